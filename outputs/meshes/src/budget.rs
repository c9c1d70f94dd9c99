//! The tolerance with which a mesh has at most so many triangles.
//!
//! Tolerances are tried on a grid of thirty-two steps an octave, from the least tolerance up, by halving: about ten
//! trials, and the same answer wherever it is asked. What is found is checked by its own count, so that a mesh has
//! never more triangles than were asked for, although a coarser mesh may now and then have a few more than a finer one.
//! Absent: what is counted.

use super::Tolerance;
use phytomer_sim::math::exp2;

/// The steps of an octave: neighbouring tolerances differ by 2 %.
const STEPS: u32 = 32;

/// The steps to the largest tolerance, 2²⁴ times the least, 168 m: every axis of any plant is one tube of three sides.
const LAST: u32 = 24 * STEPS;

/// A mesh has more triangles than were asked for, however coarse it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the mesh has at least {least} triangles")]
pub struct TooFew {
    /// The triangles that it has at least.
    pub least: u64,
}

/// The finest tolerance with which `count` tells at most `most` triangles.
///
/// # Errors
/// Where there is none, with the least number of triangles.
pub fn fitting(most: u64, mut count: impl FnMut(&Tolerance) -> u64) -> Result<Tolerance, TooFew> {
    let tolerance = |step: u32| Tolerance::of(Tolerance::LEAST * exp2(f64::from(step) / f64::from(STEPS)) as f32);
    let mut fits = |step: u32| count(&tolerance(step));
    let least = fits(LAST);
    if least > most {
        return Err(TooFew { least });
    }
    // The mesh of `high` fits, that of a step below `low` does not.
    let (mut low, mut high) = (0, LAST);
    while low < high {
        let step = low.midpoint(high);
        if fits(step) <= most { high = step } else { low = step + 1 }
    }
    Ok(tolerance(high))
}

/// The nearest range, metres, at which `count` tells at most `most` triangles: 0, or just beyond one of the `ends` at
/// which something ends to be drawn, of which there are few enough to be searched by halving.
///
/// # Errors
/// Where there is none, with the least number of triangles.
pub fn nearest(most: u64, ends: &[f32], mut count: impl FnMut(f64) -> u64) -> Result<f64, TooFew> {
    let beyond = |place: usize| place.checked_sub(1).map_or(0.0, |place| f64::from(ends[place].next_up()));
    let least = count(beyond(ends.len()));
    if least > most {
        return Err(TooFew { least });
    }
    let (mut low, mut high) = (0, ends.len());
    while low < high {
        let place = low.midpoint(high);
        if count(beyond(place)) <= most { high = place } else { low = place + 1 }
    }
    Ok(beyond(high))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mesh of ten triangles of which one goes at each metre from 1 to 8.
    #[test]
    fn the_nearest_range_that_fits_is_found() {
        let ends: Vec<f32> = (1..=8).map(|metre| metre as f32).collect();
        let count = |metres: f64| 10 - ends.iter().filter(|end| f64::from(**end) < metres).count() as u64;
        assert_eq!(nearest(10, &ends, count), Ok(0.0));
        assert_eq!(nearest(7, &ends, count), Ok(f64::from(3.0_f32.next_up())));
        assert_eq!(nearest(2, &ends, count), Ok(f64::from(8.0_f32.next_up())));
        assert_eq!(nearest(1, &ends, count), Err(TooFew { least: 2 }));
        assert_eq!(nearest(1, &[], |_| 5), Err(TooFew { least: 5 }));
    }

    /// The least number of triangles of an imagined mesh that has 1/e of them and ten more.
    fn imagined(tolerance: &Tolerance) -> u64 {
        10 + (1.0 / f64::from(tolerance.distance)) as u64
    }

    #[test]
    fn the_finest_tolerance_that_fits_is_found_and_the_least_is_told() {
        for most in [11, 100, 20_000, 100_009] {
            let found = fitting(most, imagined).expect("it fits");
            let finer = Tolerance::of(found.distance / 1.03);
            assert!(imagined(&found) <= most && imagined(&finer) > most, "{most}: {found:?}");
        }
        assert_eq!(fitting(1_000_000, imagined).map(|found| found.distance), Ok(Tolerance::LEAST));
        assert_eq!(fitting(9, imagined), Err(TooFew { least: 10 }));
        let mut tried = 0;
        let counted = |tolerance: &Tolerance| {
            tried += 1;
            imagined(tolerance)
        };
        assert!(fitting(1000, counted).is_ok());
        assert!(tried <= 12, "{tried} trials");
    }
}
