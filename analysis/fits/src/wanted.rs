//! What is asked of a fit beyond its law and its data.
//!
//! Windows, the variable of a hazard, zones, and the words for the source. Absent: what comes of it (`outcome`).

use std::collections::BTreeMap;

/// What is asked of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Wanted {
    /// The first and the last day of the window in which nodes are counted; without it waiting times are fitted.
    pub window: Option<(u32, u32)>,
    /// Waits begun before this day are used.
    pub before: Option<u32>,
    /// The variable of a hazard.
    pub over: String,
    /// The ranks of a zone.
    pub zone: usize,
    /// The zones of a chain.
    pub chain: usize,
    /// The fate of buds that bear nothing.
    pub latent: String,
    /// From which end ranks are counted: `tip` or `base`.
    pub from: String,
    /// Where the data come from, for the `source` of each law.
    pub source: String,
}

/// The days of a wait of waiting times that the record must still have after its beginning, as a share of it.
const LAST_SHARE: f64 = 2.0 / 3.0;

impl Wanted {
    /// The day before which waits of these axes begin.
    pub fn begun_before(&self, axes: &[BTreeMap<u32, u32>]) -> u32 {
        let last = axes.iter().filter_map(|days| days.keys().next_back()).max().copied().unwrap_or(0);
        self.before.unwrap_or((f64::from(last) * LAST_SHARE) as u32)
    }
}

impl Default for Wanted {
    fn default() -> Self {
        Self {
            window: None,
            before: None,
            over: "cycle".to_owned(),
            zone: 6,
            chain: 6,
            latent: "latent".to_owned(),
            from: "tip".to_owned(),
            source: String::new(),
        }
    }
}
