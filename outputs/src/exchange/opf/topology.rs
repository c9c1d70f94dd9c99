//! The plant of an OPF file: elements within elements, as entities with bearers and wholes.
//!
//! `decomp` is a part of the element around it. `branch` springs from the element around it. `follow` goes on from the
//! `decomp` or `follow` of its scale that stands before it in the same element, else from the element around it where
//! that is no whole of its scale. So
//! both ways to write an axis are read: each internode within the one before, and one beside the other. Nothing
//! recurses. Absent: what an element carries (`carried`).

use super::super::contract::MOST_ENTITIES;
use super::super::description::{Class, Entity, Individual, Link, Role};
use super::super::report::Report;
use super::super::text::said;
use super::super::xml::{Element, Piece, Xml};
use super::carried::Carried;
use super::passed::left_out;
use super::words::role;
use std::collections::BTreeMap;

/// The most wholes that an entity may be a part of, one within the other.
const MOST_SCALES: usize = 64;
/// The most classes that a file may have.
const MOST_CLASSES: usize = 10_000;
/// The most chains of different scales in an element that a `follow` is looked for in.
const MOST_CHAINS: usize = 8;

/// The plants of a file, in the making.
#[derive(Debug, Default)]
pub(super) struct Plants {
    /// The plants.
    pub individuals: Vec<Individual>,
    /// The classes of their entities.
    pub classes: Vec<Class>,
    class_of: BTreeMap<(String, u32), u32>,
    entities: usize,
    open: Vec<Open>,
    /// How many wholes each entity of the last plant is a part of.
    levels: Vec<u8>,
}

/// An element that is open.
#[derive(Debug)]
struct Open {
    /// The entity; `None` for a scene, which is none.
    entity: Option<u32>,
    scale: u32,
    /// The last `decomp` or `follow` of each scale in it.
    chains: Vec<(u32, u32)>,
}

/// How an element stands to the element around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Topology,
    Decomp,
    Follow,
    Branch,
}

impl Way {
    fn of(name: &str) -> Option<Self> {
        match name {
            "topology" => Some(Self::Topology),
            "decomp" => Some(Self::Decomp),
            "follow" => Some(Self::Follow),
            "branch" => Some(Self::Branch),
            _ => None,
        }
    }
}

impl Plants {
    /// Reads the plant whose `<topology>` was opened last.
    pub fn read(&mut self, root: &Element<'_>, xml: &mut Xml<'_>, carried: &mut Carried<'_>, report: &mut Report) {
        self.begin(Way::Topology, root, xml, report);
        while !self.open.is_empty() {
            match xml.next(report) {
                Piece::Open(element) => match Way::of(&element.name) {
                    Some(way) => self.begin(way, &element, xml, report),
                    None => match self.open.last().and_then(|open| open.entity) {
                        Some(entity) => carried.take(&element, &mut self.individuals, entity, xml, report),
                        None => left_out(&element, xml, report),
                    },
                },
                Piece::Text(text, at) => {
                    if !text.trim().is_empty() {
                        let place = xml.place(at);
                        report.warn(
                            place,
                            "text",
                            format!("`{}` stands outside of attributes: left out", said(text.trim())),
                        );
                    }
                }
                Piece::Close => _ = self.open.pop(),
                Piece::End => self.open.clear(),
            }
        }
    }

    fn begin(&mut self, way: Way, element: &Element<'_>, xml: &mut Xml<'_>, report: &mut Report) {
        let place = xml.place(element.at);
        if self.entities >= MOST_ENTITIES {
            report.fault(place, "there are too many entities", format!("at most {MOST_ENTITIES}"));
            return self.give_up(xml, report);
        }
        let Some(scale) = self.scale(way, element, place, report) else { return self.give_up(xml, report) };
        let symbol = element.attribute("class").unwrap_or("").trim();
        let is_scene = way == Way::Topology && (role(symbol) == Role::Scene || scale == 0);
        if is_scene {
            self.open.push(Open { entity: None, scale, chains: Vec::new() });
            return;
        }
        let stated = element.attribute("role").map_or_else(|| role(symbol), role);
        let Some(class) = self.class(symbol, scale, stated, place, report) else { return self.give_up(xml, report) };
        match self.entity(way, class, scale, place, report) {
            Some(entity) => self.open.push(Open { entity: Some(entity), scale, chains: Vec::new() }),
            None => self.give_up(xml, report),
        }
    }

    /// Leaves out the rest of the plant, for which the file is refused anyhow.
    fn give_up(&mut self, xml: &mut Xml<'_>, report: &mut Report) {
        xml.skip(report);
    }

    /// The scale that an element states, else that of its neighbours.
    fn scale(&self, way: Way, element: &Element<'_>, place: (usize, usize), report: &mut Report) -> Option<u32> {
        if let Some(word) = element.attribute("scale") {
            let scale = word.trim().parse().ok();
            if scale.is_none() {
                report.fault(place, format!("`scale` is `{}`", said(word)), "a whole number from 0");
            }
            return scale;
        }
        let Some(around) = self.open.last() else { return Some(1) };
        Some(match way {
            Way::Topology | Way::Decomp => around.scale.saturating_add(1),
            Way::Follow => around.chains.last().map_or(around.scale, |(scale, _)| *scale),
            Way::Branch => around.scale,
        })
    }

    fn class(
        &mut self,
        symbol: &str,
        scale: u32,
        role: Role,
        place: (usize, usize),
        report: &mut Report,
    ) -> Option<u32> {
        if symbol.is_empty() {
            report.fault(place, "an entity has no `class`", "`class=\"Internode\"` or the like");
            return None;
        }
        if let Some(class) = self.class_of.get(&(symbol.to_owned(), scale)) {
            return Some(*class);
        }
        if self.classes.len() == MOST_CLASSES {
            report.fault(place, "there are too many classes", format!("at most {MOST_CLASSES}"));
            return None;
        }
        let class = self.classes.len() as u32;
        self.classes.push(Class { symbol: symbol.to_owned(), scale, role });
        self.class_of.insert((symbol.to_owned(), scale), class);
        Some(class)
    }

    /// Adds an entity to its plant: a new plant where nothing but a scene is around it.
    fn entity(&mut self, way: Way, class: u32, scale: u32, place: (usize, usize), report: &mut Report) -> Option<u32> {
        self.entities += 1;
        let around = self.open.last().and_then(|open| open.entity.map(|entity| (entity, open.scale)));
        let Some((outer, outer_scale)) = around else {
            if matches!(way, Way::Follow | Way::Branch) {
                report.warn(place, "in a scene", format!("`<{}>` stands in a scene: read as a plant", name(way)));
            }
            self.individuals.push(Individual { entities: vec![Entity::of(class)], ..Individual::default() });
            self.levels = vec![0];
            return Some(0);
        };
        let before =
            self.open.last().and_then(|open| open.chains.iter().find(|chain| chain.0 == scale)).map(|chain| chain.1);
        let springs = match way {
            Way::Topology | Way::Decomp => None,
            Way::Branch => Some((outer, Link::Branches)),
            Way::Follow => before.or((outer_scale >= scale).then_some(outer)).map(|bearer| (bearer, Link::Follows)),
        };
        if way == Way::Follow && springs.is_none() {
            report.warn(place, "follow", "`<follow>` has nothing of its scale before it: read as a first part");
        }
        let last = self.individuals.len() - 1;
        let plant = &mut self.individuals[last];
        let mut entity = Entity::of(class);
        match springs {
            Some((bearer, link)) => {
                (entity.bearer, entity.link) = (Some(bearer), Some(link));
                entity.complex = whole(plant, &self.classes, bearer, scale);
            }
            None => entity.complex = Some(outer),
        }
        let level = entity.complex.map_or(0, |whole| usize::from(self.levels[whole as usize]) + 1);
        if level > MOST_SCALES {
            report.fault(place, "wholes stand too deep within one another", format!("at most {MOST_SCALES} scales"));
            return None;
        }
        self.levels.push(level as u8);
        plant.entities.push(entity);
        let number = plant.entities.len() as u32 - 1;
        if matches!(way, Way::Decomp | Way::Follow)
            && let Some(open) = self.open.last_mut()
        {
            open.chain(scale, number);
        }
        Some(number)
    }
}

impl Open {
    /// Notes the last entity of a chain; of many scales the one that was met last is kept longest.
    fn chain(&mut self, scale: u32, entity: u32) {
        self.chains.retain(|chain| chain.0 != scale);
        if self.chains.len() == MOST_CHAINS {
            self.chains.remove(0);
        }
        self.chains.push((scale, entity));
    }
}

/// The whole that what springs from a bearer is a part of: that of the bearer, of a coarser scale than its own.
pub(super) fn whole(plant: &Individual, classes: &[Class], bearer: u32, scale: u32) -> Option<u32> {
    let scale_of = |entity: u32| classes[plant.entities[entity as usize].class as usize].scale;
    let mut at = plant.entities[bearer as usize].complex;
    while let Some(entity) = at.filter(|entity| scale_of(*entity) >= scale) {
        at = plant.entities[entity as usize].complex;
    }
    at
}

fn name(way: Way) -> &'static str {
    match way {
        Way::Topology => "topology",
        Way::Decomp => "decomp",
        Way::Follow => "follow",
        Way::Branch => "branch",
    }
}
