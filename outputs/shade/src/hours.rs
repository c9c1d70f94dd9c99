//! How long each zone lies in the shade, month by month.
//!
//! At each moment a point lies in the shade of a building, else of a plant, else in the sun; the moments of a day stand
//! for equal parts of it. A zone has the mean of its points, by their areas. Moments are followed side by side and
//! summed in their order, so that no sum depends on the number of threads.
//!
//! **Error.** Two parts are added and told with each mean. *Moments*: where the shaded share of a zone changes by ΔA
//! from one moment to the next, when it does so is known to a step s, so that hours are off by ΔA·s/√12 in the mean
//! square; morning and evening, which may mirror each other, count as one twice as large, and days by themselves.
//! *Cells*: half of what the black and the white cells of the grid differ by. That is an estimate and no bound; it
//! falls with finer steps and grids. Not in it: what the sun's place is off by (.02°, and .1° for the declination that
//! holds for a day), and what the days between those that are followed would say.

use crate::body::{Caster, Cause};
use crate::samples::Samples;
use crate::shadow::{Marks, cast};
use crate::sky::{Day, Moment, Sky};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};

/// The share of daylight of which a point is in the shade for most of the day.
const MOST_OF_THE_DAY: f64 = 0.5;

/// How far the work has come, and the wish to stop it.
#[derive(Debug, Default)]
pub struct Watch {
    done: AtomicU64,
    in_all: AtomicU64,
    stop: AtomicBool,
}

/// The work was stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("stopped")]
pub struct Stopped;

/// A zone in a month, or in the year.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MonthOfZone {
    /// How long the sun is up, hours a day.
    pub sun_h: f64,
    /// How long the zone lies in the shade of a building, hours a day.
    pub building_h: f64,
    /// How long it lies in the shade of a plant and of no building, hours a day.
    pub plant_h: f64,
    /// The share of its area that lies in the shade for half of the daylight or longer; 0 where the sun is not up.
    pub mostly_shaded: f64,
    /// What the hours of shade may be off by, hours a day.
    pub error_h: f64,
}

/// Hours of shade; the thirteenth month is the year.
#[derive(Debug, Clone, PartialEq)]
pub struct Shade {
    /// Zone by zone.
    pub zones: Vec<[MonthOfZone; 13]>,
    /// Hours of shade a day of each point.
    pub points: Vec<[f32; 13]>,
    /// For each trial what it adds to each zone by itself, hours a day: shade where the casters cast none.
    pub added: Vec<Vec<[f64; 13]>>,
}

impl Watch {
    /// The share of the work that is done.
    pub fn share(&self) -> f64 {
        self.done.load(Relaxed) as f64 / self.in_all.load(Relaxed).max(1) as f64
    }

    /// Asks the work to stop soon.
    pub fn stop(&self) {
        self.stop.store(true, Relaxed);
    }

    /// Whether it was asked to stop.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Relaxed)
    }
}

impl MonthOfZone {
    /// Hours of shade a day.
    pub fn shade_h(&self) -> f64 {
        self.building_h + self.plant_h
    }

    /// The share of daylight in the shade; `None` where the sun is not up.
    pub fn share(&self) -> Option<f64> {
        (self.sun_h > 0.0).then(|| (self.shade_h() / self.sun_h).min(1.0))
    }
}

/// Follows the sun through the months over zones, casters and, each by itself, trials.
///
/// Takes O(moments × triangles), and more where shadows cover many points.
///
/// # Errors
/// [`Stopped`].
pub fn shade(
    sky: &Sky,
    samples: &Samples,
    casters: &[Caster<'_>],
    trials: &[Caster<'_>],
    watch: &Watch,
) -> Result<Shade, Stopped> {
    let months: Vec<Vec<Day>> = (1..=12).map(|month| sky.days(month)).collect();
    let moments: usize = months.iter().flatten().map(|day| day.moments.len()).sum();
    watch.done.store(0, Relaxed);
    watch.in_all.store(moments as u64, Relaxed);
    let mut sums = Sums::new(samples, trials.len());
    for (month, days) in months.iter().enumerate() {
        for day in days {
            let seen = |moment: &Moment| {
                watch.done.fetch_add(1, Relaxed);
                (!watch.is_stopped()).then(|| Seen::at(samples, casters, trials, month, moment)).ok_or(Stopped)
            };
            let seen: Vec<Seen> = day.moments.par_iter().map(seen).collect::<Result<_, _>>()?;
            sums.add(month, day, &seen);
        }
    }
    Ok(sums.shade(samples))
}

/// What a moment shows.
struct Seen {
    buildings: Marks,
    plants: Marks,
    /// The area that each trial adds to each zone, m².
    added: Vec<Vec<f64>>,
}

impl Seen {
    fn at(samples: &Samples, casters: &[Caster<'_>], trials: &[Caster<'_>], month: usize, moment: &Moment) -> Self {
        let marked = |cause: Cause| {
            let mut marks = Marks::none(samples.all.len());
            let of_cause = casters.iter().filter(|caster| caster.cause == cause);
            of_cause.for_each(|caster| cast(samples, caster, month, moment.shift, &mut marks));
            marks
        };
        let [buildings, plants] = [Cause::Building, Cause::Plant].map(marked);
        let added = trials.iter().map(|trial| {
            let (mut marks, mut areas) = (Marks::none(samples.all.len()), vec![0.0; samples.grids.len()]);
            cast(samples, trial, month, moment.shift, &mut marks);
            for point in marks.beyond(Some(&buildings)).filter(|point| !plants.has(*point)) {
                areas[samples.all[point].zone] += samples.all[point].area_m2;
            }
            areas
        });
        Self { added: added.collect(), buildings, plants }
    }
}

/// Hours of a point in the shade of a building, and of a plant alone, over the days of a month.
type OfPoint = [f64; 2];

struct Sums<'a> {
    samples: &'a Samples,
    /// The days of each month, and its hours of sun in all.
    days: [f64; 12],
    sun: [f64; 12],
    points: Vec<[OfPoint; 12]>,
    /// For each zone the square of what the moments may be off by, h².
    moments: Vec<[f64; 12]>,
    /// m² h of each trial and zone.
    added: Vec<Vec<[f64; 12]>>,
}

impl<'a> Sums<'a> {
    fn new(samples: &'a Samples, trials: usize) -> Self {
        Self {
            samples,
            days: [0.0; 12],
            sun: [0.0; 12],
            points: vec![[[0.0; 2]; 12]; samples.all.len()],
            moments: vec![[0.0; 12]; samples.grids.len()],
            added: vec![vec![[0.0; 12]; samples.grids.len()]; trials],
        }
    }

    fn add(&mut self, month: usize, day: &Day, seen: &[Seen]) {
        self.days[month] += day.days;
        self.sun[month] += day.days * day.sun_h;
        let each = day.days * day.sun_h / seen.len().max(1) as f64;
        let mut before: Option<Vec<f64>> = None;
        for seen in seen {
            let mut shaded = vec![0.0; self.samples.grids.len()];
            let of_causes = [seen.buildings.beyond(None), seen.plants.beyond(Some(&seen.buildings))];
            for (cause, points) in of_causes.into_iter().enumerate() {
                for point in points {
                    self.points[point][month][cause] += each;
                    shaded[self.samples.all[point].zone] += self.samples.all[point].area_m2;
                }
            }
            for (sums, areas) in self.added.iter_mut().zip(&seen.added) {
                sums.iter_mut().zip(areas).for_each(|(sum, area)| sum[month] += area * each);
            }
            for (zone, before) in before.iter().flatten().enumerate() {
                let changed = (shaded[zone] - before) / self.samples.areas_m2[zone] * each;
                self.moments[zone][month] += changed * changed / 6.0;
            }
            before = Some(shaded);
        }
    }

    fn shade(&self, samples: &Samples) -> Shade {
        let year: f64 = self.days.iter().sum();
        let mut zones = vec![[MonthOfZone::default(); 13]; samples.grids.len()];
        for month in 0..13 {
            let of_zones = self.month(month);
            zones.iter_mut().zip(of_zones).for_each(|(zone, of_zone)| zone[month] = of_zone);
        }
        let in_days = |sums: &dyn Fn(usize) -> f64, over: f64| {
            let mut months = [0.0; 13];
            (0..12).for_each(|month| months[month] = sums(month) / (self.days[month] * over));
            months[12] = (0..12).map(sums).sum::<f64>() / (year * over);
            months
        };
        let points = self.points.iter().map(|point| {
            let hours = |month: usize| point[month][0] + point[month][1];
            in_days(&hours, 1.0).map(|hours| hours as f32)
        });
        let of_trial = |zones: &Vec<[f64; 12]>| {
            let areas = zones.iter().zip(&samples.areas_m2);
            areas.map(|(sums, area)| in_days(&|month| sums[month], *area)).collect()
        };
        Shade { zones, points: points.collect(), added: self.added.iter().map(of_trial).collect() }
    }

    /// The zones in a month, or in the year.
    fn month(&self, month: usize) -> Vec<MonthOfZone> {
        let months = if month < 12 { month..month + 1 } else { 0..12 };
        let days: f64 = self.days[months.clone()].iter().sum();
        let sun = self.sun[months.clone()].iter().sum::<f64>() / days;
        let mut means = vec![Means::default(); self.samples.grids.len()];
        for (sample, point) in self.samples.all.iter().zip(&self.points) {
            let hours = [0, 1].map(|cause| point[months.clone()].iter().map(|month| month[cause]).sum::<f64>() / days);
            means[sample.zone].take(sample.area_m2, sample.is_black, hours, sun);
        }
        let of_moments = self.moments.iter().map(|zone| zone[months.clone()].iter().sum::<f64>().sqrt() / days);
        means.iter().zip(of_moments).map(|(mean, error_h)| mean.told(sun, error_h)).collect()
    }
}

/// Sums over the points of a zone, by their areas.
#[derive(Debug, Clone, Copy, Default)]
struct Means {
    area: f64,
    hours: [f64; 2],
    /// Area and hours of shade of the white and the black cells.
    colours: [[f64; 2]; 2],
    mostly: f64,
}

impl Means {
    /// Takes a point with its hours a day.
    fn take(&mut self, area: f64, is_black: bool, hours: [f64; 2], sun_h: f64) {
        let shade = hours[0] + hours[1];
        self.area += area;
        self.hours.iter_mut().zip(hours).for_each(|(sum, hours)| *sum += area * hours);
        let colour = &mut self.colours[usize::from(is_black)];
        *colour = [colour[0] + area, colour[1] + area * shade];
        // Hours are sums of equal parts, which rounding may leave a little short.
        if sun_h > 0.0 && shade >= MOST_OF_THE_DAY * sun_h - 1e-9 {
            self.mostly += area;
        }
    }

    /// Its means; the moments may be off by `error_h`.
    fn told(&self, sun_h: f64, error_h: f64) -> MonthOfZone {
        let over = |sum: f64, area: f64| if area > 0.0 { sum / area } else { 0.0 };
        let [building_h, plant_h] = self.hours.map(|sum| over(sum, self.area));
        let [white, black] = self.colours.map(|[area, sum]| over(sum, area));
        let mostly_shaded = over(self.mostly, self.area);
        MonthOfZone { sun_h, building_h, plant_h, mostly_shaded, error_h: error_h + (white - black).abs() / 2.0 }
    }
}
