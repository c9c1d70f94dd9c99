//! Reads a scenario and species with all their ancestors, and collects faults instead of stopping at the first.
//!
//! Each file is checked against the schema by itself, so that a fault is reported even where a nearer file hides the
//! value; then the merged species is checked against the complete schema, so that a missing key is reported once for
//! the whole chain. Absent: faults of meaning, which the models find (`validate`).

use phytomer_law::fault::{Path, Segment};
use phytomer_models::parameters::Keys;
use serde_json::Value as Json;

use crate::about::About;
use crate::beside;
use crate::document::{self, Node};
use crate::forms;
use crate::inherit::merge_chain;
use crate::library::{Kind, Library};
use crate::material;
use crate::meaning;
use crate::models::{MODELS, Model, ModelName, any_file};
use crate::places;
use crate::report::Fault;
use crate::schema;
use crate::solids;
use crate::source::{Origin, Source, SourceId, Sources, Span};
use crate::species::split;
use crate::woods;

/// The most ancestors of a species; more are a mistake even without a circle.
const MOST_ANCESTORS: usize = 16;

/// The texts that were read so far, and their faults.
#[derive(Default)]
pub(crate) struct Loader {
    pub library: Library,
    pub sources: Sources,
    pub faults: Vec<Fault>,
}

/// A value that serde reads from a tree, or serde's error with its path.
type Read<T> = Result<T, serde_path_to_error::Error<serde_json::Error>>;

/// A species, as far as its files could be read.
pub(crate) struct Found {
    pub about: Option<About>,
    pub model: Model,
    /// The merged tree, with the place of every value.
    pub node: Node,
}

/// A name of a species or a scenario, with the place where it is stated.
#[derive(Clone)]
pub(crate) struct Mention {
    pub name: String,
    /// The place in a file; `None` on the command line.
    pub place: Option<(Span, Path)>,
}

impl Loader {
    /// Adds a model's faults, each at the place where its value was typed.
    pub fn tell(&mut self, node: &Node, faults: Vec<phytomer_law::fault::Fault>) {
        let placed = faults.into_iter().map(|fault| meaning::place(&self.sources, node, fault));
        self.faults.extend(placed.collect::<Vec<_>>());
    }

    /// Finds a file by its name; where there is none, adds a fault and returns `None`.
    pub fn find(&mut self, kind: Kind, mention: &Mention) -> Option<Source> {
        let beside = mention.place.as_ref().map(|(span, _)| self.sources.get(span.source).origin.clone());
        match self.library.find(kind, &mention.name, beside.as_ref()) {
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

    /// Parses a text, which is kept among the sources; the tree is `None` where parsing failed.
    pub fn parse(&mut self, source: Source) -> (SourceId, Option<Node>) {
        let id = self.sources.add(source);
        (id, document::parse(&self.sources, id, &mut self.faults))
    }

    /// Puts the meshes of files into a tree, where shapes name them.
    pub fn fill_solids(&mut self, node: &mut Node) {
        let Self { library, sources, faults } = self;
        solids::fill(node, solids::Reading { library, sources, faults });
    }

    /// Puts the places of a file into the tree of a scenario, and states the plants of its stand.
    pub fn fill_stand(&mut self, node: &mut Node) {
        let Self { library, sources, faults } = self;
        places::fill(node, solids::Reading { library, sources, faults });
    }

    /// Reads a value of type `T` from a tree that was checked against its schema. `refused` are the faults of that
    /// check, and `keys` the roles of the tree's keys. With faults, the refused values are left out first; `None` where
    /// nothing useful is left.
    pub fn read<T>(
        &mut self,
        node: &Node,
        keys: &Keys,
        refused: &[Fault],
        read: impl Fn(Json) -> Read<T>,
    ) -> Option<T> {
        if !refused.is_empty() {
            return read(meaning::without(node, keys, refused)?.to_json()).ok();
        }
        read(node.to_json()).map_err(|error| self.refused(node, &error)).ok()
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

    /// Reads a species and merges its ancestors. Where there are faults, the result holds what is left without the
    /// refused values, or is `None` where nothing useful is left.
    pub fn species(&mut self, mention: &Mention) -> Option<Found> {
        let chain = self.chain(mention)?;
        let name = self.model(&chain, mention)?;
        for node in &chain {
            schema::check(name.file_schema(), node, &mut self.faults);
        }
        let keys = &name.card().keys;
        let mut node = merge_chain(name.schema(), keys.by_place.as_ref(), chain)?;
        let mut refused = Vec::new();
        woods::fill(&mut node, keys, &mut self.sources, &mut refused);
        forms::resolve(&mut node, keys, &self.sources, &mut refused);
        material::resolve(&mut node, &self.sources, &mut refused);
        beside::fill(&mut node, keys, &self.library, &mut self.sources, &mut refused);
        schema::check(name.schema(), &node, &mut refused);
        self.faults.extend(refused.iter().cloned());
        let about = self.read(&node, keys, &refused, |json| serde_path_to_error::deserialize(split(json).0));
        let model = self.read(&node, keys, &refused, |json| name.read(split(json).1))?;
        Some(Found { about, model, node })
    }

    /// The trees of the files of a species, the eldest ancestor first.
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
            let mut node = node?;
            self.fill_solids(&mut node);
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

    /// The model that the chain names; all its files must agree. Where none is named, the files are still checked.
    fn model(&mut self, chain: &[Node], mention: &Mention) -> Option<ModelName> {
        let mut found: Option<ModelName> = None;
        for value in chain.iter().filter_map(|node| node.get("model")) {
            let Some(model) = value.text().and_then(ModelName::from_word) else { continue };
            if let Some(elder) = found.filter(|elder| *elder != model) {
                let problem =
                    format!("a species of the model `{}` cannot become one of `{}`", elder.word(), model.word());
                let expected = "the model of the species that it inherits from";
                self.faults.push(Fault::new(value.span, &path_of(&["model"]), problem, expected));
                return None;
            }
            found = Some(model);
        }
        if found.is_none() {
            self.no_model(chain, mention);
        }
        found
    }

    /// Adds a fault: the species names no known model.
    fn no_model(&mut self, chain: &[Node], mention: &Mention) {
        let named = chain.iter().any(|node| node.get("model").is_some());
        if !named && chain.iter().any(looks_like_scenario) {
            return self.fault_at(mention, format!("`{}` is a scenario", mention.name), "a species");
        }
        let any = any_file();
        chain.iter().for_each(|node| schema::check(&any, node, &mut self.faults));
        if let (false, Some(youngest)) = (named, chain.last()) {
            let words: Vec<String> = MODELS.iter().map(|m| format!("`{}`", m.word())).collect();
            let expected = format!("`model`: one of {}", words.join(", "));
            self.faults.push(Fault::new(youngest.span, &Path::root(), "the key `model` is missing", expected));
        }
    }
}

/// Whether a file without a model has the keys of a scenario.
pub(crate) fn looks_like_scenario(node: &Node) -> bool {
    ["species", "ages", "plants"].into_iter().filter(|key| node.get(key).is_some()).count() >= 2
}

/// The origin without spelling differences, so that one file by two paths is found to be the same.
fn identity(origin: &Origin) -> Origin {
    match origin {
        Origin::File(path) => Origin::File(path.canonicalize().unwrap_or_else(|_| path.clone())),
        other => other.clone(),
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
