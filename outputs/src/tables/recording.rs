//! The tables of a range of plots, filled while the plots grow: which rows are written, and when.
//!
//! Files and memory are filled by the same code, so a table in memory has the rows of the Parquet file. The components
//! of a plant are written once, when their fates are known; `records` and `summary` at each recorded tick; `events` and
//! `plants` when the plot has ended, `site` when all plots of a treatment and replicate have. The plants of a plot are
//! written in the order of their numbers, one at a time, so the working memory is that of the largest plant. A plant
//! that is not sown yet has a row in `plants` only, a plant that is not in the sample in `plants` and `summary`.
//! Absent: storing row groups ([`Sink`]).

use super::sink::{Rows, Sink};
use super::site::GroundLight;
use super::{
    ComponentColumns, ComponentIndex, ComponentRow, EventColumns, Group, Membership, OfMember, OfSpecies, PlantAtAge,
    PlantColumns, RecordColumns, RecordRow, RunPlan, Sample, SiteColumns, SortedEvents, Standing, SummaryColumns,
    Table, TableError, by_number, summarise,
};
use phytomer_sim::site::calendars::Calendars;
use phytomer_sim::{Ending, Plot, Tick};

/// The tables of a run, each `None` where the plan does not have it.
struct Tables<S> {
    components: Option<Rows<ComponentColumns, S>>,
    records: Option<Rows<RecordColumns, S>>,
    events: Option<Rows<EventColumns, S>>,
    summary: Option<Rows<SummaryColumns, S>>,
    plants: Option<Rows<PlantColumns, S>>,
    site: Option<Rows<SiteColumns, S>>,
}

/// Tables that are filled plot by plot.
pub struct Recording<S> {
    tables: Tables<S>,
    sample: Option<Sample>,
    recorded: Vec<Tick>,
    until: Tick,
    mechanics: bool,
    /// Whether the columns of light are filled.
    light: bool,
    /// The light of the present plot at the recorded ticks so far, by their places.
    ground_light: Vec<(usize, GroundLight)>,
    /// Whether the components of the present plot are written, as they are early for a plot that was grown ahead.
    components_written: bool,
    index: ComponentIndex,
    numbers: Vec<u32>,
    rows: Vec<RecordRow>,
    lives: Vec<ComponentRow>,
    sorted: SortedEvents,
    calendars: Vec<Calendars>,
    species: OfSpecies,
    members: Vec<Vec<OfMember>>,
    /// The present treatment and replicate.
    group: Group,
}

/// What is stated of the member of this number in a plot.
fn of_member(members: &[Vec<OfMember>], plot: &Plot, number: usize) -> OfMember {
    let stated = members.get(plot.treatment as usize).map(Vec::as_slice).unwrap_or_default();
    let once = stated.first().filter(|_| stated.len() == 1);
    once.or_else(|| stated.get(number)).copied().unwrap_or_default()
}

/// Whether the plant with the index `at` in a plot has rows in `components`, `records` and `events`.
fn has(sample: Option<Sample>, plot: &Plot, at: usize) -> bool {
    sample.is_none_or(|sample| sample.has(plot.plants[at].id))
}

impl<S: Sink> Recording<S> {
    /// Empty tables for a plan; `open` makes the sink of each table.
    ///
    /// # Errors
    /// The errors of `open`.
    pub fn of<E>(plan: &RunPlan, mut open: impl FnMut(Table) -> Result<S, E>) -> Result<Self, E> {
        let mut sink = |table| plan.tables.contains(&table).then(|| open(table)).transpose();
        let tables = Tables {
            components: sink(Table::Components)?.map(Rows::to),
            records: sink(Table::Records)?.map(Rows::to),
            events: sink(Table::Events)?.map(Rows::to),
            summary: sink(Table::Summary)?.map(Rows::to),
            plants: sink(Table::Plants)?.map(Rows::to),
            site: sink(Table::Site)?.map(Rows::to),
        };
        Ok(Self {
            tables,
            sample: plan.sample,
            recorded: plan.recorded.clone(),
            until: plan.until,
            mechanics: plan.mechanics,
            light: plan.light,
            ground_light: Vec::new(),
            components_written: false,
            index: ComponentIndex::default(),
            numbers: Vec::new(),
            rows: Vec::new(),
            lives: Vec::new(),
            sorted: SortedEvents::default(),
            calendars: plan.calendars.clone(),
            species: OfSpecies::of(plan),
            members: plan.members.clone(),
            group: Group::default(),
        })
    }

    /// Whether a table has rows at this tick of a plot.
    pub fn wants(&self, tick: Tick) -> bool {
        let of_light = self.light && self.tables.site.is_some();
        let wanted = self.tables.records.is_some() || self.tables.summary.is_some() || of_light;
        wanted && self.recorded.binary_search(&tick).is_ok()
    }

    /// Called when a plot has been grown ahead to the tick `until`. Its components, the largest table, are written
    /// before its first tick is recorded, so that other threads encode them while this thread prepares the ticks.
    pub fn grown(&mut self, until: Tick, plot: &Plot) -> Result<(), TableError> {
        self.write_components(plot, until)?;
        self.components_written = true;
        Ok(())
    }

    /// Writes the rows of a plot as it stands at `tick`.
    pub fn record(&mut self, tick: Tick, plot: &Plot) -> Result<(), TableError> {
        if let (true, Ok(place)) = (self.light, self.recorded.binary_search(&tick)) {
            let ground = self.mean_ground(plot);
            self.ground_light.push((place, GroundLight::of(plot, tick, ground)));
        }
        let mut plants = by_number(plot).into_iter().enumerate();
        plants.try_for_each(|(number, at)| self.write_age(tick, plot, (number, at)))
    }

    /// The ground of a plant of a plot in the mean, m².
    fn mean_ground(&self, plot: &Plot) -> Option<f64> {
        let count = plot.plants.len();
        let areas = (0..count).map(|number| of_member(&self.members, plot, number).ground_area_m2);
        areas.sum::<Option<f64>>().map(|area| area / count.max(1) as f64)
    }

    /// The last recorded tick of a plot that ended in this way.
    pub fn last_tick(&self, ending: &Ending) -> Tick {
        match ending {
            Ending::Complete => self.until,
            Ending::Overgrown { age, .. } => age.saturating_sub(1),
        }
    }

    /// Writes the components, events and `plants` rows of a plot at its end, up to its tick `last`.
    pub fn end_plot(&mut self, plot: &Plot, last: Tick) -> Result<(), TableError> {
        if !self.components_written {
            self.write_components(plot, last)?;
        }
        self.write_events(plot, last)?;
        self.write_plants(plot)?;
        self.count_site(plot, last)?;
        self.index.forget();
        self.components_written = false;
        Ok(())
    }

    fn write_components(&mut self, plot: &Plot, last: Tick) -> Result<(), TableError> {
        let Some(table) = &mut self.tables.components else { return Ok(()) };
        let chosen = |at: &usize| has(self.sample, plot, *at);
        for at in by_number(plot).into_iter().filter(chosen) {
            let (of, plant) = (Membership::of(plot, at), &plot.plants[at]);
            let Some(last) = of.age_at(last) else { continue };
            let states = self.species.states(of);
            self.index.read(plant)?;
            let mut next = 0;
            while next < self.index.len() {
                let numbers = self.index.following(table.room(), &mut next);
                table.columns.fill(of, (plant, &self.index, states), numbers, last, &mut self.lives);
                table.flush_if_full()?;
            }
        }
        Ok(())
    }

    fn write_events(&mut self, plot: &Plot, last: Tick) -> Result<(), TableError> {
        let Some(table) = &mut self.tables.events else { return Ok(()) };
        self.sorted.sort(plot, last);
        let chosen = |(at, _): &(usize, &[_])| has(self.sample, plot, *at);
        for (at, mut left) in self.sorted.stretches().filter(chosen) {
            while !left.is_empty() {
                let (events, others) = left.split_at(left.len().min(table.room()));
                let of = Membership::of(plot, at);
                table.columns.fill(of, (&plot.plants[at], self.species.states(of)), events);
                table.flush_if_full()?;
                left = others;
            }
        }
        Ok(())
    }

    fn write_plants(&mut self, plot: &Plot) -> Result<(), TableError> {
        let Some(table) = &mut self.tables.plants else { return Ok(()) };
        for (number, at) in by_number(plot).into_iter().enumerate() {
            let of = Membership::of(plot, at);
            let species = self.species.number(of);
            let member = of_member(&self.members, plot, number);
            let standing = Standing { ticks_per_year: self.species.ticks_per_year(of), member };
            let of = Membership { sampled: has(self.sample, plot, at), species, ..of };
            table.columns.add(of, standing, &plot.plants[at]);
            table.flush_if_full()?;
        }
        Ok(())
    }

    /// Counts the plants of a plot among those of its treatment and replicate, and writes the rows of the ones before.
    fn count_site(&mut self, plot: &Plot, last: Tick) -> Result<(), TableError> {
        if self.tables.site.is_none() {
            return Ok(());
        }
        if !self.group.has(plot) {
            self.write_site()?;
        }
        self.group.count(plot, &self.recorded, last);
        if self.light {
            self.group.light_up(self.ground_light.drain(..));
        }
        Ok(())
    }

    fn write_site(&mut self) -> Result<(), TableError> {
        let Some(table) = &mut self.tables.site else { return Ok(()) };
        let mut next = 0;
        while next < self.group.rows() {
            let some = next..(next + table.room()).min(self.group.rows());
            next = some.end;
            table.columns.add(&self.group, (&self.recorded, some), &self.calendars);
            table.flush_if_full()?;
        }
        self.group.clear();
        Ok(())
    }

    /// Writes the rows at a tick of a plant, if it is sown by then: the member of this number, with the index `at` in
    /// the plot.
    fn write_age(&mut self, tick: Tick, plot: &Plot, (number, at): (usize, usize)) -> Result<(), TableError> {
        let (of, plant) = (Membership::of(plot, at), &plot.plants[at]);
        let Some(age) = of.age_at(tick) else { return Ok(()) };
        self.index.read(plant)?;
        self.index.find_tips(plant, age);
        let guard = of_member(&self.members, plot, number).guard;
        if let Some(table) = self.tables.summary.as_mut().filter(|_| !guard) {
            table.columns.add(of, plant, age, &summarise(plant, &self.index, age));
            if self.light {
                table.columns.add_light(plot, (at, tick));
            }
            table.flush_if_full()?;
        }
        let chosen = has(self.sample, plot, at);
        let Some(table) = self.tables.records.as_mut().filter(|_| chosen) else { return Ok(()) };
        let lit = self.light.then(|| plot.site.light.as_ref().and_then(|light| light.found.as_deref()));
        let shown = PlantAtAge { of, plant, index: &self.index, age, mechanics: self.mechanics, lit };
        let mut next = 0;
        while next < self.index.len() {
            self.index.select(age, table.room(), &mut next, &mut self.numbers);
            table.columns.fill(&shown, &self.numbers, &mut self.rows);
            table.flush_if_full()?;
        }
        Ok(())
    }

    /// Completes the tables; returns what each sink closes to, in the order of [`Table::ALL`].
    ///
    /// # Errors
    /// The errors of the sinks.
    pub fn close(mut self) -> Result<Vec<(Table, S::Closed)>, TableError> {
        self.write_site()?;
        let Tables { components, records, events, summary, plants, site } = self.tables;
        let closed = [
            (Table::Components, components.map(Rows::close)),
            (Table::Records, records.map(Rows::close)),
            (Table::Events, events.map(Rows::close)),
            (Table::Summary, summary.map(Rows::close)),
            (Table::Plants, plants.map(Rows::close)),
            (Table::Site, site.map(Rows::close)),
        ];
        closed.into_iter().filter_map(|(table, closed)| Some(closed?.map(|closed| (table, closed)))).collect()
    }
}
