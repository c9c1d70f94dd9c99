//! All faults of a validation in one report, for people (source lines with the faulty text underlined) and for
//! programs.
//!
//! The order is fixed: by file in the order of reading, then by line, then by column. A fault with equal place and
//! problem is shown once, such as a fault in a default that eight orders inherit. Absent: finding faults, which the
//! parser, the schema and the models do.

use std::fmt::Write as _;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet, Title};
use phytomer_law::fault::Path;
use serde::Serialize;

use crate::source::{Sources, Span};

/// The most faults in a report for people; `--json` has all of them.
const SHOWN: usize = 50;

/// The most faults that are collected. A file with more is not a parameter file, and its check stops.
pub(crate) const MOST_FAULTS: usize = 1000;

/// The longest line that is shown whole; of a longer line only the part around the fault is shown.
const LONGEST_LINE: usize = 2000;

/// One fault of a file, and its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The place in the text; `None` where a file could not be read at all.
    pub span: Option<Span>,
    /// The path of the value in the file's tree.
    pub path: Path,
    /// What is wrong.
    pub problem: String,
    /// What was expected.
    pub expected: String,
    /// The allowed word nearest in spelling, where there is one.
    pub suggestion: Option<String>,
}

impl Fault {
    /// A fault at a place.
    pub fn new(span: Span, path: &Path, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            span: Some(span),
            path: path.clone(),
            problem: problem.into(),
            expected: expected.into(),
            suggestion: None,
        }
    }

    /// The fault with a suggested spelling, where there is one.
    pub fn suggest(mut self, suggestion: Option<impl Into<String>>) -> Self {
        self.suggestion = suggestion.map(Into::into);
        self
    }
}

/// A fault as `--json` gives it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FaultRecord {
    /// The file, or `preset:name`.
    pub file: Option<String>,
    /// Line from 1.
    pub line: Option<usize>,
    /// Column from 1, in characters.
    pub column: Option<usize>,
    /// Path of the value in the file's tree, such as `order[1].death`.
    pub path: String,
    /// What is wrong.
    pub problem: String,
    /// What was expected.
    pub expected: String,
    /// The allowed word nearest in spelling, where there is one.
    pub suggestion: Option<String>,
}

/// Why a scenario or a species cannot be used: every fault, in order.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{}", self.summary())]
pub struct Report {
    /// The texts that the faults point into.
    pub sources: Sources,
    /// At least one fault, at most a thousand.
    pub faults: Vec<Fault>,
}

impl Report {
    /// Makes a report: sorts the faults and drops repetitions, in O(n log n).
    pub fn new(sources: Sources, mut faults: Vec<Fault>) -> Self {
        faults.sort_by(|a, b| (a.span, &a.problem, &a.path).cmp(&(b.span, &b.problem, &b.path)));
        faults.dedup_by(|b, a| a.span.is_some() && a.span == b.span && a.problem == b.problem);
        faults.truncate(MOST_FAULTS);
        Self { sources, faults }
    }

    /// The number of faults and of files in words, such as "3 faults in 2 files".
    pub fn summary(&self) -> String {
        let mut files: Vec<_> = self.faults.iter().filter_map(|f| f.span.map(|s| s.source)).collect();
        files.sort();
        files.dedup();
        let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let least = if self.faults.len() == MOST_FAULTS { "at least " } else { "" };
        let faults = format!("{least}{}", count(self.faults.len(), "fault"));
        if files.is_empty() { faults } else { format!("{faults} in {}", count(files.len(), "file")) }
    }

    /// The report for people, in lines of text; with `color` it has terminal colours. At most fifty faults are shown.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let renderer = renderer.decor_style(DecorStyle::Ascii).term_width(120);
        let mut out = String::new();
        for fault in self.faults.iter().take(SHOWN) {
            self.render_one(&renderer, fault, &mut out);
        }
        if self.faults.len() > SHOWN {
            let _ = writeln!(out, "… and {} more (--json shows them)\n", self.faults.len() - SHOWN);
        }
        let _ = writeln!(out, "{}", self.summary());
        out
    }

    fn render_one(&self, renderer: &Renderer, fault: &Fault, out: &mut String) {
        let title = Level::ERROR.primary_title(&fault.problem);
        let mut group = match fault.span {
            None => Group::with_title(title),
            Some(span) => self.underline(title, span),
        };
        if !fault.expected.is_empty() {
            group = group.element(Level::NOTE.with_name("expected").message(clean(&fault.expected)));
        }
        if let Some(suggestion) = &fault.suggestion {
            group = group.element(Level::HELP.message(format!("did you mean `{}`?", clean(suggestion))));
        }
        let shown = renderer.render(&[group]);
        // A snippet without a path of its own (a long line's) has an empty line in its place.
        let lines = shown.lines().filter(|line| line.trim() != ":::");
        lines.for_each(|line| _ = writeln!(out, "{line}"));
        out.push('\n');
    }

    /// The title above the line where `span` begins.
    fn underline<'a>(&'a self, title: Title<'a>, span: Span) -> Group<'a> {
        let source = self.sources.get(span.source);
        let (start, line) = self.sources.line_text(span);
        let underlined = self.sources.first_line(span);
        let within = |at: usize| at.saturating_sub(start).min(line.len());
        let (from, to) = (within(underlined.start), within(underlined.end));
        let (line_number, column) = self.sources.place(span);
        if line.len() <= LONGEST_LINE {
            let snippet = Snippet::source(line).line_start(line_number).path(&source.name);
            return title.element(snippet.annotation(AnnotationKind::Primary.span(from..to)));
        }
        let (left, right) = (line.floor_char_boundary(from.saturating_sub(60)), line.floor_char_boundary(to + 60));
        let origin = Origin::path(&source.name).line(line_number).char_column(column);
        let snippet = Snippet::source(&line[left..right]).line_start(line_number);
        title.element(origin).element(snippet.annotation(AnnotationKind::Primary.span(from - left..to - left)))
    }

    /// The report for programs: one record per fault, all of them.
    pub fn records(&self) -> Vec<FaultRecord> {
        self.faults.iter().map(|fault| self.record(fault)).collect()
    }

    fn record(&self, fault: &Fault) -> FaultRecord {
        let place = fault.span.map(|span| self.sources.place(span));
        FaultRecord {
            file: fault.span.map(|span| self.sources.get(span.source).name.clone()),
            line: place.map(|(line, _)| line),
            column: place.map(|(_, column)| column),
            path: fault.path.to_string(),
            problem: fault.problem.clone(),
            expected: fault.expected.clone(),
            suggestion: fault.suggestion.clone(),
        }
    }
}

/// Removes control characters, so that the text of a file cannot control the terminal.
fn clean(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).collect()
}
