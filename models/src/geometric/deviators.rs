//! What moves the tips of one growth level: a uniform deviation and points that pull (Aono & Kunii 1984, GMT2).
//!
//! x′ = x + dx + Σ factor (q − x)/L, with L the distance of x from q, and y and z alike; x is the tip before the move.
//! A point on which the tip stands adds nothing. Absent: the branch that ends at the tip (`tree`).

use super::parts::Falloff;

/// The furthest that a point whose strength falls off moves a tip, metres: near the point the quotient has no bound.
const FURTHEST_M: f64 = 1000.0;

/// A point that pulls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pull {
    pub factor: f64,
    pub at: [f64; 3],
    pub falloff: Falloff,
}

/// What moves the tips of one growth level.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Deviators {
    by: [f64; 3],
    pulls: Vec<Pull>,
}

impl Deviators {
    /// What has no effect is left out, so that a tree without effective deviators is that of GMT1 to the bit.
    pub fn new(by: [f64; 3], pulls: impl Iterator<Item = Pull>) -> Self {
        Self { by, pulls: pulls.filter(|pull| pull.factor != 0.0).collect() }
    }

    /// Whether no tip is moved.
    pub fn is_none(&self) -> bool {
        self.by == [0.0; 3] && self.pulls.is_empty()
    }

    /// A bound of how far a tip is moved, metres.
    pub fn most(&self) -> f64 {
        let most = |pull: &Pull| if pull.falloff == Falloff::None { pull.factor.abs() } else { FURTHEST_M };
        norm(self.by) + self.pulls.iter().map(most).sum::<f64>()
    }

    /// By how much a tip is moved.
    #[inline]
    pub fn of(&self, tip: [f64; 3]) -> [f64; 3] {
        let mut moved = self.by;
        for pull in &self.pulls {
            let apart = [0, 1, 2].map(|i| pull.at[i] - tip[i]);
            let distance = norm(apart);
            if distance > 0.0 {
                let per_metre = pull.per_metre(distance);
                (0..3).for_each(|i| moved[i] += per_metre * apart[i]);
            }
        }
        moved
    }
}

impl Pull {
    /// The move over the distance.
    #[inline]
    fn per_metre(&self, distance: f64) -> f64 {
        match self.falloff {
            Falloff::None => self.factor / distance,
            Falloff::Inverse => (self.factor / distance).clamp(-FURTHEST_M, FURTHEST_M) / distance,
        }
    }
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pull(factor: f64, at: [f64; 3], falloff: Falloff) -> Deviators {
        Deviators::new([0.0; 3], [Pull { factor, at, falloff }].into_iter())
    }

    #[test]
    fn the_formula_pulls_by_its_factor_at_any_distance() {
        for distance in [0.1, 1.0, 30.0, 1e6] {
            let found = pull(1.6, [distance, 0.0, 0.0], Falloff::None).of([0.0; 3]);
            assert!((found[0] - 1.6).abs() < 1e-12 && found[1..] == [0.0, 0.0], "{distance}: {found:?}");
            let away = pull(-1.0, [0.0, distance, 0.0], Falloff::None).of([0.0; 3]);
            assert!((away[1] + 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn with_falloff_it_pulls_in_inverse_proportion_to_the_distance() {
        for distance in [0.1, 1.0, 30.0] {
            let found = pull(2.0, [0.0, 0.0, distance], Falloff::Inverse).of([0.0; 3]);
            assert!((found[2] * distance - 2.0).abs() < 1e-12, "{distance}: {found:?}");
        }
        let near = pull(2.0, [0.0, 0.0, 1e-300], Falloff::Inverse).of([0.0; 3]);
        assert!(near.iter().all(|x| x.is_finite() && x.abs() <= FURTHEST_M), "{near:?}");
    }

    #[test]
    fn a_tip_on_its_controller_is_not_moved() {
        for falloff in [Falloff::None, Falloff::Inverse] {
            assert_eq!(pull(5.0, [1.0, 2.0, 3.0], falloff).of([1.0, 2.0, 3.0]), [0.0; 3]);
        }
    }

    #[test]
    fn deviators_add_up_and_their_bound_holds() {
        let pulls = [
            Pull { factor: -0.6, at: [30.0, 0.0, 0.0], falloff: Falloff::None },
            Pull { factor: -1.6, at: [-30.0, 15.0, 0.0], falloff: Falloff::None },
            Pull { factor: 0.0, at: [0.0; 3], falloff: Falloff::None },
        ];
        let all = Deviators::new([0.3, 0.3, -0.3], pulls.into_iter());
        let tip = [1.0, -2.0, 20.0];
        let single = |pull: Pull| Deviators::new([0.0; 3], [pull].into_iter()).of(tip);
        let [one, other] = [single(pulls[0]), single(pulls[1])];
        let sum = [0, 1, 2].map(|i| [0.3, 0.3, -0.3][i] + one[i] + other[i]);
        let found = all.of(tip);
        assert!((0..3).all(|i| (found[i] - sum[i]).abs() < 1e-12), "{found:?} is not {sum:?}");
        assert!(norm(found) <= all.most());
        assert!(!all.is_none() && Deviators::new([0.0; 3], [pulls[2]].into_iter()).is_none());
    }
}
