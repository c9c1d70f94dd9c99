//! A small plant that is written by hand: what its files say.

use super::*;
use phytomer_life::{Life, Maker, Nearness};
use phytomer_meshes::{MeshOptions, Scene};
use phytomer_sim::Tick;
use phytomer_sim::plant::{Cause, Form, Habit, Kind, NewAxis, NewNode, NewOrgan, NodeId, Plant, Seed, Trend};
use phytomer_sim::pose::pose;
use std::sync::Arc;

/// A trunk of six internodes, one a tick, with a leaf that stands from 2 to 5.
pub fn plant() -> Plant {
    let seed = Seed { plant: 3, draws: 3, run_seed: 1, component_limit: 100, keep_events: false };
    let mut plant = Plant::new(&seed, Arc::new(Habit { trends: vec![Trend::STRAIGHT], ..Habit::default() }));
    let axis = plant.add_axis(NewAxis::OF_THE_SEED);
    let mut parent = NodeId::NONE;
    for rank in 1..=6 {
        let node = NewNode { parent, axis, birth: rank, rank, length: 0.1, diameter: 0.01, ..NewNode::OF_THE_TRUNK };
        parent = plant.add_node(node);
    }
    plant.add_organ(NewOrgan {
        node: NodeId(0),
        kind: Kind::Leaf,
        position: 0,
        birth: 2,
        death: 5,
        cause: Cause::LifeLength,
        form: Form::default(),
        length: 0.1,
        width: 0.04,
        area: 0.002,
        azimuth: 0.0,
        insertion: 1.0,
    });
    pose(&mut plant, 6);
    plant
}

/// Its life.
pub fn life(plant: &Plant, ages: impl IntoIterator<Item = Tick>) -> Life {
    let mut maker = Maker::new(Nearness::of(1e-3), &MeshOptions::default());
    ages.into_iter().for_each(|age| maker.show(plant, age));
    maker.finish()
}

impl Sink for Vec<u8> {
    fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        self[at as usize..at as usize + bytes.len()].copy_from_slice(bytes);
        Ok(())
    }
}

#[test]
fn zz_explore() {
    let plant = plant();
    let scene = Scene::new(&plant, 3, &MeshOptions::default());
    for (encoding, ending) in [(Encoding::Text, "usda"), (Encoding::Binary, "usdc"), (Encoding::Package, "usdz")] {
        for (organs, name) in [(Organs::Instances, "i"), (Organs::Merged, "m")] {
            let asked = Asked { encoding, organs, words: "a plant".to_owned() };
            let mut out = Vec::new();
            write_plant(&asked, &scene, 1, &mut out).unwrap();
            std::fs::write(format!("/tmp/u/out/still_{name}.{ending}"), &out).unwrap();
            let lives = [life(&plant, 0..=6)];
            let plants = Plants { lives: &lives, options: &[MeshOptions::default()], members: &[Member::default()] };
            let mut out = Vec::new();
            write_life(&asked, &plants, 1e-3, &Pace { a_tick: 1.0, a_second: 24.0 }, &mut out).unwrap();
            std::fs::write(format!("/tmp/u/out/life_{name}.{ending}"), &out).unwrap();
        }
    }
}
