//! The streams of the lines of a life: the points of each, with their keyframes.
//!
//! Places are whole numbers of a step, a quarter of the page's tolerance; radii are on the logarithmic scale, so that
//! twigs are as exact as trunks. The first key of a point is told as the difference to that of the point before it on
//! its line, of the first point to that of its host; further keys to the key before.

use super::hosts::{HostStreams, Hosts};
use super::streams::{Last, Stream, Streams, linear, logarithmic};
use super::{Numbering, Scale};
use phytomer_life::{Key, Life, Point};

/// The streams of the keyframes of colours.
#[derive(Debug, Default)]
pub struct Tints {
    counts: Stream,
    ages: Stream,
    channels: [Stream; 3],
    last: [Last; 3],
}

impl Tints {
    /// Adds the keyframes of a colour.
    pub fn put(&mut self, keys: &[Key<3>], numbering: &Numbering) {
        self.counts.put(keys.len() as i64);
        let mut age = Last::default();
        let mut last = self.last;
        for (number, (at, tint)) in keys.iter().enumerate() {
            let step = age.step(numbering.place(*at));
            if number > 0 {
                self.ages.put(step);
            }
            for ((channel, last), value) in self.channels.iter_mut().zip(&mut last).zip(tint) {
                channel.put(last.step(linear(f64::from(*value), 1.0)));
            }
            if number == 0 {
                self.last = last;
            }
        }
    }

    /// Their streams.
    pub fn streams(self) -> [(&'static str, Stream); 5] {
        let [red, green, blue] = self.channels;
        [("tints", self.counts), ("tint_ages", self.ages), ("red", red), ("green", green), ("blue", blue)]
    }
}

#[derive(Debug, Default)]
struct Points {
    components: Stream,
    flags: Stream,
    from: Stream,
    lasts: Stream,
    counts: Stream,
    ages: Stream,
    places: [Stream; 4],
    last: [Last; 2],
}

/// Writes the streams of all lines of a life.
pub fn write(life: &Life, scale: &Scale, numbering: &Numbering, hosts: &mut Hosts, streams: &mut Streams, name: &str) {
    let [mut axes, mut orders, mut counts]: [Stream; 3] = Default::default();
    let (mut hosted, mut points, mut tints) = (HostStreams::default(), Points::default(), Tints::default());
    let mut axis = Last::default();
    for (number, line) in (0..).zip(&life.lines) {
        let own = &life.points[line.points.clone()];
        axes.put(axis.step(i64::from(line.axis)));
        orders.put(i64::from(line.order));
        counts.put(own.len() as i64);
        // The first point of the line as it first stood.
        let first = own.iter().min_by(|a, b| a.from.total_cmp(&b.from));
        let host = first.and_then(|first| {
            let (_, [x, y, z, _]) = life.places(first).first().copied()?;
            hosts.find(line.bearer?, [x, y, z], first.from, number)
        });
        hosted.put(host.as_ref());
        let mut last = hosts.first_of(host.as_ref()).map_or([Last::default(); 4], |at| scale.of_place(at));
        for point in own {
            points.put(point, life.places(point), &mut last, scale, numbering);
            tints.put(life.tints_of_point(point), numbering);
        }
    }
    let lines = [("axis", axes), ("order", orders), ("points", counts)];
    streams.add(&format!("{name}.line"), lines);
    streams.add(&format!("{name}.line"), [("host", hosted.points), ("share", hosted.shares)]);
    points.add(&format!("{name}.point"), streams);
    streams.add(&format!("{name}.point"), tints.streams());
}

impl Points {
    fn put(&mut self, point: &Point, keys: &[Key<4>], last: &mut [Last; 4], scale: &Scale, numbering: &Numbering) {
        self.components.put(self.last[0].step(i64::from(point.component)));
        self.flags.put(i64::from(point.end) + 2 * i64::from(point.tip));
        let from = numbering.place(point.from);
        self.from.put(self.last[1].step(from));
        self.lasts.put(numbering.lasts(point.from, point.death));
        self.counts.put(keys.len() as i64);
        let (mut age, mut track) = (Last::default(), *last);
        for (number, (at, [x, y, z, radius])) in keys.iter().enumerate() {
            let step = age.step(numbering.place(*at));
            if number > 0 {
                self.ages.put(step);
            }
            let values = scale.places([*x, *y, *z]).into_iter().chain([logarithmic(f64::from(*radius))]);
            for ((stream, last), value) in self.places.iter_mut().zip(&mut track).zip(values) {
                stream.put(last.step(value));
            }
            if number == 0 {
                *last = track;
            }
        }
    }

    fn add(self, name: &str, streams: &mut Streams) {
        let [x, y, z, radius] = self.places;
        streams.add(name, [("component", self.components), ("flags", self.flags), ("from", self.from)]);
        streams.add(name, [("lasts", self.lasts), ("keys", self.counts), ("ages", self.ages)]);
        streams.add(name, [("x", x), ("y", y), ("z", z), ("radius", radius)]);
    }
}
