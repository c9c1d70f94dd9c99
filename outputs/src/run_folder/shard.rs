//! A shard: a fixed range of plots that makes one part file of each table.
//!
//! Its files are written beside their final names and renamed in [`Shard::commit`], which ends with the shard's line in
//! the journal. A shard that is dropped before that leaves nothing.

use super::RunFolder;
use super::error::Error;
use super::journal::{FileReport, OvergrownPlot, ShardReport};
use crate::storage::durable;
use crate::storage::space::{WaitFor, Watch};
use crate::tables::{Part, PartReport, Queue, Recording, RunPlan, Table, TableError, treatments};
use phytomer_sim::{Ending, Plot, RecordError, Recorder, Tick};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A shard that is being written. It is the [`Recorder`] of each of its plots, one after another.
pub struct Shard<'a> {
    folder: &'a RunFolder,
    /// `None` once the shard is being committed.
    tables: Option<Recording<Part>>,
    staged: Vec<String>,
    report: ShardReport,
    ended: u32,
}

impl<'a> Shard<'a> {
    pub(super) fn create(folder: &'a RunFolder, shard: u32) -> Result<Self, Error> {
        let report = ShardReport { shard, files: Vec::new(), living: 0, dead: 0, components: 0, overgrown: Vec::new() };
        let mut new = Self { folder, tables: None, staged: Vec::new(), report, ended: 0 };
        // The tables of measured plants are put into the shard whole.
        if folder.plan.measured {
            return Ok(new);
        }
        let queue = Arc::new(Queue::default());
        new.tables = Some(Recording::of(&folder.plan, |table| new.part(table, &queue))?);
        Ok(new)
    }

    fn part(&mut self, table: Table, queue: &Arc<Queue>) -> Result<Part, Error> {
        let path = self.stage(&part_path(table, self.report.shard))?;
        Ok(Part::create(table, &path, &self.folder.plan, (queue, &self.folder.watch))?)
    }

    /// Registers a further file of this shard, such as a mesh, by its path in the run folder (with `/`). Returns the
    /// path to write it to; [`Shard::commit`] syncs and renames the file and enters it in the journal.
    ///
    /// # Errors
    /// Where its folder cannot be made, or the disk has less free space than a run leaves.
    pub fn stage(&mut self, path: &str) -> Result<PathBuf, Error> {
        self.look_at_disk()?;
        let full = self.folder.path.join(path);
        if let Some(folder) = full.parent() {
            fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
        }
        self.staged.push(path.to_owned());
        Ok(durable::beside(&full))
    }

    /// Writes a table of measured plants: `write` makes the file at a path.
    ///
    /// # Errors
    /// A failed write.
    pub(crate) fn put(
        &mut self,
        table: Table,
        write: impl FnOnce(&Path, &RunPlan, &Arc<Watch>) -> Result<PartReport, TableError>,
    ) -> Result<(), Error> {
        let path = part_path(table, self.report.shard);
        let staged = self.stage(&path)?;
        let PartReport { rows, bytes, sha256 } = write(&staged, &self.folder.plan, &self.folder.watch)?;
        self.report.files.push(FileReport { path, table: Some(table), rows: Some(rows), bytes, sha256 });
        Ok(())
    }

    /// Ends the plots of measured plants, which are so many and have so many components.
    pub(crate) fn end_measured(&mut self, plants: u64, components: u64) {
        self.ended = self.folder.plan.plots_of(self.report.shard).len() as u32;
        (self.report.living, self.report.components) = (plants, components);
    }

    /// Checks the free space of the disk. Call it before writing files that do not check it themselves.
    ///
    /// # Errors
    /// Where less is free than a run leaves.
    pub fn look_at_disk(&self) -> Result<(), Error> {
        self.folder.watch.check().map_err(Error::io("write more to", &self.folder.path))
    }

    /// The shard's number.
    pub fn number(&self) -> u32 {
        self.report.shard
    }

    /// Writes the components, events and `plants` rows of a plot at its end. Call it after the last tick of each plot,
    /// in the order of the plots.
    ///
    /// # Errors
    /// [`Error::PlotOutOfTurn`], or a failed write.
    pub fn end_plot(&mut self, plot: &Plot, ending: Ending) -> Result<(), Error> {
        self.check_turn(plot)?;
        let Some(tables) = &mut self.tables else { return Ok(()) };
        let last = tables.last_tick(&ending);
        tables.end_plot(plot, last)?;
        if let Ending::Overgrown { age, limit } = ending {
            let overgrown = OvergrownPlot {
                plot: plot.id,
                plant: limit.plant,
                tick: age,
                limit: limit.limit,
                stopped: limit.stopped.as_deref().map(str::to_owned),
            };
            self.report.overgrown.push(overgrown);
        }
        for (plant, member) in plot.plants.iter().zip(&plot.members) {
            let Some(age) = member.age_at(last) else { continue };
            let lives = plant.lives(age);
            self.report.dead += u64::from(!lives);
            self.report.living += u64::from(lives);
            self.report.components += plant.lived_by(age);
        }
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

    /// Closes and renames the files, and enters the shard in the journal.
    ///
    /// # Errors
    /// [`Error::UnfinishedShard`] where a plot has not ended, or a failed write.
    pub fn commit(mut self) -> Result<ShardReport, Error> {
        let plots = self.folder.plan.plots_of(self.report.shard).len() as u32;
        if self.ended < plots {
            return Err(Error::UnfinishedShard { shard: self.report.shard, ended: self.ended, plots });
        }
        let closed = self.tables.take().map(Recording::close).transpose()?;
        for (table, PartReport { rows, bytes, sha256 }) in closed.unwrap_or_default() {
            let path = part_path(table, self.report.shard);
            self.report.files.push(FileReport { path, table: Some(table), rows: Some(rows), bytes, sha256 });
        }
        self.write_treatments()?;
        let folder = self.folder;
        folder.watch.wait(WaitFor::Disk, || {
            std::mem::take(&mut self.staged).into_iter().try_for_each(|path| self.name(path))?;
            folder.journal().enter(self.report.clone())
        })?;
        Ok(self.report.clone())
    }

    /// Writes the table `treatments`, which the first shard has for the whole run.
    fn write_treatments(&mut self) -> Result<(), Error> {
        let plan = &self.folder.plan;
        if self.report.shard > 0 || !plan.tables.contains(&Table::Treatments) {
            return Ok(());
        }
        let path = part_path(Table::Treatments, self.report.shard);
        let staged = self.stage(&path)?;
        let PartReport { rows, bytes, sha256 } = treatments::write(&staged, plan, &self.folder.watch)?;
        self.report.files.push(FileReport { path, table: Some(Table::Treatments), rows: Some(rows), bytes, sha256 });
        Ok(())
    }

    /// Renames a staged file; a file that is no table is synced and hashed first.
    fn name(&mut self, path: String) -> Result<(), Error> {
        let full = self.folder.path.join(&path);
        let staged = durable::beside(&full);
        if !self.report.files.iter().any(|file| file.path == path) {
            let (bytes, sha256) = durable::sync_and_hash(&staged)?;
            self.folder.watch.count(bytes);
            self.report.files.push(FileReport { path, table: None, rows: None, bytes, sha256 });
        }
        Ok(durable::rename(&staged, &full)?)
    }
}

impl Recorder for Shard<'_> {
    fn wants(&self, tick: Tick) -> bool {
        self.tables.as_ref().is_some_and(|tables| tables.wants(tick))
    }

    fn grown(&mut self, until: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.check_turn(plot)?;
        self.tables.iter_mut().try_for_each(|tables| Ok(tables.grown(until, plot)?))
    }

    fn record(&mut self, tick: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.check_turn(plot)?;
        self.tables.iter_mut().try_for_each(|tables| Ok(tables.record(tick, plot)?))
    }
}

impl Drop for Shard<'_> {
    fn drop(&mut self) {
        for path in &self.staged {
            // A failure here is harmless: a resumed run removes such files.
            let _ = fs::remove_file(durable::beside(&self.folder.path.join(path)));
        }
    }
}

/// The path of a part file in the run folder.
pub fn part_path(table: Table, shard: u32) -> String {
    format!("{}/part-{shard:05}.parquet", table.name())
}
