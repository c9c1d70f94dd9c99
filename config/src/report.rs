//! All faults of a validation at once, for people (source lines with the offending text underlined) and for programs.
//!
//! The order is fixed: by file in the order of reading, then line, then column. One fault a place and problem: a
//! default that eight orders inherit is shown once.
//! Absent: what is a fault. That is the parser's, the schema's and the models' to say.

use std::fmt::Write as _;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use phytomer_models::fault::Path;
use serde::Serialize;

use crate::source::{Sources, Span};

/// People stop reading long before; `--json` has them all.
const SHOWN: usize = 50;

/// One thing that is wrong, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Where; `None` when a file could not be read at all.
    pub span: Option<Span>,
    /// The value's place in the file's tree.
    pub path: Path,
    /// What is wrong.
    pub problem: String,
    /// What would be right.
    pub expected: String,
    /// The nearest spelling that would be right.
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

    /// The same with a nearest spelling, where there is one.
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
    /// Place in the tree, `order[1].death`.
    pub path: String,
    /// What is wrong.
    pub problem: String,
    /// What would be right.
    pub expected: String,
    /// The nearest spelling, if one is near.
    pub suggestion: Option<String>,
}

/// Why a scenario or a species cannot be used: every fault, in order.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{}", self.summary())]
pub struct Report {
    /// The texts that the faults point into.
    pub sources: Sources,
    /// At least one fault.
    pub faults: Vec<Fault>,
}

impl Report {
    /// Sorts the faults and drops repetitions.
    pub fn new(sources: Sources, mut faults: Vec<Fault>) -> Self {
        faults.sort_by(|a, b| (a.span, &a.problem, &a.path).cmp(&(b.span, &b.problem, &b.path)));
        faults.dedup_by(|b, a| a.span.is_some() && a.span == b.span && a.problem == b.problem);
        Self { sources, faults }
    }

    /// "3 faults in 2 files".
    pub fn summary(&self) -> String {
        let mut files: Vec<_> = self.faults.iter().filter_map(|f| f.span.map(|s| s.source)).collect();
        files.sort();
        files.dedup();
        let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let faults = count(self.faults.len(), "fault");
        if files.is_empty() { faults } else { format!("{faults} in {}", count(files.len(), "file")) }
    }

    /// The report for people; `color` where a terminal wants it.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let renderer = renderer.decor_style(DecorStyle::Ascii).term_width(120);
        let mut out = String::new();
        for fault in self.faults.iter().take(SHOWN) {
            self.render_one(&renderer, fault, &mut out);
        }
        if self.faults.len() > SHOWN {
            let _ = writeln!(out, "… and {} more (--json shows them all)\n", self.faults.len() - SHOWN);
        }
        let _ = writeln!(out, "{}", self.summary());
        out
    }

    fn render_one(&self, renderer: &Renderer, fault: &Fault, out: &mut String) {
        let title = Level::ERROR.primary_title(&fault.problem);
        let mut group = match fault.span {
            None => annotate_snippets::Group::with_title(title),
            Some(span) => {
                let source = self.sources.get(span.source);
                let underline = AnnotationKind::Primary.span(self.sources.first_line(span));
                title.element(Snippet::source(&*source.text).path(&source.name).annotation(underline))
            }
        };
        if !fault.expected.is_empty() {
            group = group.element(Level::NOTE.with_name("expected").message(clean(&fault.expected)));
        }
        if let Some(suggestion) = &fault.suggestion {
            group = group.element(Level::HELP.message(format!("did you mean `{}`?", clean(suggestion))));
        }
        let _ = writeln!(out, "{}\n", renderer.render(&[group]));
    }

    /// The report for programs.
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

/// A file's text must not steer the terminal.
fn clean(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).collect()
}
