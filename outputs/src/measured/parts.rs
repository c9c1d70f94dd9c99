//! The components of a measured plant, with their numbers, axes and ranks.
//!
//! Components are the entities without parts of their own. Wood is what is no leaf, flower or fruit. Wood that follows
//! wood is of one axis; what branches begins an axis of the next order, and so does the beginning of the plant, of
//! order 1. An axis is named by a bud, as in grown runs: of its place and life the file says nothing. A bearer of a
//! coarser scale stands for the last wood within it. In O(n) for n entities, times the number of scales.

use crate::exchange::{Description, Entity, Individual, Link, Role};
use phytomer_sim::plant::{Kind, Origin};

/// A component.
#[derive(Debug, Clone, Copy)]
pub struct Part {
    /// Its entity; `None` of the bud of an axis that no entity tells.
    pub entity: Option<u32>,
    /// What it is.
    pub kind: Kind,
    /// Its axis, as the number of the bud.
    pub axis: u32,
    /// The axis that bears its axis.
    pub bearing: Option<u32>,
    /// The order of its axis, from 1.
    pub order: u32,
    /// How its axis came to be, as far as the topology tells it.
    pub origin: Origin,
    /// The internode that bears it; of a bud the internode that bears its axis.
    pub parent: Option<u32>,
    /// The rank of the internode, or of the one that bears it.
    pub rank: Option<u32>,
    /// The number of the growth unit on its axis, from 1, where the file has growth units.
    pub unit: Option<u32>,
    /// The rank in the growth unit.
    pub unit_rank: Option<u32>,
    /// The position among its like on the internode, from 0; of organs and buds.
    pub position: Option<u32>,
}

/// A measured plant.
#[derive(Debug)]
pub struct Measured<'d> {
    /// Its description.
    pub individual: &'d Individual,
    /// Its components by number.
    pub parts: Vec<Part>,
}

impl Measured<'_> {
    /// The entity of a component.
    pub fn entity(&self, part: &Part) -> Option<&Entity> {
        part.entity.map(|entity| &self.individual.entities[entity as usize])
    }

    /// Whether any component has a place and a direction.
    pub fn has_places(&self) -> bool {
        let seen = |part: &Part| {
            self.entity(part).is_some_and(|entity| {
                entity.observations.iter().any(|seen| seen.place.is_some() && seen.direction.is_some())
            })
        };
        self.parts.iter().any(seen)
    }
}

/// The components of a plant.
pub fn measured<'d>(description: &'d Description, individual: &'d Individual) -> Measured<'d> {
    let entities = &individual.entities;
    let mut has_parts = vec![false; entities.len()];
    entities.iter().filter_map(|entity| entity.complex).for_each(|complex| has_parts[complex as usize] = true);
    let mut taking =
        Taking { description, individual, parts: Vec::new(), last: vec![None; entities.len()], borne: Vec::new() };
    for place in 0..entities.len() as u32 {
        let role = description.role_of(&entities[place as usize]);
        if !has_parts[place as usize] && !matches!(role, Role::Scene | Role::Plant) {
            taking.take(place, role);
        }
    }
    Measured { individual, parts: taking.parts }
}

struct Taking<'d> {
    description: &'d Description,
    individual: &'d Individual,
    parts: Vec<Part>,
    /// The last wood within each entity, as a component.
    last: Vec<Option<u32>>,
    /// How many leaves, flowers, fruits and buds each component bears.
    borne: Vec<[u32; 4]>,
}

impl Taking<'_> {
    fn push(&mut self, part: Part) -> u32 {
        self.parts.push(part);
        self.borne.push([0; 4]);
        self.parts.len() as u32 - 1
    }

    fn take(&mut self, place: u32, role: Role) {
        let found = self.individual.bearer_of(place);
        let bearer = found.and_then(|(bearer, _)| self.wood_of(bearer));
        let (kind, like) = match role {
            Role::Leaf => (Kind::Leaf, 0),
            Role::Flower => (Kind::Flower, 1),
            Role::Fruit => (Kind::Fruit, 2),
            // An axis of which nothing but itself is told is a bud.
            Role::Axis => (Kind::ApicalBud, 3),
            _ => return self.wood(place, bearer, found.map(|(_, link)| link)),
        };
        if role == Role::Axis {
            self.axis(bearer, Some(place));
        } else {
            self.organ(place, kind, (bearer, like));
        }
    }

    /// The wood that an entity is, or the last within it.
    fn wood_of(&self, entity: u32) -> Option<u32> {
        self.last[entity as usize]
    }

    fn position(&mut self, bearer: Option<u32>, like: usize) -> Option<u32> {
        let count = &mut self.borne[bearer? as usize][like];
        *count += 1;
        Some(*count - 1)
    }

    /// The bud of a new axis, which a component bears.
    fn axis(&mut self, bearer: Option<u32>, entity: Option<u32>) -> u32 {
        let bearing = bearer.map(|bearer| self.parts[bearer as usize]);
        let position = self.position(bearer, 3);
        self.push(Part {
            entity,
            kind: Kind::ApicalBud,
            axis: self.parts.len() as u32,
            bearing: bearing.map(|bearing| bearing.axis),
            order: bearing.map_or(1, |bearing| bearing.order + 1),
            origin: if bearing.is_some() { Origin::Axillary } else { Origin::Seed },
            parent: bearer,
            rank: bearing.and_then(|bearing| bearing.rank),
            unit: None,
            unit_rank: bearing.and_then(|bearing| bearing.unit_rank),
            position,
        })
    }

    fn organ(&mut self, place: u32, kind: Kind, (bearer, like): (Option<u32>, usize)) {
        // An organ without wood stands on an axis of its own, so that it has one.
        let on = match bearer {
            Some(bearer) => self.parts[bearer as usize],
            None => {
                let axis = self.axis(None, None);
                self.parts[axis as usize]
            }
        };
        let position = self.position(bearer, like);
        self.push(Part { entity: Some(place), kind, parent: bearer, unit: None, position, ..on });
    }

    fn wood(&mut self, place: u32, bearer: Option<u32>, link: Option<Link>) {
        let follows = bearer.filter(|_| link == Some(Link::Follows)).map(|bearer| self.parts[bearer as usize]);
        let before = match follows {
            Some(before) => before,
            None => {
                let bud = self.axis_of(place, bearer);
                Part { rank: Some(0), unit: None, unit_rank: None, ..self.parts[bud as usize] }
            }
        };
        let is_unit = |entity: &Entity| self.description.role_of(entity) == Role::GrowthUnit;
        let own = self.individual.within(place, is_unit);
        let same = own.is_some() && follows.and_then(|before| self.individual.within(before.entity?, is_unit)) == own;
        let unit = own.map(|_| before.unit.unwrap_or(0) + u32::from(!same));
        let unit_rank = own.map(|_| if same { before.unit_rank.unwrap_or(0) + 1 } else { 1 });
        let rank = before.rank.map(|rank| rank + 1);
        let part = Part {
            entity: Some(place),
            kind: Kind::Internode,
            parent: bearer,
            rank,
            unit,
            unit_rank,
            position: None,
            ..before
        };
        let number = self.push(part);
        let mut at = Some(place);
        while let Some(entity) = at {
            self.last[entity as usize] = Some(number);
            at = self.individual.entities[entity as usize].complex;
        }
    }

    /// The bud of the axis that a piece of wood begins: of the entity of the axis, where it is told as a whole.
    fn axis_of(&mut self, place: u32, bearer: Option<u32>) -> u32 {
        let is_axis = |entity: &Entity| self.description.role_of(entity) == Role::Axis;
        let whole = self.individual.entities[place as usize].complex;
        let entity = whole.and_then(|whole| self.individual.within(whole, is_axis));
        // The entity stands for the axis that it begins, not for others within it.
        let entity = entity.filter(|entity| self.last[*entity as usize].is_none());
        self.axis(bearer, entity)
    }
}
