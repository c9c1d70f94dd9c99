//! Measures of recorded runs: the list of them, what each is, and the way to take one.
//!
//! A measure streams over one table of one or several runs; its memory depends on the plants and groups, not on the
//! rows. The plant is the unit of every interval. Absent: how a measure is asked for and shown, which is the command
//! line's.

mod activity;
mod allometry;
mod angles;
mod branching;
mod card;
mod causes;
mod columns;
mod contrast;
mod cover;
mod crown;
pub mod distributions;
mod fault;
mod form;
mod groups;
mod life;
mod lives;
mod means;
mod nodes;
mod result;
mod sizes;
mod source;
mod stream;

pub use card::{Card, MEASURES};
pub use cover::effective_leaf_areas;
pub use fault::Fault;
pub use result::{Cell, Column, Measured, Sheet};

use angles::AtAge;
use card::Of;
use groups::{By, Groups};
use phytomer_measures::cover::Direction;
use phytomer_outputs::read::Run;
use sizes::Size;
use source::Source;
use std::path::Path;

/// What is asked of a measure.
#[derive(Debug, Clone)]
pub struct Asked {
    /// What rows are grouped by.
    pub by: Option<String>,
    /// The level of intervals.
    pub level: f64,
    /// The age, for measures of an age; the last recorded one where it is not said.
    pub age: Option<u32>,
    /// The number of plants that contrasts, components of variance and power are of, and the y of allometry.
    pub of: Option<String>,
    /// The x of allometry.
    pub x: Option<String>,
    /// The thickness of the layers of a crown profile, metres.
    pub layer_m: f64,
    /// Where the sun stands that an effective leaf area faces: its altitude and its azimuth from north over east,
    /// degrees; from above where it is not said.
    pub sun_deg: Option<[f64; 2]>,
    /// The difference that is wanted, in the unit of the number.
    pub difference: Option<f64>,
    /// The probability with which it is to be found.
    pub power: f64,
}

impl Default for Asked {
    fn default() -> Self {
        let (by, age, of, x, sun_deg, difference) = (None, None, None, None, None, None);
        Self { by, level: 0.95, age, of, x, layer_m: 0.5, sun_deg, difference, power: 0.8 }
    }
}

/// Takes a measure of runs.
///
/// # Errors
/// [`Fault`]: runs that are not finished, of several schemas or without the table, and what cannot be asked of them.
pub fn measure(folders: &[&Path], card: &Card, asked: &Asked) -> Result<Measured, Fault> {
    check(asked)?;
    taken(Source::open(folders)?, card, asked)
}

/// Takes a measure of runs that are open, such as one whose tables are in memory.
///
/// # Errors
/// As [`measure`].
pub fn measure_runs(runs: Vec<Run>, card: &Card, asked: &Asked) -> Result<Measured, Fault> {
    check(asked)?;
    taken(Source::of_runs(runs)?, card, asked)
}

fn taken(sources: Vec<Source>, card: &Card, asked: &Asked) -> Result<Measured, Fault> {
    let by = By::of(asked.by.as_deref(), card.name, card.groups, &sources)?;
    let all_ages = by == By::Int("age");
    let mut groups = Groups::new(by);
    let (groups, level) = (&mut groups, asked.level);
    let sources = &sources[..];
    match card.of {
        Of::Life(living) => life::measure(living, sources, groups, level),
        Of::Causes(living) => causes::measure(living, sources, groups, level),
        Of::Activity => means::measure(&activity::Steps, ("activity", ""), (sources, groups, level), |own| own),
        Of::Nodes(nodes) => means::measure(&nodes, ("nodes", "node"), (sources, groups, level), |own| own.moments()),
        Of::Branching => branching::measure(sources, groups, level),
        Of::Size { column, unit, per_ground } => {
            let age = if all_ages { None } else { Some(age_of(sources, asked)?) };
            sizes::measure(&Size { column, unit, per_ground, age }, sources, groups, level)
        }
        Of::Alive => {
            let age = if all_ages { None } else { Some(age_of(sources, asked)?) };
            sizes::living(age, sources, groups, level)
        }
        Of::Angle(angle) => {
            let unit = AtAge { angle, age: age_of(sources, asked)? };
            angles::measure(&unit, sources, groups, level)
        }
        Of::Form(form) => {
            let unit = form::Standing { form, age: age_of(sources, asked)? };
            let of_values = if form == form::Form::Cone { "deg" } else { "" };
            means::measure(&unit, ("form", of_values), (sources, groups, level), |own| unit.values(&own))
        }
        Of::Cover => {
            let radians =
                |[altitude, azimuth]: [f64; 2]| Direction::of_sun(altitude.to_radians(), azimuth.to_radians());
            let direction = asked.sun_deg.map_or(Direction::ABOVE, radians);
            let unit = cover::Foliage { age: age_of(sources, asked)?, direction };
            cover::measure(&unit, sources, groups, level)
        }
        Of::Profile | Of::ClearBole => {
            let leaves = crown::Leaves { age: age_of(sources, asked)?, layer_m: asked.layer_m };
            match card.of {
                Of::Profile => crown::profile(&leaves, sources, groups, level),
                _ => crown::clear_bole(&leaves, sources, groups, level),
            }
        }
        Of::Allometry => {
            let (x, y) =
                (card::size(asked.x.as_deref(), "crown_width_m")?, card::size(asked.of.as_deref(), "height_m")?);
            let sizes = allometry::Sizes { x: x.0, y: y.0, age: age_of(sources, asked)? };
            allometry::measure(&sizes, sources, groups, level)
        }
        Of::Contrast | Of::Variance | Of::Power => of_treatments(card, sources, groups, asked),
    }
}

/// The measures that compare groups of plants, which must therefore be asked for.
fn of_treatments(card: &Card, sources: &[Source], groups: &mut Groups, asked: &Asked) -> Result<Measured, Fault> {
    let (column, unit) = card::size(asked.of.as_deref(), "height_m")?;
    let size = Size { column, unit, per_ground: false, age: Some(age_of(sources, asked)?) };
    if groups.by == By::Nothing {
        groups.by = if sources.len() > 1 { By::Run } else { By::Treatment };
    }
    match card.of {
        Of::Contrast => contrast::contrasts(&size, sources, groups, asked.level),
        Of::Variance => contrast::variances(&size, sources, groups, asked.level),
        _ => {
            let wanted = asked.difference.ok_or_else(|| {
                Fault::Asked(format!(
                    "--difference: `{}` needs the difference that is to be found, in {unit}",
                    card.name
                ))
            })?;
            contrast::needed(&size, (sources, groups), (wanted, asked.power, asked.level))
        }
    }
}

fn check(asked: &Asked) -> Result<(), Fault> {
    let between = |name: &str, value: f64| match value > 0.0 && value < 1.0 {
        true => Ok(()),
        false => Err(Fault::Asked(format!("{name} {value}: a share between 0 and 1 is expected, such as 0.95"))),
    };
    between("--level", asked.level)?;
    between("--power", asked.power)?;
    if !(asked.layer_m > 0.0 && asked.layer_m.is_finite()) {
        return Err(Fault::Asked(format!("--layer {}: a thickness above 0 m is expected", asked.layer_m)));
    }
    if let Some([altitude, azimuth]) = asked.sun_deg
        && !((0.0..=90.0).contains(&altitude) && (-360.0..=360.0).contains(&azimuth))
    {
        let expected = "an altitude from 0 to 90 and an azimuth from -360 to 360 degrees are expected, such as 30,180";
        return Err(Fault::Asked(format!("--sun {altitude},{azimuth}: {expected}")));
    }
    match asked.difference {
        Some(difference) if !(difference.is_finite() && difference != 0.0) => {
            Err(Fault::Asked(format!("--difference {difference}: a number other than 0 is expected")))
        }
        _ => Ok(()),
    }
}

/// The age that is asked for, else the last that all runs have recorded.
fn age_of(sources: &[Source], asked: &Asked) -> Result<u32, Fault> {
    if let Some(age) = asked.age {
        return sources.iter().try_for_each(|source| has_age(source, age)).map(|()| age);
    }
    let mut common: Option<Vec<u32>> = None;
    for source in sources {
        let own = source.recorded();
        common = Some(match common {
            None => own,
            Some(before) => before.into_iter().filter(|age| own.contains(age)).collect(),
        });
    }
    common
        .and_then(|ages| ages.into_iter().max())
        .ok_or_else(|| Fault::Asked("--age: the runs have recorded no age that all of them share; say one".to_owned()))
}

/// Whether a plant of a run has this age at a recorded tick; plants that were sown later have other ages.
fn has_age(source: &Source, age: u32) -> Result<(), Fault> {
    let recorded = source.recorded();
    let has = |sown: u32| sown.checked_add(age).is_some_and(|tick| recorded.contains(&tick));
    if source.plants.iter().filter_map(|plant| plant.sown).any(has) {
        return Ok(());
    }
    let ticks: Vec<String> = recorded.iter().map(u32::to_string).collect();
    Err(Fault::Age { path: source.run.path().to_path_buf(), age, recorded: ticks.join(", ") })
}
