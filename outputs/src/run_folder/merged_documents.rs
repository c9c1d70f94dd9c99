//! The documents of a merged run, made of those of one of its shares.
//!
//! What they say of the whole run is the same in each share and stays as it is, so that merging needs to know neither
//! the scenario nor what tables mean. What they say of the share's own files and plants is said of all. Absent: the
//! journal.

use super::documents::{self, PACKAGE, RunReport, VIEWS};
use super::error::Error;
use super::journal::ShardReport;
use super::share::SHARE;
use crate::storage::durable;
use crate::tables::Table;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The keys of `run.json` that tell of a share alone, or are written anew.
const OF_A_SHARE: [&str; 11] =
    [SHARE, "timings_s", "living", "dead", "components", "rows", "bytes", "files", "overgrown", "documents", "check"];

/// The documents of the whole run, without what is known when all its shards are copied.
pub struct Drafts {
    run: Map<String, Value>,
    package: Value,
    views: Vec<u8>,
}

impl Drafts {
    /// Reads those of a finished share, whose `run.json` is given.
    pub fn of(share: &Path, run: &Value) -> Result<Self, Error> {
        let read = |name: &str| {
            let file = share.join(name);
            fs::read(&file).map_err(Error::io("read", &file))
        };
        let package = serde_json::from_slice(&read(PACKAGE)?).map_err(Error::json(&share.join(PACKAGE)))?;
        let kept = run.as_object().into_iter().flatten().filter(|(key, _)| !OF_A_SHARE.contains(&key.as_str()));
        let run = kept.map(|(key, value)| (key.clone(), value.clone())).collect();
        Ok(Self { run, package, views: read(VIEWS)? })
    }

    /// Writes the documents of the run before its first shard is there; `run.json` comes first, as in every run.
    pub fn write_start(&self, path: &Path) -> Result<(), Error> {
        let mut run = self.run.clone();
        run["status"] = json!("running");
        run.insert("documents".to_owned(), json!([documents::document(VIEWS, &self.views)]));
        documents::write_run(path, run)?;
        Ok(durable::write(&path.join(VIEWS), &self.views)?)
    }

    /// Writes the documents of the finished run, whose journal must be in order.
    pub fn write_end(
        &self,
        path: &Path,
        done: &BTreeMap<u32, ShardReport>,
        timings: &[(&str, f64)],
    ) -> Result<RunReport, Error> {
        let report = RunReport::of(done.values());
        let mut package = self.package.clone();
        for resource in package["resources"].as_array_mut().into_iter().flatten() {
            let Ok(table) = Table::deserialize(&resource["name"]) else { continue };
            let files = report.files.iter().filter(|file| file.table == Some(table));
            resource["path"] = files.map(|file| file.path.as_str()).collect();
            resource["rows"] = json!(report.rows.get(&table).copied().unwrap_or(0));
        }
        documents::write_results(path, self.run.clone(), (&package, &self.views), &report, timings)?;
        Ok(report)
    }
}
