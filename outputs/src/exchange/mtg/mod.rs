//! MTG: multiscale tree graphs in FORM-A (Godin & Caraglio 1998; AMAPmod, openalea.mtg, MultiScaleTreeGraph.jl, Xplo).
//!
//! `header` reads the sections before the entities, `code` the codes of entities, `reading` the rows, `values` cells
//! and dates, `names` what features mean; `writing` writes. A file of this program says in its first line that lengths
//! are metres and that XX, YY and ZZ are the base of a component; in other files they are its end, as digitised plants
//! have them, and the unit is the caller's.

mod code;
mod header;
mod names;
mod reading;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_faults;
mod values;
mod writing;

use super::contract::{Format, Incoming, Outgoing};
use super::description::Description;
use super::losses::Losses;
use super::report::Report;
use std::io;

/// The format.
pub struct Mtg;

impl Format for Mtg {
    fn word(&self) -> &'static str {
        "mtg"
    }

    fn title(&self) -> &'static str {
        "MTG, multiscale tree graphs (FORM-A)"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["mtg"]
    }

    fn is_like(&self, bytes: &[u8]) -> bool {
        let head = &bytes[..bytes.len().min(4096)];
        head.windows(6).any(|window| window == b"FORM-A")
    }

    fn read(&self, incoming: &Incoming<'_>, report: &mut Report) -> Description {
        reading::read(incoming, report)
    }

    fn write(&self, description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()> {
        writing::write(description, out, losses)
    }
}
