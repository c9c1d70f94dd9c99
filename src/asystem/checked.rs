//! A script that is held against the models before anything is drawn: names of leaves, numbers of trees, and how large
//! they come to be.

use super::cast::Cast;
use super::foliage::form_of;
use super::grown::{MOST_COMPONENTS, foretold};
use phytomer_asystem::{Fault, Refused, Script, Statement, Step, Typing, read};
use phytomer_looks::FormName;

/// A script that can run.
#[derive(Debug, Clone)]
pub struct Checked {
    /// Its statements.
    pub steps: Vec<Step>,
    /// What is typed after it.
    pub typing: Typing,
}

/// Reads and checks a script.
///
/// # Errors
/// All that is wrong with its text and its names; where these are right, all that is wrong with its trees.
pub fn checked(text: &str) -> Result<Checked, Refused> {
    let Script { steps, typing } = read(text)?;
    let mut cast = Cast::default();
    check(&steps, &mut cast)?;
    Ok(Checked { steps, typing })
}

/// Checks statements that are typed, with the trees that there are.
///
/// # Errors
/// As [`checked`].
pub fn checked_typing(text: &str, typing: &mut Typing, cast: &Cast) -> Result<Vec<Step>, Refused> {
    let mut next = typing.clone();
    let steps = next.take(text)?;
    check(&steps, &mut cast.clone())?;
    *typing = next;
    Ok(steps)
}

fn check(steps: &[Step], cast: &mut Cast) -> Result<(), Refused> {
    let mut faults = Vec::new();
    for step in steps {
        if let Statement::Leaf { form, .. } = &step.statement
            && form_of(&form.text).is_none()
        {
            let words = FormName::ALL.map(FormName::word);
            let problem = format!("no form is named `{}`", form.text);
            faults.push(Fault::spelling(form.place, problem, (&form.text, words), "a form of `phytomer list forms`"));
        }
        if let Some(name) = cast.take(&step.statement) {
            faults.extend(faults_of(&name, step, cast));
        }
    }
    Refused::of(faults).map_or(Ok(()), Err)
}

/// The faults of a tree that a statement makes or changes, at the place of the statement.
fn faults_of(name: &str, step: &Step, cast: &Cast) -> Vec<Fault> {
    let Some(tree) = cast.trees.get(name) else { return Vec::new() };
    let told = tree.check().into_iter().map(|fault| {
        let problem = format!("the tree `{name}`, {}: {}", fault.path, fault.problem);
        Fault::new(step.place, problem, fault.expected)
    });
    let told: Vec<Fault> = told.collect();
    let large = foretold(tree).filter(|components| told.is_empty() && *components > u64::from(MOST_COMPONENTS));
    let explodes = large.map(|components| {
        let problem = format!("the tree `{name}` of growth level {} would have {components} components", tree.level());
        Fault::new(step.place, problem, format!("a growth level with at most {MOST_COMPONENTS}"))
    });
    told.into_iter().chain(explodes).collect()
}
