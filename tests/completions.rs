//! Completions and manual pages, read by what they are for: bash completes from the one, and groff sets the other.
//!
//! Where groff is not there, a page is still read line by line. Absent: zsh, fish, elvish and PowerShell themselves;
//! their scripts are searched for every verb and option.

mod program;

use program::run;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use tempfile::tempdir;

const SHELLS: [&str; 5] = ["bash", "elvish", "fish", "powershell", "zsh"];

/// The verbs that `--help` lists.
fn verbs() -> Vec<String> {
    let help = run(Path::new("."), &["--help"]).ending(0).stdout;
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = listed.take_while(|line| !line.is_empty());
    let first = |line: &str| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')).map(first_word);
    let verbs: Vec<String> = listed.filter_map(first).filter(|verb| verb != "help").collect();
    assert!(verbs.len() > 20, "{verbs:?}");
    verbs
}

fn first_word(line: &str) -> String {
    line.split_whitespace().next().unwrap_or_default().to_owned()
}

/// The long options of a verb, as its help lists them.
fn options(verb: &str) -> Vec<String> {
    let help = run(Path::new("."), &["help", verb]).ending(0).stdout;
    let listed = help.lines().map(str::trim_start).filter(|line| line.starts_with("--") || line.starts_with("-h, --"));
    let word = |line: &str| line.split_whitespace().find(|word| word.starts_with("--")).unwrap_or_default().to_owned();
    listed
        .map(|line| word(line).trim_matches(|letter: char| letter != '-' && !letter.is_alphanumeric()).to_owned())
        .collect()
}

/// The words that bash offers after `words`, the last of which is begun.
fn offered_by_bash(script: &Path, words: &[&str]) -> Vec<String> {
    let line = format!(
        "source '{}'; COMP_WORDS=({}); COMP_CWORD={}; COMPREPLY=(); \
         _phytomer phytomer \"${{COMP_WORDS[COMP_CWORD]}}\" \"${{COMP_WORDS[COMP_CWORD-1]}}\"; \
         printf '%s\\n' \"${{COMPREPLY[@]}}\"",
        script.display(),
        words.iter().map(|word| format!("'{word}'")).collect::<Vec<_>>().join(" "),
        words.len() - 1
    );
    let said = Command::new("bash").args(["--norc", "-c", &line]).output().expect("bash starts");
    let told = String::from_utf8(said.stdout).expect("UTF-8");
    assert!(said.status.success(), "{told}{}", String::from_utf8_lossy(&said.stderr));
    told.lines().filter(|line| !line.is_empty()).map(str::to_owned).collect()
}

#[test]
fn every_shell_is_told_every_verb_and_every_option() {
    let options = verbs().into_iter().flat_map(|verb| options(&verb).into_iter().chain([verb.clone()]));
    let words: Vec<String> = options.collect();
    assert!(words.len() > 100, "{words:?}");
    for shell in SHELLS {
        let script = run(Path::new("."), &["completions", shell]).ending(0).stdout;
        for word in &words {
            // fish names an option without its dashes.
            let named = if shell == "fish" { word.trim_start_matches("--") } else { word };
            assert!(script.contains(named), "{shell} is not told {word}");
        }
    }
    let refused = run(Path::new("."), &["completions", "cmd"]).ending(2).stderr;
    assert!(SHELLS.iter().all(|shell| refused.contains(shell)), "{refused}");
}

#[test]
#[cfg(unix)]
fn bash_completes_verbs_options_and_values() {
    let folder = tempdir().unwrap();
    let script = folder.path().join("phytomer.bash");
    fs::write(&script, run(folder.path(), &["completions", "bash"]).ending(0).stdout).unwrap();
    let offered = |words: &[&str]| offered_by_bash(&script, words);
    assert_eq!(offered(&["phytomer", "gro"]), ["grow"]);
    let all = offered(&["phytomer", ""]);
    verbs().iter().for_each(|verb| assert!(all.contains(verb), "{verb} is not among {all:?}"));
    assert_eq!(offered(&["phytomer", "grow", "coffee", "--pla"]), ["--plants"]);
    assert_eq!(offered(&["phytomer", "schema", "sp"]), ["species"]);
    assert_eq!(offered(&["phytomer", "init", "--model", "l"]), ["lsystem"]);
    assert!(offered(&["phytomer", "grow", "--no-such"]).is_empty());
}

/// The lines of a page between a heading and the next, with the escapes of roff taken off.
fn section(page: &str, heading: &str) -> Vec<String> {
    let lines = page.lines().skip_while(|line| *line != format!(".SH {heading}")).skip(1);
    let lines = lines.take_while(|line| !line.starts_with(".SH"));
    let plain = |line: &str| line.replace(r"\*(Aq", "'").replace(r"\-", "-").replace(r"\&", "").replace(r"\\", r"\");
    lines.filter(|line| !line.starts_with('.')).map(plain).collect()
}

#[test]
fn every_verb_has_a_page_with_the_words_of_its_help() {
    let folder = tempdir().unwrap();
    let told = run(folder.path(), &["man", "new/pages"]).ending(0).stdout;
    let names = ["phytomer.1".to_owned()].into_iter();
    let names: Vec<String> = names.chain(verbs().iter().map(|verb| format!("phytomer-{verb}.1"))).collect();
    let expected: Vec<String> = names.iter().map(|name| format!("new/pages/{name}")).collect();
    assert_eq!(told.lines().collect::<Vec<_>>(), expected);
    for (verb, name) in [None].into_iter().chain(verbs().into_iter().map(Some)).zip(&names) {
        let page = fs::read_to_string(folder.path().join("new/pages").join(name)).unwrap();
        let help = match &verb {
            None => run(folder.path(), &["--help"]),
            Some(verb) => run(folder.path(), &["help", verb]),
        };
        let help = help.ending(0).stdout;
        let (_, examples) = help.split_once("Examples:\n").expect("help ends with examples");
        let shown = section(&page, "EXAMPLES");
        let line = |line: &str| line.trim_end().to_owned();
        assert_eq!(
            shown.iter().map(|shown| line(shown)).collect::<Vec<_>>(),
            examples.lines().map(line).collect::<Vec<_>>()
        );
        let known = ["TH", "SH", "SS", "TP", "RS", "RE", "IP", "PP", "br", "nf", "fi", "ie", "el"];
        for line in page.lines().filter(|line| line.starts_with('.') || line.starts_with('\'')) {
            let word = line.trim_start_matches('.').split([' ', '\\']).next().unwrap_or_default();
            assert!(known.contains(&word), "{name}: {line}");
        }
        let text = page.replace(r"\-", "-");
        verb.iter()
            .flat_map(|verb| options(verb))
            .for_each(|option| assert!(text.contains(&option), "{name}: {option}"));
    }
    // Pages that are there are made anew, and no file is left beside them.
    assert_eq!(run(folder.path(), &["man", "new/pages", "--quiet"]).ending(0).stdout, "");
    assert_eq!(fs::read_dir(folder.path().join("new/pages")).unwrap().count(), names.len());
    fs::write(folder.path().join("file"), "").unwrap();
    let refused = run(folder.path(), &["man", "file"]).ending(1).stderr;
    assert!(refused.contains("cannot create file"), "{refused}");
}

/// groff warns of what it cannot set; it sets every page without a word.
#[test]
fn groff_sets_every_page() {
    if Command::new("groff").arg("--version").stdout(Stdio::null()).status().is_err() {
        println!("groff is not there: its reading of the pages is left out");
        return;
    }
    let folder = tempdir().unwrap();
    for name in run(folder.path(), &["man", "pages"]).ending(0).stdout.lines() {
        let mut groff = Command::new("groff");
        groff.args(["-man", "-Tutf8", "-Kutf8", "-ww", "-P-cbou", name]).current_dir(folder.path());
        let said = groff.output().expect("groff starts");
        let (text, warned) = (String::from_utf8_lossy(&said.stdout), String::from_utf8_lossy(&said.stderr));
        assert!(said.status.success() && warned.is_empty(), "{name}: {warned}");
        assert!(text.contains("EXAMPLES") && text.contains("\n         phytomer "), "{name}:\n{text}");
    }
}
