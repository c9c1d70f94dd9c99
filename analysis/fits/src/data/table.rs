//! A table of texts with named columns, and what is wrong with it.
//!
//! Comma-separated values are read by the crate csv; every row has as many cells as the header. Faults are collected,
//! at most [`MOST_FAULTS`] of them, each with file and line. Absent: the meaning of a column.

use std::fmt;

/// The most faults that are told of one table.
pub const MOST_FAULTS: usize = 20;

/// What is wrong with a file of data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The file.
    pub file: String,
    /// The line from 1; for tables without lines the row from 1.
    pub line: Option<u64>,
    /// The character of the line, from 1, where it is known.
    pub column: Option<u64>,
    /// What is wrong.
    pub problem: String,
    /// What was expected, and what to do.
    pub expected: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, column, problem, expected } = self;
        write!(f, "{file}:")?;
        for place in [line, column].into_iter().flatten() {
            write!(f, "{place}:")?;
        }
        write!(f, " {problem}; expected {expected}")
    }
}

/// A table.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The name of its file, for messages.
    pub file: String,
    /// The names of its columns.
    pub names: Vec<String>,
    /// The line of each row, and its cells.
    pub rows: Vec<(u64, Vec<String>)>,
}

impl Table {
    /// Reads comma-separated values with a header. A byte order mark and blanks around cells are passed over; a line
    /// that begins with `#` is a comment.
    ///
    /// # Errors
    /// No header, two columns of one name, ragged lines, text that is not UTF-8.
    pub fn from_csv(file: &str, bytes: &[u8]) -> Result<Self, Vec<Fault>> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let fault = |line, problem: String, expected: &str| Fault {
            file: file.to_owned(),
            line,
            column: None,
            problem,
            expected: expected.to_owned(),
        };
        let mut reader =
            csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).comment(Some(b'#')).from_reader(bytes);
        let header =
            reader.headers().map_err(|error| vec![fault(None, in_words(&error), "a table of text in UTF-8")])?;
        let names: Vec<String> = header.iter().map(str::to_owned).collect();
        if names.is_empty() || names.iter().all(String::is_empty) {
            return Err(vec![fault(
                Some(1),
                "there is no header".to_owned(),
                "the names of the columns in the first line",
            )]);
        }
        let line_of_names = header.position().map_or(1, csv::Position::line);
        if let Some(twice) = names.iter().enumerate().find(|(place, name)| names[..*place].contains(name)) {
            let problem = format!("two columns are named `{}`", twice.1);
            return Err(vec![fault(Some(line_of_names), problem, "a name of its own for each column")]);
        }
        let (mut rows, mut faults) = (Vec::new(), Vec::new());
        for record in reader.records() {
            match record {
                Ok(record) if record.len() == names.len() => {
                    let line = record.position().map_or(0, csv::Position::line);
                    rows.push((line, record.iter().map(str::to_owned).collect()));
                }
                Ok(record) => {
                    let problem = format!("{} cells under {} names", record.len(), names.len());
                    let line = record.position().map(csv::Position::line);
                    let expected = "a cell for each column; leave it empty where nothing was measured";
                    let last = record.len().min(names.len() + 1).saturating_sub(1);
                    let column = line.and_then(|line| column_of(bytes, line, last));
                    faults.push(Fault { column, ..fault(line, problem, expected) });
                }
                Err(error) => {
                    let line = error.position().map(csv::Position::line);
                    faults.push(fault(line, in_words(&error), "a table of text in UTF-8"));
                }
            }
            if faults.len() >= MOST_FAULTS {
                break;
            }
        }
        if rows.is_empty() && faults.is_empty() {
            faults.push(fault(
                None,
                "there are no rows below the header".to_owned(),
                "a row for each plant, axis or bud",
            ));
        }
        if faults.is_empty() { Ok(Self { file: file.to_owned(), names, rows }) } else { Err(faults) }
    }

    /// The rows whose cell in a column is this text.
    ///
    /// # Errors
    /// The table has no such column, or no such row.
    pub fn only(mut self, column: &str, text: &str) -> Result<Self, Fault> {
        let place = self.column(column)?;
        self.rows.retain(|(_, cells)| cells[place] == text);
        if self.rows.is_empty() {
            let problem = format!("no row has `{text}` in the column `{column}`: the group is empty");
            return Err(self.fault(None, problem, "a value that occurs in the column"));
        }
        Ok(self)
    }

    /// The place of a column.
    ///
    /// # Errors
    /// There is none; the nearest name is told.
    pub fn column(&self, name: &str) -> Result<usize, Fault> {
        self.find(name).ok_or_else(|| {
            let near = nearest(name, &self.names).map_or_else(String::new, |near| format!("; the nearest is `{near}`"));
            let problem = format!("there is no column `{name}`");
            self.fault(None, problem, &format!("it among the columns {}{near}", self.names.join(", ")))
        })
    }

    /// The place of a column that may be absent.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|own| own == name)
    }

    /// A fault of this table.
    pub fn fault(&self, line: Option<u64>, problem: impl Into<String>, expected: &str) -> Fault {
        Fault { file: self.file.clone(), line, column: None, problem: problem.into(), expected: expected.to_owned() }
    }
}

/// The character, from 1, at which a cell of a line of comma-separated values begins; `None` where there is none, or
/// where the cells of the row do not stand on one line.
pub fn column_of(bytes: &[u8], line: u64, cell: usize) -> Option<u64> {
    let at = usize::try_from(line).ok()?.checked_sub(1)?;
    let text = std::str::from_utf8(bytes.split(|byte| *byte == b'\n').nth(at)?).ok()?;
    let (mut quoted, mut passed, mut is_blank) = (false, 0, true);
    for (column, letter) in (1..).zip(text.trim_start_matches('\u{feff}').chars()) {
        if passed == cell && is_blank && !letter.is_whitespace() {
            return Some(column);
        }
        match letter {
            '"' => quoted = !quoted,
            ',' if !quoted => {
                passed += 1;
                is_blank = true;
                continue;
            }
            _ => {}
        }
        is_blank = is_blank && letter.is_whitespace();
    }
    // An empty cell at the end of the line.
    (passed == cell).then(|| text.trim_end().chars().count() as u64 + 1)
}

fn in_words(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Utf8 { .. } => "the bytes are no text in UTF-8".to_owned(),
        _ => error.to_string(),
    }
}

/// The name of the fewest edits, if a third of the letters or fewer differ.
fn nearest<'a>(name: &str, names: &'a [String]) -> Option<&'a str> {
    let by_edits = names.iter().map(|own| (edits(&name.to_lowercase(), &own.to_lowercase()), own));
    let (edits, own) = by_edits.min_by_key(|(edits, _)| *edits)?;
    (edits * 3 <= name.chars().count().max(3)).then_some(own.as_str())
}

/// Levenshtein's distance.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().take(64).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().take(64).enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let next = (corner + usize::from(x != *y)).min(row[j] + 1).min(row[j + 1] + 1);
            corner = row[j + 1];
            row[j + 1] = next;
        }
    }
    row[b.len()]
}
