//! From the bytes of a file to a species file: what is read, whose keys they are, and what is written.
//!
//! Absent: files and their paths, which the caller has; whether the parametric model takes the numbers, which `config`
//! checks of any species file.

use crate::fault::{Refused, Wrong, said};
use crate::format::{Format, Syntax, of_keys};
use crate::mapping::{Mapping, Told};
use crate::value::Entry;
use crate::{arbaro, helios, literal, names, sapling, tree_gen, writing, xml};
use std::borrow::Cow;

/// So many bytes may a file have: a library has some 1,300 bytes a tree.
pub const MOST_BYTES: usize = 1 << 20;

/// What is asked of a file.
#[derive(Debug, Clone, Copy, Default)]
pub struct Asked<'a> {
    /// Whose file it is; its ending and its keys tell where this does not.
    pub from: Option<Format>,
    /// Which of the trees of a library.
    pub tree: Option<&'a str>,
}

/// A tree of another program as a species file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Converted {
    /// Whose file it was.
    pub format: Format,
    /// What the file calls the tree.
    pub label: Option<String>,
    /// The text of the species file.
    pub species: String,
    /// What became of each key, in the order of the file.
    pub told: Vec<Told>,
}

/// Why nothing is converted.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Failed {
    /// The file is wrong.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// The ending does not tell whose file it is, and nobody has said.
    #[error("the ending of {0} does not tell whose file it is; say --from arbaro, tree-gen, sapling, helios or json")]
    Ending(String),
    /// The file has several trees, or none of the name.
    #[error("{name} has {}; choose one by --tree", listed(.labels))]
    Choice {
        /// The file.
        name: String,
        /// What it calls its trees.
        labels: Vec<String>,
    },
}

fn listed(labels: &[String]) -> String {
    let shown: Vec<String> = labels.iter().take(20).map(|label| said(label)).collect();
    let more = if labels.len() > 20 { ", …" } else { "" };
    format!("{} trees: {}{more}", labels.len(), shown.join(", "))
}

/// Reads a file of another program and writes its tree as a species of the parametric model.
///
/// At most [`MOST_BYTES`] are read; a caller need not hand over more than one byte beyond them.
///
/// # Errors
/// What is wrong with the file, with line and column, and what the caller has to say.
pub fn convert(name: &str, bytes: &[u8], asked: Asked<'_>) -> Result<Converted, Failed> {
    let text = decode(name, bytes)?;
    let syntax = match asked.from {
        Some(format) => format.into(),
        None => Syntax::of_name(name).ok_or_else(|| Failed::Ending(name.to_owned()))?,
    };
    let refuse = |wrong: Wrong| Refused { name: name.to_owned(), faults: vec![wrong.placed(&text)] };
    let (format, tree) = match syntax {
        Syntax::Xml => {
            let (format, trees) = xml::trees(&text).map_err(refuse)?;
            (
                format,
                chosen(name, trees, asked.tree)
                    .map_err(|failed| failed.unwrap_or_else(|| refuse(none(&text)).into()))?,
            )
        }
        Syntax::Python => dictionary(&text, Format::Sapling, asked.from).map_err(refuse)?,
        Syntax::Json => {
            json(&text).map_err(refuse)?;
            dictionary(&text, Format::Json, asked.from).map_err(refuse)?
        }
    };
    if asked.from.is_some_and(|from| from != format && from != Format::Json) {
        let (from, is) = (asked.from.map_or("", Format::program), format.program());
        let wrong =
            Wrong::new(0..0, format!("this is a file of {is} and not of {from}"), format!("--from {}", format.word()));
        return Err(refuse(wrong).into());
    }
    let (species, told) = mapped(&text, format, &tree, name).map_err(refuse)?;
    Ok(Converted { format, label: tree.label, species, told })
}

/// The text of the bytes.
fn decode<'b>(name: &str, bytes: &'b [u8]) -> Result<Cow<'b, str>, Refused> {
    let refused = |text: &str, wrong: Wrong| Refused { name: name.to_owned(), faults: vec![wrong.placed(text)] };
    let (whole, long) = (&bytes[..bytes.len().min(MOST_BYTES)], bytes.len() > MOST_BYTES);
    let bare = whole.strip_prefix(b"\xef\xbb\xbf").unwrap_or(whole);
    if long {
        let text = String::from_utf8_lossy(bare);
        let problem = format!("the file goes on beyond {MOST_BYTES} bytes");
        return Err(refused(
            &text,
            Wrong::new(text.len()..text.len(), problem, "the file of a tree, or a library of trees"),
        ));
    }
    match std::str::from_utf8(bare) {
        Ok(text) => Ok(Cow::Borrowed(text)),
        Err(error) => {
            let text = String::from_utf8_lossy(&bare[..error.valid_up_to()]);
            let wrong = Wrong::new(text.len()..text.len(), "this byte belongs to no character", "text in UTF-8");
            Err(refused(&text, wrong))
        }
    }
}

/// The one tree that is meant; no fault of the file where the caller has to choose.
fn chosen(name: &str, mut trees: Vec<xml::Tree>, asked: Option<&str>) -> Result<xml::Tree, Option<Failed>> {
    let labels: Vec<String> = trees.iter().map(|tree| tree.label.clone().unwrap_or_default()).collect();
    let found = match asked {
        Some(label) => labels.iter().position(|known| known.eq_ignore_ascii_case(label)),
        None => (trees.len() == 1).then_some(0),
    };
    match found {
        _ if trees.is_empty() => Err(None),
        Some(index) => Ok(trees.swap_remove(index)),
        None => Err(Some(Failed::Choice { name: name.to_owned(), labels })),
    }
}

fn none(text: &str) -> Wrong {
    Wrong::new(text.len()..text.len(), "the file has no tree", "`<species>` or `<WeberPennTree>`")
}

/// Whether the text is JSON, which is asked of a parser of JSON; the places of its values are found by `literal`.
fn json(text: &str) -> Result<(), Wrong> {
    let Err(error) = serde_json::from_str::<serde_json::Value>(text) else { return Ok(()) };
    let line = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum::<usize>();
    let at = (line + error.column().saturating_sub(1)).min(text.len());
    let told = error.to_string();
    let told = told.split(" at line ").next().unwrap_or(&told);
    Err(Wrong::new(at..at, format!("this is no JSON: {told}"), "a JSON object, such as `{\"Shape\": 7}`"))
}

/// The dictionary of a text, and whose keys it has.
fn dictionary(text: &str, syntax: Format, from: Option<Format>) -> Result<(Format, xml::Tree), Wrong> {
    let entries = literal::dictionary(text)?;
    let known = of_keys(&entries).or(from).or((syntax == Format::Json).then_some(Format::Json));
    let Some(format) = known else {
        let first = entries.first().map_or(0..0, |entry| entry.at.clone());
        let expected = "the keys of tree-gen, such as `g_scale`, or of Sapling, such as `baseSize`";
        return Err(Wrong::new(first, "the keys are neither tree-gen's nor Sapling's", expected));
    };
    let label = |entry: &&Entry| ["name", "Species"].contains(&entry.key.as_str());
    let label = entries.iter().find(label).and_then(|entry| match &entry.node.value {
        crate::value::Value::Text(name) => Some(name.clone()),
        _ => None,
    });
    Ok((format, xml::Tree { label, entries }))
}

fn mapped(text: &str, format: Format, tree: &xml::Tree, name: &str) -> Result<(String, Vec<Told>), Wrong> {
    let keys = match format {
        Format::TreeGen => ["levels", "leaf_blos_num"],
        Format::Sapling => ["levels", "leaves"],
        _ => ["Levels", "Leaves"],
    };
    let mut mapping = Mapping::of(text, &tree.entries, keys, 3)?;
    match format {
        Format::Arbaro => {
            mapping.follow(arbaro::rule)?;
            arbaro::finish(&mut mapping);
            mapping.fill("Arbaro", arbaro::default);
        }
        Format::TreeGen => {
            mapping.follow(tree_gen::rule)?;
            tree_gen::finish(&mut mapping);
            mapping.fill("tree-gen", tree_gen::default);
        }
        Format::Sapling => {
            mapping.follow(sapling::rule)?;
            mapping.fill("Sapling", sapling::default);
        }
        Format::Helios => {
            mapping.follow(helios::rule)?;
            mapping.fill("Helios", helios::default);
        }
        Format::Json => {
            mapping.follow(names::rule)?;
            mapping.fill("the paper", names::default);
        }
    }
    mapping.drop_idle_envelope();
    let species = writing::species(&mapping, tree.label.as_deref(), name, format);
    Ok((species, mapping.told))
}
