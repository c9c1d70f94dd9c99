//! The statements of single trees: made, moved, told, joined, deformed, in leaf and in their shadow.

use super::super::fault::Fault;
use super::super::operands::{Operands, Read};
use super::super::statement::{Angles, Controller, Deformation, Name, Part, Statement, TreeDescriptor, TreeType};
use super::{lag, tree_name, tree_type};

/// The numbers of a controller, and of the start of a tree.
const CONTROLLER: usize = 6;
const START: usize = 4;

/// `None` for a word that is no command of this kind.
pub fn one(command: &str, of: &mut Operands) -> Option<Read<Statement>> {
    let absolute = command.starts_with("abs_");
    Some(match command {
        "create" => create(of),
        "combine" => combine(of),
        "delete" => tree_name(of).map(|tree| Statement::Delete { tree }),
        "copy" => tree_name(of).and_then(|from| Ok(Statement::Copy { from, to: new_name(of)? })),
        "abs_translate" | "rel_translate" => tree_name(of).and_then(|tree| {
            let by = of.place3("the translation")?;
            Ok(Statement::Translate { tree, by, absolute })
        }),
        "abs_zoom" | "rel_zoom" => tree_name(of).and_then(|tree| {
            let factor = of.number_in("the zoom factor", 1e-6..=1e6)?;
            Ok(Statement::Zoom { tree, factor, absolute })
        }),
        "abs_rotate" | "rel_rotate" => tree_name(of).and_then(|tree| {
            let degrees = of.number("the angle about the main axis, degrees")?;
            Ok(Statement::Rotate { tree, degrees, absolute })
        }),
        "release" => tree_name(of).map(|tree| Statement::Release { tree }),
        "animate" => tree_type(of).and_then(|tree_type| {
            let (tree, level) = (tree_name(of)?, of.level("the last growth level")?);
            Ok(Statement::Animate { tree_type, tree, level, lag: lag(of)? })
        }),
        "inform" => tree_name(of).map(|tree| Statement::Inform { tree }),
        "glue" => tree_name(of).and_then(|first| {
            let trees = [first, tree_name(of)?];
            Ok(Statement::Glue { trees, to: new_name(of)? })
        }),
        "deform" => deform(of),
        "leaf" => leaf(of),
        "shadow" => shadow(of),
        _ => return None,
    })
}

fn new_name(of: &mut Operands) -> Read<Name> {
    of.name("a name for the tree")
}

fn create(of: &mut Operands) -> Read<Statement> {
    let tree_type = tree_type(of)?;
    let tree = new_name(of)?;
    let level = of.level("the growth level")?;
    Ok(Statement::Create { tree_type, tree, level, descriptor: descriptor(tree_type, of)? })
}

fn combine(of: &mut Operands) -> Read<Statement> {
    let tree = new_name(of)?;
    let place = of.place();
    let level = of.level("the growth level")?;
    let parts = of.optional(|of| {
        of.many(|of| {
            let tree_type = tree_type(of)?;
            Ok(Part { tree_type, levels: of.levels()?, descriptor: descriptor(tree_type, of)? })
        })
    })?;
    let parts = parts.unwrap_or_default();
    let mut next = 1;
    for Part { levels, descriptor, .. } in &parts {
        if levels[0] != next {
            let problem = format!("the range begins with growth level {}", levels[0]);
            let expected = format!("growth level {next}: ranges follow one another from 1 to the growth level");
            return Err(Fault::new(descriptor.place, problem, expected));
        }
        next = levels[1] + 1;
    }
    if next != level + 1 {
        let problem = format!("the ranges lead to growth level {}, and the tree to {level}", next - 1);
        return Err(Fault::new(place, problem, "ranges that follow one another from 1 to the growth level"));
    }
    Ok(Statement::Combine { tree, level, parts })
}

/// A tree's numbers: R0 of three children, R1 and R2, then h1 and h2, or of changing angles the category, h1′, h1″, h2′
/// and h2″; then the first branch, where it is stated.
fn descriptor(tree_type: TreeType, of: &mut Operands) -> Read<TreeDescriptor> {
    let place = of.place();
    let ratio = |of: &mut Operands, name: &str| {
        let what = format!("the contraction ratio {name}, above 0 and at most 1");
        of.number_in(&what, f64::MIN_POSITIVE..=1.0).map_err(|fault| Fault { expected: what, ..fault })
    };
    let angle = |of: &mut Operands, name: &str| of.number_in(&format!("the angle {name}, degrees"), -180.0..=180.0);
    let r0 = if tree_type == TreeType::Gmt3 { Some(ratio(of, "R0")?) } else { None };
    let ratios = [ratio(of, "R1")?, ratio(of, "R2")?];
    let angles = if tree_type == TreeType::Gmt4 {
        let category = of.whole("the category", 1..=5)?;
        let left = [angle(of, "h1'")?, angle(of, "h1''")?];
        Angles::Changing { category, left, right: [angle(of, "h2'")?, angle(of, "h2''")?] }
    } else {
        Angles::Constant([angle(of, "h1")?, angle(of, "h2")?])
    };
    // In a list of ranges the type of the next one follows.
    let init = match of.flat().first().is_some_and(|word| word.text.parse::<f64>().is_ok()) {
        true => of.optional(|of| Ok([of.place3("the start of the first branch")?, of.place3("its end")?]))?,
        false => None,
    };
    if init.is_some_and(|[start, end]| start == end) {
        return Err(Fault::new(place, "the first branch has no length", "an end that is not its start"));
    }
    Ok(TreeDescriptor { place, r0, ratios, angles, init })
}

/// The three masks say which groups follow: a deviator, controllers of six numbers each, a start of four.
fn deform(of: &mut Operands) -> Read<Statement> {
    let tree = tree_name(of)?;
    let masks = [
        of.flag("the mask of the uniform deviator, on or off")?,
        of.flag("the mask of the controllers, on or off")?,
        of.flag("the mask of the starting locator, on or off")?,
    ];
    // A group of controllers has no end of its own, so the numbers are counted.
    let (place, words) = (of.place(), of.flat());
    of.skip();
    let [uniform, controlled, started] = masks;
    let fixed = if uniform { 3 } else { 0 } + if started { START } else { 0 };
    let left = words.len().checked_sub(fixed).filter(|left| left % CONTROLLER == 0 && (*left > 0) == controlled);
    let Some(left) = left else {
        let mut groups = Vec::new();
        groups.extend(uniform.then_some("dx, dy and dz of the deviator"));
        groups.extend(controlled.then_some("lower and upper level, factor, x, y and z of each controller"));
        groups.extend(started.then_some("x, y and z of the root, and what is added to the first branch"));
        let expected = if groups.is_empty() { "none: all masks are off".to_owned() } else { groups.join("; ") };
        return Err(Fault::new(place, format!("here are {} numbers", words.len()), expected));
    };
    let end = words.last().map_or(place, |word| word.place);
    let mut of = Operands::among(&words, end);
    let deviator = if uniform { Some(of.place3("the deviator")?) } else { None };
    let mut controllers = Vec::with_capacity(left / CONTROLLER);
    for _ in 0..left / CONTROLLER {
        controllers.push(Controller {
            levels: of.levels()?,
            factor: of.number_in("the factor of the controller", -1000.0..=1000.0)?,
            at: of.place3("the controller")?,
        });
    }
    let start = if started { Some((of.place3("the root")?, of.number("the additional length")?)) } else { None };
    let controllers = controlled.then_some(controllers);
    Ok(Statement::Deform { tree, deformation: Deformation { deviator, controllers, start } })
}

fn leaf(of: &mut Operands) -> Read<Statement> {
    let (tree, tree_type) = (tree_name(of)?, tree_type(of)?);
    let form = of.name("the form of a leaf (`phytomer list forms`)")?;
    let (level, colour) = (of.level("the growth level from which branches bear leaves")?, of.colour()?);
    let size = of.optional(|of| {
        let mut side = |what| of.number_in(what, 1e-6..=100.0);
        Ok([side("the length of a leaf")?, side("the width of a leaf")?])
    })?;
    Ok(Statement::Leaf { tree, tree_type, form, level, colour, size })
}

fn shadow(of: &mut Operands) -> Read<Statement> {
    let (tree, tree_type) = (tree_name(of)?, tree_type(of)?);
    let place = of.place();
    let emitter = of.place3("the emitter")?;
    if emitter[2] <= 0.0 {
        return Err(Fault::new(place, "the emitter lies on or below the ground", "an emitter above the ground, z > 0"));
    }
    let colour = of.colour()?;
    let merged = of.optional(|of| of.flag("whether shadows are merged, on or off"))?.unwrap_or(true);
    Ok(Statement::Shadow { tree, tree_type, emitter, colour, merged })
}
