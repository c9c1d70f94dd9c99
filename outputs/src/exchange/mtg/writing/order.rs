//! The order in which the entities of a plant are written, and the column of each.
//!
//! What an entity bears stands one column to its right, below it; its parts and then what follows it go on in its own
//! column. Since `^` goes on from the last entity of the column, a second follower stands to the right as well. So an
//! axis of any length takes one column, and columns count branchings. Nothing recurses.

use crate::exchange::description::{Individual, Link};

/// How an entity is tied to what stands before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tie {
    /// It begins the plant.
    Root,
    /// It goes on in the column of the entity above (`^`).
    Above(char),
    /// It stands to the right of what it springs from.
    Left(char),
}

/// An entity in its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line {
    pub entity: u32,
    pub column: usize,
    pub tie: Tie,
}

/// What stands below each entity, as chains in the order of the plant.
struct Below {
    first: Vec<u32>,
    next: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Below {
    fn of(individual: &Individual) -> Self {
        let count = individual.entities.len();
        let (mut first, mut next) = (vec![NONE; count], vec![NONE; count]);
        for (place, entity) in individual.entities.iter().enumerate().rev() {
            if let Some(above) = entity.bearer.or(entity.complex) {
                next[place] = first[above as usize];
                first[above as usize] = place as u32;
            }
        }
        Self { first, next }
    }

    fn each(&self, entity: u32) -> impl Iterator<Item = u32> {
        let mut at = self.first[entity as usize];
        std::iter::from_fn(move || {
            let found = (at != NONE).then_some(at)?;
            at = self.next[found as usize];
            Some(found)
        })
    }
}

/// Calls `line` for each entity of a plant, in the order of the file.
///
/// # Errors
/// Those of `line`.
pub fn each<E>(individual: &Individual, mut line: impl FnMut(Line) -> Result<(), E>) -> Result<(), E> {
    let below = Below::of(individual);
    let is_root = |place: &u32| {
        let entity = &individual.entities[*place as usize];
        entity.bearer.or(entity.complex).is_none()
    };
    let roots = (0..individual.entities.len() as u32).filter(is_root);
    let mut waiting: Vec<Line> = roots.map(|entity| Line { entity, column: 0, tie: Tie::Root }).collect();
    waiting.reverse();
    let mut found = Vec::new();
    while let Some(now) = waiting.pop() {
        line(now)?;
        let (mut parts, mut follower) = (Vec::new(), None);
        found.clear();
        for entity in below.each(now.entity) {
            let known = &individual.entities[entity as usize];
            let right = |sign| Line { entity, column: now.column + 1, tie: Tie::Left(sign) };
            match (known.bearer.and(known.link), follower) {
                (None, _) => parts.push(Line { entity, column: now.column, tie: Tie::Above('/') }),
                (Some(Link::Follows), None) => {
                    follower = Some(Line { entity, column: now.column, tie: Tie::Above('<') });
                }
                (Some(Link::Follows), Some(_)) => found.push(right('<')),
                (Some(Link::Branches), _) => found.push(right('+')),
            }
        }
        waiting.extend(follower);
        waiting.extend(parts.into_iter().rev());
        waiting.extend(found.drain(..).rev());
    }
    Ok(())
}

/// The number of columns of a plant.
pub fn width(individual: &Individual) -> usize {
    // A column is that of what an entity springs from, which stands before it.
    let mut columns = vec![0_usize; individual.entities.len()];
    let mut followed = vec![false; individual.entities.len()];
    let mut most = 0;
    for (place, entity) in individual.entities.iter().enumerate() {
        let Some(above) = entity.bearer.or(entity.complex) else { continue };
        let above = above as usize;
        let goes_on = match (entity.bearer.and(entity.link), followed[above]) {
            (None, _) => true,
            (Some(Link::Follows), false) => {
                followed[above] = true;
                true
            }
            _ => false,
        };
        columns[place] = columns[above] + usize::from(!goes_on);
        most = most.max(columns[place]);
    }
    most + 1
}
