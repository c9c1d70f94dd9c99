//! Reading a scenario and a species with all their ancestors, collecting faults and going on.
//!
//! Each file is held against the schema by itself, so that a fault is told even where a nearer file hides it; then the
//! merged species is held against the complete schema, so that a missing key is told once for the whole chain.
//! Absent: faults of meaning, which `validate` asks the models for.

use phytomer_models::fault::{Path, Segment};
use serde::de::DeserializeOwned;
use serde_json::Value as Json;

use crate::document::{self, Node};
use crate::inherit::merge_chain;
use crate::library::{self, Kind};
use crate::report::Fault;
use crate::schema;
use crate::source::{Origin, Source, SourceId, Sources, Span};
use crate::species::{About, MODELS, ModelName, Species, any_file, split};

/// More ancestors than this are a mistake even where they are no circle.
const MOST_ANCESTORS: usize = 16;

/// What was read so far, and what was wrong with it.
#[derive(Default)]
pub(crate) struct Loader {
    pub sources: Sources,
    pub faults: Vec<Fault>,
}

/// A name in a file, and the file.
#[derive(Clone)]
pub(crate) struct Mention {
    pub name: String,
    /// Where it is named; `None` on the command line.
    pub place: Option<(Span, Path)>,
}

impl Loader {
    /// A file by its name; `None`, with a fault, where there is none.
    pub fn find(&mut self, kind: Kind, mention: &Mention) -> Option<Source> {
        let beside = mention.place.as_ref().map(|(span, _)| self.sources.get(span.source).origin.clone());
        match library::find(kind, &mention.name, beside.as_ref()) {
            Ok(source) => Some(source),
            Err(missing) => {
                let place = mention.place.clone();
                self.faults.push(Fault {
                    span: place.as_ref().map(|(span, _)| *span),
                    path: place.map_or_else(Path::root, |(_, path)| path),
                    problem: missing.problem,
                    expected: missing.expected,
                    suggestion: missing.suggestion,
                });
                None
            }
        }
    }

    /// The tree of a text, which is kept.
    pub fn parse(&mut self, source: Source) -> (SourceId, Option<Node>) {
        let id = self.sources.add(source);
        (id, document::parse(&self.sources, id, &mut self.faults))
    }

    /// A value of a type that the schema stands for, from a tree that the schema has passed.
    pub fn read<T: DeserializeOwned>(&mut self, node: &Node, json: Json) -> Option<T> {
        match serde_path_to_error::deserialize(json) {
            Ok(value) => Some(value),
            Err(error) => {
                self.refused(node, &error);
                None
            }
        }
    }

    fn refused(&mut self, node: &Node, error: &serde_path_to_error::Error<serde_json::Error>) {
        let mut path = Path::root();
        for segment in error.path() {
            match segment {
                serde_path_to_error::Segment::Seq { index } => path = path.index(*index),
                serde_path_to_error::Segment::Map { key } => path = path.key(key),
                _ => break,
            }
        }
        let problem = error.inner().to_string();
        self.faults.push(Fault::new(node.locate(&path), &path, problem, "a value that the schema allows"));
    }

    /// A species, its ancestors merged; `None`, with faults, where that is not possible.
    pub fn species(&mut self, mention: &Mention) -> Option<(Species, Node)> {
        let known = self.faults.len();
        let chain = self.chain(mention)?;
        let model = self.model(&chain)?;
        for node in &chain {
            schema::check(model.file_schema(), node, &mut self.faults);
        }
        let merged = merge_chain(model.schema(), chain)?;
        schema::check(model.schema(), &merged, &mut self.faults);
        if self.faults.len() > known {
            return None;
        }
        let (about, parameters) = split(merged.to_json());
        let about: Option<About> = self.read(&merged, about);
        let model = model.read(parameters).map_err(|error| self.refused(&merged, &error)).ok();
        Some((Species { about: about?, model: model? }, merged))
    }

    /// The files of a species, the eldest ancestor first.
    fn chain(&mut self, mention: &Mention) -> Option<Vec<Node>> {
        let mut chain: Vec<Node> = Vec::new();
        let mut line: Vec<(Origin, String)> = Vec::new();
        let mut next = Some(mention.clone());
        while let Some(mention) = next {
            let source = self.find(Kind::Species, &mention)?;
            let (origin, name) = (identity(&source.origin), source.name.clone());
            if let Some(first) = line.iter().position(|(known, _)| *known == origin) {
                self.circle(&line[first..], &name, &mention);
                return None;
            }
            line.push((origin, name));
            let (_, node) = self.parse(source);
            let node = node?;
            next = node.get("inherits").and_then(|value| {
                let path = Path::root().key("inherits");
                value.text().map(|name| Mention { name: name.to_owned(), place: Some((value.span, path)) })
            });
            chain.push(node);
            if chain.len() > MOST_ANCESTORS {
                self.fault_at(&mention, format!("more than {MOST_ANCESTORS} ancestors"), "fewer ancestors");
                return None;
            }
        }
        chain.reverse();
        Some(chain)
    }

    fn circle(&mut self, circle: &[(Origin, String)], last: &str, mention: &Mention) {
        let names: Vec<&str> = circle.iter().map(|(_, name)| name.as_str()).chain([last]).collect();
        let problem = match circle.len() {
            1 => format!("`{last}` inherits from itself"),
            _ => format!("inheritance runs in a circle: {}", names.join(" → ")),
        };
        self.fault_at(mention, problem, "an ancestor that does not inherit from this species");
    }

    fn fault_at(&mut self, mention: &Mention, problem: String, expected: &str) {
        let (span, path) = mention.place.clone().map_or((None, Path::root()), |(span, path)| (Some(span), path));
        self.faults.push(Fault { span, path, problem, expected: expected.to_owned(), suggestion: None });
    }

    /// The model that the chain names; all its files must agree. Where none is named the files are still checked.
    fn model(&mut self, chain: &[Node]) -> Option<ModelName> {
        let key = Path::root().key("model");
        let mut found: Option<ModelName> = None;
        let mut named = false;
        for value in chain.iter().filter_map(|node| node.get("model")) {
            named = true;
            let Some(model) = value.text().and_then(ModelName::from_word) else { continue };
            if found.is_some_and(|elder| elder != model) {
                let problem = format!("a species of the model `{}` cannot become one of `{}`", word(found), model.word());
                self.faults.push(Fault::new(value.span, &key, problem, "the model of the species that it inherits from"));
                return None;
            }
            found = Some(model);
        }
        if found.is_some() {
            return found;
        }
        let any = any_file();
        chain.iter().for_each(|node| schema::check(&any, node, &mut self.faults));
        if let (false, Some(youngest)) = (named, chain.last()) {
            let words: Vec<String> = MODELS.iter().map(|m| format!("`{}`", m.word())).collect();
            let expected = format!("`model`: one of {}", words.join(", "));
            let fault = Fault::new(youngest.span, &Path::root(), "the key `model` is missing", expected);
            self.faults.push(fault);
        }
        None
    }
}

fn word(model: Option<ModelName>) -> &'static str {
    model.map_or("", ModelName::word)
}

/// The same file by whatever path it is reached.
fn identity(origin: &Origin) -> Origin {
    match origin {
        Origin::File(path) => Origin::File(path.canonicalize().unwrap_or_else(|_| path.clone())),
        preset => preset.clone(),
    }
}

/// The whole number at a path of keys, where there is one.
pub(crate) fn integer_at(node: &Node, keys: &[&str]) -> Option<i64> {
    let mut at = node;
    for key in keys {
        at = at.get(key)?;
    }
    match at.value {
        document::Value::Integer(n) => Some(n),
        _ => None,
    }
}

/// A path from keys.
pub(crate) fn path_of(keys: &[&str]) -> Path {
    Path(keys.iter().map(|key| Segment::Key((*key).to_owned())).collect())
}
