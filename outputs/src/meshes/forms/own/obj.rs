//! Triangles out of a Wavefront OBJ: the lines `v` and `f`; polygons become fans.
//!
//! A corner is `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or, negative, from the end. Corners with the same `v` and
//! `vn` are one vertex, so that a file's hard edges stay hard. Absent: everything else, which is passed over.

use super::{MeshFault, Read, Soup};
use std::collections::BTreeMap;

/// What the lines have told so far.
#[derive(Default)]
struct Reading {
    vertices: Vec<[f32; 3]>,
    corners: BTreeMap<(usize, Option<i64>), u32>,
    soup: Soup,
}

/// Reads a file.
pub fn read(bytes: &[u8]) -> Read<Soup> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        MeshFault::new(format!("byte {}", error.valid_up_to() + 1), "no UTF-8 text", "the text of a Wavefront OBJ")
    })?;
    let mut reading = Reading::default();
    for (number, line) in (1..).zip(text.lines()) {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => reading.vertex(words, number)?,
            Some("f") => reading.face(words, number)?,
            _ => {}
        }
    }
    Ok(reading.soup)
}

impl Reading {
    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a str>, number: usize) -> Read<()> {
        let numbers: Vec<f32> = words.take(3).map_while(|word| word.parse().ok()).collect();
        let Ok(at) = <[f32; 3]>::try_from(numbers) else {
            return Err(MeshFault::new(format!("line {number}"), "a vertex without three numbers", "`v x y z`"));
        };
        self.vertices.push(at);
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>, number: usize) -> Read<()> {
        let corners: Read<Vec<u32>> =
            words.take_while(|word| !word.starts_with('#')).map(|word| self.corner(word, number)).collect();
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
        let place = if index < 0 { index.checked_add(count) } else { index.checked_sub(1) };
        let place = place.filter(|place| (0..count).contains(place)).ok_or_else(fault)? as usize;
        let normal = parts.nth(1).and_then(|part| part.parse().ok());
        let next = self.soup.points.len() as u32;
        let corner = *self.corners.entry((place, normal)).or_insert(next);
        if corner == next {
            self.soup.points.push(self.vertices[place]);
        }
        Ok(corner)
    }
}
