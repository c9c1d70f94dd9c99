//! Scenarios with obstacles that block, a ground, and stems that shoots meet: the shipped wall and oak, the same bytes
//! on any number of threads and after a kill, nothing within the wall, in any form of shape or below the ground of any
//! shipped scenario, meshes of three formats, and faults told with their keys.
//!
//! The shoots are looked at in the tables that a run writes and in the plot that a program grows. Absent: the ways past
//! solids (`sim/src/site/way.rs`), what each answer of a bud does (`models/src/buds/tests_contact.rs`), and what stems
//! do (`models/src/buds/tests_stems.rs`).

mod program;

use phytomer::config::{Resolved, validate, validate_texts};
use phytomer::run::plots::Plots;
use phytomer::sim::plant::{NodeId, OrganId, Plant, ThreadBudget};
use phytomer::sim::pose::{node_frame, organ_frame};
use phytomer::sim::{Growth, Tick, grow};
use program::{hashes, run};
use std::fs;

fn shipped(name: &str) -> Resolved {
    validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn told(text: &str) -> String {
    match validate_texts("site", &[("site", text)]) {
        Ok(_) => String::new(),
        Err(report) => report.render(false),
    }
}

/// The ivies climb to the top of the wall, go round the window, and no tip of a shoot or a leaf is in the wall, in the
/// window or below the ground. Shoots that lie on the wall are within the reach that ivy states.
#[test]
fn ivies_climb_the_wall_and_go_round_its_window() {
    let wall = shipped("wall");
    let until = wall.scenario.ages.until;
    let plots = Plots::of(wall.trial(), wall.models());
    let mut plot = plots.sow(0, ThreadBudget::default());
    grow(&mut plot, until, &mut ()).expect("nothing is recorded");
    plot.stand(until);
    let (mut above_window, mut beside, mut held, mut leaves) = (0, 0, 0, 0);
    for plant in &plot.plants {
        let place = plant.place;
        for node in 0..plant.nodes.len() {
            let tip = node_frame(plant, NodeId(node as u32)).base;
            let at = [0, 1, 2].map(|k| place[k] + f64::from(tip[k]));
            assert!(at[2] > 0.0, "below the ground: {at:?}");
            assert!(!plot.site.bars_at(at), "in the wall or the window: {at:?}");
            let on_wall = at[1] < 0.0 && at[2] < 3.9 && at[0].abs() < 2.2;
            held += usize::from(on_wall && at[1] > -0.05);
            above_window += usize::from(on_wall && at[2] > 2.6 && at[0].abs() < 0.5);
            beside += usize::from(on_wall && (1.2..2.5).contains(&at[2]) && (0.55..0.8).contains(&at[0].abs()));
        }
        for organ in 0..plant.organs.len() {
            let frame = organ_frame(plant, OrganId(organ as u32), until);
            let tip = f64::from(frame.base[2]) + f64::from(plant.organs.length[organ] * frame.heading[2]);
            assert!(tip > 0.0, "the tip of a leaf is below the ground: {tip}");
            leaves += 1;
        }
    }
    assert!(held > 500 && beside > 20 && above_window > 10 && leaves > 500, "{held} {beside} {above_window} {leaves}");
}

/// Grows a scenario on 1, 2, 3 and 8 threads, and one run again after a part of it is lost, as after a kill.
fn has_the_same_bytes_on_any_threads_and_when_it_is_resumed(text: &str) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("wall.toml"), text).unwrap();
    let written = ["1", "2", "3", "8"].map(|threads| {
        run(folder.path(), &["grow", "wall.toml", "--threads", threads, "--name", threads, "--quiet"]).ending(0);
        hashes(&folder.path().join("runs").join(threads))
    });
    assert!(written.iter().all(|one| *one == written[0]));
    let records = folder.path().join("runs/2/records");
    let part = fs::read_dir(&records).unwrap().next().expect("a part").unwrap().path();
    fs::remove_file(part).unwrap();
    run(folder.path(), &["grow", "wall.toml", "--name", "2", "--resume", "--quiet"]).ending(0);
    assert_eq!(hashes(&folder.path().join("runs/2")), written[0]);
}

#[test]
fn a_run_with_obstacles_has_the_same_bytes_on_any_number_of_threads_and_when_it_is_resumed() {
    let presets = phytomer::config::presets(phytomer::config::Kind::Scenario);
    let text = presets.iter().find(|(name, _)| *name == "wall").expect("it ships").1;
    let text = text.replace("plants = 3", "plants = 18").replace("until = 48", "until = 14");
    has_the_same_bytes_on_any_threads_and_when_it_is_resumed(&text.replace("[12, 24, 36, 48]", "[6, 14]"));
}

/// The plants of each plot of this scenario meet one another's stems, and their own.
#[test]
fn a_run_whose_plants_meet_has_the_same_bytes_on_any_number_of_threads_and_when_it_is_resumed() {
    let text = "name = \"meet\"\nspecies = \"coffee\"\nplants = 18\nspacing_m = 5\nmember = [{}, { at_m = [0.3, 0] }, { \
                species = \"ivy\", at_m = [0.02, 0], sown = 6 }]\nages = { until = 22, record = [11, 22] }\nsite = { \
                ground = true, stems = \"all\" }\n";
    has_the_same_bytes_on_any_threads_and_when_it_is_resumed(text);
}

/// The places of the nodes of a plant, and of the tips of its leaves at `age` as if they were straight, metres.
fn tips(plant: &Plant, age: Tick) -> impl Iterator<Item = [f64; 3]> {
    let nodes = (0..plant.nodes.len() as u32).map(NodeId).filter(move |node| plant.stands(*node, age));
    let organs = (0..plant.organs.len() as u32).map(OrganId).filter(move |organ| plant.organ_stands(*organ, age));
    let leaf = move |organ: OrganId| {
        let frame = organ_frame(plant, organ, age);
        let length = plant.organs.length[organ.index()] * plant.expanded(organ, age);
        frame.advanced(length).base
    };
    let leaves = organs.filter(|organ| plant.organs.kind[organ.index()].is_foliage()).map(leaf);
    nodes.map(|node| node_frame(plant, node).base).chain(leaves).map(|at| at.map(f64::from))
}

/// No tip of a shoot or of a leaf is below the ground in any shipped scenario that says that it is one. Scenarios grow
/// as far as it is quickly done.
#[test]
fn nothing_is_below_the_ground_of_any_shipped_scenario() {
    let presets = phytomer::config::presets(phytomer::config::Kind::Scenario);
    let (mut scenarios, mut looked) = (0, 0);
    for (name, _) in presets {
        let resolved = shipped(name);
        if !resolved.trial().treatments().iter().all(|treatment| treatment.scenario.site.ground) {
            continue;
        }
        let plots = Plots::of(resolved.trial(), resolved.models());
        let mut plot = plots.sow(0, ThreadBudget::default());
        let mut made = 0;
        for tick in 1..=resolved.scenario.ages.until {
            plot.site.begin(tick);
            plot.operate(tick).expect("room for what is cut to grow again");
            plot.grow_to(tick).expect("room to grow");
            plot.stand(tick);
            made += plot.plants.iter().map(|plant| plant.nodes.len()).sum::<usize>();
            if made > 300_000 {
                break;
            }
        }
        let tick = plot.site.tick;
        for (plant, member) in plot.plants.iter().zip(&plot.members) {
            let Some(age) = member.age_at(tick) else { continue };
            // Trees of other models than that of buds do not answer.
            if plot.species[member.species].growth() != Growth::Extends {
                continue;
            }
            let low = tips(plant, age).map(|at| at[2]).fold(f64::INFINITY, f64::min);
            assert!(low > 0.0, "{name}: plant {} reaches {low} m at tick {tick}", plant.id);
            looked += plant.nodes.len() + plant.organs.len();
        }
        scenarios += 1;
    }
    assert!(scenarios >= 2 && looked > 20_000, "{looked} tips in {scenarios} scenarios");
}

/// Each form of shape, by itself and combined, as an obstacle beside a coffee tree that does not bend: no shoot is in
/// it, and some have turned.
#[test]
fn every_form_of_shape_blocks() {
    let folder = tempfile::tempdir().unwrap();
    let rock = "{ form = \"mesh\", points_m = [[0.05, -0.3, 0.02], [0.7, -0.3, 0.02], [0.05, 0.4, 0.02], [0.1, 0, 0.9]], \
                faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] }";
    let forms = [
        "{ form = \"half_space\", point_m = [0.06, 0, 0], normal = [-1, 0, 0] }",
        "{ form = \"box\", at_m = [0.3, 0, 0.05], size_m = [0.5, 0.4, 0.5] }",
        "{ form = \"sphere\", at_m = [0.3, 0, 0.4], radius_m = 0.28 }",
        "{ form = \"ellipsoid\", at_m = [0.3, 0, 0.4], radii_m = [0.28, 0.35, 0.3] }",
        "{ form = \"cylinder\", at_m = [0.2, 0, 0.03], radius_m = 0.12, height_m = 0.5 }",
        "{ form = \"cone\", at_m = [0.2, 0, 0.03], radius_m = 0.15, height_m = 0.6 }",
        "{ form = \"capsule\", from_m = [0.1, -0.3, 0.45], to_m = [0.1, 0.3, 0.45], radius_m = 0.05 }",
        "{ form = \"torus\", at_m = [0, 0, 0.45], ring_radius_m = 0.15, radius_m = 0.06 }",
        "{ form = \"polyline\", points_m = [[0.08, -0.4, 0.4], [0.08, 0.1, 0.5], [-0.1, 0.2, 0.6]], radii_m = [0.03, 0.03, 0.02] }",
        "{ form = \"soft\", points = [{ at_m = [0.3, 0, 0.4], reach_m = 0.45 }] }",
        rock,
        "{ form = \"union\", of = [\"ball\", \"post\"] }",
        "{ form = \"intersection\", of = [\"ball\", \"case\"] }",
        "{ form = \"difference\", of = \"case\", less = [\"post\"] }",
        "{ form = \"blend\", of = [\"ball\", \"post\"], reach_m = 0.1 }",
        "{ form = \"placed\", of = \"case\", turn = { about = [0, 0, 1], angle_deg = 30 }, scale = [1, 0.8, 1.2] }",
    ];
    for (number, form) in forms.iter().enumerate() {
        let text = format!(
            "name = \"forms\"\nspecies = \"coffee\"\nplants = 1\nages = {{ until = 40 }}\nsite.gravity_m_s2 = 0\n\
             [site.shape]\nball = {{ form = \"sphere\", at_m = [0.3, 0, 0.4], radius_m = 0.28 }}\n\
             post = {{ form = \"cylinder\", at_m = [0.2, 0, 0.03], radius_m = 0.1, height_m = 0.8 }}\n\
             case = {{ form = \"box\", at_m = [0.3, 0, 0.4], size_m = [0.5, 0.4, 0.5] }}\n\
             [[site.obstacle]]\nblocks = \"inside\"\nshape = {form}\n"
        );
        let file = folder.path().join(format!("{number}.toml"));
        fs::write(&file, text).unwrap();
        let resolved = shipped(&file.display().to_string());
        let plots = Plots::of(resolved.trial(), resolved.models());
        let mut plot = plots.sow(0, ThreadBudget::default());
        grow(&mut plot, 40, &mut ()).expect("nothing is recorded");
        plot.stand(40);
        let plant = &plot.plants[0];
        let within = tips(plant, 40).take(plant.nodes.len()).find(|at| plot.site.bars_at(*at));
        assert!(within.is_none(), "{form}: {within:?}");
        assert!(plant.nodes.len() > 50 && !plant.stated.is_empty(), "{form}: nothing has met it");
    }
}

/// Ivies on an oak: those that climb lie on its bark, go up its trunk and are in no wood of it.
#[test]
fn ivies_climb_the_oak() {
    let oak = shipped("ivy_on_oak");
    let until = oak.scenario.ages.until;
    let plots = Plots::of(oak.trial(), oak.models());
    let mut plot = plots.sow(0, ThreadBudget::default());
    grow(&mut plot, until, &mut ()).expect("nothing is recorded");
    plot.stand(until);
    let [tree, ivies @ ..] = &plot.plants[..] else { panic!("an oak and ivies") };
    // The trunk alone, whose wood does not change: each internode a straight piece that tapers.
    let trunk: Vec<_> =
        (0..tree.nodes.len() as u32).map(NodeId).filter(|node| tree.nodes.axis[node.index()].0 == 0).collect();
    let to_bark = |at: [f64; 3]| {
        let of = |node: &NodeId| {
            let [from, to] = [tree.frames.at(*node).base, node_frame(tree, *node).base]
                .map(|end| [0, 1, 2].map(|k| tree.place[k] + f64::from(end[k])));
            let along = [0, 1, 2].map(|k| to[k] - from[k]);
            let square: f64 = along.iter().map(|x| x * x).sum();
            let share = ((0..3).map(|k| along[k] * (at[k] - from[k])).sum::<f64>() / square).clamp(0.0, 1.0);
            let out: f64 = (0..3).map(|k| at[k] - from[k] - share * along[k]).map(|apart| apart * apart).sum();
            let [base, tip] = [tree.nodes.diameter[node.index()], tree.nodes.diameter_tip[node.index()]].map(f64::from);
            out.sqrt() - 0.5 * (base + share * (tip - base))
        };
        trunk.iter().map(of).fold(f64::INFINITY, f64::min)
    };
    let (mut highest, mut held, mut all) = (0.0_f64, 0, 0);
    for plant in ivies {
        for at in tips(plant, until).take(plant.nodes.len()) {
            let at = [0, 1, 2].map(|k| plant.place[k] + at[k]);
            let distance = to_bark(at);
            assert!(distance > 0.0, "in the trunk: {at:?} by {distance} m");
            held += usize::from(distance < 0.05);
            highest = if distance < 0.05 { highest.max(at[2]) } else { highest };
            all += 1;
        }
    }
    assert!(highest > 2.0 && held * 2 > all, "{held} of {all} nodes on the trunk, up to {highest} m");
}

/// What is far away changes nothing: `summary` of a run in the open, which grows ahead, and of one beside a house that
/// no shoot reaches, which follows the clock.
#[test]
fn a_house_that_is_never_reached_leaves_every_byte_of_the_summary() {
    let folder = tempfile::tempdir().unwrap();
    let text =
        "name = \"far\"\nspecies = \"coffee\"\nplants = 3\nspacing_m = 4\nages = { until = 14, record = [7, 14] }\n";
    fs::write(folder.path().join("open.toml"), text).unwrap();
    let house =
        "[[site.obstacle]]\nblocks = \"inside\"\nshape = { form = \"box\", at_m = [0, 90, 0], size_m = [9, 9, 6] }\n";
    fs::write(folder.path().join("house.toml"), format!("{text}{house}")).unwrap();
    let [open, beside] = ["open", "house"].map(|name| {
        run(folder.path(), &["grow", &format!("{name}.toml"), "--name", name, "--quiet"]).ending(0);
        fs::read(folder.path().join(format!("runs/{name}/summary/part-00000.parquet"))).unwrap()
    });
    assert!(open.len() > 1000 && open == beside);
}

/// One tetrahedron as OBJ and as PLY states the same shape; a mesh that is open is refused with its file.
#[test]
fn meshes_of_several_formats_are_obstacles_and_open_ones_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n\
        property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    fs::write(folder.path().join("rock.obj"), obj).unwrap();
    fs::write(folder.path().join("rock.ply"), ply).unwrap();
    fs::write(folder.path().join("open.obj"), &obj[..obj.len() - 8]).unwrap();
    fs::write(folder.path().join("bad.glb"), "glTF").unwrap();
    let scenario = |file: &str| {
        let text = format!(
            "name = \"rock\"\nspecies = \"example1\"\nplants = 1\nages = {{ until = 4 }}\n[[site.obstacle]]\nblocks = \
             \"inside\"\nshape = {{ form = \"mesh\", file = \"{file}\" }}\n"
        );
        let path = folder.path().join(format!("{file}.toml"));
        fs::write(&path, text).unwrap();
        validate(&path.display().to_string()).map(|found| found.scenario.site).map_err(|report| report.render(false))
    };
    assert_eq!(scenario("rock.obj").unwrap(), scenario("rock.ply").unwrap());
    let open = scenario("open.obj").unwrap_err();
    assert!(open.contains("the mesh `open.obj`: the mesh is not closed at 3 of its edges"), "{open}");
    let bad = scenario("bad.glb").unwrap_err();
    assert!(bad.contains("the mesh `bad.glb`, its header: it is no GLB, or it is cut off"), "{bad}");
}

#[test]
fn keys_that_have_no_effect_are_told() {
    let told = |keys: &str| {
        told(&format!(
            "name = \"a\"\nspecies = \"example1\"\nplants = 1\nages = {{ until = 4 }}\n[[site.obstacle]]\nshape = {{ form = \
             \"sphere\", radius_m = 1 }}\n{keys}\n"
        ))
    };
    assert_eq!(told("blocks = \"inside\"\nholds = false"), "");
    let both = told("blocks = \"inside\"\nkills = \"outside\"");
    assert!(both.contains("the obstacle kills on one side and blocks"), "{both}");
    let holds = told("holds = false");
    assert!(holds.contains("no shoot holds to an obstacle that kills"), "{holds}");
    let side = told("blocks = \"insid\"");
    assert!(side.contains("`inside`"), "{side}");
    let stems = told("blocks = \"inside\"\n[site]\nstems = \"other\"");
    assert!(stems.contains("`neighbours`"), "{stems}");
}
