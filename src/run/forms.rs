//! What a species states for meshes by itself, the meshes of the user's that it names as forms and the pictures of its
//! materials: read once for a run, told where they stand when they are none.
//!
//! Where a leaf states no area its mesh does. Their hashes are among the inputs of a run, so that a plant is drawn
//! again with the same triangles and pictures or not at all. Absent: what these files may hold, which is
//! `phytomer_outputs::meshes`'.

use super::RunError;
use phytomer_config::{Covered, Report, Resolved, Species, Uncompiled, path_of_material};
use phytomer_models::fault::{Fault, Path};
use phytomer_outputs::meshes::{MOST_PICTURE_BYTES, OwnForms, Picture, Texture, Textures, check_form};
use phytomer_outputs::{Input, read::Run};
use phytomer_sim::plant::Class;
use sha2::{Digest, Sha256};
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::sync::Arc;

/// A longer file is no organ.
const MOST_BYTES: u64 = 16 << 20;

/// The forms of its own that a species names, its textures and its flare.
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
    let textures = textures_of(species, &mut faults);
    match forms {
        Ok(forms) if faults.is_empty() => Ok(Arc::new(forms.with(textures, species.about.flare))),
        _ => Err(faults),
    }
}

/// The textures that a species states, each picture read once.
fn textures_of(species: &Species, faults: &mut Vec<Fault>) -> Textures {
    let mut known: Vec<(&str, Arc<Picture>)> = Vec::new();
    let mut textures = Textures { species: species.about.name.clone(), list: Vec::new() };
    for (place, material) in species.about.material.iter().enumerate() {
        let mut pictures = Vec::new();
        for (path, name) in material.pictures(&path_of_material(place)) {
            if let Some((_, picture)) = known.iter().find(|(of, _)| *of == name) {
                pictures.push(Arc::clone(picture));
                continue;
            }
            match picture(&path, name) {
                Ok(picture) => {
                    let picture = Arc::new(picture);
                    known.push((name, Arc::clone(&picture)));
                    pictures.push(picture);
                }
                Err(fault) => faults.push(fault),
            }
        }
        let mut pictures = pictures.into_iter();
        let Some(colours) = pictures.next() else { continue };
        let of = match material.of {
            Covered::Bark => Class::Internode,
            Covered::Leaf => Class::Leaf,
            Covered::Flower => Class::Flower,
            Covered::Fruit => Class::Fruit,
        };
        let width_m = material.width_m.as_ref().map(|width| width.value() as f32);
        textures.list.push(Arc::new(Texture { of, order: material.order, colours, normals: pictures.next(), width_m }));
    }
    textures
}

fn picture(path: &Path, name: &str) -> Result<Picture, Fault> {
    let bytes = bytes_of(name, MOST_PICTURE_BYTES).map_err(|error| {
        Fault::new(path, format!("cannot read the picture `{name}`: {error}"), "a PNG or JPEG file of at most 32 MiB")
    })?;
    Picture::read(name, bytes).map_err(|fault| {
        Fault::new(path, format!("in the picture `{name}`, {}: {}", fault.place, fault.problem), fault.expected)
    })
}

fn checked(path: &Path, name: &str) -> Result<Vec<u8>, Fault> {
    let bytes = bytes_of(name, MOST_BYTES).map_err(|error| {
        Fault::new(path, format!("cannot read the mesh `{name}`: {error}"), "a PLY, OBJ or GLB file of at most 16 MiB")
    })?;
    check_form(name, &bytes).map_err(|fault| {
        Fault::new(path, format!("in the mesh `{name}`, {}: {}", fault.place, fault.problem), fault.expected)
    })?;
    Ok(bytes)
}

fn bytes_of(name: &str, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(name)?.take(most + 1).read_to_end(&mut bytes)?;
    let told = || io::Error::other(format!("it is longer than {} MiB", most >> 20));
    if bytes.len() as u64 > most { Err(told()) } else { Ok(bytes) }
}

/// Reads the forms of all species of a scenario, in the order of its species, and states the area share that their
/// meshes have where leaves state none: a run's `run.json` tells it from then on.
///
/// # Errors
/// As [`read`], of the first species that is wrong, as a report.
pub fn settle(resolved: &mut Resolved) -> Result<Vec<Arc<OwnForms>>, Report> {
    settle_all(resolved).map_err(|(species, faults)| resolved.report_of(species, faults))
}

/// The same; the faults with the place of the species that has them.
fn settle_all(resolved: &mut Resolved) -> Result<Vec<Arc<OwnForms>>, Uncompiled> {
    let others = resolved.others.iter_mut().map(|other| &mut other.species);
    let all = [&mut resolved.species].into_iter().chain(others).enumerate();
    let mut states_any = false;
    let settled = all.map(|(place, species)| {
        let forms = read(species).map_err(|faults| (place, faults))?;
        states_any |= state_shares(species, &forms);
        Ok(forms)
    });
    let forms = settled.collect::<Result<_, Uncompiled>>()?;
    if states_any || resolved.is_stale() {
        resolved.compile()?;
    }
    Ok(forms)
}

/// States the area share that its own meshes have where leaves state none; whether there is any, so that the species is
/// to be compiled again.
pub fn state_shares(species: &mut Species, forms: &OwnForms) -> bool {
    species.model.state_area_shares(|place| forms.area_share(place))
}

/// The same for a scenario that was checked before: the scenario as it is grown, and the forms of its species. Where
/// its seed has changed since, and the site depends on it, its models are compiled for the new one.
///
/// # Errors
/// The first of its faults.
pub fn settled(resolved: &Resolved) -> Result<(Cow<'_, Resolved>, Vec<Arc<OwnForms>>), RunError> {
    let species = resolved.all_species();
    let forms = species.iter().map(|species| of(species)).collect::<Result<Vec<_>, _>>()?;
    let states = |(species, forms): (&&Species, &Arc<OwnForms>)| state_shares(&mut (*species).clone(), forms);
    let states_any = species.iter().zip(&forms).map(states).fold(false, |any, states| any | states);
    if !states_any && !resolved.is_stale() {
        return Ok((Cow::Borrowed(resolved), forms));
    }
    let mut settled = resolved.clone();
    let forms = settle_all(&mut settled).map_err(|(_, faults)| RunError::of_species(faults))?;
    Ok((Cow::Owned(settled), forms))
}

/// The forms of a species that was checked before.
///
/// # Errors
/// The first of its faults.
pub fn of(species: &Species) -> Result<Arc<OwnForms>, RunError> {
    read(species).map_err(RunError::of_species)
}

/// A file that a species names.
struct Named<'s> {
    what: &'static str,
    name: &'s str,
    most: u64,
}

/// The files that a species names, each once.
fn named(species: &Species) -> Vec<Named<'_>> {
    let meshes = species.model.own_forms().into_iter().map(|(_, name)| Named { what: "mesh", name, most: MOST_BYTES });
    let materials = species.about.material.iter().enumerate();
    let pictures = materials.flat_map(|(place, material)| material.pictures(&path_of_material(place)));
    let pictures = pictures.map(|(_, name)| Named { what: "picture", name, most: MOST_PICTURE_BYTES });
    let mut files: Vec<Named<'_>> = Vec::new();
    for file in meshes.chain(pictures) {
        if !files.iter().any(|known| known.name == file.name) {
            files.push(file);
        }
    }
    files
}

/// The files as inputs of a run.
///
/// # Errors
/// Where one cannot be read.
pub fn inputs(species: &Species) -> Result<Vec<Input>, RunError> {
    named(species).iter().map(input).collect()
}

fn input(&Named { what, name, most }: &Named) -> Result<Input, RunError> {
    let bytes = bytes_of(name, most).map_err(|source| RunError::Form { what, name: name.to_owned(), source })?;
    let sha256 = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(Input { path: name.to_owned(), sha256 })
}

/// The forms with which a run was made.
///
/// # Errors
/// Where a file is gone or has changed since.
pub fn of_run(species: &Species, run: &Run) -> Result<Arc<OwnForms>, RunError> {
    let recorded = run.json()["inputs"].as_array().map(Vec::as_slice).unwrap_or_default();
    for file in named(species) {
        let input = input(&file)?;
        let same = recorded.iter().any(|known| known["path"] == input.path && known["sha256"] == input.sha256);
        if !same {
            return Err(RunError::FormChanged { what: file.what, name: input.path });
        }
    }
    of(species)
}
