//! When a film shows what: ages of a plant at the frames of a film, and the length of its pictures in the units of
//! formats.
//!
//! Time goes evenly from the first age at the first frame to the last age at the last. A frame shows the nearest of the
//! ages that there are; of two that are equally near the earlier one. So where a film has more frames than ages each
//! age is held, the first and the last half as long as the others. Absent: what stands at an age.

/// The ages of a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timeline {
    /// The first age, in ticks.
    pub first: f64,
    /// The last age.
    pub last: f64,
    /// The time from one age that there is to the next; above 0.
    pub step: f64,
    /// The frames; at least one.
    pub frames: u32,
}

impl Timeline {
    /// How many ages there are.
    pub fn ages(&self) -> u32 {
        ((self.last - self.first) / self.step + 1e-9).floor().max(0.0).min(f64::from(u32::MAX - 1)) as u32 + 1
    }

    /// The age with a number.
    pub fn age(&self, number: u32) -> f64 {
        self.first + self.step * f64::from(number)
    }

    /// The age that a frame stands for.
    pub fn age_at(&self, frame: u32) -> f64 {
        let last = self.age(self.ages() - 1);
        if self.frames < 2 { last } else { self.first + (last - self.first) * self.share(frame) }
    }

    /// The share of the film that lies before a frame, from 0 at the first to 1 at the last.
    fn share(&self, frame: u32) -> f64 {
        f64::from(frame) / f64::from((self.frames - 1).max(1))
    }

    /// The number of the age that a frame shows: that nearest to the age that it stands for.
    pub fn shown_at(&self, frame: u32) -> u32 {
        let number = (self.age_at(frame) - self.first) / self.step;
        ((number - 0.5 - 1e-9).ceil().max(0.0) as u32).min(self.ages() - 1)
    }

    /// The ages that are shown, by their numbers, each with how many frames show it; in their order.
    pub fn held(&self) -> Vec<(u32, u32)> {
        let mut held: Vec<(u32, u32)> = Vec::new();
        for frame in 0..self.frames {
            let shown = self.shown_at(frame);
            match held.last_mut() {
                Some((age, frames)) if *age == shown => *frames += 1,
                _ => held.push((shown, 1)),
            }
        }
        held
    }
}

/// Frames in a unit of time of which so many make a second: each picture has a whole number of units, and no film is
/// longer or shorter by more than half a unit.
#[derive(Debug, Clone, Copy)]
pub struct Units {
    a_second: u64,
    fps: u64,
    frames: u64,
}

impl Units {
    /// At the beginning of a film.
    pub fn new(a_second: u32, fps: u32) -> Self {
        Self { a_second: a_second.into(), fps: u64::from(fps.max(1)), frames: 0 }
    }

    /// The units of the next picture, which is shown for so many frames.
    pub fn next(&mut self, frames: u32) -> u32 {
        let from = self.so_far();
        self.frames += u64::from(frames);
        u32::try_from(self.so_far() - from).unwrap_or(u32::MAX)
    }

    fn so_far(&self) -> u64 {
        (2 * self.frames * self.a_second + self.fps) / (2 * self.fps)
    }
}
