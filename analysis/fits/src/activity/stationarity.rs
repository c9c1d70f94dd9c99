//! Whether growth was steady: the nodes made in windows of equal length, against equal expectations.
//!
//! χ² = Σ (O − E)² / E over the windows, where E shares all nodes in proportion to the axes observed over each whole
//! window. The nodes of a Bernoulli bud vary less than those of the Poisson process that χ² supposes, so the test
//! refuses steady growth less often than its level says. Absent: seasons by name.

use crate::fit::Test;
use crate::problem::Problem;

/// What was seen in a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Axes that were seen at its beginning and at its end.
    pub axes: f64,
    /// The nodes that these made.
    pub nodes: f64,
}

/// The test over windows of equal length.
///
/// # Errors
/// Fewer than two windows, or no nodes in any.
pub fn stationarity(windows: &[Window]) -> Result<Test, Problem> {
    let seen: Vec<Window> = windows.iter().copied().filter(|window| window.axes > 0.0).collect();
    if seen.len() < 2 {
        let (what, purpose) = ("windows with axes", "a test of steady growth");
        return Err(Problem::TooFew { what, found: seen.len(), needed: 2, purpose });
    }
    let (axes, nodes) = seen.iter().fold((0.0, 0.0), |(a, n), window| (a + window.axes, n + window.nodes));
    if nodes <= 0.0 {
        let consequence = "whether growth was steady cannot be told";
        return Err(Problem::Degenerate { what: "no node was made in any window".to_owned(), consequence });
    }
    let off = |window: &Window| {
        let expected = nodes * window.axes / axes;
        (window.nodes - expected) * (window.nodes - expected) / expected
    };
    Ok(Test::chi2("nodes made in windows of equal length", seen.iter().map(off).sum(), seen.len() - 1))
}
