//! Plants of buds and shapes, through scenario files: a hedge that is clipped to a shape, shapes that stop buds, and
//! obstacles in what is drawn of a plot.
//!
//! Where the shapes stand and what is inside is asked of the compiled scenario. Absent: the shapes themselves
//! (`phytomer_sim::shape`), and faults, which are fixtures of `config`.

use phytomer::config::{Resolved, validate_texts};
use phytomer::run::picturing::{Pictured, pictured_plants, pictured_plot, plot_mesh};
use phytomer::run::plots::Plots;
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::plant::{NodeId, Plant, ThreadBudget};
use phytomer::sim::pose::node_frame;
use phytomer::sim::shape::Shape;
use phytomer::sim::site::Side;
use phytomer::sim::{Plot, Tick};

const FORM: &str = r#"{ form = "blend", reach_m = 0.1, of = [
  { form = "cylinder", radius_m = 0.15, height_m = 0.8 },
  { form = "sphere", at_m = [0, 0, 1.1], radius_m = 0.45 },
] }"#;

/// Four cherries, with keys before the shapes.
fn resolved_of(keys: &str) -> Resolved {
    stated(keys, "")
}

/// Four cherries, with tables after the shapes.
fn resolved(more: &str) -> Resolved {
    stated("", more)
}

fn stated(keys: &str, more: &str) -> Resolved {
    let text = format!(
        "name = \"form\"\nspecies = \"wild_cherry\"\nplants = 4\nspacing_m = 7\n\
         ages = {{ until = 24 }}\n{keys}[site.shape]\nform = {}\n{more}",
        FORM.replace('\n', " "),
    );
    validate_texts("plot", &[("plot", &text)]).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

/// Plot 3 grown by the clock, standing at each tick, and shown to `look`.
fn grown(resolved: &Resolved, mut look: impl FnMut(&Plot, Tick)) {
    let plots = Plots::of(resolved.trial(), resolved.models());
    let mut plot = plots.sow(3, ThreadBudget::default());
    plot.stand(0);
    for tick in 1..=resolved.scenario.ages.until {
        plot.site.begin(tick);
        plot.operate(tick).expect("room to grow");
        plot.grow_to(tick).expect("room to grow");
        plot.stand(tick);
        look(&plot, tick);
    }
}

/// The standing internodes of which the tip lies outside a shape around the seed, with the tick of their birth.
fn outside(plant: &Plant, tick: Tick, shape: &Shape) -> (Vec<Tick>, usize) {
    let (mut births, mut standing) = (Vec::new(), 0);
    for node in (0..plant.nodes.len() as u32).map(NodeId).filter(|node| plant.stands(*node, tick)) {
        standing += 1;
        if !shape.inside(node_frame(plant, node).base.map(f64::from)) {
            births.push(plant.nodes.birth[node.index()]);
        }
    }
    (births, standing)
}

/// After each clipping nothing stands outside the form but what has grown at the tick of the clipping itself; and the
/// plant fills the form: without clipping it would stand out of it.
#[test]
fn a_hedge_that_is_clipped_to_a_shape_stands_in_it() {
    let event = "[[event]]\noperation = \"hedging\"\ntick = 2\nevery = 1\nshape = \"form\"\n";
    let clipped = resolved(event);
    let shape = clipped.scenario.management(None).operations()[0].act.clone();
    let phytomer::sim::management::Act::Clear(phytomer::sim::management::Region::Outside(shape), _) = shape else {
        panic!("a hedge clears what is outside a shape: {shape:?}");
    };
    let (mut cut, mut last) = (0, 0);
    grown(&clipped, |plot, tick| {
        let (births, standing) = outside(&plot.plants[0], tick, &shape);
        assert!(births.iter().all(|birth| *birth == tick), "at {tick}: {births:?}");
        cut = plot.plants[0].cuts.all().len();
        last = standing;
    });
    assert!(cut > 3 && last > 50, "{cut} cuts, {last} internodes");
    let mut free = 0;
    grown(&resolved(""), |plot, tick| free = outside(&plot.plants[0], tick, &shape).0.len());
    assert!(free > 50, "without clipping {free} internodes stand out");
}

/// A form that stops buds outside of it, in a plot that does not stand at the origin: each axis stands out by its last
/// growth unit at most.
#[test]
fn an_axis_stands_out_of_an_obstacle_by_its_last_growth_unit() {
    let stopped = resolved("[[site.obstacle]]\nshape = \"form\"\nkills = \"outside\"\n");
    let mut most = 0;
    grown(&stopped, |plot, tick| {
        let plant = &plot.plants[0];
        assert!(plant.place[0] > 5.0 || plant.place[1] > 5.0, "plot 3 stands apart: {:?}", plant.place);
        let obstacle = &plot.site.obstacles[0];
        assert_eq!(obstacle.kills, Side::Outside);
        let kills = |node: NodeId| {
            let at = node_frame(plant, node).base;
            obstacle.kills_at([0, 1, 2].map(|k| plant.place[k] + f64::from(at[k])))
        };
        for axis in 0..plant.axes.len() {
            let nodes = (0..plant.nodes.len() as u32).map(NodeId);
            let own = nodes.filter(|node| plant.nodes.axis[node.index()].index() == axis && plant.stands(*node, tick));
            let beyond: Vec<Tick> =
                own.filter(|node| kills(*node)).map(|node| plant.nodes.birth[node.index()]).collect();
            let units: std::collections::BTreeSet<&Tick> = beyond.iter().collect();
            assert!(units.len() <= 1, "axis {axis} at {tick} stands out by what grew at {units:?}");
            most = most.max(beyond.len());
        }
    });
    assert!(most > 0, "some axis reaches out");
}

/// The first plot at a tick, as a picture shows it.
fn pictured(resolved: &Resolved, tick: Tick) -> Pictured {
    pictured_plot(&Regrowth::of(resolved), &resolved.all_species(), (0, &[tick]), false).expect("it grows")
}

/// A house is drawn where buds die in it, a form that stops buds outside of it is not, and either may be stated
/// otherwise; a half space has no end. In the PLY its vertices follow those of the plants.
#[test]
fn obstacles_are_drawn_in_their_plot() {
    let house = "{ form = \"box\", at_m = [3, 0, 0], size_m = [2, 1, 4] }";
    let roof = "{ form = \"half_space\", point_m = [0, 0, 9], normal = [0, 0, -1] }";
    let obstacle = |shape: &str, more: &str| format!("[[site.obstacle]]\nshape = {shape}\n{more}\n");
    for (text, drawn) in [
        (obstacle(house, "colour = \"#0a141e\""), 1),
        (obstacle(house, "drawn = false"), 0),
        (obstacle(house, "kills = \"outside\""), 0),
        (obstacle(house, "kills = \"outside\"\ndrawn = true"), 1),
        (obstacle(roof, "") + &obstacle(house, ""), 1),
        (String::new(), 0),
    ] {
        let resolved = resolved(&text);
        let shown = pictured(&resolved, 2);
        assert_eq!(shown.stands[0].obstacles.len(), drawn, "{text}");
        assert_eq!(shown.stands(&[])[0].obstacles.len(), drawn);
    }
    let resolved = resolved(&obstacle(house, "colour = \"#0a141e\""));
    let shown = pictured(&resolved, 2);
    let vertices = &shown.stands[0].obstacles[0].vertices;
    assert!(vertices.iter().all(|vertex| vertex.tag().colour == [10, 20, 30, 255]));
    let reach = |k: usize| vertices.iter().map(|vertex| vertex.position()[k]).fold(0.0_f32, f32::max);
    assert_eq!([reach(0), reach(1), reach(2)], [4.0, 0.5, 4.0]);
    let mut bytes = Vec::new();
    let mesh = plot_mesh(&shown.stands[0], &Regrowth::of(&resolved), (0, 2.0), (&resolved.all_species(), &[]), 8);
    mesh.write(&mut bytes).expect("written");
    let header = String::from_utf8_lossy(&bytes[..1000]).into_owned();
    assert!(header.contains("comment obstacle 0 vertices 24\n"), "{header}");
}

/// Ticks of 10 days from 2001-02-01: tick 2 is reached on the 21st, tick 24 after 240 days, .66 years. Without a
/// calendar years are those of the species.
#[test]
fn captions_have_dates_where_ticks_have_them() {
    let dated = resolved_of("planting_date = \"2001-02-01\"\ncalendar = { tick = { days = 10 } }\n");
    let shown = pictured_plants(&Regrowth::of(&dated), &dated.all_species(), &[0], &[2, 24]).expect("it grows");
    let labels: Vec<&str> = shown.stands.iter().map(|stand| stand.label.as_str()).collect();
    assert_eq!(labels, ["age 2 · 2001-02-21 · 0.1 years", "age 24 · 2001-09-29 · 0.7 years"]);
    assert_eq!(pictured(&dated, 24).stands[0].label, "tick 24 · 2001-09-29 · 0.7 years");
    let bare = resolved("");
    let label = &pictured(&bare, 24).stands[0].label;
    assert!(label.starts_with("tick 24") && !label.contains("2001"), "{label}");
}
