//! What a binary layer says of itself at its end: tokens, strings, fields, sets of fields, paths, specs, contents.

use super::ints::{compress, pack};
use super::values::{Rep, Values};
use super::{BOOTSTRAP, Field};
use std::collections::BTreeMap;
use std::io;

/// The path of the root of all.
pub const ROOT: u32 = 0;
/// The end of a set of fields.
const END: u32 = u32::MAX;
/// A token with the number 0, which has no negative: tokens of properties are told by their negative numbers.
const NO_PROPERTY: &str = ";-)";

/// The types of specs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spec {
    Attribute = 1,
    Prim = 6,
    PseudoRoot = 7,
    Relationship = 8,
    Variant = 10,
    VariantSet = 11,
}

/// An element of the tree of paths.
#[derive(Debug, Default)]
struct Element {
    token: u32,
    property: bool,
    children: Vec<u32>,
}

/// The tables of a layer.
#[derive(Debug, Default)]
pub struct Tables {
    tokens: Vec<String>,
    token_places: BTreeMap<String, u32>,
    strings: Vec<u32>,
    fields: Vec<Field>,
    field_places: BTreeMap<Field, u32>,
    sets: Vec<u32>,
    paths: Vec<Element>,
    path_places: BTreeMap<(u32, u32, bool), u32>,
    specs: Vec<[u32; 3]>,
}

impl Tables {
    /// Nothing but the root.
    pub fn new() -> Self {
        let mut tables = Self { paths: vec![Element::default()], ..Self::default() };
        tables.token(NO_PROPERTY);
        tables
    }

    /// The number of a token.
    pub fn token(&mut self, word: &str) -> u32 {
        if let Some(place) = self.token_places.get(word) {
            return *place;
        }
        let place = self.tokens.len() as u32;
        self.tokens.push(word.to_owned());
        self.token_places.insert(word.to_owned(), place);
        place
    }

    /// The number of a string.
    pub fn text(&mut self, text: &str) -> u32 {
        let token = self.token(text);
        self.strings.push(token);
        self.strings.len() as u32 - 1
    }

    /// The number of a path below another.
    pub fn path(&mut self, parent: u32, token: u32, property: bool) -> u32 {
        if let Some(place) = self.path_places.get(&(parent, token, property)) {
            return *place;
        }
        let place = self.paths.len() as u32;
        self.paths.push(Element { token, property, children: Vec::new() });
        self.paths[parent as usize].children.push(place);
        self.path_places.insert((parent, token, property), place);
        place
    }

    /// The number of a path from the root, such as `/plant/wood.points`.
    pub fn path_of(&mut self, path: &str) -> u32 {
        let (prims, property) = path.split_once('.').map_or((path, None), |(prims, name)| (prims, Some(name)));
        let mut place = ROOT;
        for name in prims.split('/').filter(|name| !name.is_empty()) {
            let token = self.token(name);
            place = self.path(place, token, false);
        }
        match property {
            Some(name) => {
                let token = self.token(name);
                self.path(place, token, true)
            }
            None => place,
        }
    }

    /// Adds a spec.
    pub fn add(&mut self, path: u32, fields: Vec<Field>, spec: Spec) {
        let set = self.sets.len() as u32;
        for field in fields {
            let fields = &mut self.fields;
            let place = *self.field_places.entry(field).or_insert_with(|| {
                fields.push(field);
                fields.len() as u32 - 1
            });
            self.sets.push(place);
        }
        self.sets.push(END);
        self.specs.push([path, set, spec as u32]);
    }

    /// Writes all tables; the place of the table of contents.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write(&self, out: &mut Values) -> io::Result<u64> {
        let mut contents: Vec<(&str, u64, u64)> = Vec::new();
        let sections: [(&str, Section); 6] = [
            ("TOKENS", Self::write_tokens),
            ("STRINGS", Self::write_strings),
            ("FIELDS", Self::write_fields),
            ("FIELDSETS", Self::write_sets),
            ("PATHS", Self::write_paths),
            ("SPECS", Self::write_specs),
        ];
        for (name, write) in sections {
            let start = out.place();
            write(self, out)?;
            contents.push((name, start, out.place() - start));
        }
        let place = out.place();
        debug_assert!(place >= BOOTSTRAP as u64);
        out.put_long(contents.len() as u64)?;
        for (name, start, size) in contents {
            let mut padded = [0; 16];
            padded[..name.len()].copy_from_slice(name.as_bytes());
            out.put(&padded)?;
            out.put_long(start)?;
            out.put_long(size)?;
        }
        Ok(place)
    }

    fn write_tokens(&self, out: &mut Values) -> io::Result<()> {
        let texts: Vec<u8> = self.tokens.iter().flat_map(|token| token.bytes().chain([0])).collect();
        out.put_long(self.tokens.len() as u64)?;
        out.put_long(texts.len() as u64)?;
        put_sized(out, &compress(&texts))
    }

    fn write_strings(&self, out: &mut Values) -> io::Result<()> {
        out.put_long(self.strings.len() as u64)?;
        out.put(bytemuck::cast_slice(&self.strings))
    }

    fn write_fields(&self, out: &mut Values) -> io::Result<()> {
        out.put_long(self.fields.len() as u64)?;
        put_sized(out, &pack_all(self.fields.iter().map(|(token, _)| *token)))?;
        let reps: Vec<u8> = self.fields.iter().flat_map(|(_, rep): &(u32, Rep)| rep.0.to_le_bytes()).collect();
        put_sized(out, &compress(&reps))
    }

    fn write_sets(&self, out: &mut Values) -> io::Result<()> {
        out.put_long(self.sets.len() as u64)?;
        put_sized(out, &pack_all(self.sets.iter().copied()))
    }

    /// The tree of paths, each before its children and those before its next sibling. A jump is 0 where the next
    /// element is a sibling, −1 where it is a child and there is no sibling, −2 where there is neither, else how far
    /// the sibling is.
    fn write_paths(&self, out: &mut Values) -> io::Result<()> {
        let (mut order, mut jumps) = (Vec::with_capacity(self.paths.len()), vec![0_i32; self.paths.len()]);
        // The paths that wait, each with the place of the element before whose sibling it is.
        let mut waiting: Vec<(u32, Option<usize>)> = vec![(ROOT, None)];
        let mut has_sibling = vec![false; self.paths.len()];
        for element in &self.paths {
            element.children.iter().rev().skip(1).for_each(|child| has_sibling[*child as usize] = true);
        }
        while let Some((path, before)) = waiting.pop() {
            let place = order.len();
            order.push(path);
            if let Some(before) = before {
                jumps[before] = if before + 1 == place { 0 } else { (place - before) as i32 };
            }
            let Element { children, .. } = &self.paths[path as usize];
            if !has_sibling[path as usize] {
                jumps[place] = if children.is_empty() { -2 } else { -1 };
            } else if let Some((_, of)) = waiting.last_mut() {
                *of = Some(place);
            }
            waiting.extend(children.iter().rev().map(|child| (*child, None)));
        }
        let token = |path: &u32| {
            let Element { token, property, .. } = self.paths[*path as usize];
            if property { -(token as i32) } else { token as i32 }
        };
        out.put_long(self.paths.len() as u64)?;
        out.put_long(order.len() as u64)?;
        put_sized(out, &pack_all(order.iter().copied()))?;
        put_sized(out, &pack(&order.iter().map(token).collect::<Vec<_>>()))?;
        put_sized(out, &pack(&jumps))
    }

    fn write_specs(&self, out: &mut Values) -> io::Result<()> {
        out.put_long(self.specs.len() as u64)?;
        (0..3).try_for_each(|part| put_sized(out, &pack_all(self.specs.iter().map(|spec| spec[part]))))
    }
}

/// What writes a section.
type Section = fn(&Tables, &mut Values) -> io::Result<()>;

fn put_sized(out: &mut Values, bytes: &[u8]) -> io::Result<()> {
    out.put_long(bytes.len() as u64)?;
    out.put(bytes)
}

fn pack_all(numbers: impl Iterator<Item = u32>) -> Vec<u8> {
    pack(&numbers.map(|number| number as i32).collect::<Vec<_>>())
}
