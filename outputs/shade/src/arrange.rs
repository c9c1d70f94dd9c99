//! Which candidate is planted at which spot: an integer program, solved exactly.
//!
//! The space-planning problem of Aono & Kunii 1984, in the form that the hours of this crate allow: each spot has one
//! candidate or none; what they cost stays within a budget; of two spots in different rows the one farther back never
//! has the lower tree; and each demand, such as the hours of shade of a zone in July, holds for the **sum** of what its
//! candidates add one by one. Sums are linear, so the program is one; what shadows that overlap really add is less, and
//! the caller asks for it afterwards. Where an arrangement then fails a least demand, so does every part of it, since
//! fewer trees shade less: the [`Plan`] takes such arrangements as refused, and the program must choose something
//! beside them. `microlp` proves its answer by branch and bound, without a gap. Absent: hours and plants.

mod conflict;
mod program;
#[cfg(test)]
mod tests;

pub use conflict::conflict;

/// A candidate for each spot, by its number; `None` where the spot stays empty.
pub type Arrangement = Vec<Option<usize>>;

/// What is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// The largest sum of gains.
    Most,
    /// The least sum of gains.
    Least,
    /// The least cost.
    Cheapest,
}

/// What can be planted.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// What one of them costs.
    pub cost: f64,
    /// How high it is, metres.
    pub height_m: f64,
    /// How many there are at most.
    pub at_most: Option<u32>,
}

/// A quantity that must lie within bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Demand {
    /// Its value without any candidate.
    pub base: f64,
    /// What a candidate at a spot adds, spot by spot and in each candidate by candidate.
    pub added: Vec<f64>,
    /// The least that is allowed.
    pub least: Option<f64>,
    /// The most that is allowed.
    pub most: Option<f64>,
}

/// The whole question.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// What can be planted.
    pub candidates: Vec<Candidate>,
    /// For each spot its row, 1 in front; a spot without a row stands before and behind no other.
    pub rows: Vec<Option<u32>>,
    /// The most that all may cost.
    pub budget: Option<f64>,
    /// Whether every spot must be planted.
    pub every_spot: bool,
    /// What is sought.
    pub aim: Aim,
    /// What a candidate at a spot is worth, in the order of [`Demand::added`].
    pub gains: Vec<f64>,
    /// What must hold.
    pub demands: Vec<Demand>,
    /// Arrangements that are no answer, and no part of which is one.
    pub refused: Vec<Arrangement>,
}

/// A rule that an arrangement keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// The budget.
    Budget,
    /// Tall trees stand behind low ones.
    Rows,
    /// Every spot is planted.
    EverySpot,
    /// There are so many of a candidate at most.
    AtMost(usize),
    /// A demand has its least value.
    Least(usize),
    /// A demand does not have more than its most.
    Most(usize),
    /// An arrangement that was refused is not chosen again.
    Refused,
}

/// The solver ended without an answer and without a proof that there is none.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the solver gave up: {0}")]
pub struct Unsolved(pub String);

impl Plan {
    /// The best arrangement; `None` where there is none.
    ///
    /// # Errors
    /// Where the solver itself fails, as at numbers that are none.
    pub fn solve(&self) -> Result<Option<Arrangement>, Unsolved> {
        program::solve(self, &self.rules())
    }

    /// All rules that this plan has, in the order in which a reader would give them up last to first.
    pub fn rules(&self) -> Vec<Rule> {
        let mut rules = Vec::new();
        for (number, demand) in self.demands.iter().enumerate() {
            rules.extend(demand.least.map(|_| Rule::Least(number)));
            rules.extend(demand.most.map(|_| Rule::Most(number)));
        }
        let limited = self.candidates.iter().enumerate().filter(|(_, candidate)| candidate.at_most.is_some());
        rules.extend(limited.map(|(number, _)| Rule::AtMost(number)));
        rules.extend(self.rows.iter().any(Option::is_some).then_some(Rule::Rows));
        rules.extend(self.budget.map(|_| Rule::Budget));
        rules.extend(self.every_spot.then_some(Rule::EverySpot));
        rules.extend((!self.refused.is_empty()).then_some(Rule::Refused));
        rules
    }

    /// Where the value of a candidate at a spot stands in a list.
    pub fn at(&self, spot: usize, candidate: usize) -> usize {
        spot * self.candidates.len() + candidate
    }

    /// What an arrangement costs.
    pub fn cost(&self, arrangement: &Arrangement) -> f64 {
        arrangement.iter().flatten().map(|candidate| self.candidates[*candidate].cost).sum()
    }

    /// The sum of a list's values over an arrangement.
    pub fn sum(&self, of: &[f64], arrangement: &Arrangement) -> f64 {
        let chosen = arrangement.iter().enumerate();
        chosen.filter_map(|(spot, candidate)| candidate.map(|candidate| of[self.at(spot, candidate)])).sum()
    }

    /// The value of a demand by the sum of what the candidates of an arrangement add one by one.
    pub fn demanded(&self, demand: usize, arrangement: &Arrangement) -> f64 {
        self.demands[demand].base + self.sum(&self.demands[demand].added, arrangement)
    }
}
