//! The cross sections of the trunk: corners by the lobes, rings by the flare and the spheres.
//!
//! Absent: their triangles (`phytomer_meshes`).

use super::params::Tree;
use super::radius::{flare, lobe, radius_at};
use super::specimens::{aspen, bare, unvaried};
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

/// A trunk that is a plain cone has no section, and a branch never has one.
#[test]
fn plain_stems_have_no_section() {
    let with_section = |tree: &Tree| {
        let plant = grown(tree, 0);
        (0..plant.nodes.len()).filter(|&node| plant.own_looks.section_of(NodeId(node as u32)).is_some()).count()
    };
    assert_eq!(with_section(&bare()), 0);
    assert_eq!(with_section(&aspen()), 3);
}
