//! How many branches, axes and leaves a tree has, by growth level and order, before it grows.
//!
//! Of m mothers each bears one child that continues its axis, and its other children begin axes of the next order: one
//! more where branches are two, two more where they are three. So the branches of level n by order are the binomial
//! C(n, k) or the trinomial C(n, k) 2ᵏ, and a tree of GMT3 has (3ⁿ⁺¹ − 1)/2 branches. What cuts leave is the main axis
//! with the lateral branches that it bears, each a tree of its own up to its last level. Absent: branches that
//! deviators move to nothing, which no closed form knows (`plan`).

/// What a tree adds at one growth level: branches, and the axes among them that begin, by order from 1.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Added {
    pub branches: Vec<u64>,
    pub axes: Vec<u64>,
}

/// What the counts follow from.
pub(super) struct Outline<'a> {
    /// How many children a branch bears at each level, from level 1.
    pub children: &'a [u32],
    /// The last growth level of the main axis.
    pub main_until: u32,
    /// For each level, from 1, the last that grows on the lateral branches that leave the main axis there.
    pub reach: &'a [u32],
}

/// What the tree adds at each level, from level 0. Numbers saturate.
pub(super) fn added(outline: &Outline<'_>) -> Vec<Added> {
    let levels = outline.children.len();
    let mut all = vec![Added { branches: vec![0; levels + 1], axes: vec![0; levels + 1] }; levels + 1];
    all[0].branches[0] = 1;
    for level in 1..=levels {
        let (last, sideways) = (level as u32, u64::from(outline.children[level - 1]) - 1);
        if last <= outline.main_until {
            all[level].branches[0] += 1;
        }
        // The mother stands on the main axis, one level below.
        let reach = outline.reach[level - 1].min(levels as u32);
        if last <= outline.main_until.saturating_add(1) && last <= reach {
            lateral(outline, level, reach as usize, sideways, &mut all);
        }
    }
    all
}

/// Adds `number` lateral branches that leave the main axis at `first`, with all that they bear up to `reach`.
fn lateral(outline: &Outline<'_>, first: usize, reach: usize, number: u64, all: &mut [Added]) {
    let orders = all.len();
    let mut branches = vec![0_u64; orders];
    branches[1] = number;
    let mut begun = branches.clone();
    for (level, added) in all.iter_mut().enumerate().take(reach + 1).skip(first) {
        if level > first {
            let sideways = u64::from(outline.children[level - 1]) - 1;
            begun = (0..orders).map(|k| if k > 0 { branches[k - 1].saturating_mul(sideways) } else { 0 }).collect();
            for (branches, begun) in branches.iter_mut().zip(&begun) {
                *branches = branches.saturating_add(*begun);
            }
        }
        for order in 0..orders {
            added.branches[order] = added.branches[order].saturating_add(branches[order]);
            added.axes[order] = added.axes[order].saturating_add(begun[order]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(children: &[u32]) -> Vec<Added> {
        let levels = children.len() as u32;
        added(&Outline { children, main_until: levels, reach: &vec![levels; children.len()] })
    }

    fn sum(numbers: &[u64]) -> u64 {
        numbers.iter().sum()
    }

    #[test]
    fn two_children_have_powers_of_two_and_three_children_of_three() {
        for levels in 0..=18_u32 {
            let all = whole(&vec![2; levels as usize]);
            assert_eq!(all.iter().map(|added| sum(&added.branches)).sum::<u64>(), (1 << (levels + 1)) - 1);
            let all = whole(&vec![3; levels as usize]);
            assert_eq!(all.iter().map(|added| sum(&added.branches)).sum::<u64>(), (3_u64.pow(levels + 1) - 1) / 2);
            assert_eq!(sum(&all[levels as usize].branches), 3_u64.pow(levels));
            // An axis for each tip.
            assert_eq!(1 + all.iter().map(|added| sum(&added.axes)).sum::<u64>(), 3_u64.pow(levels));
        }
    }

    #[test]
    fn orders_are_binomial() {
        let all = whole(&[2; 5]);
        assert_eq!(all[5].branches, [1, 5, 10, 10, 5, 1]);
        let all = whole(&[3; 3]);
        assert_eq!(all[3].branches, [1, 6, 12, 8]);
    }

    #[test]
    fn a_cut_takes_what_stands_on_it() {
        let children = [2; 4];
        let free = Outline { children: &children, main_until: 4, reach: &[4; 4] };
        let all = |outline: &Outline<'_>| added(outline).iter().map(|added| sum(&added.branches)).sum::<u64>();
        assert_eq!(all(&free), 31);
        // The main axis ends below level 3: a branch of each of the levels 3 and 4, and the lateral of level 4.
        assert_eq!(all(&Outline { main_until: 2, ..free }), 31 - 3);
        // The lateral branch of level 2 is a tree of 1 + 2 + 4 branches.
        assert_eq!(all(&Outline { reach: &[4, 1, 4, 4], ..free }), 31 - 7);
        assert_eq!(all(&Outline { reach: &[4, 3, 4, 4], ..free }), 31 - 4);
        assert_eq!(all(&Outline { main_until: 0, reach: &[0; 4], ..free }), 1);
    }
}
