//! The XML of Arbaro and of Helios' library: the trees of a file, each with its keys.
//!
//! An XML parser reads the text; document types, and with them entities, are refused. Helios writes
//! `<?xml version=1.0?>` without quotes, which is no XML: declarations are passed over. Absent: what the keys mean.

use crate::fault::{Wrong, said};
use crate::format::Format;
use crate::value::{Entry, Node, Value};
use roxmltree::{Document, Error as Early, ParsingOptions, TextPos};
use std::ops::Range;

/// So many nodes may a document have.
const MOST_NODES: u32 = 200_000;

/// A tree of a file.
pub(crate) struct Tree {
    /// What the file calls it.
    pub label: Option<String>,
    /// Its keys.
    pub entries: Vec<Entry>,
}

/// The trees of a document, and whose they are.
pub(crate) fn trees(text: &str) -> Result<(Format, Vec<Tree>), Wrong> {
    let blank = without_declaration(text);
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, entity_resolver: None };
    let document = Document::parse_with_options(&blank, options).map_err(|error| wrong(text, &error))?;
    let root = document.root_element();
    match root.tag_name().name() {
        "arbaro" => Ok((Format::Arbaro, children(root, "species").map(arbaro).collect::<Result<_, _>>()?)),
        "helios" => Ok((
            Format::Helios,
            children(root, "WeberPennTree").map(|tree| Ok(helios(tree))).collect::<Result<_, _>>()?,
        )),
        other => {
            let problem = format!("`<{}>` is neither Arbaro's nor Helios'", said(other));
            Err(Wrong::new(head(root), problem, "`<arbaro>` or `<helios>` around all"))
        }
    }
}

/// The text with blanks for its declaration, so that all places stay.
fn without_declaration(text: &str) -> String {
    let start = text.len() - text.trim_start().len();
    let end = text[start..].starts_with("<?xml").then(|| text[start..].find("?>")).flatten();
    match end {
        Some(end) => {
            let blank = |c: char| std::iter::repeat_n(if c == '\n' { '\n' } else { ' ' }, c.len_utf8());
            let until = start + end + 2;
            text[..until].chars().flat_map(blank).chain(text[until..].chars()).collect()
        }
        None => text.to_owned(),
    }
}

fn wrong(text: &str, error: &roxmltree::Error) -> Wrong {
    if matches!(error, roxmltree::Error::DtdDetected) {
        // The parser tells no place of it.
        let at = text.find("<!DOCTYPE").unwrap_or(0);
        let expected = "no document type: entities are not expanded";
        return Wrong::new(at..(at + 9).min(text.len()), "the file declares a document type", expected);
    }
    // An end that comes too soon has the place of the beginning.
    let ends = matches!(error, Early::UnclosedRootNode | Early::NoRootNode | Early::UnexpectedEndOfStream);
    let TextPos { row, col } = if ends { TextPos::new(u32::MAX, 1) } else { error.pos() };
    let line = text.split_inclusive('\n').take((row as usize).saturating_sub(1)).map(str::len).sum::<usize>();
    let within = text.get(line..).unwrap_or("").chars().take((col as usize).saturating_sub(1)).map(char::len_utf8);
    let at = (line + within.sum::<usize>()).min(text.len());
    let told = error.to_string();
    // The parser ends its words with the place, which stands before them here.
    let told = told.split(" at ").next().unwrap_or(&told);
    Wrong::new(
        at..at,
        format!("this is no XML: {told}"),
        "elements that are closed, values in quotes, and no document type",
    )
}

type Element<'a, 'i> = roxmltree::Node<'a, 'i>;

fn children<'a, 'i>(of: Element<'a, 'i>, name: &'static str) -> impl Iterator<Item = Element<'a, 'i>> {
    of.children().filter(move |child| child.is_element() && child.tag_name().name() == name)
}

/// The bytes of `<name`.
fn head(element: Element<'_, '_>) -> Range<usize> {
    let start = element.range().start;
    start..start + 1 + element.tag_name().name().len()
}

/// A species of Arbaro: `<param name="…" value="…"/>`.
fn arbaro(species: Element<'_, '_>) -> Result<Tree, Wrong> {
    let mut entries = Vec::new();
    for param in children(species, "param") {
        let attribute = |name: &str| param.attribute_node(name);
        let (Some(name), Some(value)) = (attribute("name"), attribute("value")) else {
            let expected = "`name` and `value` of a parameter";
            return Err(Wrong::new(head(param), "an attribute of this `<param>` is missing", expected));
        };
        let node = Node { value: written(value.value()), bytes: value.range_value() };
        entries.push(Entry { key: name.value().to_owned(), at: name.range_value(), node });
    }
    Ok(Tree { label: species.attribute("name").map(str::to_owned), entries })
}

/// A tree of Helios' library: `<nCurve> 1 2 3 4 </nCurve>`.
fn helios(tree: Element<'_, '_>) -> Tree {
    let entry = |element: Element<'_, '_>| {
        let text = element.children().find(roxmltree::Node::is_text);
        let bytes = text.map_or(head(element), |text| text.range());
        let words = text.and_then(|text| text.text()).unwrap_or("").split_whitespace();
        let mut values: Vec<Node> = words.map(|word| Node { value: written(word), bytes: bytes.clone() }).collect();
        let value = if values.len() == 1 { values.remove(0).value } else { Value::List(values) };
        Entry { key: element.tag_name().name().to_owned(), at: head(element), node: Node { value, bytes } }
    };
    let elements = tree.children().filter(roxmltree::Node::is_element);
    Tree { label: tree.attribute("label").map(str::to_owned), entries: elements.map(entry).collect() }
}

/// A number, where it is written like one.
fn written(text: &str) -> Value {
    match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Value::Number(number),
        _ => Value::Text(text.trim().to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn either_quote_and_a_declaration_without_any() {
        let arbaro = "<?xml version='1.0' ?>\n<arbaro><!-- a -->\n<species name='x'>\n\
            <param name=\"Shape\" value='7'/>\n</species></arbaro>";
        let (format, trees) = trees(arbaro).unwrap();
        assert_eq!((format, trees.len(), trees[0].label.as_deref()), (Format::Arbaro, 1, Some("x")));
        let entry = &trees[0].entries[0];
        assert_eq!((&arbaro[entry.at.clone()], &arbaro[entry.node.bytes.clone()]), ("Shape", "7"));
        let helios = "<?xml version=1.0?>\n<helios>\n\
            <WeberPennTree label=\"A\"><nCurve> 1 -2 </nCurve></WeberPennTree></helios>";
        let (format, trees) = super::trees(helios).unwrap();
        assert_eq!((format, trees[0].entries[0].key.as_str()), (Format::Helios, "nCurve"));
        assert!(matches!(&trees[0].entries[0].node.value, Value::List(list) if list.len() == 2));
    }

    #[test]
    fn entities_and_broken_elements_are_told_with_their_place() {
        let bomb =
            "<?xml version=\"1.0\"?>\n<!DOCTYPE a [<!ENTITY b \"bb\"><!ENTITY c \"&b;&b;\">]>\n<arbaro>&c;</arbaro>";
        let bad = [
            (bomb, 2),
            ("<arbaro>\n<species></species>", 2),
            ("<other/>", 1),
            ("", 1),
            ("<arbaro>\n<species><param name='a'/></species></arbaro>", 2),
        ];
        for (text, line) in bad {
            let fault = trees(text).map(|_| ()).expect_err(text).placed(text);
            assert_eq!(fault.line, line, "{fault:?}");
        }
    }
}
