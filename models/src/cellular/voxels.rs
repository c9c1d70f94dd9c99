//! Cubes of space, voxels, and those that a segment passes through (Amanatides & Woo 1987, "A fast voxel traversal
//! algorithm").
//!
//! Absent: what stands in them.

/// A voxel, by its place on the lattice.
pub(super) type Voxel = [i32; 3];

/// The most voxels of a segment.
const MOST: i64 = 10_000;

/// A lattice of voxels, as one plant sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lattice {
    /// The edge of a voxel, metres.
    pub edge: f64,
    /// Where the seed lies, in edges from the lowest corner of the voxel [0, 0, 0].
    seed: [f64; 3],
}

impl Lattice {
    /// The lattice of a plant by itself: its seed lies in the middle of the base of the voxel [0, 0, 0].
    pub fn of_one(edge: f64) -> Self {
        Self { edge, seed: [0.5, 0.5, 0.0] }
    }

    /// The lattice that the plants of a plot share, of a plant whose seed lies so far from the middle of the base of
    /// the voxel [0, 0, 0], metres.
    pub fn shared(edge: f64, seed: [f64; 3]) -> Self {
        let [x, y, z] = seed.map(|x| x / edge);
        Self { edge, seed: [x + 0.5, y + 0.5, z] }
    }

    /// The voxel of the seed.
    pub fn seed(self) -> Voxel {
        self.voxel_of([0.0; 3])
    }

    /// A point, metres from the seed, in edges from the lowest corner of the voxel [0, 0, 0].
    fn scaled(self, point: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| point[k] / self.edge + self.seed[k])
    }

    /// The voxel that holds a point.
    pub fn voxel_of(self, point: [f64; 3]) -> Voxel {
        // The cast keeps to the ends of the range.
        self.scaled(point).map(|x| x.floor() as i32)
    }

    /// The middle of a voxel, metres from the seed.
    pub fn middle_of(self, voxel: Voxel) -> [f64; 3] {
        [0, 1, 2].map(|k| (f64::from(voxel[k]) + 0.5 - self.seed[k]) * self.edge)
    }

    /// The voxels from that of `start` to that of `end`, each sharing a face with the next.
    pub fn passed(self, start: [f64; 3], end: [f64; 3]) -> Vec<Voxel> {
        let (mut at, last) = (self.voxel_of(start), self.voxel_of(end));
        let (start, end) = (self.scaled(start), self.scaled(end));
        let mut passed = vec![at];
        let way = [0, 1, 2].map(|k| end[k] - start[k]);
        let step = way.map(|x| if x > 0.0 { 1 } else { -1 });
        // The share of the way at which the next voxel begins along an axis.
        let share = |k: usize, at: i32| {
            let border = f64::from(at) + if step[k] > 0 { 1.0 } else { 0.0 };
            if way[k] == 0.0 { f64::INFINITY } else { (border - start[k]) / way[k] }
        };
        let steps: i64 = (0..3).map(|k| (i64::from(last[k]) - i64::from(at[k])).abs()).sum();
        for _ in 0..steps.min(MOST) {
            let open = |k: &usize| at[*k] != last[*k];
            let next = (0..3).filter(open).min_by(|a, b| share(*a, at[*a]).total_cmp(&share(*b, at[*b])));
            let Some(axis) = next else { break };
            at[axis] += step[axis];
            passed.push(at);
        }
        passed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each point of a segment lies in one of its voxels, neighbours share a face, and none is passed twice.
    #[test]
    fn segments_pass_through_their_voxels() {
        let ends = [[0.31, 0.52, -0.13], [-1.7, 2.9, 0.44], [0.31, 0.52, 3.0], [5.0, -4.0, -3.0], [0.35, 0.55, -0.11]];
        for start in ends {
            for end in ends {
                let lattice =
                    if start[0] > 1.0 { Lattice::shared(0.4, [3.1, -7.3, 0.2]) } else { Lattice::of_one(0.4) };
                let passed = lattice.passed(start, end);
                for step in 0..=1000 {
                    let share = f64::from(step) / 1000.0;
                    let at = [0, 1, 2].map(|k| start[k] + share * (end[k] - start[k]));
                    assert!(passed.contains(&lattice.voxel_of(at)), "{start:?} {end:?} {at:?}");
                }
                let apart = |pair: &[Voxel]| (0..3).map(|k| (pair[0][k] - pair[1][k]).abs()).sum::<i32>();
                assert!(passed.windows(2).all(|pair| apart(pair) == 1));
                let once: std::collections::BTreeSet<_> = passed.iter().collect();
                assert_eq!(once.len(), passed.len());
                assert!(passed.iter().all(|voxel| lattice.voxel_of(lattice.middle_of(*voxel)) == *voxel));
            }
        }
    }
}
