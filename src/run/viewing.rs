//! A page of the whole life of plants: each is grown once more and shown age by age, as lines with keyframes and as the
//! rows of `records`.
//!
//! Where no tolerance is given, or a detail above 0, the plants are grown twice: first at a few ages, to find how large
//! they become and how many triangles their organs have. The tolerance is then half a pixel of a screen that shows them
//! whole, and the detail the largest whose triangles a browser still draws as fast as it is turned. Memory holds what
//! changes in a life, not its ages.
//! Absent: the page itself, which is `phytomer_pages`'.

use super::RunError;
use super::captions::{caption_of_plant, caption_of_plot, titles_of};
use super::drawing::options_of;
use super::filming::Filming;
use super::picturing::obstacles_of;
use super::regrowth::{Regrowth, Standing, Whose};
use phytomer_config::Species;
use phytomer_outputs::life::{Maker, Nearness, organs_alone};
use phytomer_outputs::meshes::{MOST_DETAIL, MeshOptions, OwnForms, Scene};
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
/// The ages that are looked at for that extent and for the triangles.
const LOOKS: usize = 4;
/// The share of its radius by which the radius of wood may be off.
pub(super) const OF_A_RADIUS: f32 = 0.25;
/// The most triangles that organs have at any of these ages.
const MOST_TRIANGLES: u64 = 2_000_000;
/// The tolerance of plants of which nothing is seen, metres.
const OF_NOTHING: f32 = 1e-3;
/// The sides of tubes in a form of the page; the page chooses those of its wood itself.
pub(super) const SIDES: u32 = 8;
/// The room between plants side by side, as a share of the wider.
pub(super) const ROOM: f32 = 0.25;

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
    /// How finely organs are drawn at most.
    pub detail: u8,
}

/// How large plants are at some ages, and how many triangles their organs have at each detail, at most.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Look {
    reach: f32,
    triangles: [u64; MOST_DETAIL as usize + 1],
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
        let looks = if self.tolerance.is_some() && self.detail == 0 { 0 } else { LOOKS };
        filming.begin((self.whose.len() * (looks + self.ages.len())) as u32);
        let options = self.options();
        let look = if looks > 0 { self.look(&options, filming)? } else { Look::default() };
        let tolerance = self.tolerance.unwrap_or_else(|| tolerance_of(look.reach));
        let detail = look.detail(self.detail);
        let options: Vec<MeshOptions> = options.into_iter().map(|options| MeshOptions { detail, ..options }).collect();
        let mut rows = Rows::new(self.mechanics);
        let mut events: BTreeMap<(Moment, &'static str), u64> = BTreeMap::new();
        let mut subjects: Vec<Subject> = Vec::new();
        for whose in &self.whose {
            let mut growing: BTreeMap<u32, Growing> = BTreeMap::new();
            self.show(*whose, &self.ages, filming, &mut |at, standing| {
                let tick = at.tick();
                for one in standing {
                    let sow = || self.sow((tick, one), tolerance, &rows, &options);
                    let grown = growing.entry(one.plant.id).or_insert_with(sow);
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
            self.place(*whose, growing, &options, &mut subjects);
        }
        Ok(Page { detail, ..self.bound(subjects, rows.columns().to_vec(), tolerance, &events) })
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

    /// Looks at the plants at some ages: all of those of a page at once, since they are side by side.
    fn look(&self, options: &[MeshOptions], filming: &Filming) -> Result<Look, RunError> {
        let looks = (1..=LOOKS).filter_map(|look| self.ages.get((self.ages.len() * look / LOOKS).saturating_sub(1)));
        let looks: BTreeSet<Moment> = looks.copied().collect();
        let looks: Vec<Moment> = looks.into_iter().collect();
        let mut at: BTreeMap<Moment, Look> = BTreeMap::new();
        for whose in &self.whose {
            self.show(*whose, &looks, filming, &mut |age, standing| {
                let look = at.entry(age).or_default();
                standing.iter().for_each(|one| look.add((&one.plant, one.age), &options[one.species], self.detail));
                Ok(())
            })?;
        }
        Ok(at.into_values().fold(Look::default(), Look::most))
    }

    fn sow(&self, (tick, one): (Tick, &Standing), tolerance: f32, rows: &Rows, options: &[MeshOptions]) -> Growing {
        Growing {
            maker: Maker::new(
                Nearness { share: OF_A_RADIUS, ..Nearness::of(tolerance * OF_A_LIFE) },
                &options[one.species],
            ),
            table: Table::new(rows.columns()),
            species: one.species,
            sown: tick.saturating_sub(one.age),
            reach: 0.0,
        }
    }

    /// The options of each species.
    fn options(&self) -> Vec<MeshOptions> {
        (0..self.species.len())
            .map(|species| options_of(SIDES, &self.forms.get(species).cloned().unwrap_or_default()))
            .collect()
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
    fn place(
        &self,
        whose: Whose,
        growing: BTreeMap<u32, Growing>,
        options: &[MeshOptions],
        subjects: &mut Vec<Subject>,
    ) {
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
                options: options[grown.species].clone(),
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
            detail: 0,
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

impl Look {
    /// Adds a plant at an age; `most` is the largest detail that is counted.
    pub(super) fn add(&mut self, (plant, age): (&Plant, Tick), options: &MeshOptions, most: u8) {
        self.reach = self.reach.max(reach_of(plant, age));
        for detail in 1..=most {
            let options = MeshOptions { detail, ..organs_alone(options) };
            self.triangles[usize::from(detail)] += Scene::new(plant, age, &options).counts().faces;
        }
    }

    /// The larger of each of two.
    pub(super) fn most(self, other: Self) -> Self {
        let triangles = std::array::from_fn(|detail| self.triangles[detail].max(other.triangles[detail]));
        Self { reach: self.reach.max(other.reach), triangles }
    }

    /// How large the largest is, metres.
    pub(super) fn reach(&self) -> f32 {
        self.reach
    }

    /// The largest detail up to one that is asked for whose triangles are not too many.
    pub(super) fn detail(&self, asked: u8) -> u8 {
        (1..=asked).rev().find(|detail| self.triangles[usize::from(*detail)] <= MOST_TRIANGLES).unwrap_or(0)
    }
}

/// Half a pixel of a screen that shows an extent: a bare number of micrometres, so that it can be told and asked for
/// again.
pub(super) fn tolerance_of(extent: f32) -> f32 {
    let micrometres = (extent / PIXELS * 1e6).round().max(10.0);
    if extent > 0.0 { micrometres / 1e6 } else { OF_NOTHING }
}

/// The largest side of the box around what stands of a plant, metres.
pub(super) fn reach_of(plant: &Plant, age: Tick) -> f32 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_detail_of_a_page_is_the_largest_that_is_not_too_large() {
        let look = |triangles| Look { reach: 1.0, triangles };
        let many = look([0, 10, MOST_TRIANGLES, MOST_TRIANGLES + 1]);
        assert_eq!([0, 1, 2, 3].map(|asked| many.detail(asked)), [0, 1, 2, 2]);
        assert_eq!(look([0, MOST_TRIANGLES + 1, 0, 0]).detail(1), 0);
        let both = many.most(look([0, 20, 5, 7]));
        assert_eq!(both.triangles, [0, 20, MOST_TRIANGLES, MOST_TRIANGLES + 1]);
    }
}
