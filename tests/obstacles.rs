//! Scenarios with obstacles that block and a ground: the shipped wall, the same bytes on any number of threads and
//! after a kill, nothing within the wall or below the ground, meshes of three formats, and faults told with their keys.
//!
//! The shoots are looked at in the tables that a run writes and in the plot that a program grows. Absent: the ways past
//! solids (`sim/src/site/way.rs`), and what each answer of a bud does (`models/src/buds/tests_contact.rs`).

mod program;

use phytomer::config::{Resolved, validate, validate_texts};
use phytomer::run::plots::Plots;
use phytomer::sim::grow;
use phytomer::sim::plant::{NodeId, OrganId, ThreadBudget};
use phytomer::sim::pose::{node_frame, organ_frame};
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

#[test]
fn a_run_with_obstacles_has_the_same_bytes_on_any_number_of_threads_and_when_it_is_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let presets = phytomer::config::presets(phytomer::config::Kind::Scenario);
    let text = presets.iter().find(|(name, _)| *name == "wall").expect("it ships").1;
    let text = text.replace("plants = 3", "plants = 18").replace("until = 48", "until = 14");
    fs::write(folder.path().join("wall.toml"), text.replace("[12, 24, 36, 48]", "[6, 14]")).unwrap();
    let written = ["1", "2", "3", "8"].map(|threads| {
        run(folder.path(), &["grow", "wall.toml", "--threads", threads, "--name", threads, "--quiet"]).ending(0);
        hashes(&folder.path().join("runs").join(threads))
    });
    assert!(written.iter().all(|one| *one == written[0]));
    // A part is lost, as after a kill: it is grown again.
    let records = folder.path().join("runs/2/records");
    let part = fs::read_dir(&records).unwrap().next().expect("a part").unwrap().path();
    fs::remove_file(part).unwrap();
    run(folder.path(), &["grow", "wall.toml", "--name", "2", "--resume", "--quiet"]).ending(0);
    assert_eq!(hashes(&folder.path().join("runs/2")), written[0]);
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
}
