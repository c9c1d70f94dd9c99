//! The meshes of the user's that a species names as forms: read once for a run, told where they stand when they are none.
//!
//! Their hashes are among the inputs of a run, so that a plant is drawn again with the same triangles or not at all.
//! Absent: what a mesh file may hold, which is `phytomer_outputs::meshes`'.

use anyhow::{Context, Result, ensure};
use phytomer_config::Species;
use phytomer_models::fault::{Fault, Path};
use phytomer_outputs::meshes::{OwnForms, check_form};
use phytomer_outputs::{Input, read::Run};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, Read};
use std::sync::Arc;

/// A longer file is no organ.
const MOST_BYTES: u64 = 16 << 20;

/// The forms of its own that a species names.
///
/// # Errors
/// What is wrong with each of its files, at the place of its mention.
pub fn read(species: &Species) -> Result<Arc<OwnForms>, Vec<Fault>> {
    let mut faults = Vec::new();
    let mut files = Vec::new();
    for (path, name) in species.model.own_forms() {
        match checked(&path, name) {
            Ok(bytes) => files.push((name, bytes)),
            Err(fault) => faults.push(fault),
        }
    }
    let forms = OwnForms::read(files.iter().map(|(name, bytes)| (*name, bytes.as_slice())));
    match forms {
        Ok(forms) if faults.is_empty() => Ok(Arc::new(forms)),
        _ => Err(faults),
    }
}

fn checked(path: &Path, name: &str) -> Result<Vec<u8>, Fault> {
    let bytes = bytes_of(name).map_err(|error| {
        Fault::new(path, format!("cannot read the mesh `{name}`: {error}"), "a PLY, OBJ or GLB file of at most 16 MiB")
    })?;
    check_form(name, &bytes).map_err(|fault| {
        Fault::new(path, format!("in the mesh `{name}`, {}: {}", fault.place, fault.problem), fault.expected)
    })?;
    Ok(bytes)
}

fn bytes_of(name: &str) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(name)?.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES { Err(io::Error::other("it is longer than 16 MiB")) } else { Ok(bytes) }
}

/// The same for a species that was checked before.
///
/// # Errors
/// The first of its faults.
pub fn of(species: &Species) -> Result<Arc<OwnForms>> {
    read(species).map_err(|faults| match faults.into_iter().next() {
        Some(fault) => anyhow::Error::new(fault),
        None => anyhow::anyhow!("the meshes of the species cannot be read"),
    })
}

/// The files as inputs of a run.
///
/// # Errors
/// Where one cannot be read.
pub fn inputs(species: &Species) -> Result<Vec<Input>> {
    let input = |(_, name): (Path, &str)| {
        let bytes = bytes_of(name).with_context(|| format!("cannot read the mesh {name}"))?;
        let sha256 = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Input { path: name.to_owned(), sha256 })
    };
    species.model.own_forms().into_iter().map(input).collect()
}

/// The forms with which a run was made.
///
/// # Errors
/// Where a file is gone or has changed since.
pub fn of_run(species: &Species, run: &Run) -> Result<Arc<OwnForms>> {
    let recorded = run.json()["inputs"].as_array().map(Vec::as_slice).unwrap_or_default();
    for input in inputs(species)? {
        let same = recorded.iter().any(|known| known["path"] == input.path && known["sha256"] == input.sha256);
        ensure!(same, "the mesh {} is not the one with which the run was made", input.path);
    }
    of(species)
}
