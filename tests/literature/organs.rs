//! The expectation of organs that wait: flowers and fruits that never appear because their branch dies first, on
//! species made to be hard for the closed form; and the forecast where there is no closed form.
//!
//! Absent: the shipped species (`forecast`).

use crate::forecast::differences;
use phytomer_config::{ResolvedSpecies, validate, validate_species};
use phytomer_sim::Tick;
use phytomer_sim::expectation::Certainty;
use std::fs;

/// Enough for some thousand plants of each species.
const COMPONENTS: f64 = 4e6;

fn species(orders: &str, until: Tick) -> ResolvedSpecies {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("made.toml");
    fs::write(&path, text(orders)).unwrap();
    validate_species(path.to_str().unwrap(), until).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn text(orders: &str) -> String {
    format!("name = 'made'\nsource = 'made up'\nmodel = 'buds'\ntick = 'a node'\n{orders}")
}

fn assert_exact(orders: &str, until: Tick) {
    let model = species(orders, until).model;
    let expected = model.expectation(until).unwrap();
    assert_eq!(expected.certainty(), Certainty::Exact, "{orders}");
    assert_eq!(differences(orders, model.as_ref(), until, COMPONENTS), Vec::<String>::new());
}

/// One axis that dies with probability d a tick, a node a tick and on it a flower that opens n ticks later: of a node
/// made at tick t, which the apex has survived, the flower opens with (1 − d)ⁿ.
#[test]
fn flowers_of_one_axis_open_if_it_survives_their_delay() {
    let (death, delay, until) = (0.1_f64, 4, 20);
    let orders =
        format!("[[order]]\ndeath = {death}\nleaf = {{ per_node = 0 }}\nflower = {{ lateral = 1, delay = {delay} }}\n");
    let expected = species(&orders, until).model.expectation(until).unwrap();
    let opened: f64 = (1..=until - delay).map(|node| powered(1.0 - death, node + delay)).sum();
    let found = expected.orders[0].organs[until as usize];
    assert!((found - opened).abs() < 1e-8, "{found} foretold, {opened} by the sum");
    assert_exact(&orders, until);
}

fn powered(x: f64, n: Tick) -> f64 {
    (0..n).fold(1.0, |product, _| product * x)
}

/// Laterals in zones from both ends and in two states keep the branches alive on which flowers and fruits wait.
#[test]
fn flowers_wait_on_branches_that_their_laterals_keep_alive() {
    assert_exact(
        "states = ['strong', 'weak']
[[order]]
speed = '3/2'
death = 0.15
growth_unit = { nodes = { poisson = { mean = 1.4 } } }
flower = { lateral = 0.4, per_node = { empirical = [1, 1, 1] }, delay = { poisson = { mean = 2 } }, life = { empirical = [0, 1, 2] }, fruit_set = { expression = '0.2 + 0.05 * rank' } }
reiteration = { buds = 1, probability = 0.04, order = 1, delay = 1 }
[order.axillary]
buds = 2
delay = { empirical = [2, 1, 1] }
pattern = { zones = [
    { from = 'tip', first = 1, last = 1, ramification = 0.3, state = { strong = 1, weak = 2 } },
    { from = 'base', first = 1, last = 2, ramification = 0.2, state = 'weak' },
] }
[[order]]
death = { by_state = { strong = 0.1, weak = 0.4 } }
flower = { lateral = 0.5, delay = 3, fruit_set = 0.5, life = 2 }
transition = [{ from = 'strong', to = 'weak', probability = 0.2 }]
",
        9,
    );
}

/// Relays below the last node, forks, branches that persist, and terminal flowers with their fruits.
#[test]
fn flowers_wait_on_modules_that_are_relayed_or_divide() {
    assert_exact(
        "states = ['up', 'out']
[[order]]
death = 0.12
growth_unit = { nodes = { empirical = [1, 2, 2] }, per_step = { empirical = [0, 2, 1] } }
relay = { on = ['death'], count = { empirical = [1, 1, 1] }, probability = 0.6, below = { empirical = [1, 1, 1] }, delay = { empirical = [1, 1] } }
transition = [
    { from = 'up', to = 'out', probability = 0.2, sibling = 'others', relayed = true },
    { from = 'out', to = 'up', probability = 0.3 },
]
flower = { lateral = 0.5, delay = 2, fruit_set = 0.5, life = 2, terminal = { by_state = { up = 0, out = 0.2 } } }
fruit = { life = { empirical = [0, 1, 1] } }
axillary = { buds = 1, ramification = 0.3, delay = 1 }
[[order]]
death = { by_state = { up = 0.15, out = 0.25 } }
apex = { units = { empirical = [0, 1, 1, 1] }, persists = { empirical = [1, 1, 1, 1] }, fork = { axes = { empirical = [1, 0, 1] }, insertion_deg = 30 } }
flower = { lateral = 0.6, delay = { empirical = [1, 1, 1, 1] }, life = 1, fruit_set = 0.7 }
",
        9,
    );
}

/// The delay of a lateral is evaluated at the rank of its node.
#[test]
fn laterals_appear_after_the_delay_of_their_rank() {
    assert_exact(
        "[[order]]
growth_unit = { nodes = { empirical = [0, 1, 1, 1] } }
axillary = { buds = 1, ramification = 0.5, delay = { constant = { expression = '3 * (rank - 1)' } } }
[[order]]
death = 0.1
",
        10,
    );
}

/// Branches of released dormant buds and drawn zones are not independent of one another: the forecast of organs is a
/// bound from above, the other figures are exact, and plants have fewer organs.
#[test]
fn organs_without_a_closed_form_are_bounded() {
    let released = "[[order]]
death = 0.2
axillary = { buds = 2, ramification = 0.3 }
traumatic = { probability = 0.4 }
leaf = { per_node = 0 }
flower = { lateral = 1, per_node = 8, delay = 6 }
[[order]]
death = 0.5
leaf = { per_node = 0 }
flower = { lateral = 1, per_node = 8, delay = 6 }
";
    let drawn = released.replace("traumatic = { probability = 0.4 }\n", "").replace(
        "ramification = 0.3 }",
        "ramification = 0.3, pattern = { zones = [{ from = 'tip', first = { empirical = [0, 1, 1] } }] } }",
    );
    for orders in [released, &drawn] {
        let until = 14;
        let model = species(orders, until).model;
        let expected = model.expectation(until).unwrap();
        assert_eq!((expected.axes, expected.organs), (Certainty::Exact, Certainty::AtMost), "{orders}");
        assert!(expected.least_components(until) < 0.5 * expected.components(until));
        assert_eq!(differences(orders, model.as_ref(), until, COMPONENTS), Vec::<String>::new());
    }
}

/// A limit between the known number of components and an upper bound refuses no run; a limit below the known number
/// does.
#[test]
fn a_run_is_refused_on_what_is_known_and_not_on_a_bound() {
    let folder = tempfile::tempdir().unwrap();
    let orders = "[[order]]\ndeath = 0.1\naxillary = { buds = 1, ramification = 0.2 }\ntraumatic = { probability = 0.5 }\n\
        leaf = { per_node = 0 }\nflower = { lateral = 1, per_node = 20, delay = 9 }\n[[order]]\ndeath = 0.5\n";
    fs::write(folder.path().join("made.toml"), text(orders)).unwrap();
    let until = 30;
    let expected = species(orders, until).model.expectation(until).unwrap();
    let (least, most) = (expected.least_components(until), expected.components(until));
    let validated = |limit: f64| {
        let path = folder.path().join("scenario.toml");
        let limit = limit as u32;
        let scenario = format!(
            "name = 's'\nspecies = 'made.toml'\nplants = 1\nages = {{ until = {until} }}\nlimits = {{ max_components = {limit} }}\n"
        );
        fs::write(&path, scenario).unwrap();
        validate(path.to_str().unwrap()).map_err(|report| report.render(false))
    };
    assert!(expected.organs == Certainty::AtMost && most > 2.0 * least, "{least} to {most}");
    assert!(validated((least + most) / 2.0).is_ok());
    let refused = validated(least - 1.0).expect_err("an explosion");
    assert!(refused.contains("is expected to have at least"), "{refused}");
}
