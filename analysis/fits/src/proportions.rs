//! The ratios of a geometric tree from its height H, the length H0 of its first branch and the reach L of its lowest
//! lateral branch (Aono & Kunii 1984, "Parameter fitting", Fig. 18, Eqs. 1 to 3).
//!
//! The main axis goes straight on and each branch is R1 times its mother, the lateral branches at the first branching
//! R2 times it, and then R1 again. So H = H0 (1 + R1 + … + R1ⁿ) and L = H0 R2 (1 + R1 + … + R1ⁿ⁻¹) at growth level n.
//! The paper lets n grow without end, where R1 = 1 − H0/H and R2 = (L/h) R1 with h = H − H0, which is L/H whatever H0
//! is. A tree of some growth level with these ratios is lower than the one measured; [`exact`] solves the equations at
//! the level itself. In a ternary tree R0 takes the place of R1, and R1 = R2 that of R2. Absent: angles, which do not
//! enter, and trees that are bent.

/// The most growth levels: far more than a tree can have, and few enough to sum.
pub const MOST_LEVELS: u32 = 10_000;

/// What is measured of a tree, all in one unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// H: from the root to the top.
    pub height: f64,
    /// H0: from the root to the first branching.
    pub first_branch: f64,
    /// L: from the first branching to the farthest tip of the lateral branches that begin there.
    pub lateral: f64,
}

/// The ratios of lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proportions {
    /// Of the branches of the main axis: R1 of a binary tree, R0 of a ternary one.
    pub main: f64,
    /// Of the lateral branches: R2 of a binary tree, R1 = R2 of a ternary one.
    pub lateral: f64,
}

/// Why a tree has no ratios: its measures contradict one another, or the equations.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Misfit {
    /// A measure is not a number above 0.
    #[error("{what} is {value}; expected a length above 0")]
    NoLength {
        /// Which measure.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The first branch is not shorter than the tree.
    #[error("the first branch is {first_branch} long and the tree {height} high; expected H0 < H")]
    NoCrown {
        /// H.
        height: f64,
        /// H0.
        first_branch: f64,
    },
    /// The growth level is 0, or above [`MOST_LEVELS`].
    #[error("the growth level is {0}; expected 1 to {MOST_LEVELS}")]
    NoLevels(u32),
    #[error(
        "the tree is {ratio} first branches high, and at its growth level at most {most} with ratios up to 1; expected a \
         longer first branch or a higher growth level"
    )]
    /// The tree is higher than branches of its growth level can make it: a ratio would be above 1.
    TooHigh {
        /// H / H0.
        ratio: f64,
        /// n + 1.
        most: f64,
    },
    #[error("the ratio of the lateral branches is {0}; expected a shorter lateral branch, at most 1")]
    /// The lateral branch is so long that its ratio would be above 1.
    TooWide(f64),
}

impl Measures {
    /// h: from the first branching to the top (Eq. 1).
    pub fn crown(&self) -> f64 {
        self.height - self.first_branch
    }

    fn checked(&self) -> Result<(), Misfit> {
        let all = [("height", self.height), ("first_branch", self.first_branch), ("lateral", self.lateral)];
        for (what, value) in all {
            if !(value.is_finite() && value > 0.0) {
                return Err(Misfit::NoLength { what, value });
            }
        }
        if self.first_branch >= self.height {
            return Err(Misfit::NoCrown { height: self.height, first_branch: self.first_branch });
        }
        Ok(())
    }
}

impl Proportions {
    /// The tree of a growth level with these ratios and a first branch: H (Eqs. 1 and 2) and L (Eq. 3).
    pub fn measures(&self, first_branch: f64, level: u32) -> Measures {
        let below = sum_of_powers(self.main, level);
        Measures {
            height: first_branch * (1.0 + self.main * below),
            first_branch,
            lateral: first_branch * self.lateral * below,
        }
    }
}

/// The ratios of a tree of a growth level, from Eqs. 1 to 3 at that level. Linear in the level, some two hundred times.
///
/// # Errors
/// Where the measures contradict one another, or a ratio would be above 1.
pub fn exact(tree: &Measures, level: u32) -> Result<Proportions, Misfit> {
    tree.checked()?;
    if !(1..=MOST_LEVELS).contains(&level) {
        return Err(Misfit::NoLevels(level));
    }
    let (ratio, most) = (tree.height / tree.first_branch, f64::from(level) + 1.0);
    if ratio > most {
        return Err(Misfit::TooHigh { ratio, most });
    }
    // 1 + R1 + … + R1ⁿ rises with R1: halving ends at two neighbouring numbers.
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        match sum_of_powers(middle, level + 1) < ratio {
            true => low = middle,
            false => high = middle,
        }
    }
    of_main(tree, high)
}

/// The ratios as the paper prints them, for a growth level without end.
///
/// # Errors
/// As [`exact`], but for the growth level.
pub fn printed(tree: &Measures) -> Result<Proportions, Misfit> {
    tree.checked()?;
    of_main(tree, 1.0 - tree.first_branch / tree.height)
}

/// Eqs. 2 and 3 divided: h : L = R1 : R2 at every growth level.
fn of_main(tree: &Measures, main: f64) -> Result<Proportions, Misfit> {
    let lateral = tree.lateral / tree.crown() * main;
    // Of branches that do not shrink at all rounding may leave a little more than 1.
    if lateral > 1.0 + 1e-9 {
        Err(Misfit::TooWide(lateral))
    } else {
        Ok(Proportions { main, lateral: lateral.min(1.0) })
    }
}

/// 1 + r + … + rᵏ⁻¹ by Horner's rule, which keeps its digits near r = 1.
fn sum_of_powers(r: f64, terms: u32) -> f64 {
    (0..terms).fold(0.0, |sum, _| sum * r + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The young ginkgo: H0/H = .174, L/h = .75 (printed as h/L), growth level 7.
    const GINKGO: Measures = Measures { height: 1.0, first_branch: 0.174, lateral: 0.75 * (1.0 - 0.174) };

    #[test]
    fn the_ginkgo_has_the_printed_ratios() {
        let found = printed(&GINKGO).expect("ratios");
        assert!((found.main - 0.826).abs() < 5e-4 && (found.lateral - 0.620).abs() < 5e-4, "{found:?}");
    }

    /// At growth level 7 the printed ratios give 4.502 H0, not the measured 5.747.
    #[test]
    fn the_ginkgo_of_level_7_is_solved_at_its_level() {
        let printed = Proportions { main: 0.826, lateral: 0.620 };
        assert!((printed.measures(1.0, 7).height - 4.502).abs() < 5e-4);
        assert!((GINKGO.height / GINKGO.first_branch - 5.747).abs() < 5e-4);
        let found = exact(&GINKGO, 7).expect("ratios");
        assert!((found.main - 0.902756).abs() < 5e-7, "{found:?}");
        assert!((found.lateral - 0.677067).abs() < 5e-7, "{found:?}");
    }

    #[test]
    fn a_tree_has_the_ratios_that_it_was_made_of() {
        for level in [1, 2, 7, 10, 28, 300] {
            for main in [0.2, 0.5, 0.7, 0.9, 0.95, 1.0] {
                for lateral in [0.1, 0.62, 1.0] {
                    let tree = Proportions { main, lateral }.measures(1.7, level);
                    if tree.height - tree.first_branch < 1e-3 || level > 28 && main < 0.95 {
                        continue;
                    }
                    let found = exact(&tree, level).expect("ratios");
                    assert!((found.main - main).abs() < 1e-9 && (found.lateral - lateral).abs() < 1e-9, "{found:?}");
                }
            }
        }
    }

    #[test]
    fn the_equations_agree_with_their_closed_forms() {
        for (r, n) in [(0.3, 4), (0.9, 9), (0.826, 7)] {
            let power = (0..=n).fold(1.0, |power: f64, _| power * r);
            let tree = Proportions { main: r, lateral: 0.5 }.measures(2.0, n);
            assert!((tree.height - 2.0 * (1.0 - power) / (1.0 - r)).abs() < 1e-12);
            assert!((tree.lateral - 2.0 * 0.5 * (1.0 - power / r) / (1.0 - r)).abs() < 1e-12);
            assert!((tree.crown() / tree.lateral - r / 0.5).abs() < 1e-12, "h : L = R1 : R2");
        }
    }

    /// With the growth level the exact ratios come down to the printed ones, of which R2 = L/H.
    #[test]
    fn in_endless_growth_the_exact_ratios_are_the_printed_ones() {
        let tree = Measures { height: 5.0, first_branch: 1.0, lateral: 2.0 };
        let endless = printed(&tree).expect("ratios");
        assert!((endless.lateral - 0.4).abs() < 1e-15, "L/H");
        let off = [5, 10, 20, 40, 80].map(|level| exact(&tree, level).expect("ratios").main - endless.main);
        assert!(off.windows(2).all(|pair| pair[1] < pair[0]) && off[0] > 0.01 && off[4] < 1e-7, "{off:?}");
        for first_branch in [0.5, 1.0, 3.0] {
            let lateral = printed(&Measures { first_branch, ..tree }).expect("ratios").lateral;
            assert!((lateral - 0.4).abs() < 1e-15, "whatever H0 is");
        }
    }

    #[test]
    fn measures_that_contradict_one_another_are_told() {
        let tree = Measures { height: 5.0, first_branch: 1.0, lateral: 2.0 };
        let told = |tree: Measures, level| exact(&tree, level).expect_err("no tree").to_string();
        assert!(told(Measures { height: f64::NAN, ..tree }, 7).starts_with("height is NaN; expected a length above 0"));
        assert!(told(Measures { lateral: -1.0, ..tree }, 7).starts_with("lateral is -1"));
        assert!(told(Measures { first_branch: 5.0, ..tree }, 7).ends_with("expected H0 < H"));
        assert!(told(tree, 0).starts_with("the growth level is 0; expected 1 to"));
        assert!(told(tree, 3).starts_with("the tree is 5 first branches high, and at its growth level at most 4"));
        assert!(told(Measures { lateral: 50.0, ..tree }, 7).starts_with("the ratio of the lateral branches is"));
        assert_eq!(exact(&tree, 4).map(|found| found.main), Ok(1.0));
    }
}
