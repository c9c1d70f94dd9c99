//! Broken files: programs with letters, lines and words changed at random, from fixed seeds. Each is refused, stopped
//! or derived, within bounds of time and memory, and never panics.

mod common;
use common::Turtle;
use phytomer_rewriting::{Cells, Limits, Program, Reading};
use phytomer_sim::key::scramble;
use phytomer_sim::random::PlantRandom;
use std::time::{Duration, Instant};

/// Programs that use everything that the language has.
const PROGRAMS: [&str; 6] = [
    "#define N 3\n#define W(x) (x*2)\nLsystem: 1\nseed: 4\nderivation length: N\nconsider: A F []\n\
     define: { array a[2][2] = {1,2,3,4}; }\nStart: {n = 0; srand(N);}\nStartEach: {n = n + 1;}\nEndEach: {m = n;}\n\
     Axiom: A(1)F(W(2))[+B]/(45)?P(0,0,0)\nA(x) < F(y) > [B=]?P(p,q,r) : {t = x + ran(1);} t > 0 {u = t^2;} --> F(u)[A(x+1)]% : 0.5\n\
     A(x) --> F(x)[+A(x*a[1][0])]A(x/2) : 0.5\nF(x) --> F(x+Q)\nB : n < Z --> [B]~l(2)@Gs(1)\n\
     decomposition\nmaximum depth: 4\nF(x) : x > 8 --> F(x/2)F(x/2)\nhomomorphism\nmaximum depth: 3\n\
     F(x) : 1 {while (x > 4) {x = x - 1; if (x < 2) {x = 0;} else {x = x - 1;}}} --> ;(1)G(x)\nendlsystem\n",
    "n = 4, δ = 22.5\n#define L 5.2\nprune(x, y) = (x < −L/2) ‖ (x > L/2) ‖ (y < 0) ‖ (y > L),\nω : FA?P(x, y)\n\
     p1 : A > ?P(x, y) : !prune(x, y) → @oF/(180)A\np2 : A > ?P(x, y) : prune(x, y) → T%\np3 : F > T → S\n\
     p4 : F > S → SF\np5 : S → ε\np6 : @o > S → [+FA?P(x, y)]\np7 : T → ε\n",
    "Lsystem: 0\nring lsystem\nderivation length: 3\nStart: {ang = 180/8;}\nAxiom: X(8)\nA < B : 1==1 --> A\nA --> B\n\
     decomposition\nmaximum depth: 100\nX(n) : n>1 --> X(n-1)B\nX(n) : n==1 --> A\n\
     homomorphism: no warnings\nmaximum depth: 2\nA --> ;(1)S\nS --> [+(90)F(5)]-(ang)f-(ang)\nendlsystem\n",
    "#if defined(X) || 1\n#define T(a,b) a b\n#else\n#error no\n#endif\nignore: +-/,\naxiom: D(0)F(3,0)A(0)B\n\
     A(i)B : i<2 --> T(A(i+1),\n\tB)\nS(i) < F(l,o) : (o==0)&&(i==1) --> ,#F(l,o)!;S(0)\nD(i) --> S(min(i,3))F(nran(0,1),biran(3,0.5))\n\
     * < S(i) > * --> *\nF(l,o) > F(a,b) --> F(o,bran(2,3))\n",
    "Axiom: F[X]F\nF > [X=]F --> FF[X]\nX : * {x = 3; do { x = x - 1; } while (x > 0);} --> X(x)\nX(y) --> Y : 33\nX(y) --> * : 66\n",
    "ω : A(1)B(3)A(5)\np1 : A(x) → A(x+1) : 0.4\np2 : A(x) → B(x−1) : 0.6\np3 : A(x) < B(y) > A(z) : y < 4 → B(x+z)[A(y)]\n",
];

/// Words that are put into a text.
const WORDS: [&str; 40] = [
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "<",
    ">",
    ":",
    "-->",
    "→",
    "%",
    "=",
    ";",
    ",",
    "*",
    "?",
    "?(",
    "@",
    "~",
    "#define A A A\n",
    "#include \"x\"\n",
    "#if 1\n",
    "#endif\n",
    "\n",
    "\n\t",
    "\\\n",
    "//",
    "/*",
    "\"",
    "while(1){}",
    "1e999",
    "-",
    "ε",
    "Axiom: A\n",
    "decomposition\nmaximum depth: 1e9\n",
    "homomorphism\n",
    "derivation length: -1\n",
    "F(ran(1)/0)",
    "\u{0}",
];

/// Changes a text at some places.
fn mutated(text: &str, state: &mut u64) -> String {
    let mut letters: Vec<char> = text.chars().collect();
    let mut next = |below: usize| {
        *state = scramble(*state);
        (*state >> 16) as usize % below.max(1)
    };
    for _ in 0..=next(4) {
        let at = next(letters.len());
        match next(5) {
            0 => drop(letters.drain(at..(at + 1 + next(6)).min(letters.len()))),
            1 => {
                let word: Vec<char> = WORDS[next(WORDS.len())].chars().collect();
                letters.splice(at..at, word);
            }
            2 => {
                let (from, length) = (next(letters.len()), 1 + next(40));
                let copy: Vec<char> = letters[from..(from + length).min(letters.len())].to_vec();
                letters.splice(at..at, copy);
            }
            3 if !letters.is_empty() => {
                let other = next(letters.len());
                letters.swap(at.min(other), at.max(other));
            }
            _ if !letters.is_empty() => letters[at] = char::from(32 + next(95) as u8),
            _ => {}
        }
    }
    letters.into_iter().collect()
}

/// Reads and derives a text within small limits; tells whether it could be read.
fn answered(text: &str, cells: bool) -> bool {
    let reading = Reading { cells, ..Reading::of("broken.l") };
    let read = Program::read(text, &reading);
    assert!(!cells || read.is_err() || Cells::read(text, &reading).is_ok(), "{text}");
    let Ok(mut program) = read else { return false };
    program.limits = Limits { modules: 3000, rounds: 300_000 };
    let mut turtle = Turtle::new(60.0);
    let Ok(mut derived) = program.sow(PlantRandom::new(1, 1), &mut turtle) else { return true };
    for _ in 0..4 {
        if program.step(&mut derived, &mut turtle).is_err() {
            break;
        }
        assert!(derived.string().len() <= 3000);
    }
    assert_eq!(derived.string().modules().count(), derived.string().len());
    let _ = program.draw(&derived, |_| {});
    true
}

#[test]
fn broken_programs_are_answered() {
    let (mut read, mut longest, mut state) = (0, Duration::ZERO, 20_260_728);
    const ROUNDS: usize = 4000;
    for round in 0..ROUNDS {
        let text = mutated(PROGRAMS[round % PROGRAMS.len()], &mut state);
        let begun = Instant::now();
        read += usize::from(answered(&text, false));
        longest = longest.max(begun.elapsed());
    }
    assert!(PROGRAMS.iter().all(|program| answered(program, false)));
    assert!(read > ROUNDS / 20 && read < ROUNDS, "{read} of {ROUNDS} can be read");
    assert!(longest < Duration::from_secs(20), "{longest:?}");
}

/// As many symbols as a program may have, but for a few.
fn of_all_symbols() -> String {
    (0..4000_u32).filter_map(|number| char::from_u32(0x4e00 + number)).collect()
}

/// A file that includes itself twice is read a bounded number of times.
#[test]
fn files_within_files_are_bounded() {
    let comment = "/*".to_owned() + &" ".repeat(1_000_000) + "*/\n#include \"x\"\n#include \"x\"\n";
    let include = |_: &str| Ok(comment.clone());
    let begun = Instant::now();
    let refused = Program::read("#include \"x\"\nAxiom: A\n", &Reading { include: &include, ..Reading::of("a.l") });
    assert!(refused.unwrap_err().to_string().contains("x:1:1: the files are too long"));
    assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
}

/// Long texts of a single kind of thing: nothing recurses, and nothing takes time with the square of the length.
#[test]
fn long_texts_are_answered() {
    const LONG: usize = 100_000;
    let texts = [
        format!("Axiom: A\nA --> F({}1{})\n", "(".repeat(LONG), ")".repeat(LONG)),
        format!("Axiom: A\nA --> F({}1)\n", "-".repeat(LONG)),
        format!("Axiom: A\nA --> F(1{})\n", "+1".repeat(LONG)),
        format!("Axiom: A\nA : 1 {{{}", "if (1) {".repeat(LONG)),
        format!("Axiom: A\nA : 1 {{{}x = 1;}} --> B\n", "if (1) ".repeat(LONG)),
        format!("Axiom: {}{}\nA --> B\n", "[".repeat(LONG), "]".repeat(LONG)),
        format!("Axiom: {}\nA --> B\n", "A".repeat(LONG)),
        format!("Axiom: A\n{}", "A --> B\n".repeat(LONG / 8)),
        format!("Axiom: A\nA({}) --> B\n", (0..LONG / 4).map(|n| format!("x{n},")).collect::<String>()),
        format!("Axiom: A\n{} --> B\n", "A(x)".repeat(LONG / 4)),
        format!("Axiom: A\nA --> F({})\n", "y+".repeat(LONG / 2)),
        format!("{}Axiom: A\n", "#if 1\n".repeat(LONG / 8)),
        format!("{}Axiom: A\n", "#define f(x) x\nf(\n".repeat(LONG / 20)),
        (0..LONG / 20).map(|n| format!("#define m{} m{n}\n", n + 1)).collect::<String>() + "Axiom: m5000\n",
        format!("{}ω : A\n", (0..2000).map(|n| format!("f{}(x) = f{n}(f{n}(x))\n", n + 1)).collect::<String>()),
        format!("#define F(x) x\nAxiom: {}{}\n", "F(".repeat(LONG / 5), ")".repeat(LONG / 5)),
        format!("#define X(a) {}\nAxiom: {}\n", "b".repeat(LONG), "X ".repeat(LONG / 5)),
        format!("Axiom: A\n{}B --> C\n", "#if 1\nA --> B\n".repeat(LONG / 14)),
        format!("Axiom: A\n#if {}\n#endif\n", "defined(A) + ".repeat(LONG / 2)),
        format!("Axiom: A\nω : A\np1 : A > {} → B\n", "]".repeat(2 * LONG)),
        format!("Axiom: {}\nderivation length: 1\n{}B --> C\n", "A".repeat(LONG / 2), "A".repeat(LONG / 4)),
        format!("Axiom: A\nA : 1 {{ while (1) {{ {} }} }} --> B\n", "x = 1; ".repeat(LONG / 2)),
        format!("{}\n", "\" ".repeat(3 * LONG)),
        "\"".repeat(LONG),
        "\\\n".repeat(LONG),
        format!("Axiom: A\n#if {}\n#endif\n", "defined(A".repeat(LONG)),
        format!("Axiom: {}\nA > {} --> B\n", of_all_symbols(), "(x)z".repeat(LONG)),
        format!("Axiom: {}\nA > {} --> B\n", of_all_symbols(), "☃".repeat(2 * LONG)),
        format!("Axiom: {}\n{}", "A".repeat(LONG / 50), "A(x) --> B\nA : 2 < 1 --> B\n".repeat(LONG / 50)),
        format!("Axiom: A\n{}B --> C\n", "A : a<b<c --> B\n \n \n".repeat(LONG / 20)),
        format!("Axiom: A\n{}\n", " \n".repeat(LONG) + &"A --> B : 1\n  \n".repeat(LONG / 20)),
        "@".repeat(LONG),
    ];
    for text in texts {
        let begun = Instant::now();
        answered(&text, false);
        let took = begun.elapsed();
        assert!(took < Duration::from_secs(10), "{took:?}: {}", text.chars().take(60).collect::<String>());
    }
}

/// D0L-systems of cells, broken in the same ways; what can be derived can be read as strings too.
#[test]
fn broken_systems_of_cells_are_answered() {
    const K: &str = "/* K1 */\n#define n d\nw = g\np1 : g → n(g)(dg)g // a branch\nd --> d\n( → (\n) → )\n";
    assert!(answered(K, true));
    let (mut read, mut state) = (0, 19_840_501);
    const ROUNDS: usize = 1000;
    for _ in 0..ROUNDS {
        read += usize::from(answered(&mutated(K, &mut state), true));
    }
    assert!(read > ROUNDS / 20 && read < ROUNDS, "{read} of {ROUNDS} can be read");
}
