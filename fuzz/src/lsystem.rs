//! L-systems with the files beside them: read, grown for some steps within small limits, drawn and posed.
//!
//! An input is a list of files (`several`). With a file `own` that is a species, which is read with
//! all others as the program does; without it the text `plant.l` is taken with its view file, surfaces, functions and
//! maps of colours, with kinds of modules (`kinds`), with what answers `?E` (`environment`), and with two shapes.
//! Absent: what is broken in them (`broken`), and the files that are right (`seeds`).

use super::several::files;
use phytomer_config::{Model, validate_texts};
use phytomer_models::fault::Path;
use phytomer_models::lsystem::text::{Environment, TextSystem};
use phytomer_models::shapes::{Named, Shapes, StatedShape};
use phytomer_rewriting::Limits;
use phytomer_sim::plant::{Kind, Plant, Seed};
use phytomer_sim::plot::Plot;
use phytomer_sim::pose::pose;

/// The steps of a plant.
const STEPS: u32 = 6;
/// The most that a derivation may come to.
const LIMITS: Limits = Limits { modules: 5000, rounds: 500_000 };

/// An L-system with the files beside it.
pub fn lsystem(data: &[u8]) {
    let files = files(data);
    let text = |content: &[u8]| String::from_utf8_lossy(content).into_owned();
    let texts: Vec<(&str, String)> = files.iter().map(|(name, content)| (name.as_str(), text(content))).collect();
    let system = if texts.iter().any(|(name, _)| *name == "own") {
        let texts: Vec<(&str, &str)> = texts.iter().map(|(name, text)| (*name, text.as_str())).collect();
        of_species(&texts)
    } else {
        Some(stated(&files, &texts))
    };
    let Some(mut system) = system else { return };
    system.limits = LIMITS;
    let Ok(model) = system.compile() else { return };
    let seed = Seed { plant: 1, draws: 1, run_seed: 1, component_limit: 10_000, keep_events: true };
    let mut plot = Plot::of_one(&model, &seed);
    for age in 1..=STEPS {
        if plot.grow_to(age).is_err() {
            return;
        }
        pose(&mut plot.plants[0], age);
        check(&plot.plants[0]);
    }
}

/// The L-system of a species that is right.
fn of_species(texts: &[(&str, &str)]) -> Option<TextSystem> {
    match validate_texts("own", texts) {
        Err(report) => {
            assert!(!report.render(false).is_empty());
            None
        }
        Ok(resolved) => {
            let Model::Lsystem(stated) = &resolved.species.model else { return None };
            stated.text_system(&Path::root())?.ok()
        }
    }
}

/// What an input says of its L-system without a species.
fn stated(files: &[(String, &[u8])], texts: &[(&str, String)]) -> TextSystem {
    let of = |name: &str| texts.iter().find(|(known, _)| *known == name).map_or("", |(_, text)| text.as_str());
    let named = |ending: &str| texts.iter().map(|(name, _)| *name).find(|name| name.ends_with(ending));
    let kinds = of("kinds").lines().filter_map(|line| {
        let (module, tag) = line.split_once(' ')?;
        Some((module.to_owned(), Kind::ALL.into_iter().find(|kind| kind.tag() == tag)?))
    });
    let shapes = shapes();
    let environment = match of("environment").trim().split_once(' ') {
        Some(("collision", radius)) => {
            let radius = radius.parse::<f64>().ok().filter(|radius| (1e-9..=1e6).contains(radius));
            radius.map(|radius_m| Environment::Collision { radius_m })
        }
        Some(("field", name)) => shapes.get(name).cloned().map(Environment::Field),
        _ => None,
    };
    TextSystem {
        file: "plant.l".to_owned(),
        view: named(".v").map(str::to_owned),
        colours: named(".map").or(named(".mat")).map(str::to_owned),
        texts: texts.iter().map(|(name, text)| ((*name).to_owned(), text.clone())).collect(),
        maps: files.iter().map(|(name, content)| (name.clone(), content.to_vec())).collect(),
        shapes,
        environment,
        kinds: kinds.collect(),
        continues_last: if of("continues").is_empty() { Vec::new() } else { vec!["F".to_owned()] },
        step_m: 0.5,
        ..TextSystem::default()
    }
}

/// The shapes that a file may call.
fn shapes() -> Named {
    let ball = StatedShape::Sphere { at_m: [0.0, 0.0, 1.0], radius_m: 1.5 };
    let block = StatedShape::Box { at_m: [0.0; 3], size_m: [2.0, 2.0, 3.0] };
    let shapes: Shapes = [("ball".to_owned(), ball), ("prune".to_owned(), block)].into();
    Named::of(&shapes, &Path::root(), &mut Vec::new())
}

/// What holds of every plant, whatever it was grown from.
fn check(plant: &Plant) {
    let nodes = &plant.nodes;
    for (node, parent) in nodes.parent.iter().enumerate() {
        assert!(parent.some().is_none_or(|parent| parent.index() < node), "a parent comes first");
    }
    let numbers = nodes.length.iter().chain(&nodes.primary_diameter).chain(&plant.organs.area);
    let numbers = numbers.chain(plant.frames.base.as_flattened());
    assert!(numbers.copied().all(f32::is_finite), "every number is finite");
    let mut components: Vec<u32> = nodes.component.iter().chain(&plant.organs.component).copied().collect();
    components.extend(&plant.axes.component);
    let all = components.len();
    components.sort_unstable();
    components.dedup();
    assert_eq!(components.len(), all, "a number is that of one component");
}
