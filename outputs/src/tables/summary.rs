//! The rows of `summary`: one plant at one age in a few numbers, which agree with a count of its `records`.
//!
//! Sums run in the order of the plant's columns, in double precision, so their bits do not depend on the number of
//! threads.

use super::TableError;
use super::buffers::{NULL, columns};
use super::component_index::ComponentIndex;
use super::membership::Membership;
use phytomer_sim::Tick;
use phytomer_sim::mechanics::wood_volume;
use phytomer_sim::plant::{AxisId, Cause, Class, Kind, NodeId, OrganId, Plant};
use phytomer_sim::pose::{node_frame, organ_frame};
use std::ops::Range;

columns! {
    /// The buffers of `summary`.
    SummaryColumns of summary: Summary, of: &OfPlant<'_> {
        treatment: Name(i32) = of.of.treatment as i32,
        plot: Int(i32) = of.of.plot as i32,
        plant: Int(i32) = of.plant.id as i32,
        tick: Int(i32) = of.of.tick_at(of.age) as i32,
        age: Int(i32) = of.age as i32,
        internodes: Int(i32) = summary.internodes as i32,
        leaves: Int(i32) = summary.leaves as i32,
        flowers: Int(i32) = summary.flowers as i32,
        fruits: Int(i32) = summary.fruits as i32,
        buds: Int(i32) = summary.buds as i32,
        dead_internodes: Int(i32) = summary.dead_internodes as i32,
        axes: Int(i32) = summary.axes as i32,
        max_order: Int(i32) = i32::from(summary.max_order),
        height: Double(f64) = summary.height,
        crown_width: Double(f64) = summary.crown_width,
        leaf_area: Double(f64) = summary.leaf_area,
        wood_volume: Double(f64) = summary.wood_volume,
        alive: Bool(i8) = i8::from(of.plant.lives(of.age)),
        death: Int(i32) = if of.plant.lives(of.age) { NULL } else { of.plant.death as i32 },
        harvested_fruits: Int(i32) = summary.harvested_fruits as i32,
        harvested_mass: Double(f64) = summary.harvested_mass,
        basal_diameter: Double(f64) = summary.basal_diameter,
        breast_diameter: Double(f64) = summary.breast_diameter,
        lowest_leaf: Double(f64) = summary.lowest_leaf,
        intercepted_light: Double(f64),
        light_competition: Double(f64),
    }
}

/// The plant and the age of a summary.
struct OfPlant<'a> {
    of: Membership,
    plant: &'a Plant,
    age: Tick,
}

/// The summary of one plant at one age.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Summary {
    /// Living internodes.
    pub internodes: u32,
    /// Living leaves.
    pub leaves: u32,
    /// Open flowers.
    pub flowers: u32,
    /// Fruits.
    pub fruits: u32,
    /// Living apical buds.
    pub buds: u32,
    /// Dead internodes that still stand.
    pub dead_internodes: u32,
    /// Axes that stand.
    pub axes: u32,
    /// The highest order of the standing axes.
    pub max_order: u8,
    /// The height of the tip of the highest living internode above the seed, m; NaN (null in the table) where none
    /// lives.
    pub height: f64,
    /// The mean of the widths along x and y of the living part of the plant, m; NaN where no internode lives.
    pub crown_width: f64,
    /// The area of one side of all leaves, m².
    pub leaf_area: f64,
    /// The volume of all internodes that stand, m³.
    pub wood_volume: f64,
    /// Fruits harvested by this age.
    pub harvested_fruits: u32,
    /// Their fresh mass when they were harvested, kg; NaN where the species states no mass of fruits.
    pub harvested_mass: f64,
    /// The diameter at the base of the first internode of the axis of the seed, m; NaN where it does not live.
    pub basal_diameter: f64,
    /// The greatest diameter at 1.3 m of the living internodes of order 1 that rise through that height,
    /// m; NaN where none does.
    pub breast_diameter: f64,
    /// The height of the base of the lowest leaf or leaflet above the seed, m; NaN where there is none.
    pub lowest_leaf: f64,
}

/// The height at which foresters measure the diameter of a stem, m.
pub const BREAST_HEIGHT_M: f64 = 1.3;

impl Summary {
    /// The summary of `plant`, posed at `age`, in O(n) for n components.
    ///
    /// # Errors
    /// [`TableError::PlantTooLarge`].
    pub fn of(plant: &Plant, age: Tick) -> Result<Self, TableError> {
        let mut index = ComponentIndex::default();
        index.read(plant)?;
        index.find_tips(plant, age);
        Ok(summarise(plant, &index, age))
    }
}

/// The summary of `plant` at `age`; `index` holds the plant with the tips of its axes at that age.
pub fn summarise(plant: &Plant, index: &ComponentIndex, age: Tick) -> Summary {
    let [basal_diameter, breast_diameter, lowest_leaf] = [f64::NAN; 3];
    let mut summary = Summary { basal_diameter, breast_diameter, lowest_leaf, ..Summary::default() };
    count_nodes(plant, age, &mut summary);
    count_organs(plant, age, &mut summary);
    count_axes(plant, index, age, &mut summary);
    summary
}

fn count_nodes(plant: &Plant, age: Tick, summary: &mut Summary) {
    let axes = &plant.axes;
    let mut low = [f32::INFINITY; 3];
    let mut high = [f32::NEG_INFINITY; 3];
    // The standing part of an axis lives or is dead as a whole.
    plant.each_standing(age, |stretch| {
        let (axis, standing) = (stretch.axis, stretch.nodes());
        let frusta = standing.clone().map(|node| wood_volume(plant, NodeId(node as u32)));
        summary.wood_volume = frusta.fold(summary.wood_volume, |sum, frustum| sum + frustum);
        if age >= axes.death[axis.index()] {
            summary.dead_internodes += standing.len() as u32;
            return;
        }
        summary.internodes += standing.len() as u32;
        if axes.order[axis.index()] == 1 {
            measure_stem(plant, axis, standing.clone(), summary);
        }
        for node in standing {
            let tip = node_frame(plant, NodeId(node as u32)).base;
            for k in 0..3 {
                low[k] = low[k].min(tip[k]);
                high[k] = high[k].max(tip[k]);
            }
        }
    });
    let extent = |k: usize| f64::from(high[k]) - f64::from(low[k]);
    let lives = summary.internodes > 0;
    summary.height = if lives { f64::from(high[2]) } else { f64::NAN };
    summary.crown_width = if lives { (extent(0) + extent(1)) / 2.0 } else { f64::NAN };
}

/// Measures the diameters of living internodes of an axis of order 1. A trunk of relays is measured as any other, since
/// relays are of its order. Diameters are straight from the base of an internode to its tip, as its frustum is.
fn measure_stem(plant: &Plant, axis: AxisId, standing: Range<usize>, summary: &mut Summary) {
    let nodes = &plant.nodes;
    for node in standing {
        if axis == AxisId::TRUNK && nodes.rank[node] == 1 {
            summary.basal_diameter = nodes.diameter[node].into();
        }
        let (base, tip) = (plant.frames.base[node][2], node_frame(plant, NodeId(node as u32)).base[2]);
        let (base, tip) = (f64::from(base), f64::from(tip));
        if base <= BREAST_HEIGHT_M && BREAST_HEIGHT_M < tip {
            let share = (BREAST_HEIGHT_M - base) / (tip - base);
            let (low, high) = (f64::from(nodes.diameter[node]), f64::from(nodes.diameter_tip[node]));
            summary.breast_diameter = summary.breast_diameter.max(low + (high - low) * share);
        }
    }
}

fn count_organs(plant: &Plant, age: Tick, summary: &mut Summary) {
    let organs = &plant.organs;
    let masses = plant.habit.wood.as_ref().map(|wood| &wood.organs).filter(|masses| masses.fruit > 0.0);
    summary.harvested_mass = if masses.is_some() { 0.0 } else { f64::NAN };
    for organ in 0..organs.len() {
        if organs.birth[organ] > age {
            continue;
        }
        if age >= plant.organ_end(OrganId(organ as u32)) {
            if organs.cause[organ] == Cause::Harvested && organs.kind[organ].class() == Class::Fruit {
                summary.harvested_fruits += 1;
                summary.harvested_mass += masses.map_or(0.0, |of| of.of(plant, organ, organs.death[organ]));
            }
            continue;
        }
        let kind = organs.kind[organ];
        if kind.is_foliage() {
            summary.leaf_area += plant.organ_area::<f64>(OrganId(organ as u32), age);
            let height = organ_frame(plant, OrganId(organ as u32), age).base[2];
            summary.lowest_leaf = summary.lowest_leaf.min(height.into());
        }
        summary.leaves += u32::from(kind == Kind::Leaf);
        summary.flowers += u32::from(kind.class() == Class::Flower);
        summary.fruits += u32::from(kind.class() == Class::Fruit);
    }
}

fn count_axes(plant: &Plant, index: &ComponentIndex, age: Tick, summary: &mut Summary) {
    let axes = &plant.axes;
    for axis in 0..axes.len() {
        let there = age < axes.shed[axis];
        let bud = plant.bud_lives(AxisId(axis as u32), age);
        let stem = there && index.tip(AxisId(axis as u32)).some().is_some();
        summary.buds += u32::from(bud);
        if bud || stem {
            summary.axes += 1;
            summary.max_order = summary.max_order.max(axes.order[axis]);
        }
    }
}

impl SummaryColumns {
    /// Adds the row of one plant at one age.
    pub fn add(&mut self, of: Membership, plant: &Plant, age: Tick, summary: &Summary) {
        self.extend(std::slice::from_ref(summary), &OfPlant { of, plant, age });
    }
}
