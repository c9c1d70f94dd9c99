//! Trees by the printed equations (Aono & Kunii 1984), as branches that could have been measured, with scatter or
//! without.
//!
//! Written apart from the models: u, v, w, S and T as in "3-D geometric model GMT1", the turn of Fig. 10 about the
//! mother, the deviation of GMT2, the centre child of GMT3.

use phytomer_fits::draws::Draws;
use phytomer_fits::gmt::{Piece, Skeleton};
use phytomer_sim::math;

/// A tree; angles in degrees.
#[derive(Debug, Clone)]
pub struct Tree {
    /// h1 and h2 by the share of the way from the first branching to the last.
    pub angles: fn(f64) -> [f64; 2],
    /// R1, R2.
    pub ratios: [f64; 2],
    /// R0.
    pub centre: Option<f64>,
    pub divergence: f64,
    pub delta: f64,
    pub deviation: [f64; 3],
    pub diameter_ratio: f64,
    pub levels: u32,
    pub first: [f64; 3],
    /// Standard deviations: of angles, degrees; of ratios; of the turns of branchings, and of children by themselves,
    /// degrees.
    pub scatter: [f64; 4],
}

impl Tree {
    /// Table 4, Fig. 11, without its deviation.
    pub const PLAIN: Self = Self {
        angles: |_| [0.0, -45.0],
        ratios: [0.9, 0.8],
        centre: None,
        divergence: 140.0,
        delta: 0.0,
        deviation: [0.0; 3],
        diameter_ratio: 0.7,
        levels: 6,
        first: [0.0, 0.0, 10.0],
        scatter: [0.0; 4],
    };
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector of a child, turned about its mother by `turn`, radians.
fn child(mother: [f64; 3], ratio: f64, angle: f64, turn: f64) -> [f64; 3] {
    let [u, v, w] = mother;
    let t = (u * u + v * v + w * w).sqrt();
    let flat = (u * u + v * v).sqrt();
    let (sin, cos) = math::sincos(angle);
    let across = if flat < 1e-9 * t { [-t, 0.0, 0.0] } else { [-t * v / flat, t * u / flat, 0.0] };
    let beyond = cross(mother.map(|x| x / t), across);
    let (turn_sin, turn_cos) = math::sincos(turn);
    [0, 1, 2].map(|k| ratio * (mother[k] * cos + (across[k] * turn_cos + beyond[k] * turn_sin) * sin))
}

struct Grown {
    piece: usize,
    vector: [f64; 3],
    tip: [f64; 3],
    rank: u32,
    diameter: f64,
}

/// The branches of a tree; `draws` scatters them.
pub fn grown(tree: &Tree, draws: &mut Draws) -> Skeleton {
    let mut pieces = vec![Piece { plant: 0, mother: None, base: [0.0; 3], vector: tree.first, diameter: Some(1.0) }];
    let mut tips = vec![Grown { piece: 0, vector: tree.first, tip: tree.first, rank: 1, diameter: 1.0 }];
    for level in 1..=tree.levels {
        let s = f64::from(level - 1) / f64::from((tree.levels - 1).max(1));
        let mut next = Vec::new();
        for mother in &tips {
            let mut off = |k: usize| if tree.scatter[k] > 0.0 { tree.scatter[k] * draws.normal() } else { 0.0 };
            let [h1, h2] = (tree.angles)(s);
            let left_leads = h1.abs() <= h2.abs();
            let turn = tree.delta + f64::from(mother.rank - 1) * tree.divergence + off(2);
            let mut ways = vec![(h1 + off(0), tree.ratios[0] + off(1), tree.centre.is_none() && left_leads)];
            ways.push((h2 + off(0), tree.ratios[1] + off(1), tree.centre.is_none() && !left_leads));
            ways.extend(tree.centre.map(|ratio| (0.0, ratio + off(1), true)));
            for (angle, ratio, goes_on) in ways {
                let turn = turn + off(3);
                let straight = child(mother.vector, ratio, angle.to_radians(), turn.to_radians());
                let vector = [0, 1, 2].map(|k| straight[k] + tree.deviation[k]);
                let tip = [0, 1, 2].map(|k| mother.tip[k] + vector[k]);
                let diameter = mother.diameter * tree.diameter_ratio;
                let rank = if goes_on { mother.rank + 1 } else { 1 };
                next.push(Grown { piece: pieces.len(), vector, tip, rank, diameter });
                let (base, diameter) = (mother.tip, Some(diameter));
                pieces.push(Piece { plant: 0, mother: Some(mother.piece), base, vector, diameter });
            }
        }
        tips = next;
    }
    Skeleton::of(&pieces)
}
