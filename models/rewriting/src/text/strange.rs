//! Files of other languages that share the ending `.l` or the words of cpfg: lpfg (C++), L-Py (Python), panels of vlab.
//!
//! They are told at the first line that no program of cpfg has, by the name of their language.

use crate::fault::Fault;
use crate::letters::Letter;

const LPFG: &str = "lpfg, whose productions are C++";
const LPY: &str = "L-Py, whose productions are Python";
const PANEL: &str = "a panel of vlab, which sets constants of a program";

/// The fault of a line without comments that is written in another language.
pub(super) fn foreign(line: &[Letter]) -> Option<Fault> {
    let first = line.iter().find(|letter| !letter.c.is_whitespace())?;
    let text: String = line.iter().map(|letter| letter.c).collect();
    let said: String = text.trim().chars().filter(|c| !c.is_control()).take(40).collect();
    let problem = format!("this is a file of {}: `{said}`", language(text.trim())?);
    Some(Fault::new(first.place, problem, "a program of cpfg, or one in the papers' notation"))
}

fn language(line: &str) -> Option<&'static str> {
    let first = line.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("");
    let rest = line[first.len()..].trim_start();
    let is_blank = line[first.len()..].starts_with([' ', '\t']);
    let begins_name = is_blank && rest.starts_with(|c: char| c.is_alphabetic() || c == '_');
    let by_end = if line.ends_with(';') { LPFG } else { LPY };
    match first {
        "" if line.starts_with("#include") && line.contains("lpfgall") => Some(LPFG),
        "module" | "produce" | "nproduce" if begins_name && !line.contains("-->") => Some(by_end),
        "production" if rest == ":" => Some(LPY),
        "target" if rest.starts_with(':') && !line.contains("-->") => Some(PANEL),
        "panel" if rest.starts_with("name:") => Some(PANEL),
        "def" if begins_name && line.ends_with(':') => Some(LPY),
        "from" if begins_name && line.contains(" import ") => Some(LPY),
        "import" if begins_name && !line.contains("-->") => Some(LPY),
        _ => None,
    }
}
