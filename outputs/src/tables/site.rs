//! The rows of `site`: what the date brought to the plots of a treatment and replicate at a recorded tick, how many of
//! their plants lived, and what pests did to these.
//!
//! Plots of one treatment and replicate follow one another, so their plants are counted together and their rows are
//! written when the next ones begin, or the part ends. A run of several parts has the rows of each part that has
//! plots of them: the sums of `plots` and `living_plants` are those of the run. Without a calendar the columns of the
//! date are null. Absent: what single plants are (`summary`).

use super::buffers::{NO_DATE, NULL, columns};
use phytomer_sim::plant::Exposure;
use phytomer_sim::site::calendar::CalendarTick;
use phytomer_sim::site::calendars::Calendars;
use phytomer_sim::site::date::Date;
use phytomer_sim::{Plot, Tick};
use std::ops::Range;

columns! {
    /// The buffers of `site`.
    SiteColumns of at: SiteAt, of: &Group {
        treatment: Name(i32) = of.treatment as i32,
        plot: Int(i32) = of.first_plot as i32,
        replicate: Int(i32) = of.replicate as i32,
        block: Int(i32) = of.block.map_or(NULL, |block| block as i32),
        tick: Int(i32) = at.tick as i32,
        date: Date(i32) = at.of_calendar.map_or(NO_DATE, |of| of.date.since(Date::EPOCH)),
        degree_days: Double(f64) = at.number(|of| of.degree_days),
        degree_day_sum: Double(f64) = at.number(|of| of.degree_day_sum),
        day_length: Double(f64) = at.number(|of| of.day_length_h),
        nitrogen: Double(f64) = at.number(|of| of.nitrogen_kg_ha),
        plots: Int(i32) = of.plots as i32,
        living: Int(i32) = at.living as i32,
        apex: Double(f64) = at.pressures[0],
        leaf: Double(f64) = at.pressures[1],
        flower: Double(f64) = at.pressures[2],
        fruit: Double(f64) = at.pressures[3],
        plant: Double(f64) = at.pressures[4],
        leaf_area_index: Double(f64),
        ground_light: Double(f64),
    }
}

/// A recorded tick of the plots of a group.
#[derive(Debug, Clone, Copy)]
struct SiteAt {
    tick: Tick,
    of_calendar: Option<CalendarTick>,
    living: u32,
    /// The means of [`Exposure::pressures`] over the living plants; NaN where there is none.
    pressures: [f64; 5],
}

impl SiteAt {
    fn number(&self, of: fn(&CalendarTick) -> Option<f64>) -> f64 {
        self.of_calendar.as_ref().and_then(of).unwrap_or(f64::NAN)
    }
}

/// The plots of one treatment and replicate so far, in one part.
#[derive(Debug, Default)]
pub struct Group {
    treatment: u32,
    replicate: u32,
    block: Option<u32>,
    first_plot: u32,
    plots: u32,
    /// The plants that live at each recorded tick.
    living: Vec<u32>,
    /// The sums of their [`Exposure::pressures`]; empty without pests.
    pressures: Vec<[f64; 5]>,
    /// What a pest attacks on any of the plants.
    attacked: [bool; 5],
    /// What the light of the plots comes to at each recorded tick; empty in runs without columns of light.
    light: Vec<GroundLight>,
}

/// What the light of plots comes to at a tick.
#[derive(Debug, Clone, Copy, Default)]
pub struct GroundLight {
    /// The leaf area of the plots, m².
    pub leaf_area: f64,
    /// Their ground, m²; NaN where it is not known.
    pub ground: f64,
    /// The sum over the plots of the share of open light on their ground; NaN where there is no light.
    pub share: f64,
    /// The number of plots.
    pub plots: u32,
}

impl Group {
    /// Whether a plot belongs to the group.
    pub fn has(&self, plot: &Plot) -> bool {
        self.plots > 0 && (self.treatment, self.replicate) == (plot.treatment, plot.replicate)
    }

    /// Counts the living plants of a plot that has ended, at the recorded ticks up to `last`; the first plot makes the
    /// group one of its treatment and replicate.
    pub fn count(&mut self, plot: &Plot, recorded: &[Tick], last: Tick) {
        if self.plots == 0 {
            let Plot { treatment, replicate, block, id: first_plot, .. } = *plot;
            (self.treatment, self.replicate, self.block, self.first_plot) = (treatment, replicate, block, first_plot);
            self.living.clear();
            self.living.resize(recorded.len(), 0);
        }
        self.plots += 1;
        for (plant, member) in plot.plants.iter().zip(&plot.members) {
            for (living, tick) in self.living.iter_mut().zip(recorded).take_while(|(_, tick)| **tick <= last) {
                *living += u32::from(member.age_at(*tick).is_some_and(|age| plant.lives(age)));
            }
            if let Some(exposure) = &plant.exposure {
                let ages = recorded.iter().take_while(|tick| **tick <= last).map(|tick| member.age_at(*tick));
                let living = |age: Option<Tick>| age.filter(|age| plant.lives(*age));
                self.press(exposure, ages.map(living));
            }
        }
    }

    /// Adds the light of a plot at recorded ticks, by their places.
    pub fn light_up(&mut self, light: impl Iterator<Item = (usize, GroundLight)>) {
        self.light.resize(self.living.len(), GroundLight::default());
        for (place, of_plot) in light {
            let Some(sum) = self.light.get_mut(place) else { continue };
            sum.leaf_area += of_plot.leaf_area;
            sum.ground += of_plot.ground;
            sum.share += of_plot.share;
            sum.plots += of_plot.plots;
        }
    }

    /// The leaf area index and the light on the ground at a recorded tick; NaN where they are not known.
    fn light_at(&self, place: usize) -> [f64; 2] {
        let Some(of) = self.light.get(place).filter(|of| of.plots > 0) else { return [f64::NAN; 2] };
        [of.leaf_area / of.ground, of.share / f64::from(of.plots)]
    }

    /// Adds what pests do to a plant at its age at each recorded tick; no age where it does not live.
    fn press(&mut self, exposure: &Exposure, ages: impl Iterator<Item = Option<Tick>>) {
        self.pressures.resize(self.living.len(), [0.0; 5]);
        for (sums, age) in self.pressures.iter_mut().zip(ages) {
            let Some(age) = age else { continue };
            for (place, pressure) in exposure.pressures(age).into_iter().enumerate() {
                self.attacked[place] |= pressure.is_some();
                sums[place] += pressure.unwrap_or(0.0);
            }
        }
    }

    /// The means of the pressures at a recorded tick, by its place.
    fn mean_pressures(&self, place: usize) -> [f64; 5] {
        let living = self.living.get(place).copied().unwrap_or(0);
        let sums = self.pressures.get(place).copied().unwrap_or([f64::NAN; 5]);
        let mean = |at: usize| if self.attacked[at] && living > 0 { sums[at] / f64::from(living) } else { f64::NAN };
        [0, 1, 2, 3, 4].map(mean)
    }

    /// The number of its rows: one for each recorded tick; none where the group has no plot.
    pub fn rows(&self) -> usize {
        if self.plots == 0 { 0 } else { self.living.len() }
    }

    /// Forgets the plots, keeping the memory.
    pub fn clear(&mut self) {
        self.plots = 0;
        self.living.clear();
        self.pressures.clear();
        self.attacked = [false; 5];
        self.light.clear();
    }
}

impl SiteColumns {
    /// Adds the rows of a group at some of the recorded ticks, by their places. `calendars` has those of each
    /// treatment.
    pub fn add(&mut self, group: &Group, (recorded, some): (&[Tick], Range<usize>), calendars: &[Calendars]) {
        let calendar = calendars.get(group.treatment as usize).and_then(|of| of.of(group.replicate));
        let at = |place: usize| SiteAt {
            tick: recorded[place],
            of_calendar: calendar.map(|calendar| *calendar.at(recorded[place])),
            living: group.living[place],
            pressures: group.mean_pressures(place),
        };
        let rows: Vec<SiteAt> = some.clone().map(at).collect();
        self.extend(&rows, group);
        if !group.light.is_empty() {
            let [index, share]: [fn([f64; 2]) -> f64; 2] = [|[index, _]| index, |[_, share]| share];
            self.leaf_area_index.extend(some.clone().map(|place| index(group.light_at(place))));
            self.ground_light.extend(some.map(|place| share(group.light_at(place))));
        }
    }
}
