//! A shard: a fixed range of plots that makes one part file of each table.
//!
//! Its files are written beside their final names and get those names in [`Shard::commit`], which ends with the shard's
//! line in the journal. A shard that is dropped before leaves nothing.

use super::RunFolder;
use super::journal::{FileReport, OvergrownPlot, ShardReport};
use crate::Error;
use crate::storage::durable;
use crate::tables::{
    Columns, ComponentColumns, ComponentRow, EventColumns, Part, PartReport, PlantColumns, Queue, RecordColumns,
    RecordRow, Scene, Standing, SummaryColumns, Table, sort_events, summarise,
};
use phytomer_sim::plant::{Event, Plant};
use phytomer_sim::{Ending, Plot, RecordError, Recorder, Tick};
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

/// The tables of a shard, being filled.
#[derive(Default)]
struct Parts {
    components: Option<Part<ComponentColumns>>,
    records: Option<Part<RecordColumns>>,
    events: Option<Part<EventColumns>>,
    summary: Option<Part<SummaryColumns>>,
    plants: Option<Part<PlantColumns>>,
}

/// A shard being written: a [`Recorder`] for each of its plots in turn.
pub struct Shard<'a> {
    folder: &'a RunFolder,
    parts: Parts,
    staged: Vec<String>,
    standing: Standing,
    numbers: Vec<u32>,
    rows: Vec<RecordRow>,
    lives: Vec<ComponentRow>,
    sorted: Vec<Event>,
    report: ShardReport,
    ended: u32,
    /// Of the plot whose turn it is: already, because its growth ran ahead.
    components_written: bool,
}

impl<'a> Shard<'a> {
    pub(super) fn create(folder: &'a RunFolder, shard: u32) -> Result<Self, Error> {
        let report = ShardReport { shard, files: Vec::new(), living: 0, dead: 0, components: 0, overgrown: Vec::new() };
        let mut new = Self {
            folder,
            parts: Parts::default(),
            staged: Vec::new(),
            standing: Standing::default(),
            numbers: Vec::new(),
            rows: Vec::new(),
            lives: Vec::new(),
            sorted: Vec::new(),
            report,
            ended: 0,
            components_written: false,
        };
        let queue = Arc::new(Queue::default());
        new.parts = Parts {
            components: new.part(Table::Components, &queue)?,
            records: new.part(Table::Records, &queue)?,
            events: new.part(Table::Events, &queue)?,
            summary: new.part(Table::Summary, &queue)?,
            plants: new.part(Table::Plants, &queue)?,
        };
        Ok(new)
    }

    fn part<C: Columns>(&mut self, table: Table, queue: &Arc<Queue>) -> Result<Option<Part<C>>, Error> {
        if !self.folder.plan.tables.contains(&table) {
            return Ok(None);
        }
        let path = self.stage(&part_path(table, self.report.shard))?;
        Part::create(table, &path, &self.folder.plan, (queue, &self.folder.watch)).map(Some)
    }

    /// Registers a further file of this shard, such as a mesh, by its path in the run folder (with `/`). Write it to
    /// the path that this returns; [`Shard::commit`] syncs it, gives it its name and enters it in the journal.
    ///
    /// # Errors
    /// Where its folder cannot be made, or the disk has no room for it.
    pub fn stage(&mut self, path: &str) -> Result<PathBuf, Error> {
        self.look_at_disk()?;
        let full = self.folder.path.join(path);
        if let Some(folder) = full.parent() {
            fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
        }
        self.staged.push(path.to_owned());
        Ok(durable::beside(&full))
    }

    /// Looks at the free space, before something is written that does not look itself.
    ///
    /// # Errors
    /// Where less is free than a run leaves.
    pub fn look_at_disk(&self) -> Result<(), Error> {
        self.folder.watch.look().map_err(Error::io("write more to", &self.folder.path))
    }

    /// The shard's number.
    pub fn number(&self) -> u32 {
        self.report.shard
    }

    /// Writes what is known of a plot at its end: its components, its events and its plants. Comes after its last age,
    /// for each plot of the shard in turn.
    ///
    /// # Errors
    /// [`Error::PlotOutOfTurn`], or a failed write.
    pub fn end_plot(&mut self, plot: &Plot, ending: Ending) -> Result<(), Error> {
        self.check_turn(plot)?;
        let last = match ending {
            Ending::Complete => self.folder.plan.until,
            Ending::Overgrown { age, limit } => {
                let overgrown = OvergrownPlot { plot: plot.id, plant: limit.plant, age, limit: limit.limit };
                self.report.overgrown.push(overgrown);
                age.saturating_sub(1)
            }
        };
        for plant in &plot.plants {
            let lives = plant.lives(last);
            self.report.dead += u64::from(!lives);
            self.report.living += u64::from(lives);
            self.report.components += plant.lived_by(last);
            if !self.components_written {
                self.write_components(plot, plant, last)?;
            }
            self.write_events(plot, plant, last)?;
            if let Some(part) = &mut self.parts.plants {
                part.columns.add(plot, plant);
                part.flush_if_full()?;
            }
        }
        self.standing.forget();
        self.components_written = false;
        self.ended += 1;
        Ok(())
    }

    fn check_turn(&self, plot: &Plot) -> Result<(), Error> {
        let plots = self.folder.plan.plots_of(self.report.shard);
        let expected = plots.start + self.ended;
        if plot.id == expected && plots.contains(&expected) {
            return Ok(());
        }
        Err(Error::PlotOutOfTurn { shard: self.report.shard, plot: plot.id, expected })
    }

    fn write_components(&mut self, plot: &Plot, plant: &Plant, last: Tick) -> Result<(), Error> {
        let Some(part) = &mut self.parts.components else { return Ok(()) };
        self.standing.read(plant)?;
        let mut next = 0;
        while next < self.standing.len() {
            let numbers = self.standing.following(part.room(), &mut next);
            part.columns.fill(plot, (plant, &self.standing), numbers, last, &mut self.lives);
            part.flush_if_full()?;
        }
        Ok(())
    }

    fn write_events(&mut self, plot: &Plot, plant: &Plant, last: Tick) -> Result<(), Error> {
        let Some(part) = &mut self.parts.events else { return Ok(()) };
        sort_events(plant, last, &mut self.sorted);
        let mut left = &self.sorted[..];
        while !left.is_empty() {
            let (events, others) = left.split_at(left.len().min(part.room()));
            part.columns.fill(plot, plant, events);
            part.flush_if_full()?;
            left = others;
        }
        Ok(())
    }

    fn write_age(&mut self, age: Tick, plot: &Plot, plant: &Plant) -> Result<(), Error> {
        self.standing.read(plant)?;
        self.standing.find_tips(plant, age);
        if let Some(part) = &mut self.parts.summary {
            part.columns.add(plot, plant, age, &summarise(plant, &self.standing, age));
            part.flush_if_full()?;
        }
        let Some(part) = &mut self.parts.records else { return Ok(()) };
        let scene = Scene { plant, standing: &self.standing, age, mechanics: self.folder.plan.mechanics };
        let mut next = 0;
        while next < self.standing.len() {
            self.standing.select(age, part.room(), &mut next, &mut self.numbers);
            part.columns.fill(plot.id, &scene, &self.numbers, &mut self.rows);
            part.flush_if_full()?;
        }
        Ok(())
    }

    /// Closes the files, gives them their names and enters the shard in the journal.
    ///
    /// # Errors
    /// [`Error::UnfinishedShard`] where a plot has not ended, or a failed write.
    pub fn commit(mut self) -> Result<ShardReport, Error> {
        let plots = self.folder.plan.plots_of(self.report.shard).len() as u32;
        if self.ended < plots {
            return Err(Error::UnfinishedShard { shard: self.report.shard, ended: self.ended, plots });
        }
        let parts = std::mem::take(&mut self.parts);
        self.close(Table::Components, parts.components)?;
        self.close(Table::Records, parts.records)?;
        self.close(Table::Events, parts.events)?;
        self.close(Table::Summary, parts.summary)?;
        self.close(Table::Plants, parts.plants)?;
        for path in std::mem::take(&mut self.staged) {
            self.name(path)?;
        }
        self.folder.journal().enter(self.report.clone())?;
        Ok(self.report.clone())
    }

    fn close<C: Columns>(&mut self, table: Table, part: Option<Part<C>>) -> Result<(), Error> {
        if let Some(part) = part {
            let PartReport { rows, bytes, sha256 } = part.finish()?;
            let path = part_path(table, self.report.shard);
            self.report.files.push(FileReport { path, table: Some(table), rows: Some(rows), bytes, sha256 });
        }
        Ok(())
    }

    /// Gives a staged file its name; one that is not a table's is synced and hashed first.
    fn name(&mut self, path: String) -> Result<(), Error> {
        let full = self.folder.path.join(&path);
        let staged = durable::beside(&full);
        if !self.report.files.iter().any(|file| file.path == path) {
            let (bytes, sha256) = durable::sync_and_hash(&staged)?;
            self.report.files.push(FileReport { path, table: None, rows: None, bytes, sha256 });
        }
        durable::rename(&staged, &full)
    }
}

impl Recorder for Shard<'_> {
    fn wants(&self, age: Tick) -> bool {
        let wanted = self.parts.records.is_some() || self.parts.summary.is_some();
        wanted && self.folder.plan.recorded.binary_search(&age).is_ok()
    }

    /// The largest table of a plant comes first: other threads encode it while this one makes the first ages ready.
    fn grown(&mut self, until: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.check_turn(plot)?;
        for plant in &plot.plants {
            self.write_components(plot, plant, until)?;
        }
        self.components_written = true;
        Ok(())
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.check_turn(plot)?;
        for plant in &plot.plants {
            self.write_age(age, plot, plant)?;
        }
        Ok(())
    }
}

impl Drop for Shard<'_> {
    fn drop(&mut self) {
        for path in &self.staged {
            // Nothing is lost where this fails: a resumed run removes such files.
            let _ = fs::remove_file(durable::beside(&self.folder.path.join(path)));
        }
    }
}

/// The path of a part file in the run folder.
pub fn part_path(table: Table, shard: u32) -> String {
    format!("{}/part-{shard:05}.parquet", table.name())
}
