//! The tables of a range of plots, filled from what the loop of growth shows: which rows are written, and when.
//!
//! Files and memory are filled by the same code, so a table in memory has the rows of the Parquet file. The components
//! of a plant are written once, as soon as their lives are known; `records` and `summary` at each recorded age; events
//! and plants when the plot has ended. Absent: where row groups go, which is the [`Sink`]'s.

use super::sink::{Rows, Sink};
use super::{
    ComponentColumns, ComponentIndex, ComponentRow, EventColumns, PlantAtAge, PlantColumns, RecordColumns, RecordRow,
    RunPlan, SummaryColumns, Table, TableError, sort_events, summarise,
};
use phytomer_sim::plant::{Event, Plant};
use phytomer_sim::{Ending, Plot, Tick};

/// The tables that a run asks for.
struct Tables<S> {
    components: Option<Rows<ComponentColumns, S>>,
    records: Option<Rows<RecordColumns, S>>,
    events: Option<Rows<EventColumns, S>>,
    summary: Option<Rows<SummaryColumns, S>>,
    plants: Option<Rows<PlantColumns, S>>,
}

/// Tables being filled, plot after plot.
pub struct Recording<S> {
    tables: Tables<S>,
    recorded: Vec<Tick>,
    until: Tick,
    mechanics: bool,
    /// Whether the components of the present plot are written already, which they are where its growth ran ahead.
    components_written: bool,
    index: ComponentIndex,
    numbers: Vec<u32>,
    rows: Vec<RecordRow>,
    lives: Vec<ComponentRow>,
    sorted: Vec<Event>,
}

impl<S: Sink> Recording<S> {
    /// The tables of a plan, each with the sink that `open` gives.
    ///
    /// # Errors
    /// Those of `open`.
    pub fn of<E>(plan: &RunPlan, mut open: impl FnMut(Table) -> Result<S, E>) -> Result<Self, E> {
        let mut sink = |table| plan.tables.contains(&table).then(|| open(table)).transpose();
        let tables = Tables {
            components: sink(Table::Components)?.map(Rows::to),
            records: sink(Table::Records)?.map(Rows::to),
            events: sink(Table::Events)?.map(Rows::to),
            summary: sink(Table::Summary)?.map(Rows::to),
            plants: sink(Table::Plants)?.map(Rows::to),
        };
        Ok(Self {
            tables,
            recorded: plan.recorded.clone(),
            until: plan.until,
            mechanics: plan.mechanics,
            components_written: false,
            index: ComponentIndex::default(),
            numbers: Vec::new(),
            rows: Vec::new(),
            lives: Vec::new(),
            sorted: Vec::new(),
        })
    }

    /// Whether a table has rows at this age.
    pub fn wants(&self, age: Tick) -> bool {
        let wanted = self.tables.records.is_some() || self.tables.summary.is_some();
        wanted && self.recorded.binary_search(&age).is_ok()
    }

    /// Growth has run ahead to `until`: the components of the plot, the largest table of a plant, are written before
    /// its first age, so that other threads can encode them while this thread makes the ages ready.
    pub fn grown(&mut self, until: Tick, plot: &Plot) -> Result<(), TableError> {
        for plant in &plot.plants {
            self.write_components(plot, plant, until)?;
        }
        self.components_written = true;
        Ok(())
    }

    /// Writes the rows of a plot as it stands at `age`.
    pub fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), TableError> {
        plot.plants.iter().try_for_each(|plant| self.write_age(age, plot, plant))
    }

    /// The last age of which a plot that ended so has rows.
    pub fn last_age(&self, ending: &Ending) -> Tick {
        match ending {
            Ending::Complete => self.until,
            Ending::Overgrown { age, .. } => age.saturating_sub(1),
        }
    }

    /// Writes what is known of a plot at its end, after its age `last`: its components, its events and its plants.
    pub fn end_plot(&mut self, plot: &Plot, last: Tick) -> Result<(), TableError> {
        for plant in &plot.plants {
            if !self.components_written {
                self.write_components(plot, plant, last)?;
            }
            self.write_events(plot, plant, last)?;
            if let Some(table) = &mut self.tables.plants {
                table.columns.add(plot, plant);
                table.flush_if_full()?;
            }
        }
        self.index.forget();
        self.components_written = false;
        Ok(())
    }

    fn write_components(&mut self, plot: &Plot, plant: &Plant, last: Tick) -> Result<(), TableError> {
        let Some(table) = &mut self.tables.components else { return Ok(()) };
        self.index.read(plant)?;
        let mut next = 0;
        while next < self.index.len() {
            let numbers = self.index.following(table.room(), &mut next);
            table.columns.fill(plot, (plant, &self.index), numbers, last, &mut self.lives);
            table.flush_if_full()?;
        }
        Ok(())
    }

    fn write_events(&mut self, plot: &Plot, plant: &Plant, last: Tick) -> Result<(), TableError> {
        let Some(table) = &mut self.tables.events else { return Ok(()) };
        sort_events(plant, last, &mut self.sorted);
        let mut left = &self.sorted[..];
        while !left.is_empty() {
            let (events, others) = left.split_at(left.len().min(table.room()));
            table.columns.fill(plot, plant, events);
            table.flush_if_full()?;
            left = others;
        }
        Ok(())
    }

    fn write_age(&mut self, age: Tick, plot: &Plot, plant: &Plant) -> Result<(), TableError> {
        self.index.read(plant)?;
        self.index.find_tips(plant, age);
        if let Some(table) = &mut self.tables.summary {
            table.columns.add(plot, plant, age, &summarise(plant, &self.index, age));
            table.flush_if_full()?;
        }
        let Some(table) = &mut self.tables.records else { return Ok(()) };
        let shown = PlantAtAge { plot: plot.id, plant, index: &self.index, age, mechanics: self.mechanics };
        let mut next = 0;
        while next < self.index.len() {
            self.index.select(age, table.room(), &mut next, &mut self.numbers);
            table.columns.fill(&shown, &self.numbers, &mut self.rows);
            table.flush_if_full()?;
        }
        Ok(())
    }

    /// Completes the tables, in the order of [`Table::ALL`].
    ///
    /// # Errors
    /// Those of the sinks.
    pub fn close(self) -> Result<Vec<(Table, S::Closed)>, TableError> {
        let Tables { components, records, events, summary, plants } = self.tables;
        let closed = [
            (Table::Components, components.map(Rows::close)),
            (Table::Records, records.map(Rows::close)),
            (Table::Events, events.map(Rows::close)),
            (Table::Summary, summary.map(Rows::close)),
            (Table::Plants, plants.map(Rows::close)),
        ];
        closed.into_iter().filter_map(|(table, closed)| Some(closed?.map(|closed| (table, closed)))).collect()
    }
}
