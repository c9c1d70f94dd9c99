//! The tree of a file of cylinders: axes by their numbers, and cylinders that follow or branch.
//!
//! A cylinder goes on from its parent where both have the same axis; else it begins an axis, which branches from the
//! parent. Parents may stand behind their children in the file. Nothing recurses. Absent: columns and their names.

use super::super::description::{
    Class, Description, Entity, Feature, FeatureType, Individual, Link, Observation, Role, Value,
};
use super::super::report::Report;

const NONE: u32 = u32::MAX;

/// A cylinder of a file.
#[derive(Debug, Clone)]
pub(super) struct Cylinder {
    /// The line that it stands in.
    pub line: usize,
    /// The place of its parent among the cylinders; none for what begins the tree.
    pub parent: Option<u32>,
    /// The number of its axis.
    pub axis: i64,
    /// The order of its axis, where the file tells it.
    pub order: Option<i64>,
    /// Where it begins, m.
    pub start: [f64; 3],
    /// Its direction; none where it has none.
    pub direction: Option<[f64; 3]>,
    /// Its length, m.
    pub length: f64,
    /// Its radius, m.
    pub radius: f64,
    /// Values of the features of the file, in their order.
    pub values: Vec<f64>,
}

/// The cylinders of a file, and the features that it has of each.
#[derive(Debug, Default)]
pub(super) struct Cylinders {
    /// The cylinders.
    pub all: Vec<Cylinder>,
    /// The names of the features.
    pub features: Vec<&'static str>,
}

/// The plant of these cylinders, in time of their number.
pub(super) fn described(cylinders: Cylinders, report: &mut Report) -> Description {
    let Some(order) = parents_first(&cylinders.all, report) else { return Description::default() };
    let mut tree = Tree::of(&cylinders.all);
    for place in order {
        tree.add(&cylinders.all, place, report);
    }
    let class = |symbol: &str, scale, role| Class { symbol: symbol.to_owned(), scale, role };
    let feature = |name: &&str| Feature { name: (*name).to_owned(), kind: FeatureType::Real };
    Description {
        individuals: vec![Individual { entities: tree.entities, ..Individual::default() }],
        classes: vec![class("P", 1, Role::Plant), class("A", 2, Role::Axis), class("I", 3, Role::Internode)],
        features: cylinders.features.iter().map(feature).collect(),
        ..Description::default()
    }
}

/// The cylinders in an order in which parents stand first: that of the file where it is one. Told and none where
/// parents go round in a circle.
fn parents_first(all: &[Cylinder], report: &mut Report) -> Option<Vec<u32>> {
    let parents = all.iter().map(|cylinder| cylinder.parent);
    if parents.clone().enumerate().all(|(place, parent)| parent.is_none_or(|parent| (parent as usize) < place)) {
        return Some((0..all.len() as u32).collect());
    }
    // The children of each cylinder, from the first to the last.
    let (mut first, mut next) = (vec![NONE; all.len()], vec![NONE; all.len()]);
    for (place, parent) in parents.clone().enumerate().rev() {
        let Some(parent) = parent else { continue };
        next[place] = std::mem::replace(&mut first[parent as usize], place as u32);
    }
    let roots = parents.enumerate().filter(|(_, parent)| parent.is_none()).map(|(place, _)| place as u32);
    let mut stack: Vec<u32> = roots.collect();
    stack.reverse();
    let mut found = Vec::with_capacity(all.len());
    let mut is_met = vec![false; all.len()];
    while let Some(place) = stack.pop() {
        is_met[place as usize] = true;
        found.push(place);
        let start = stack.len();
        let mut child = first[place as usize];
        while child != NONE {
            stack.push(child);
            child = next[child as usize];
        }
        stack[start..].reverse();
    }
    if let Some(place) = is_met.iter().position(|met| !met) {
        let line = all[place].line;
        report.fault(
            (line, 0),
            "the parents of a cylinder go round in a circle",
            "a way from each cylinder to the base",
        );
        return None;
    }
    Some(found)
}

/// The entities of a tree, in the making.
struct Tree {
    entities: Vec<Entity>,
    /// The entity of each cylinder, and that of its axis.
    entity_of: Vec<u32>,
    axis_of: Vec<u32>,
    /// Whether something goes on from the cylinder along its axis.
    is_continued: Vec<bool>,
    /// The number of cylinders of each axis so far, and its order, by entity.
    ranks: Vec<u32>,
    orders: Vec<u32>,
    /// The order of the trunk in the file.
    trunk: Option<i64>,
    /// Which axes have begun.
    begun: std::collections::BTreeSet<i64>,
    /// Axes among the entities that their bearers bear, by bearer.
    borne: Vec<u32>,
}

impl Tree {
    fn of(all: &[Cylinder]) -> Self {
        let each = || vec![NONE; all.len()];
        Self {
            entities: vec![Entity::of(0)],
            entity_of: each(),
            axis_of: each(),
            is_continued: vec![false; all.len()],
            ranks: vec![0],
            orders: vec![0],
            trunk: None,
            begun: std::collections::BTreeSet::new(),
            borne: vec![0],
        }
    }

    fn push(&mut self, entity: Entity, order: u32) -> u32 {
        self.entities.push(entity);
        self.ranks.push(0);
        self.orders.push(order);
        self.borne.push(0);
        self.entities.len() as u32 - 1
    }

    fn add(&mut self, all: &[Cylinder], place: u32, report: &mut Report) {
        let cylinder = &all[place as usize];
        let parent = cylinder.parent.map(|parent| parent as usize);
        let goes_on = parent.filter(|parent| all[*parent].axis == cylinder.axis && !self.is_continued[*parent]);
        let axis = match goes_on {
            Some(parent) => self.axis_of[parent],
            None => self.begin(cylinder, parent, report),
        };
        let mut entity = Entity::of(2);
        if let Some(parent) = goes_on {
            self.is_continued[parent] = true;
            (entity.bearer, entity.link) = (Some(self.entity_of[parent]), Some(Link::Follows));
        }
        entity.complex = Some(axis);
        self.ranks[axis as usize] += 1;
        entity.index = Some(f64::from(self.ranks[axis as usize]));
        entity.observations = vec![seen(cylinder)];
        let order = self.orders[axis as usize];
        self.check_order(cylinder, order, report);
        self.axis_of[place as usize] = axis;
        self.entity_of[place as usize] = self.push(entity, order);
    }

    /// Begins an axis.
    fn begin(&mut self, cylinder: &Cylinder, parent: Option<usize>, report: &mut Report) -> u32 {
        let mut axis = Entity::of(1);
        axis.complex = Some(0);
        let mut order = 0;
        let bearer = parent.map_or(0, |parent| self.entity_of[parent]);
        if let Some(parent) = parent {
            (axis.bearer, axis.link) = (Some(bearer), Some(Link::Branches));
            order = self.orders[self.axis_of[parent] as usize] + 1;
        } else if self.entities.len() > 1 {
            let text = "the cylinder has no parent, as the base of the tree has none: read as an axis that springs from nothing";
            report.warn((cylinder.line, 0), "", text);
        }
        if !self.begun.insert(cylinder.axis) {
            let text = "the axis of the cylinder is begun already, and its parent does not lead to it: read as an axis of its own";
            report.warn((cylinder.line, 0), "", text);
        }
        self.borne[bearer as usize] += 1;
        axis.index = Some(f64::from(self.borne[bearer as usize]));
        self.push(axis, order)
    }

    /// Warns where the file counts orders otherwise than its parents do.
    fn check_order(&mut self, cylinder: &Cylinder, order: u32, report: &mut Report) {
        let Some(stated) = cylinder.order else { return };
        let trunk = *self.trunk.get_or_insert(stated.saturating_sub(i64::from(order)));
        if stated.saturating_sub(trunk) != i64::from(order) {
            let text = format!(
                "the order {stated} is {} by the parents: the parents count",
                trunk.saturating_add(i64::from(order))
            );
            report.warn((cylinder.line, 0), "order", text);
        }
    }
}

fn seen(cylinder: &Cylinder) -> Observation {
    let values = cylinder.values.iter().enumerate().map(|(k, value)| (k as u32, Value::Real(*value)));
    Observation {
        length: Some(cylinder.length),
        base_diameter: Some(2.0 * cylinder.radius),
        tip_diameter: Some(2.0 * cylinder.radius),
        place: Some(cylinder.start),
        direction: cylinder.direction,
        values: values.collect(),
        ..Observation::default()
    }
}
