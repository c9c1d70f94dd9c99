//! The shortening of stems until they fit into the envelope (Weber & Penn 1995 §4.6).
//!
//! The very path that is then built is tried, with its clones: its turns do not depend on its length. A length comes
//! down a ladder of equal steps, so that the result is defined where a curved stem leaves the envelope and comes back.
//! Nothing is drawn again. Absent: the envelope itself (`envelope`).

use super::envelope::beyond;
use super::numbers::Numbers;
use super::path::{ALONG, Path};

/// The steps from the full length to none.
const STEPS: u32 = 32;

/// By how much an end may be outside, over the size of the tree: rounding.
const ROUNDING: f64 = 1e-9;

/// The length of a stem of `length` after pruning, metres. `scale` is the size of the tree, `base` where the stem
/// begins; `bare` exempts what is in the bare part of the tree, as the base of the trunk.
pub(super) fn pruned(
    tree: &Numbers,
    path: &Path,
    base: [f64; 3],
    length: f64,
    scale: f64,
    bare: bool,
    res: u32,
) -> f64 {
    if tree.prune_ratio == 0.0 {
        return length;
    }
    let fits = |length: f64| ends(path, base, length / f64::from(res)).all(|end| inside(tree, end, scale, bare));
    let fitting =
        (0..STEPS).map(|step| length * (1.0 - f64::from(step) / f64::from(STEPS))).find(|&length| fits(length));
    tree.prune_ratio * fitting.unwrap_or(0.0) + (1.0 - tree.prune_ratio) * length
}

/// The ends of the segments of a path that begins at `base`, with segments of a length.
fn ends(path: &Path, base: [f64; 3], segment: f64) -> impl Iterator<Item = [f64; 3]> {
    path.segments.iter().map(move |of| {
        let heading = of.frame.turned(ALONG);
        [0, 1, 2].map(|k| base[k] + segment * (of.start[k] + heading[k]))
    })
}

fn inside(tree: &Numbers, [z, x, y]: [f64; 3], scale: f64, bare: bool) -> bool {
    let (height, out) = (z / scale, (x * x + y * y).sqrt() / scale);
    bare && height <= tree.base_size || beyond(&tree.envelope, tree.base_size, height, out) <= ROUNDING
}
