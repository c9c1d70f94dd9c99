//! Triangles out of a Wavefront OBJ: the statements `v` and `f`; polygons become triangles.
//!
//! A statement is a line, or several of which each but the last ends in a backslash; lines end in LF, CR LF or CR, and
//! a
//! `#` begins a comment, which is never continued: paths in comments end in backslashes. A corner is `v`, `v/vt`,
//! `v//vn` or
//! `v/vt/vn`, counted from 1 or, negative, from the end. Corners with the same `v` and `vn` are one vertex, so that a
//! file's hard edges stay hard. Absent: everything else, which is passed over.

use super::{MeshFault, Read, Soup};
use std::collections::BTreeMap;

/// The mark of UTF-8 that some editors put before a text.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// What the lines have told so far.
#[derive(Default)]
struct Reading {
    vertices: Vec<[f32; 3]>,
    /// The normals are counted, not kept.
    normals: i64,
    corners: BTreeMap<(usize, Option<i64>), u32>,
    soup: Soup,
}

/// Reads a file.
pub fn read(bytes: &[u8]) -> Read<Soup> {
    let mut reading = Reading::default();
    let mut statement = Vec::new();
    let mut begun = None;
    for (number, (start, line)) in (1..).zip(lines(bytes)) {
        let line = line.split(|&byte| byte == b'#').next().unwrap_or_default().trim_ascii_end();
        let place = *begun.get_or_insert((number, start));
        if let Some(head) = line.strip_suffix(b"\\") {
            statement.extend_from_slice(head);
            statement.push(b' ');
            continue;
        }
        statement.extend_from_slice(line);
        reading.statement(&statement, bytes, place)?;
        statement.clear();
        begun = None;
    }
    // The last line may promise one more.
    reading.statement(&statement, bytes, begun.unwrap_or((0, 0)))?;
    Ok(reading.soup)
}

/// The lines of a text, whichever of the three ends they have, each with the byte at which it starts.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut next = if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
    std::iter::from_fn(move || {
        let start = next;
        let text = bytes.get(start..).filter(|text| !text.is_empty())?;
        let length = text.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(text.len());
        next += length + if text[length..].starts_with(b"\r\n") { 2 } else { 1 };
        Some((start, &text[..length]))
    })
}

impl Reading {
    /// One statement, which begins in a line of this number, at this byte. Names and other text may be in any encoding.
    fn statement(&mut self, statement: &[u8], bytes: &[u8], (number, start): (usize, usize)) -> Read<()> {
        let mut words = statement.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let kind = words.next().unwrap_or_default();
        if kind == b"vn" {
            self.normals += 1;
        }
        if !matches!(kind, b"v" | b"f" | b"fo") {
            return Ok(());
        }
        let text = std::str::from_utf8(statement).map_err(|_| {
            let sound = std::str::from_utf8(&bytes[start..]).map_or_else(|error| error.valid_up_to(), str::len);
            MeshFault::new(format!("byte {}", start + sound + 1), "no UTF-8 text", "the text of a Wavefront OBJ")
        })?;
        let words = text.split_ascii_whitespace().skip(1);
        if kind == b"v" { self.vertex(words, number) } else { self.face(words, number) }
    }

    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a str>, number: usize) -> Read<()> {
        let numbers: Vec<f32> = words.take(3).map_while(|word| word.parse().ok()).collect();
        let Ok(at) = <[f32; 3]>::try_from(numbers) else {
            return Err(MeshFault::new(format!("line {number}"), "a vertex without three numbers", "`v x y z`"));
        };
        self.vertices.push(at);
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>, number: usize) -> Read<()> {
        let corners: Read<Vec<u32>> = words.map(|word| self.corner(word, number)).collect();
        self.soup.polygon(&corners?, || format!("line {number}"))
    }

    /// The number of a corner among the points, which gets one if it is new.
    fn corner(&mut self, word: &str, number: usize) -> Read<u32> {
        let mut parts = word.split('/');
        let fault = || {
            let problem = format!("the corner `{}`", word.chars().take(40).collect::<String>());
            MeshFault::new(
                format!("line {number}"),
                problem,
                format!("one of the {} vertices before it", self.vertices.len()),
            )
        };
        let index: i64 = parts.next().and_then(|part| part.parse().ok()).ok_or_else(fault)?;
        let count = self.vertices.len() as i64;
        let place = from_either_end(index, count).filter(|place| (0..count).contains(place));
        let place = place.ok_or_else(fault)? as usize;
        // A file may state its normals after its faces, so any number of them will do.
        let normal = parts.nth(1).and_then(|part| part.parse().ok());
        let normal = normal.and_then(|normal| from_either_end(normal, self.normals));
        let next = self.soup.points.len() as u32;
        let corner = *self.corners.entry((place, normal)).or_insert(next);
        if corner == next {
            self.soup.points.push(self.vertices[place]);
        }
        Ok(corner)
    }
}

/// A place from 0 out of a number that counts from 1, or backwards from the `count` that are there.
fn from_either_end(index: i64, count: i64) -> Option<i64> {
    if index < 0 { index.checked_add(count) } else { index.checked_sub(1) }
}
