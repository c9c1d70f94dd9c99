//! The order in which the entities of a plant stand in an OPF file, and in which element.
//!
//! Parts and what springs from an entity stand in its element; what goes on from an entity stands beside it, as often
//! as the file then reads the same. First in an element comes what goes on from it and cannot stand beside it, then
//! its parts, each with all that goes on from it, then its branches. An entity without a way to say where it belongs
//! stands in its whole.

use super::super::description::{Class, Individual, Link};
use super::topology::whole;

const NONE: u32 = u32::MAX;

/// How an entity stands in its element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// As a part.
    Decomp,
    /// It goes on from the entity before it, or from the one around it.
    Follow,
    /// It springs from the entity around it.
    Branch,
}

/// The order of a plant.
#[derive(Debug)]
pub(super) struct Order {
    /// How each entity stands.
    pub ways: Vec<Way>,
    /// The entity in the element of which it stands; of the first entity none.
    pub around: Vec<u32>,
    /// What goes on from it beside it.
    beside: Vec<u32>,
    /// What goes on from it within it.
    within: Vec<u32>,
    /// The first part and the first branch in it, and the next one in the same element.
    part: Vec<u32>,
    branch: Vec<u32>,
    next: Vec<u32>,
    /// How many entities the format cannot put where they belong.
    pub misplaced: u64,
}

/// What comes next in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// The element of an entity begins.
    Begin(u32),
    /// It ends.
    End(u32),
}

impl Order {
    /// The order of a plant, in time of its entities.
    pub fn of(plant: &Individual, classes: &[Class]) -> Self {
        let entities = plant.entities.len();
        let all = |fill| vec![fill; entities];
        let mut order = Self {
            ways: vec![Way::Decomp; entities],
            around: all(NONE),
            beside: all(NONE),
            within: all(NONE),
            part: all(NONE),
            branch: all(NONE),
            next: all(NONE),
            misplaced: 0,
        };
        // The last that goes on from each entity may stand beside it, any other cannot.
        let mut last = all(NONE);
        for number in 0..entities as u32 {
            if let Some((bearer, Link::Follows)) = springs(plant, classes, number) {
                last[bearer as usize] = number;
            }
        }
        for number in 1..entities as u32 {
            order.settle(plant, classes, &last, number);
        }
        order.link();
        order
    }

    fn settle(&mut self, plant: &Individual, classes: &[Class], last: &[u32], number: u32) {
        let at = number as usize;
        let entity = &plant.entities[at];
        let own = scale(plant, classes, number);
        let from =
            springs(plant, classes, number).filter(|(bearer, _)| whole(plant, classes, *bearer, own) == entity.complex);
        let (around, way) = match from {
            Some((bearer, Link::Follows)) if scale(plant, classes, bearer) == own => {
                let before = bearer as usize;
                let is_in_row = bearer != 0 && self.ways[before] != Way::Branch;
                if is_in_row && last[before] == number {
                    self.beside[before] = number;
                    (self.around[before], Way::Follow)
                } else if self.within[before] == NONE {
                    self.within[before] = number;
                    (bearer, Way::Follow)
                } else {
                    self.misplaced += 1;
                    (bearer, Way::Branch)
                }
            }
            Some((bearer, link)) => {
                self.misplaced += u64::from(link == Link::Follows);
                (bearer, Way::Branch)
            }
            None => {
                self.misplaced += u64::from(entity.bearer.is_some() || entity.complex.is_none());
                (entity.complex.unwrap_or_default(), Way::Decomp)
            }
        };
        (self.around[at], self.ways[at]) = (around, way);
    }

    /// Makes the lists of parts and of branches, whose first are found in the end.
    fn link(&mut self) {
        for number in (1..self.ways.len()).rev() {
            let around = self.around[number] as usize;
            let first = match self.ways[number] {
                Way::Decomp => &mut self.part[around],
                Way::Branch => &mut self.branch[around],
                Way::Follow => continue,
            };
            self.next[number] = *first;
            *first = number as u32;
        }
    }

    /// Goes through the elements in the order of the file.
    pub fn each<E>(&self, mut take: impl FnMut(Step) -> Result<(), E>) -> Result<(), E> {
        if self.ways.is_empty() {
            return Ok(());
        }
        let mut stack = vec![Next::Step(Step::Begin(0))];
        while let Some(next) = stack.pop() {
            let step = match next {
                Next::All(first) => {
                    if self.next[first as usize] != NONE {
                        stack.push(Next::All(self.next[first as usize]));
                    }
                    Step::Begin(first)
                }
                Next::Step(step) => step,
            };
            take(step)?;
            match step {
                Step::Begin(number) => {
                    let at = number as usize;
                    stack.push(Next::Step(Step::End(number)));
                    // What comes first is put on last.
                    let lists = [self.branch[at], self.part[at], self.within[at]];
                    stack.extend(lists.into_iter().filter(|first| *first != NONE).map(Next::All));
                }
                Step::End(number) => {
                    let beside = self.beside[number as usize];
                    stack.extend((beside != NONE).then_some(Next::Step(Step::Begin(beside))));
                }
            }
        }
        Ok(())
    }
}

fn scale(plant: &Individual, classes: &[Class], number: u32) -> u32 {
    classes[plant.entities[number as usize].class as usize].scale
}

/// What an entity springs from in the file, and how. What goes on from a part of a whole of its own scale, as a growth
/// unit from the last internode of another, goes on from that whole.
fn springs(plant: &Individual, classes: &[Class], number: u32) -> Option<(u32, Link)> {
    let entity = &plant.entities[number as usize];
    let (bearer, link) = entity.bearer.zip(entity.link)?;
    let own = scale(plant, classes, number);
    if link == Link::Branches || scale(plant, classes, bearer) <= own {
        return Some((bearer, link));
    }
    let like = plant.within(bearer, |known| classes[known.class as usize].scale <= own);
    Some((like.filter(|like| scale(plant, classes, *like) == own).unwrap_or(bearer), link))
}

/// What is to come: a step, or the entities of a list from one on.
enum Next {
    Step(Step),
    All(u32),
}
