//! No two neighbours in a folder of source use each other, directly or through other modules: files of a circle can
//! only be read, tested and taken away together.
//!
//! Neighbours are the files of a folder, and its folders with all their files. Uses are read from the text: `use` lines
//! and paths that begin with `crate` or `super`, followed through the names that a folder exports with `pub use`.
//! Absent: tests, uses between a folder's own file and the files in it, `use super::*`, and methods of a type that are
//! written in several files.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The names from the root of a crate to a module.
type Place = Vec<String>;

/// The facts read from the text of a module.
#[derive(Default)]
struct Module {
    uses: BTreeSet<Place>,
    /// The path behind each name that the module exports with `pub use`.
    passes_on: BTreeMap<String, Place>,
}

type Modules = BTreeMap<Place, Module>;

#[test]
fn no_neighbours_use_each_other() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut found, mut files) = (BTreeSet::new(), 0);
    for source in sources(root) {
        let modules = modules(&source);
        files += modules.len();
        let folder = source.strip_prefix(root).unwrap_or(&source).to_string_lossy().replace('\\', "/");
        found.extend(circles(&modules).into_iter().map(|circle| format!("{folder}{circle}")));
    }
    assert!(files > 150, "only {files} files are found");
    assert!(found.is_empty(), "these use each other, which must go one way only: {found:#?}");
}

#[test]
fn a_circle_is_found_however_it_is_written() {
    let text = [
        ("", "pub mod laws; pub use laws::Law;"),
        ("laws", "mod a; mod b; mod c; mod d;\npub use c::{self, Curve};\npub use d::*;"),
        ("laws::a", "use super::b::{B1, B2 as Other};"),
        ("laws::b", "// use super::a::Comment;\nuse super::{\n    Curve,\n    d,\n};"),
        ("laws::c", "fn of() -> f64 { crate::laws::a::value(1.0) }\nmod tests {\n    use super::d;\n}"),
        ("laws::d", "use std::fmt;"),
    ];
    let place = |name: &str| name.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect();
    let modules: Modules = text.map(|(name, text)| (place(name), module(text))).into();
    assert_eq!(circles(&modules), ["/laws: a, b, c"]);
}

/// The source folders of the packages below `folder`.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let own = folder.join("src");
    let mut found = Vec::from_iter(folder.join("Cargo.toml").is_file().then_some(own));
    let skipped = ["src", "target", "runs", "tests"];
    for (name, path) in entries(folder) {
        if path.is_dir() && !name.starts_with('.') && !skipped.contains(&name.as_str()) {
            found.extend(sources(&path));
        }
    }
    found
}

/// The entries of a folder, by name.
fn entries(folder: &Path) -> BTreeMap<String, PathBuf> {
    let read = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    read.flatten().map(|entry| (entry.file_name().to_string_lossy().into_owned(), entry.path())).collect()
}

/// The modules of a crate, without its tests.
fn modules(source: &Path) -> Modules {
    let mut modules = Modules::new();
    let mut folders = vec![(source.to_owned(), Place::new())];
    while let Some((folder, at)) = folders.pop() {
        for (name, path) in entries(&folder) {
            let below = |name: &str| at.iter().cloned().chain([name.to_owned()]).collect();
            match name.strip_suffix(".rs") {
                _ if name.starts_with("tests") => {}
                None if path.is_dir() => folders.push((path, below(&name))),
                None | Some("main") => {}
                Some(stem) => {
                    let place = if matches!(stem, "lib" | "mod") { at.clone() } else { below(stem) };
                    modules.insert(place, module(&fs::read_to_string(&path).expect("it reads")));
                }
            }
        }
    }
    modules
}

/// Reads the text of a module up to the tests in it.
fn module(text: &str) -> Module {
    let mut module = Module::default();
    let code: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    let code = code.join("\n");
    let code = code.split("\nmod tests {").next().unwrap_or_default();
    for (is_public, tree) in code.split(';').filter_map(used) {
        for (path, name) in leaves(tree) {
            if is_public {
                module.passes_on.extend(name.or(path.last().cloned()).map(|name| (name, path.clone())));
            }
            module.uses.insert(path);
        }
    }
    let written = code.split(|letter: char| !(letter.is_alphanumeric() || "_:".contains(letter)));
    let absolute = written.filter(|path| path.starts_with("crate::") || path.starts_with("super::"));
    module.uses.extend(absolute.map(parts));
    module
}

/// The paths of a statement, where it is a `use`, and whether it exports them.
fn used(statement: &str) -> Option<(bool, &str)> {
    let (before, tree) = statement.rsplit_once("use ")?;
    let before = before.lines().last().unwrap_or_default().trim();
    let is_public = before.starts_with("pub");
    (before.is_empty() || is_public).then_some((is_public, tree))
}

fn parts(path: &str) -> Place {
    path.split("::").map(str::trim).filter(|part| !part.is_empty() && *part != "self").map(str::to_owned).collect()
}

/// The paths of a `use`, with their lists in braces taken apart, and the new name of each that has one.
fn leaves(tree: &str) -> Vec<(Place, Option<String>)> {
    let Some((before, list)) = tree.split_once('{') else {
        let (path, name) = tree.split_once(" as ").map_or((tree, None), |(path, name)| (path, Some(name)));
        return vec![(parts(path), name.map(|name| name.trim().to_owned()))];
    };
    let list = list.rsplit_once('}').map_or(list, |(list, _)| list);
    let mut depth = 0;
    let items = list.split(|letter| {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        letter == ',' && depth == 0
    });
    let items = items.filter(|item| !item.trim().is_empty()).flat_map(leaves);
    items.map(|(path, name)| (parts(before).into_iter().chain(path).collect(), name)).collect()
}

/// The module that a path leads to from the module `at`; `None` out of the crate.
fn resolved(modules: &Modules, at: &[String], path: &[String], passed_on: u32) -> Option<Place> {
    let ups = path.iter().take_while(|part| *part == "super").count();
    let (mut place, mut rest) = match path.first()?.as_str() {
        "crate" => (Place::new(), &path[1..]),
        "super" => (at[..at.len().checked_sub(ups)?].to_vec(), &path[ups..]),
        child => modules.contains_key(&[at, &[child.to_owned()]].concat()).then(|| (at.to_vec(), path))?,
    };
    while let [name, more @ ..] = rest {
        let below = [place.as_slice(), std::slice::from_ref(name)].concat();
        if modules.contains_key(&below) {
            (place, rest) = (below, more);
            continue;
        }
        let passed = modules.get(&place).and_then(|module| module.passes_on.get(name)).filter(|_| passed_on < 8);
        let further = passed.and_then(|to| resolved(modules, &place, &[to.as_slice(), more].concat(), passed_on + 1));
        return Some(further.unwrap_or(place));
    }
    Some(place)
}

/// The circles of a crate: "/folder: one, other".
fn circles(modules: &Modules) -> Vec<String> {
    let mut neighbours: BTreeMap<&[String], BTreeMap<&str, BTreeSet<String>>> = BTreeMap::new();
    for (at, module) in modules {
        for to in module.uses.iter().filter_map(|path| resolved(modules, at, path, 0)) {
            let shared = at.iter().zip(&to).take_while(|(a, b)| a == b).count();
            if let (Some(from), Some(to)) = (at.get(shared), to.get(shared)) {
                neighbours.entry(&at[..shared]).or_default().entry(from).or_default().insert(to.clone());
            }
        }
    }
    let mut circles = BTreeSet::new();
    for (folder, uses) in &neighbours {
        let folder: String = folder.iter().map(|name| format!("/{name}")).collect();
        for name in uses.keys() {
            let reached = reached(uses, name);
            let back: Vec<&str> =
                reached.iter().copied().filter(|other| self::reached(uses, other).contains(name)).collect();
            circles.extend((!back.is_empty()).then(|| format!("{folder}: {}", back.join(", "))));
        }
    }
    circles.into_iter().collect()
}

/// The modules used from `name` on, directly or through others.
fn reached<'a>(uses: &'a BTreeMap<&str, BTreeSet<String>>, name: &str) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut next: Vec<&str> = uses.get(name).into_iter().flatten().map(String::as_str).collect();
    while let Some(name) = next.pop() {
        if reached.insert(name) {
            next.extend(uses.get(name).into_iter().flatten().map(String::as_str));
        }
    }
    reached
}
