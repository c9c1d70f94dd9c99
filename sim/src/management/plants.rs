//! Whole plants, measured where conditions ask.
//!
//! A plant is measured as it stood at the end of the tick before the operation, and without what has been taken since.
//! Absent: what is done with it.

use super::column::Column;
use crate::clock::Tick;
use crate::plant::{Class, Kind, NodeId, OrganId, Plant};
use crate::pose;

/// The value of a column of a plant that is number `member` of its plot, at its age `tick`; NaN for columns that plants
/// do not have. Linear in the plant.
pub fn value(plant: &Plant, member: usize, tick: Tick, column: Column) -> f64 {
    let organs = |counts: &dyn Fn(usize) -> bool| {
        let there = |organ: usize| plant.organ_stands(OrganId(organ as u32), tick);
        (0..plant.organs.len())
            .filter(|&organ| counts(organ) && plant.organs.birth[organ] < tick && there(organ))
            .collect::<Vec<usize>>()
    };
    match column {
        Column::Age => f64::from(tick),
        Column::Member => member as f64,
        Column::Components => f64::from(plant.components()),
        Column::Internodes => {
            let mut standing = 0;
            plant.each_standing(tick, |stretch| standing += stretch.nodes().len());
            standing as f64
        }
        Column::Leaves => organs(&|organ| plant.organs.kind[organ] == Kind::Leaf).len() as f64,
        Column::Fruits => organs(&|organ| plant.organs.kind[organ].class() == Class::Fruit).len() as f64,
        Column::LeafArea => {
            let leaves = organs(&|organ| plant.organs.kind[organ].is_foliage());
            let area = |organ: usize| plant.organ_area::<f64>(OrganId(organ as u32), tick.saturating_sub(1));
            leaves.into_iter().fold(0.0, |sum, leaf| sum + area(leaf))
        }
        Column::Diameter => trunk_base(plant, tick).map_or(0.0, |node| f64::from(plant.nodes.diameter[node.index()])),
        Column::Height => height(plant, tick),
        _ => f64::NAN,
    }
}

/// The height of the plant, metres.
pub fn height(plant: &Plant, tick: Tick) -> f64 {
    f64::from(pose::height(plant, tick))
}

/// The first internode of the trunk that stands.
fn trunk_base(plant: &Plant, tick: Tick) -> Option<NodeId> {
    let mut first = None;
    plant.each_standing(tick, |stretch| {
        if plant.axes.bearer[stretch.axis.index()].some().is_none() {
            first = first.or(Some(NodeId(stretch.nodes().start as u32)));
        }
    });
    first
}
