//! A plot that repeats, and the same plot shifted: by half its width, and by other whole numbers of voxels.
//!
//! Nothing is rounded otherwise after the shift, so that plants, voxels and light are the same to the last bit.

use phytomer::run::seed_of;
use phytomer_config::{Resolved, validate};
use phytomer_sim::plant::Plant;
use phytomer_sim::site::light::{Borders, Field, Light, Lighting, Projection};
use phytomer_sim::{Plot, Sowing, Tick, grow};
use std::sync::Arc;

const WIDTH: [f64; 2] = [3.0, 2.0];
const PLACES: [[f64; 2]; 5] = [[0.31, 0.4], [1.0, 0.7], [2.2, 1.93], [0.0, 0.0], [2.9, 1.1]];
const UNTIL: Tick = 34;

fn grown(resolved: &Resolved, shift: [f64; 2], projection: Projection) -> Plot<'_> {
    let sowing = |(number, place): (u32, &[f64; 2])| {
        let [x, y] = [0, 1].map(|k| (place[k] + shift[k]).rem_euclid(WIDTH[k]));
        Sowing { species: 0, seed: seed_of(&resolved.scenario, number), place: [x, y, 0.0], sown: number % 2 * 5 }
    };
    let sowings: Vec<Sowing> = (0..).zip(&PLACES).map(sowing).collect();
    let mut plot = Plot::new(0, vec![resolved.model.as_ref()], &sowings);
    let borders = Borders::Periodic(WIDTH);
    plot.site.light = Some(Light::of(Lighting { borders, projection, ..Lighting::default() }));
    plot.ask_light();
    grow(&mut plot, UNTIL, &mut ()).expect("nothing is recorded");
    plot.stand(UNTIL);
    plot
}

fn field(plot: &Plot) -> Arc<Field> {
    plot.site.light.as_ref().and_then(|light| light.found.clone()).expect("the plants stand in light")
}

/// All that a plant is, but for its place.
fn columns(plant: &Plant) -> String {
    let Plant { axes, nodes, organs, events, frames, shade, .. } = plant;
    format!("{axes:?} {nodes:?} {organs:?} {events:?} {frames:?} {shade:?}")
}

/// The leaf area and the light of each voxel, by its place before the shift.
fn voxels(field: &Field, by: [i32; 2]) -> Vec<([i32; 3], u64, u64)> {
    let grid = &field.grid;
    let mut all = Vec::new();
    // Light is kept of wanted voxels alone, in the order of their indices.
    let mut light = field.light.iter();
    for (brick, place) in grid.bricks.iter().enumerate() {
        for inner in 0..512_usize {
            let index = brick * 512 + inner;
            if grid.is_wanted(index) {
                let within = [inner & 7, (inner >> 3) & 7, inner >> 6];
                let [x, y, z] = [0, 1, 2].map(|k| place[k] * 8 + within[k] as i32);
                let voxel = grid.within([x - by[0], y - by[1], z]);
                all.push((voxel, grid.area[index], light.next().expect("light of each wanted voxel").to_bits()));
            }
        }
    }
    assert_eq!(light.next(), None);
    all.sort_unstable();
    all
}

#[test]
fn a_shifted_plot_has_the_same_plants() {
    let resolved = validate("coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    for projection in [Projection::Even(0.5), Projection::OfLeaves] {
        let known = grown(&resolved, [0.0; 2], projection);
        let there: Vec<String> = known.plants.iter().map(columns).collect();
        let known = voxels(&field(&known), [0; 2]);
        assert!(known.iter().filter(|(_, area, _)| *area > 0).count() > 1_000);
        // Half the width along one side, along both, and whole numbers of voxels.
        for (shift, by) in [([1.5, 0.0], [15, 0]), ([1.5, 1.0], [15, 10]), ([0.7, -0.3], [7, -3])] {
            let shifted = grown(&resolved, shift, projection);
            assert!(voxels(&field(&shifted), by) == known, "{projection:?}, {shift:?}: other light");
            for (plant, same) in shifted.plants.iter().zip(&there) {
                assert!(columns(plant) == *same, "{projection:?}, {shift:?}: plant {}", plant.id);
            }
        }
        // Light is felt: half a voxel farther it is found in other voxels, and plants differ.
        let other = grown(&resolved, [0.05, 0.0], projection);
        assert!(other.plants.iter().zip(&there).any(|(plant, same)| columns(plant) != *same), "{projection:?}");
    }
}
