//! What public files of cpfg write beside what the manual shows: each trap in a small file of our own.

mod common;
use common::{derive, derive_program, read, refused, string, text};
use phytomer_rewriting::Unanswered;

/// A program of cpfg.
fn cpfg(body: &str) -> String {
    format!("Lsystem: 1\n{body}\n")
}

/// The string after so many steps.
#[track_caller]
fn becomes(body: &str, steps: u32, expected: &str) {
    assert_eq!(string(&cpfg(body), steps), expected);
}

#[test]
fn a_context_may_begin_a_branch_and_leave_it_open() {
    becomes("Axiom: -(2)[!(1)L]-(3)[!(7)L]-(4)\n-(a) > [!(w)L : w < 5 --> -(a+w)", 1, "-(3)[!(1)L]-(3)[!(7)L]-(4)");
    // What a branch begins with is not asked, and the branch beside it is.
    becomes("Axiom: F[X][-D]F[-D]\nF > [=][-D=] --> FD", 1, "FD[X][-D]F[-D]");
}

#[test]
fn stars_stand_close_to_their_signs() {
    becomes("Axiom: A#(1)B#(2)\n*<#(w)>B --> G(w)\n* < #(w) > * : * {v = w;} --> *", 1, "AG(1)B");
}

#[test]
fn an_arrow_stands_close_to_a_number_or_a_macro() {
    let file = "#define SHOW 1\nLsystem: 1\nAxiom: A(3)B\nA(n) : n > 1+1--> C\nB : SHOW-->D\n";
    assert_eq!(string(file, 1), "CD");
}

#[test]
fn a_group_of_symbols_alone_is_a_symbol() {
    let (program, derived) = derive(&cpfg("Axiom: @GA@T@Gs\nhomomorphism\n@G --> *"), 0);
    let mut drawn = String::new();
    program.draw(&derived, |module| drawn.push_str(program.symbols().name(module.symbol))).unwrap();
    assert_eq!(drawn, "A@T@Gs");
}

#[test]
fn labels_have_a_text() {
    becomes("Axiom: A(2)\nA(c) --> [@L(\" %.f, (c)\", c)]A(c+1)", 1, "[@L(0,2)]A(3)");
}

#[test]
fn choices_may_be_written_without_blanks() {
    becomes("Axiom: A(-3)A(4)\nA(a) : a<5{dir=a>0?1:-1;wr= dir<a? a:dir;} --> A(dir,wr)", 1, "A(-1,-1)A(1,4)");
}

#[test]
fn comments_may_begin_twice() {
    becomes("Axiom: A /* one\n/* two */\n\t/* and a line of a comment behind a tab */\nA --> B\n/*A --> C*/", 1, "B");
}

#[test]
fn words_are_modules_letter_by_letter() {
    becomes("Axiom: +(45)leaf(1,.5)\nleaf(S,A) : S>0 --> leaf(S-1,A)\nleaf(S,A) : !(S>0) --> F(A)", 2, "+(45)F(0.5)");
}

#[test]
fn lists_of_symbols_hold_brackets_and_signs() {
    becomes("ignore: [+-_WI/!;\nAxiom: A_W!;(1)B\nA > B --> C\nA < B --> D", 1, "C_W!;(1)D");
    becomes("Consider: @v?PHUIE\nAxiom: A@v(1)+F?P(1,2)U\nA > @v(x)?P(y,z)U --> B(x,z)", 1, "B(1,2)@v(1)+F?P(1,2)U");
}

#[test]
fn a_predecessor_may_be_a_whole_branch() {
    let body = "Axiom: [f(1)-f(2)P(3)?E(0)][f(1)-f(2)P(3)?E(1)]\n[f(y)-f(z)P(r)?E(x)] : x==0 || r >= 5 --> *\n\
        P(r)?E(x) : * {r = r + 1;} --> P(r)?E(r)";
    becomes(body, 1, "[f(1)-f(2)P(4)?E(4)]");
    becomes(body, 3, "");
}

#[test]
fn words_of_items_begin_with_either_letter() {
    let program = read("lsystem: 4\nSeed: 3\nderivation length: 2\nConsider: A\naxiom: A\nA --> AB\nEndlsystem\n");
    assert_eq!((program.settings().steps, program.settings().seed), (Some(2), Some(3.0_f64.to_bits())));
    assert_eq!(text(&program, &derive_program(&program, 1, 2, &mut Unanswered)), "ABB");
}

/// Files that are read are told as such, and nothing that follows from them.
#[test]
fn files_that_are_read_are_told_by_their_functions() {
    let refused = refused(
        "Define: {array g[2];}\nStart: {fp = fopen(\"x\", \"r\");\n\tfscanf(fp, \"%lf\\n\", &step); i = 0;\n\
         \twhile (i < 2) {fscanf(fp, \"%lf\", &g[i]); i = i+1;}}\nAxiom: A\nA : step > 0 --> F(g[0])\n",
    );
    let told: Vec<(u32, u32, &str)> =
        refused.faults.iter().map(|fault| (fault.place.line, fault.place.column, fault.problem.as_str())).collect();
    let reads = "`fscanf` reads or writes files";
    assert_eq!(told, [(2, 14, "`fopen` reads or writes files"), (3, 2, reads), (4, 17, reads)]);
}

#[test]
fn panels_are_told_by_their_name() {
    let told = refused("target: Lsystem\npanel name: L-system\nsize: 170 205\ntype: SLIDER\n").to_string();
    let expected = "plant.l:1:1: this is a file of a panel of vlab, which sets constants of a program: `target: Lsystem`; \
        expected a program of cpfg, or one in the papers' notation\n";
    assert_eq!(told, expected);
}
