//! The middle line of a growth unit before its nodes are made, and whether it touches no stem.
//!
//! The stems are asked once for some internodes together, by the box about them. A line that passes them touches none
//! as [`Beside::touched`](super::Beside::touched) finds it, internode by internode: a line that is not known to pass
//! has to be asked so. Absent: the way past a stem that is touched.

use super::beside::ROUNDING;
use super::cells::NO_AXIS;
use super::of_plant::OfPlant;
use super::segments::Segment;
use super::stem::{Near, Stem, length};
use super::{Spared, Stems};
use crate::shape::{Bounds, Point};
use crate::vector::Vector;

/// The most internodes that ask together.
const PIECE: usize = 6;
/// The most stems that are looked at one by one.
const MOST_NEAR: usize = 128;
/// What rounding may add to a distance, or to a place, metres.
const DIGITS: f64 = 1e-7;

/// The middle line of a growth unit: where it begins, and where each internode ends.
#[derive(Debug, Clone, Default)]
pub struct Line {
    points: Vec<Point>,
    /// What each internode is to keep from bark, metres.
    rooms: Vec<f64>,
}

impl Line {
    /// Begins a line at a point of the plot.
    pub fn begin(&mut self, at: Point) {
        self.points.clear();
        self.rooms.clear();
        self.points.push(at);
    }

    /// Goes on to the tip of the next internode, which keeps so much room from bark, metres.
    pub fn go_on(&mut self, at: Point, room: f64) {
        self.points.push(at);
        self.rooms.push(room);
    }
}

/// Some internodes of a line, one after another.
struct Piece<'a> {
    points: &'a [Point],
    rooms: &'a [f64],
    /// The largest of their rooms, and what rounding may add.
    room: f64,
    /// A box that holds all that may touch them.
    about: Bounds,
}

impl Stems {
    /// How many internodes of a line, from its first on, are soon known to touch no stem: none of them comes nearer to
    /// one than its room and than it began to the axis of that stem.
    pub fn passed_by(&self, line: &Line, spared: Spared) -> usize {
        let touches = (0..line.rooms.len()).step_by(PIECE).find(|&first| {
            let last = line.rooms.len().min(first + PIECE);
            let (points, rooms) = (&line.points[first..=last], &line.rooms[first..last]);
            let room = rooms.iter().copied().fold(0.0, f64::max) + DIGITS;
            let piece = Piece { points, rooms, room, about: Bounds::of_points(points).with_margin(room) };
            !self.are_passed_by(&piece, spared)
        });
        touches.unwrap_or(line.rooms.len())
    }

    fn are_passed_by(&self, piece: &Piece, spared: Spared) -> bool {
        let Bounds { low, high } = piece.about;
        let middle = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        let half = [0, 1, 2].map(|k| 0.5 * (high[k] - low[k]));
        let reach = half.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut passed = reach.is_finite();
        self.each_plant_near(middle, reach, spared, &mut |plant| {
            let of = &self.plants[plant as usize];
            let own = if of.number == spared.plant { spared.axis } else { NO_AXIS };
            passed = passed && piece.passes(of, own, |stem| self.is_met(of, stem, spared));
        });
        passed
    }
}

impl Piece<'_> {
    /// Whether it passes all stems of a plant that count; those of the axis `spared` do not.
    fn passes(&self, of: &OfPlant, spared: u32, counts: impl Fn(&Stem) -> bool) -> bool {
        let [low, high] = [self.about.low, self.about.high].map(|corner| of.seen_from_seed(corner));
        let cells = of.cells();
        let Some(range) = cells.around([low, high]) else { return false };
        let (mut near, mut many) = ([0; MOST_NEAR], 0);
        cells.each_in(&range, spared, |node| {
            let stem = &of.stems[node as usize];
            let radius = f64::from(stem.radius());
            let beyond = |k: usize| {
                let (start, end) = (f64::from(stem.start[k]), f64::from(stem.end[k]));
                (start.min(end) - radius > high[k]) | (start.max(end) + radius < low[k])
            };
            if beyond(0) | beyond(1) | beyond(2) || !counts(stem) {
                return false;
            }
            if let Some(free) = near.get_mut(many) {
                *free = node;
            }
            many += 1;
            many > MOST_NEAR
        });
        if many == 0 {
            return true;
        }
        let mut points = [Vector::default(); PIECE + 1];
        let seen = self.points.iter().map(|point| Vector::of(of.seen_from_seed(*point)));
        points.iter_mut().zip(seen).for_each(|(point, seen)| *point = seen);
        let (points, near) = (&points[..self.points.len()], near.get(..many));
        near.is_some_and(|near| near.iter().all(|node| self.passes_one(of, near, *node, points)))
    }

    /// Whether it passes one of the stems that are near; `points` are its points as seen from the seed.
    fn passes_one(&self, of: &OfPlant, near: &[u32], node: u32, points: &[Vector]) -> bool {
        let stem = &of.stems[node as usize];
        let wood = Near::of(stem, [0.0; 3], 0);
        let last = points[points.len() - 1];
        // The middle line of the stem lies all behind the plane through its point that is nearest to the last one.
        let foot = wood.middle.at(wood.middle.share_near(last));
        let out = last - foot;
        let keeps = length(out) * (f64::from(stem.radius()) + self.room);
        let is_beyond = |point: Vector| (point - foot).dot(out) > keeps;
        let mut began = is_beyond(points[0]);
        points.windows(2).zip(self.rooms).all(|(ends, room)| {
            let was = std::mem::replace(&mut began, is_beyond(ends[1]));
            if was && began {
                return true;
            }
            let way = Segment { start: ends[0], along: ends[1] - ends[0] };
            if wood.is_left_by(&way) {
                return true;
            }
            let (distance, _) = wood.distance_of(&way);
            let is_passed = |began: f64| room.min(began) - distance < ROUNDING - DIGITS;
            *room <= distance || is_passed(wood.distance(way.start)) || {
                // Another stem of the axis may have been nearer.
                let stems = near.iter().map(|node| &of.stems[*node as usize]);
                let of_axis = stems.filter(|other| other.axis == stem.axis);
                let began = of_axis.map(|other| Near::of(other, [0.0; 3], 0).distance(way.start));
                is_passed(began.fold(f64::INFINITY, f64::min))
            }
        })
    }
}

impl Near {
    /// Whether a way is soon known to come nowhere nearer to the bark than where it begins, but for less than what
    /// rounding may add. It leads away from the nearest point of the middle line, and the distance from a segment is a
    /// convex function of the way; so it never falls. Nor does the radius beside the way grow, but by the taper.
    fn is_left_by(&self, way: &Segment) -> bool {
        let share = self.middle.share_near(way.start);
        let out = way.start - self.middle.at(share);
        let leaves = way.along.dot(out) >= 0.0 || out.dot(out) <= DIGITS * DIGITS;
        let square = self.middle.along.dot(self.middle.along);
        // What the radius grows by at most, in metres times the square of the length of the stem.
        let grows = (self.radii[1] - self.radii[0]) * way.along.dot(self.middle.along);
        leaves && grows <= 4.0 * DIGITS * square
    }
}
