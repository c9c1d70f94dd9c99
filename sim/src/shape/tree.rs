//! A bounding tree: of many items with bounds, those whose bounds hold a point, without asking the others.
//!
//! The tree is a list in the order in which it is walked: a node, what lies below it, then what `past` points at. So a
//! walk is one loop without a stack, and its order is the same on every machine. Items are halved by the middles of
//! their bounds along the axis in which these spread widest (Kay & Kajiya 1986, "Ray tracing complex scenes").

use super::Point;
use super::bounds::Bounds;

/// Marks a node that is no leaf.
const NO_ITEM: u32 = u32::MAX;

/// A bounding tree over items that are known by their numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tree {
    nodes: Vec<Node>,
}

/// A node with its bounds.
#[derive(Debug, Clone, PartialEq)]
struct Node {
    bounds: Bounds,
    /// The place of the first node that does not lie below this one.
    past: u32,
    /// The item of a leaf, or [`NO_ITEM`].
    item: u32,
}

/// An item while the tree is made.
#[derive(Debug, Clone, Copy)]
struct Item {
    /// The middle of its bounds.
    middle: Point,
    item: u32,
}

/// The axis along which the middles of items spread widest, the first of equal ones.
fn widest(items: &[Item]) -> usize {
    let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for item in items {
        for axis in 0..3 {
            let middle = item.middle[axis];
            least[axis] = if middle < least[axis] { middle } else { least[axis] };
            most[axis] = if middle > most[axis] { middle } else { most[axis] };
        }
    }
    let spread = |axis: usize| most[axis] - least[axis];
    (1..3).fold(0, |widest, axis| if spread(axis) > spread(widest) { axis } else { widest })
}

/// How a walk goes on from a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Walk {
    /// With what lies below the node.
    Below,
    /// Without it.
    Past,
}

impl Tree {
    /// The tree over items with these bounds.
    pub fn of(bounds: &[Bounds]) -> Self {
        let middle = |bounds: &Bounds| [0, 1, 2].map(|axis| bounds.middle(axis));
        let items = (0..NO_ITEM).zip(bounds).map(|(item, bounds)| Item { middle: middle(bounds), item });
        let mut items: Vec<Item> = items.collect();
        let mut tree = Self { nodes: Vec::with_capacity(2 * items.len()) };
        if !items.is_empty() {
            tree.add(bounds, &mut items);
        }
        tree
    }

    /// Adds the tree over some of the items, and tells its bounds; its depth is the logarithm of their number.
    fn add(&mut self, bounds: &[Bounds], items: &mut [Item]) -> Bounds {
        let place = self.nodes.len();
        self.nodes.push(Node { bounds: Bounds::NOTHING, past: 0, item: NO_ITEM });
        let all = if let [item] = items {
            self.nodes[place].item = item.item;
            bounds[item.item as usize]
        } else {
            let axis = widest(items);
            // Which items are in a half follows from their order, so the tree is that of sorted items.
            let half = items.len() / 2;
            let order = |a: &Item, b: &Item| a.middle[axis].total_cmp(&b.middle[axis]).then(a.item.cmp(&b.item));
            items.select_nth_unstable_by(half, order);
            let (first, second) = items.split_at_mut(half);
            let first = self.add(bounds, first);
            first.with(&self.add(bounds, second))
        };
        (self.nodes[place].bounds, self.nodes[place].past) = (all, self.nodes.len() as u32);
        all
    }

    /// The bounds of all items.
    pub fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::NOTHING, |node| node.bounds)
    }

    /// The number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The number behind the last item below a node, and that of the node's own item where it is a leaf.
    pub fn below(&self, node: usize) -> (usize, Option<usize>) {
        let Node { past, item, .. } = self.nodes[node];
        (past as usize, (item != NO_ITEM).then_some(item as usize))
    }

    /// Whether `test` holds for any item whose bounds hold the point.
    #[inline]
    pub fn any(&self, point: Point, mut test: impl FnMut(usize) -> bool) -> bool {
        let mut place = 0;
        while let Some(node) = self.nodes.get(place) {
            if !node.bounds.holds(point) {
                place = node.past as usize;
                continue;
            }
            if node.item != NO_ITEM && test(node.item as usize) {
                return true;
            }
            place += 1;
        }
        false
    }

    /// An item that is likely to be near a point: that of the leaf to which the nearer bounds lead. `None` without
    /// items.
    pub fn near(&self, point: Point) -> Option<usize> {
        let mut place = 0;
        let mut node = self.nodes.first()?;
        while node.item == NO_ITEM {
            let first = self.nodes.get(place + 1)?;
            let second = self.nodes.get(first.past as usize)?;
            let nearer = first.bounds.square_distance(point) <= second.bounds.square_distance(point);
            place = if nearer { place + 1 } else { first.past as usize };
            node = self.nodes.get(place)?;
        }
        Some(node.item as usize)
    }

    /// Walks over the nodes with their bounds, and tells the items of the leaves that `way` does not pass by.
    pub fn walk(&self, mut way: impl FnMut(usize, &Bounds, Option<usize>) -> Walk) {
        let mut place = 0;
        while let Some(node) = self.nodes.get(place) {
            let item = (node.item != NO_ITEM).then_some(node.item as usize);
            place = match way(place, &node.bounds, item) {
                Walk::Below => place + 1,
                Walk::Past => node.past as usize,
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each item whose bounds hold a point is found, and no other, whatever reaches to infinity.
    #[test]
    fn what_holds_a_point_is_found() {
        let ball = |k: usize| Bounds::of_ball([0.3 * k as f64, (k % 7) as f64, (k % 5) as f64 * 0.5], 0.6);
        let mut bounds: Vec<Bounds> = (0..50).map(ball).collect();
        bounds.push(Bounds { low: [2.0; 3], high: [f64::INFINITY; 3] });
        bounds.push(Bounds::NOTHING);
        let tree = Tree::of(&bounds);
        assert_eq!(tree.len(), 2 * bounds.len() - 1);
        let mut hits = 0;
        for step in 0..1000_usize {
            let point = [(step % 17) as f64, (step % 11) as f64 * 0.7, (step % 13) as f64 * 0.2];
            let mut found = Vec::new();
            assert!(!tree.any(point, |item| {
                found.push(item);
                false
            }));
            found.sort_unstable();
            let expected: Vec<usize> = (0..bounds.len()).filter(|item| bounds[*item].holds(point)).collect();
            assert_eq!(found, expected, "{point:?}");
            hits += found.len();
        }
        assert!(hits > 300, "{hits}");
        assert!(!Tree::of(&[]).any([0.0; 3], |_| true));
        assert_eq!(Tree::of(&[]).bounds(), Bounds::NOTHING);
    }
}
