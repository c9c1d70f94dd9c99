//! The wood of plants as cylinders in rows: what every kind of file of cylinders is written from.
//!
//! A row is what is wood and has no finer wood in it, with a place, a direction, a length and a diameter. Its radius is
//! that of a cylinder of the same length and volume. Parents stand before their children, and parents without a row of
//! their own are passed over. Absent: how a file lays the rows out (`write`).

use super::super::description::{Description, Entity, Individual, Link, Observation, Role, Value};
use super::super::losses::Losses;
use super::tree::Cylinders;

/// A cylinder that is written.
#[derive(Debug, Clone)]
pub(super) struct Row {
    /// The place of its parent among the rows.
    pub parent: Option<u32>,
    /// The place of what goes on from it along its axis.
    pub extension: Option<u32>,
    /// The number of its axis, from 1.
    pub axis: u32,
    /// The order of its axis; the trunk's is 0.
    pub order: u32,
    /// Its place along its axis, from 1.
    pub position: u32,
    /// Where it begins, m.
    pub start: [f64; 3],
    /// Its direction.
    pub direction: [f64; 3],
    /// Its length, m.
    pub length: f64,
    /// Its radius, m.
    pub radius: f64,
    /// Deviation, coverage, whether it is added, and radius before it was changed.
    pub told: [f64; 4],
}

/// The rows of each plant.
#[derive(Debug, Default)]
pub(super) struct Rows {
    /// The plants.
    pub plants: Vec<Vec<Row>>,
}

/// The features that rows tell beside their cylinder, with what stands there where a description has none.
pub(super) const TOLD: [&str; 4] = ["mad", "SurfCov", "added", "UnmodRadius"];

/// What stands in the place of a feature of a cylinder that does not have it.
fn stand_in(feature: usize, radius: f64) -> f64 {
    if feature == 3 { radius } else { 0.0 }
}

/// The cylinders without the features in which nothing but such stand-ins stand.
pub(super) fn without_stand_ins(mut cylinders: Cylinders) -> Cylinders {
    let tells = |place: usize, name: &str| {
        let feature = TOLD.iter().position(|known| *known == name).unwrap_or_default();
        cylinders.all.iter().any(|cylinder| cylinder.values[place] != stand_in(feature, cylinder.radius))
    };
    let kept: Vec<usize> =
        (0..cylinders.features.len()).filter(|place| tells(*place, cylinders.features[*place])).collect();
    for cylinder in &mut cylinders.all {
        cylinder.values = kept.iter().map(|place| cylinder.values[*place]).collect();
    }
    cylinders.features = kept.iter().map(|place| cylinders.features[*place]).collect();
    cylinders
}

impl Rows {
    /// The rows of the plants of a description, and what they do not hold.
    pub fn of(description: &Description, losses: &mut Losses) -> Self {
        let told = TOLD.map(|name| description.features.iter().position(|feature| feature.name == name));
        let plants = description.individuals.iter().map(|plant| Making::of(description, plant, told).all(losses));
        let rows = Self { plants: plants.collect() };
        let count = rows.plants.len().saturating_sub(1) as u64;
        losses.add("plants beyond the first in one file", count, "each has a file of its own");
        let standing = description.individuals.iter().filter(|plant| plant.standing.is_some()).count() as u64;
        losses.add("places of plants in their plot", standing, "a cylinder stands where it is in its plant");
        rows
    }
}

/// The rows of a plant, in the making.
struct Making<'a> {
    description: &'a Description,
    plant: &'a Individual,
    told: [Option<usize>; 4],
    rows: Vec<Row>,
    /// The row that what springs from an entity springs from.
    anchor: Vec<Option<u32>>,
    /// The axis of each row among the entities.
    axis_of: Vec<Option<u32>>,
    axes: u32,
}

impl<'a> Making<'a> {
    fn of(description: &'a Description, plant: &'a Individual, told: [Option<usize>; 4]) -> Self {
        let anchor = vec![None; plant.entities.len()];
        Self { description, plant, told, rows: Vec::new(), anchor, axis_of: Vec::new(), axes: 0 }
    }

    fn role(&self, entity: &Entity) -> Role {
        self.description.role_of(entity)
    }

    fn all(mut self, losses: &mut Losses) -> Vec<Row> {
        let mut has_wood = vec![false; self.plant.entities.len()];
        for entity in self.plant.entities.iter().filter(|entity| is_wood(self.role(entity))) {
            if let Some(whole) = entity.complex {
                has_wood[whole as usize] = true;
            }
        }
        for number in 0..self.plant.entities.len() as u32 {
            let entity = &self.plant.entities[number as usize];
            let springs = self.plant.bearer_of(number);
            let parent = springs.and_then(|(bearer, _)| self.anchor[bearer as usize]);
            let row = if is_wood(self.role(entity)) && !has_wood[number as usize] {
                self.row(number, entity, parent, springs.map(|(_, link)| link), losses)
            } else {
                tell_lost(self.role(entity), has_wood[number as usize], losses);
                None
            };
            self.anchor[number as usize] = row.or(parent);
            if let Some(row) = row {
                self.hold(entity.complex, row);
            }
            let ages = u64::from(entity.birth.is_some() || entity.death.is_some());
            losses.add("ages of birth and death", ages, "the format has none");
        }
        self.rows
    }

    /// What springs from a whole springs from its last row.
    fn hold(&mut self, mut whole: Option<u32>, row: u32) {
        while let Some(at) = whole {
            let entity = &self.plant.entities[at as usize];
            if matches!(self.role(entity), Role::Plant | Role::Scene) {
                return;
            }
            self.anchor[at as usize] = Some(row);
            whole = entity.complex;
        }
    }

    fn row(
        &mut self,
        number: u32,
        entity: &Entity,
        parent: Option<u32>,
        link: Option<Link>,
        losses: &mut Losses,
    ) -> Option<u32> {
        let Some((seen, start, length)) = entity.latest().and_then(|seen| Some((seen, seen.place?, seen.length?)))
        else {
            losses.add("wood without a place or a length", 1, "what it bears springs from its bearer");
            return None;
        };
        let Some((base, direction)) =
            seen.base_diameter.or(seen.tip_diameter).zip(seen.direction.or_else(|| still(length)))
        else {
            losses.add("wood without a diameter or a direction", 1, "what it bears springs from its bearer");
            return None;
        };
        let radius = radius(base, seen.tip_diameter.unwrap_or(base));
        let narrows = seen.tip_diameter.is_some_and(|tip| tip != base);
        losses.add("how wood narrows", u64::from(narrows), "a cylinder of the same volume");
        let place = self.rows.len() as u32;
        let axis = self.plant.within(number, |whole| self.role(whole) == Role::Axis);
        let goes_on = parent.filter(|parent| {
            let before = &self.rows[*parent as usize];
            link == Some(Link::Follows) && before.extension.is_none() && self.axis_of[*parent as usize] == axis
        });
        let (axis_number, order, position) = match (goes_on, parent) {
            (Some(parent), _) => {
                let before = &mut self.rows[parent as usize];
                before.extension = Some(place);
                (before.axis, before.order, before.position + 1)
            }
            (None, parent) => {
                self.axes += 1;
                (self.axes, parent.map_or(0, |parent| self.rows[parent as usize].order + 1), 1)
            }
        };
        let told = self.told_of(seen, radius);
        let (extension, axis_is) = (None, axis);
        self.rows.push(Row {
            parent,
            extension,
            axis: axis_number,
            order,
            position,
            start,
            direction,
            length,
            radius,
            told,
        });
        self.axis_of.push(axis_is);
        Some(place)
    }

    fn told_of(&self, seen: &Observation, radius: f64) -> [f64; 4] {
        [0, 1, 2, 3].map(|place| {
            let value =
                self.told[place].and_then(|feature| seen.values.iter().find(|(known, _)| *known as usize == feature));
            match value {
                Some((_, Value::Real(number))) => *number,
                Some((_, Value::Int(number))) => *number as f64,
                Some((_, Value::Truth(truth))) => f64::from(u8::from(*truth)),
                _ => stand_in(place, radius),
            }
        })
    }
}

fn is_wood(role: Role) -> bool {
    matches!(role, Role::Internode | Role::GrowthUnit | Role::Axis)
}

/// The direction of what has no length.
fn still(length: f64) -> Option<[f64; 3]> {
    (length == 0.0).then_some([0.0; 3])
}

/// The radius of a cylinder with the volume of a truncated cone of these diameters and the same length.
fn radius(base: f64, tip: f64) -> f64 {
    if base == tip { base / 2.0 } else { ((base * base + base * tip + tip * tip) / 12.0).sqrt() }
}

fn tell_lost(role: Role, is_whole: bool, losses: &mut Losses) {
    let what = match role {
        Role::Leaf => "leaves",
        Role::Flower => "flowers",
        Role::Fruit => "fruits",
        Role::GrowthUnit if is_whole => "growth units",
        Role::Other => "entities that are no wood",
        _ => return,
    };
    losses.add(what, 1, "the format has wood alone");
}
