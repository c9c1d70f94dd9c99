//! The Open Plant Format 2.0 (`.opf`) of Xplo, Archimed and PlantGeom.jl: XML with reference meshes, and a plant whose
//! entities have a matrix each.
//!
//! Read: parts in any order, any of them missing; `follow` within its predecessor and beside it; `NA`. Written:
//! `follow` beside, so that long axes do not nest; what the format has no word for as attributes (`words`). Absent:
//! how plants stand in a plot, which scenes hold (`ops`).

mod carried;
mod faces;
mod fields;
mod order;
mod parts;
mod passed;
mod topology;
mod used;
mod words;
mod write;

use super::contract::{Format, Incoming, Outgoing};
use super::description::{Description, Role};
use super::losses::Losses;
use super::report::Report;
use super::text::{decoded, said};
use super::xml::{Piece, Xml};
use carried::Carried;
use parts::Parts;
use passed::left_out;
use std::io;
use topology::Plants;
pub(super) use write::Writing;

/// The format.
pub struct Opf;

impl Format for Opf {
    fn word(&self) -> &'static str {
        "opf"
    }

    fn title(&self) -> &'static str {
        "Open Plant Format of Xplo, Archimed and PlantGeom.jl"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["opf"]
    }

    fn is_like(&self, bytes: &[u8]) -> bool {
        bytes[..bytes.len().min(1000)].windows(5).any(|five| five == b"<opf ")
    }

    fn read(&self, incoming: &Incoming<'_>, report: &mut Report) -> Description {
        read(incoming, report)
    }

    fn write(&self, description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()> {
        let standing = description.individuals.iter().filter(|plant| plant.standing.is_some()).count() as u64;
        losses.add("places of plants in their plot", standing, "a scene (`ops`) holds them");
        let plants: Vec<usize> = (0..description.individuals.len()).collect();
        let writing = Writing::of(description, losses);
        out.file(None, &mut |file| writing.file(&plants, file, losses))
    }
}

/// The plants of a file.
pub(super) fn read(incoming: &Incoming<'_>, report: &mut Report) -> Description {
    let text = decoded(incoming.bytes, report);
    let mut xml = Xml::of(&text);
    let mut described = Description::default();
    match first(&mut xml, report) {
        Some(()) => inside(&mut xml, incoming, &mut described, report),
        None => return described,
    }
    if described.individuals.is_empty() && !report.is_refused() {
        report.fault((0, 0), "the file has no plant", "a `<topology>` with a plant in it");
    }
    described
}

/// Goes to the inside of `<opf>`.
fn first(xml: &mut Xml<'_>, report: &mut Report) -> Option<()> {
    loop {
        match xml.next(report) {
            Piece::Open(element) if element.name == "opf" => {
                let version = element.attribute("version").unwrap_or("2.0").trim();
                if version.parse() != Ok(2.0) {
                    let place = xml.place(element.at);
                    report.warn(place, "", format!("the file is of version `{}` and is read as 2.0", said(version)));
                }
                return Some(());
            }
            Piece::Open(element) => {
                let place = xml.place(element.at);
                report.fault(
                    place,
                    format!("the file begins with `<{}>`", said(&element.name)),
                    "`<opf version=\"2.0\">`",
                );
                return None;
            }
            Piece::Text(..) | Piece::Close => {}
            Piece::End => {
                if !report.is_refused() {
                    report.fault((0, 0), "the file has no element", "`<opf version=\"2.0\">`");
                }
                return None;
            }
        }
    }
}

fn inside(xml: &mut Xml<'_>, incoming: &Incoming<'_>, described: &mut Description, report: &mut Report) {
    let mut parts = Parts::default();
    let mut plants = Plants::default();
    // What stands before the plant is known when the plant is read; of what stands behind it, shapes alone are needed.
    let found = loop {
        match xml.next(report) {
            Piece::Open(element) if element.name == "topology" => {
                let mut carried = Carried::of(&parts, incoming.units);
                plants.read(&element, xml, &mut carried, report);
                break Some(carried.found());
            }
            Piece::Open(element) => {
                if !parts.take(&element.name.clone(), xml, report) {
                    left_out(&element, xml, report);
                }
            }
            Piece::Text(..) => {}
            Piece::Close | Piece::End => break None,
        }
    };
    let Some(found) = found else { return };
    loop {
        match xml.next(report) {
            Piece::Open(element) if element.name == "topology" => {
                let place = xml.place(element.at);
                report.fault(
                    place,
                    "a second `<topology>`",
                    "one, with several plants within a scene where there are more",
                );
                xml.skip(report);
            }
            Piece::Open(element) => {
                if !parts.take(&element.name.clone(), xml, report) {
                    left_out(&element, xml, report);
                }
            }
            Piece::Text(..) | Piece::Close => {}
            Piece::End => break,
        }
    }
    let shapes = parts.shapes(report);
    let Plants { mut individuals, classes, .. } = plants;
    let role_of = |class: u32| classes.get(class as usize).map_or(Role::Other, |class| class.role);
    found.settle(&mut individuals, &parts, &shapes, role_of, report);
    let (features, ticks_per_year) = (found.features, found.ticks_per_year);
    let Parts { meshes, materials, .. } = parts;
    *described = Description { individuals, classes, features, meshes, materials, shapes, ticks_per_year };
}
