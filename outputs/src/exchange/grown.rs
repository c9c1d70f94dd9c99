//! From a grown plant at an age to a description: classes P, A, U, I, L, F and R, with the features of its records.
//!
//! What stands at the age is told, dead wood too. An axis springs from the internode that bears it, and one that has
//! no internode yet is told as well. Growth units are told where the model has them; else internodes are parts of their
//! axis. The number of each component stands in the feature `Id`, its kind in `kind` where the class does not say it.
//! Absent: meshes of organs, buds as entities of their own, and what has fallen.

use super::description::{
    Class, Description, Entity, FeatureType, Individual, Link, Observation, Role, Standing, Value,
};
use phytomer_sim::Tick;
use phytomer_sim::plant::{AxisId, Class as KindClass, Frame, Kind, NOT_TOLD, NodeId, OrganId, Plant};
use phytomer_sim::pose::organ_frame;
use std::collections::BTreeMap;

/// The classes of this program, with their scales and roles.
pub(super) const CLASSES: [(&str, u32, Role); 7] = [
    ("P", 1, Role::Plant),
    ("A", 2, Role::Axis),
    ("U", 3, Role::GrowthUnit),
    ("I", 4, Role::Internode),
    ("L", 4, Role::Leaf),
    ("F", 4, Role::Flower),
    ("R", 4, Role::Fruit),
];
const PLANT: u32 = 0;
const AXIS: u32 = 1;
const UNIT: u32 = 2;
const INTERNODE: u32 = 3;

/// What is told of a plant beside its columns.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Told {
    /// Its name.
    pub name: Option<String>,
    /// Its species.
    pub species: Option<String>,
    /// Its place in the plot, metres.
    pub place: Option<[f64; 3]>,
}

/// A description without plants, to which grown plants are added.
pub fn of_grown(ticks_per_year: Option<f64>) -> Description {
    let class = |(symbol, scale, role): (&str, u32, Role)| Class { symbol: symbol.to_owned(), scale, role };
    let mut description = Description { classes: CLASSES.map(class).into(), ticks_per_year, ..Description::default() };
    description.feature("Id", FeatureType::Int);
    description.feature("kind", FeatureType::Text);
    description
}

/// Adds a plant as it stands at an age, for which it is posed. In O(n log n) for n components.
pub fn add(description: &mut Description, plant: &Plant, age: Tick, told: &Told) {
    let standing = told.place.map(|place| Standing { place, scale: 1.0, azimuth: 0.0, inclination: 0.0, twist: 0.0 });
    let (name, species) = (told.name.clone(), told.species.clone());
    let mut entities = Telling::new(plant, age);
    entities.axes();
    let entities = entities.entities;
    description.individuals.push(Individual { name, species, age: Some(age), standing, entities });
}

struct Telling<'p> {
    plant: &'p Plant,
    age: Tick,
    entities: Vec<Entity>,
    /// The entity of each node that stands.
    of_node: Vec<u32>,
    /// The organs that stand, by their nodes.
    organs: BTreeMap<u32, Vec<OrganId>>,
    /// How many entities of each class a node bears so far.
    borne: BTreeMap<(u32, u32), u32>,
}

const NONE: u32 = u32::MAX;

impl<'p> Telling<'p> {
    fn new(plant: &'p Plant, age: Tick) -> Self {
        let mut organs: BTreeMap<u32, Vec<OrganId>> = BTreeMap::new();
        for organ in (0..plant.organs.len() as u32).map(OrganId) {
            if plant.organs.birth[organ.index()] <= age && age < plant.organ_end(organ) {
                organs.entry(plant.organs.node[organ.index()].0).or_default().push(organ);
            }
        }
        let root = Entity { index: Some(f64::from(plant.id) + 1.0), ..Entity::of(PLANT) };
        let of_node = vec![NONE; plant.nodes.len()];
        Self { plant, age, entities: vec![root], of_node, organs, borne: BTreeMap::new() }
    }

    fn push(&mut self, entity: Entity) -> u32 {
        self.entities.push(entity);
        self.entities.len() as u32 - 1
    }

    /// The rank of the next entity of a class among its like on an internode, from 1.
    fn rank(&mut self, on: u32, class: u32) -> Option<f64> {
        let count = self.borne.entry((on, class)).or_insert(0);
        *count += 1;
        Some(f64::from(*count))
    }

    fn axes(&mut self) {
        let mut nodes: Vec<(AxisId, u32)> = Vec::new();
        self.plant.each_standing(self.age, |stretch| {
            nodes.extend(stretch.nodes().map(|node| (stretch.axis, node as u32)));
        });
        nodes.sort_unstable();
        let mut nodes = nodes.as_slice();
        for axis in (0..self.plant.axes.len() as u32).map(AxisId) {
            let count = nodes.iter().take_while(|(of, _)| *of == axis).count();
            let (own, rest) = nodes.split_at(count);
            nodes = rest;
            let i = axis.index();
            let buds = self.plant.axes.appearance[i] <= self.age && self.age < self.plant.bud_end(axis);
            if !own.is_empty() || buds {
                let entity = self.axis(axis);
                self.internodes(entity, own);
            }
        }
    }

    fn axis(&mut self, axis: AxisId) -> u32 {
        let axes = &self.plant.axes;
        let i = axis.index();
        let bearer = axes.bearer[i].some().map(|node| self.of_node[node.index()]).filter(|bearer| *bearer != NONE);
        let (birth, death, number) = (axes.appearance[i], axes.death[i], axes.component[i]);
        let rank = self.rank(bearer.unwrap_or(0), AXIS);
        self.push(Entity {
            index: rank,
            bearer,
            link: bearer.map(|_| Link::Branches),
            complex: Some(0),
            ..self.entity(AXIS, (birth, death), numbered(number, None))
        })
    }

    /// An entity of a class with its ages and an observation.
    fn entity(&self, class: u32, (birth, death): (Tick, Tick), seen: Observation) -> Entity {
        let dead = death <= self.age;
        Entity {
            birth: Some(birth),
            death: dead.then_some(death),
            dead: Some(dead),
            observations: vec![seen],
            ..Entity::of(class)
        }
    }

    fn internodes(&mut self, axis: u32, nodes: &[(AxisId, u32)]) {
        let columns = &self.plant.nodes;
        let (mut unit, mut whole, mut last) = (NOT_TOLD, axis, None);
        for &(of, node) in nodes {
            let i = node as usize;
            let own = columns.growth_unit[i];
            if own != unit && own != NOT_TOLD {
                unit = own;
                let ages = (columns.birth[i], self.plant.axes.death[of.index()]);
                let begun = Entity { observations: Vec::new(), ..self.entity(UNIT, ages, Observation::default()) };
                whole = self.push(Entity {
                    index: Some(f64::from(own)),
                    bearer: last,
                    link: last.map(|_| Link::Follows),
                    complex: Some(axis),
                    ..begun
                });
                last = None;
            }
            let id = NodeId(node);
            let seen = Observation {
                length: Some(f64::from(self.plant.posed_length(id))),
                base_diameter: Some(f64::from(columns.diameter[i])),
                tip_diameter: Some(f64::from(columns.diameter_tip[i])),
                ..self.seen(columns.component[i], self.plant.kind_of(id), Kind::Internode, self.plant.frames.at(id))
            };
            let entity = self.push(Entity {
                index: Some(f64::from(columns.rank[i])),
                bearer: last,
                link: last.map(|_| Link::Follows),
                complex: Some(whole),
                ..self.entity(INTERNODE, (columns.birth[i], self.plant.death_of(id)), seen)
            });
            self.of_node[i] = entity;
            last = Some(entity);
            self.organs_of(node, entity, whole);
        }
    }

    fn organs_of(&mut self, node: u32, on: u32, whole: u32) {
        let organs = &self.plant.organs;
        for organ in self.organs.remove(&node).unwrap_or_default() {
            let i = organ.index();
            let (class, plain) = match organs.kind[i].class() {
                KindClass::Flower => (5, Kind::Flower),
                KindClass::Fruit => (6, Kind::Fruit),
                _ => (4, Kind::Leaf),
            };
            let share = self.plant.expanded(organ, self.age);
            let area: f32 = self.plant.organ_area(organ, self.age);
            let frame = organ_frame(self.plant, organ, self.age);
            let seen = Observation {
                length: Some(f64::from(organs.length[i] * share)),
                base_diameter: Some(f64::from(organs.width[i] * share)),
                area: (area > 0.0).then_some(f64::from(area)),
                ..self.seen(organs.component[i], organs.kind[i], plain, frame)
            };
            let rank = self.rank(on, class);
            let ages = (organs.birth[i], self.plant.organ_end(organ));
            self.push(Entity {
                index: rank,
                bearer: Some(on),
                link: Some(Link::Branches),
                complex: Some(whole),
                ..self.entity(class, ages, seen)
            });
        }
    }

    /// Number, kind and pose of a component.
    fn seen(&self, number: u32, kind: Kind, plain: Kind, frame: Frame) -> Observation {
        let vector = |vector: [f32; 3]| Some(vector.map(f64::from));
        Observation {
            place: vector(frame.base),
            direction: vector(frame.heading),
            up: vector(frame.up),
            ..numbered(number, (kind != plain).then(|| kind.tag()))
        }
    }
}

fn numbered(number: u32, kind: Option<&str>) -> Observation {
    let id = (0, Value::Int(i64::from(number)));
    let kind = kind.map(|kind| (1, Value::Text(kind.into())));
    Observation { values: std::iter::once(id).chain(kind).collect(), ..Observation::default() }
}
