//! Triangles from a Wavefront OBJ: the statements `v` and `f`; polygons become triangles.
//!
//! A statement is a line, or several lines that end in a backslash, but for the last; lines end in LF, CR LF or CR. A
//! `#` begins a comment, which is never continued, since paths in comments may end in backslashes. A corner is `v`,
//! `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or, if negative, from the end. Corners with equal `v` and `vn` are one
//! vertex, so that a file's hard edges stay hard. Absent: all other statements, which are skipped.

use super::{MeshFault, Read, Soup};
use std::collections::BTreeMap;

/// The byte order mark of UTF-8, which some editors put before a text.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// The vertices and triangles of the lines read so far.
#[derive(Default)]
struct Reading {
    vertices: Vec<[f32; 3]>,
    /// The normals are only counted.
    normals: i64,
    corners: BTreeMap<(usize, Option<i64>), u32>,
    soup: Soup,
}

/// Reads the triangles of an OBJ file.
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
    // The last line may end in a backslash.
    reading.statement(&statement, bytes, begun.unwrap_or((0, 0)))?;
    Ok(reading.soup)
}

/// The lines of a text, with any of the three line ends, each with the byte at which it starts.
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
    /// Reads one statement, given with the line and the byte at which it begins. Names and other text may have any
    /// encoding.
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

    /// The index of a corner's point; a new corner gets a new point.
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
        // A file may state its normals after its faces, so their number is not checked.
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

/// An index from 0, from an index that counts from 1, or backwards from the `count` entries so far.
fn from_either_end(index: i64, count: i64) -> Option<i64> {
    if index < 0 { index.checked_add(count) } else { index.checked_sub(1) }
}
