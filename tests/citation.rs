//! `CITATION.cff` says what the manifest says, and names every paper whose place in the project `docs/papers.md` tells.
//!
//! The file is read as the part of YAML that it uses: keys and lists by their indents, texts on one line or folded.
//! Absent: the schema of the Citation File Format itself (1.2.0), of which the keys that it asks for are asked here.

use std::fs;
use std::path::Path;

fn read(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name))
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The value of a key at an indent, without its quotes.
fn value<'a>(text: &'a str, indent: usize, key: &str) -> Option<&'a str> {
    let begin = format!("{}{key}:", " ".repeat(indent));
    text.lines().find_map(|line| line.strip_prefix(&begin)).map(|value| value.trim().trim_matches('"'))
}

/// The works of the list `references`, each with its first key where the others stand.
fn references(text: &str) -> Vec<String> {
    let (_, list) = text.split_once("\nreferences:\n").expect("a list of references");
    list.split("\n  - ").map(|work| format!("    {}\n", work.trim_start_matches("  - "))).collect()
}

#[test]
fn it_says_what_the_manifest_says() {
    let text = read("CITATION.cff");
    assert_eq!(value(&text, 0, "cff-version"), Some("1.2.0"));
    assert_eq!(value(&text, 0, "version"), Some(env!("CARGO_PKG_VERSION")));
    assert_eq!(value(&text, 0, "repository-code"), Some(env!("CARGO_PKG_REPOSITORY")));
    let (_, licences) = text.split_once("\nlicense:\n").expect("licences");
    let licences = licences.lines().map_while(|line| line.strip_prefix("  - ")).collect::<Vec<_>>();
    assert_eq!(licences.join(" OR "), env!("CARGO_PKG_LICENSE"));
    for key in ["message", "title", "abstract", "type"] {
        assert!(value(&text, 0, key).is_some_and(|value| !value.is_empty()), "no `{key}`");
    }
    assert!(text.contains("\nauthors:\n  - name: "), "no authors");
    assert!(text.lines().all(|line| !line.contains('\t') && line.trim_end() == line), "tabs or blanks at an end");
}

#[test]
fn every_work_can_be_found() {
    let (text, mut dois) = (read("CITATION.cff"), Vec::new());
    for work in references(&text) {
        let of = |key| value(&work, 4, key).unwrap_or_else(|| panic!("no `{key}` in\n{work}"));
        assert!(["article", "book", "conference-paper"].contains(&of("type")), "{work}");
        assert!(!of("title").is_empty() && work.contains("    authors:\n      - family-names: "), "{work}");
        assert!(of("year").parse::<u32>().is_ok_and(|year| (1950..2100).contains(&year)), "{work}");
        let doi = value(&work, 4, "doi");
        assert!(doi.is_none_or(|doi| doi.starts_with("10.") && doi.contains('/')), "{work}");
        assert!(doi.is_some() || of("type") == "book", "an article without its DOI:\n{work}");
        dois.extend(doi.map(str::to_owned));
        if let (Some(start), Some(end)) = (value(&work, 4, "start"), value(&work, 4, "end")) {
            assert!(start.parse::<u32>().unwrap() < end.parse::<u32>().unwrap(), "{work}");
        }
    }
    let number = dois.len();
    dois.sort();
    dois.dedup();
    assert_eq!(dois.len(), number, "a work stands there twice");
}

#[test]
fn every_paper_of_the_project_is_there() {
    let works = references(&read("CITATION.cff"));
    let papers = read("docs/papers.md");
    let headings: Vec<&str> = papers.lines().filter_map(|line| line.strip_prefix("## ")).collect();
    assert!(headings.len() >= 5, "{headings:?}");
    for heading in headings {
        let year = heading.split([' ', ',']).find(|word| word.len() == 4 && word.parse::<u32>().is_ok());
        let year = year.unwrap_or_else(|| panic!("no year in `{heading}`"));
        let names = heading.split(year).next().unwrap_or_default().replace('&', ",");
        let names: Vec<&str> = names.split(',').filter_map(|name| name.split_whitespace().last()).collect();
        let is_it = |work: &&String| {
            let named = |name| work.contains(&format!("family-names: {name}\n"));
            value(work, 4, "year") == Some(year) && names.iter().all(named)
        };
        assert_eq!(works.iter().filter(is_it).count(), 1, "{names:?} {year}");
    }
}
