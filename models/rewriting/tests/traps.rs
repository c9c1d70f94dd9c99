//! The traps of the dialect, each in a small file: what cpfg and the papers mean by what they write.

mod common;
use common::{Turtle, counts, derive, derive_program, lines, read, string, text};
use phytomer_rewriting::{Program, Reading, Unanswered};
use phytomer_sim::random::PlantRandom;

/// A program of cpfg with a head, from its axiom and its productions.
fn cpfg(body: &str) -> String {
    format!("Lsystem: 1\nderivation length: 1\n{body}\nendlsystem\n")
}

#[track_caller]
fn becomes(body: &str, steps: u32, expected: &str) {
    assert_eq!(string(&cpfg(body), steps), expected);
}

#[test]
fn a_symbol_is_one_character_or_two_or_three() {
    let (program, derived) = derive("Axiom: F@o@Gs@Tx(1)?P~p@!(3);,{.}\\\\|$_\nF --> F\n", 0);
    let names: Vec<&str> = derived.string().modules().map(|module| program.symbols().name(module.symbol)).collect();
    assert_eq!(names, ["F", "@o", "@Gs", "@Tx", "?P", "~p", "@!", ";", ",", "{", ".", "}", "\\", "\\", "|", "$", "_"]);
}

#[test]
fn the_number_of_parameters_must_fit() {
    becomes("Axiom: F F(1) F(1,2)\nF(x) --> G", 1, "FGF(1,2)");
    let program = read(&cpfg("Axiom: F(1)\nF --> GG"));
    assert!(program.warnings()[0].problem.contains("no `F` has 0 parameters"), "{:?}", program.warnings());
}

#[test]
fn axiom_is_a_keyword_with_its_colon_and_five_modules_without() {
    becomes("Axiom: AXIOM\nAXIOM : 1 == 1 --> B", 1, "B");
}

#[test]
fn a_line_that_begins_with_a_tab_continues_the_last() {
    becomes("Axiom: A\nA\n\t: 1 == 1\n\t-->\n\t\tB\n\tC\n\n\tD", 1, "BCD");
    becomes("Axiom: A\n  A --> B\n  B --> C", 2, "C");
    becomes("Axiom: A(1)\nA(x) : {y = x;\nz = y +\n1;} z == 2 --> B(z)", 1, "B(2)");
}

#[test]
fn strokes_are_modules_where_they_are_no_comment() {
    becomes("Axiom: [A]/////[B] // a comment\n// another\nA --> C", 1, "[C]/////[B]");
}

#[test]
fn macros_are_words_of_their_own() {
    let text = "#define A B\n#define Apex A(2)\n#define in(x,y) ((x)*(x) < y)\nLsystem: 1\nAxiom: AC A Apex\n\
        B(x) : in(x-1, 4) --> D(x)\n";
    assert_eq!(string(text, 1), "ACBD(2)");
    let long = "#define both(x, y) \\\n\tx y\nAxiom: F\nF --> both(G(1),\n\tH(2))\n";
    assert_eq!(string(long, 1), "G(1)H(2)");
    assert_eq!(string("#define f(x) x\n#define g f\nAxiom: f\nf --> #\n", 1), "#");
}

#[test]
fn conditions_of_the_preprocessor() {
    let text = "#define N 2\n#if N > 1 && defined(N)\n#define X A\n#else\n#define X B\n#endif\n\
        #ifndef M\n#define Y C\n#elif 1\n#error never\n#endif\n#undef N\n#ifdef N\n#error never\n#endif\nAxiom: X Y\nF --> F\n";
    assert_eq!(string(text, 0), "AC");
}

#[test]
fn files_are_included_by_their_names() {
    let include = |name: &str| match name {
        "constants.h" => Ok("#define LEN 3\n".to_owned()),
        other => Err(format!("no file is named {other}")),
    };
    let reading = Reading { include: &include, ..Reading::of("plant.l") };
    let program = Program::read("#include \"constants.h\"\nAxiom: F(LEN)\nF(x) --> F(x+1)\n", &reading).unwrap();
    assert_eq!(text(&program, &derive_program(&program, 1, 1, &mut Unanswered)), "F(4)");
    let refused = Program::read("Axiom: F\n#include \"other.h\"\n", &reading).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "plant.l:2:1: `other.h` cannot be included: no file is named other.h; expected a file that can be read\n"
    );
}

#[test]
fn constants_can_be_set() {
    let define = [("a".to_owned(), -2.5)];
    let reading = Reading { define: &define, ..Reading::of("plant.l") };
    let program = Program::read("#define a 1\nAxiom: F(a)\nF --> F\n", &reading).unwrap();
    assert_eq!(text(&program, &derive_program(&program, 1, 0, &mut Unanswered)), "F(-2.5)");
    let refused = Program::read("Axiom: F(1)\nF --> F\n", &reading).unwrap_err();
    assert!(refused.to_string().contains("no constant is named `a`"), "{refused}");
}

#[test]
fn the_first_production_that_applies() {
    becomes("Axiom: A(3)A(1)\nA(x) : x > 2 --> B\nA(x) --> C", 1, "BC");
    becomes(
        "Axiom: A(1)\nA(t) : {t = t - 2;} t > 0 --> B(t)\nA(t) : {t = t + 1;} t > 1 {u = 2*t;} --> C(t,u)",
        1,
        "C(2,4)",
    );
}

#[test]
fn left_context_goes_out_of_branches_and_past_finished_ones() {
    // The example of The Algorithmic Beauty of Plants §1.8.
    becomes("Axiom: ABC[DE][SG[HI[JK]L]MNO]\nBC < S > G[H=]M --> X", 1, "ABC[DE][XG[HI[JK]L]MNO]");
    becomes("Axiom: ABC[DE][SG[HI[JK]L]MNO]\nBC < S > G[H]M --> X", 1, "ABC[DE][SG[HI[JK]L]MNO]");
    becomes("Axiom: A[B[C]]D\nA < D --> X\nA < C --> Y\nB < C --> Z", 1, "A[B[Z]]X");
}

#[test]
fn the_papers_mean_a_beginning_by_a_branch_in_a_context() {
    assert_eq!(string("ω : ABC[DE][SG[HI[JK]L]MNO]\np1 : BC < S > G[H]M → X\n", 1), "ABC[DE][XG[HI[JK]L]MNO]");
}

#[test]
fn right_context_goes_past_branches_that_it_does_not_name() {
    becomes("Axiom: A[X][Y]B\nA > B --> C", 1, "C[X][Y]B");
    becomes("Axiom: A[X(1)Y]B\nA > [X(x)=]B --> C(x)", 1, "C(1)[X(1)Y]B");
    becomes("Axiom: [4F[X]]g\n4 > F=]g --> 5", 1, "[5F[X]]g");
    becomes("Axiom: A[B]\nA > B --> C", 1, "A[B]");
}

#[test]
fn what_is_not_considered_is_looked_through() {
    becomes("ignore: +-\nAxiom: A+[-X]-B\nA < B --> C\nA > B --> D", 1, "D+[-X]-C");
    becomes("consider: A B[]\nAxiom: A[+B]FB\nA > [B]B --> C", 1, "C[+B]FB");
    // Without brackets in the list the look goes into the branch.
    becomes("consider: A B\nAxiom: A[+B]FC\nA > B --> D", 1, "D[+B]FC");
    becomes("consider: A B\nAxiom: A[+B]FB\nB < B --> D", 1, "A[+B]FD");
}

#[test]
fn several_modules_are_a_predecessor() {
    becomes("Axiom: A(1)BAB\nA(x)B --> C(x)", 1, "C(1)AB");
    becomes("Axiom: FFFF\nFF --> G", 1, "GG");
    becomes("Axiom: AAB\nAA > B --> C\nA --> D", 1, "CB");
}

#[test]
fn a_star_is_any_context_and_no_successor() {
    becomes("Axiom: AB\n* < A > B --> C\nB > * --> *", 1, "C");
    becomes("Axiom: AB\nA : * --> *", 1, "B");
}

#[test]
fn a_ring_has_no_ends() {
    becomes("ring lsystem\nAxiom: ABBB\nA < B --> A\nA --> B", 1, "BABB");
    becomes("ring lsystem\nAxiom: BBBA\nA < B --> A\nA --> B", 1, "ABBB");
    becomes("ring lsystem\nAxiom: BBBA\nB > A --> A\nA --> B", 4, "BBBA");
}

#[test]
fn decomposition_works_at_once_and_from_the_axiom_on() {
    let file = cpfg("Axiom: X(3)\nA --> B\ndecomposition\nmaximum depth: 10\nX(n) : n > 1 --> X(n-1)A\nX(n) --> A");
    assert_eq!(string(&file, 0), "AAA");
    assert_eq!(string(&file, 1), "BBB");
    // Without a maximum depth it goes one deep.
    becomes("Axiom: A\nA --> A\ndecomposition\nA --> AB", 2, "ABBB");
    // Contexts are those of the string.
    becomes("Axiom: CA\nA --> X\ndecomposition\nC < X --> Y", 1, "CY");
}

#[test]
fn homomorphism_draws_and_changes_nothing() {
    let file = cpfg("Axiom: AB\nA --> AA\nhomomorphism\nA --> FF\nA > B --> G\nB --> B");
    let (program, derived) = derive(&file, 1);
    assert_eq!((text(&program, &derived).as_str(), lines(&program, &derived)), ("AAB", 4));
    let deep = cpfg("Axiom: A(3)\nhomomorphism\nmaximum depth: 10\nA(n) : n > 0 --> FA(n-1)");
    let (program, derived) = derive(&deep, 0);
    assert_eq!(lines(&program, &derived), 3);
    let state = cpfg("Start: {c = 0;}\nAxiom: AAA\nhomomorphism\nA : 1 {c = c + 1;} --> F(c)");
    let (program, derived) = derive(&state, 0);
    for _ in 0..2 {
        let mut drawn = Vec::new();
        program.draw(&derived, |module| drawn.push(module.parameters[0])).unwrap();
        assert_eq!(drawn, [1.0, 2.0, 3.0], "what drawing assigns is forgotten");
    }
}

#[test]
fn a_cut_takes_what_follows_in_its_branch() {
    becomes("Axiom: A[BC[D]E]F\nB --> B%", 1, "A[B]F");
    becomes("Axiom: A[BC]DE\nD --> %", 1, "A[BC]");
    // What is made and cut in one step never lives: the queries of the interpreter do not see it.
    becomes("Axiom: AB\nA --> C%\nB --> DDD", 1, "C");
    becomes("Axiom: A%B[C]\nA --> D", 0, "A");
}

#[test]
fn blocks_and_the_step() {
    let file = "Lsystem: 1\nderivation length: 7\nStart: {n = 10; m = 0;}\nStartEach: {n = n + 1;}\nEndEach: {m = m + 1;}\n\
        End: {n = 0;}\nAxiom: A(0,0,0,0)\nA(x,y,z,w) --> A(n,m,Q,Z)\nendlsystem\n";
    assert_eq!(string(file, 3), "A(13,2,3,7)");
    assert_eq!(read(file).settings().steps, Some(7));
}

#[test]
fn statements() {
    let body = "Define: {array a[2][3] = {1, 2, 3, 4, 5, 6}; array b[2];}\nStart: {b[1] = 7;}\nAxiom: A(0)\n\
        A(x) : 1 {\n  i = 0; s = 0;\n  while (i < 3) { s = s + a[1][i]; i = i + 1; }\n  do { s = s - 1; } while (s > 10);\n\
        if (s == 10) s = s + b[1]; else { s = 0; }\n  if (s == 0) { s = 1; }\n  printf(\"%f\\n\", s); } --> A(s)";
    becomes(body, 1, "A(17)");
}

#[test]
fn operators_are_those_of_cpfg() {
    let value = |expression: &str| {
        let (_, derived) = derive(&format!("Axiom: A({expression})\nA --> A\n"), 0);
        derived.string().modules().next().map(|module| module.parameters[0]).unwrap()
    };
    for (expression, expected) in [
        ("2+3*4^2", 50.0),
        ("-2^2", 4.0),
        ("2^3^2", 64.0),
        ("7%4+0.5", 3.5),
        ("1<2==1", 1.0),
        ("!0&&3", 1.0),
        ("2>1 ? 5 : 6", 5.0),
        ("1 || 1/0", 1.0),
        ("sin(30)", 0.5),
        ("atan2(1,1)", 45.0),
        ("floor(-1.5)+ceil(1.2)+trunc(2.5)", 3.0),
        ("sign(-3)*fabs(-4)", -4.0),
        ("min{3, 1, 2}+max(1,2)", 3.0),
        ("2(1+2)^2", 18.0),
        ("1e2+.5", 100.5),
        ("sqrt(16)+exp(0)+log(1)", 5.0),
        ("1≤1", 1.0),
    ] {
        assert!((value(expression) - expected).abs() < 1e-12, "{expression} = {}", value(expression));
    }
}

#[test]
fn weights_are_shares_of_their_sum() {
    let file = cpfg("seed: 3\nAxiom: A\nA --> B : 1\nA --> C : 3\nA --> D : -5\nA --> E : 0");
    let program = read(&file);
    let mut found = [0_u32; 2];
    for plant in 0..4000 {
        let derived = derive_program(&program, plant, 1, &mut Unanswered);
        match text(&program, &derived).as_str() {
            "B" => found[0] += 1,
            "C" => found[1] += 1,
            other => panic!("{other}"),
        }
    }
    // A quarter of 4,000, within four standard errors.
    assert!((f64::from(found[0]) - 1000.0).abs() < 4.0 * (4000.0_f64 * 0.25 * 0.75).sqrt(), "{found:?}");
    let weights = "the weights of the productions of this predecessor sum to";
    assert!(program.warnings()[0].problem.starts_with(weights), "{:?}", program.warnings());
    assert!(read(&cpfg("Axiom: F\nF --> F : 33\nF --> FF : 67")).warnings().is_empty());
    assert_eq!(read(&cpfg("Axiom: F\nF --> F : 33\nF --> FF : 33\nF --> FFF : 33")).warnings().len(), 1);
    // With a seed productions without a weight compete with the weight 1.
    let even = read(&cpfg("seed: 1\nAxiom: A\nA --> B\nA --> C"));
    let results: std::collections::BTreeSet<String> =
        (0..50).map(|plant| text(&even, &derive_program(&even, plant, 1, &mut Unanswered))).collect();
    assert_eq!(results.len(), 2);
}

#[test]
fn draws_are_keyed_by_plant_module_step_and_seed() {
    let file = |seed: &str| {
        cpfg(&format!("{seed}\nAxiom: AA\nA --> A(ran(1),nran(0,1),bran(2,3),biran(5,0.5))\nA(a,b,c,d) --> A"))
    };
    let of = |seed: &str, plant: u64, steps: u32| {
        let program = read(&file(seed));
        text(&program, &derive_program(&program, plant, steps, &mut Unanswered))
    };
    let one = of("", 1, 1);
    assert_eq!(one, of("", 1, 1));
    assert!(one.split("A").collect::<std::collections::BTreeSet<_>>().len() == 3, "two modules draw alike: {one}");
    let others = [of("", 2, 1), of("", 1, 3), of("seed: 4", 1, 1), of("Start: {srand(4);}", 1, 1)];
    assert!(others.iter().all(|other| *other != one));
    assert_ne!(others[2], of("seed: 5", 1, 1));
}

#[test]
fn queries_are_filled_between_steps() {
    let program = read(&cpfg("Axiom: F(2)?P(0,0,0)+(90)F(1)A?P(9,9)\nA > ?P(x,y) --> B(x,y)"));
    let derived = derive_program(&program, 1, 1, &mut Turtle::new(60.0));
    assert_eq!(text(&program, &derived), "F(2)?P(0,2,0)+(90)F(1)B(-1,2)?P(-1,2)");
}

#[test]
fn greek_names_and_the_heads_of_papers() {
    let program = read(
        "n = 3, δ = 22.5°\n#define φ 2\nθ(x) = 2x + φ\nω : A\np_1 : A → F(θ(3))A\np₂ : F(λ) : λ ≥ 5 ∥ λ = 0 → ε\n",
    );
    assert_eq!((program.settings().steps, program.settings().angle_deg), (Some(3), Some(22.5)));
    let derived = derive_program(&program, 1, 2, &mut Unanswered);
    assert_eq!(text(&program, &derived), "F(8)A");
}

/// Parameters that change alone are changed in the order of the memory, all else in the order of the string; what
/// looks at contexts makes all successors first. Either way gives one string, with the same identities.
#[test]
fn parameters_change_alike_in_any_order() {
    let body = "Axiom: A(1)F(2)X\nA(x) --> F(x)[+(x)A(x+1)]C(x)F(1)A(x/2)X\nF(l) --> F(l*1.5+1)\n+(a) --> +(a+Q)\n\
        X F(l) --> G(l)\nX --> [X]\nG(l) --> G(l-1)\nC(x) : ran(1) < 0.2 --> %\nC(x) --> C(x+1)\nH(x) --> H(x)";
    let looks = cpfg(&format!("{body}\nZ < Z --> Z"));
    let (one, other) = (read(&cpfg(body)), read(&looks));
    let mut longest = 0;
    for plant in 0..20 {
        let [a, b] = [&one, &other].map(|program| derive_program(program, plant, 9, &mut Unanswered));
        assert_eq!(text(&one, &a), text(&other, &b));
        assert!(a.string().modules().zip(b.string().modules()).all(|(a, b)| a.identity == b.identity));
        longest = longest.max(a.string().len());
    }
    assert!(longest > 200, "{longest}");
}

#[test]
fn a_module_that_no_production_touches_keeps_its_key() {
    let program = read(&cpfg("Axiom: XA\nA --> F[+A]A\nF --> FF\nX > F --> Y"));
    let mut derived = program.sow(PlantRandom::new(1, 1), &mut Unanswered).unwrap();
    let mut seen = std::collections::BTreeMap::new();
    for step in 0..6 {
        if step > 0 {
            program.step(&mut derived, &mut Unanswered).unwrap();
        }
        let mut now = std::collections::BTreeSet::new();
        for module in derived.string().modules() {
            assert!(now.insert(module.identity.key.0), "two modules share a key");
            let name = program.symbols().name(module.symbol);
            let (known, last) = seen.entry(module.identity.key.0).or_insert((name, step));
            assert_eq!(*known, name, "a key names one symbol here");
            assert!(*last + 1 >= step, "what is gone does not come back");
            *last = step;
        }
    }
    // A goes on outside the brackets: it is the module of the axiom, and the one in brackets is born of it.
    let axiom = derived.string().modules().last().unwrap();
    assert_eq!((program.symbols().name(axiom.symbol), axiom.identity.birth), ("A", 0));
    let lateral =
        derived.string().modules().find(|module| module.identity.birth == 6 || module.identity.birth == 5).unwrap();
    assert!(seen.contains_key(&lateral.identity.predecessor.0));
}

#[test]
fn growth_may_be_intercalary_at_the_other_end() {
    let last = ["F".to_owned()];
    let reading = Reading { continues_last: &last, ..Reading::of("plant.l") };
    let program = Program::read("ω : F\np1 : F → FF\n", &reading).unwrap();
    let derived = derive_program(&program, 1, 2, &mut Unanswered);
    let births: Vec<u32> = derived.string().modules().map(|module| module.identity.birth).collect();
    assert_eq!(births, [2, 1, 2, 0]);
}

#[test]
fn what_is_drawn_has_a_key_of_its_path() {
    let (program, derived) = derive(&cpfg("Axiom: AA\nhomomorphism\nmaximum depth: 2\nA --> BB\nB --> FF"), 0);
    let mut keys = std::collections::BTreeSet::new();
    program.draw(&derived, |drawn| assert!(keys.insert(drawn.key.0) && drawn.depth == 2)).unwrap();
    assert_eq!(keys.len(), 8);
}

#[test]
fn dragon_curve_and_signals() {
    let dragon = cpfg("Axiom: L\nL --> +L--R+\nR --> -L++R-\nhomomorphism\nL --> F\nR --> F");
    let (program, derived) = derive(&dragon, 8);
    assert_eq!((counts(&program, &derived)["+"], lines(&program, &derived)), (2 * 255, 256));
    becomes("Axiom: S0000\nS --> 0\nS < 0 --> S", 3, "000S0");
}
