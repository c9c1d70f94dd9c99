//! Which child of a branching is the left, the right and the centre one, and the ranks of branches on their axes.
//!
//! Of each branching the order of children is taken that is nearest to what is expected. In a binary tree the left
//! child continues the axis of its mother here, in a ternary one the centre child; whether the left one is to be
//! called the right one is settled at the end (`estimate`). Absent: what is expected (`rule`).

use super::fork::{Children, Shape, Vector, shape};
use super::rule::{Rule, Stand};
use super::skeleton::Skeleton;

/// A branching of two or three children.
#[derive(Debug, Clone, PartialEq)]
pub struct Fork {
    pub mother: usize,
    /// The growth level of the children.
    pub level: u32,
    children: Vec<usize>,
}

/// The branchings that a fit takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Forks<'a> {
    pub skeleton: &'a Skeleton,
    /// Those of lower levels first.
    pub all: Vec<Fork>,
    /// The place of the branching of each branch.
    pub of_branch: Vec<Option<usize>>,
    /// Branchings with another number of children.
    pub others: usize,
    /// The number of children of those that are taken.
    pub number: usize,
}

/// The children of each branching in their order, and the rank of each branch.
#[derive(Debug, Clone, PartialEq)]
pub struct Labels {
    pub children: Vec<Option<Children<usize>>>,
    pub ranks: Vec<u32>,
}

/// The orders of two and of three children: left, right, centre.
const TWO: [[usize; 2]; 2] = [[0, 1], [1, 0]];
const THREE: [[usize; 3]; 6] = [[0, 1, 2], [1, 0, 2], [0, 2, 1], [2, 0, 1], [1, 2, 0], [2, 1, 0]];

impl<'a> Forks<'a> {
    /// The branchings with so many children, or with the number of most of them.
    pub fn of(skeleton: &'a Skeleton, number: Option<usize>) -> Self {
        let count = |n: usize| skeleton.branches.iter().filter(|branch| branch.children.len() == n).count();
        let number = number.unwrap_or(if count(3) > count(2) { 3 } else { 2 });
        let (mut all, mut of_branch) = (Vec::new(), vec![None; skeleton.branches.len()]);
        let mut others = 0;
        for (mother, branch) in skeleton.branches.iter().enumerate().filter(|(_, branch)| !branch.children.is_empty()) {
            if branch.children.len() == number {
                of_branch[mother] = Some(all.len());
                all.push(Fork { mother, level: branch.level + 1, children: branch.children.clone() });
            } else {
                others += 1;
            }
        }
        Self { skeleton, all, of_branch, others, number }
    }

    /// How many branchings have children of at most this level.
    pub fn below(&self, level: u32) -> usize {
        self.all.partition_point(|fork| fork.level <= level)
    }

    /// The shape of a branching whose children are moved by a deviation.
    pub fn shape(&self, fork: &Fork, children: Children<usize>, deviation: Vector) -> Option<Shape> {
        let vector = |place: usize| self.skeleton.branches[place].vector;
        let unmoved = |place: usize| {
            let [x, y, z] = vector(place);
            [x - deviation[0], y - deviation[1], z - deviation[2]]
        };
        shape(vector(fork.mother), children.map(unmoved))
    }

    /// The orders of children of the first so many branchings that are nearest to a rule.
    pub fn labels(&self, rule: &Rule, first: usize) -> Labels {
        let mut labels = Labels { children: vec![None; first], ranks: vec![1; self.skeleton.branches.len()] };
        for (place, fork) in self.all[..first].iter().enumerate() {
            let stand = Stand { level: fork.level, rank: labels.ranks[fork.mother] };
            let mut best: Option<(f64, Children<usize>)> = None;
            for children in fork.orders() {
                let Some(shape) = self.shape(fork, children, rule.deviation) else { continue };
                let distance = rule.distance(&shape, stand);
                if best.is_none_or(|(least, _)| distance < least) {
                    best = Some((distance, children));
                }
            }
            labels.children[place] = best.map(|(_, children)| children);
            if let Some((_, children)) = best {
                labels.ranks[children.centre.unwrap_or(children.left)] = stand.rank + 1;
            }
        }
        labels
    }

    /// Where a branching stands.
    pub fn stand(&self, place: usize, labels: &Labels) -> Stand {
        let fork = &self.all[place];
        Stand { level: fork.level, rank: labels.ranks[fork.mother] }
    }
}

impl Fork {
    fn orders(&self) -> impl Iterator<Item = Children<usize>> + '_ {
        let two = (self.children.len() == 2).then_some(TWO).into_iter().flatten();
        let three = (self.children.len() == 3).then_some(THREE).into_iter().flatten();
        let of = |places: &[usize]| Children {
            left: self.children[places[0]],
            right: self.children[places[1]],
            centre: places.get(2).map(|place| self.children[*place]),
        };
        two.map(move |places| of(&places)).chain(three.map(move |places| of(&places)))
    }
}
