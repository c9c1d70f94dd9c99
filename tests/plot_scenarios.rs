//! Plots of several plants: the same bytes on any number of threads, planes that kill buds, plants that are sown later,
//! and all of a plot in one mesh and one picture.
//!
//! A plant of a plot is the same plant whenever it is grown again: by itself, or with its whole plot where the site has
//! feedback. The tests compare files that were written in different ways.

mod ply;
mod program;

use phytomer::config::{Resolved, validate, validate_texts};
use phytomer::outputs::pictures::{Picture, draw_stands};
use phytomer::run::picturing::{Pictured, pictured_plot};
use phytomer::run::plots::Plots;
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::plant::{ApexFate, AxisId, ThreadBudget};
use phytomer::sim::pose::bud_frame;
use phytomer::sim::{Tick, grow};
use ply::{count, mesh, place_in};
use program::{data, hashes, program, run};
use std::fs;

/// Two species sown three ticks apart under a plane.
const ROOF: &str = "under_a_roof";
/// Bytes of a vertex.
const VERTEX: usize = 49;

fn shipped(name: &str) -> Resolved {
    validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn resolved(text: &str) -> Resolved {
    validate_texts("plot", &[("plot", text)]).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

#[test]
fn a_plot_under_a_roof_has_the_same_bytes_on_any_number_of_threads() {
    let shipped = shipped(ROOF).scenario;
    assert_eq!((shipped.member[0].sown, shipped.member[3].sown, shipped.site.plane.len()), (0, 3, 1));
    let folder = tempfile::tempdir().unwrap();
    let text = shipped_text(ROOF) + "\n[meshes]\nages = [11, 15]\nplants = \"all\"\nsides = 4\n";
    fs::write(
        folder.path().join("roof.toml"),
        text.replace("plants = 6", "plants = 18").replace("23, 27]", "20]").replace("until = 27", "until = 20"),
    )
    .unwrap();
    let written = ["1", "2", "7"].map(|threads| {
        run(folder.path(), &["grow", "roof.toml", "--threads", threads, "--name", threads, "--quiet"]).ending(0);
        let drawn = ["plot.ply", "plot.png"].map(|file| {
            let verb = if file.ends_with("ply") { "mesh" } else { "picture" };
            let words = [verb, "roof.toml", "--plot", "2", "--age", "16", "--out", file];
            let done = program(folder.path(), &words).env("RAYON_NUM_THREADS", threads).output().unwrap();
            assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
            fs::read(folder.path().join(file)).unwrap()
        });
        (hashes(&folder.path().join("runs").join(threads)), drawn)
    });
    assert!(written[0].0.len() >= 6 + 2 * 18, "six tables and two meshes a plant: {}", written[0].0.len());
    assert!(written[0] == written[1] && written[0] == written[2]);
}

/// The text of a shipped scenario.
fn shipped_text(name: &str) -> String {
    let presets = phytomer::config::presets(phytomer::config::Kind::Scenario);
    presets.iter().find(|(known, _)| *known == name).map(|(_, text)| (*text).to_owned()).expect("it ships")
}

/// Each bud that reached the roof was killed there at the next tick, none was killed below it, and both species reach
/// it.
#[test]
fn buds_die_where_they_reach_the_roof() {
    let roofed = shipped(ROOF);
    let plots = Plots::of(roofed.trial(), roofed.models());
    let mut plot = plots.sow(1, ThreadBudget::default());
    assert!(plot.plants[0].place[1] != 0.0 || plot.plants[0].place[0] > 5.0, "the roof moves with its plot");
    grow(&mut plot, roofed.scenario.ages.until, &mut ()).unwrap();
    let mut killed = [0, 0];
    for (plant, member) in plot.plants.iter().zip(&plot.members) {
        for (k, fate) in plant.axes.apex_fate.iter().enumerate() {
            let at = bud_frame(plant, AxisId(k as u32)).base;
            let at = [0, 1, 2].map(|k| plant.place[k] + f64::from(at[k]));
            let last = plant.axes.last_node[k].some();
            let reached = last.map_or(plant.axes.appearance[k], |node| plant.nodes.birth[node.index()]);
            if plot.site.kills_at(at) && reached < plant.age {
                assert!(plant.axes.apex_end[k] <= reached + 1, "axis {k} of plant {} lives beyond", plant.id);
            }
            if *fate == ApexFate::Killed {
                assert!(plot.site.kills_at([at[0], at[1], at[2] + 1e-6]), "axis {k} of plant {} at {at:?}", plant.id);
                killed[member.species] += 1;
            }
        }
    }
    assert!(killed[0] > 20 && killed[1] > 20, "{killed:?}");
}

/// The mesh of a plant that is requested by its number is its own part of the plot's mesh, moved to its place there:
/// where the site has feedback and where it has none.
#[test]
fn a_plant_by_itself_is_its_part_of_the_mesh_of_its_plot() {
    let folder = tempfile::tempdir().unwrap();
    let open = "name = \"open\"\nspecies = \"example1\"\nplants = 6\nspacing_m = 9\nages = { until = 9 }\nmember = [{}, \
                { species = \"gmt1/5a\", at_m = [1, 2], sown = 2 }, { at_m = [-1, 0.5, 0.25], sown = 3 }]\n";
    fs::write(folder.path().join("open.toml"), open).unwrap();
    fs::write(folder.path().join("roof.toml"), shipped_text(ROOF).replace("plants = 6", "plants = 12")).unwrap();
    for (file, tick) in [("open.toml", 9), ("roof.toml", 17)] {
        let scenario = validate(&folder.path().join(file).display().to_string()).unwrap().scenario;
        let members = scenario.members();
        let words = ["mesh", file, "--plot", "1", "--age", &tick.to_string(), "--sides", "3", "--out", "plot.ply"];
        run(folder.path(), &words).ending(0);
        let (header, plot) = mesh(&folder.path().join("plot.ply"));
        assert_eq!(place_in(&header), [scenario.spacing_m.unwrap(), 0.0, 0.0], "{file}: the place of plot 1");
        let mut first = 0;
        for (member, plant) in scenario.member.iter().zip(members..) {
            let (number, age) = (plant.to_string(), (tick - member.sown).to_string());
            let words = ["mesh", file, "--plant", &number, "--age", &age, "--sides", "3", "--out", "one.ply"];
            run(folder.path(), &words).ending(0);
            let (own, alone) = mesh(&folder.path().join("one.ply"));
            let vertices = count(&own, "vertex");
            let told = format!(" age {age} vertices {vertices}");
            let comment = header.lines().find(|line| line.starts_with(&format!("comment plant {plant} species ")));
            assert!(comment.unwrap_or_default().ends_with(&told), "{file}: {comment:?} tells {told}");
            let place = member.place();
            for (moved, home) in (first..first + vertices).zip(0..vertices) {
                let (moved, home) = (&plot[moved * VERTEX..][..VERTEX], &alone[home * VERTEX..][..VERTEX]);
                let there = [0, 1, 2].map(|k| (f64::from(float(&home[4 * k..])) + place[k]) as f32);
                assert_eq!([0, 1, 2].map(|k| float(&moved[4 * k..])), there, "{file}: plant {plant}");
                assert_eq!(moved[12..], home[12..], "{file}: plant {plant}");
            }
            first += vertices;
        }
        assert_eq!(count(&header, "vertex"), first, "{file}: the plants are the whole mesh");
    }
}

/// Draws are keyed by run seed and plant, and laws use the plant's age: sown three ticks later it is the same plant.
#[test]
fn a_plant_that_is_sown_later_is_the_same_plant_later() {
    let folder = tempfile::tempdir().unwrap();
    let [first, later] = [(0, 9), (3, 12)].map(|(sown, until)| {
        let text = format!(
            "name = \"late\"\nspecies = \"coffee\"\nplants = 2\nages = {{ until = {until} }}\n\
             member = [{{ species = \"example1\" }}, {{ at_m = [1, 2], sown = {sown} }}]\n"
        );
        fs::write(folder.path().join("late.toml"), text).unwrap();
        run(folder.path(), &["mesh", "late.toml", "--plant", "1", "--age", "9", "--out", "late.ply"]).ending(0);
        fs::read(folder.path().join("late.ply")).unwrap()
    });
    assert!(first == later);
    let words = ["mesh", "late.toml", "--plant", "1", "--age", "10", "--out", "late.ply"];
    let told = run(folder.path(), &words).ending(2).stderr;
    assert!(told.contains("plant 1, which is sown at tick 3, has the ages 0 to 9"), "{told}");
    let told = run(folder.path(), &["mesh", "late.toml", "--plot", "1", "--out", "late.ply"]).ending(2).stderr;
    assert!(told.contains("--plot 1: the run has the plots 0 to 0"), "{told}");
}

fn pictured(resolved: &Resolved, tick: Tick, apart: bool) -> Pictured {
    pictured_plot(&Regrowth::of(resolved), &resolved.all_species(), (0, &[tick]), apart).unwrap()
}

/// Plants without draws that are sown together are one plant in memory, and the picture is the same. Plants of another
/// age, and plants with draws, are kept apart.
#[test]
fn equal_plants_share_one_mesh_and_the_picture_is_the_same() {
    let member = |k: u32| format!("{{ at_m = [{}, {}], sown = {} }}, ", k % 10, k / 10, if k < 90 { 0 } else { 1 });
    let members: String = (0..100).map(member).collect();
    let text = format!("name = \"field\"\nspecies = \"{}\"\nplants = 101\nages = {{ until = 6 }}\n", "gmt1/5a")
        + &format!("member = [{members}{{ species = \"coffee\", at_m = [-1, -1] }}]");
    let field = resolved(&text);
    let (shared, apart) = (pictured(&field, 6, false), pictured(&field, 6, true));
    assert_eq!(shared.stands[0].members.len(), 101, "more plants than stand side by side");
    assert_eq!((shared.stands[0].plants.len(), apart.stands[0].plants.len()), (3, 101));
    let draw = |pictured: &Pictured| {
        let style = Picture { size: [160, 120], ..Picture::default() };
        draw_stands(&pictured.stands(&[]), &pictured.title, &style)
    };
    assert!(draw(&shared) == draw(&apart));
    let coffee = resolved("name = \"a\"\nspecies = \"coffee\"\nplants = 2\nages = { until = 9 }\nmember = [{}, {}]");
    assert_eq!(pictured(&coffee, 9, false).stands[0].plants.len(), 2, "draws tell plants apart");
}

/// A member is not drawn before it is sown, and the title names only the drawn species.
#[test]
fn members_that_are_not_sown_are_not_drawn() {
    let text = "name = \"a\"\nspecies = \"coffee\"\nplants = 2\nages = { until = 9 }\n\
                member = [{}, { species = \"example1\", sown = 5 }]";
    let plot = resolved(text);
    let drawn = |tick| {
        let pictured = pictured(&plot, tick, false);
        let ages: Vec<Tick> = pictured.stands[0].members.iter().map(|member| member.age).collect();
        (ages, pictured.title.contains(", "))
    };
    assert_eq!([drawn(4), drawn(5), drawn(9)], [(vec![4], false), (vec![5, 0], true), (vec![9, 4], true)]);
}

/// The scenes after Photos 14 and 15 of de Reffye 1988: more plants than can stand side by side, trees over herbs. In
/// the second the poplars are yellow, and no part of the first picture is yellow.
#[test]
fn herbs_and_trees_stand_in_one_picture() {
    for (name, herb, yellow) in
        [("herbs_and_trees", "meadow_grass", false), ("herbs_and_poplars", "meadow_grass", true)]
    {
        let scene = shipped(name);
        let pictured = pictured(&scene, scene.scenario.ages.until, false);
        let members = &pictured.stands[0].members;
        let of_herb = scene.all_species().iter().position(|species| species.about.name == herb).unwrap();
        let herbs = members.iter().filter(|member| member.species == of_herb).count();
        assert!(members.len() > 64 && herbs > 40 && herbs < members.len(), "{name}: {herbs} of {}", members.len());
        let style = Picture { size: [240, 160], caption: false, ..Picture::default() };
        let canvas = draw_stands(&pictured.stands(&[]), &pictured.title, &style);
        let yellows = canvas.pixels.iter().filter(|[r, g, b, _]| r > g && u16::from(*g) > u16::from(*b) + 60).count();
        assert_eq!(yellows > 200, yellow, "{name}: {yellows} yellow pixels");
    }
}

/// A run of plots reports both species wherever it reports species, and its plants can be grown again from its folder.
#[test]
fn a_run_folder_keeps_all_species() {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(data("still.toml"), folder.path().join("still.toml")).unwrap();
    let text = "name = \"two\"\nspecies = \"still.toml\"\nplants = 4\nages = { until = 6 }\n\
                member = [{}, { species = \"example1\", at_m = [1, 0], sown = 2 }]\n";
    fs::write(folder.path().join("two.toml"), text).unwrap();
    let told = run(folder.path(), &["grow", "two.toml", "--json"]).ending(0).json();
    assert_eq!((told["species"].as_str(), told["plants"].as_u64()), (Some("still, example1"), Some(4)), "{told}");
    let told = run(folder.path(), &["describe", "runs/two", "--json"]).ending(0).json();
    assert_eq!(told["species"], "still, example1");
    let [again, fresh] = ["runs/two", "two.toml"].map(|name| {
        run(folder.path(), &["mesh", name, "--plot", "1", "--out", "plot.ply"]).ending(0);
        fs::read(folder.path().join("plot.ply")).unwrap()
    });
    assert!(again == fresh, "the plot of the folder is that of the scenario");
    let told = run(folder.path(), &["grow", "two.toml", "--plants", "3", "--dry-run"]).ending(2).stderr;
    assert!(told.contains("3 plants cannot be dealt into plots of 2") && told.contains("2 or 4"), "{told}");
}

fn float(bytes: &[u8]) -> f32 {
    f32::from_le_bytes(bytes[..4].try_into().expect("four bytes"))
}
