//! A page of the whole life of plants: each is grown once more and shown age by age, as lines with keyframes and as the
//! rows of `records`.
//!
//! Where no tolerance is given the plants are grown twice: first at a few ages, to find how large they become; the
//! tolerance is then half a pixel of a screen that shows them whole. Memory holds what changes in a life, not its ages.
//! Absent: the page itself, which is `phytomer_pages`'.

use super::RunError;
use super::captions::{caption_of_plant, caption_of_plot, titles_of};
use super::drawing::options_of;
use super::filming::Filming;
use super::picturing::obstacles_of;
use super::regrowth::{Regrowth, Standing, Whose};
use phytomer_config::Species;
use phytomer_outputs::life::{Maker, Nearness};
use phytomer_outputs::meshes::{MeshOptions, OwnForms};
use phytomer_outputs::pages::{Column, OF_A_LIFE, Page, Subject, Table};
use phytomer_outputs::paging::Rows;
use phytomer_outputs::tables::Membership;
use phytomer_sim::between::Moment;
use phytomer_sim::plant::{NodeId, OrganId, Plant};
use phytomer_sim::{RecordError, Tick};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The largest extent of the plants in tolerances, where none is given: two to a pixel.
const PIXELS: f32 = 2000.0;
/// The ages that are looked at for that extent.
const LOOKS: usize = 4;
/// The share of its radius by which the radius of wood may be off.
const OF_A_RADIUS: f32 = 0.25;
/// The tolerance of plants of which nothing is seen, metres.
const OF_NOTHING: f32 = 1e-3;
/// The sides of tubes in a form of the page; the page chooses those of its wood itself.
const SIDES: u32 = 8;
/// The room between plants side by side, as a share of the wider.
const ROOM: f32 = 0.25;

/// What a page shows, and how.
#[derive(Clone)]
pub struct View<'a> {
    /// How the plants grow.
    pub regrowth: &'a Regrowth<'a>,
    /// The species of the run.
    pub species: &'a [&'a Species],
    /// Their forms.
    pub forms: &'a [Arc<OwnForms>],
    /// What is shown: some plants side by side, or a plot.
    pub whose: Vec<Whose>,
    /// The ages, of a plot the ticks, in their order. Rows are those of whole ticks.
    pub ages: Vec<Moment>,
    /// How near the page is to the plants, metres; half a pixel of a screen if not given.
    pub tolerance: Option<f32>,
    /// Whether the columns of mechanics are kept.
    pub mechanics: bool,
}

/// What is done with what stands at an age.
type ShowAge<'a> = dyn FnMut(Moment, &[Standing]) -> Result<(), RecordError> + 'a;

/// A plant while its life is shown.
struct Growing {
    maker: Maker,
    table: Table,
    species: usize,
    sown: Tick,
    reach: f32,
}

impl View<'_> {
    /// Grows the plants and makes the page.
    ///
    /// # Errors
    /// Those of growing; [`RunError::Stopped`].
    pub fn page(&self, filming: &Filming) -> Result<Page, RunError> {
        let looks = if self.tolerance.is_some() { 0 } else { LOOKS };
        filming.begin((self.whose.len() * (looks + self.ages.len())) as u32);
        let tolerance = match self.tolerance {
            Some(tolerance) => tolerance,
            None => self.usual_tolerance(filming)?,
        };
        let mut rows = Rows::new(self.mechanics);
        let mut events: BTreeMap<(Moment, &'static str), u64> = BTreeMap::new();
        let mut subjects: Vec<Subject> = Vec::new();
        for whose in &self.whose {
            let mut growing: BTreeMap<u32, Growing> = BTreeMap::new();
            self.show(*whose, &self.ages, filming, &mut |at, standing| {
                let tick = at.tick();
                for one in standing {
                    let grown = growing.entry(one.plant.id).or_insert_with(|| self.sow(tick, one, tolerance, &rows));
                    grown.maker.show(&one.plant, one.age);
                    if at.share().is_none() {
                        let of = self.membership(&one.plant, grown);
                        rows.show(&mut grown.table, (of, &one.plant, one.age), one.age as f32)?;
                    }
                    grown.reach = grown.reach.max(reach_of(&one.plant, one.age));
                }
                if self.ages.last() == Some(&at) {
                    standing.iter().for_each(|one| self.happened(one, tick - one.age.min(tick), &mut events));
                }
                Ok(())
            })?;
            self.place(*whose, growing, &mut subjects);
        }
        Ok(self.bound(subjects, rows.columns().to_vec(), tolerance, &events))
    }

    /// Shows what stands at some ages, until it is told to stop.
    fn show(&self, whose: Whose, ages: &[Moment], filming: &Filming, show: &mut ShowAge<'_>) -> Result<(), RunError> {
        self.regrowth.show_timed(whose, ages, &|_| vec![0.0], &mut |at, standing| {
            filming.check()?;
            show(at, standing)?;
            filming.step();
            Ok(())
        })
    }

    /// Half a pixel of a screen that shows the largest extent of the plants.
    fn usual_tolerance(&self, filming: &Filming) -> Result<f32, RunError> {
        let looks = (1..=LOOKS).filter_map(|look| self.ages.get((self.ages.len() * look / LOOKS).saturating_sub(1)));
        let looks: BTreeSet<Moment> = looks.copied().collect();
        let looks: Vec<Moment> = looks.into_iter().collect();
        let mut most = 0.0_f32;
        for whose in &self.whose {
            self.show(*whose, &looks, filming, &mut |_, standing| {
                let reach = standing.iter().map(|one| reach_of(&one.plant, one.age)).fold(0.0, f32::max);
                most = most.max(reach);
                Ok(())
            })?;
        }
        // A bare number of micrometres, so that it can be told and asked for again.
        let micrometres = (most / PIXELS * 1e6).round().max(10.0);
        Ok(if most > 0.0 { micrometres / 1e6 } else { OF_NOTHING })
    }

    fn sow(&self, tick: Tick, one: &Standing, tolerance: f32, rows: &Rows) -> Growing {
        Growing {
            maker: Maker::new(
                Nearness { share: OF_A_RADIUS, ..Nearness::of(tolerance * OF_A_LIFE) },
                &self.options(one.species),
            ),
            table: Table::new(rows.columns()),
            species: one.species,
            sown: tick.saturating_sub(one.age),
            reach: 0.0,
        }
    }

    fn options(&self, species: usize) -> MeshOptions {
        options_of(SIDES, &self.forms.get(species).cloned().unwrap_or_default())
    }

    fn membership(&self, plant: &Plant, grown: &Growing) -> Membership {
        let of = self.regrowth.trial().plant(plant.id);
        Membership { plot: of.plot, treatment: of.treatment as u32, sown: grown.sown, ..Membership::default() }
    }

    /// Counts the events of a plant up to the last age, at the first age that is shown after each.
    fn happened(&self, one: &Standing, sown: Tick, events: &mut BTreeMap<(Moment, &'static str), u64>) {
        for event in one.plant.events.iter().flatten() {
            let tick = Moment::from(event.tick.saturating_add(sown));
            let at = self.ages.partition_point(|age| *age < tick);
            if let Some(age) = self.ages.get(at) {
                *events.entry((*age, event.kind.tag())).or_insert(0) += 1;
            }
        }
    }

    /// Gives plants side by side their places, to the right of those that have theirs; those of a plot keep theirs.
    fn place(&self, whose: Whose, growing: BTreeMap<u32, Growing>, subjects: &mut Vec<Subject>) {
        let trial = self.regrowth.trial();
        for (number, grown) in growing {
            let place = match whose {
                Whose::Plot(_) => trial.place_in_plot(number),
                Whose::Plant(_) => [0.0; 3],
            };
            let of = trial.plant(number);
            let treatment = trial.treatments().get(of.treatment).map(|treatment| treatment.name.clone());
            let species = self.species[grown.species].about.name.clone();
            subjects.push(Subject {
                number,
                species: grown.species,
                name: format!("plant {number}, {species}"),
                place,
                sown: if matches!(whose, Whose::Plot(_)) { grown.sown as f32 } else { 0.0 },
                constants: vec![
                    ("treatment", treatment.unwrap_or_default().into()),
                    ("plot_id", of.plot.into()),
                    ("plant_id", number.into()),
                ],
                reach: grown.reach,
                life: grown.maker.finish(),
                table: grown.table,
                options: self.options(grown.species),
            });
        }
        if let (Whose::Plant(_), [.., before, last]) = (whose, &mut subjects[..]) {
            let apart = (before.reach + last.reach) * 0.5 * (1.0 + ROOM);
            last.place[0] = before.place[0] + f64::from(apart);
        }
    }

    fn bound(
        &self,
        subjects: Vec<Subject>,
        columns: Vec<Column>,
        tolerance: f32,
        events: &BTreeMap<(Moment, &'static str), u64>,
    ) -> Page {
        let trial = self.regrowth.trial();
        let scenario = trial.scenario();
        let caption = |age: Moment| match self.whose[0] {
            Whose::Plant(plant) => caption_of_plant(trial, self.species, plant, age),
            Whose::Plot(plot) => caption_of_plot(trial, self.species, plot, age),
        };
        let shown: BTreeSet<usize> = subjects.iter().map(|subject| subject.species).collect();
        let what: Vec<String> = self
            .whose
            .iter()
            .map(|whose| match whose {
                Whose::Plant(plant) => format!("plant {plant}"),
                Whose::Plot(plot) => format!("plot {plot}"),
            })
            .collect();
        Page {
            title: titles_of(self.species, &shown),
            note: format!("{} of {}, seed {}", what.join(", "), scenario.name, scenario.seed),
            run: scenario.name.clone(),
            seed: scenario.seed,
            tolerance,
            of_plot: matches!(self.whose[0], Whose::Plot(_)),
            ages: self.ages.iter().map(|age| (age.age() as f32, caption(*age))).collect(),
            events: events.iter().map(|((age, what), count)| (age.age() as f32, *what, *count)).collect(),
            columns,
            subjects,
            obstacles: match self.whose[0] {
                Whose::Plot(plot) => obstacles_of(trial, plot),
                Whose::Plant(_) => Vec::new(),
            },
        }
    }
}

/// The largest side of the box around what stands of a plant, metres.
fn reach_of(plant: &Plant, age: Tick) -> f32 {
    let nodes = (0..plant.nodes.len() as u32).map(NodeId).filter(|node| plant.stands(*node, age));
    let tips = nodes.map(|node| plant.frames.at(node).advanced(plant.posed_length(node)).base);
    let (mut low, mut high) = ([0.0_f32; 3], [0.0_f32; 3]);
    for tip in tips {
        low = [0, 1, 2].map(|k| low[k].min(tip[k]));
        high = [0, 1, 2].map(|k| high[k].max(tip[k]));
    }
    let organs = (0..plant.organs.len()).filter(|organ| plant.organ_stands(OrganId(*organ as u32), age));
    let organ = organs.map(|organ| plant.organs.length[organ]).fold(0.0, f32::max);
    [0, 1, 2].map(|k| high[k] - low[k]).into_iter().fold(organ, f32::max)
}
