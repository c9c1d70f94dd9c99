//! Plants of buds and shapes, through scenario files: a hedge that is clipped to a shape, and shapes that stop buds.
//!
//! Where the shapes stand and what is inside is asked of the compiled scenario. Absent: the shapes themselves
//! (`phytomer_sim::shape`), and faults, which are fixtures of `config`.

use phytomer::config::{Resolved, validate_texts};
use phytomer::run::plots::Plots;
use phytomer::sim::plant::{NodeId, Plant, ThreadBudget};
use phytomer::sim::pose::node_frame;
use phytomer::sim::shape::Shape;
use phytomer::sim::site::Side;
use phytomer::sim::{Plot, Tick};

const FORM: &str = r#"{ form = "blend", reach_m = 0.1, of = [
  { form = "cylinder", radius_m = 0.15, height_m = 0.8 },
  { form = "sphere", at_m = [0, 0, 1.1], radius_m = 0.45 },
] }"#;

fn resolved(more: &str) -> Resolved {
    let text = format!(
        "name = \"form\"\nspecies = \"wild_cherry\"\nplants = 4\nspacing_m = 7\nages = {{ until = 24 }}\n[site.shape]\nform = {}\n{more}",
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
