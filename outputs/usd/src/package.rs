//! A package (`.usdz`): a zip without compression, whose first file is a binary layer; pictures follow. Each begins at
//! a multiple of 64 bytes.
//!
//! The sum and the size of the layer stand before it and are known after it, so they are put right at the end, as the
//! layer's own bootstrap is. The time of the file is the earliest of its format, so that the same plants are the same
//! bytes.

use crc32fast::Hasher;
use phytomer_meshes::{Patched, Picture};
use std::io::{self, Write};
use std::sync::Arc;

/// Where the layer begins.
const ALIGNED: usize = 64;
/// The bytes of the header of a file, without its name.
const LOCAL: usize = 30;
/// The least bytes of the field that fills the header.
const LEAST_FILLING: usize = 4;
/// The name of the field that fills the header, as OpenUSD has it.
const FILLING: u16 = 0x1986;
/// 1980-01-01.
const DATE: u16 = 0x21;
/// The bytes at the beginning that are put right at the end: those of the bootstrap of a layer.
const PATCHED: usize = 88;

/// A package that is being written.
pub struct Package<'o> {
    out: &'o mut dyn Patched,
    name: String,
    /// The first bytes of the layer, as they are going to be.
    head: Vec<u8>,
    rest: Hasher,
    size: u64,
}

impl<'o> Package<'o> {
    /// Begins a package whose layer has this name, with its ending.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn begin(out: &'o mut dyn Patched, name: &str) -> io::Result<Self> {
        let package = Self { out, name: name.to_owned(), head: Vec::new(), rest: Hasher::new(), size: 0 };
        package.out.write_all(&package.local(0, 0))?;
        Ok(package)
    }

    /// The header before the layer.
    fn local(&self, sum: u32, size: u32) -> Vec<u8> {
        Entry { name: &self.name, sum, size, at: 0 }.local()
    }

    /// Writes pictures behind the layer by their names, then what stands behind all files, and puts the header of the
    /// layer right.
    ///
    /// # Errors
    /// Those of the file; files that are larger than a package may be.
    pub fn finish(self, pictures: &[(Arc<Picture>, String)]) -> io::Result<()> {
        let too_large =
            || io::Error::other("a .usdz file holds at most 4 GiB: write a .usdc file, or choose a larger tolerance");
        let most = |size: u64| u32::try_from(size).ok().filter(|size| *size < u32::MAX - 4096).ok_or_else(too_large);
        let size = most(self.size)?;
        let mut sum = Hasher::new();
        sum.update(&self.head);
        sum.combine(&self.rest);
        let sum = sum.finalize();
        let mut entries = vec![Entry { name: &self.name, sum, size, at: 0 }];
        let mut place = ALIGNED as u64 + self.size;
        for (picture, name) in pictures {
            let sum = crc32fast::hash(&picture.bytes);
            let entry = Entry { name, sum, size: most(picture.bytes.len() as u64)?, at: most(place)? };
            let header = entry.local();
            self.out.write_all(&header)?;
            self.out.write_all(&picture.bytes)?;
            place += (header.len() + picture.bytes.len()) as u64;
            entries.push(entry);
        }
        let directory: Vec<u8> = entries.iter().flat_map(Entry::listed).collect();
        let mut end = b"PK\x05\x06".to_vec();
        let count = entries.len() as u16;
        end.extend([0, 0, count, count].into_iter().flat_map(u16::to_le_bytes));
        end.extend([directory.len() as u32, most(place)?].into_iter().flat_map(u32::to_le_bytes));
        end.extend([0; 2]);
        self.out.write_all(&directory)?;
        self.out.write_all(&end)?;
        self.out.flush()?;
        let header = self.local(sum, size);
        self.out.patch(0, &header)
    }
}

/// A file of a package, whose header begins at a place.
struct Entry<'e> {
    name: &'e str,
    sum: u32,
    size: u32,
    at: u32,
}

impl Entry<'_> {
    /// The header before it, filled up so that it begins at a multiple of 64 bytes.
    fn local(&self) -> Vec<u8> {
        let plain = LOCAL + self.name.len();
        let end = (self.at as usize + plain + LEAST_FILLING).next_multiple_of(ALIGNED) - self.at as usize;
        let filling = end - plain;
        let mut header = b"PK\x03\x04".to_vec();
        self.describe(&mut header);
        header.extend((filling as u16).to_le_bytes());
        header.extend(self.name.as_bytes());
        header.extend([FILLING, filling as u16 - 4].into_iter().flat_map(u16::to_le_bytes));
        header.resize(end, 0);
        header
    }

    /// What both headers say: version, flags, method, time and date, sum, sizes, length of the name.
    fn describe(&self, header: &mut Vec<u8>) {
        header.extend([10, 0, 0, 0, DATE].into_iter().flat_map(u16::to_le_bytes));
        header.extend([self.sum, self.size, self.size].into_iter().flat_map(u32::to_le_bytes));
        header.extend((self.name.len() as u16).to_le_bytes());
    }

    /// Its line in the directory.
    fn listed(&self) -> Vec<u8> {
        let mut line = b"PK\x01\x02".to_vec();
        line.extend(10_u16.to_le_bytes());
        self.describe(&mut line);
        // No filling, no comment, the first disk, no attributes.
        line.extend([0; 12]);
        line.extend(self.at.to_le_bytes());
        line.extend(self.name.as_bytes());
        line
    }
}

impl Write for Package<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        let first = (PATCHED - self.head.len()).min(written);
        self.head.extend_from_slice(&bytes[..first]);
        self.rest.update(&bytes[first..written]);
        self.size += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

impl Patched for Package<'_> {
    fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        let place = at as usize..at as usize + bytes.len();
        let head = self.head.get_mut(place).ok_or_else(|| io::Error::other("only the beginning can be put right"))?;
        head.copy_from_slice(bytes);
        self.out.patch(at + ALIGNED as u64, bytes)
    }
}
