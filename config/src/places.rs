//! The places of a stand from a CSV file, and the number of plants that a stand implies.
//!
//! The places of the file take the place of its name in the tree, so that a run is grown again without the file; its
//! text is kept among the sources, by which a run knows its inputs. A scenario with a stand that states no `plants` has
//! one plot in each replicate. Absent: what a stand is (`scenario::stand`).

use crate::document::{Entry, Node, Value};
use crate::report::Fault;
use crate::scenario::Stand;
use crate::scenario::stand::MOST_PLANTS;
use crate::solids::Reading;
use crate::source::{SourceId, Span};
use csv::{ReaderBuilder, StringRecord, Trim};
use phytomer_law::fault::Path;

/// The most faults of a file that are told.
const MOST_FAULTS: usize = 20;

/// The columns that a file may have.
const COLUMNS: [&str; 6] = ["x_m", "y_m", "z_m", "species", "sown", "guard"];

/// Replaces the file of the layout of a stand by its places, and states the number of plants where it is left out.
pub(crate) fn fill(node: &mut Node, mut reading: Reading<'_>) {
    fill_layout(node, &mut reading);
    if node.get("plants").is_some() {
        return;
    }
    let (span, plants) = match node.get("stand") {
        // What is refused in the stand is told by the check of its schema, and that it has too many plants by its own.
        Some(stand) => {
            let read = serde_json::from_value::<Stand>(stand.to_json());
            (stand.span, read.map_or(1, |stand| stand.plants().clamp(1, MOST_PLANTS)))
        }
        // Each treatment has the plants of its level; those of the scenario alone are nowhere grown.
        None if has_stands_in_levels(node) => (node.span, 1),
        None => return,
    };
    if let Value::Table(entries) = &mut node.value {
        let value = Node { span, value: Value::Integer(plants as i64) };
        entries.push(Entry { key: "plants".to_owned(), key_span: span, node: value });
    }
}

/// Whether a level of the experiment states a stand.
fn has_stands_in_levels(node: &Node) -> bool {
    let items = |node: &Node, key: &str| node.get(key).map(|list| list.items().to_vec()).unwrap_or_default();
    let factors = node.get("experiment").map(|experiment| items(experiment, "factor")).unwrap_or_default();
    factors.iter().flat_map(|factor| items(factor, "level")).any(|level| level.get("stand").is_some())
}

fn fill_layout(node: &mut Node, reading: &mut Reading<'_>) {
    let Some(layout) = below(node, "stand").and_then(|stand| below(stand, "layout")) else { return };
    let Some((name, span)) = layout.get("file").and_then(|file| Some((file.text()?.to_owned(), file.span))) else {
        return;
    };
    let path = path_of_file();
    if layout.get("at").is_some() {
        let problem = "the layout has a file, and places of its own";
        return reading.faults.push(Fault::new(span, &path, problem, "`file` or `at`"));
    }
    let beside = reading.sources.get(span.source).origin.clone();
    let source = match reading.library.beside(&name, &beside) {
        Ok(source) => source,
        Err(missing) => {
            let fault = Fault::new(span, &path, missing.problem, "a CSV file in the folder of this file");
            return reading.faults.push(fault.suggest(missing.suggestion));
        }
    };
    let text = source.text.clone();
    let id = reading.sources.add(source);
    let mut file = File { id, text: &text, faults: Vec::new() };
    let mut places = file.places();
    if places.is_empty() {
        // What is wrong is told, and a single place takes the place of all, so that nothing else is told of them.
        places.push(Node { span, value: Value::Table(Vec::new()) });
    }
    reading.faults.append(&mut file.faults);
    layout.remove("file");
    if let Value::Table(entries) = &mut layout.value {
        entries.push(Entry { key: "at".to_owned(), key_span: span, node: Node { span, value: Value::Array(places) } });
    }
}

/// The path of the key that names the file.
fn path_of_file() -> Path {
    Path::root().key("stand").key("layout").key("file")
}

/// The value of a key of a table.
fn below<'n>(node: &'n mut Node, key: &str) -> Option<&'n mut Node> {
    match &mut node.value {
        Value::Table(entries) => entries.iter_mut().find(|entry| entry.key == key).map(|entry| &mut entry.node),
        _ => None,
    }
}

/// A file of places while it is read.
struct File<'t> {
    id: SourceId,
    text: &'t str,
    faults: Vec<Fault>,
}

impl File<'_> {
    fn fault(&mut self, span: Span, problem: String, expected: impl Into<String>) {
        if self.faults.len() < MOST_FAULTS {
            self.faults.push(Fault::new(span, &path_of_file(), problem, expected));
        }
    }

    /// The line that begins at a byte, without its end.
    fn line_at(&self, byte: usize) -> Span {
        let start = byte.min(self.text.len());
        let rest = self.text.get(start..).unwrap_or_default();
        // The position of a record is that before the ends of lines that are skipped.
        let start = start + rest.len() - rest.trim_start_matches(['\r', '\n']).len();
        let rest = self.text.get(start..).unwrap_or_default();
        let end = start + rest.find(['\r', '\n']).unwrap_or(rest.len());
        Span { source: self.id, start, end }
    }

    /// Where a cell stands; the whole line where quotes hide it.
    fn cell(&self, line: Span, column: usize) -> Span {
        let text = self.text.get(line.start..line.end).unwrap_or_default();
        if text.contains('"') {
            return line;
        }
        let mut cells = text.split(',').scan(line.start, |from, cell| {
            let start = *from;
            *from += cell.len() + 1;
            Some((start, cell))
        });
        cells.nth(column).map_or(line, |(start, cell)| {
            let lead = cell.len() - cell.trim_start().len();
            Span { start: start + lead, end: (start + cell.trim_end().len()).max(start + lead), ..line }
        })
    }

    fn places(&mut self) -> Vec<Node> {
        let mut reader =
            ReaderBuilder::new().flexible(true).trim(Trim::All).comment(Some(b'#')).from_reader(self.text.as_bytes());
        let header = match reader.headers() {
            Ok(header) => header.clone(),
            Err(error) => {
                self.fault(self.line_at(0), format!("the file cannot be read: {error}"), "CSV in UTF-8");
                return Vec::new();
            }
        };
        let line = self.line_at(header.position().map_or(0, |position| position.byte() as usize));
        if !self.knows(&header, line) {
            return Vec::new();
        }
        let mut places = Vec::new();
        for record in reader.records() {
            match record {
                Ok(record) => places.extend(self.place(&header, &record)),
                Err(error) => {
                    let byte = error.position().map_or(0, |position| position.byte() as usize);
                    self.fault(self.line_at(byte), format!("the line cannot be read: {error}"), "CSV in UTF-8");
                }
            }
        }
        if places.is_empty() && self.faults.is_empty() {
            self.fault(line, "the file has no places".to_owned(), "a line below the names for each plant");
        }
        places
    }

    /// Whether the columns are known, each once, with both coordinates.
    fn knows(&mut self, header: &StringRecord, line: Span) -> bool {
        for (number, name) in header.iter().enumerate() {
            if !COLUMNS.contains(&name) {
                let expected = format!("one of {}", COLUMNS.join(", "));
                self.fault(self.cell(line, number), format!("there is no column `{name}` of places"), expected);
            } else if header.iter().take(number).any(|known| known == name) {
                self.fault(
                    self.cell(line, number),
                    format!("the column `{name}` stands twice"),
                    "one column of a name",
                );
            }
        }
        for name in ["x_m", "y_m"].iter().filter(|name| header.iter().all(|known| known != **name)) {
            self.fault(line, format!("the column `{name}` is missing"), "the columns `x_m` and `y_m`, in metres");
        }
        self.faults.is_empty()
    }

    fn place(&mut self, header: &StringRecord, record: &StringRecord) -> Option<Node> {
        let line = self.line_at(record.position().map_or(0, |position| position.byte() as usize));
        if record.len() != header.len() {
            let problem = format!("the line has {} cells, and {} columns are named", record.len(), header.len());
            self.fault(line, problem, "as many cells as names");
            return None;
        }
        let mut entries = Vec::new();
        for (column, (name, cell)) in header.iter().zip(record.iter()).enumerate() {
            let span = self.cell(line, column);
            let value = match name {
                "species" if cell.is_empty() => continue,
                "sown" | "z_m" | "guard" if cell.is_empty() => continue,
                "species" => Some(Value::Text(cell.to_owned())),
                "sown" => cell.parse().ok().filter(|tick| (0..=65_534).contains(tick)).map(Value::Integer),
                "guard" => cell.parse().ok().map(Value::Boolean),
                _ => cell.parse().ok().filter(|metres: &f64| metres.abs() <= 1e5).map(Value::Float),
            };
            match value {
                Some(value) => {
                    entries.push(Entry { key: name.to_owned(), key_span: span, node: Node { span, value } });
                }
                None => {
                    let expected = match name {
                        "sown" => "a tick in [0, 65534]",
                        "guard" => "`true` or `false`",
                        _ => "metres in [-100000, 100000]",
                    };
                    self.fault(span, format!("the {name} of the place is `{cell}`"), expected);
                }
            }
        }
        Some(Node { span: line, value: Value::Table(entries) })
    }
}
