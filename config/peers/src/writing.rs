//! A species file of the parametric model, with the paper's names.
//!
//! Absent: whether the model takes the numbers.

use crate::fault::said;
use crate::format::Format;
use crate::mapping::Mapping;
use std::fmt::Write as _;

/// Trees of this model have no age.
const TICK: &str = "one year, by which its bark ages; its form has no age";

/// The text of the species.
pub(crate) fn species(mapping: &Mapping<'_>, label: Option<&str>, file: &str, format: Format) -> String {
    let base = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let stem = base.rsplit_once('.').map_or(base, |(stem, _)| stem);
    let label = label.filter(|label| !label.trim().is_empty()).unwrap_or(stem);
    let (label, base) = (said(label), said(base));
    let levels = mapping.levels;
    let plural = if levels == 1 { "" } else { "s" };
    let mut text = format!(
        "name = {}\ndescription = {}\nsource = {}\nmodel = \"parametric\"\ntick = \"{TICK}\"\nshown_at = 30\n",
        quoted(&label),
        quoted(&format!(
            "{label}: a parametric tree of {levels} level{plural} of stems, converted from a file of {}.",
            format.program()
        )),
        quoted(&format!("{base} ({})", format.program())),
    );
    let mut level = None;
    text.push('\n');
    for (key, stated) in &mapping.values {
        if key.level != level {
            level = key.level;
            let leaves = level == Some(mapping.levels);
            let _ = writeln!(
                text,
                "\n# Level {}{}",
                level.unwrap_or(0),
                if leaves { ": the angles of the leaves." } else { "." }
            );
        }
        let comment = stated.comment.as_ref().map(|comment| format!("  # {comment}")).unwrap_or_default();
        let _ = writeln!(text, "{key} = {}{comment}", stated.setting);
    }
    text
}

/// A text of TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
