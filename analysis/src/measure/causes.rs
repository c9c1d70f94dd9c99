//! Measure of causes: the share of lives that each cause has ended by a dimension, where causes compete.
//!
//! F_k(t) = Σ S(s − 1) d_k(s) / n(s) (Aalen & Johansen 1978), with intervals of plants. Unit: share of lives. Absent:
//! survival (`life`).

use super::fault::Fault;
use super::groups::Groups;
use super::life::lives;
use super::lives::Living;
use super::result::{Cells, Measured, Sheet};
use super::source::Source;
use phytomer_measures::Lack;
use phytomer_measures::survival::aalen_johansen;
use phytomer_outputs::tables::columns::CAUSES;
use std::collections::BTreeSet;

/// The shares ended by each cause, in each group.
pub(super) fn measure(living: Living, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let found = lives(living, sources, groups)?;
    let mut notes = BTreeSet::new();
    let mut sheet = Sheet::new(
        "causes",
        &[
            ("group", ""),
            ("cause", ""),
            ("dimension", "tick"),
            ("ended", ""),
            ("share", ""),
            ("plant_se", ""),
            ("low", ""),
            ("high", ""),
        ],
    );
    for (number, name) in groups.sorted() {
        let Some(lives) = found.get(number as usize).filter(|lives| !lives.is_empty()) else { continue };
        let clusters = lives.clusters();
        if clusters < 2 {
            notes.insert(format!("{name}: no interval: {}", Lack::Plants { found: clusters, needed: 2 }));
        }
        match aalen_johansen(lives, level) {
            Err(lack) => {
                notes.insert(format!("{name}: no share of causes: {lack}"));
            }
            Ok(rows) => sheet.rows.extend(rows.into_iter().map(|of| {
                let row = Cells::of(name, &mut notes).word(CAUSES.get(of.cause).copied().unwrap_or("unknown"));
                let row = row.count(of.ticks).count(of.ended).real(of.share).maybe(of.of_plants);
                row.maybe(of.interval.map(|of| of.low)).maybe(of.interval.map(|of| of.high)).done()
            })),
        }
    }
    if sheet.rows.is_empty() && notes.is_empty() {
        notes.insert(format!("no causes: {}", Lack::Empty));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}
