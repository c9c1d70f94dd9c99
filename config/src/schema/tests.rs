//! The check against a schema, on a small type with the shapes that species files have.
//!
//! Each test states the faults with their places. Absent: files (`config/tests/fixtures.rs`).

use schemars::JsonSchema;
use serde::Deserialize;

use super::{check, of_type};
use crate::document;
use crate::report::Report;
use crate::source::{Origin, Source, Sources};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[allow(dead_code)]
struct Plant {
    name: String,
    plants: Option<u16>,
    #[schemars(range(min = 0.0, max = 1.0))]
    pause: Option<f64>,
    habit: Option<Habit>,
    #[schemars(length(min = 1))]
    order: Vec<Order>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum Habit {
    Orthotropic,
    Plagiotropic,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[allow(dead_code)]
struct Order {
    death: Law,
    weights: Option<[f64; 2]>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
#[allow(dead_code)]
enum Law {
    Number(f64),
    Form(Box<Form>),
}

#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[allow(dead_code)]
enum Form {
    Weibull { shape: f64, scale: f64 },
    Mixture(Vec<Law>),
}

fn faults(text: &str) -> Vec<String> {
    let mut sources = Sources::default();
    let origin = Origin::Preset("t".into());
    let id = sources.add(Source { name: "t.toml".into(), origin, text: text.into(), bytes: None });
    let mut faults = Vec::new();
    let node = document::parse(&sources, id, &mut faults);
    if let Some(node) = node {
        check(&of_type::<Plant>(), &node, &mut faults);
    }
    let tell = |f: crate::report::FaultRecord| {
        let near = f.suggestion.map(|s| format!(" ({s}?)")).unwrap_or_default();
        format!("{}:{} {}; {}{near}", f.line.unwrap_or(0), f.column.unwrap_or(0), f.problem, f.expected)
    };
    Report::new(sources, faults).records().into_iter().map(tell).collect()
}

#[test]
fn a_right_file_has_no_fault() {
    let text = "name = \"a\"\nplants = 3\npause = 1\nhabit = \"orthotropic\"\n[[order]]\ndeath = 0.5\n\
                [[order]]\ndeath = { mixture = [0.1, { weibull = { shape = 1, scale = 2.0 } }] }\n";
    assert_eq!(faults(text), Vec::<String>::new());
}

#[test]
fn every_fault_is_told_in_the_order_of_the_file() {
    let text = "nmae = \"a\"\nplants = 70000\npause = 1.5\nhabit = \"ortotropic\"\n[[order]]\ndeath = \"no\"\n\
                [[order]]\ndeth = 1\nweights = [1]\n";
    assert_eq!(
        faults(text),
        [
            "1:1 unknown key `nmae`; one of `name`, `plants`, `pause`, `habit`, `order` (name?)",
            "2:10 `plants` is 70000; a whole number in [0, 65535]",
            "3:9 `pause` is 1.5; a number in [0, 1]",
            "4:9 `habit` is the text \"ortotropic\"; one of `orthotropic`, `plagiotropic` (orthotropic?)",
            "6:9 `death` is the text \"no\"; a number, or a table with one of `weibull`, `mixture`",
            "8:1 unknown key `deth`; one of `death`, `weights` (death?)",
            "9:11 `weights` has 1 item; a list of 2 items, each a number",
        ]
    );
}

#[test]
fn only_the_form_that_fits_best_is_told_of() {
    let law = |text: &str| faults(&format!("name = \"a\"\n[[order]]\ndeath = {text}\n"));
    assert_eq!(law("{ wiebull = 1 }"), ["3:11 unknown key `wiebull`; one of `weibull`, `mixture` (weibull?)"]);
    assert_eq!(law("{}"), ["3:9 `death` is an empty table; one of `weibull`, `mixture`"]);
    assert_eq!(
        law("{ weibull = { shape = true } }"),
        ["3:21 the key `scale` is missing; `scale`: a number", "3:31 `shape` is true; a number",]
    );
    let deep = format!("{}1{}", "{ mixture = [".repeat(20), "] }".repeat(20));
    assert_eq!(law(&deep), Vec::<String>::new());
    assert_eq!(law("2020-01-01").len(), 1);
    assert_eq!(law("nan").len(), 1);
}

#[test]
fn faults_of_syntax_are_told_once_a_line() {
    assert_eq!(
        faults("name = \"a\nplants = = 3\n"),
        ["1:10 invalid basic string; `\"`", "2:10 extra `=`; nothing more here",]
    );
    let twice = faults("name = \"a\"\nname = \"b\"\n[[order]]\ndeath = 2\nx = 1\n");
    assert_eq!(
        twice,
        [
            "2:1 the key `name` is given twice; each key once in its table",
            "5:1 unknown key `x`; one of `death`, `weights`"
        ]
    );
}
