//! Elements and texts of an XML file, one after another, as a parser of the XML standard finds them.
//!
//! Nothing but the names of open elements is kept, so a file takes no more memory than what is made of it. Document
//! types, and with them entities, are refused; so are entities that nothing declares, and files that nest deeper than
//! any plant. Places come as line and column. Absent: what the elements mean.

use super::cursor::Cursor;
use super::report::Report;
use super::text::said;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use std::borrow::Cow;

/// How deep elements may stand within one another: an axis of so many internodes, each within the one before.
pub const MOST_DEPTH: usize = 100_000;
/// How many attributes an element may have.
const MOST_ATTRIBUTES: usize = 64;
/// How many characters a name may have.
const LONGEST_NAME: usize = 200;

/// What stands in a file, in its order.
#[derive(Debug)]
pub enum Piece<'a> {
    /// An element begins. Every element also ends.
    Open(Element<'a>),
    /// Characters between elements.
    Text(Cow<'a, str>, usize),
    /// The element that began last and has not ended yet ends.
    Close,
    /// The file ends; all elements have ended.
    End,
}

/// The beginning of an element.
#[derive(Debug)]
pub struct Element<'a> {
    /// Its name.
    pub name: Cow<'a, str>,
    /// The byte at which it begins.
    pub at: usize,
    attributes: Vec<(Cow<'a, str>, Cow<'a, str>)>,
}

impl Element<'_> {
    /// The value of an attribute, whatever the case of its name.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
        found.map(|(_, value)| value.as_ref())
    }
}

/// The pieces of a file.
pub struct Xml<'a> {
    reader: Reader<&'a [u8]>,
    cursor: Cursor<'a>,
    depth: usize,
    /// Whether the file is refused: no piece follows.
    over: bool,
}

impl<'a> Xml<'a> {
    /// The pieces of a text.
    pub fn of(text: &'a str) -> Self {
        let mut reader = Reader::from_str(text);
        reader.config_mut().expand_empty_elements = true;
        Self { reader, cursor: Cursor::of(text), depth: 0, over: false }
    }

    /// Line and column of a byte.
    pub fn place(&mut self, byte: usize) -> (usize, usize) {
        self.cursor.place(byte)
    }

    /// Line and column of what was read last.
    pub fn here(&mut self) -> (usize, usize) {
        self.cursor.place(self.reader.buffer_position() as usize)
    }

    /// The next piece. Where the file is no XML, or asks for what is refused, that is told and [`Piece::End`] follows.
    pub fn next(&mut self, report: &mut Report) -> Piece<'a> {
        while !self.over {
            let at = self.reader.buffer_position() as usize;
            let event = match self.reader.read_event() {
                Ok(event) => event,
                Err(error) => {
                    let at = self.reader.error_position() as usize;
                    return self.refuse(report, at, &format!("this is no XML: {error}"), WELL_FORMED);
                }
            };
            match event {
                Event::Start(start) => return self.open(&start, at, report),
                Event::End(_) => {
                    self.depth = self.depth.saturating_sub(1);
                    return Piece::Close;
                }
                Event::Text(text) => return Piece::Text(text.into_inner(), at),
                Event::CData(text) => return Piece::Text(text.into_inner(), at),
                Event::GeneralRef(name) => return self.resolved(&name, at, report),
                Event::DocType(_) => {
                    return self.refuse(report, at, "the file declares a document type", "no document type");
                }
                Event::Eof => return self.end(at, report),
                Event::Empty(_) | Event::Comment(_) | Event::Decl(_) | Event::PI(_) => {}
            }
        }
        Piece::End
    }

    /// Goes on behind the element that was opened last.
    pub fn skip(&mut self, report: &mut Report) {
        let outside = self.depth.saturating_sub(1);
        while self.depth > outside && !matches!(self.next(report), Piece::End) {}
    }

    /// The characters of the element that was opened last and has none within it, up to its end, with the byte of the
    /// first of them. Elements within it are left out.
    pub fn text(&mut self, report: &mut Report) -> (Cow<'a, str>, usize) {
        let mut whole: Option<(Cow<'a, str>, usize)> = None;
        loop {
            match self.next(report) {
                Piece::Text(text, at) => match &mut whole {
                    Some((known, _)) => known.to_mut().push_str(&text),
                    None => whole = Some((text, at)),
                },
                Piece::Open(_) => self.skip(report),
                Piece::Close | Piece::End => {
                    return whole.unwrap_or_else(|| (Cow::Borrowed(""), self.reader.buffer_position() as usize));
                }
            }
        }
    }

    fn open(&mut self, start: &BytesStart<'a>, at: usize, report: &mut Report) -> Piece<'a> {
        self.depth += 1;
        if self.depth > MOST_DEPTH {
            let expected = format!("at most {MOST_DEPTH} elements within one another");
            return self.refuse(report, at, "elements stand too deep within one another", &expected);
        }
        let name = start.name().as_ref().to_owned();
        let mut attributes = Vec::new();
        for attribute in start.attributes().with_checks(false) {
            let Ok(attribute) = attribute else {
                let expected = "`name=\"value\"` after the name of an element";
                return self.refuse(
                    report,
                    at,
                    &format!("`<{}>` has an attribute without a value", said(&name)),
                    expected,
                );
            };
            let Ok(value) = attribute.normalized_value(XmlVersion::Implicit1_0) else {
                let problem = format!("an attribute of `<{}>` has an entity", said(&name));
                return self.refuse(report, at, &problem, NO_ENTITIES);
            };
            attributes.push((attribute.key.as_ref().to_owned().into(), value.into_owned().into()));
            if attributes.len() > MOST_ATTRIBUTES {
                let expected = format!("at most {MOST_ATTRIBUTES} attributes");
                return self.refuse(report, at, &format!("`<{}>` has too many attributes", said(&name)), &expected);
            }
        }
        if name.is_empty() || name.len() > LONGEST_NAME {
            let expected = format!("a name of 1 to {LONGEST_NAME} bytes");
            return self.refuse(report, at, "an element has no name, or too long a one", &expected);
        }
        Piece::Open(Element { name: name.into(), at, attributes })
    }

    /// A character that is written as an entity.
    fn resolved(&mut self, name: &BytesRef<'a>, at: usize, report: &mut Report) -> Piece<'a> {
        if let Ok(Some(character)) = name.resolve_char_ref() {
            return Piece::Text(Cow::Owned(character.to_string()), at);
        }
        match resolve_predefined_entity(name) {
            Some(text) => Piece::Text(Cow::Borrowed(text), at),
            None => {
                let problem = format!("`&{};` stands for nothing", said(name));
                self.refuse(report, at, &problem, NO_ENTITIES)
            }
        }
    }

    fn end(&mut self, at: usize, report: &mut Report) -> Piece<'a> {
        if self.depth > 0 {
            let problem = format!("the file ends within {} open elements", self.depth);
            return self.refuse(report, at, &problem, WELL_FORMED);
        }
        self.over = true;
        Piece::End
    }

    fn refuse(&mut self, report: &mut Report, at: usize, problem: &str, expected: &str) -> Piece<'a> {
        let place = self.place(at);
        report.fault(place, problem, expected);
        self.over = true;
        self.depth = 0;
        Piece::End
    }
}

const WELL_FORMED: &str = "elements that are closed and values in quotes";
const NO_ENTITIES: &str = "characters themselves, or `&lt;`, `&gt;`, `&amp;`, `&quot;`, `&apos;`";

/// A text as characters of an element or a value in double quotes.
pub fn escaped(text: &str) -> Cow<'_, str> {
    let bad = |c: char| c.is_control() && !matches!(c, '\t' | '\n' | '\r') || matches!(c, '\u{fffe}' | '\u{ffff}');
    if text.contains(bad) {
        let kept: String = text.chars().filter(|c| !bad(*c)).collect();
        return Cow::Owned(quick_xml::escape::escape(kept.as_str()).into_owned());
    }
    quick_xml::escape::escape(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> Vec<String> {
        let mut report = Report::new("x");
        let mut xml = Xml::of(text);
        while !matches!(xml.next(&mut report), Piece::End) {}
        report.faults().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn what_is_refused_has_its_place() {
        let deep = format!("<a>{}", "<b>".repeat(MOST_DEPTH + 3));
        let bad = [
            ("<a>\n <b></a>", "x:2:5: this is no XML"),
            ("<a>\n  <b>", "x:2:6: the file ends within 2 open elements"),
            ("<a>\n&c;</a>", "x:2:1: `&c;` stands for nothing"),
            ("<!DOCTYPE a [<!ENTITY b \"bb\">]>\n<a>&b;</a>", "x:1:1: the file declares a document type"),
            ("<a>\n<b c></b></a>", "x:2:1: `<b>` has an attribute without a value"),
            ("<a b='&c;'/>", "x:1:1: an attribute of `<a>` has an entity"),
            (&deep, "x:1:300001: elements stand too deep"),
        ];
        for (text, starts) in bad {
            let told = told(text);
            assert_eq!(told.len(), 1, "{told:?}");
            assert!(told[0].starts_with(starts), "{told:?}");
        }
        assert!(told("<?xml version='1.0'?><!-- a --><a b='1'>&lt;&#65;<![CDATA[<]]></a>").is_empty());
    }

    #[test]
    fn texts_are_joined_and_elements_skipped() {
        let mut report = Report::new("x");
        let mut xml = Xml::of("<a><b>1 &amp;<c>no</c> 2</b><d><e/>no</d></a>");
        let mut texts = Vec::new();
        loop {
            match xml.next(&mut report) {
                Piece::Open(element) if element.name == "b" => texts.push(xml.text(&mut report).0.into_owned()),
                Piece::Open(element) if element.name == "d" => xml.skip(&mut report),
                Piece::End => break,
                _ => {}
            }
        }
        assert_eq!(texts, ["1 & 2"]);
        assert_eq!(xml.depth, 0);
        assert!(!report.is_refused());
    }

    #[test]
    fn what_is_written_is_read_again() {
        let text = "a<b & \"c\" 'd' \u{1}\u{7}e";
        let file = format!("<a>{}</a>", escaped(text));
        let mut report = Report::new("x");
        let mut xml = Xml::of(&file);
        assert!(matches!(xml.next(&mut report), Piece::Open(_)));
        assert_eq!(xml.text(&mut report).0, "a<b & \"c\" 'd' e");
    }
}
