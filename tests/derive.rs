//! `derive`: the strings of L-systems on the two streams, with the exit codes of what goes wrong; and `-D`, which sets
//! constants for it and for what checks and draws plants.
//!
//! Absent: the language itself (`phytomer_rewriting`), and the plants that are made of the strings
//! (`tests/lsystems.rs`).

mod program;

use program::{run, write};
use tempfile::tempdir;

const DRAGON: &str = "Lsystem: 1\nderivation length: 2\nAxiom: L\nL --> +L--R+\nR --> -L++R-\nhomomorphism\nL --> F\nR --> F\nendlsystem\n";

#[test]
fn strings_and_counts_are_told() {
    let folder = tempdir().unwrap();
    write(folder.path(), "dragon.l", DRAGON);
    let string = |words: &[&str]| run(folder.path(), words).ending(0).stdout;
    assert_eq!(string(&["derive", "dragon.l", "--step", "1"]), "+L--R+\n");
    assert_eq!(string(&["derive", "dragon.l"]), "++L--R+---L++R-+\n", "the steps that the file states");
    let counts = string(&["derive", "dragon.l", "--step", "8", "--counts"]);
    assert_eq!(counts, "step\t8\nmodules\t1276\ndrawn\t1276\n+\t510\n-\t510\nL\t128\nR\t128\n");
}

/// μ3 of L-system 2 and the counts of L-system 4 (Prusinkiewicz, James & Měch 1994), whose queries the turtle answers.
#[test]
fn queries_are_answered_as_in_a_plant_that_grows() {
    let folder = tempdir().unwrap();
    let string = run(folder.path(), &["derive", "topiary/2", "--step", "3"]).ending(0).stdout;
    assert_eq!(string, "F(3)?P(0,3)-F(2)?P(2,3)-F(1)?P(2,2)-A\n");
    let told = run(folder.path(), &["derive", "topiary/4", "--step", "75", "--json"]).ending(0).json();
    assert_eq!((&told["counts"]["F"], &told["counts"]["@o"]), (&18.into(), &2.into()));
    let modules = told["modules"].as_array().unwrap();
    assert_eq!(modules.len(), 84);
    let keys: std::collections::BTreeSet<&str> = modules.iter().map(|module| module["key"].as_str().unwrap()).collect();
    assert_eq!(keys.len(), 84, "a key names one module");
}

#[test]
fn constants_are_set() {
    let folder = tempdir().unwrap();
    write(folder.path(), "f.l", "#define N 2\nAxiom: F(N)\nF(x) --> F(x+N)\n");
    let told = run(folder.path(), &["derive", "f.l", "--step", "1", "-D", "N=1.5"]).ending(0);
    assert_eq!(told.stdout, "F(3)\n");
    // A file that leaves a name open is wrong alone, and sound where the name is given.
    write(folder.path(), "open.l", "Axiom: F(N)\nF(x) --> F(x+N)\n");
    let told = run(folder.path(), &["derive", "open.l", "--step", "1"]).ending(3);
    assert!(told.stderr.contains("open.l:1:10") && told.stderr.contains("nothing is named `N`"), "{}", told.stderr);
    let told = run(folder.path(), &["derive", "open.l", "--step", "1", "-D", "N=2"]).ending(0);
    assert_eq!(told.stdout, "F(4)\n");
    run(folder.path(), &["grow", "open.l", "--quiet"]).ending(3);
    run(folder.path(), &["grow", "open.l", "--quiet", "-D", "N=2"]).ending(0);
    let told = std::fs::read_to_string(folder.path().join("runs/open/run.json")).unwrap();
    assert!(told.contains(r#""define":{"N":2.0}"#) || told.contains(r#""N": 2.0"#), "run.json keeps the constant");
    run(folder.path(), &["grow", "coffee", "-D", "N=2"]).ending(2);
    run(folder.path(), &["grow", "halle/massart", "-D", "N=2"]).ending(2);
    run(folder.path(), &["derive", "f.l", "-D", "N"]).ending(2);
    let told = run(folder.path(), &["derive", "f.l", "-D", "M=1"]).ending(3);
    assert!(told.stderr.contains("no constant is named `M`"), "{}", told.stderr);
}

#[test]
fn constants_are_set_where_plants_are_checked_and_drawn() {
    let folder = tempdir().unwrap();
    write(folder.path(), "open.l", "derivation length: 3\nAxiom: F(N)\nF(x) --> F(x+N)[+F(x)]\n");
    let told = run(folder.path(), &["validate", "open.l"]).ending(3);
    assert!(told.stderr.contains("nothing is named `N`"), "{}", told.stderr);
    run(folder.path(), &["validate", "open.l", "-D", "N=2"]).ending(0);
    let told = run(folder.path(), &["validate", "open.l", "-D", "N=2", "-D", "M=1"]).ending(3);
    assert!(told.stderr.contains("no constant is named `M`"), "{}", told.stderr);
    let drawn = |verb: &str, file: &str, constant: &str, small: &[&str]| {
        let words = [&[verb, "open.l", "--age", "2", "--out", file, "-D", constant], small].concat();
        run(folder.path(), &words).ending(0);
        std::fs::read(folder.path().join(file)).unwrap()
    };
    for (verb, file, small) in [("mesh", "a.ply", &[][..]), ("picture", "a.png", &["--size", "160x120"][..])] {
        let [two, again, three] = ["N=2", "N=2", "N=3"].map(|constant| drawn(verb, file, constant, small));
        assert!(two == again && two != three, "{verb}");
    }
    // A run keeps the constants that it was grown with, a scenario states its own, and coffee has no L-system.
    run(folder.path(), &["grow", "open.l", "--quiet", "-D", "N=2"]).ending(0);
    for name in ["runs/open", "coffee", "halle/massart"] {
        run(folder.path(), &["mesh", name, "--out", "b.ply", "-D", "N=2"]).ending(2);
        run(folder.path(), &["picture", name, "--out", "b.png", "-D", "N=2"]).ending(2);
        run(folder.path(), &["validate", name, "-D", "N=2"]).ending(2);
    }
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let folder = tempdir().unwrap();
    write(folder.path(), "wrong.l", "Axiom: A[\nA --> B(x)\n");
    let told = run(folder.path(), &["derive", "wrong.l"]).ending(3);
    assert!(told.stdout.is_empty());
    for words in ["wrong.l:1:9", "wrong.l:2:9", "nothing is named `x`"] {
        assert!(told.stderr.contains(words), "`{words}` is missing in\n{}", told.stderr);
    }
    let told = run(folder.path(), &["derive", "wrong.l", "--json"]).ending(3).json();
    assert_eq!(told["status"], "invalid");
    write(folder.path(), "endless.l", "Axiom: A(1)\nA(x) --> A(1/(x-2))A(x+1)\n");
    let told = run(folder.path(), &["derive", "endless.l", "--step", "5"]).ending(1);
    assert!(told.stderr.contains("endless.l:2:10: step 2: a parameter of a module becomes inf"), "{}", told.stderr);
    run(folder.path(), &["derive", "coffee"]).ending(2);
    run(folder.path(), &["derive", "nothing.l"]).ending(3);
}
