//! The faces of a reference mesh in an OPF file: in elements of their own, or their corners all together in threes.

use super::super::numbers::words;
use super::super::report::Report;
use super::super::text::said;
use super::super::xml::{Piece, Xml};
use super::passed::left_out;

/// The faces of a mesh.
#[derive(Debug, Default)]
pub(super) struct Faces {
    /// Corners of faces that have elements of their own, and where each of these faces ends.
    corners: Vec<u32>,
    ends: Vec<u32>,
    /// Corners that stand in threes.
    loose: Vec<u32>,
    /// The largest corner, and where it stands first.
    largest: Option<(u32, (usize, usize))>,
    end: (usize, usize),
}

impl Faces {
    /// The faces that were opened last.
    pub fn read(&mut self, xml: &mut Xml<'_>, report: &mut Report) {
        loop {
            match xml.next(report) {
                Piece::Text(text, at) => {
                    let found = self.indices(&text, at, xml, report);
                    self.loose.extend(found);
                }
                Piece::Open(element) if element.name == "face" => {
                    let place = xml.place(element.at);
                    let (text, at) = xml.text(report);
                    let found = self.indices(&text, at, xml, report);
                    if found.len() < 3 {
                        let problem = format!("a face has {} corners", found.len());
                        report.fault(place, problem, "three corners or more");
                    }
                    self.corners.extend(found);
                    self.ends.push(self.corners.len() as u32);
                }
                Piece::Open(element) => left_out(&element, xml, report),
                Piece::Close | Piece::End => {
                    self.end = xml.here();
                    return;
                }
            }
        }
    }

    fn indices(&mut self, text: &str, at: usize, xml: &mut Xml<'_>, report: &mut Report) -> Vec<u32> {
        let mut found = Vec::new();
        for (word, at) in words(text, at) {
            let Ok(index) = word.parse() else {
                let place = xml.place(at);
                report.fault(place, format!("`{}` is no corner of a face", said(word)), "whole numbers from 0");
                continue;
            };
            if self.largest.is_none_or(|(largest, _)| index > largest) {
                self.largest = Some((index, xml.place(at)));
            }
            found.push(index);
        }
        found
    }

    /// Triangles; a polygon becomes a fan about its first corner.
    pub fn triangles(&self, points: usize, report: &mut Report) -> Vec<[u32; 3]> {
        if let Some((corner, place)) = self.largest.filter(|(corner, _)| *corner as usize >= points) {
            let problem = format!("a face names point {corner} of a mesh with {points} points");
            report.fault(place, problem, format!("a whole number below {points}"));
        }
        if !self.loose.len().is_multiple_of(3) {
            let problem = format!("{} corners outside of `<face>` are no triangles", self.loose.len());
            report.fault(self.end, problem, "a multiple of three");
        }
        let threes = self.loose.chunks_exact(3).map(|face| [face[0], face[1], face[2]]);
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let fans = starts.zip(&self.ends).flat_map(|(start, end)| {
            let face = &self.corners[start as usize..*end as usize];
            (1..face.len().saturating_sub(1)).map(|k| [face[0], face[k], face[k + 1]])
        });
        threes.chain(fans).collect()
    }
}
