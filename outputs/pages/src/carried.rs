//! Where a host carries what it bears: the place at which a part would be if it kept its distance along the line.
//!
//! Places of parts are told as the difference to this place, which a twig that bends or sways carries along; so the
//! differences of a part hardly change. The line is that of the keyframes as the page has them, in whole numbers. All
//! is computed in double precision by the four operations and square roots, which are exact to the last bit in every
//! language, and rounded to whole numbers. Numbers of ages stand for ages here: the place is a guess, and any would do.

use super::hosts::{Host, SHARES};
use super::{Numbering, Scale};
use phytomer_life::Life;
use std::ops::Range;

/// A key of a point: the number of its age, and its place.
type Key = (i64, [f64; 3]);

/// The points of a life as the page has them.
#[derive(Debug)]
pub struct Carriers {
    keys: Vec<Key>,
    of_point: Vec<Range<usize>>,
    /// The number of the age from which each point stands, and that from which it does not.
    stands: Vec<Range<i64>>,
    /// Where the line of each point ends.
    ends: Vec<usize>,
}

/// A host with the distance along its line, steps.
#[derive(Debug, Clone, Copy)]
pub struct Carried {
    point: usize,
    along: f64,
}

impl Carriers {
    /// The points of a life.
    pub fn of(life: &Life, scale: &Scale, numbering: &Numbering) -> Self {
        let (mut keys, mut of_point, mut stands, mut ends) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for line in &life.lines {
            for point in &life.points[line.points.clone()] {
                let first = keys.len();
                keys.extend(life.places(point).iter().map(|(age, [x, y, z, _])| {
                    (numbering.place(*age), scale.places([*x, *y, *z]).map(|place| place as f64))
                }));
                of_point.push(first..keys.len());
                let from = numbering.place(point.from);
                let lasts = numbering.lasts(point.from, point.death);
                stands.push(from..if lasts > 0 { from + lasts } else { i64::MAX });
                ends.push(line.points.end);
            }
        }
        Self { keys, of_point, stands, ends }
    }

    /// A host at the age at which it begins to bear something.
    pub fn begin(&self, host: &Host, number: i64) -> Carried {
        let point = host.point as usize;
        let next = self.following(point, number).next();
        let far = next.map_or(0.0, |next| distance(self.at(point, number), self.at(next, number)));
        Carried { point, along: f64::from(host.share) / f64::from(SHARES) * far }
    }

    /// The place to which a host has carried what it bears by an age.
    pub fn place(&self, carried: &Carried, number: i64) -> [i64; 3] {
        let (mut here, mut rest) = (self.at(carried.point, number), carried.along);
        for next in self.following(carried.point, number) {
            let there = self.at(next, number);
            let far = distance(here, there);
            if far > 0.0 && rest <= far {
                let share = rest / far;
                here = [0, 1, 2].map(|k| here[k] + share * (there[k] - here[k]));
                break;
            }
            rest -= far;
            here = there;
        }
        here.map(|x| (x + 0.5).floor() as i64)
    }

    /// The points of the line after a point that stand at an age.
    fn following(&self, point: usize, number: i64) -> impl Iterator<Item = usize> {
        (point + 1..self.ends[point]).filter(move |next| self.stands[*next].contains(&number))
    }

    fn at(&self, point: usize, number: i64) -> [f64; 3] {
        let keys = &self.keys[self.of_point[point].clone()];
        let after = keys.partition_point(|(age, _)| *age <= number);
        let (Some((from, low)), Some((to, high))) = (keys.get(after.wrapping_sub(1)), keys.get(after)) else {
            return keys.get(after.saturating_sub(1)).map_or([0.0; 3], |(_, place)| *place);
        };
        let share = (number - from) as f64 / (to - from) as f64;
        [0, 1, 2].map(|k| low[k] + share * (high[k] - low[k]))
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|k| b[k] - a[k]);
    (x * x + y * y + z * z).sqrt()
}
