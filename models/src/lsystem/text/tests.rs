//! Plants of L-systems against the numbers of the papers: Synthetic Topiary (Prusinkiewicz, James & Měch 1994) and The
//! Algorithmic Beauty of Plants (Prusinkiewicz & Lindenmayer 1990 ch. 2), their life tables, and the contract.

use super::{TextModel, TextSystem};
use crate::contract;
use phytomer_sim::clock::Tick;
use phytomer_sim::model::Grow as _;
use phytomer_sim::plant::{Cause, Kind, NodeId, OrganId, Plant};
use phytomer_sim::pose::{node_frame, pose};
use std::collections::BTreeMap;

/// L-system 3: a structure pruned to an ellipse.
pub(super) const ELLIPSE: &str = "\
lsystem: 1
Axiom: A
A --> [+B][-B]F?P(0,0)A
B --> F?P(0,0)@oB
?P(x,y) : 4*x*x + (y-10)*(y-10) > 100 --> [+(2*y)F][-(2*y)F]%
endlsystem
";

/// L-system 4 with T → ε and contexts that see past brackets and turns.
pub(super) const BOX: &str = "\
lsystem: 1
#define L 5.2
#define prune(x,y) ((x < -L/2) || (x > L/2) || (y < 0) || (y > L))
consider: F A ?P S T @o
Axiom: FA?P(0,0)
A > ?P(x,y) : !prune(x,y) --> @oF/(180)A
A > ?P(x,y) : prune(x,y) --> T%
F > T --> S
F > S --> SF
S --> *
T --> *
@o > S --> [+FA?P(0,0)]
endlsystem
";

/// L-system 5: a stochastic tree.
pub(super) const TREE: &str = "\
lsystem: 1
Axiom: FA(1)
A(k) : k < 3 --> /(90)[+(32)FA(k+1)]-(20)FA(k+1)
A(k) : k >= 3 --> /(90)[+(32)FA(k+1)]-(20)FA(k+1) : (2*k+1)/(k*k)
A(k) : k >= 3 --> /(90)B-(20)FA(k+1) : 1-(2*k+1)/(k*k)
endlsystem
";

/// L-system 6 in a cube of four internodes, with T → ε and contexts that see past brackets and turns.
pub(super) const CUBE: &str = "\
#define a 0\n#define b 1\n#define c (-5)
consider: F A B ?P S T @o
prune(x, y, z) = (x < −2) ‖ (x > 2) ‖ (y < 0) ‖ (y > 4) ‖ (z < −2) ‖ (z > 2)
ω : FA(1)?P(x, y, z)
p1 : A(k) > ?P(x, y, z) : !prune(x, y, z) → /(90)[+(32)FA(k+1)?P(x, y, z)]−(20)FA(k+1) : min{1, (2k+1)/k^2}
p2 : A(k) > ?P(x, y, z) : !prune(x, y, z) → /(90)B(k+1, k+1)−(20)FA(k+1) : max{0, 1 − (2k+1)/k^2}
p3 : A(k) > ?P(x, y, z) : prune(x, y, z) → T%
p4 : F > T → S
p5 : F > S → SF
p6 : S → ε
p7 : B(m, n) > S → [+(32)FA(a*m+b*n+c)?P(x, y, z)]
p8 : B(m, n) > F → B(m+1, n)
p9 : T → ε
";

/// Fig. 2.8a.
pub(super) const TERNARY: &str = "\
lsystem: 1
#define d1 94.74
#define d2 132.63
#define a 18.95
#define lr 1.109
#define vr 1.732
Axiom: !(1)F(200)/(45)A
A --> !(vr)F(50)[&(a)F(50)A]/(d1)[&(a)F(50)A]/(d2)[&(a)F(50)A]
F(l) --> F(l*lr)
!(w) --> !(w*vr)
endlsystem
";

pub(super) fn model(text: &str, view: &str, kinds: &[(&str, Kind)]) -> TextModel {
    let texts = [("plant.l", text), ("plant.v", view)].map(|(name, text)| (name.to_owned(), text.to_owned()));
    let system = TextSystem {
        file: "plant.l".to_owned(),
        view: Some("plant.v".to_owned()),
        texts: texts.into(),
        kinds: kinds.iter().map(|(name, kind)| ((*name).to_owned(), *kind)).collect(),
        step_m: 1.0,
        ..TextSystem::default()
    };
    system.compile().unwrap_or_else(|wrong| panic!("{wrong:#?}"))
}

pub(super) fn grown(model: &TextModel, age: Tick) -> Plant {
    let mut plot = contract::sown(model, &contract::seed_of(1, 0));
    if age > 0 {
        plot.grow_to(age).expect("room to grow");
    }
    let mut plant = plot.plants.remove(0);
    pose(&mut plant, age);
    plant
}

/// The tip of an internode in the coordinates of the turtle: the plant is (x, −z, y).
fn tip(plant: &Plant, node: usize) -> [f64; 3] {
    let [x, y, z] = node_frame(plant, phytomer_sim::plant::NodeId(node as u32)).base.map(f64::from);
    [x, z, -y]
}

fn count(plant: &Plant, kind: Kind) -> usize {
    plant.organs.kind.iter().filter(|of| **of == kind).count()
}

/// F → FF, three steps: births along the axis 0 3 2 3 1 3 2 3; numbers 0 4 2 5 1 6 3 7 behind that of the bud.
#[test]
fn what_is_put_in_mid_axis_is_numbered_after_what_was_there() {
    let doubling = model("Axiom: F\nF --> FF\n", "", &[]);
    let plant = grown(&doubling, 3);
    assert_eq!(plant.nodes.birth, [0, 3, 2, 3, 1, 3, 2, 3]);
    assert_eq!(plant.nodes.component.iter().map(|n| n - 1).collect::<Vec<_>>(), [0, 4, 2, 5, 1, 6, 3, 7]);
    let bearers: Vec<Option<Option<u32>>> = (0..9).map(|number| plant.bearer_at_birth(number)).collect();
    // Born: the bud; F; F on F; then one on each of both; then one on each of the four.
    let expected = [None, None, Some(1), Some(1), Some(2), Some(1), Some(3), Some(2), Some(4)];
    assert_eq!(bearers, expected.map(Some));
    let axes: Vec<f32> = plant.frames.base.iter().map(|base| base[2]).collect();
    assert!(axes.iter().zip(0..).all(|(z, i)| (z - i as f32).abs() < 1e-6), "{axes:?}");
}

/// L-system 3: from step 23 on 313 internodes, of which 21 are of the stem and 43 pairs are tentacles.
#[test]
fn a_structure_is_pruned_to_an_ellipse() {
    let ellipse = model(ELLIPSE, "angle increment: 60", &[("A", Kind::ApicalBud), ("B", Kind::ApicalBud)]);
    for (step, internodes) in [(1, 1), (2, 4), (3, 9)] {
        assert_eq!(grown(&ellipse, step).nodes.len(), internodes, "step {step}");
    }
    for step in [23, 25] {
        let plant = grown(&ellipse, step);
        let on_stem = plant.nodes.axis.iter().filter(|axis| axis.0 == 0).count();
        assert_eq!((plant.nodes.len(), on_stem), (313, 21), "step {step}");
        assert!(plant.axes.apex_end.iter().all(|end| *end <= 23), "no apex grows on");
    }
}

/// Fig. 4 and the life table of L-system 4.
#[test]
fn a_simple_tree_responds_to_pruning() {
    let kinds = [("A", Kind::ApicalBud), ("@o", Kind::AxillaryBud)];
    let pruned = model(BOX, "angle increment: 32", &kinds);
    let steps = [6, 7, 8, 10, 12, 13, 14, 17, 20, 40, 75, 94];
    let found: Vec<(usize, usize)> = steps
        .iter()
        .map(|step| grown(&pruned, *step))
        .map(|plant| (plant.nodes.len(), count(&plant, Kind::AxillaryBud)))
        .collect();
    let internodes = [6, 5, 6, 5, 6, 7, 7, 7, 6, 12, 18, 20];
    let buds = [5, 5, 4, 4, 3, 4, 4, 3, 3, 3, 2, 0];
    assert_eq!(found, internodes.into_iter().zip(buds).collect::<Vec<_>>());
    assert!(count(&grown(&pruned, 93), Kind::AxillaryBud) > 0, "step 94 is the first without a dormant bud");
    let plant = grown(&pruned, 94);
    let gone = |kind| plant.ledger.iter().filter(move |gone| gone.kind == kind);
    let short_lived: Vec<Tick> = gone(Kind::Internode).map(|gone| gone.death - gone.birth).collect();
    assert_eq!(plant.nodes.len() + short_lived.len(), 39, "internodes born");
    assert_eq!(short_lived, vec![2; 19]);
    let mut waited: BTreeMap<Tick, usize> = BTreeMap::new();
    gone(Kind::AxillaryBud).for_each(|gone| *waited.entry(gone.death - gone.birth).or_default() += 1);
    let expected = [(3, 10), (8, 4), (13, 1), (18, 1), (23, 1), (48, 1), (93, 1)];
    assert_eq!(waited, expected.into());
    assert!(plant.ledger.iter().all(|gone| gone.cause == Cause::Rewritten));
}

/// Fig. 4: the signal S stands at (0, 5) in steps 7 and 10, and at (0, 3) in step 20. S draws nothing, so that it
/// stands where the turtle comes to it.
#[test]
fn the_signal_stands_where_figure_4_shows_it() {
    use crate::lsystem::turtle::{Command, Turtle};
    use crate::lsystem::view::View;
    use phytomer_sim::random::PlantRandom;
    let pruned = model(BOX, "angle increment: 32", &[]);
    for (step, expected) in [(7, 5.0), (10, 5.0), (20, 3.0)] {
        let derived = pruned.derive(PlantRandom::new(1, 0), step).expect("a step");
        let mut turtle = Turtle::new(&View { angle_deg: 32.0, ..View::default() });
        let mut found = Vec::new();
        for module in derived.string().modules() {
            let name = pruned.program().symbols().name(module.symbol);
            if name == "S" {
                found.push(turtle.state().frame.position);
            }
            turtle.follow(Command::of(name), module.parameters);
        }
        let [[x, y, z]] = found[..] else { panic!("one signal in step {step}: {found:?}") };
        assert!(x.abs() + (y - expected).abs() + z.abs() < 1e-12, "step {step}: {x} {y} {z}");
    }
}

/// Numbers of any size in a surface, a view file and a string make a plant of finite numbers.
#[test]
fn numbers_of_any_size_are_drawn() {
    use super::TextSystem;
    let head = [
        "-1e308 1e308 -1e308 1e308 -1e308 1e308",
        "CONTACT POINT X: 0.0 Y: 0.0 Z: 0.0",
        "END POINT X: 0.0 Y: 1.0 Z: 0.0",
        "HEADING X: 0.0 Y: 1.0 Z: 0.0",
        "UP X: 0.0 Y: 0.0 Z: 1.0",
        "SIZE: 1e-300",
        "p",
        "TOP COLOR: 0 DIFFUSE: 1.0 BOTTOM COLOR: 0 DIFFUSE: 1.0",
        "AL: ~ A: ~ AR: ~",
        "L: ~ R: ~",
        "BL: ~ B: ~ BR: ~\n",
    ];
    let row = |y: &str| format!("-1e306 {y} 0 -1e303 {y} 1e305 1e303 {y} 0 1e306 {y} 0\n");
    let surface = format!("{}{}{}{}{}", head.join("\n"), row("-1e306"), row("0"), row("1e300"), row("1e306"));
    let text = "Axiom: F(1e300)[+(30)~p(1e300)]F(1e300){.f(1e200)+(90).f(1e200)+(90).}\n";
    let texts = [("plant.l", text), ("plant.v", "surface: p p.s 1e300\n"), ("p.s", &surface)];
    let system = TextSystem {
        file: "plant.l".to_owned(),
        view: Some("plant.v".to_owned()),
        texts: texts.map(|(name, text)| (name.to_owned(), text.to_owned())).into(),
        step_m: 1000.0,
        ..TextSystem::default()
    };
    let model = system.compile().unwrap_or_else(|wrong| panic!("{wrong:?}"));
    let plant = grown(&model, 0);
    assert_eq!((plant.nodes.len(), plant.organs.len()), (2, 2));
    let organs = [0, 1].map(phytomer_sim::plant::OrganId).into_iter();
    let corners = organs.flat_map(|organ| plant.outline_of(organ).to_vec()).flatten();
    let numbers = plant.nodes.length.iter().chain(&plant.organs.area).chain(plant.frames.base.as_flattened());
    assert!(numbers.copied().chain(corners).all(f32::is_finite), "{:?}", plant.organs.area);
}

/// What follows `%` is cut off and pruned; what becomes a flower has flowered.
#[test]
fn what_vanishes_has_a_cause() {
    let text = "Axiom: FAF[+F~l]\nA --> K\nF > [ --> F\nK --> F%\n";
    let kinds = [("A", Kind::ApicalBud), ("K", Kind::Flower)];
    let flowering = model(text, "angle increment: 90", &kinds);
    let plant = grown(&flowering, 1);
    assert_eq!((plant.axes.apex_end[0], plant.axes.apex_fate[0]), (1, phytomer_sim::plant::ApexFate::Flowered));
    assert_eq!((plant.nodes.len(), count(&plant, Kind::Flower), count(&plant, Kind::Leaf)), (3, 1, 1));
    let plant = grown(&flowering, 2);
    let causes: Vec<(Kind, Cause)> = plant.ledger.iter().map(|gone| (gone.kind, gone.cause)).collect();
    let pruned = |kind| (kind, Cause::Pruned);
    assert!(causes.contains(&(Kind::Flower, Cause::Rewritten)), "{causes:?}");
    let all = [Kind::Leaf, Kind::Internode, Kind::Internode].map(pruned);
    assert!(all.iter().all(|one| causes.contains(one)), "{causes:?}");
    assert_eq!(plant.nodes.len(), 2, "the first internode, and that which the flower became");
}

/// What a homomorphism draws goes as its module goes.
#[test]
fn what_is_drawn_for_a_module_is_cut_with_it() {
    let text = "Lsystem: 1\nAxiom: FXMM\nX --> Y\nY --> %\nhomomorphism\nM --> F[+F]\nendlsystem\n";
    let model = model(text, "angle increment: 90", &[]);
    assert_eq!((grown(&model, 0).nodes.len(), grown(&model, 1).nodes.len()), (5, 5));
    let plant = grown(&model, 2);
    assert_eq!((plant.nodes.len(), plant.axes.len(), plant.ledger.len()), (1, 1, 6));
    assert!(plant.ledger.iter().all(|gone| gone.cause == Cause::Pruned && gone.birth == 0), "{:?}", plant.ledger);
}

/// Fig. 2.8: 2·3ⁿ − 1 internodes; the squares of the widths of the last generation sum up to 3ⁿ; the mean tip.
#[test]
fn a_tree_of_ternary_branching() {
    let view = "tropism direction: 0.00,-1.00,0.00\ninitial elasticity: 0.22\ninitial line width: 1";
    let ternary = model(TERNARY, view, &[]);
    for step in 0..=6 {
        let plant = grown(&ternary, step);
        let tips = 3_usize.pow(step);
        assert_eq!(plant.nodes.len(), 2 * tips - 1, "step {step}");
    }
    let plant = grown(&ternary, 6);
    let is_last: Vec<bool> = (0..plant.nodes.len() as u32)
        .map(|node| !plant.nodes.parent.contains(&phytomer_sim::plant::NodeId(node)))
        .collect();
    let tips: Vec<[f64; 3]> =
        (0..plant.nodes.len()).filter(|node| is_last[*node]).map(|node| tip(&plant, node)).collect();
    assert_eq!(tips.len(), 729);
    let mean = [0, 1, 2].map(|i| tips.iter().map(|tip| tip[i]).sum::<f64>() / 729.0);
    let expected = [-43.179219, 784.271207, 3.687640];
    assert!(mean.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3), "{mean:?}");
}

/// A plant draws a constant once for its whole life; a constant that is drawn changes no other.
/// A cylinder of two parts over a contour, and a leaf that is a curved surface: both stated where they stand, at their
/// size in metres.
#[test]
fn cylinders_have_their_contours_and_leaves_their_surfaces() {
    let surface = "0 1 0 1 0 0\nCONTACT POINT X: 0 Y: 0 Z: 0\nEND POINT X: 0 Y: 1 Z: 0\nHEADING X: 0 Y: 1 Z: 0\n\
                   UP X: 0 Y: 0 Z: 1\nSIZE: 1\npatch\n";
    let rows = ["0", "0.4", "0.6", "1"].map(|y| ["0", "0.4", "0.6", "1"].map(|x| format!("{x} {y} 0")).join(" "));
    let texts = [
        ("a.l", "Axiom: @#(2)@Gsf@Gcf@Ge~l(2)F\nA --> A\n".to_owned()),
        ("a.v", "initial line width: 1\nsurface: l l.s 3 4 4\ncontour: 2 c.con\n".to_owned()),
        ("l.s", format!("{surface}{}\n", rows.join("\n"))),
        ("c.con", "4 2 closed\n1 0\n0 1\n-1 0\n0 -1\n".to_owned()),
    ];
    let system = TextSystem {
        file: "a.l".to_owned(),
        view: Some("a.v".to_owned()),
        texts: texts.map(|(name, text)| (name.to_owned(), text)).into(),
        step_m: 0.1,
        ..TextSystem::default()
    };
    let model = system.compile().unwrap_or_else(|wrong| panic!("{wrong:?}"));
    let plant = grown(&model, 1);
    let sections: Vec<_> = (0..3).map(|node| plant.own_looks.section_of(NodeId(node))).collect();
    assert_eq!(sections, [Some(0), Some(0), None]);
    let (place, scale) = plant.stated_organs.surface(OrganId(0)).expect("a surface");
    assert_eq!((place, scale), (0, [0.2; 3]));
    // A square of three steps of 0.1 m, twice as large.
    assert!((plant.organ_area::<f64>(OrganId(0), 1) - 0.36).abs() < 1e-6);
    assert!((plant.organs.length[0] - 0.6).abs() < 1e-6);
    let sheets = phytomer_looks::Paints::of(&plant.habit);
    assert_eq!((sheets.surface(0).map(|surface| surface.faces().len()), sheets.sections().len()), (Some(32), 1));
    // The closed B-spline through four points at a distance of 1 is no circle, and has less than its area.
    let bulks = [0, 2].map(|node| plant.own_looks.bulk_of(NodeId(node)));
    let of_contour = sheets.sections()[0].bulk([0.3, 0.2], 7.0);
    assert!((bulks[0] - of_contour).abs() < 1e-6 && of_contour < 0.95, "{bulks:?} {of_contour}");
    assert_eq!(bulks[1], 1.0);
}

#[test]
fn plants_draw_constants() {
    use crate::fault::Path;
    use crate::law::{Domain, ValueRange, Variate};
    let law = |json: &str| {
        let law: Variate = serde_json::from_str(json).expect("a law");
        let range = ValueRange { min: 0.0, max: 100.0, what: "a number" };
        law.compile(&Domain::ONCE, &Path::root(), range).expect("a sound law")
    };
    let lengths = |define: &[(&str, &str)]| {
        let texts = BTreeMap::from([("plant.l".to_owned(), "Axiom: F(a)\nF(x) --> F(x)F(b)\n".to_owned())]);
        let define = define.iter().map(|(name, json)| ((*name).to_owned(), law(json))).collect();
        let system = TextSystem { file: "plant.l".to_owned(), texts, define, step_m: 1.0, ..TextSystem::default() };
        let model = system.compile().unwrap_or_else(|wrong| panic!("{wrong:?}"));
        contract::check(&model, 3, 5);
        let grown = |number| contract::grown(&model, 2, &contract::seed_of(1, number)).nodes.length;
        (0..40).map(grown).collect::<Vec<_>>()
    };
    let spread = r#"{ "uniform": { "min": 1, "max": 3 } }"#;
    let (one, both) = (lengths(&[("a", spread), ("b", "5")]), lengths(&[("a", spread), ("b", spread)]));
    let firsts: Vec<f32> = one.iter().map(|lengths| lengths[0]).collect();
    assert!(firsts.iter().all(|first| (1.0..=3.0).contains(first)), "{firsts:?}");
    assert!(firsts.windows(2).any(|pair| pair[0] != pair[1]), "{firsts:?}");
    assert!(one.iter().all(|lengths| lengths[1..] == [5.0; 3][..lengths.len() - 1]));
    assert_eq!(firsts, both.iter().map(|lengths| lengths[0]).collect::<Vec<_>>());
    assert!(both.iter().all(|lengths| lengths[0] != lengths[1] && lengths[1] == lengths[2]));
}

/// A number that is none stops the string at its production, and the plant says where.
#[test]
fn a_string_that_comes_to_a_stop_says_why() {
    let model = model("Axiom: F(2)\nF(x) --> F(1/(x-x))\n", "", &[]);
    let mut plot = contract::sown(&model, &contract::seed_of(1, 0));
    let stopped = plot.grow_to(1).expect_err("it stops");
    assert!(stopped.to_string().starts_with("plant 0 came to a stop: plant.l:2:"), "{stopped}");
    assert_eq!(plot.grow_to(2).expect_err("it stays so"), stopped);
}

#[test]
fn systems_of_texts_keep_the_contract() {
    let apices = [("A", Kind::ApicalBud), ("B", Kind::ApicalBud), ("@o", Kind::AxillaryBud)];
    contract::check(&model(ELLIPSE, "angle increment: 60", &apices), 6, 3);
    contract::check(&model(BOX, "angle increment: 32", &[apices[0], apices[2]]), 24, 3);
    contract::check(&model(TREE, "", &[apices[0]]), 7, 3);
    let pruned = model(CUBE, "", &[apices[0], ("B", Kind::AxillaryBud)]);
    contract::check(&pruned, 12, 3);
    assert!(grown(&pruned, 12).ledger.len() > 10, "the cube cuts");
    contract::check(&model(TERNARY, "initial elasticity: 0.22", &[]), 4, 3);
    contract::check(&model("Axiom: F\nF --> FF\n", "", &[]), 6, 3);
    let model = model("Axiom: F\nF --> FF\n", "", &[]);
    assert_eq!(model.growth(), phytomer_sim::model::Growth::Rewrites);
}
