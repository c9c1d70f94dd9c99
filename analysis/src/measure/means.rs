//! The sheet of means of units within plants, which measures of activity, nodes and angles share.
//!
//! Each row has the mean over units with its interval of plants, the design effect and the Monte-Carlo error, which is
//! the standard error of the mean over the drawn plants. Absent: what a unit is.

use super::fault::Fault;
use super::groups::Groups;
use super::result::{Cells, Column, Measured, Sheet};
use super::source::Source;
use super::stream::{Unit, each_plant, of_group};
use phytomer_measures::Lack;
use phytomer_measures::moments::Moments;
use phytomer_measures::ratio::Ratio;
use std::collections::BTreeSet;

/// The means of each group. `own` makes the moments of the units of a plant.
pub(super) fn measure<U: Unit>(
    unit: &U,
    (name, of_units): (&'static str, &'static str),
    (sources, groups, level): (&[Source], &mut Groups, f64),
    own: impl Fn(U::OfPlant) -> Moments,
) -> Result<Measured, Fault> {
    let mut found: Vec<Ratio> = Vec::new();
    for source in sources {
        each_plant(unit, source, groups, |of, plant| of_group(&mut found, of.group).add(&own(plant)))?;
    }
    let mut notes = BTreeSet::new();
    let columns: [Column; 9] = [
        ("group", ""),
        ("plants", ""),
        ("units", ""),
        ("mean", of_units),
        ("sd_of_units", of_units),
        ("monte_carlo_error", of_units),
        ("low", of_units),
        ("high", of_units),
        ("design_effect", ""),
    ];
    let mut sheet = Sheet::new(name, &columns);
    for (number, group) in groups.sorted() {
        let Some(ratio) = found.get(number as usize) else { continue };
        match ratio.mean(level) {
            Err(lack) => {
                notes.insert(format!("{group}: no mean: {lack}"));
            }
            Ok(mean) => {
                let row = Cells::of(group, &mut notes).count(mean.plants).count(mean.units).real(mean.value);
                let row = row.estimate("deviation of units", mean.deviation);
                let row = row.estimate("interval", mean.estimate.map(|of| of.standard_error));
                let row = row.maybe(mean.estimate.ok().map(|of| of.interval.low));
                let row = row.maybe(mean.estimate.ok().map(|of| of.interval.high));
                sheet.rows.push(
                    match mean.estimate {
                        Ok(_) => row.estimate("design effect", mean.design_effect),
                        Err(_) => row.maybe(None),
                    }
                    .done(),
                );
            }
        }
    }
    if sheet.rows.is_empty() {
        notes.insert(format!("no mean: {}", Lack::Empty));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}
