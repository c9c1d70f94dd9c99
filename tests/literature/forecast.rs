//! The forecast of `--dry-run` for every shipped species and scenario, against the mean of plants grown from fixed
//! seeds: by order, of axes, growth units, nodes and organs, at three ages.
//!
//! An exact figure lies within 4 standard errors of the sample's mean, an upper bound ("at most") not below it. The
//! number of plants follows from their size; a species with large plants is sampled at younger ages. Absent: species
//! that are made to be hard (`organs`).

use crate::grown::Sample;
use phytomer_config::{Kind, Model, SPECIES_ALONE_UNTIL, presets, validate, validate_species};
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};
use phytomer_sim::plant::{EventKind, Seed};
use phytomer_sim::{GrowthModel, Plant, Plot, Tick};
use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};

/// A plant that is expected to have more components is counted at a younger age.
const LARGE: f64 = 10_000.0;
/// The approximate number of components that are grown of a species.
const COMPONENTS: f64 = 400_000.0;
const PLANTS: std::ops::RangeInclusive<f64> = 50.0..=2_000.0;

/// The counts of the plants of one order.
const COUNTED: [&str; 4] = ["axes", "growth units", "nodes", "organs"];

/// The numbers that have appeared on one plant: by order, by age, by kind of count.
type Counts = Vec<Vec<[f64; 4]>>;

/// Compares the forecast for the plants of a model with grown plants. Returns the differences in words.
pub fn differences(name: &str, model: &dyn GrowthModel, until: Tick, components: f64) -> Vec<String> {
    let expected = model.expectation(until).unwrap_or_else(|| panic!("{name} has no forecast"));
    differences_from(&expected, name, model, until, components)
}

/// The same, with the forecast until that age.
fn differences_from(
    expected: &Expectation,
    name: &str,
    model: &dyn GrowthModel,
    until: Tick,
    components: f64,
) -> Vec<String> {
    let last = (1..=until).rev().find(|&age| expected.components(age) <= LARGE).unwrap_or(1);
    let ages = [last.div_ceil(3), (2 * last).div_ceil(3), last];
    let (fewest, most) = PLANTS.into_inner();
    let plants = (components / expected.components(last)).clamp(fewest, most) as u32;
    let orders = expected.orders.len();
    let counts: Vec<Counts> = (0..plants).map(|plant| counted(&grown(model, plant, last), &ages, orders)).collect();
    let mut differences = Vec::new();
    for (order, figures) in expected.orders.iter().enumerate() {
        for (nth, &age) in ages.iter().enumerate() {
            for (counted, what) in COUNTED.iter().enumerate() {
                let sample = Sample::of(counts.iter().map(|plant| plant[order][nth][counted]));
                let foretold = figure(figures, counted, age);
                if let Some(problem) = misses(&sample, foretold, certainty_of(expected, counted)) {
                    differences.push(format!("{name}: {what} of order {} at age {age}: {problem}", order + 1));
                }
            }
        }
    }
    differences
}

fn certainty_of(expected: &Expectation, counted: usize) -> Certainty {
    if COUNTED[counted] == "organs" { expected.organs } else { expected.axes }
}

fn figure(figures: &OrderExpectation, counted: usize, age: Tick) -> f64 {
    [&figures.axes, &figures.units, &figures.nodes, &figures.organs][counted][age as usize]
}

/// The figures that the mean of a sample contradicts.
fn misses(sample: &Sample, foretold: f64, certainty: Certainty) -> Option<String> {
    let (found, error) = (sample.mean(), standard_error(sample, foretold));
    let bound = 4.0 * error + unseen(sample, foretold) + 1e-9 * foretold.max(1.0);
    let holds = match certainty {
        Certainty::Exact => (found - foretold).abs() <= bound,
        Certainty::AtMost | Certainty::Bound => found - foretold <= bound,
        Certainty::About => true,
    };
    let mean = format!("{found:.4} grow on {} plants", sample.n());
    (!holds).then(|| format!("{certainty:?} {foretold:.4} foretold, {mean}, standard error {error:.4}"))
}

/// The standard error of the sample's mean. For a count so rare that few plants of the sample have any, the variance is
/// at least that of a Poisson number.
fn standard_error(sample: &Sample, foretold: f64) -> f64 {
    let is_rare = foretold * sample.n() < 25.0;
    let variance = if is_rare { sample.variance().max(foretold) } else { sample.variance() };
    (variance / sample.n()).sqrt()
}

/// The possible error of the mean where all plants of a sample have the same number. An event that none of n plants has
/// shown is at 4 standard errors less probable than 10/n, since (1 − 10/n)ⁿ is below 6e-5; at most it takes or adds the
/// whole number.
fn unseen(sample: &Sample, foretold: f64) -> f64 {
    if sample.variance() > 0.0 { 0.0 } else { 10.0 / sample.n() * foretold.max(sample.mean()).min(LARGE) }
}

fn grown(model: &dyn GrowthModel, plant: u32, age: Tick) -> Plant {
    let seed = Seed { plant, draws: plant.into(), run_seed: 1988, component_limit: 5_000_000, keep_events: true };
    let mut plot = Plot::of_one(model, &seed);
    plot.grow_to(age).expect("within the limit");
    plot.plants.remove(0)
}

fn counted(plant: &Plant, ages: &[Tick], orders: usize) -> Counts {
    let mut counts = vec![vec![[0.0; 4]; ages.len()]; orders];
    let mut count = |axis: usize, what: usize, birth: Tick| {
        // The last order of a bound has the higher ones too.
        let order = (usize::from(plant.axes.order[axis]) - 1).min(orders - 1);
        for (nth, age) in ages.iter().enumerate() {
            if birth <= *age {
                counts[order][nth][what] += 1.0;
            }
        }
    };
    for axis in 0..plant.axes.len() {
        count(axis, 0, plant.axes.appearance[axis]);
    }
    for event in plant.events.iter().flatten().filter(|event| event.kind == EventKind::Grew) {
        count(event.axis.index(), 1, event.tick);
    }
    let (nodes, organs) = (&plant.nodes, &plant.organs);
    for node in 0..nodes.len() {
        count(nodes.axis[node].index(), 2, nodes.birth[node]);
    }
    for organ in 0..organs.len() {
        // An organ planned for a branch that died before the organ appeared is not counted.
        if organs.birth[organ] < organs.death[organ] {
            count(nodes.axis[organs.node[organ].index()].index(), 3, organs.birth[organ]);
        }
    }
    counts
}

/// In a model that makes its plant anew at each age growth units are its nodes. Of a bound, which is far above what
/// grows, few and young plants tell enough.
fn differences_of(name: &str, of: &Model, model: &dyn GrowthModel, until: Tick, expected: &Expectation) -> Vec<String> {
    let mut differences = if is_bounded(of) {
        differences(name, model, until.min(20), 0.0)
    } else {
        differences_from(expected, name, model, until, COMPONENTS)
    };
    if !model.growth().keeps_its_past() {
        differences.retain(|difference| !difference.contains("growth units"));
    }
    differences
}

/// Whether a species has a forecast. The L-system of a file has none, for its strings depend on contexts and queries;
/// those of the shoots of Greene and the tips of Cohen, which depend on the room that is left, are bounds.
fn is_foretold(model: &Model) -> bool {
    match model {
        Model::Lsystem(system) => system.is_of_cells(),
        _ => true,
    }
}

/// Whether nothing but a bound is known of the plants of a model.
fn is_bounded(model: &Model) -> bool {
    matches!(model, Model::Greene(_) | Model::Cohen(_))
}

/// The trees of stems whose numbers follow from what is drawn. The clones of the first three are no whole number a
/// segment (Weber & Penn 1995 §4.2), and their means are estimates. The crowns of the others, shapes 5 and 8, have no
/// width at one end (§4.3); the stems there that would be under a millimetre long do not grow. Of the trees of Aono &
/// Kunii 1984 deviators move tips by more than the last branches are long, and might move one to nothing, where it
/// ends. The shoots of the ivy go from state to state by what they meet.
const DRAWN: [(&str, Certainty); 16] = [
    ("wp/black_oak", Certainty::About),
    ("wp/cottonwood", Certainty::About),
    ("wp/weeping_willow", Certainty::About),
    ("wp/balsam_fir", Certainty::AtMost),
    ("wp/black_spruce", Certainty::AtMost),
    ("wp/generic_tree_1v", Certainty::AtMost),
    ("wp/tamarack", Certainty::AtMost),
    ("wp/white_cedar", Certainty::AtMost),
    ("gmt2/11a", Certainty::AtMost),
    ("gmt2/11b", Certainty::AtMost),
    ("gmt2/11c", Certainty::AtMost),
    ("gmt2/11d", Certainty::AtMost),
    ("gmt2/11e", Certainty::AtMost),
    ("gmt3/12c", Certainty::AtMost),
    ("aono_kunii/pine", Certainty::AtMost),
    ("ivy", Certainty::About),
];

/// Every shipped species that has a forecast has it in closed form, but for those of which no more than a bound is
/// known, and for the named trees; and all grow as foretold.
#[test]
fn every_shipped_species_grows_as_foretold() {
    let species = presets(Kind::Species).into_par_iter().flat_map_iter(|(name, _)| {
        let resolved = validate_species(name, SPECIES_ALONE_UNTIL).unwrap_or_else(|report| panic!("{name}: {report}"));
        let until = resolved.shown_at();
        let of = &resolved.species.model;
        if !is_foretold(of) {
            assert!(resolved.model.expectation(until).is_none(), "{name} has a forecast, which is to be tested");
            return Vec::new();
        }
        let model = of.compile(until).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
        let expected = model.expectation(until).unwrap_or_else(|| panic!("{name} has no forecast"));
        let drawn = DRAWN.into_iter().find_map(|(drawn, certainty)| (drawn == *name).then_some(certainty));
        let known = drawn.or(is_bounded(of).then_some(Certainty::Bound)).unwrap_or(Certainty::Exact);
        let mut differences = differences_of(name, of, model.as_ref(), until, &expected);
        if expected.certainty() != known {
            differences.push(format!("{name}: {:?}, and {known:?} is known", expected.certainty()));
        }
        differences
    });
    let differences: Vec<String> = species.collect();
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

#[test]
fn every_shipped_scenario_grows_as_foretold() {
    let scenarios = presets(Kind::Scenario).into_par_iter().flat_map_iter(|(name, _)| {
        let resolved = validate(name).unwrap_or_else(|report| panic!("{name}: {report}"));
        if !is_foretold(&resolved.species.model) {
            return Vec::new();
        }
        let (model, until) = (resolved.model.as_ref(), resolved.scenario.ages.until);
        let expected = model.expectation(until).unwrap_or_else(|| panic!("{name} has no forecast"));
        differences_of(name, &resolved.species.model, model, until, &expected)
    });
    let differences: Vec<String> = scenarios.collect();
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

/// Flowers that open after the last age are no components: they are neither forecast nor counted against the limit.
#[test]
fn flowers_that_open_after_the_last_age_are_neither_foretold_nor_limited() {
    let folder = tempfile::tempdir().unwrap();
    let species = "name = 'late'\nsource = 'made up'\nmodel = 'buds'\ntick = 'a node'\n[[order]]\nleaf = { per_node = 0 }\n\
        flower = { lateral = 1, per_node = 8, delay = 500, life = 1 }\n";
    std::fs::write(folder.path().join("late.toml"), species).unwrap();
    let scenario = "name = 'late'\nspecies = 'late.toml'\nplants = 1\nages = { until = 120 }\n\
        limits = { max_components = 500 }\n";
    let path = folder.path().join("scenario.toml");
    std::fs::write(&path, scenario).unwrap();
    let resolved = validate(path.to_str().unwrap()).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let expected = resolved.model.expectation(120).unwrap();
    assert_eq!((expected.components(120), expected.certainty()), (121.0, Certainty::Exact));
    let limits = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 500, keep_events: false };
    let mut plot = Plot::of_one(resolved.model.as_ref(), &limits);
    plot.grow_to(120).expect("121 components grow");
    assert_eq!(plot.plants[0].lived_by(120), 121);
}
