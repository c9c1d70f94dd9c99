//! A layer in the binary format of USD (`.usdc`, "crate", version 0.8.0): values as they come, then tables of what
//! there is.
//!
//! The format is that of pxr/usd/sdf/crateFile.cpp and integerCoding.cpp of OpenUSD. A file begins with a bootstrap
//! that points to the table of contents at the end. Values are written at once, so that memory holds the tables alone;
//! a value is known by its representation, 64 bits with its type and its place in the file, or the value itself where
//! it is small. Words are numbered (tokens), fields are pairs of a word and a value, sets of fields are shared, paths
//! are a tree, and specs are triples of a path, a set of fields and a type. Whole numbers are coded by their
//! differences and packed with LZ4. At the end the place of the table of contents is put right in the bootstrap. We
//! wrote our own since the crates that write it keep every value in memory.

mod ints;
mod tables;
mod values;

use super::layer::{Attribute, Data, Header, Layer, List, Value, Values as Make, Variants};
use phytomer_meshes::Patched;
use std::io;
use tables::{ROOT, Spec, Tables};
use values::{Rep, Type, Values};

/// The bytes of the bootstrap.
const BOOTSTRAP: usize = 88;
/// The place in it of the place of the table of contents.
const CONTENTS: u64 = 16;
const VERSION: [u8; 8] = [0, 8, 0, 0, 0, 0, 0, 0];

/// What says that a spec goes over what others say.
const OVER: u32 = 1;

/// A field of a spec.
type Field = (u32, Rep);

/// A prim, a set of variants or a variant that is open.
struct Open {
    path: u32,
    spec: Spec,
    fields: Vec<Field>,
    properties: Vec<u32>,
    children: Vec<u32>,
}

/// A list as it is written.
enum Packed {
    /// As it is in memory.
    Plain(List),
    /// So many whole numbers.
    Ints(usize, Vec<u8>),
    /// So many whole numbers of 64 bits.
    Longs(usize, Vec<u8>),
}

impl Packed {
    fn of(list: List) -> Self {
        match &list {
            List::Ints(numbers) if values::is_packed(numbers) => Self::Ints(numbers.len(), ints::pack(numbers)),
            List::Longs(numbers) if values::is_packed(numbers) => Self::Longs(numbers.len(), ints::pack_longs(numbers)),
            _ => Self::Plain(list),
        }
    }
}

/// A layer in the binary format.
pub struct Binary<'o> {
    values: Values<'o>,
    tables: Tables,
    open: Vec<Open>,
    /// The name of the set of variants that is open.
    set: String,
}

impl<'o> Binary<'o> {
    /// Begins a layer.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn begin(out: &'o mut dyn Patched, header: &Header) -> io::Result<Self> {
        let mut values = Values::of(out);
        let mut bootstrap = [0; BOOTSTRAP];
        bootstrap[..8].copy_from_slice(b"PXR-USDC");
        bootstrap[8..16].copy_from_slice(&VERSION);
        values.put(&bootstrap)?;
        let mut binary = Self { values, tables: Tables::new(), open: Vec::new(), set: String::new() };
        let fields = binary.of_header(header)?;
        binary.begin_spec(ROOT, Spec::PseudoRoot, fields);
        Ok(binary)
    }

    fn of_header(&mut self, header: &Header) -> io::Result<Vec<Field>> {
        let root = self.tables.token(&header.root);
        let words = self.tables.text(&header.words);
        let z = self.tables.token("Z");
        let mut fields = vec![
            ("defaultPrim", Rep::inlined(Type::Token, root)),
            ("documentation", Rep::inlined(Type::String, words)),
            ("metersPerUnit", self.values.write_double(1.0)?),
            ("upAxis", Rep::inlined(Type::Token, z)),
        ];
        if let Some([first, last, a_second]) = header.time {
            let [first, last] = [self.values.write_double(first)?, self.values.write_double(last)?];
            let a_second = self.values.write_double(a_second)?;
            fields.extend([("startTimeCode", first), ("endTimeCode", last)]);
            fields.extend([("timeCodesPerSecond", a_second), ("framesPerSecond", a_second)]);
        }
        Ok(fields.into_iter().map(|(name, rep)| (self.tables.token(name), rep)).collect())
    }

    fn token(&mut self, word: &str) -> Rep {
        Rep::inlined(Type::Token, self.tables.token(word))
    }

    fn field(&mut self, name: &str, rep: Rep) -> Field {
        (self.tables.token(name), rep)
    }

    /// The representation of a value, which is written where it is large.
    fn rep(&mut self, data: Data) -> io::Result<Rep> {
        Ok(match data {
            Data::Token(word) => self.token(word),
            Data::Text(text) => Rep::inlined(Type::String, self.tables.text(text)),
            Data::Flag(yes) => Rep::inlined(Type::Bool, u32::from(yes)),
            Data::Float(number) => Rep::inlined(Type::Float, number.to_bits()),
            Data::Triple(numbers) => self.values.write(Type::Vec3f, bytemuck::bytes_of(&numbers))?,
            Data::Quad(numbers) => self.values.write(Type::Vec4f, bytemuck::bytes_of(&numbers))?,
            Data::File(path) => Rep::inlined(Type::AssetPath, self.tables.token(path)),
            Data::Ints(numbers) => self.values.write_ints(numbers)?,
            Data::Longs(numbers) => self.values.write_longs(numbers)?,
            Data::Floats(numbers) => self.values.write_list(Type::Float, numbers)?,
            Data::Pairs(pairs) => self.values.write_list(Type::Vec2f, pairs)?,
            Data::Triples(triples) => self.values.write_list(Type::Vec3f, triples)?,
            Data::Turns(turns) => self.values.write_list(Type::Quath, turns)?,
        })
    }

    /// Writes the values of some times, each different one once. Two are made and packed at a time, by two threads.
    fn timed(&mut self, times: &[(f64, usize)], make: &Make) -> io::Result<Rep> {
        let most = times.iter().map(|(_, number)| number + 1).max().unwrap_or(0);
        let mut reps: Vec<Option<Rep>> = vec![None; most];
        let mut is_new = vec![true; most];
        let numbers: Vec<usize> = times.iter().map(|(_, number)| *number).collect();
        let numbers: Vec<usize> =
            numbers.into_iter().filter(|number| std::mem::replace(&mut is_new[*number], false)).collect();
        let packed = |number: usize| make(number).map(Packed::of);
        for pair in numbers.chunks(2) {
            let (first, second) = rayon::join(|| packed(pair[0]), || pair.get(1).map(|number| packed(*number)));
            reps[pair[0]] = Some(self.packed(first?)?);
            if let (Some(number), Some(second)) = (pair.get(1), second) {
                reps[*number] = Some(self.packed(second?)?);
            }
        }
        let samples = times.iter().filter_map(|(time, number)| Some((*time, reps[*number]?)));
        self.values.write_samples(&samples.collect::<Vec<_>>())
    }

    /// The representation of a value that is packed.
    fn packed(&mut self, packed: Packed) -> io::Result<Rep> {
        match packed {
            Packed::Plain(list) => self.rep(list.data()),
            Packed::Ints(count, bytes) => self.values.write_packed(Type::Int, count, &bytes),
            Packed::Longs(count, bytes) => self.values.write_packed(Type::Int64, count, &bytes),
        }
    }

    /// Adds a property of the open prim.
    fn property(&mut self, name: &str, fields: Vec<Field>, spec: Spec) {
        let token = self.tables.token(name);
        let Some(open) = self.open.last_mut() else { return };
        open.properties.push(token);
        let path = self.tables.path(open.path, token, true);
        self.tables.add(path, fields, spec);
    }

    fn words(&mut self, words: &[u32]) -> io::Result<Rep> {
        self.values.write_words(Type::TokenVector, words)
    }

    fn begin_spec(&mut self, path: u32, spec: Spec, fields: Vec<Field>) {
        self.open.push(Open { path, spec, fields, properties: Vec::new(), children: Vec::new() });
    }

    /// Ends what is open.
    fn close(&mut self) -> io::Result<()> {
        let Some(Open { path, spec, mut fields, properties, children }) = self.open.pop() else { return Ok(()) };
        let of_children = if spec == Spec::VariantSet { "variantChildren" } else { "primChildren" };
        for (name, words) in [("properties", properties), (of_children, children)] {
            if !words.is_empty() {
                let rep = self.words(&words)?;
                fields.push(self.field(name, rep));
            }
        }
        self.tables.add(path, fields, spec);
        Ok(())
    }
}

impl Layer for Binary<'_> {
    fn begin(&mut self, of: &'static str, name: &str, schemas: &[&str]) -> io::Result<()> {
        let token = self.tables.token(name);
        let Some(parent) = self.open.last_mut() else { return Ok(()) };
        parent.children.push(token);
        let path = self.tables.path(parent.path, token, false);
        let of = self.token(of);
        let mut fields = vec![self.field("specifier", Rep::inlined(Type::Specifier, 0)), self.field("typeName", of)];
        if !schemas.is_empty() {
            let words: Vec<u32> = schemas.iter().map(|schema| self.tables.token(schema)).collect();
            let rep = self.values.write_prepended(Type::TokenListOp, &words)?;
            fields.push(self.field("apiSchemas", rep));
        }
        self.begin_spec(path, Spec::Prim, fields);
        Ok(())
    }

    fn begin_varied(&mut self, of: &'static str, name: &str, variants: &Variants) -> io::Result<()> {
        self.begin(of, name, &[])?;
        let Variants { set, names } = variants;
        let chosen = names.first().map_or("", String::as_str);
        let [set_text, chosen] = [*set, chosen].map(|text| self.tables.text(text));
        let sets = self.values.write_prepended(Type::StringListOp, &[set_text])?;
        let choice = self.values.write_choice(set_text, chosen)?;
        let word = self.tables.token(set);
        let of_sets = self.words(&[word])?;
        let more = [("variantSetNames", sets), ("variantSelection", choice), ("variantSetChildren", of_sets)];
        let more = more.map(|(name, rep)| self.field(name, rep));
        let element = self.tables.token(&format!("{{{set}=}}"));
        let Some(prim) = self.open.last_mut() else { return Ok(()) };
        prim.fields.extend(more);
        let path = self.tables.path(prim.path, element, false);
        self.set = (*set).to_owned();
        self.begin_spec(path, Spec::VariantSet, Vec::new());
        Ok(())
    }

    fn begin_variant(&mut self, name: &str) -> io::Result<()> {
        let (word, element) = (self.tables.token(name), self.tables.token(&format!("{{{}={name}}}", self.set)));
        let [.., prim, set] = &mut self.open[..] else { return Ok(()) };
        set.children.push(word);
        let path = self.tables.path(prim.path, element, false);
        let specifier = self.field("specifier", Rep::inlined(Type::Specifier, OVER));
        self.begin_spec(path, Spec::Variant, vec![specifier]);
        Ok(())
    }

    fn attribute(&mut self, attribute: Attribute, value: Value) -> io::Result<()> {
        let of = self.token(attribute.of);
        let mut fields = vec![self.field("typeName", of)];
        if attribute.uniform {
            fields.push(self.field("variability", Rep::inlined(Type::Variability, 1)));
        }
        if let Some(interpolation) = attribute.interpolation {
            let rep = self.token(interpolation);
            fields.push(self.field("interpolation", rep));
        }
        match value {
            Value::None => {}
            Value::Always(data) => {
                let rep = self.rep(data)?;
                fields.push(self.field("default", rep));
            }
            Value::Of(path) => {
                let path = self.tables.path_of(path);
                let rep = self.values.write_explicit(Type::PathListOp, &[path])?;
                fields.push(self.field("connectionPaths", rep));
            }
            Value::Timed(times, make) => {
                let rep = self.timed(times, make)?;
                fields.push(self.field("timeSamples", rep));
            }
        }
        self.property(attribute.name, fields, Spec::Attribute);
        Ok(())
    }

    fn relationship(&mut self, name: &str, targets: &[String]) -> io::Result<()> {
        let paths: Vec<u32> = targets.iter().map(|target| self.tables.path_of(target)).collect();
        let rep = self.values.write_explicit(Type::PathListOp, &paths)?;
        let uniform = Rep::inlined(Type::Variability, 1);
        let fields = vec![self.field("variability", uniform), self.field("targetPaths", rep)];
        self.property(name, fields, Spec::Relationship);
        Ok(())
    }

    fn end(&mut self) -> io::Result<()> {
        self.close()
    }

    fn finish(&mut self) -> io::Result<()> {
        self.close()?;
        let contents = self.tables.write(&mut self.values)?;
        self.values.patch(CONTENTS, &contents.to_le_bytes())
    }
}
