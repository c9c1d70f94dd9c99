//! Material slots of a mesh: a material for each class of components, for each order of axes where that is asked for,
//! and for each texture of a species.
//!
//! A slot of a vertex follows from its component: its class, and the order of the axis that it is, or that bears it.
//! Vertices of a mesh stand plant after plant, so slots are asked for in the order of the vertices. Where nothing but
//! classes matters nothing is kept. Absent: what a material looks like, which is each format's.

use super::chunk::{Tag, Vertex};
use super::texture::{Texture, Textures};
use super::{MeshOptions, OwnForms};
use phytomer_sim::plant::{Class, Kind, Plant};
use std::sync::Arc;

/// The classes of components, by their names: each has a material of its own at least.
pub const CLASSES: [&str; 5] = ["wood", "leaves", "flowers", "fruits", "obstacles"];
/// The place of the class of obstacles.
const OBSTACLES: usize = 4;

/// The class of a vertex, as a place among [`CLASSES`].
#[inline]
pub fn class_of(tag: &Tag) -> usize {
    if tag.component < 0 {
        return OBSTACLES;
    }
    Kind::ALL.get(usize::from(tag.kind)).map_or(0, |kind| class_of_kind(*kind))
}

/// The class of a kind of components, as a place among [`CLASSES`].
#[inline]
pub fn class_of_kind(kind: Kind) -> usize {
    match kind.class() {
        Class::Leaf => 1,
        Class::Flower => 2,
        Class::Fruit => 3,
        _ => 0,
    }
}

/// The part of a plant that a class is, as textures state it.
fn part_of(class: usize) -> Class {
    [Class::Internode, Class::Leaf, Class::Flower, Class::Fruit][class.min(OBSTACLES - 1)]
}

/// How many materials a mesh has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Slotting {
    /// One for each class of components.
    #[default]
    Kind,
    /// One for each class and each order of axes.
    Order,
}

/// A material slot.
#[derive(Debug, Clone, PartialEq)]
pub struct Slot {
    /// The class, as a place among [`CLASSES`].
    pub class: usize,
    /// Its name, of letters, digits and underscores: `wood`, `wood_1`.
    pub name: String,
    /// What covers it.
    pub texture: Option<Arc<Texture>>,
}

/// The material slots of a mesh.
#[derive(Debug, Clone)]
pub struct Slots {
    list: Vec<Slot>,
    bodies: Vec<Body>,
}

/// The slots of the vertices of a plant.
#[derive(Debug, Clone)]
struct Body {
    /// One past its last vertex.
    end: u64,
    /// The order of each component.
    orders: Arc<[u8]>,
    /// The slot of each class and order, from 0.
    slots: Arc<[Vec<u16>; OBSTACLES]>,
}

/// What tells one slot from another: the class, the order where it counts, and the texture with its species.
#[derive(Debug, Clone, PartialEq)]
struct Key {
    class: usize,
    order: Option<u8>,
    texture: Option<(String, Arc<Texture>)>,
}

impl Default for Slots {
    fn default() -> Self {
        let slot = |class: usize| Slot { class, name: CLASSES[class].to_owned(), texture: None };
        Self { list: (0..CLASSES.len()).map(slot).collect(), bodies: Vec::new() }
    }
}

impl Slots {
    /// The slots of plants that stand in a mesh one after another, each with the number of its vertices.
    pub fn of<'a>(plants: impl IntoIterator<Item = (&'a Plant, &'a MeshOptions, u64)>) -> Self {
        let plants: Vec<_> = plants.into_iter().collect();
        if plants.iter().all(|(_, options, _)| is_plain(options)) {
            return Self::default();
        }
        let mut keys: Vec<Key> = Vec::new();
        let mut known: Vec<(*const Plant, Body)> = Vec::new();
        let (mut bodies, mut end) = (Vec::new(), 0);
        for (plant, options, vertices) in plants {
            end += vertices;
            if let Some((_, same)) = known.iter().find(|(of, _)| std::ptr::eq(*of, plant)) {
                bodies.push(Body { end, ..same.clone() });
                continue;
            }
            let last = plant.axes.order.iter().copied().max().unwrap_or(1);
            let slots = Arc::new(slots_of(last, options, &mut keys));
            let body = Body { end, orders: orders_of(plant).into(), slots };
            known.push((std::ptr::from_ref(plant), body.clone()));
            bodies.push(body);
        }
        Self::sorted(keys, bodies)
    }

    /// The slots of plants of which each component has an order, for [`Slots::of_component`].
    pub fn of_orders<'a>(plants: impl IntoIterator<Item = (Vec<u8>, &'a MeshOptions)>) -> Self {
        let plants: Vec<_> = plants.into_iter().collect();
        if plants.iter().all(|(_, options)| is_plain(options)) {
            return Self::default();
        }
        let mut keys: Vec<Key> = Vec::new();
        let body = |(orders, options): (Vec<u8>, &MeshOptions)| {
            let last = orders.iter().copied().max().unwrap_or(1);
            Body { end: 0, orders: orders.into(), slots: Arc::new(slots_of(last, options, &mut keys)) }
        };
        let bodies = plants.into_iter().map(body).collect();
        Self::sorted(keys, bodies)
    }

    fn sorted(keys: Vec<Key>, mut bodies: Vec<Body>) -> Self {
        let (list, places) = sorted(keys);
        for body in &mut bodies {
            let moved = |slot: &u16| places[usize::from(*slot)];
            body.slots = Arc::new(std::array::from_fn(|class| body.slots[class].iter().map(moved).collect()));
        }
        Self { list, bodies }
    }

    /// Whether there is a slot for each class, without a texture.
    pub fn is_plain(&self) -> bool {
        self.bodies.is_empty()
    }

    /// The slots in their order, whether they have vertices or not.
    pub fn list(&self) -> &[Slot] {
        &self.list
    }

    /// The slot of an organ of a plant that stands at a place among the plants of the mesh.
    pub fn of_component(&self, body: usize, component: u32, class: usize) -> usize {
        self.bodies.get(body).map_or(class, |body| body.slot(component as usize, class))
    }

    /// The slots of all vertices, one after another.
    pub fn in_turn(&self) -> InTurn<'_> {
        InTurn { slots: self, body: 0, vertex: 0 }
    }
}

impl Body {
    fn slot(&self, component: usize, class: usize) -> usize {
        let order = self.orders.get(component).copied().unwrap_or(1);
        let slots = &self.slots[class.min(OBSTACLES - 1)];
        slots.get(usize::from(order)).or(slots.last()).copied().map_or(0, usize::from)
    }
}

/// The slots of the vertices of a mesh, in their order.
pub struct InTurn<'s> {
    slots: &'s Slots,
    body: usize,
    vertex: u64,
}

impl InTurn<'_> {
    /// The slot of the next vertex.
    #[inline]
    pub fn next(&mut self, vertex: &Vertex) -> usize {
        let tag = vertex.tag();
        let class = class_of(&tag);
        if self.slots.is_plain() {
            return class;
        }
        while self.slots.bodies.get(self.body).is_some_and(|body| body.end <= self.vertex) {
            self.body += 1;
        }
        self.vertex += 1;
        match self.slots.bodies.get(self.body).filter(|_| class != OBSTACLES) {
            Some(body) => body.slot(tag.component as usize, class),
            None => self.slots.list.len() - 1,
        }
    }
}

/// The order of each component of a plant.
fn orders_of(plant: &Plant) -> Vec<u8> {
    let mut orders = vec![1; plant.components() as usize];
    let order = |node: usize| plant.axes.order[plant.nodes.axis[node].index()];
    for (node, component) in plant.nodes.component.iter().enumerate() {
        orders[*component as usize] = order(node);
    }
    for (organ, component) in plant.organs.component.iter().enumerate() {
        orders[*component as usize] = order(plant.organs.node[organ].index());
    }
    orders
}

/// Whether a plant has a slot for each class alone, without a texture.
fn is_plain(options: &MeshOptions) -> bool {
    options.slotting == Slotting::Kind && options.own.textures().list.is_empty()
}

/// The slots of the classes and orders of a plant, as places among keys, which are added where they are new.
fn slots_of(last: u8, options: &MeshOptions, keys: &mut Vec<Key>) -> [Vec<u16>; OBSTACLES] {
    std::array::from_fn(|class| {
        let slot = |order: u8| {
            let key = key_of(options.own.as_ref(), options.slotting, class, order);
            let place = keys.iter().position(|known| *known == key).unwrap_or_else(|| {
                keys.push(key);
                keys.len() - 1
            });
            u16::try_from(place).unwrap_or(u16::MAX)
        };
        (0..=last).map(slot).collect()
    })
}

fn key_of(own: &OwnForms, slotting: Slotting, class: usize, order: u8) -> Key {
    let Textures { species, list } = own.textures();
    let texture = own.textures().find(part_of(class), order.max(1)).map(|place| Arc::clone(&list[place]));
    let by_order = slotting == Slotting::Order || texture.as_ref().is_some_and(|texture| texture.order.is_some());
    let texture = texture.map(|texture| (species.clone(), texture));
    Key { class, order: by_order.then_some(order.max(1)), texture }
}

/// The slots of keys by class, order and texture, with that of obstacles as the last, and the new place of each.
fn sorted(keys: Vec<Key>) -> (Vec<Slot>, Vec<u16>) {
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by_key(|place| (keys[*place].class, keys[*place].order, *place));
    let (mut list, mut places): (Vec<Slot>, _) = (Vec::new(), vec![0; keys.len()]);
    for place in order {
        let Key { class, order, texture } = &keys[place];
        let number = order.map(|order| format!("_{order}")).unwrap_or_default();
        let alike = |other: &Key| (other.class, other.order) == (*class, *order);
        let species = texture.as_ref().filter(|_| keys.iter().filter(|key| alike(key)).count() > 1);
        let species = species.map(|(species, _)| format!("{}_", word_of(species))).unwrap_or_default();
        let plain = format!("{species}{}{number}", CLASSES[*class]);
        let taken = |name: &str| list.iter().any(|slot| slot.name == name);
        let numbered = (2..).map(|k| format!("{plain}_{k}"));
        let name = [plain.clone()].into_iter().chain(numbered).find(|name| !taken(name)).unwrap_or(plain);
        places[place] = list.len() as u16;
        list.push(Slot { class: *class, name, texture: texture.as_ref().map(|(_, texture)| Arc::clone(texture)) });
    }
    list.push(Slot { class: OBSTACLES, name: CLASSES[OBSTACLES].to_owned(), texture: None });
    (list, places)
}

/// A name of letters, digits and underscores that begins with a letter.
fn word_of(name: &str) -> String {
    let word: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if word.starts_with(|c: char| c.is_ascii_alphabetic()) { word } else { format!("s_{word}") }
}
