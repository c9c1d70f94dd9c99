//! Lives counted by duration, once for all plants and once for each cluster of plants.
//!
//! A run may have a million plants, so at most [`CLUSTERS`] tables are kept: up to that number each plant has its own,
//! more plants are dealt into them in turn, as in a delete-a-group jackknife (Kott 2001). So memory depends on the
//! longest life and not on the number of lives. Absent: any estimate.

/// The greatest number of clusters of plants.
pub const CLUSTERS: u32 = 256;

/// How a life came to be known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It ended by the cause with this number.
    Ended(usize),
    /// It was still going on when it was seen last.
    Censored,
}

/// Lives by duration.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    /// The lives that ended, by cause and duration.
    pub by_cause: Vec<Vec<u32>>,
    /// The lives that were censored, by duration.
    pub censored: Vec<u32>,
}

/// The lives of one group of plants.
#[derive(Debug, Clone, Default)]
pub struct Lives {
    pub(super) clusters: Vec<Table>,
    lives: u64,
    ended: u64,
    last: usize,
    causes: usize,
}

/// One more in the cell of a duration, making cells up to it.
fn count(cells: &mut Vec<u32>, at: usize) {
    if cells.len() <= at {
        cells.resize(at + 1, 0);
    }
    cells[at] = cells[at].saturating_add(1);
}

impl Lives {
    /// Adds the life of a unit of a plant, in ticks. Plants are numbered as the caller likes.
    pub fn add(&mut self, plant: u32, ticks: u32, fate: Fate) {
        let (cluster, ticks) = ((plant % CLUSTERS) as usize, ticks as usize);
        if self.clusters.len() <= cluster {
            self.clusters.resize_with(cluster + 1, Table::default);
        }
        let table = &mut self.clusters[cluster];
        match fate {
            Fate::Censored => count(&mut table.censored, ticks),
            Fate::Ended(cause) => {
                if table.by_cause.len() <= cause {
                    table.by_cause.resize(cause + 1, Vec::new());
                }
                count(&mut table.by_cause[cause], ticks);
                self.ended += 1;
                self.causes = self.causes.max(cause + 1);
            }
        }
        self.lives += 1;
        self.last = self.last.max(ticks);
    }

    /// The number of lives.
    pub fn len(&self) -> u64 {
        self.lives
    }

    /// Whether there is no life.
    pub fn is_empty(&self) -> bool {
        self.lives == 0
    }

    /// The number of lives that ended before they were censored.
    pub fn ended(&self) -> u64 {
        self.ended
    }

    /// The number of causes by which lives ended, up to the highest that occurs.
    pub fn causes(&self) -> usize {
        self.causes
    }

    /// The number of durations from 0 to the longest life.
    pub(super) fn durations(&self) -> usize {
        if self.lives == 0 { 0 } else { self.last + 1 }
    }

    /// The number of clusters that have a life.
    pub fn clusters(&self) -> u64 {
        self.clusters.iter().filter(|table| !table.is_empty()).count() as u64
    }

    /// All lives in one table, over `durations`.
    pub(super) fn whole(&self, durations: usize) -> Counts {
        let mut whole = Counts::zero(durations, self.causes);
        self.clusters.iter().for_each(|table| whole.add(table));
        whole.settle();
        whole
    }
}

impl Table {
    pub(super) fn is_empty(&self) -> bool {
        self.censored.is_empty() && self.by_cause.is_empty()
    }

    /// The table over `durations`, with its numbers at risk.
    pub(super) fn counts(&self, durations: usize, causes: usize) -> Counts {
        let mut counts = Counts::zero(durations, causes);
        counts.add(self);
        counts.settle();
        counts
    }
}

/// A life table: what ended, what was censored and what was at risk at each duration.
#[derive(Debug, Clone)]
pub(super) struct Counts {
    pub by_cause: Vec<Vec<f64>>,
    pub ended: Vec<f64>,
    pub censored: Vec<f64>,
    pub at_risk: Vec<f64>,
}

impl Counts {
    fn zero(durations: usize, causes: usize) -> Self {
        let zero = vec![0.0; durations];
        Self { by_cause: vec![zero.clone(); causes], ended: zero.clone(), censored: zero.clone(), at_risk: zero }
    }

    fn add(&mut self, table: &Table) {
        let put = |into: &mut [f64], from: &[u32]| into.iter_mut().zip(from).for_each(|(a, b)| *a += f64::from(*b));
        put(&mut self.censored, &table.censored);
        self.by_cause.iter_mut().zip(&table.by_cause).for_each(|(into, from)| put(into, from));
    }

    /// Sums over causes, and the numbers at risk from the longest life down.
    fn settle(&mut self) {
        let mut standing = 0.0;
        for at in (0..self.ended.len()).rev() {
            self.ended[at] = self.by_cause.iter().map(|cause| cause[at]).sum();
            standing += self.ended[at] + self.censored[at];
            self.at_risk[at] = standing;
        }
    }

    /// The hazard at a duration: the share of those at risk that ended.
    pub(super) fn hazard(&self, at: usize) -> f64 {
        if self.at_risk[at] > 0.0 { self.ended[at] / self.at_risk[at] } else { 0.0 }
    }
}
