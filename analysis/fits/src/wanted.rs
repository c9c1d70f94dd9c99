//! What is asked of a fit beyond its law and its data.
//!
//! Windows, the variable of a hazard, zones, and the words for the source. Absent: what comes of it (`outcome`).

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
