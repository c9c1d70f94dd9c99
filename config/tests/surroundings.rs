//! What a scenario states for L-systems of files: constants, also as levels of a factor, and shapes of its site.
//!
//! Each treatment has the model of its own constants and shapes; what is wrong with them is told where it is stated.

use phytomer_config::{Report, Resolved, validate_texts};
use phytomer_sim::plant::{Plant, Seed};
use phytomer_sim::plot::Plot;

const SPECIES: &str = "name = \"own\"\nmodel = \"lsystem\"\ntick = \"a step\"\nfile = \"own.l\"\n";
const SCENARIO: &str = "name = \"a\"\nspecies = \"own\"\nplants = 2\nages = { until = 2 }\n";

/// Two lines of the length a; b is the length of what follows.
const CONSTANTS: &str = "#define a 1\n#define b 5\nAxiom: F(a)F(a)\nF(x) --> F(x)F(b)\n";

fn read(scenario: &str, species: &str, file: &str) -> Result<Resolved, Report> {
    validate_texts("a", &[("a", scenario), ("own", species), ("own.l", file)])
}

fn sound(scenario: &str, species: &str, file: &str) -> Resolved {
    read(scenario, species, file).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn refused(scenario: &str, species: &str, file: &str) -> String {
    read(scenario, species, file).expect_err("it is wrong").render(false)
}

/// A plant of a cohort after a step.
fn grown(resolved: &Resolved, cohort: usize, plant: u64) -> Plant {
    let seed = Seed { plant: plant as u32, draws: plant, run_seed: 1, component_limit: 1000, keep_events: false };
    let mut plot = Plot::of_one(resolved.models()[cohort], &seed);
    plot.grow_to(1).expect("room to grow");
    plot.plants.remove(0)
}

/// The lengths of a plant of the first replicate of each treatment.
fn lengths(resolved: &Resolved) -> Vec<Vec<f32>> {
    let trial = resolved.trial();
    let of = |treatment| grown(resolved, trial.cohorts_of(treatment, 0)[0], 0).nodes.length;
    (0..trial.treatments().len()).map(of).collect()
}

#[test]
fn levels_set_constants() {
    let levels = "[define]\nb = 7\n[[experiment.factor]]\nname = \"vigour\"\n\
                  level = [{ name = \"low\" }, { name = \"high\", define = { a = 3 } }, { name = \"as low\" }]\n";
    let resolved = sound(&format!("{SCENARIO}{levels}"), SPECIES, CONSTANTS);
    assert_eq!(lengths(&resolved), [[1.0, 7.0, 1.0, 7.0], [3.0, 7.0, 3.0, 7.0], [1.0, 7.0, 1.0, 7.0]]);
    assert_eq!(resolved.trial().cohorts().len(), 2, "equal constants are one model");
    // The scenario's constants take the place of those of the species.
    let own = format!("{SPECIES}[define]\na = 2\nb = 2\n");
    let resolved = sound(&format!("{SCENARIO}{levels}"), &own, CONSTANTS);
    assert_eq!(lengths(&resolved)[0..2], [[2.0, 7.0, 2.0, 7.0], [3.0, 7.0, 3.0, 7.0]]);
    let plain = sound(SCENARIO, SPECIES, CONSTANTS);
    assert_eq!((lengths(&plain), plain.models().len()), (vec![vec![1.0, 5.0, 1.0, 5.0]], 1));
}

/// A law of a scenario is drawn once a plant, as that of a species is, and with the same draws.
#[test]
fn laws_of_a_scenario_are_drawn_once_a_plant() {
    let law = "[define]\na = { uniform = { min = 2, max = 3 } }\n";
    let of_scenario = sound(&format!("{SCENARIO}{law}"), SPECIES, CONSTANTS);
    let of_species = sound(SCENARIO, &format!("{SPECIES}{law}"), CONSTANTS);
    let firsts = |resolved: &Resolved| (0..20).map(|plant| grown(resolved, 0, plant).nodes.length).collect::<Vec<_>>();
    let found = firsts(&of_scenario);
    assert_eq!(found, firsts(&of_species));
    assert!(found.iter().all(|lengths| lengths[0] == lengths[2] && (2.0..=3.0).contains(&lengths[0])), "{found:?}");
    assert!(found.windows(2).any(|pair| pair[0][0] != pair[1][0]), "{found:?}");
}

#[test]
fn constants_that_nothing_has_are_told_where_they_are_stated() {
    let told = refused(&format!("{SCENARIO}[define]\nc = 1\n"), SPECIES, CONSTANTS);
    assert!(told.contains("a:6:") && told.contains("no constant is named `c`"), "{told}");
    let level = "[[experiment.factor]]\nname = \"vigour\"\nlevel = [{ name = \"low\" },\n{ name = \"high\", define = { c = 3 } }]\n";
    let told = refused(&format!("{SCENARIO}{level}"), SPECIES, CONSTANTS);
    assert!(told.contains("a:8:") && told.contains("no constant is named `c`"), "{told}");
    let told =
        refused(&format!("{SCENARIO}[define]\na = {{ uniform = {{ min = 3, max = 2 }} }}\n"), SPECIES, CONSTANTS);
    assert!(told.contains("a:6:") && !told.contains("own"), "{told}");
    let told = refused(SCENARIO, &format!("{SPECIES}[define]\nc = 1\n"), CONSTANTS);
    assert!(told.contains("own:6:") && told.contains("no constant is named `c`"), "{told}");
    let buds = SCENARIO.replace("\"own\"", "\"coffee\"");
    let told = refused(&format!("{buds}[define]\na = 1\n"), SPECIES, CONSTANTS);
    assert!(told.contains("no species of this run is an L-system"), "{told}");
}

/// A shape of the site is called as one of the species is, and takes its place where both have the name.
#[test]
fn files_call_shapes_of_the_site() {
    const ASKS: &str = "Axiom: X\nX --> F(2 + inside_crown(0, 1.5, 0) + prune(0, 1.5, 0))\n";
    let shape = |name: &str, height: f64| format!("[{name}]\nform = \"box\"\nsize_m = [2, 2, {height}]\n");
    let length = |scenario: &str, species: &str| {
        lengths(&sound(&format!("{SCENARIO}{scenario}"), &format!("{SPECIES}{species}"), ASKS)).concat()
    };
    let own = shape("shape.crown", 1.0) + &shape("shape.prune", 1.0);
    assert_eq!(length("", &own), [3.0]);
    assert_eq!(length(&shape("site.shape.crown", 2.0), &own), [4.0]);
    assert_eq!(length(&(shape("site.shape.crown", 2.0) + &shape("site.shape.prune", 2.0)), ""), [3.0]);
    let told = refused(SCENARIO, SPECIES, ASKS);
    assert!(told.contains("own.l:2:13") && told.contains("[site.shape.crown]"), "{told}");
    // A level may set the shape, and a fault of a shape is told once.
    let level = format!(
        "{SCENARIO}{}[[experiment.factor]]\nname = \"clipped\"\nlevel = [{{ name = \"low\" }}, {{ name = \"high\", \
         site = {{ shape = {{ crown = {{ form = \"box\", size_m = [2, 2, 2] }} }} }} }}]\n",
        shape("site.shape.crown", 1.0)
    );
    assert_eq!(lengths(&sound(&level, &format!("{SPECIES}{}", shape("shape.prune", 1.0)), ASKS)), [[3.0], [4.0]]);
    let wrong = "[site.shape.crown]\nform = \"half_space\"\npoint_m = [0, 0, 0]\nnormal = [0, 0, 0]\n";
    let told = refused(&format!("{SCENARIO}{wrong}"), &format!("{SPECIES}{}", shape("shape.prune", 1.0)), ASKS);
    assert!(told.contains("length 0") && !told.contains("own"), "{told}");
}

#[test]
fn environments_are_read_and_refused() {
    const QUERY: &str = "Axiom: F?E(0)\n?E(x) --> F(1 + x)\n";
    let species = |environment: &str| format!("{SPECIES}{environment}");
    let last = |environment: &str| lengths(&sound(SCENARIO, &species(environment), QUERY))[0][1];
    assert_eq!(last("environment = { gives = \"collision\", radius_m = 0.5 }\n"), 2.0);
    assert_eq!(last(""), 1.0);
    let field = "environment = { gives = \"field\", shape = { form = \"sphere\", at_m = [0, 0, 1], radius_m = 1 } }\n";
    assert_eq!(last(field), 2.5);
    let told = |environment: &str| refused(SCENARIO, &species(environment), QUERY);
    let light = told("environment = { gives = \"light\" }\n");
    assert!(light.contains("own:5:") && light.contains("no site has light yet"), "{light}");
    let unknown = told("environment = { gives = \"field\", shape = \"crown\" }\n");
    assert!(unknown.contains("there is no shape `crown`"), "{unknown}");
    let radius = told("environment = { gives = \"collision\", radius_m = -1 }\n");
    assert!(radius.contains("radius_m"), "{radius}");
    let unasked = refused(SCENARIO, &species("environment = { gives = \"collision\", radius_m = 1 }\n"), "Axiom: F\n");
    assert!(unasked.contains("own:5:") && unasked.contains("no module `?E`"), "{unasked}");
}
