//! The species of a run: each that its treatments name, read and checked once, and compiled for the dates of its
//! plants.
//!
//! What depends on the date alone is compiled away: a law of the date is a table of the age. So a species with such
//! laws is compiled once for each calendar and first tick of sowing, and stands in the run as a species of its own for
//! each; a species without them is compiled once. Absent: calendars (`dates`), and what must hold between species and
//! scenario (`checked`).

use phytomer_law::Constant;
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::site::calendar::Dates;

use crate::about::About;
use crate::checked::Compiled;
use crate::dates::{Dated, Refused};
use crate::document::Node;
use crate::load::{Found, Loader, Mention, path_of};
use crate::models::Model;
use crate::report::Fault;
use crate::species::Species;
use crate::treatments::Read;

/// The calendars of all treatments, one for each.
type Calendars<'a> = Result<&'a [Option<Dated>], &'a Refused>;

/// The species of the run, and for each treatment the places of its species among them. `until` is the last tick.
pub(crate) fn check(
    loader: &mut Loader,
    read: &[Read],
    calendars: Calendars<'_>,
    until: Option<u32>,
) -> Option<(Vec<Compiled>, Vec<Vec<usize>>)> {
    let mut run = SpeciesOfRun { read, calendars, until, known: Vec::new(), compiled: Vec::new() };
    let mut places = Vec::with_capacity(read.len());
    for (treatment, Read { species, .. }) in read.iter().enumerate() {
        // All are looked at, so that the faults of all are told.
        let of_treatment: Vec<Option<usize>> =
            species.iter().map(|mention| run.place(loader, mention, treatment)).collect();
        places.push(of_treatment.into_iter().collect::<Option<Vec<usize>>>());
    }
    Some((run.compiled, places.into_iter().collect::<Option<_>>()?))
}

/// What the laws of a species may depend on beside the age: a calendar, as the first treatment that has it, and the
/// first tick of sowing.
type Key = (usize, u32);

/// A species under a key.
struct Known {
    name: String,
    /// `None` where no law depends on the date.
    key: Option<Key>,
    /// Its place in the run; `None` where it has faults, which are told.
    place: Option<usize>,
}

struct SpeciesOfRun<'a> {
    read: &'a [Read],
    calendars: Calendars<'a>,
    until: Option<u32>,
    known: Vec<Known>,
    compiled: Vec<Compiled>,
}

impl SpeciesOfRun<'_> {
    /// The place in the run of a species of a treatment.
    fn place(&mut self, loader: &mut Loader, mention: &Mention, treatment: usize) -> Option<usize> {
        let key = self.key_of(mention, treatment);
        let of_name = || self.known.iter().filter(|known| known.name == mention.name);
        let holds = |known: &&Known| known.place.is_none() || known.key.is_none() || known.key == key;
        if let Some(known) = of_name().find(holds) {
            return known.place;
        }
        let first = of_name().find_map(|known| known.place);
        let dates = self.calendars.map(|_| key.and_then(|key| self.dates(key))).map_err(|refused| *refused);
        let until = self.until.map(|until| self.last_age_of(mention).unwrap_or(until));
        let compiled = match first {
            None => check_species(loader, mention, |_| until, dates.clone()),
            Some(place) => compiled_again(loader, &self.compiled[place], until?, &dates.clone().ok()??),
        };
        let key = key.filter(|_| compiled.as_ref().is_none_or(|of| of.species.may_know_the_date()));
        let place = compiled.map(|compiled| {
            self.compiled.push(compiled);
            self.compiled.len() - 1
        });
        self.known.push(Known { name: mention.name.clone(), key, place });
        place
    }

    fn key_of(&self, mention: &Mention, treatment: usize) -> Option<Key> {
        let calendars = self.calendars.ok()?;
        let calendar = calendars.get(treatment)?.as_ref()?;
        let first = calendars.iter().position(|other| other.as_ref() == Some(calendar))?;
        let scenario = self.read[treatment].scenario.as_ref()?;
        let place = scenario.species_names().iter().position(|name| *name == mention.name)?;
        Some((first, scenario.first_sowing_of(place)))
    }

    fn dates(&self, (calendar, sown): Key) -> Option<Dates> {
        Some(self.calendars.ok()?.get(calendar)?.as_ref()?.of_sowing(sown))
    }

    /// The last age that a species reaches in any treatment; `None` where none of them could be read.
    fn last_age_of(&self, species: &Mention) -> Option<u32> {
        let ages = self.read.iter().filter_map(|Read { scenario, .. }| {
            let scenario = scenario.as_ref()?;
            let place = scenario.species_names().iter().position(|name| *name == species.name)?;
            Some(scenario.last_age_of_species(place).clamp(1, LAST_TICK))
        });
        ages.max()
    }
}

/// A species that was checked, for other dates.
fn compiled_again(loader: &mut Loader, of: &Compiled, until: u32, dates: &Dates) -> Option<Compiled> {
    match of.species.model.compile_dated(until, Some(dates)) {
        Ok(model) => Some(Compiled { species: of.species.clone(), model, tree: of.tree.clone() }),
        Err(faults) => {
            loader.tell(&of.tree, faults);
            None
        }
    }
}

/// Reads, checks and compiles a species.
pub(crate) fn check_species(
    loader: &mut Loader,
    mention: &Mention,
    until: impl Fn(Option<&About>) -> Option<u32>,
    dates: Result<Option<Dates>, Refused>,
) -> Option<Compiled> {
    let Found { about, model, node } = loader.species(mention)?;
    if let Some(about) = &about {
        loader.tell(&node, about.faults());
        check_year(loader, &node, about, &model);
    }
    // Without its calendar a scenario cannot know which laws of the date hold.
    let dates = dates.ok()?;
    match model.compile_dated(until(about.as_ref())?, dates.as_ref()) {
        Ok(compiled) => Some(Compiled { species: Species { about: about?, model }, model: compiled, tree: node }),
        Err(faults) => {
            loader.tell(&node, faults);
            None
        }
    }
}

/// A species has one year: where its season states the ticks of a year too, both numbers must agree.
fn check_year(loader: &mut Loader, node: &Node, about: &About, model: &Model) {
    let (Some(stated), Some((path, in_season))) = (about.ticks_per_year.as_ref().map(Constant::value), model.year())
    else {
        return;
    };
    if stated == f64::from(in_season) {
        return;
    }
    let other = path_of(&["ticks_per_year"]);
    let span = node.locate(&other);
    let ((line, column), file) = (loader.sources.place(span), &loader.sources.get(span.source).name);
    let problem = format!(
        "the year of the season is of {in_season} ticks, and `ticks_per_year` is {stated} ({file}:{line}:{column})"
    );
    loader.faults.push(Fault::new(node.locate(&path), &path, problem, "the same number at both places"));
}
