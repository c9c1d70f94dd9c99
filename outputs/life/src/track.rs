//! Keyframes of values that change with age: those that linear interpolation would miss by more than a tolerance.
//!
//! Each value has a door, the slopes from the last key that pass all values since within the tolerance; a value whose
//! slope does not pass through the door makes a key of the value before it (swinging door, Bristol 1990, US patent
//! 4 669 097, expired). A track remembers its last key, the last value and the door, whatever the number of ages.

/// Values at an age, in ticks.
pub type Key<const N: usize> = (f32, [f32; N]);

/// A track that is being made.
#[derive(Debug, Clone, Copy)]
pub struct Track<const N: usize> {
    key: Key<N>,
    last: Key<N>,
    /// The age until which the last values have held.
    held: f32,
    low: [f32; N],
    high: [f32; N],
}

impl<const N: usize> Track<N> {
    /// A track that begins with this key, which the caller keeps.
    pub fn begin(key: Key<N>) -> Self {
        Self { key, last: key, held: key.0, low: [f32::NEG_INFINITY; N], high: [f32::INFINITY; N] }
    }

    /// Takes the values of a later age; the key that is to be kept, if it makes one. Each value of the ages between two
    /// keys is within its tolerance of linear interpolation.
    #[inline]
    pub fn add(&mut self, age: f32, values: [f32; N], tolerance: &[f32; N]) -> Option<Key<N>> {
        let over = 1.0 / (age - self.key.0);
        let passes = (0..N).all(|k| {
            let slope = (values[k] - self.key.1[k]) * over;
            self.low[k] <= slope && slope <= self.high[k]
        });
        let made = if passes { None } else { Some(self.last) };
        if let Some(key) = made {
            *self = Self::begin(key);
        }
        let over = 1.0 / (age - self.key.0);
        for k in 0..N {
            let gained = values[k] - self.key.1[k];
            self.low[k] = self.low[k].max((gained - tolerance[k]) * over);
            self.high[k] = self.high[k].min((gained + tolerance[k]) * over);
        }
        (self.last, self.held) = ((age, values), age);
        made
    }

    /// Tells whether these are the last values.
    #[inline]
    pub fn has(&self, values: &[f32; N]) -> bool {
        self.last.1 == *values
    }

    /// The last values hold at a later age too. Of such ages the last alone is taken ([`Track::catch_up`]): a straight
    /// line that passes equal values at two ages within a tolerance passes them at all ages between.
    #[inline]
    pub fn hold(&mut self, age: f32) {
        self.held = age;
    }

    /// Takes the last age of those at which the last values have held, before other values are added; the key that is
    /// to be kept, if it makes one.
    #[inline]
    pub fn catch_up(&mut self, tolerance: &[f32; N]) -> Option<Key<N>> {
        if self.held > self.last.0 { self.add(self.held, self.last.1, tolerance) } else { None }
    }

    /// The last key.
    #[inline]
    pub fn key(&self) -> Key<N> {
        self.key
    }

    /// The values that were taken last.
    pub fn latest(&self) -> [f32; N] {
        self.last.1
    }

    /// The last key; `None` where the key before, which holds from then on, is within the tolerance of all that came.
    pub fn end(&self) -> Option<Key<N>> {
        let holds = (0..N).all(|k| self.low[k] <= 0.0 && 0.0 <= self.high[k]);
        (!holds).then_some(self.last)
    }
}

/// The values at an age between keys, which must be in the order of their ages and at least one: linear between two,
/// the first before all, the last after all.
pub fn between<const N: usize>(keys: &[Key<N>], age: f32) -> [f32; N] {
    some_between(keys, age, 0)
}

/// As [`between`], of the values from a place on.
#[inline]
pub fn some_between<const N: usize, const M: usize>(keys: &[Key<N>], age: f32, first: usize) -> [f32; M] {
    let after = first_after(keys, age);
    let (Some((from, low)), Some((to, high))) = (keys.get(after.wrapping_sub(1)), keys.get(after)) else {
        let held = keys.get(after.saturating_sub(1));
        return held.map_or([0.0; M], |(_, values)| std::array::from_fn(|k| values[first + k]));
    };
    let share = (age - from) / (to - from);
    std::array::from_fn(|k| low[first + k] + share * (high[first + k] - low[first + k]))
}

/// The place of the first key after an age. Most tracks have few keys, and most ages are after all of them.
#[inline]
fn first_after<const N: usize>(keys: &[Key<N>], age: f32) -> usize {
    if keys.last().is_some_and(|(at, _)| *at <= age) {
        return keys.len();
    }
    keys.partition_point(|(at, _)| *at <= age)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(values: &[f32], tolerance: f32) -> Vec<Key<1>> {
        let mut ages = values.iter().enumerate().map(|(age, value)| (age as f32, [*value]));
        let mut kept: Vec<Key<1>> = ages.next().into_iter().collect();
        let mut track = Track::begin(kept[0]);
        kept.extend(ages.filter_map(|(age, value)| track.add(age, value, &[tolerance])).collect::<Vec<_>>());
        kept.extend(track.end());
        kept
    }

    #[test]
    fn what_is_linear_needs_its_ends_and_what_stands_still_one_key() {
        assert_eq!(keys(&[1.0; 50], 0.1), [(0.0, [1.0])]);
        let line: Vec<f32> = (0..50).map(|k| 2.0 * k as f32).collect();
        assert_eq!(keys(&line, 0.1), [(0.0, [0.0]), (49.0, [98.0])]);
        let mut jump = vec![0.0; 20];
        jump[10..].fill(5.0);
        assert_eq!(keys(&jump, 0.1), [(0.0, [0.0]), (9.0, [0.0]), (10.0, [5.0])]);
        assert_eq!(keys(&[3.0], 0.1), [(0.0, [3.0])]);
        assert_eq!(keys(&[3.0, 4.0], 0.1), [(0.0, [3.0]), (1.0, [4.0])]);
    }

    /// Whatever the course, each value is within the tolerance of what the keys give back at its age, and a wider
    /// tolerance keeps fewer keys.
    #[test]
    fn every_value_comes_back_within_the_tolerance() {
        let course: Vec<f32> = (0..400_u32)
            .map(|k| {
                let noise = (k.wrapping_mul(2_654_435_761) >> 16) as f32 / 65_536.0;
                phytomer_sim::math::sinf(k as f32 * 0.05) + 0.02 * noise
            })
            .collect();
        let mut before = usize::MAX;
        for tolerance in [0.001, 0.01, 0.05, 0.3] {
            let kept = keys(&course, tolerance);
            for (age, value) in course.iter().enumerate() {
                let [found] = between(&kept, age as f32);
                assert!((found - value).abs() <= tolerance * 1.001, "{tolerance} at {age}: {found} {value}");
            }
            assert!(kept.len() < before, "{tolerance}: {}", kept.len());
            before = kept.len();
        }
        assert!(before < 30);
    }

    /// Values that hold cost nothing, and come back as well as others.
    #[test]
    fn values_that_hold_come_back_too() {
        let course = |age: u32| [age, 10, 10, 10 + (age - age.min(60)), 30][(age.min(99) / 25) as usize] as f32;
        let mut track = Track::begin((0.0, [course(0)]));
        let mut kept = vec![(0.0, [course(0)])];
        for age in 1..125 {
            let values = [course(age)];
            if track.has(&values) {
                track.hold(age as f32);
            } else {
                kept.extend(track.catch_up(&[0.25]));
                kept.extend(track.add(age as f32, values, &[0.25]));
            }
        }
        kept.extend(track.end());
        for age in 0..125 {
            let [found] = between(&kept, age as f32);
            assert!((found - course(age)).abs() <= 0.2501, "{found} at {age}: {kept:?}");
        }
        assert!(kept.len() < 12, "{kept:?}");
    }

    #[test]
    fn keys_hold_before_the_first_and_after_the_last() {
        let kept = [(2.0, [1.0, 0.0]), (4.0, [3.0, -2.0])];
        assert_eq!([0.0, 2.0, 3.0, 4.0, 9.0].map(|age| between(&kept, age)[0]), [1.0, 1.0, 2.0, 3.0, 3.0]);
        assert_eq!(between::<2>(&[], 1.0), [0.0; 2]);
    }
}
