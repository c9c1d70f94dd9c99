//! The rows of `site`: what the date brought to the plots of a treatment and replicate at a recorded tick, and how many
//! of their plants lived.
//!
//! Plots of one treatment and replicate follow one another, so their plants are counted together and their rows are
//! written when the next ones begin, or the part ends. A run of several parts has the rows of each part that has
//! plots of them: the sums of `plots` and `living_plants` are those of the run. Without a calendar the columns of the
//! date are null. Absent: what single plants are (`summary`).

use super::buffers::{NO_DATE, NULL, columns};
use phytomer_sim::site::calendar::{Calendar, CalendarTick};
use phytomer_sim::site::date::Date;
use phytomer_sim::{Plot, Tick};
use std::sync::Arc;

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
    }
}

/// A recorded tick of the plots of a group.
#[derive(Debug, Clone, Copy)]
struct SiteAt {
    tick: Tick,
    of_calendar: Option<CalendarTick>,
    living: u32,
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
            let living = std::mem::take(&mut self.living);
            let Plot { treatment, replicate, block, id: first_plot, .. } = *plot;
            *self = Self { treatment, replicate, block, first_plot, plots: 0, living };
            self.living.resize(recorded.len(), 0);
        }
        self.plots += 1;
        for (plant, member) in plot.plants.iter().zip(&plot.members) {
            for (living, tick) in self.living.iter_mut().zip(recorded).take_while(|(_, tick)| **tick <= last) {
                *living += u32::from(member.age_at(*tick).is_some_and(|age| plant.lives(age)));
            }
        }
    }

    /// The plants that live at each recorded tick; none where the group has no plot.
    pub fn living(&self) -> &[u32] {
        if self.plots == 0 { &[] } else { &self.living }
    }

    /// Forgets the plots, keeping the memory.
    pub fn clear(&mut self) {
        self.plots = 0;
        self.living.clear();
    }
}

impl SiteColumns {
    /// Adds the rows of a group at some of the recorded ticks; beside each tick its living plants.
    /// `calendars` has one for each treatment.
    pub fn add(&mut self, group: &Group, recorded: (&[Tick], &[u32]), calendars: &[Option<Arc<Calendar>>]) {
        let calendar = calendars.get(group.treatment as usize).and_then(Option::as_ref);
        let at = |(tick, living): (&Tick, &u32)| SiteAt {
            tick: *tick,
            of_calendar: calendar.map(|calendar| *calendar.at(*tick)),
            living: *living,
        };
        let rows: Vec<SiteAt> = recorded.0.iter().zip(recorded.1).map(at).collect();
        self.extend(&rows, group);
    }
}
