//! A small plant for the tests of this crate, with every component and fate that the tables distinguish.
//!
//! Each tick the trunk makes an internode with a leaf, which lives for three ticks, and a bud. The bud grows two
//! internodes and dies, and its branch falls two ticks later. At tick 6 the trunk bears a flower, at tick 8 it dies.

use crate::tables::OfMember;
use crate::{Mode, Provenance, RunFolder, RunPlan, RunReport, ShardReport, Table};
use phytomer_sim::mechanics::Wood;
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::{
    ApexFate, AxisId, Cause, EventKind, Habit, Kind, LineageKey, Looks, NewAxis, NewNode, NewOrgan, NodeId, Origin,
    Plant, Seed, Shape, Trend, key::Place,
};
use phytomer_sim::site::View;
use phytomer_sim::site::calendars::Calendars;
use phytomer_sim::{Ending, Grow, Growth, GrowthModel, NEVER, Plot, Tick, grow};
use std::path::Path;
use std::sync::Arc;

/// The model of the specimen.
pub struct Sapling;

/// The specimen with the wood that is given.
pub struct Wooden(pub Option<Wood>);

const TRUNK_DIES: Tick = 8;

impl Grow for Sapling {
    type Life = ();

    fn growth(&self) -> Growth {
        Growth::Extends
    }

    fn habit(&self) -> Arc<Habit> {
        let trends = vec![Trend::STRAIGHT];
        Arc::new(Habit { trends, looks: Looks::of_shape(Shape::Cone), ..Habit::default() })
    }

    fn sow(&self, plant: &mut Plant) {
        axis(plant, None, 0);
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, (): &mut (), _view: &View<'_>) -> Result<(), Overgrown> {
        (plant.age + 1..=age).try_for_each(|tick| step(plant, tick))
    }

    fn thicken(&self, age: Tick, plant: &mut Plant) {
        for node in 0..plant.nodes.len() {
            let years = age.saturating_sub(plant.nodes.birth[node]) as f32;
            plant.nodes.diameter[node] = plant.nodes.primary_diameter[node] * (1.0 + 0.1 * years);
            plant.nodes.diameter_tip[node] = plant.nodes.diameter[node] * 0.9;
        }
    }
}

impl Grow for Wooden {
    type Life = ();

    fn growth(&self) -> Growth {
        Grow::growth(&Sapling)
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::new(Habit { wood: self.0.clone(), ..(*Grow::habit(&Sapling)).clone() })
    }

    fn sow(&self, plant: &mut Plant) {
        Grow::sow(&Sapling, plant);
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut (), view: &View<'_>) -> Result<(), Overgrown> {
        Grow::grow_to(&Sapling, age, plant, life, view)
    }

    fn thicken(&self, age: Tick, plant: &mut Plant) {
        Grow::thicken(&Sapling, age, plant);
    }
}

fn step(plant: &mut Plant, tick: Tick) -> Result<(), Overgrown> {
    let axes = plant.axes.len();
    if !plant.has_room_for(4 * axes as u32) {
        return Err(Overgrown::of(plant));
    }
    for axis in 0..axes {
        grow_axis(plant, AxisId(axis as u32), tick);
    }
    plant.age = tick;
    Ok(())
}

fn grow_axis(plant: &mut Plant, id: AxisId, tick: Tick) {
    if !plant.bud_lives(id, tick - 1) {
        return;
    }
    let trunk = id == AxisId::TRUNK;
    let last = if trunk { TRUNK_DIES } else { plant.axes.birth[id.index()] + 3 };
    if tick == last {
        plant.axes.end_apex(id, tick, ApexFate::Died);
        plant.note(tick, id, EventKind::Died, 1);
        return;
    }
    let node = internode(plant, id, tick);
    plant.note(tick, id, EventKind::Grew, 1);
    organ(plant, node, Kind::Leaf, tick, 3);
    if trunk {
        let branch = axis(plant, Some(node), tick);
        plant.note(tick, branch, EventKind::Branched, 1);
    }
    if trunk && tick == 6 {
        organ(plant, node, Kind::Flower, tick, 1);
    }
}

fn axis(plant: &mut Plant, bearer: Option<NodeId>, tick: Tick) -> AxisId {
    let key = bearer.map_or(LineageKey::SEED, |node| LineageKey::SEED.child(Place::Axillary(0).on(node.0 + 1)));
    plant.add_axis(NewAxis {
        bearer,
        key,
        order: if bearer.is_some() { 2 } else { 1 },
        origin: if bearer.is_some() { Origin::Axillary } else { Origin::Seed },
        appearance: tick,
        birth: tick,
        azimuth: tick as f32,
        insertion: if bearer.is_some() { 1.0 } else { 0.0 },
        shed_after: if bearer.is_some() { 2 } else { NEVER },
        ..NewAxis::OF_THE_SEED
    })
}

fn internode(plant: &mut Plant, axis: AxisId, tick: Tick) -> NodeId {
    let last = plant.axes.last_node[axis.index()];
    let parent = last.some().unwrap_or(plant.axes.bearer[axis.index()]);
    let rank = last.some().map_or(1, |last| plant.nodes.rank[last.index()] + 1);
    plant.add_node(NewNode {
        parent,
        axis,
        birth: tick,
        rank,
        short: axis != AxisId::TRUNK,
        length: 0.1 + 0.001 * plant.id as f32,
        diameter: 0.01,
        azimuth: 2.4,
        ..NewNode::OF_THE_TRUNK
    })
}

fn organ(plant: &mut Plant, node: NodeId, kind: Kind, birth: Tick, life: Tick) {
    let leaf = kind == Kind::Leaf;
    plant.add_organ(NewOrgan {
        node,
        kind,
        birth,
        death: birth + life,
        cause: Cause::LifeLength,
        length: 0.08,
        width: 0.03,
        area: if leaf { 0.0016 } else { 0.0 },
        azimuth: 2.4,
        insertion: 0.8,
        ..NewOrgan::LEAF
    });
}

/// A plan of `plots` specimens to age 12.
pub fn plan(plots: u32, plots_per_part: u32) -> RunPlan {
    RunPlan {
        tables: Table::ALL.to_vec(),
        sample: None,
        recorded: vec![1, 4, 7, 8, 10, 12],
        until: 12,
        plots,
        plots_per_part,
        compression_level: 1,
        precision_m: None,
        mechanics: false,
        light: false,
        measured: false,
        calendars: vec![Calendars::default()],
        species_of_models: Vec::new(),
        members: vec![vec![OfMember { ground_area_m2: Some(6.25), guard: false }]],
        provenance: Provenance {
            scenario: "Sapling".to_owned(),
            treatments: vec!["control".to_owned()],
            factors: Vec::new(),
            species: vec!["sapling".to_owned()],
            states: vec![vec!["young".to_owned(), "old".to_owned()]],
            ticks_per_year: vec![Some(4.0)],
            seed: 42,
            version: "0.0.0".to_owned(),
            git_hash: "abc".to_owned(),
            resolved: serde_json::json!({ "species": "sapling", "share": 0.1 }),
            inputs: Vec::new(),
        },
    }
}

/// A sown plot.
pub fn plot(plant: u32, component_limit: u32) -> Plot<'static> {
    Plot::of_one(&Sapling, &seed(plant, component_limit))
}

fn seed(plant: u32, component_limit: u32) -> Seed {
    Seed { plant, draws: plant.into(), run_seed: 42, component_limit, keep_events: true }
}

/// A grown and ended plot in the shard of a folder.
pub fn grow_shard(folder: &RunFolder, shard: u32, component_limit: u32) -> ShardReport {
    grow_shard_of(&Sapling, folder, shard, component_limit)
}

fn grow_shard_of(model: &dyn GrowthModel, folder: &RunFolder, shard: u32, component_limit: u32) -> ShardReport {
    let alone = |id| Plot::of_one(model, &seed(id, component_limit));
    let (report, endings) = grow_plots(folder, shard, alone);
    assert!(endings.iter().all(|ending| matches!(ending, Ending::Complete) == (component_limit > 1000)));
    report
}

/// Sows, grows and ends the plots of a shard of a folder; returns the report of the shard, and how each plot ended.
pub fn grow_plots<'m>(folder: &RunFolder, shard: u32, sow: impl Fn(u32) -> Plot<'m>) -> (ShardReport, Vec<Ending>) {
    let mut open = folder.shard(shard).unwrap();
    let mut endings = Vec::new();
    for id in folder.plan().plots_of(shard) {
        let mut plot = sow(id);
        let ending = grow(&mut plot, folder.plan().until, &mut open).unwrap();
        open.end_plot(&plot, ending.clone()).unwrap();
        endings.push(ending);
    }
    (open.commit().unwrap(), endings)
}

/// A whole run of specimens.
pub fn run(path: &Path, plan: RunPlan) -> RunReport {
    run_of(&Sapling, path, plan)
}

/// A whole run of the plants of a model.
pub fn run_of(model: &dyn GrowthModel, path: &Path, plan: RunPlan) -> RunReport {
    let folder = RunFolder::create(path, plan, Mode::New).unwrap();
    for shard in folder.missing_shards() {
        grow_shard_of(model, &folder, shard, 100_000);
    }
    folder.finish(&[("growth", 0.5)]).unwrap()
}
