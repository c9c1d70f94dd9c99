//! Maps of colours (`.map`) and of materials (`.mat`), in which `;` and `,` walk: binary files of up to 256 entries.
//!
//! A colour is three bytes: red, green, blue. A material is fifteen: its number, its transparency, the ambient, the
//! diffuse, the emitted and the specular colour, its shininess. Of a material the diffuse colour is used, or the
//! ambient where that is black. Absent: light.

use super::text::TextFault;

/// The most entries of a map.
const MOST: usize = 256;
/// The bytes of a material.
const MATERIAL: usize = 15;

/// The colours of a map by their numbers.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Colours {
    by_number: Vec<Option<[u8; 3]>>,
}

impl Colours {
    /// Reads a map of colours.
    ///
    /// # Errors
    /// Where the file has no whole number of colours from 1 to 256.
    pub fn of_map(bytes: &[u8]) -> Result<Self, TextFault> {
        whole(bytes, 3)?;
        let colour = |entry: &[u8]| Some([entry[0], entry[1], entry[2]]);
        Ok(Self { by_number: bytes.chunks_exact(3).map(colour).collect() })
    }

    /// Reads a map of materials.
    ///
    /// # Errors
    /// As [`Colours::of_map`].
    pub fn of_materials(bytes: &[u8]) -> Result<Self, TextFault> {
        whole(bytes, MATERIAL)?;
        let mut by_number = vec![None; MOST];
        for entry in bytes.chunks_exact(MATERIAL) {
            let colour = |first: usize| [entry[first], entry[first + 1], entry[first + 2]];
            let (ambient, diffuse) = (colour(2), colour(5));
            by_number[usize::from(entry[0])] = Some(if diffuse == [0; 3] { ambient } else { diffuse });
        }
        Ok(Self { by_number })
    }

    /// The colour of a number, which is counted around 256; `None` where the map has none.
    pub fn get(&self, number: i32) -> Option<[u8; 3]> {
        let place = number.rem_euclid(MOST as i32) as usize;
        self.by_number.get(place).copied().flatten()
    }
}

/// A fault where the bytes are no whole number of entries of a size, from 1 to 256.
fn whole(bytes: &[u8], size: usize) -> Result<(), TextFault> {
    let entries = bytes.len() / size;
    if bytes.len().is_multiple_of(size) && (1..=MOST).contains(&entries) {
        return Ok(());
    }
    let column = (entries.min(MOST) * size + 1) as u32;
    let problem = format!("the file has {} bytes", bytes.len());
    Err(TextFault { line: 1, column, problem, expected: format!("a multiple of {size}, at most {}", size * MOST) })
}
