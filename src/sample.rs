//! A sample of a species, grown to be held against what was published of such plants (`[[published]]`).
//!
//! The sample is the same on every machine: plants 0, 1, 2 … of the default seed, on open ground, as many as the size
//! of the first ones allows. Means are over the plants that live. Absent: files, and what is done about a sample that
//! does not fit.

use phytomer_config::published::{Measure, PUBLISHED, Published, Range};
use phytomer_config::{Species, scenario::DEFAULT_SEED};
use phytomer_models::fault::{Fault, Path};
use phytomer_outputs::tables::Summary;
use phytomer_sim::plant::Seed;
use phytomer_sim::{Ending, GrowthModel, Plot, RecordError, Recorder, Tick, grow};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// The plants of a sample, unless they are large.
const MOST_PLANTS: u32 = 16;

/// Of large plants fewer do: their parts already average.
const FEWEST_PLANTS: u32 = 2;

/// No more plants are grown than come to about so many components.
const ENOUGH_COMPONENTS: u64 = 1_000_000;

/// A plant that is larger is not measured.
const COMPONENT_LIMIT: u32 = 20_000_000;

/// A measure of the sample beside the range that was published.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// Which `[[published]]` of the species, from 0.
    pub row: usize,
    /// The age, ticks.
    pub at_age: Tick,
    /// What was measured.
    pub measure: Measure,
    /// The published range.
    pub range: Range,
    /// The sample's mean; NaN where no plant of it lives.
    pub found: f64,
    /// The plants of the sample.
    pub plants: u32,
}

impl Compared {
    /// Whether the sample lies in the range.
    pub fn fits(&self) -> bool {
        (self.range[0]..=self.range[1]).contains(&self.found)
    }
}

/// Grows a sample and holds it against every published range; nothing is grown where there is none.
///
/// # Errors
/// Laws that do not hold up to the last published age, and a plant too large to be measured.
pub fn compare(species: &Species) -> Result<Vec<Compared>, Vec<Fault>> {
    let published = &species.about.published;
    let Some(last) = published.iter().map(|row| row.at_age).max() else { return Ok(Vec::new()) };
    let model = species.model.compile(last)?;
    let sample = Sample::grown(model.as_ref(), published, last).map_err(|problem| {
        let path = Path::root().key(PUBLISHED);
        vec![Fault::new(&path, problem, "plants that can be grown to the published age")]
    })?;
    let rows = published.iter().enumerate();
    Ok(rows.flat_map(|(row, published)| sample.held_against(row, published)).collect())
}

/// What a sample does not fit, each at its place in the species file; the faults of [`compare`] likewise.
pub fn faults(species: &Species) -> Vec<Fault> {
    let compared = match compare(species) {
        Ok(compared) => compared,
        Err(faults) => return faults,
    };
    let misfits = compared.iter().filter(|compared| !compared.fits());
    misfits.map(|misfit| fault(misfit, &species.about.published[misfit.row])).collect()
}

fn fault(misfit: &Compared, published: &Published) -> Fault {
    let Compared { row, at_age, measure, range: [least, most], found, plants } = *misfit;
    let (name, unit) = (measure.name(), measure.unit());
    let of = amounts(plants);
    let problem = match found.is_nan() {
        true => format!("none of {of} lives at age {at_age}"),
        false => format!("the {name} of {of} is {found:.3}{unit} on average at age {at_age}"),
    };
    let expected = format!("{least} to {most}{unit}: {}", published.source);
    Fault::new(&Path::root().key(PUBLISHED).index(row).key(measure.key()), problem, expected)
}

fn amounts(plants: u32) -> String {
    if plants == 1 { "1 plant".to_owned() } else { format!("{plants} plants") }
}

/// What stood of each plant of a sample at the published ages.
struct Sample {
    plants: u32,
    seen: Vec<Seen>,
}

/// What stood of one plant at an age, and whether it lived.
type Seen = (Tick, bool, Summary);

impl Sample {
    /// The first plants tell how many more there are to be; they grow side by side.
    fn grown(model: &dyn GrowthModel, published: &[Published], last: Tick) -> Result<Self, String> {
        let ages: Vec<Tick> = published.iter().map(|row| row.at_age).collect();
        let grown = |from: u32, to: u32| -> Result<Vec<_>, String> {
            (from..to).into_par_iter().map(|plant| seen_of(plant, model, &ages, last)).collect()
        };
        let mut views = grown(0, FEWEST_PLANTS)?;
        let components = views.iter().map(|(_, components)| components).sum::<u64>().max(1);
        let enough = (ENOUGH_COMPONENTS * u64::from(FEWEST_PLANTS)).div_ceil(components).min(MOST_PLANTS.into()) as u32;
        views.extend(grown(FEWEST_PLANTS, enough)?);
        Ok(Self { plants: views.len() as u32, seen: views.into_iter().flat_map(|(seen, _)| seen).collect() })
    }

    fn held_against(&self, row: usize, published: &Published) -> Vec<Compared> {
        let at_age = published.at_age;
        let ranges = published.ranges();
        let compared = ranges.map(|(measure, range)| {
            let found = self.mean(measure, at_age);
            Compared { row, at_age, measure, range, found, plants: self.plants }
        });
        compared.collect()
    }

    fn mean(&self, measure: Measure, age: Tick) -> f64 {
        let living: Vec<&Summary> =
            self.seen.iter().filter(|(at, lives, _)| *at == age && *lives).map(|(_, _, summary)| summary).collect();
        let mean = |of: fn(&Summary) -> f64| living.iter().map(|s| of(s)).sum::<f64>() / living.len() as f64;
        match measure {
            Measure::Height => mean(|s| s.height),
            Measure::CrownWidth => mean(|s| s.crown_width),
            Measure::Leaves => mean(|s| f64::from(s.leaves)),
            Measure::LeafArea => mean(|s| s.leaf_area),
            Measure::Living => living.len() as f64 / f64::from(self.plants),
        }
    }
}

/// Grows one plant of a sample; what was seen of it, and its components.
fn seen_of(plant: u32, model: &dyn GrowthModel, ages: &[Tick], last: Tick) -> Result<(Vec<Seen>, u64), String> {
    let seed = Seed {
        plant,
        draws: plant.into(),
        run_seed: DEFAULT_SEED,
        component_limit: COMPONENT_LIMIT,
        keep_events: false,
    };
    let mut plot = Plot::of_one(model, &seed);
    let mut view = View { ages, seen: Vec::new() };
    match grow(&mut plot, last, &mut view) {
        Ok(Ending::Complete) => Ok((view.seen, u64::from(plot.plants[0].components()))),
        Ok(Ending::Overgrown { age, .. }) => {
            Err(format!("a plant has more than {COMPONENT_LIMIT} components at age {age}"))
        }
        Err(error) => Err(error.to_string()),
    }
}

/// What is seen of one plant.
struct View<'a> {
    ages: &'a [Tick],
    seen: Vec<Seen>,
}

impl Recorder for View<'_> {
    fn wants(&self, age: Tick) -> bool {
        self.ages.contains(&age)
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        let plant = &plot.plants[0];
        self.seen.push((age, plant.death > age, Summary::of(plant, age)?));
        Ok(())
    }
}
