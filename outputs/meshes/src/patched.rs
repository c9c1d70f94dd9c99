//! Where a file is written whose beginning is put right at its end, such as a count that is known only then.
//!
//! Absent: files of the system, which are the caller's.

use std::io::{self, Write};

/// What a file is written to that can be put right.
pub trait Patched: Write + Send {
    /// Writes over bytes that were written before.
    ///
    /// # Errors
    /// Those of the file; where the bytes have gone out for good, as in a pipe.
    fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()>;
}

impl<S: Patched + ?Sized> Patched for &mut S {
    fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        (**self).patch(at, bytes)
    }
}

impl Patched for Vec<u8> {
    fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        let place = usize::try_from(at).ok().and_then(|at| self.get_mut(at..at.checked_add(bytes.len())?));
        place.ok_or(io::ErrorKind::InvalidInput)?.copy_from_slice(bytes);
        Ok(())
    }
}
