//! D0L-systems of cells as text: the printed strings of K1 and K2 (Aono & Kunii 1984, "L-system model"), and what such
//! a text may not say.

use phytomer_rewriting::{Cells, Program, Reading, Unanswered};
use phytomer_sim::random::PlantRandom;

const K1: &str = "/* K1 */\nw = g\ng → d(g)g\nd → d\n( → (\n) → )\n";
const K2: &str = "ω : g\np1 : g --> d(g)(g)\n";

fn cells(text: &str) -> Result<Cells, String> {
    Cells::read(text, &Reading::of("k.l")).map_err(|refused| refused.to_string())
}

/// The strings of a text from step 0 on, in the letters of the file.
fn strings(text: &str, steps: usize) -> Vec<String> {
    let program = Program::read(text, &Reading { cells: true, ..Reading::of("k.l") }).expect("a sound text");
    let mut derived = program.sow(PlantRandom::new(1, 0), &mut Unanswered).expect("an axiom");
    let mut told = Vec::new();
    for step in 0..=steps {
        if step > 0 {
            program.step(&mut derived, &mut Unanswered).expect("a step");
        }
        told.push(derived.string().modules().map(|module| program.written(module.symbol)).collect());
    }
    told
}

/// Level 4 of K1 has 29 characters. Of level 4 of K2 half is printed; the whole has 43.
#[test]
fn the_strings_of_k1_and_k2_are_those_of_the_paper() {
    let k1 = strings(K1, 3);
    assert_eq!(k1, ["g", "d(g)g", "d(d(g)g)d(g)g", "d(d(d(g)g)d(g)g)d(d(g)g)d(g)g"]);
    let k2 = strings(K2, 3);
    assert_eq!(k2[..3], ["g", "d(g)(g)", "d(d(g)(g))(d(g)(g))"]);
    assert!(k2[3].starts_with("d(d(d(g)(g))(d(g)(g)))"), "{}", k2[3]);
    assert_eq!((k1[3].len(), k2[3].len()), (29, 43));
}

#[test]
fn a_cell_stands_at_its_column() {
    let read = cells("#define LONG d(g)\nw = g\n  g → LONG g\n").expect("a sound text");
    assert_eq!((read.axiom.text.as_str(), read.axiom.place.line), ("    g", 2));
    // What a macro made stands where the macro is named, and what follows at its own column or behind it.
    let [(cell, becomes)] = &read.productions[..] else { panic!("{:?}", read.productions) };
    assert_eq!((cell.as_str(), becomes.text.as_str(), becomes.place.line), ("g", "      d(g) g", 3));
}

#[test]
fn what_a_system_without_interaction_cannot_say_is_told_at_its_place() {
    let cell = "expected a cell, an arrow and a string of cells: a D0L-system has no interaction\n";
    for (line, told) in [
        ("a < g → d", "k.l:2:1: this production has a context"),
        ("g > a → d", "k.l:2:1: this production has a context"),
        ("g : 1 → d", "k.l:2:1: this production has a condition"),
        ("g → d : 2", "k.l:2:1: this production has a weight"),
        ("gd → d", "k.l:2:1: 2 cells are rewritten together"),
        ("( → d", "k.l:2:1: a parenthesis is rewritten"),
        ("( → )", "k.l:2:1: a parenthesis is rewritten"),
        ("ignore: d", "k.l:1:1: the file states what contexts see"),
        ("seed: 3", "k.l:1:1: the file states a seed"),
        ("homomorphism\ng → d", "k.l:3:1: a homomorphism begins"),
    ] {
        assert_eq!(cells(&format!("w = g\n{line}\n")), Err(format!("{told}; {cell}")), "{line}");
    }
    let twice = cells("w = g\ng → d\ng → dg\n").expect_err("two productions");
    assert_eq!(twice, "k.l:3:1: `g` has two productions; expected one: a D0L-system is deterministic\n");
    assert!(cells("g → d\n").expect_err("no start").contains("the file has no axiom"));
}
