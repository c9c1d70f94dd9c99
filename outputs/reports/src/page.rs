//! A report, and its page: one HTML file without script that asks for nothing beyond itself.
//!
//! Its policy of content allows inline styles and pictures within the file, and nothing else. Each figure has its words
//! for those who do not see it, and its numbers as a table and as CSV. Absent: what is reported.

use super::chart::Plotted;
use super::drawn::svg;
use super::escape::{address, text};
use super::table::Table;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write as _;

/// What is allowed in a page.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";
const STYLE: &str = include_str!("page.css");

/// A figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// A name of letters, digits, `_` and `-`, of its own in the report: that of its files.
    pub id: String,
    /// What it shows, a line.
    pub title: String,
    /// What is to be read from it: how intervals are made, how many plants there are.
    pub caption: String,
    /// What somebody sees in it, for those who do not see it.
    pub words: String,
    /// Its data.
    pub plotted: Plotted,
}

/// A picture in the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// The file, as PNG.
    pub png: Vec<u8>,
    /// Below it.
    pub caption: String,
    /// What somebody sees in it.
    pub words: String,
}

/// A part of a section.
#[derive(Debug, Clone, PartialEq)]
pub enum Part {
    /// A paragraph.
    Text(String),
    /// A figure.
    Figure(Figure),
    /// A picture.
    Picture(Picture),
    /// A table with its caption.
    Table(String, Table),
}

/// Parts under a heading.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The heading.
    pub heading: String,
    /// The parts.
    pub parts: Vec<Part>,
}

/// A report.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Its title.
    pub title: String,
    /// Below the title.
    pub about: String,
    /// The sections.
    pub sections: Vec<Section>,
}

impl Report {
    /// Its figures, in their order.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.sections.iter().flat_map(|section| &section.parts).filter_map(|part| match part {
            Part::Figure(figure) => Some(figure),
            _ => None,
        })
    }
}

/// The page of a report.
pub fn page(report: &Report) -> String {
    let title = text(&report.title);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n<p>{}</p>\n</header>\n",
        text(&report.about)
    );
    out += "<nav aria-label=\"Contents\"><ol>";
    for (place, section) in report.sections.iter().enumerate() {
        let _ = write!(out, "<li><a href=\"#section-{place}\">{}</a></li>", text(&section.heading));
    }
    out += "</ol></nav>\n<main>\n";
    let mut number = 0;
    for (place, section) in report.sections.iter().enumerate() {
        let _ = writeln!(out, "<section id=\"section-{place}\">\n<h2>{}</h2>", text(&section.heading));
        for part in &section.parts {
            put(part, &mut number, &mut out);
        }
        out += "</section>\n";
    }
    out + "</main>\n</body>\n</html>\n"
}

fn put(part: &Part, number: &mut u32, out: &mut String) {
    let _ = match part {
        Part::Text(words) => writeln!(out, "<p>{}</p>", text(words)),
        Part::Table(caption, table) => {
            writeln!(
                out,
                "<figure class=\"table\">\n<figcaption>{}</figcaption>\n{}\n</figure>",
                text(caption),
                table.html()
            )
        }
        Part::Picture(Picture { png, caption, words }) => writeln!(
            out,
            "<figure>\n<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n<figcaption>{}</figcaption>\n</figure>",
            text(words),
            STANDARD.encode(png),
            text(caption)
        ),
        Part::Figure(figure) => {
            *number += 1;
            writeln!(out, "{}", of_figure(figure, *number))
        }
    };
}

fn of_figure(figure: &Figure, number: u32) -> String {
    let Figure { id, title, caption, words, plotted } = figure;
    let drawn = svg(plotted, id, title, words)
        .unwrap_or_else(|| "<p class=\"lack\">Nothing can be drawn: no value is known.</p>".to_owned());
    let table = plotted.table();
    let csv = table.csv();
    format!(
        "<figure id=\"{}\">\n{drawn}\n<figcaption><strong>Figure {number}. {}.</strong> {}</figcaption>\n\
         <details>\n<summary>The numbers of figure {number}</summary>\n\
         <p><a download=\"{}.csv\" href=\"data:text/csv;charset=utf-8,{}\">{}.csv</a></p>\n<pre>{}</pre>\n</details>\n</figure>",
        text(id),
        text(title),
        text(caption),
        text(id),
        address(&csv),
        text(id),
        text(&csv.replace("\r\n", "\n"))
    )
}
