//! The shipped L-systems as plants: numbers of *Synthetic Topiary* and of *The Algorithmic Beauty of Plants*, and what
//! is told of a species whose files are wrong.

use phytomer_config::{Report, ResolvedSpecies, validate_species, validate_texts};
use phytomer_sim::plant::{NodeId, Plant, Seed};
use phytomer_sim::plot::Plot;
use phytomer_sim::pose::{node_frame, pose};

fn species(name: &str) -> ResolvedSpecies {
    validate_species(name, 1).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn grown(name: &str, age: u32, seed: u64) -> Plant {
    let species = species(name);
    let seed = Seed { plant: 0, draws: 0, run_seed: seed, component_limit: 1_000_000, keep_events: true };
    let mut plot = Plot::of_one(species.model.as_ref(), &seed);
    plot.grow_to(age).expect("room to grow");
    let mut plant = plot.plants.remove(0);
    pose(&mut plant, age);
    plant
}

/// The tips of the internodes that bear none, in the coordinates of the turtle: the plant is (x, −z, y) in steps.
fn tips(plant: &Plant, step_m: f64) -> Vec<[f64; 3]> {
    let mut bears = vec![false; plant.nodes.len()];
    plant.nodes.parent.iter().filter_map(|parent| parent.some()).for_each(|parent| bears[parent.index()] = true);
    let ends = (0..plant.nodes.len()).filter(|node| !bears[*node]);
    let tip = |node: usize| {
        let [x, y, z] = node_frame(plant, NodeId(node as u32)).base.map(|x| f64::from(x) / step_m);
        [x, z, -y]
    };
    ends.map(tip).collect()
}

fn mean(points: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|i| points.iter().map(|point| point[i]).sum::<f64>() / points.len() as f64)
}

#[test]
fn every_shipped_l_system_can_be_read() {
    let names = phytomer_config::presets(phytomer_config::Kind::Species).iter().map(|(name, _)| *name);
    let own: Vec<&str> = names.filter(|name| name.starts_with("topiary/") || name.starts_with("abop/")).collect();
    assert_eq!(own.len(), 28);
    own.iter().for_each(|name| _ = species(name));
}

/// Figs. 2.6 and 2.7: 2ⁿ − 1 segments after n steps, and the mean tip of Fig. 2.6a.
#[test]
fn trees_of_two_daughters() {
    for figure in ["2.6a", "2.6b", "2.6c", "2.6d", "2.7a", "2.7b", "2.7c", "2.7d"] {
        for age in [1, 4, 8] {
            let plant = grown(&format!("abop/{figure}"), age, 1);
            assert_eq!(plant.nodes.len(), (1 << age) - 1, "{figure}, step {age}");
            assert!(plant.ledger.is_empty(), "{figure}: nothing vanishes");
        }
    }
    // The apices of step 10 stand on the segments that they have made: those of the last step.
    let plant = grown("abop/2.6a", 10, 1);
    let tips = tips(&plant, 1.0);
    // Each of the 512 last segments bears two apices.
    assert_eq!((tips.len(), plant.nodes.len()), (512, 1023));
    let (found, expected) = (mean(&tips), [-0.023129, 2.911796, -0.508310]);
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-6), "{found:?}");
}

/// Fig. 2.7 is GMT1 of Aono & Kunii 1984 with h1 = a1 and h2 = −a2, turned by 90° about the trunk, point for point.
#[test]
fn sympodial_trees_are_gmt1() {
    use phytomer_models::fault::Path;
    use phytomer_models::geometric::{Descriptor, GeometricTree, Gmt1, Rule};
    for (figure, r2, a1, a2) in
        [("a", 0.7, 5.0, 65.0), ("b", 0.7, 10.0, 60.0), ("c", 0.8, 20.0, 50.0), ("d", 0.8, 35.0, 35.0)]
    {
        let rule = Rule {
            h1_deg: Some(a1.into()),
            h2_deg: Some((-a2).into()),
            r1: Some(0.9.into()),
            r2: Some(r2.into()),
            diameter_ratio: Some(0.707.into()),
            ..Rule::default()
        };
        let gmt1 = Gmt1::from(GeometricTree::from(Descriptor::new(rule, 7)));
        let model = gmt1.compile(8, &Path::root()).expect("a sound tree");
        let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 100_000, keep_events: false };
        let mut plot = Plot::of_one(&model, &seed);
        plot.grow_to(8).expect("room to grow");
        let mut tree = plot.plants.remove(0);
        pose(&mut tree, 8);
        let points = |plant: &Plant, turned: bool| {
            let nodes = (0..plant.nodes.len() as u32).map(|node| node_frame(plant, NodeId(node)).base);
            let mut points: Vec<[f32; 3]> =
                nodes.map(|[x, y, z]| if turned { [-y, x, z] } else { [x, y, z] }).collect();
            points.sort_by(|one, other| one.partial_cmp(other).expect("numbers"));
            points
        };
        let plant = grown(&format!("abop/2.7{figure}"), 8, 1);
        let (own, theirs) = (points(&plant, true), points(&tree, false));
        assert_eq!(own.len(), theirs.len());
        let far = |point: &[f32; 3]| {
            let distance = |other: &[f32; 3]| (0..3).map(|i| (point[i] - other[i]).abs()).fold(0.0, f32::max);
            theirs.iter().map(distance).fold(f32::INFINITY, f32::min)
        };
        let furthest = own.iter().map(far).fold(0.0, f32::max);
        assert!(furthest < 1e-5, "2.7{figure}: {furthest}");
    }
}

/// Fig. 2.8: 2·3ⁿ − 1 segments; the widths that a step has made hold the square of the first: w² sums up to 3ⁿ.
#[test]
fn trees_of_three_daughters() {
    for figure in ["2.8a", "2.8b", "2.8c", "2.8d"] {
        let plant = grown(&format!("abop/{figure}"), 5, 1);
        assert_eq!(plant.nodes.len(), 2 * 243 - 1, "{figure}");
    }
    let plant = grown("abop/2.8a", 6, 1);
    let (found, expected) = (mean(&tips(&plant, 0.01)), [-43.179219, 784.271207, 3.687640]);
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3), "{found:?}");
}

/// Fig. 2 of Aono & Kunii 1984: level 4 of K1 and K2, as files of their own, by the drawing rules with |g| = 1. The
/// mean end of the axes that grow on, x to the right and y up.
#[test]
fn k1_and_k2_are_files() {
    use phytomer_sim::plant::{ApexFate, AxisId};
    for (name, mean_end) in [("aono_kunii/k1", [-1.508883, 5.465990]), ("aono_kunii/k2", [0.0, 4.767767])] {
        let plant = grown(name, 3, 1);
        let growing = (0..plant.axes.len()).filter(|axis| plant.axes.apex_fate[*axis] == ApexFate::Alive);
        let ends: Vec<[f64; 3]> = growing
            .map(|axis| phytomer_sim::pose::bud_frame(&plant, AxisId(axis as u32)).base.map(f64::from))
            .collect();
        assert_eq!(ends.len(), 8, "{name}");
        let [x, y, z] = mean(&ends);
        assert!((x - mean_end[0]).abs() < 1e-5 && y.abs() < 1e-5 && (z - mean_end[1]).abs() < 1e-5, "{name}: {x} {z}");
    }
}

/// A D0L-system is the same plant whether its strings stand in the species file or in a file of their own.
#[test]
fn cells_of_a_file_are_those_of_the_species_file() {
    let cells = "branching_deg = 30\n[cell.g]\nlength_m = 1\n[cell.d]\nlength_m = 2\n";
    let head = "name = \"own\"\nmodel = \"lsystem\"\ntick = \"a level\"\n";
    let stated = format!("{head}axiom = \"g\"\nproduction = {{ g = \"d(g)dg\" }}\n{cells}");
    let filed = format!("{head}file = \"own.l\"\nsyntax = \"d0l\"\n{cells}");
    let text = "#define LONG d(g)d\nn = 4\nw = g\ng → LONG g\n";
    let grown = |texts: &[(&str, &str)]| {
        let species = validate_texts("own", texts).unwrap_or_else(|report| panic!("{}", told(report)));
        let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 1000, keep_events: true };
        let mut plot = Plot::of_one(species.model.as_ref(), &seed);
        plot.grow_to(4).expect("room to grow");
        (species.scenario.ages.until, plot.plants.remove(0))
    };
    let (_, one) = grown(&[("own", stated.as_str())]);
    let (shown_at, other) = grown(&[("own", filed.as_str()), ("own.l", text), ("other.v", "angle increment: many\n")]);
    assert_eq!(
        (one.nodes.len(), &one.nodes.component, &one.nodes.length),
        (other.nodes.len(), &other.nodes.component, &other.nodes.length)
    );
    assert_eq!((&one.axes.azimuth, &one.axes.bearer), (&other.axes.azimuth, &other.axes.bearer));
    assert_eq!(shown_at, 4, "after the steps that the file states");
    for (text, place, problem) in [
        ("w = g\ng → d(x)g\n", "own.l:2:1", "`x` at column 7 is no cell"),
        ("\nw = (g)\n", "own.l:2:1", "the branch at column 5 is borne by nothing"),
        ("w = g\ng → d(g\n", "own.l:2:1", "1 branches do not end"),
        ("w = g\nx → g\n", "own.l:2:1", "unknown cell `x`"),
        ("w = g\nd < g → d\n", "own.l:2:1", "this production has a context"),
        ("w = d\nd → ε\n", "own.l:1:1", "`d` ends an axis"),
    ] {
        let report = told(validate_texts("own", &[("own", &filed), ("own.l", text)]).expect_err(text));
        assert!(report.contains(place) && report.contains(problem), "{text}\n{report}");
    }
    let report = told(
        validate_texts("own", &[("own", &stated.replace("axiom", "syntax = \"d0l\"\naxiom"))]).expect_err("no file"),
    );
    assert!(report.contains("`syntax` stands without `file`"), "{report}");
    let bare = format!("{head}file = \"own.l\"\nsyntax = \"d0l\"\nbranching_deg = 30\n");
    let report = told(validate_texts("own", &[("own", &bare), ("own.l", text)]).expect_err("no cells"));
    assert!(report.contains("the key `cell` is missing"), "{report}");
    let beside = format!("{filed}[kinds]\ng = \"apical_bud\"\n");
    let report = told(validate_texts("own", &[("own", &beside), ("own.l", text)]).expect_err("kinds"));
    assert!(report.contains("`kinds` stands beside `syntax = \"d0l\"`"), "{report}");
}

/// Borchert & Slade 1981: N(k+1) = min{b_max N(k), 2π l² (k+1)²/σ_min}, of which the tree makes the whole part. Season
/// k is the age k − 1. All segments of a season together have the cross section of the crown's shoots.
#[test]
fn the_seasons_of_borchert_and_slade_have_the_shoots_of_their_formula() {
    let (maximum, area) = (2.0_f64, 2.0 * std::f64::consts::PI / 2.5);
    let plant = grown("borchert_slade", 17, 1);
    let mut shoots = 1.0_f64;
    for birth in 0..=17_u32 {
        let season = f64::from(birth + 1);
        shoots = if birth == 0 { 1.0 } else { (maximum * shoots).min(area * season * season) };
        let born: Vec<usize> = (0..plant.nodes.len()).filter(|node| plant.nodes.birth[*node] == birth).collect();
        assert_eq!(born.len(), shoots.floor() as usize, "season {season}");
        let section: f64 =
            born.iter().map(|node| f64::from(plant.nodes.primary_diameter[*node])).map(|width| width * width).sum();
        assert!((section / (814.0 * 1e-4) - 1.0).abs() < 1e-4, "season {season}: {section}");
    }
    // Of 814 shoots each has six leaves; those of earlier seasons have fallen.
    assert_eq!((shoots.floor(), plant.organs.len()), (814.0, 6 * 814));
}

/// L-system 1: one of four outcomes, whose modules stand as buds.
#[test]
fn l_system_1_stands_as_buds() {
    for seed in 0..20 {
        let plant = grown("topiary/1", 1, seed);
        assert_eq!(plant.organs.len() + plant.nodes.len(), 5, "four modules, and the foot that they stand on");
    }
}

/// L-system 6: nothing stands a whole internode outside its cube, and what grew outside is gone. Of the three trees of
/// Fig. 7, from left to right, each is denser than that before it.
#[test]
fn l_system_6_fills_its_cube() {
    let mut before = 0;
    for (name, age, least) in
        [("topiary/6", 27, 300), ("topiary/7a", 31, 300), ("topiary/6", 31, 400), ("topiary/7c", 31, 1200)]
    {
        let plant = grown(name, age, 2);
        for node in 0..plant.nodes.len() as u32 {
            let [x, y, z] = node_frame(&plant, NodeId(node)).base;
            assert!(x.abs() < 7.001 && y.abs() < 7.001 && (-1.001..13.001).contains(&z), "{x} {y} {z}");
        }
        let internodes = plant.nodes.len();
        assert!(internodes > least && !plant.ledger.is_empty(), "{name} at {age}: {internodes} internodes");
        if age == 31 {
            assert!(internodes > before, "{name}: {internodes} internodes, {before} before");
            before = internodes;
        }
    }
}

/// The scenes of *Synthetic Topiary*: each internode begins within the form that its plant is pruned to, so none is a
/// whole internode outside of it. The two trees of the dinosaur stand in one form; the stem below the ball stands free.
#[test]
fn clipped_plants_keep_within_their_forms() {
    use phytomer_config::Model;
    use phytomer_models::fault::Path;
    use phytomer_models::shapes::Named;
    for (name, at_m, least) in [
        ("topiary/box_and_cylinder", 0.0, 800),
        ("topiary/spiral", 0.0, 800),
        ("topiary/dinosaur_fore", 0.51, 800),
        ("topiary/dinosaur_hind", -0.51, 800),
        ("topiary/hedge", 0.0, 500),
        ("topiary/hedge_across", 0.0, 500),
        ("topiary/hedge_ring", 0.0, 800),
        ("topiary/hedge_ball", 0.0, 150),
    ] {
        let species = species(name);
        let Model::Lsystem(stated) = &species.species.model else { panic!("{name} is an L-system") };
        let shapes = Named::of(&stated.shape, &Path::root(), &mut Vec::new());
        let shape = shapes.get("prune").expect("a form");
        // Eight steps before the age of its picture, when its form is filled for the most part.
        let plant = grown(name, species.shown_at() - 8, 3);
        assert!(plant.nodes.len() > least, "{name}: {} internodes", plant.nodes.len());
        for node in (0..plant.nodes.len()).filter(|node| plant.nodes.birth[*node] > 0) {
            let [x, y, z] = plant.frames.base[node].map(f64::from);
            // Single precision tells places to a micrometre or so.
            let field = shape.field([x + at_m, y, z]);
            assert!(field >= 0.5 - 1e-4, "{name}: an internode begins at {x} {y} {z}, where the field is {field}");
        }
    }
}

/// Hedges are without chance: all segments of one form are the same plant, whatever draws they have.
#[test]
fn hedges_are_instances_of_one_another() {
    let [one, other] = [1, 2].map(|seed| grown("topiary/hedge_across", 12, seed));
    assert_eq!((&one.frames.base, &one.nodes.birth), (&other.frames.base, &other.nodes.birth));
    assert_ne!(grown("topiary/spiral", 12, 1).frames.base, grown("topiary/spiral", 12, 2).frames.base);
}

fn told(report: Report) -> String {
    report.render(false)
}

const SPECIES: &str = "name = \"own\"\nmodel = \"lsystem\"\ntick = \"a step\"\nfile = \"own.l\"\n";

#[test]
fn what_is_wrong_in_a_file_is_told_at_its_line_and_column() {
    let texts = |l: &'static str, v: &'static str| [("own", SPECIES), ("own.l", l), ("own.v", v)];
    let grown = validate_texts("own", &texts("Axiom: F(1)\nF(x) --> F(2*x)\n", "angle increment: 30\n"));
    assert!(grown.is_ok(), "{}", grown.err().map(told).unwrap_or_default());
    let wrong = validate_texts("own", &texts("Axiom: F(1)\nF(x) --> F(2*y)\n", "angle increment: many\n"));
    let report = told(wrong.expect_err("it is wrong"));
    assert!(report.contains("own.v:1:18"), "{report}");
    assert!(report.contains("own.l:2:"), "{report}");
    let unknown = format!("{SPECIES}[kinds]\nA = \"bud\"\n");
    let report = told(validate_texts("own", &[("own", &unknown), ("own.l", "Axiom: FA\n")]).expect_err("it is wrong"));
    assert!(report.contains("unknown kind `bud`"), "{report}");
    let bracket = format!("{SPECIES}[kinds]\n\"[\" = \"axillary_bud\"\n");
    let report =
        told(validate_texts("own", &[("own", &bracket), ("own.l", "Axiom: F[F]\n")]).expect_err("it is wrong"));
    assert!(report.contains("`[` is a bracket"), "{report}");
    let report = told(validate_texts("own", &[("own", SPECIES)]).expect_err("it is wrong"));
    assert!(report.contains("there is no file `own.l`"), "{report}");
    let outside = SPECIES.replace("own.l", "../own.l");
    let report = told(validate_texts("own", &[("own", &outside)]).expect_err("it is wrong"));
    assert!(report.contains("may lie outside the folder"), "{report}");
    let texts = [("own", SPECIES), ("own.l", "#include \"../own.h\"\nAxiom: F\n")];
    let report = told(validate_texts("own", &texts).expect_err("it is wrong"));
    assert!(report.contains("may lie outside the folder") && report.contains("own.l:1:1"), "{report}");
}

/// Fig. 2.6: on branches a lateral daughter stands as the formula of Aono & Kunii 1984 has it: from the direction
/// (u, v, w) of its bearer by an angle h towards the horizontal at its side.
#[test]
fn branches_of_honda_obey_the_formula_of_gmt1() {
    for (figure, angle) in [("2.6a", 45.0_f64), ("2.6b", 45.0), ("2.6c", 45.0), ("2.6d", 30.0)] {
        let plant = grown(&format!("abop/{figure}"), 8, 1);
        let (mut held, (sin, cos)) = (0, phytomer_sim::math::sincos(angle.to_radians()));
        for node in 0..plant.nodes.len() {
            let Some(below) = plant.nodes.parent[node].some() else { continue };
            let (axis, bearing) = (plant.nodes.axis[node], plant.nodes.axis[below.index()]);
            if axis == bearing || plant.axes.order[bearing.index()] < 2 {
                continue;
            }
            let [u, v, w] = node_frame(&plant, below).heading.map(f64::from);
            let found = node_frame(&plant, NodeId(node as u32)).heading.map(f64::from);
            let across = (u * u + v * v).sqrt();
            let near = |h: f64| {
                let expected = [u * cos - h * v * sin / across, v * cos + h * u * sin / across, w * cos];
                (0..3).all(|i| (expected[i] - found[i]).abs() < 1e-4)
            };
            assert!(across < 1e-3 || near(1.0) || near(-1.0), "{figure}: {found:?} on {u} {v} {w}");
            held += usize::from(across >= 1e-3);
        }
        assert!(held > 50, "{figure}: {held}");
    }
}

#[test]
fn includes_and_constants_are_read() {
    let species = format!("{SPECIES}[define]\nn = 3\n");
    let texts = [
        ("own", species.as_str()),
        ("own.l", "#include \"more.h\"\nAxiom: X\nX --> TWICE\n"),
        ("more.h", "#define n 1\n#define TWICE F(n)F(n)\n"),
    ];
    let resolved = validate_texts("own", &texts).unwrap_or_else(|report| panic!("{}", told(report)));
    let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 100, keep_events: false };
    let mut plot = Plot::of_one(resolved.model.as_ref(), &seed);
    plot.grow_to(1).expect("room to grow");
    assert_eq!(plot.plants[0].nodes.length, [3.0, 3.0]);
}

fn alone(l: &'static str, more: &[(&'static str, &'static str)]) -> Result<phytomer_config::Resolved, Report> {
    validate_texts("own", &[&[("own", SPECIES), ("own.l", l)], more].concat())
}

/// What an `#include` names must be there where the line holds: not in a comment, nor under a condition that fails.
#[test]
fn includes_that_do_not_hold_need_no_file() {
    let passed = "/*\n#include \"gone.h\"\n*/\n#if 0\n#include \"gone.h\"\n#endif\nAxiom: F\n";
    assert!(alone(passed, &[]).is_ok(), "{}", alone(passed, &[]).err().map(told).unwrap_or_default());
    let report = told(alone("Axiom: F\n#include \"gone.h\"\n", &[]).expect_err("it is missing"));
    assert!(report.contains("own.l:2:1") && report.contains("`gone.h` cannot be included"), "{report}");
    let report = told(alone("#include \"../gone.h\"\nAxiom: F\n", &[]).expect_err("it is outside"));
    assert!(report.contains("own.l:1:1") && report.contains("may lie outside the folder"), "{report}");
    // A name in angle brackets is that of no file of the folder.
    let more = [("more.h", "Axiom: F\n")];
    let report = told(alone("#include <more.h>\n", &more).expect_err("it is no file of the folder"));
    assert!(report.contains("own.l:1:1") && report.contains("`#include <more.h>`"), "{report}");
}

/// A pipe that has the name of a view file would never end; among very many files the view file is found by its ending.
#[test]
#[cfg(unix)]
fn only_regular_files_lie_beside_an_l_system() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let write = |name: &str, text: &str| std::fs::write(at(name), text).expect("a file");
    let pipe = |name: &str| {
        let made = std::process::Command::new("mkfifo").arg(at(name)).status();
        assert!(made.expect("mkfifo").success());
    };
    write("own.l", "Axiom: F(1)+F(1)\n");
    pipe("own.v");
    let name = at("own.l").display().to_string();
    let find = || validate_species(&name, 1);
    assert!(find().is_ok(), "{}", find().err().map(told).unwrap_or_default());
    (0..1500).for_each(|number| write(&format!("{number}.txt"), ""));
    write("other.v", "angle increment: none\n");
    let report = told(find().expect_err("its view file is wrong"));
    assert!(report.contains("other.v:1:18"), "{report}");
    write("second.v", "angle increment: none\n");
    assert!(find().is_ok(), "of two view files neither is that of the L-system");
    write("stated.toml", &SPECIES.replace("file =", "view = \"own.v\"\nfile ="));
    let report = told(validate_species(&at("stated.toml").display().to_string(), 1).expect_err("it is a pipe"));
    assert!(report.contains("it is no regular file"), "{report}");
    pipe("pipe.l");
    let report = told(validate_species(&at("pipe.l").display().to_string(), 1).expect_err("it is a pipe"));
    assert!(report.contains("it is no regular file"), "{report}");
}
