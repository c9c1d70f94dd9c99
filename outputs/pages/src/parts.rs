//! The streams of the parts of a life: organs, and internodes that are drawn by themselves, with their keyframes.
//!
//! A part is a form of the page's list (`forms`) in a frame and of a size. Its place is told as the difference to that
//! to which its host has carried it (`carried`), its frame as a unit quaternion without its largest component, as
//! finely as its size asks, its sizes on the logarithmic scale. Parts of one form stand together.

use super::carried::{Carried, Carriers};
use super::forms::Forms;
use super::hosts::{HostStreams, Hosts};
use super::streams::{Last, OCTAVE, Stream, Streams, linear, logarithmic};
use super::wood::Tints;
use super::{Numbering, Scale};
use phytomer_life::{Key, Life, Part, What};

/// The exponents of the finest and of the coarsest steps of a component of a quaternion, and that of forms that state
/// no size in metres.
const FINEST: i64 = 12;
const COARSEST: i64 = 6;
const OF_SHARES: i64 = 10;

#[derive(Debug, Default)]
struct Keys {
    counts: Stream,
    ages: Stream,
    places: [Stream; 3],
    largest: Stream,
    turns: [Stream; 3],
    sizes: [Stream; 3],
    last: [Last; 3],
}

/// Writes the streams of all parts of a life, form by form.
pub fn write(
    life: &Life,
    (scale, numbering): (&Scale, &Numbering),
    hosts: &mut Hosts,
    forms: &mut Forms,
    streams: &mut Streams,
    name: &str,
) {
    let of_form: Vec<u32> = life.parts.iter().map(|part| forms.of(part, life)).collect();
    let mut order: Vec<usize> = (0..life.parts.len()).collect();
    order.sort_by_key(|place| of_form[*place]);
    let [mut components, mut of, mut fullness]: [Stream; 3] = Default::default();
    let [mut from, mut lasts] = [Stream::default(), Stream::default()];
    let [mut component, mut form, mut full, mut first] = [Last::default(); 4];
    let (mut hosted, mut keys, mut tints) = (HostStreams::default(), Keys::default(), Tints::default());
    let carriers = Carriers::of(life, scale, numbering);
    for place in order {
        let part = &life.parts[place];
        components.put(component.step(i64::from(part.component)));
        of.put(form.step(i64::from(of_form[place])));
        fullness.put(full.step(logarithmic(f64::from(part.fullness))));
        from.put(first.step(numbering.place(part.from)));
        lasts.put(numbering.lasts(part.from, part.death));
        let poses = life.poses(part);
        let host =
            poses.first().and_then(|(_, [x, y, z, ..])| hosts.find(part.axis, [*x, *y, *z], part.from, u32::MAX));
        hosted.put(host.as_ref());
        let carried = host.map(|host| carriers.begin(&host, numbering.place(part.from)));
        let carry = |number: i64| carried.map_or([0; 3], |carried: Carried| carriers.place(&carried, number));
        keys.put(poses, &carry, part, scale, numbering);
        tints.put(life.tints_of_part(part), numbering);
    }
    let name = &format!("{name}.part");
    streams.add(name, [("component", components), ("form", of), ("fullness", fullness)]);
    streams.add(name, [("from", from), ("lasts", lasts), ("host", hosted.points), ("share", hosted.shares)]);
    keys.add(name, streams);
    streams.add(name, tints.streams());
}

impl Keys {
    fn put(
        &mut self,
        keys: &[Key<12>],
        carry: &dyn Fn(i64) -> [i64; 3],
        part: &Part,
        scale: &Scale,
        numbering: &Numbering,
    ) {
        self.counts.put(keys.len() as i64);
        let (mut age, mut off, mut size) = (Last::default(), [Last::default(); 3], self.last);
        let mut turn = (usize::MAX, [0; 3]);
        let mut exponent = 0;
        for (number, (at, pose)) in keys.iter().enumerate() {
            let now = numbering.place(*at);
            let step = age.step(now);
            if number > 0 {
                self.ages.put(step);
            }
            let (base, there) = (scale.places([pose[0], pose[1], pose[2]]), carry(now));
            for (((stream, last), value), there) in self.places.iter_mut().zip(&mut off).zip(base).zip(there) {
                stream.put(last.step(value - there));
            }
            let sizes = [pose[9], pose[10], pose[11]].map(|size| logarithmic(f64::from(size)));
            let told = if matches!(part.what, What::Internode | What::Surface(_)) { 3 } else { 2 };
            for ((stream, last), value) in self.sizes.iter_mut().zip(&mut size).zip(sizes).take(told) {
                stream.put(last.step(value));
            }
            if number == 0 {
                self.last = size;
                exponent = exponent_of(part, sizes, scale.near);
            }
            let turned = quaternion([pose[3], pose[4], pose[5]], [pose[6], pose[7], pose[8]]);
            self.put_turn(turned, exponent, &mut turn);
        }
    }

    /// Adds a frame: the largest component of its quaternion, and the three others in their order.
    fn put_turn(&mut self, turn: [f32; 4], exponent: i64, last: &mut (usize, [i64; 3])) {
        let largest = (0..4).fold(0, |most, k| if turn[k].abs() > turn[most].abs() { k } else { most });
        let steps = (1_i64 << exponent) as f32;
        let sign = if turn[largest] < 0.0 { -steps } else { steps };
        let mut others = (0..4).filter(|k| *k != largest).map(|k| linear(f64::from(sign * turn[k]), 1.0));
        let others: [i64; 3] = std::array::from_fn(|_| others.next().unwrap_or(0));
        self.largest.put(largest as i64);
        let before = if last.0 == largest { last.1 } else { [0; 3] };
        for ((stream, value), before) in self.turns.iter_mut().zip(others).zip(before) {
            stream.put(value - before);
        }
        *last = (largest, others);
    }

    fn add(self, name: &str, streams: &mut Streams) {
        streams.add(name, [("keys", self.counts), ("ages", self.ages), ("largest", self.largest)]);
        for (names, values) in
            [(["x", "y", "z"], self.places), (["a", "b", "c"], self.turns), (["length", "width", "tip"], self.sizes)]
        {
            names.into_iter().zip(values).for_each(|stream| streams.add(name, [stream]));
        }
    }
}

/// The exponent of two of the steps of a part's turns: the tip of a part as long as its first key says moves by less
/// than the tolerance from step to step.
fn exponent_of(part: &Part, [length, width, _]: [i64; 3], near: i64) -> i64 {
    match part.what {
        What::Outlined(_) | What::Surface(_) => OF_SHARES,
        What::Organ(_) | What::Near(_) | What::Internode => {
            ((length.max(width) - near).div_euclid(OCTAVE as i64) + 2).clamp(COARSEST, FINEST)
        }
    }
}

/// The unit quaternion (x, y, z, w) that turns the axes x, y and z into the heading, the left and the upper side.
fn quaternion(heading: [f32; 3], up: [f32; 3]) -> [f32; 4] {
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |v: [f32; 3]| {
        let length = dot(v, v).sqrt();
        if length > 0.0 { v.map(|x| x / length) } else { v }
    };
    let x = unit(heading);
    let along = dot(up, x);
    let z = unit([0, 1, 2].map(|k| up[k] - along * x[k]));
    let y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
    // Four times the square of each component (Shepperd 1978); the largest gives the others.
    let squares =
        [1.0 + x[0] - y[1] - z[2], 1.0 - x[0] + y[1] - z[2], 1.0 - x[0] - y[1] + z[2], 1.0 + x[0] + y[1] + z[2]];
    let largest = (0..4).fold(0, |most, k| if squares[k] > squares[most] { k } else { most });
    let root = squares[largest].max(0.0).sqrt();
    if root <= 0.0 || root.is_nan() {
        return [0.0, 0.0, 0.0, 1.0];
    }
    let half = 0.5 / root;
    let [xy, xz, yz] = [x[1] + y[0], x[2] + z[0], y[2] + z[1]];
    let [wx, wy, wz] = [y[2] - z[1], z[0] - x[2], x[1] - y[0]];
    let products = match largest {
        0 => [squares[0], xy, xz, wx],
        1 => [xy, squares[1], yz, wy],
        2 => [xz, yz, squares[2], wz],
        _ => [wx, wy, wz, squares[3]],
    };
    products.map(|product| product * half)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turned by its quaternion, each axis is the direction that was told.
    #[test]
    fn a_quaternion_turns_the_axes_into_the_frame() {
        let frames = [
            ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
            ([-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
            ([0.6, 0.0, 0.8], [-0.8, 0.0, 0.6]),
            ([0.0, -1.0, 0.0], [0.0, 0.0, 1.0]),
        ];
        for (heading, up) in frames {
            let [x, y, z, w] = quaternion(heading, up);
            assert!((x * x + y * y + z * z + w * w - 1.0).abs() < 1e-6);
            let along = [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)];
            let above = [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)];
            for k in 0..3 {
                assert!((along[k] - heading[k]).abs() < 1e-6 && (above[k] - up[k]).abs() < 1e-6, "{heading:?} {up:?}");
            }
        }
        assert!(quaternion([0.0; 3], [0.0; 3]).iter().all(|x| x.is_finite()));
    }
}
