//! From the keys of GMT4 to the angles of each growth level (Aono & Kunii 1984, Tables 3 and 4).
//!
//! Table 4 gives the greatest and the smallest angle of each side as |h′| and |h″|; both have the sign of their side. A
//! range of levels that states a category or an angle of its own takes the other keys from the tree. Absent: the
//! functions (`course`).

use super::course::{Category, Curve};
use super::descriptor::Rule;
use crate::fault::{Fault, Path};
use crate::law::{Constant, Quantity, ValueRange};

const ANGLE: ValueRange = ValueRange { min: -180.0, max: 180.0, what: "an angle in degrees" };
const PHI: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 3600.0, what: "an angle in degrees" };
const PEAK: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1.0 - f64::EPSILON, what: "a share below 1" };

/// How the angles of both sides change over a range of growth levels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Courses {
    category: Category,
    /// Left and right; `None` where the category holds for no angle of the side.
    sides: [Option<Side>; 2],
}

/// The angles of one side: their sizes and their sign.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Side {
    greatest: f64,
    smallest: f64,
    sign: f64,
}

impl Courses {
    /// The angles, left and right, at the share `s` of the way, degrees; 0 where there is none.
    pub fn at(&self, s: f64) -> [f64; 2] {
        self.sides
            .map(|side| side.map_or(0.0, |side| side.sign * self.category.angle_deg(side.greatest, side.smallest, s)))
    }

    /// Whether the category holds for the angle of a side.
    pub fn has(&self, side: usize) -> bool {
        self.sides[side].is_some()
    }

    /// The greatest angle of a side, degrees, without sign.
    pub fn greatest(&self, side: usize) -> f64 {
        self.sides[side].map_or(0.0, |side| side.greatest)
    }
}

/// The keys of the greatest and of the smallest angle of each side.
const ENDS: [[&str; 2]; 2] = [["h1_max_deg", "h1_min_deg"], ["h2_max_deg", "h2_min_deg"]];

fn ends(rule: &Rule) -> [[Option<&Constant>; 2]; 2] {
    [[rule.h1_max_deg.as_ref(), rule.h1_min_deg.as_ref()], [rule.h2_max_deg.as_ref(), rule.h2_min_deg.as_ref()]]
}

/// Whether a rule states the range of the angle of each side.
pub(super) fn has_ends(rule: &Rule) -> [bool; 2] {
    ends(rule).map(|pair| pair.iter().any(Option::is_some))
}

/// Whether a rule states any key of angles that change.
pub(super) fn changes(rule: &Rule) -> bool {
    let others = [rule.category.is_some(), rule.curve.is_some(), rule.phi_deg.is_some(), rule.peak.is_some()];
    others.contains(&true) || has_ends(rule).contains(&true)
}

/// The angles of a rule at `path`, with those keys of `base` that the rule does not state; `None` where neither states
/// a range of angles, or where a key is wrong.
pub(super) fn courses(rule: &Rule, base: Option<&Rule>, path: &Path, faults: &mut Vec<Fault>) -> Option<Courses> {
    let before = faults.len();
    let (own, of_tree) = (ends(rule), base.map(ends));
    let laws = [rule.h1_deg.is_some(), rule.h2_deg.is_some()];
    let sides = [0, 1].map(|side| {
        let stated = own[side].iter().any(Option::is_some);
        let inherited = of_tree.filter(|_| !stated && !laws[side]).map_or([None; 2], |ends| ends[side]);
        side_of(if stated { own[side] } else { inherited }, ENDS[side], path, faults)
    });
    let category = category(rule, base, &sides, path, faults)?;
    let has_side = sides.iter().any(Option::is_some);
    if !has_side && faults.len() == before {
        let expected = "h2_max_deg and h2_min_deg, or h1_max_deg and h1_min_deg, beside the category";
        faults.push(Fault::new(&path.key("category"), "no angle changes by the category", expected));
    }
    (faults.len() == before).then_some(Courses { category, sides })
}

/// The angles of one side.
fn side_of(ends: [Option<&Constant>; 2], keys: [&str; 2], path: &Path, faults: &mut Vec<Fault>) -> Option<Side> {
    let mut read = |end: Option<&Constant>, place: usize| {
        end.and_then(|end| end.within(&path.key(keys[place]), ANGLE).map_err(|fault| faults.push(fault)).ok())
    };
    let values = [read(ends[0], 0), read(ends[1], 1)];
    let missing = match ends {
        [Some(_), None] => Some(1),
        [None, Some(_)] => Some(0),
        _ => None,
    };
    if let Some(place) = missing {
        let problem = format!("{} is given without {}", keys[1 - place], keys[place]);
        faults.push(Fault::new(&path.key(keys[1 - place]), problem, "both ends of the range"));
    }
    let [greatest, smallest] = [values[0]?, values[1]?];
    if greatest * smallest < 0.0 || smallest.abs() > greatest.abs() {
        let problem = format!("{} is {smallest}, and {} is {greatest}", keys[1], keys[0]);
        let expected = format!("|{}| ≤ |{}|, both on one side", keys[1], keys[0]);
        faults.push(Fault::new(&path.key(keys[1]), problem, expected));
        return None;
    }
    let sign = if greatest < 0.0 { -1.0 } else { 1.0 };
    Some(Side { greatest: greatest.abs(), smallest: smallest.abs(), sign })
}

/// The category and the numbers of its function.
fn category(
    rule: &Rule,
    base: Option<&Rule>,
    sides: &[Option<Side>; 2],
    path: &Path,
    faults: &mut Vec<Fault>,
) -> Option<Category> {
    let number = rule.category.as_ref().or(base.and_then(|base| base.category.as_ref())).map(Quantity::value);
    let curve = rule.curve.or(base.and_then(|base| base.curve)).unwrap_or_default();
    let phi = rule.phi_deg.as_ref().or(base.and_then(|base| base.phi_deg.as_ref()));
    let peak = rule.peak.as_ref().or(base.and_then(|base| base.peak.as_ref()));
    let fault = |key: &str, problem: String, expected: &str| Fault::new(&path.key(key), problem, expected);
    let is_exponential = curve == Curve::Exponential;
    if is_exponential && !matches!(number, Some(2 | 3)) {
        let problem = "the curve is exponential".to_owned();
        faults.push(fault("curve", problem, "a polynomial, or category 2 or 3"));
    }
    if phi.is_some() && !(is_exponential && number == Some(2)) {
        let expected = "it beside the exponential curve of category 2 alone";
        faults.push(fault("phi_deg", "phi_deg has no use here".to_owned(), expected));
    }
    if peak.is_some() && number != Some(5) {
        faults.push(fault("peak", "peak has no use here".to_owned(), "it beside category 5 alone"));
    }
    Some(match (number, is_exponential) {
        (Some(1), _) => Category::Constant,
        (Some(2), false) => Category::Late,
        (Some(2), true) => Category::LateExponential(phi_of(phi, sides, path, faults)?),
        (Some(3), false) => Category::Early,
        (Some(3), true) => {
            if sides.iter().flatten().any(|side| side.smallest == 0.0 && side.greatest > 0.0) {
                let problem = "the smallest angle is 0".to_owned();
                let expected = "an angle that is not 0, which an exponential curve can come to";
                faults.push(fault("curve", problem, expected));
            }
            Category::EarlyExponential
        }
        (Some(4), _) => Category::Middle,
        (Some(5), _) => {
            let stated = peak.map_or(Ok(0.5), |peak| peak.within(&path.key("peak"), PEAK));
            Category::Peak(stated.map_err(|fault| faults.push(fault)).ok()?)
        }
        (Some(other), _) => {
            faults.push(fault("category", format!("the category is {other}"), "a category from 1 to 5"));
            return None;
        }
        (None, _) => {
            faults.push(fault("category", "no category is given".to_owned(), "a category from 1 to 5"));
            return None;
        }
    })
}

/// The angle φ, which no angle of the range may reach.
fn phi_of(phi: Option<&Constant>, sides: &[Option<Side>; 2], path: &Path, faults: &mut Vec<Fault>) -> Option<f64> {
    let path = path.key("phi_deg");
    let greatest = sides.iter().flatten().map(|side| side.greatest).fold(0.0, f64::max);
    let expected = format!("an angle above {greatest}, the greatest of the range");
    let Some(phi) = phi else {
        faults.push(Fault::new(&path, "the exponential curve of category 2 has no phi_deg", expected));
        return None;
    };
    let phi = phi.within(&path, PHI).map_err(|fault| faults.push(fault)).ok()?;
    if phi <= greatest {
        faults.push(Fault::new(&path, format!("phi_deg is {phi}: the angles cross it"), expected));
        return None;
    }
    Some(phi)
}
