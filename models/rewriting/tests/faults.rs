//! Faults: where they stand, what they say, and that all are told at once.

mod common;
use common::{derive_program, read, refused};
use phytomer_rewriting::{Answers, Derived, Interpreter, Program, Reading, Unanswered};
use phytomer_sim::random::PlantRandom;

/// The first fault of a text, as a line.
#[track_caller]
fn told(text: &str, expected: &str) {
    let refused = refused(text);
    let lines = refused.to_string();
    assert!(lines.lines().any(|line| line == expected), "not told: {expected}\n{lines}");
}

#[test]
fn brackets_names_and_arity() {
    told("Axiom: A[B\nA --> B\n", "plant.l:1:9: `[` begins a branch that does not end; expected `]` behind it");
    told("Axiom: A\nA --> B]C\n", "plant.l:2:8: `]` closes no branch; expected `[` before it");
    told(
        "Axiom: A(1)\nA(x) --> A(x+y)\n",
        "plant.l:2:14: nothing is named `y`; expected one of x, or a name that a `#define` states",
    );
    told("Axiom: A\nA --> F(sin(1,2))\n", "plant.l:2:9: `sin` has 2 arguments; expected 1");
    told(
        "Axiom: A\nA --> F(prune(1,2))\n",
        "plant.l:2:9: no function of 2 arguments is named `prune`; expected a function of the language, such as `sqrt(x)`",
    );
    told(
        "Axiom: A\nA(1,w) : * --> B\n",
        "plant.l:2:3: `1` stands here; expected the name of a parameter, such as the letter `l`",
    );
    told("#define f(x) x\nAxiom: A\nA --> f(1,2)\n", "plant.l:3:7: `f` has 2 arguments; expected 1: `f(x)`");
    told("Axiom: A\nA B\n", "plant.l:2:4: the end of the line stands here; expected an arrow `-->` and a successor");
    told("A --> B\n", "plant.l:1:8: the file has no axiom; expected `Axiom:` and modules, or `ω :` as in the papers");
}

#[test]
fn places_are_true_behind_macros_and_in_included_files() {
    told(
        "#define LONG F(1)F(2)F(3)\nAxiom: LONG LONG A(\n",
        "plant.l:2:20: the end of the file stands here; expected a number, a name or `(`",
    );
    told(
        "#define W (x)\nAxiom: A\n/* one\n two */ A --> F(W)\n",
        "plant.l:4:17: nothing is named `x`; expected a number, or a name that a `#define` or a block before it states",
    );
    let include = |_: &str| Ok("\nB --> [\n".to_owned());
    let reading = Reading { include: &include, ..Reading::of("plant.l") };
    let refused = Program::read("Axiom: B\n#include \"b.h\"\n", &reading).unwrap_err();
    assert_eq!(refused.to_string(), "b.h:2:7: `[` begins a branch that does not end; expected `]` behind it\n");
}

#[test]
fn all_faults_are_told_at_once() {
    let refused = refused("Axiom: A[\nA --> B]\nB --> F(y)\nC(1) --> D\nD --> E : \n");
    let lines: Vec<u32> = refused.faults.iter().map(|fault| fault.place.line).collect();
    assert_eq!(lines, [1, 2, 3, 4, 5], "{refused}");
}

#[test]
fn other_languages_are_told_by_their_names() {
    told(
        "#include <lpfgall.h>\nderivation length: 1;\nmodule A(float);\n",
        "plant.l:1:1: this is a file of lpfg, whose productions are C++: `#include <lpfgall.h>`; expected a program of cpfg, or one in the papers' notation",
    );
    told(
        "module A\nAxiom: A\nproduction:\nA :\n  produce F A\n",
        "plant.l:1:1: this is a file of L-Py, whose productions are Python: `module A`; expected a program of cpfg, or one in the papers' notation",
    );
    told(
        "Axiom: A\nA --> ?(2)B$\n",
        "plant.l:2:7: a sub-L-system is called with `?(…)`; expected one L-system: sub-L-systems are not derived",
    );
    told(
        "Lsystem: 1\nAxiom: A\nA --> B\nendlsystem\nLsystem: 2\nAxiom: B\n",
        "plant.l:5:1: a second L-system begins; expected one L-system: sub-L-systems are not derived",
    );
    told(
        "Start: {fp = fopen(\"out\", \"w\");}\nAxiom: A\nA --> B\n",
        "plant.l:1:14: `fopen` reads or writes files; expected a program that only derives strings",
    );
    told(
        "Axiom: A\nA : 1 {system(\"ls\");} --> B\n",
        "plant.l:2:8: `system` calls the system; expected a program that only derives strings",
    );
}

#[test]
fn macros_that_multiply_and_files_that_include_themselves() {
    let mut bomb = "#define a0 F F\n".to_owned();
    for level in 1..60 {
        bomb.push_str(&format!("#define a{level} a{0} a{0}\n", level - 1));
    }
    let refused_bomb = refused(&format!("{bomb}Axiom: a59\nF --> F\n"));
    assert!(refused_bomb.to_string().contains("letters when its macros are expanded"), "{refused_bomb}");
    let silent: String = (1..60).map(|level| format!("#define b{level}() b{0}()b{0}()\n", level - 1)).collect();
    assert!(refused(&format!("#define b0()\n{silent}Axiom: F b59()\nF --> F\n")).to_string().contains("letters when"));
    let include = |_: &str| Ok("#include \"self.h\"\n".to_owned());
    let reading = Reading { include: &include, ..Reading::of("plant.l") };
    let refused_include = Program::read("#include \"self.h\"\nAxiom: A\n", &reading).unwrap_err();
    assert!(refused_include.to_string().contains("is included within 16 files"), "{refused_include}");
    told("#if 1\nAxiom: A\n", "plant.l:1:1: a condition begins and does not end; expected `#endif` at its end");
    told("Axiom: A /* B\n", "plant.l:1:10: a comment begins and does not end; expected `*/` at its end");
}

#[test]
fn places_are_told_where_no_name_stands() {
    told("", "plant.l:1:1: the file has no axiom; expected `Axiom:` and modules, or `ω :` as in the papers");
    let expected = "the value is not a finite number; expected a number";
    told("derivation length: 1/0\nAxiom: A\n", &format!("plant.l:1:1: {expected}"));
    told("Axiom: A\nhomomorphism\nmaximum depth: 1/0\n", &format!("plant.l:3:1: {expected}"));
    let names: String = (0..5000_u32).filter_map(|n| char::from_u32(0x4e00 + n)).collect();
    told(
        &format!("Axiom: A\nA --> {names}\n"),
        "plant.l:2:4099: the file has too many symbols; expected at most 4096 symbols",
    );
}

#[test]
fn defined_asks_for_one_name() {
    let expected = "`defined` asks for one name; expected `defined(NAME)`, or `defined NAME`";
    told("Axiom: A\n#if defined(A && B) || (1)\n#endif\n", &format!("plant.l:2:15: {expected}"));
    told("Axiom: A\n#if defined(A\n#endif\n", &format!("plant.l:2:14: {expected}"));
    told("Axiom: A\n#if defined\n#endif\n", &format!("plant.l:2:5: {expected}"));
    assert!(read("#define N\n#if !defined ( N ) || defined M\n#error no\n#endif\nAxiom: A\n").warnings().is_empty());
}

/// What a homomorphism draws is bounded, and told at its production.
#[test]
fn what_ends_a_drawing() {
    let mut program = read("Axiom: A\nhomomorphism\nmaximum depth: 100\nB --> B\nA --> AA\n");
    program.limits.modules = 1000;
    let derived = derive_program(&program, 1, 0, &mut Unanswered);
    let stopped = program.draw(&derived, |_| {}).map_err(|why| why.to_string());
    let expected = "plant.l:5:1: step 0: a homomorphism draws more than 1000 modules; expected fewer";
    assert_eq!(stopped, Err(expected.to_owned()));
}

/// The parameters of modules that wait are bounded as those of modules are.
#[test]
fn parameters_that_wait_are_bounded() {
    let ones = ["1"; 32].join(",");
    let wide = format!("Axiom: A\ndecomposition\nmaximum depth: 1000000\nA --> A{}\n", format!("B({ones})").repeat(5));
    let told = stopped(&wide, 0);
    let expected = "plant.l:4:1: step 0: more than 1000 modules, or eight times as many parameters, wait in a step; expected fewer";
    assert_eq!(told, expected);
}

/// A question that cannot be answered is told where the file asks it.
#[test]
fn queries_that_cannot_be_answered() {
    struct Blind;
    impl Interpreter for Blind {
        fn answer(&mut self, _: &Program, _: &Derived, _: &mut Answers) -> Result<(), (String, String)> {
            Err(("nothing answers `?E`".to_owned(), "light".to_owned()))
        }
    }
    let program = read("Axiom: A\nB --> C\nA --> F?E(0)\n");
    let why = program.sow(PlantRandom::new(1, 1), &mut Blind).err().map(|why| why.to_string());
    assert_eq!(why.as_deref(), Some("plant.l:3:8: step 0: nothing answers `?E`; expected light"));
}

/// Why a derivation of so many steps stops.
fn stopped(text: &str, steps: u32) -> String {
    let mut program = read(text);
    program.limits.modules = 1000;
    program.limits.rounds = 100_000;
    let mut derived = match program.sow(PlantRandom::new(1, 1), &mut Unanswered) {
        Ok(derived) => derived,
        Err(why) => return why.to_string(),
    };
    let stopped = (0..steps).find_map(|_| program.step(&mut derived, &mut Unanswered).err());
    stopped.map_or_else(|| "nothing stops it".to_owned(), |why| why.to_string())
}

#[test]
fn what_ends_a_derivation() {
    let infinite = stopped("Axiom: A(1)\nA(x) --> A(1/(x-2))A(x+1)\n", 3);
    assert_eq!(infinite, "plant.l:2:10: step 2: a parameter of a module becomes inf; expected a finite number");
    let endless = stopped("Axiom: A\nA : 1 {while (1) {x = 1;}} --> B\n", 1);
    assert_eq!(endless, "plant.l:2:8: step 1: the rounds of `while` come to no end; expected an end within a step");
    let decomposition = stopped("Axiom: A\nF --> F\ndecomposition\nmaximum depth: 1000000\nA --> A\n", 1);
    assert_eq!(
        decomposition,
        "plant.l:5:1: step 0: productions within productions come to no end; expected an end within a step"
    );
    let growing = stopped("Axiom: A\nF --> F\ndecomposition\nmaximum depth: 1000000\nA --> FA\n", 1);
    assert!(growing.contains("more than 1000 modules"), "{growing}");
    for production in ["F --> FF", "F --> F(1)[F]F\nF(x) --> F(x)", "F > F --> FF\nF --> FFF"] {
        let long = stopped(&format!("Axiom: F\n{production}\n"), 40);
        assert!(long.contains("the string has more than 1000 modules"), "{long}");
    }
    assert!(growing.starts_with("plant.l:5:1: step 0: "), "{growing}");
    let trials = stopped("Axiom: A\nA --> AB(biran(1000000, 0.5))\n", 1);
    assert_eq!(trials, "plant.l:2:10: step 1: the trials of `biran` come to no end; expected an end within a step");
    let tried = stopped(&format!("Axiom: {}\n{}", "A".repeat(900), "A : 1 > 2 --> B\n".repeat(900)), 1);
    assert_eq!(tried, "plant.l:102:1: step 1: the trials of productions come to no end; expected an end within a step");
    let element = stopped("Define: {array a[3];}\nAxiom: A\nA --> F(a[5])\n", 1);
    assert_eq!(element, "plant.l:3:9: step 1: `a` is asked for its element 5; expected an element from 0 to 2");
    let far = stopped(&format!("consider: X\nAxiom: {}\nA > X --> B\n", "A".repeat(900)), 1);
    assert!(far.contains("the looks at contexts come to no end"), "{far}");
}

#[test]
fn a_step_that_is_stopped_leaves_a_string_that_can_be_read() {
    let mut program = read("Axiom: A(3)B[C]\nA(x) --> A(x-1)[F]F(1/(x-1))\nB --> [B]B\n");
    program.limits.modules = 100;
    let mut derived = derive_program(&program, 1, 0, &mut Unanswered);
    while program.step(&mut derived, &mut Unanswered).is_ok() {}
    assert_eq!(derived.string().modules().count(), derived.string().len());
}
