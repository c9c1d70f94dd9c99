//! Which operands each statement has, and in which order: the grammar of the appendix.
//!
//! The grammar slips here and there: it has SHADOW_TREE and SHADOW_LEAF, BACKGROUND_OPERATION and BACKGROUND_COLOR_SET,
//! CLUSTER_TREE, CLEAR_WORKSTATION and DECORATION by two names each; what is meant is always clear. Trees, with their
//! shape and decoration, are in `trees`; here are clusters, views, modes, workstations and the rest.

mod trees;

use super::commands::COMMANDS;
use super::fault::Fault;
use super::operands::{DEVICES, Operands, Read, TREE_TYPES, VIEW_TYPES, WORKSTATION_TYPES};
use super::statement::{Device, GirthForm, Name, Statement, TreeType, ViewType, Viewing};
use super::words::{Sentence, clip};

/// The longest time lag, seconds.
const LONGEST_LAG: f64 = 3600.0;
/// The most parts of a growth level.
const MOST_STEPS: u32 = 1000;
/// The most corners of a cross-section.
const MOST_CORNERS: u32 = 64;

const TREE: &str = "the name of a tree";
const CLUSTER: &str = "the name of a cluster";
const WORKSTATION: &str = "the name of a workstation";

/// Reads a statement.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn statement(sentence: &Sentence) -> Read<Statement> {
    let mut operands = Operands::of(sentence);
    let command = sentence.words[0].text;
    let read = one(command, &mut operands).unwrap_or_else(|| {
        let words = COMMANDS.iter().map(|command| command.word);
        let problem = format!("`{}` is no command", clip(command));
        Err(Fault::spelling(sentence.words[0].place, problem, (command, words), "a command (`help;` lists them)"))
    })?;
    operands.finish()?;
    Ok(read)
}

/// `None` for a word that is no command.
fn one(command: &str, of: &mut Operands) -> Option<Read<Statement>> {
    trees::one(command, of).or_else(|| cluster(command, of)).or_else(|| mode(command, of)).or_else(|| rest(command, of))
}

fn tree_name(of: &mut Operands) -> Read<Name> {
    of.name(TREE)
}

fn tree_type(of: &mut Operands) -> Read<TreeType> {
    of.choice("the type of a tree", &TREE_TYPES)
}

fn lag(of: &mut Operands) -> Read<Option<f64>> {
    of.optional(seconds)
}

fn seconds(of: &mut Operands) -> Read<f64> {
    of.number_in("a time lag, seconds", 0.0..=LONGEST_LAG)
}

fn cluster(command: &str, of: &mut Operands) -> Option<Read<Statement>> {
    let name = |of: &mut Operands| of.name(CLUSTER);
    Some(match command {
        "cluster" => name(of).and_then(|cluster| {
            let first = tree_name(of)?;
            let mut trees = of.many(tree_name)?;
            trees.insert(0, first);
            Ok(Statement::Cluster { cluster, trees })
        }),
        "remove" => name(of).map(|cluster| Statement::Remove { cluster }),
        "append" => name(of).and_then(|cluster| Ok(Statement::Append { cluster, tree: tree_name(of)? })),
        "expel" => name(of).and_then(|cluster| Ok(Statement::Expel { cluster, tree: tree_name(of)? })),
        "flush" => name(of).and_then(|cluster| Ok(Statement::Flush { cluster, lag: lag(of)? })),
        "merge" => name(of).and_then(|first| {
            let clusters = [first, name(of)?];
            Ok(Statement::Merge { clusters, to: name(of)? })
        }),
        "inquire" => name(of).map(|cluster| Statement::Inquire { cluster }),
        "compose" => tree_name(of).and_then(|tree| Ok(Statement::Compose { tree, viewing: viewing(of)? })),
        "view" => name(of).and_then(|cluster| Ok(Statement::View { cluster, viewing: viewing(of)? })),
        "visible" => name(of).and_then(|cluster| {
            let on = of.flag("whether the cluster is visible, on or off")?;
            Ok(Statement::Visible { cluster, on })
        }),
        _ => return None,
    })
}

/// A view: its type where a word follows, and the place of an eye where numbers follow.
fn viewing(of: &mut Operands) -> Read<Viewing> {
    let is_number = |of: &Operands| of.flat().first().is_some_and(|word| word.text.parse::<f64>().is_ok());
    let view = if is_number(of) { None } else { of.optional(view_type)? };
    let point = of.optional(|of| of.place3("the place of the eye"))?;
    Ok(Viewing { view, point })
}

fn view_type(of: &mut Operands) -> Read<ViewType> {
    of.choice("a view", &VIEW_TYPES)
}

fn mode(command: &str, of: &mut Operands) -> Option<Read<Statement>> {
    Some(match command {
        "color" => color(of),
        "appear" => tree_name(of).and_then(|tree| {
            let on = of.flag("whether the tree is visible, on or off")?;
            Ok(Statement::Appear { tree, on })
        }),
        "girth" => girth(of),
        "cont" => of.flag("whether growth is continuous, on or off").and_then(|on| {
            let steps = of.optional(|of| of.whole("the steps of a growth level", 1..=MOST_STEPS))?;
            Ok(Statement::Cont { on, steps })
        }),
        "cut_axis" => of.flag("whether the main axis is cut, on or off").and_then(|on| {
            let level = of.optional(|of| of.level("the growth level from which it is cut"))?;
            Ok(Statement::CutAxis { on, level })
        }),
        "cut_lateral" => of.flag("whether lateral branches are cut, on or off").and_then(|on| {
            let cut = of.optional(|of| {
                let level = of.level("the first growth level whose lateral branches are cut")?;
                let until = of.optional(|of| of.many(|of| of.level("the last growth level of a lateral branch")))?;
                Ok((level, until.unwrap_or_default()))
            })?;
            let (level, until) = cut.unzip();
            Ok(Statement::CutLateral { on, level, until: until.unwrap_or_default() })
        }),
        "divergence" => divergence(of).map(|degrees| Statement::Divergence { degrees }),
        _ => return None,
    })
}

/// An angle in degrees, or a fraction of a turn such as 2/5.
fn divergence(of: &mut Operands) -> Read<f64> {
    const WHAT: &str = "a divergence in degrees, −360 to 360, or a fraction of a turn such as 2/5";
    let fraction = of.peek().and_then(|text| text.split_once('/'));
    let Some((turns, leaves)) = fraction else { return of.number_in(WHAT, -360.0..=360.0) };
    let place = of.place();
    let parts = (turns.parse::<u32>(), leaves.parse::<u32>());
    of.skip_word();
    match parts {
        (Ok(turns), Ok(leaves)) if leaves > 0 && turns <= leaves => Ok(360.0 * f64::from(turns) / f64::from(leaves)),
        _ => Err(Fault::new(place, "this is no part of a turn", WHAT)),
    }
}

fn color(of: &mut Operands) -> Read<Statement> {
    let named = of.peek().is_some_and(|text| !text.starts_with('#') && !text.starts_with(|c: char| c.is_ascii_digit()));
    let tree = if named { of.optional(tree_name)? } else { None };
    Ok(Statement::Color { tree, colour: of.colour()? })
}

fn girth(of: &mut Operands) -> Read<Statement> {
    let tree = if of.at_flag() { None } else { of.optional(tree_name)? };
    let on = of.flag("whether branches have a girth, on or off")?;
    let form = of.optional(|of| {
        Ok(GirthForm {
            first: of.number_in("the diameter of the first branch", 1e-6..=1000.0)?,
            ratio: of.number_in("the ratio of diameters", 0.01..=1.0)?,
            dense: of.number_in("the density of lines", 0.0..=1.0)?,
            shaded: of.flag("whether the far side is shaded, on or off")?,
            main_axis: of.flag("whether the main axis alone has it, on or off")?,
            corners: of.whole("the corners of a cross-section", 3..=MOST_CORNERS)?,
        })
    })?;
    Ok(Statement::Girth { tree, on, form })
}

fn rest(command: &str, of: &mut Operands) -> Option<Read<Statement>> {
    let name = |of: &mut Operands| of.name(WORKSTATION);
    let device = |of: &mut Operands| -> Read<Device> { of.choice("a logical device", &DEVICES) };
    Some(match command {
        "open" => name(of).and_then(|workstation| {
            let kind = of.choice("the type of a workstation", &WORKSTATION_TYPES)?;
            Ok(Statement::Open { workstation, kind })
        }),
        "close" => name(of).map(|workstation| Statement::Close { workstation }),
        "port" => name(of).and_then(|workstation| {
            let view = view_type(of)?;
            let frame = frame(of, "of the port, as a share of the picture", 0.0..=1.0)?;
            Ok(Statement::Port { workstation, view, frame })
        }),
        "window" => name(of).and_then(|workstation| {
            let frame = frame(of, "of the window, metres", -1e6..=1e6)?;
            Ok(Statement::Window { workstation, frame })
        }),
        "activate" => name(of).and_then(|w| Ok(Statement::Activate { workstation: w, device: device(of)? })),
        "deactivate" => name(of).and_then(|w| Ok(Statement::Deactivate { workstation: w, device: device(of)? })),
        "clear" => name(of).map(|workstation| Statement::Clear { workstation }),
        "back_color" => of.colour().map(|colour| Statement::BackColor { colour }),
        "exit" => Ok(Statement::Exit),
        "local" => Ok(Statement::Local),
        "defer" => seconds(of).map(|lag| Statement::Defer { lag }),
        "help" => of.optional(|of| of.name("the name of a command")).map(|command| Statement::Help { command }),
        _ => return None,
    })
}

/// Left, right, top and bottom, of which the right is beyond the left, and the top above the bottom.
fn frame(of: &mut Operands, what: &str, range: std::ops::RangeInclusive<f64>) -> Read<[f64; 4]> {
    let place = of.place();
    let mut side = |name: &str| of.number_in(&format!("the {name} {what}"), range.clone());
    let [left, right, top, bottom] = [side("left side")?, side("right side")?, side("top")?, side("bottom")?];
    if left >= right || bottom >= top {
        let problem = format!("the frame {left} {right} {top} {bottom} is inside out");
        return Err(Fault::new(place, problem, "left, right, top and bottom: left below right, bottom below top"));
    }
    Ok([left, right, top, bottom])
}
