//! A proportion of plants, with Wilson's interval (Wilson 1927; Brown, Cai & DasGupta 2001, eq. 4).
//!
//! Each plant counts once, as one that has the property or one that has not. A share of buds, axes or leaves is no
//! proportion of plants: `ratio` has its interval.

use crate::{Interval, Lack, quantile};

/// Wilson's interval at `level` of a proportion of which `with` of `plants` plants were found.
///
/// # Errors
/// [`Lack::Empty`] without plants, [`Lack::OutOfRange`] where more plants have the property than there are.
pub fn wilson(with: u64, plants: u64, level: f64) -> Result<Interval, Lack> {
    match plants {
        0 => return Err(Lack::Empty),
        _ if with > plants => return Err(Lack::OutOfRange),
        _ => {}
    }
    let z = quantile::normal_for(level)?;
    let (n, share) = (plants as f64, with as f64 / plants as f64);
    let centre = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let half = z / (1.0 + z * z / n) * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    let interval = Interval::about(centre, half).within(0.0, 1.0);
    Ok(Interval {
        low: if with == 0 { 0.0 } else { interval.low },
        high: if with == plants { 1.0 } else { interval.high },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn none_of_twenty() {
        let none = wilson(0, 20, 0.95).unwrap();
        assert!(none.low == 0.0 && (none.high - 0.1611).abs() < 5e-5, "{none:?}");
        let all = wilson(20, 20, 0.95).unwrap();
        assert!(all.high == 1.0 && (all.low - 0.8389).abs() < 5e-5, "{all:?}");
        assert_eq!((wilson(0, 0, 0.95), wilson(3, 2, 0.95)), (Err(Lack::Empty), Err(Lack::OutOfRange)));
    }
}
