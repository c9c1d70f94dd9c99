//! A layer as text (`.usda`): every number with as many digits as bring it back.

use super::layer::{Attribute, Data, Header, Layer, Value, Values, Variants};
use half::f16;
use std::fmt::Display;
use std::io::{self, Write};

/// A layer as text.
pub struct Text<W> {
    out: W,
    depth: usize,
}

impl<W: Write> Text<W> {
    /// Begins a layer.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn begin(mut out: W, header: &Header) -> io::Result<Self> {
        let Header { root, words, time } = header;
        writeln!(out, "#usda 1.0\n(\n    defaultPrim = {}\n    doc = {}", quoted(root), quoted(words))?;
        if let Some([first, last, a_second]) = time {
            writeln!(out, "    endTimeCode = {last}\n    framesPerSecond = {a_second}")?;
            writeln!(out, "    startTimeCode = {first}\n    timeCodesPerSecond = {a_second}")?;
        }
        writeln!(out, "    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n")?;
        Ok(Self { out, depth: 0 })
    }

    /// Writes an attribute with a list of values, each as it is handed on.
    ///
    /// # Errors
    /// Those of `out` and of `each`.
    pub fn listed(
        &mut self,
        attribute: &Attribute,
        each: impl FnOnce(&mut dyn FnMut(&dyn Display) -> io::Result<()>) -> io::Result<()>,
    ) -> io::Result<()> {
        self.declare(attribute, " = [")?;
        let mut first = true;
        let out = &mut self.out;
        each(&mut |value| {
            let between = if std::mem::take(&mut first) { "" } else { ", " };
            write!(out, "{between}{value}")
        })?;
        writeln!(self.out, "]")
    }

    /// Writes a prim that is what another file has at its root.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn refer(&mut self, name: &str, file: &str) -> io::Result<()> {
        self.indent()?;
        writeln!(self.out, "def Xform {} (", quoted(name))?;
        self.indent()?;
        writeln!(self.out, "    prepend references = @{file}@")?;
        for line in [")", "{", "}"] {
            self.indent()?;
            writeln!(self.out, "{line}")?;
        }
        Ok(())
    }

    fn indent(&mut self) -> io::Result<()> {
        (0..self.depth).try_for_each(|_| self.out.write_all(b"    "))
    }

    fn declare(&mut self, attribute: &Attribute, suffix: &str) -> io::Result<()> {
        self.indent()?;
        let uniform = if attribute.uniform { "uniform " } else { "" };
        write!(self.out, "{uniform}{} {}{suffix}", attribute.of, attribute.name)
    }

    /// What is said of an attribute behind it.
    fn end_line(&mut self, attribute: &Attribute) -> io::Result<()> {
        if let Some(interpolation) = attribute.interpolation {
            writeln!(self.out, " (")?;
            self.indent()?;
            writeln!(self.out, "    interpolation = \"{interpolation}\"")?;
            self.indent()?;
            write!(self.out, ")")?;
        }
        writeln!(self.out)
    }

    fn timed(&mut self, times: &[(f64, usize)], values: &Values) -> io::Result<()> {
        writeln!(self.out, " = {{")?;
        for (time, number) in times {
            self.indent()?;
            write!(self.out, "    {time}: ")?;
            put(&mut self.out, values(*number)?.data())?;
            writeln!(self.out, ",")?;
        }
        self.indent()?;
        writeln!(self.out, "}}")
    }
}

impl<W: Write> Layer for Text<W> {
    fn begin(&mut self, of: &'static str, name: &str, schemas: &[&str]) -> io::Result<()> {
        self.indent()?;
        write!(self.out, "def {of} {}", quoted(name))?;
        if !schemas.is_empty() {
            writeln!(self.out, " (")?;
            self.indent()?;
            write!(self.out, "    prepend apiSchemas = ")?;
            list(&mut self.out, schemas.iter().map(|schema| quoted(schema)))?;
            writeln!(self.out)?;
            self.indent()?;
            write!(self.out, ")")?;
        }
        writeln!(self.out)?;
        self.indent()?;
        writeln!(self.out, "{{")?;
        self.depth += 1;
        Ok(())
    }

    fn begin_varied(&mut self, of: &'static str, name: &str, variants: &Variants) -> io::Result<()> {
        let Variants { set, names } = variants;
        let chosen = names.first().map_or("", String::as_str);
        let of_prim = [
            format!("def {of} {} (", quoted(name)),
            "    variants = {".to_owned(),
            format!("        string {set} = {}", quoted(chosen)),
            "    }".to_owned(),
            format!("    prepend variantSets = {}", quoted(set)),
            ")".to_owned(),
            "{".to_owned(),
            format!("    variantSet {} = {{", quoted(set)),
        ];
        for line in of_prim {
            self.indent()?;
            writeln!(self.out, "{line}")?;
        }
        self.depth += 2;
        Ok(())
    }

    fn begin_variant(&mut self, name: &str) -> io::Result<()> {
        self.indent()?;
        writeln!(self.out, "{} {{", quoted(name))?;
        self.depth += 1;
        Ok(())
    }

    fn attribute(&mut self, attribute: Attribute, value: Value) -> io::Result<()> {
        match value {
            Value::None => {
                self.declare(&attribute, "")?;
                self.end_line(&attribute)
            }
            Value::Always(data) => {
                self.declare(&attribute, " = ")?;
                put(&mut self.out, data)?;
                self.end_line(&attribute)
            }
            Value::Of(path) => {
                self.declare(&attribute, ".connect = ")?;
                writeln!(self.out, "<{path}>")
            }
            Value::Timed(times, values) => {
                self.declare(&attribute, "")?;
                self.end_line(&attribute)?;
                self.declare(&attribute, ".timeSamples")?;
                self.timed(times, values)
            }
        }
    }

    fn relationship(&mut self, name: &str, targets: &[String]) -> io::Result<()> {
        self.indent()?;
        write!(self.out, "rel {name} = ")?;
        match targets {
            [target] => write!(self.out, "<{target}>")?,
            _ => list(&mut self.out, targets.iter().map(|target| format!("<{target}>")))?,
        }
        writeln!(self.out)
    }

    fn end(&mut self) -> io::Result<()> {
        self.depth = self.depth.saturating_sub(1);
        self.indent()?;
        writeln!(self.out, "}}")
    }

    fn finish(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// A text in quotes, on one line.
fn quoted(text: &str) -> String {
    let mut quoted = String::with_capacity(text.len() + 2);
    quoted.push('"');
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            '\n' => quoted.push_str("\\n"),
            letter if letter.is_control() => quoted.push(' '),
            letter => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}

fn list<T: Display>(out: &mut impl Write, items: impl Iterator<Item = T>) -> io::Result<()> {
    out.write_all(b"[")?;
    for (place, item) in items.enumerate() {
        if place > 0 {
            out.write_all(b", ")?;
        }
        write!(out, "{item}")?;
    }
    out.write_all(b"]")
}

fn put(out: &mut impl Write, data: Data) -> io::Result<()> {
    match data {
        Data::Token(text) | Data::Text(text) => out.write_all(quoted(text).as_bytes()),
        Data::Flag(yes) => out.write_all(if yes { b"1" } else { b"0" }),
        Data::Float(number) => write!(out, "{number}"),
        Data::Triple(numbers) => write!(out, "{}", Tuple(numbers)),
        Data::Quad(numbers) => write!(out, "{}", Tuple(numbers)),
        Data::File(path) => write!(out, "@{path}@"),
        Data::Ints(numbers) => list(out, numbers.iter()),
        Data::Longs(numbers) => list(out, numbers.iter()),
        Data::Floats(numbers) => list(out, numbers.iter()),
        Data::Pairs(pairs) => list(out, pairs.iter().map(|pair| Tuple(*pair))),
        Data::Triples(triples) => list(out, triples.iter().map(|triple| Tuple(*triple))),
        // The real part comes first in a text and last in memory.
        Data::Turns(turns) => list(out, turns.iter().map(|[x, y, z, real]| Turn([*real, *x, *y, *z]))),
    }
}

/// Numbers in parentheses.
pub struct Tuple<T, const N: usize>(pub [T; N]);

/// A rotation by the bits of half precision, the real part first.
pub struct Turn(pub [u16; 4]);

impl Display for Turn {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(out, "{}", Tuple(self.0.map(|bits| f16::from_bits(bits).to_f32())))
    }
}

impl<T: Display, const N: usize> Display for Tuple<T, N> {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        for (place, number) in self.0.iter().enumerate() {
            write!(out, "{}{number}", if place == 0 { "(" } else { ", " })?;
        }
        write!(out, ")")
    }
}
