//! Finding files by name: a user's file by its path, a shipped preset by its name.
//!
//! A name that ends in `.toml` is a file. A name with a separator is a file where there is one, else a preset
//! (`gmt1/5a`). A bare name is looked up first in the folder of the file that states it, then among the presets; on the
//! command line a bare name is a preset. Presets, and the weather files of shipped scenarios, are compiled into the
//! program, so that an installed binary needs no data folder. A library of texts in memory reads no file: names then
//! lead to these texts and to presets ([`Library::Memory`]).

use std::fs::File;
use std::io::{self, Read};
use std::path::{Component, Path as FilePath, PathBuf};
use std::sync::Arc;

use crate::source::{Origin, Source, folder_of, stays_inside};
use phytomer_models::law::spelling::nearest;
use phytomer_models::lsystem::is_map;

include!(concat!(env!("OUT_DIR"), "/presets.rs"));

/// The largest size of a parameter file; a longer file is refused, so that it does not fill the memory.
const MAX_BYTES: u64 = 4 << 20;
/// How many files of a folder are looked at for the nearest spelling of a name.
const LOOKED_AT: usize = 1000;
/// How many files of a folder are looked at for the only one with an ending.
const MOST_ENTRIES: usize = 100_000;
/// The largest size of a weather file: a century of days is 2 MB.
const MAX_WEATHER_BYTES: u64 = 64 << 20;

/// The two kinds of parameter file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A species with its parameters.
    Species,
    /// A scenario: one run.
    Scenario,
}

impl Kind {
    /// The kind as messages and the command line write it.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Species => "species",
            Kind::Scenario => "scenario",
        }
    }
}

/// The shipped presets of a kind as pairs of name and text, sorted by path.
pub fn presets(kind: Kind) -> &'static [(&'static str, &'static str)] {
    match kind {
        Kind::Species => SPECIES,
        Kind::Scenario => SCENARIOS,
    }
}

/// Why no text was found under a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotFound {
    /// What is wrong, in words.
    pub problem: String,
    /// What was expected, in words.
    pub expected: String,
    /// The preset nearest in spelling.
    pub suggestion: Option<String>,
}

/// Where names are looked up.
#[derive(Debug, Clone, Default)]
pub enum Library {
    /// Among files and presets.
    #[default]
    Disk,
    /// Among these texts, by their names, and among presets.
    Memory(Vec<Source>),
}

impl Library {
    /// Texts in memory, by their names.
    pub fn of_texts(texts: &[(&str, &str)]) -> Self {
        let source = |(name, text): &(&str, &str)| {
            let name = (*name).to_owned();
            Source { origin: Origin::Memory(name.clone()), name, text: (*text).into(), bytes: None }
        };
        Self::Memory(texts.iter().map(source).collect())
    }

    /// Finds the text with the name `name`. `beside` is the origin of the text that states the name, `None` on the
    /// command line. A name in a preset is always that of a preset.
    pub fn find(&self, kind: Kind, name: &str, beside: Option<&Origin>) -> Result<Source, NotFound> {
        let Self::Memory(texts) = self else { return find(kind, name, beside) };
        let own = texts.iter().filter(|_| !matches!(beside, Some(Origin::Preset(_))));
        let own: Vec<&Source> = own.collect();
        let found = own.iter().find(|text| text.name == name).map(|text| (*text).clone());
        found.or_else(|| preset(kind, name)).ok_or_else(|| {
            let near = nearest(name, own.iter().map(|text| text.name.as_str())).map(str::to_owned);
            let unknown = unknown(kind, name);
            NotFound {
                expected: format!("the name of a text in memory, or of a shipped {}", kind.word()),
                suggestion: near.or(unknown.suggestion.clone()),
                ..unknown
            }
        })
    }
}

impl Library {
    /// The weather file with a name, as seen from the text that states it: beside a file, among the texts in memory, or
    /// among the weather that ships, for a preset.
    pub fn weather(&self, name: &str, beside: &Origin) -> Result<Source, NotFound> {
        match (self, beside) {
            (_, Origin::Preset(_)) => shipped_weather(name),
            (Self::Memory(texts), _) => {
                let found = texts.iter().find(|text| text.name == name).cloned();
                found.ok_or_else(|| NotFound {
                    problem: format!("there is no weather file `{name}` among the texts"),
                    expected: "the name of a text in memory".to_owned(),
                    suggestion: nearest(name, texts.iter().map(|text| text.name.as_str())).map(str::to_owned),
                })
            }
            (Self::Disk, Origin::File(file)) => {
                let path = file.parent().map_or_else(|| PathBuf::from(name), |folder| folder.join(name));
                read_weather(&path).map_err(|error| NotFound {
                    problem: format!("cannot read the weather file `{}`: {}", shown(&path), reason(&error)),
                    expected: "a readable weather file, by its path from this file's folder".to_owned(),
                    suggestion: None,
                })
            }
            (Self::Disk, Origin::Memory(_)) => shipped_weather(name),
        }
    }
}

impl Library {
    /// A file in the folder of the text that names it: beside a file and not outside its folder, among the texts in
    /// memory, or among the files that ship beside a preset. The bytes of what is no UTF-8 text come with it.
    pub fn beside(&self, name: &str, beside: &Origin) -> Result<Source, NotFound> {
        let missing = |problem: String| NotFound {
            problem,
            expected: "a file in the folder of the species".to_owned(),
            suggestion: nearest(name, self.names_beside(beside).iter().map(String::as_str)).map(str::to_owned),
        };
        if !stays_inside(name) {
            return Err(missing(format!("the file `{name}` may lie outside the folder")));
        }
        match (self, beside) {
            (Self::Memory(texts), Origin::Memory(_)) => {
                let found = texts.iter().find(|text| text.name == name).cloned();
                found.ok_or_else(|| missing(format!("there is no file `{name}` among the texts")))
            }
            (_, Origin::File(file)) => {
                let folder = file.parent().unwrap_or(FilePath::new(""));
                read_beside(folder, name)
                    .map_err(|error| missing(format!("cannot read the file `{name}`: {}", reason(&error))))
            }
            _ => {
                let own = format!("{}/{name}", folder_of(beside));
                let found =
                    TEXTS.iter().find(|(known, _)| known.trim_start_matches('/') == own.trim_start_matches('/'));
                let (known, text) = found.ok_or_else(|| missing(format!("there is no file `{name}`")))?;
                let origin = Origin::Preset((*known).to_owned());
                Ok(Source { name: format!("preset:{known}"), origin, text: (*text).into(), bytes: None })
            }
        }
    }

    /// The file beside a text that has one of the endings: of the names of the stem with each ending the first that is
    /// there, else the only file with such an ending. `None` where there are several, and in a folder of very many
    /// files, of which it cannot be known. Only regular files count.
    pub fn with_ending(&self, beside: &Origin, stem: &str, endings: &[&str]) -> Option<String> {
        let own = endings.iter().map(|ending| format!("{stem}{ending}"));
        let has_ending = |name: &str| endings.iter().any(|ending| name.ends_with(ending));
        let Origin::File(file) = beside else {
            let mut names = self.names_beside(beside);
            names.retain(|name| has_ending(name));
            let same = own.into_iter().find(|own| names.contains(own));
            return same.or_else(|| if let [only] = &names[..] { Some(only.clone()) } else { None });
        };
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(FilePath::new("."));
        if let Some(same) = own.into_iter().find(|own| folder.join(own).is_file()) {
            return Some(same);
        }
        let (mut seen, mut found) = (0, Vec::new());
        for entry in std::fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok) {
            seen += 1;
            let name = entry.file_name().into_string().ok().filter(|name| has_ending(name));
            found.extend(name.filter(|_| entry.path().is_file()));
            if seen > MOST_ENTRIES || found.len() > 1 {
                return None;
            }
        }
        found.pop()
    }

    /// The names of the files in the folder of a text, as far as [`Library::beside`] finds them; of a folder of very
    /// many files the first that the system names.
    pub fn names_beside(&self, beside: &Origin) -> Vec<String> {
        match (self, beside) {
            (Self::Memory(texts), Origin::Memory(_)) => texts.iter().map(|text| text.name.clone()).collect(),
            (_, Origin::File(file)) => {
                let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
                let entries = std::fs::read_dir(folder.unwrap_or(FilePath::new("."))).into_iter().flatten();
                let entries = entries.take(LOOKED_AT).filter_map(Result::ok);
                entries.filter_map(|entry| entry.file_name().into_string().ok()).collect()
            }
            _ => {
                let folder = folder_of(beside);
                let own = TEXTS.iter().filter_map(|(known, _)| known.rsplit_once('/').or(Some(("", known))));
                own.filter(|(known, _)| *known == folder).map(|(_, name)| name.to_owned()).collect()
            }
        }
    }
}

/// Reads a file in a folder; a link that leads out of it is refused.
fn read_beside(folder: &FilePath, name: &str) -> io::Result<Source> {
    let folder = if folder.as_os_str().is_empty() { FilePath::new(".") } else { folder };
    let path = folder.join(name);
    if !path.canonicalize()?.starts_with(folder.canonicalize()?) {
        return Err(io::Error::other("it lies outside the folder"));
    }
    check_regular(&path)?;
    let bytes = read_bytes(&path, MAX_BYTES)?;
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let differs = text.as_bytes() != bytes.as_slice() || is_map(name);
    let (text, shown) = (Arc::from(text), shown(&path));
    Ok(Source { name: shown, origin: Origin::File(path), text, bytes: differs.then(|| Arc::from(bytes)) })
}

/// An L-system that is named itself, as a species: the file, and nothing stated of it.
fn alone(path: &FilePath) -> io::Result<Source> {
    check_regular(path)?;
    let bytes = read_bytes(path, MAX_BYTES)?;
    let file = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let stem = file.strip_suffix(".l").unwrap_or(file);
    let name: String = stem.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    // A string of JSON is a string of TOML, whatever characters it has.
    let quoted = |text: &str| serde_json::Value::from(text).to_string();
    let name = quoted(if name.is_empty() { "lsystem" } else { &name });
    let text = format!("name = {name}\nmodel = \"lsystem\"\ntick = \"a step\"\nfile = {}\n", quoted(file));
    Ok(Source {
        name: shown(path),
        origin: Origin::File(path.to_owned()),
        text: text.into(),
        bytes: Some(bytes.into()),
    })
}

/// What is no regular file, such as a pipe, may never end.
fn check_regular(path: &FilePath) -> io::Result<()> {
    let kind = std::fs::metadata(path)?;
    if kind.is_file() || kind.is_dir() { Ok(()) } else { Err(io::Error::other("it is no regular file")) }
}

/// Whether a name is that of the file of an L-system.
pub(crate) fn is_lsystem(name: &str) -> bool {
    name.ends_with(".l")
}

/// A weather file that ships, by its name.
fn shipped_weather(name: &str) -> Result<Source, NotFound> {
    let found = WEATHER.iter().find(|(known, _)| *known == name);
    let (name, text) = found.ok_or_else(|| NotFound {
        problem: format!("there is no weather file `{name}`"),
        expected: "a weather file that ships".to_owned(),
        suggestion: nearest(name, WEATHER.iter().map(|(known, _)| *known)).map(str::to_owned),
    })?;
    let origin = Origin::Preset((*name).to_owned());
    Ok(Source { name: format!("preset:{name}"), origin, text: (*text).into(), bytes: None })
}

fn read_weather(path: &FilePath) -> io::Result<Source> {
    let bytes = read_bytes(path, MAX_WEATHER_BYTES)?;
    let text = phytomer_weather::decode(&bytes);
    let differs = text.as_bytes() != bytes.as_slice();
    let (text, name) = (Arc::from(text), shown(path));
    Ok(Source { name, origin: Origin::File(path.to_owned()), text, bytes: differs.then(|| Arc::from(bytes)) })
}

/// Finds a file or a preset by its name. `beside` is the file that states the name, `None` on the command line.
pub fn find(kind: Kind, name: &str, beside: Option<&Origin>) -> Result<Source, NotFound> {
    let folder = match beside {
        Some(Origin::File(path)) => path.parent(),
        _ => None,
    };
    let as_path = name.ends_with(".toml") || name.contains(['/', '\\']);
    // A preset names presets only; files are named by users only.
    if !matches!(beside, Some(Origin::Preset(_))) && !name.is_empty() {
        let path = folder.map_or_else(|| PathBuf::from(name), |folder| folder.join(name));
        let with_end = PathBuf::from(format!("{}.toml", path.display()));
        let may_be_file = as_path || folder.is_some();
        if is_lsystem(name) && matches!(kind, Kind::Species) {
            return alone(&path).map_err(|error| unreadable(kind, name, &path, &error));
        }
        if name.ends_with(".toml") || (as_path && path.is_file()) {
            return read(&path).map_err(|error| unreadable(kind, name, &path, &error));
        }
        if may_be_file && with_end.is_file() {
            return read(&with_end).map_err(|error| unreadable(kind, name, &with_end, &error));
        }
    }
    preset(kind, name).ok_or_else(|| unknown(kind, name))
}

/// A shipped preset by its name.
pub fn preset(kind: Kind, name: &str) -> Option<Source> {
    let (name, text) = presets(kind).iter().find(|(preset, _)| *preset == name)?;
    let origin = Origin::Preset((*name).to_owned());
    Some(Source { name: format!("preset:{name}"), origin, text: (*text).into(), bytes: None })
}

fn read_bytes(path: &FilePath, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::Error::other(format!("it is longer than {} MiB", most >> 20)));
    }
    Ok(bytes)
}

fn read(path: &FilePath) -> io::Result<Source> {
    let bytes = read_bytes(path, MAX_BYTES)?;
    let text = String::from_utf8(bytes)
        .map_err(|e| io::Error::other(format!("byte {} is not UTF-8 text", e.utf8_error().valid_up_to() + 1)))?;
    Ok(Source { name: shown(path), origin: Origin::File(path.to_owned()), text: text.into(), bytes: None })
}

/// The path in short: without `.`, and without pairs of a folder and `..`.
pub(crate) fn shown(path: &FilePath) -> String {
    let mut parts = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(parts.components().next_back(), Some(Component::Normal(_))) => {
                _ = parts.pop()
            }
            other => parts.push(other),
        }
    }
    parts.display().to_string()
}

fn unreadable(kind: Kind, name: &str, path: &FilePath, error: &io::Error) -> NotFound {
    let reason = reason(error);
    NotFound {
        problem: format!("cannot read the {} file `{}`: {reason}", kind.word(), shown(path)),
        expected: format!("a readable {} file, or the name of a shipped {}", kind.word(), kind.word()),
        suggestion: near_file(name, path).or_else(|| near_preset(kind, name.trim_end_matches(".toml"))),
    }
}

fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "it may not be read".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder".to_owned(),
        _ => error.to_string(),
    }
}

fn unknown(kind: Kind, name: &str) -> NotFound {
    NotFound {
        problem: format!("there is no {} `{name}`", kind.word()),
        expected: format!("a shipped {} (`phytomer list` has them) or the path of a file", kind.word()),
        // A species may stand in the place of a scenario: it is then grown by itself.
        suggestion: near_preset(kind, name).or_else(|| near_preset(Kind::Species, name)),
    }
}

/// The TOML file of the same folder that is nearest in spelling, written as `name` is.
fn near_file(name: &str, path: &FilePath) -> Option<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(FilePath::new("."));
    let entries = std::fs::read_dir(folder).ok()?.take(LOOKED_AT).filter_map(Result::ok);
    let mut stems: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    stems.retain_mut(|file| file.strip_suffix(".toml").map(str::to_owned).map(|stem| *file = stem).is_some());
    let typed = path.file_name()?.to_str()?;
    let near = nearest(typed.trim_end_matches(".toml"), stems.iter().map(String::as_str))?;
    Some(format!("{}{near}.toml", name.strip_suffix(typed).unwrap_or_default()))
}

/// The preset nearest in spelling. A preset in a folder is also found without the folder's name (`massart`).
fn near_preset(kind: Kind, name: &str) -> Option<String> {
    let names = || presets(kind).iter().map(|(preset, _)| *preset);
    let without_folder = |preset: &str| preset.rsplit('/').next().is_some_and(|own| own.eq_ignore_ascii_case(name));
    names().find(|preset| without_folder(preset)).or_else(|| nearest(name, names())).map(str::to_owned)
}
