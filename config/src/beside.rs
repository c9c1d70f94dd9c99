//! The files of a species whose model has texts of its own: an L-system, and what lies beside it in the folder of the
//! species file.
//!
//! Each file becomes an entry of the table `texts`, in which a fault is shown at its line and column. Read are the file
//! that the species names, what it includes, its view file, the surfaces, contours and functions that the view file
//! names, and a map of colours. Nothing outside the folder is read. Absent: what the texts mean
//! (`phytomer_models::lsystem`).

use crate::document::{Entry, Node, Value};
use crate::library::Library;
use crate::report::Fault;
use crate::source::{Sources, Span};
use phytomer_models::fault::Path;
use phytomer_models::lsystem::is_map;
use phytomer_models::lsystem::view::View;
use phytomer_models::parameters::Keys;

/// The most files of a species.
const MOST_FILES: usize = 256;

/// The most bytes of all files of a species.
const MOST_BYTES: usize = 1 << 24;

/// The key of the table of texts.
const TEXTS: &str = "texts";

/// Reads the files of a species into its table `texts`, and states the names of the view file and of the map of colours
/// where they are found.
pub(crate) fn fill(species: &mut Node, keys: &Keys, library: &Library, sources: &mut Sources, faults: &mut Vec<Fault>) {
    let Some(key) = keys.texts else { return };
    let Some((name, span)) = species.get(key).and_then(|file| Some((file.text()?.to_owned(), file.span))) else {
        return;
    };
    let mut files = Files { species, library, sources, faults, span, path: Path::root().key(key), count: 0, bytes: 0 };
    files.add(&name);
    // No turtle draws a D0L-system, so what lies beside it is not of it.
    if files.species.get("syntax").and_then(Node::text) == Some("d0l") {
        return;
    }
    let view = files.stated_or_found("view", &name, &[".v"]);
    view.iter().for_each(|view| files.add(view));
    let colours = files.stated_or_found("colours", &name, &[".map", ".mat"]);
    colours.iter().for_each(|colours| files.add(colours));
    let named = view.and_then(|view| files.text(&view)).map(|view| View::read(&view).unwrap_or_default());
    let named = named.unwrap_or_default();
    let surfaces = named.surfaces.iter().map(|surface| &surface.file);
    let contours = named.contours.iter().map(|(_, file)| file);
    let all = surfaces.chain(contours).chain(&named.functions).chain(&named.function_set);
    all.for_each(|file| files.add(file));
}

/// The files of a species while they are read.
struct Files<'f> {
    species: &'f mut Node,
    library: &'f Library,
    sources: &'f mut Sources,
    faults: &'f mut Vec<Fault>,
    /// Where the species names its file.
    span: Span,
    path: Path,
    /// How many files were read.
    count: usize,
    /// How many bytes they have.
    bytes: usize,
}

impl Files<'_> {
    /// The text of a file that was read, or that the species states.
    fn text(&self, name: &str) -> Option<String> {
        self.species.get(TEXTS).and_then(|texts| texts.get(name)).and_then(Node::text).map(str::to_owned)
    }

    /// Whether a file was read, or its text is stated.
    fn is_there(&self, name: &str) -> bool {
        self.species.get(TEXTS).and_then(|texts| texts.get(name)).is_some()
    }

    /// Adds a file, and what it includes.
    fn add(&mut self, name: &str) {
        let (mut waiting, mut is_named) = (vec![name.to_owned()], true);
        while let Some(name) = waiting.pop() {
            if self.count > MOST_FILES || self.bytes > MOST_BYTES || !self.read(&name, is_named) {
                is_named = false;
                continue;
            }
            self.count += 1;
            if self.count > MOST_FILES || self.bytes > MOST_BYTES {
                let problem =
                    format!("this L-system has more than {MOST_FILES} files, or {} MiB of them", MOST_BYTES >> 20);
                return self.faults.push(Fault::new(self.span, &self.path, problem, "fewer files, or smaller ones"));
            }
            let text = self.text(&name).unwrap_or_default();
            waiting.extend(included(&text).map(str::to_owned));
            is_named = false;
        }
    }

    /// Reads a file into the table; false where it stands there already, or cannot be read. It is a fault if a file
    /// cannot be read that the species or a view file names. An `#include` may stand in a comment or under a condition
    /// that does not hold: where it does not, the language tells what is missing, at its line.
    fn read(&mut self, name: &str, is_named: bool) -> bool {
        if name.is_empty() || self.is_there(name) {
            return false;
        }
        let beside = self.sources.get(self.span.source).origin.clone();
        let source = match self.library.beside(name, &beside) {
            Ok(source) => source,
            Err(_) if !is_named => return false,
            Err(missing) => {
                let fault = Fault::new(self.span, &self.path, missing.problem, missing.expected);
                self.faults.push(fault.suggest(missing.suggestion));
                return false;
            }
        };
        let text = match &source.bytes {
            Some(bytes) if is_map(name) => phytomer_models::lsystem::digits_of(bytes),
            _ => source.text.to_string(),
        };
        let end = source.text.len();
        self.bytes += end.max(text.len());
        let id = self.sources.add(source);
        let span = Span { source: id, start: 0, end };
        let node = Node { span, value: Value::Text(text) };
        self.put(Some(TEXTS), Entry { key: name.to_owned(), key_span: self.span, node });
        true
    }

    /// The name that the species states under a key; else the file of an ending that has the name of the L-system, or
    /// that is alone in the folder, which is then stated.
    fn stated_or_found(&mut self, key: &str, file: &str, endings: &[&str]) -> Option<String> {
        if let Some(stated) = self.species.get(key) {
            return stated.text().map(str::to_owned);
        }
        let beside = self.sources.get(self.span.source).origin.clone();
        let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        let found = self.stated_text(stem, endings).or_else(|| self.library.with_ending(&beside, stem, endings))?;
        let node = Node { span: self.span, value: Value::Text(found.clone()) };
        self.put(None, Entry { key: key.to_owned(), key_span: self.span, node });
        Some(found)
    }

    /// Of the texts that the species states that of an ending, found as a file is.
    fn stated_text(&self, stem: &str, endings: &[&str]) -> Option<String> {
        let texts = self.species.get(TEXTS).map(Node::entries).unwrap_or_default();
        let names = texts.iter().map(|entry| &entry.key);
        let names: Vec<&String> = names.filter(|name| endings.iter().any(|ending| name.ends_with(ending))).collect();
        let is_own = |name: &&&String| endings.iter().any(|ending| ***name == format!("{stem}{ending}"));
        let only = if let [only] = &names[..] { Some(only) } else { None };
        names.iter().find(is_own).or(only).map(|name| (*name).clone())
    }

    /// Adds an entry to the species, or to a table of it.
    fn put(&mut self, table: Option<&str>, entry: Entry) {
        let span = self.span;
        let Value::Table(entries) = &mut self.species.value else { return };
        let Some(table) = table else { return entries.push(entry) };
        if !entries.iter().any(|known| known.key == table) {
            let node = Node { span, value: Value::Table(Vec::new()) };
            entries.push(Entry { key: table.to_owned(), key_span: span, node });
        }
        let own = entries.iter_mut().find(|known| known.key == table);
        if let Some(Value::Table(inner)) = own.map(|known| &mut known.node.value) {
            inner.push(entry);
        }
    }
}

/// The names that a text includes: `#include "name"` at the beginning of a line.
fn included(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("include")?.trim();
        rest.strip_prefix('"')?.split('"').next()
    })
}
