//! The texts that a validation reads, one [`Source`] per file, and byte ranges ([`Span`]) in them.
//!
//! A value keeps its span through inheritance and merging, so that a late fault is still shown in the file and at the
//! column where the value was typed. Lines and columns are counted only when a fault is shown; columns count characters
//! from 1, as editors do.

use std::sync::Arc;

/// The origin of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// A file of the user, by the path under which it was found.
    File(std::path::PathBuf),
    /// A preset that ships with the program, by its name (`gmt1/5a`).
    Preset(String),
    /// A text that a calling program passed, by the name that the program gave it.
    Memory(String),
}

/// One text that was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The name in messages: the path as it was typed, `preset:coffee`, or the name of a text in memory.
    pub name: String,
    /// Its origin.
    pub origin: Origin,
    /// The whole text, as read.
    pub text: Arc<str>,
    /// The bytes of the file, where they are not those of the text: a weather file need not be UTF-8.
    pub bytes: Option<Arc<[u8]>>,
}

/// The number of a text among the [`Sources`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SourceId(pub u32);

/// A range of bytes in a source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The text that the span lies in.
    pub source: SourceId,
    /// The first byte, from 0.
    pub start: usize,
    /// The byte after the last.
    pub end: usize,
}

/// Every text read so far, in the order of reading.
#[derive(Debug, Clone, Default)]
pub struct Sources(Vec<(Source, Arc<[usize]>)>);

impl Sources {
    /// Keeps a text and returns its id, which stays valid. A text that is added again, as an ancestor of two species,
    /// is kept once.
    pub fn add(&mut self, source: Source) -> SourceId {
        if let Some(known) = self.iter().position(|known| *known == source) {
            return SourceId(known as u32);
        }
        let line_starts = line_starts(&source.text);
        self.0.push((source, line_starts));
        SourceId(self.0.len() as u32 - 1)
    }

    /// The text with an id that [`Sources::add`] returned.
    pub fn get(&self, id: SourceId) -> &Source {
        &self.0[id.0 as usize].0
    }

    /// All texts, in the order of reading.
    pub fn iter(&self) -> impl Iterator<Item = &Source> {
        self.0.iter().map(|(source, _)| source)
    }

    /// The line of the first byte of `span`, from 1.
    pub fn line(&self, span: Span) -> usize {
        self.0[span.source.0 as usize].1.partition_point(|start| *start <= span.start)
    }

    /// Line and column of the first byte of `span`, both from 1, the column in characters.
    pub fn place(&self, span: Span) -> (usize, usize) {
        let (line, text) = (self.line(span), &self.get(span.source).text);
        let start = self.0[span.source.0 as usize].1[line - 1];
        (line, text[start..floor_boundary(text, span.start)].chars().count() + 1)
    }

    /// The text of the line where `span` begins, and where that line begins.
    pub fn line_text(&self, span: Span) -> (usize, &str) {
        let starts = &self.0[span.source.0 as usize].1;
        let (line, text) = (self.line(span), &self.get(span.source).text);
        let end = starts.get(line).copied().unwrap_or(text.len());
        (starts[line - 1], text[starts[line - 1]..end].trim_end_matches(['\n', '\r']))
    }

    /// The bytes that are underlined: the part of `span` on its first line, at most 80 bytes, up to a whole character.
    pub fn first_line(&self, span: Span) -> std::ops::Range<usize> {
        let text = &self.get(span.source).text;
        let start = floor_boundary(text, span.start);
        let end = floor_boundary(text, span.end.min(start + 80)).max(start);
        let line = text[start..end].find(['\n', '\r']).map_or(end, |n| start + n);
        start..line
    }
}

/// Where each line begins. A text without any LF has lines that end with CR, as old weather files do.
fn line_starts(text: &str) -> Arc<[usize]> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    [0].into_iter().chain(text.match_indices(end).map(|(at, _)| at + 1)).collect()
}

/// The last character boundary at or before `at`.
fn floor_boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Whether the name of a file in a folder leads to no place outside the folder.
pub(crate) fn stays_inside(name: &str) -> bool {
    let path = std::path::Path::new(name);
    path.components().all(|part| matches!(part, std::path::Component::Normal(_) | std::path::Component::CurDir))
}

/// The folder of the species that an origin names; of a preset the part of its name before the last `/`.
pub(crate) fn folder_of(origin: &Origin) -> &str {
    match origin {
        Origin::Preset(name) => name.rsplit_once('/').map_or("", |(folder, _)| folder),
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let mut sources = Sources::default();
        let text = "a = 1\nβ = \"é\" # x\n";
        let id = sources.add(Source {
            name: "t".into(),
            origin: Origin::Preset("t".into()),
            text: text.into(),
            bytes: None,
        });
        let start = text.find('#').unwrap();
        assert_eq!(sources.place(Span { source: id, start, end: start + 1 }), (2, 9));
        let past = Span { source: id, start: 999, end: 1000 };
        assert_eq!(sources.place(past), (3, 1));
        assert_eq!(sources.line_text(Span { source: id, start, end: start }), (6, "β = \"é\" # x"));
        assert_eq!(sources.line_text(past), (text.len(), ""));
        assert_eq!(sources.first_line(Span { source: id, start: 0, end: 999 }), 0..5);
    }
}
