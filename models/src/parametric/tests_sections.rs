//! The cross sections of the trunk: corners by the lobes, rings by the flare and the spheres.
//!
//! Absent: their triangles (`phytomer_meshes`).

use super::params::{Branches, Tree};
use super::radius::{flare, lobe, radius_at};
use super::specimens::{aspen, bare, level, unvaried, with};
use super::tests::{compiled, grown};
use phytomer_looks::Paints;
use phytomer_sim::math::atan2;
use phytomer_sim::plant::NodeId;

/// At each ring of each segment the radius that a mesh draws is that of the equations; the rings are spread over the
/// part of the trunk where they are needed, and corners are those of the lobes.
#[test]
fn the_trunk_is_drawn_as_its_equations_say() {
    let mut cactus = bare();
    (cactus.trunk.taper, cactus.whole.ratio, cactus.whole.lobes) = (2.2.into(), 0.05.into(), 11.into());
    (cactus.whole.lobe_depth, cactus.whole.flare) = (0.05.into(), 0.3.into());
    let mut rounded = bare();
    (rounded.trunk.taper, rounded.whole.ratio) = (1.5.into(), 0.1.into());
    for (tree, least) in [(unvaried(aspen()), 5), (cactus, 60), (rounded, 4)] {
        let (plant, model) = (grown(&tree, 0), compiled(&tree));
        let (of, paints) = (model.numbers(), Paints::of(&plant.habit));
        let segments = of.level[0].curve_res;
        let long = f64::from(plant.nodes.length[0]) * f64::from(segments);
        let mut rings = 0;
        for nth in 0..segments {
            let node = nth as usize;
            let Some(section) = plant.own_looks.section_of(NodeId(nth)) else { continue };
            let section = &paints.sections()[section];
            let [base, tip] = [plant.nodes.diameter[node], plant.nodes.diameter_tip[node]].map(|d| 0.5 * f64::from(d));
            for [share, bulge] in section.rings().iter().map(|ring| ring.map(f64::from)) {
                let z = (f64::from(nth) + share) / f64::from(segments);
                let drawn = base + share * (tip - base) + bulge * long / f64::from(segments);
                let expected = radius_at(z, of.level[0].taper, of.ratio * long, long) * flare(of.flare, z);
                assert!((drawn - expected).abs() < 1e-5 * long, "at {z}: {drawn} {expected}");
                rings += 1;
            }
            for [up, right] in section.corners().iter().map(|corner| corner.map(f64::from)) {
                let radius = lobe(of.lobes, of.lobe_depth, atan2(up, -right));
                assert!(((up * up + right * right).sqrt() - radius).abs() < 1e-6);
            }
        }
        assert!(rings >= least, "{rings}");
    }
}

/// Arms of a cactus: each has the rings of the nearest ratio of radius to length, within an eighth of an octave.
#[test]
fn branches_with_spheres_have_sections_by_their_proportions() {
    let mut tree = with(Branches { taper: 2.0.into(), ..level(12.0) }, bare());
    (tree.whole.ratio, tree.whole.ratio_power, tree.whole.shape) = (0.08.into(), 0.4.into(), 0.into());
    tree.trunk.taper = 0.0.into();
    let (plant, model) = (grown(&tree, 0), compiled(&tree));
    let (of, paints) = (model.numbers(), Paints::of(&plant.habit));
    assert!(plant.axes.len() > 9);
    for axis in 1..plant.axes.len() {
        let nodes: Vec<usize> = (0..plant.nodes.len()).filter(|&node| plant.nodes.axis[node].index() == axis).collect();
        let (thick, long) =
            (0.5 * f64::from(plant.nodes.diameter[nodes[0]]), 5.0 * f64::from(plant.nodes.length[nodes[0]]));
        let mut rings = 0;
        for (nth, &node) in nodes.iter().enumerate() {
            let section =
                plant.own_looks.section_of(NodeId(node as u32)).expect("a section, so that segments are joined");
            let [base, tip] = [plant.nodes.diameter[node], plant.nodes.diameter_tip[node]].map(|d| 0.5 * f64::from(d));
            for [share, bulge] in paints.sections()[section].rings().iter().map(|ring| ring.map(f64::from)) {
                let drawn = base + share * (tip - base) + bulge * long / 5.0;
                let expected = radius_at((nth as f64 + share) / 5.0, of.level[1].taper, thick, long);
                assert!((drawn - expected).abs() < 0.25 * thick, "{drawn} {expected} of {thick}");
                rings += 1;
            }
        }
        assert!(rings >= 5, "{rings}");
    }
}

/// A trunk that is a plain cone has no section, nor has a branch of the aspen.
#[test]
fn plain_stems_have_no_section() {
    let with_section = |tree: &Tree| {
        let plant = grown(tree, 0);
        (0..plant.nodes.len()).filter(|&node| plant.own_looks.section_of(NodeId(node as u32)).is_some()).count()
    };
    assert_eq!(with_section(&bare()), 0);
    assert_eq!(with_section(&aspen()), 3);
}
