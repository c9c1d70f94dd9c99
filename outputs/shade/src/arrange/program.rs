//! The integer program of a plan: a variable of 0 or 1 for each candidate at each spot.
//!
//! Tall behind low: for a spot in front of another and each height, the front has a taller candidate or the back one of
//! at most this height, not both. As each spot has one candidate at most, these sums are the strongest form of all
//! pairs. Values that are very large are scaled row by row, so that one tolerance of the solver fits all rows.

use super::{Aim, Arrangement, Plan, Rule, Unsolved};
use good_lp::{
    Expression, ProblemVariables, ResolutionError, Solution, SolverModel, Variable, constraint, microlp, variable,
};

/// By how much a demand may be missed, as a share of its largest term: what sums of so many terms are off by.
const ROUNDING: f64 = 1e-9;

/// The best arrangement that keeps some rules.
pub fn solve(plan: &Plan, rules: &[Rule]) -> Result<Option<Arrangement>, Unsolved> {
    let (spots, candidates) = (plan.rows.len(), plan.candidates.len());
    let mut variables = ProblemVariables::new();
    let chosen: Vec<Variable> = (0..spots * candidates).map(|_| variables.add(variable().binary())).collect();
    let worth: Vec<f64> = match plan.aim {
        Aim::Most | Aim::Least => plan.gains.clone(),
        Aim::Cheapest => (0..spots).flat_map(|_| plan.candidates.iter().map(|candidate| candidate.cost)).collect(),
    };
    let scale = largest(&worth);
    let objective = sum(&chosen, worth.iter().map(|worth| worth / scale));
    let problem = if plan.aim == Aim::Most { variables.maximise(objective) } else { variables.minimise(objective) };
    let mut model = problem.using(microlp);
    for spot in 0..spots {
        let one = sum(&chosen[spot * candidates..(spot + 1) * candidates], std::iter::repeat(1.0));
        model.add_constraint(if rules.contains(&Rule::EverySpot) { one.eq(1.0) } else { one.leq(1.0) });
    }
    rules.iter().for_each(|rule| keep(plan, *rule, &chosen, &mut model));
    match model.solve() {
        Ok(solution) => {
            let spot =
                |spot: usize| (0..candidates).find(|candidate| solution.value(chosen[plan.at(spot, *candidate)]) > 0.5);
            Ok(Some((0..spots).map(spot).collect()))
        }
        Err(ResolutionError::Infeasible) => Ok(None),
        Err(error) => Err(Unsolved(error.to_string())),
    }
}

/// Adds the rows of a rule.
fn keep(plan: &Plan, rule: Rule, chosen: &[Variable], model: &mut impl SolverModel) {
    let (spots, candidates) = (plan.rows.len(), plan.candidates.len());
    match rule {
        Rule::EverySpot => {}
        Rule::Budget => {
            let costs: Vec<f64> =
                (0..spots).flat_map(|_| plan.candidates.iter().map(|candidate| candidate.cost)).collect();
            let scale = largest(&costs);
            let most = plan.budget.unwrap_or(f64::MAX) / scale;
            model.add_constraint(sum(chosen, costs.iter().map(|cost| cost / scale)).leq(most + ROUNDING));
        }
        Rule::AtMost(candidate) => {
            let of_it = (0..spots).map(|spot| chosen[plan.at(spot, candidate)]);
            let most = plan.candidates[candidate].at_most.unwrap_or(u32::MAX);
            model.add_constraint(of_it.map(Expression::from).sum::<Expression>().leq(f64::from(most)));
        }
        Rule::Least(demand) | Rule::Most(demand) => {
            let demand = &plan.demands[demand];
            let scale = largest(&demand.added);
            let added = sum(chosen, demand.added.iter().map(|added| added / scale));
            let bound = |of: Option<f64>| (of.unwrap_or(demand.base) - demand.base) / scale;
            model.add_constraint(match rule {
                Rule::Least(_) => added.geq(bound(demand.least) - ROUNDING),
                _ => added.leq(bound(demand.most) + ROUNDING),
            });
        }
        Rule::Rows => {
            for (front, back) in pairs(plan) {
                for height in heights(plan) {
                    let tall = (0..candidates).filter(|candidate| plan.candidates[*candidate].height_m > height);
                    let low = (0..candidates).filter(|candidate| plan.candidates[*candidate].height_m <= height);
                    let both = tall.map(|candidate| plan.at(front, candidate));
                    let both = both.chain(low.map(|candidate| plan.at(back, candidate)));
                    let both = both.map(|place| Expression::from(chosen[place])).sum::<Expression>();
                    model.add_constraint(both.leq(1.0));
                }
            }
        }
        Rule::Refused => {
            for refused in &plan.refused {
                let beside =
                    (0..spots * candidates).filter(|place| refused[place / candidates] != Some(place % candidates));
                let beside = beside.map(|place| Expression::from(chosen[place])).sum::<Expression>();
                model.add_constraint(constraint!(beside >= 1.0));
            }
        }
    }
}

/// Spots in front, each with a spot behind it.
pub fn pairs(plan: &Plan) -> Vec<(usize, usize)> {
    let rows = &plan.rows;
    let all = (0..rows.len()).flat_map(|front| (0..rows.len()).map(move |back| (front, back)));
    all.filter(|(front, back)| matches!((rows[*front], rows[*back]), (Some(front), Some(back)) if front < back))
        .collect()
}

/// The heights of candidates below which another is, each once.
fn heights(plan: &Plan) -> Vec<f64> {
    let mut heights: Vec<f64> = plan.candidates.iter().map(|candidate| candidate.height_m).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    // Nothing is taller than the tallest.
    heights.pop();
    heights
}

fn sum(chosen: &[Variable], factors: impl Iterator<Item = f64>) -> Expression {
    chosen.iter().zip(factors).map(|(variable, factor)| *variable * factor).sum()
}

/// The largest size of some values, 1 where all are 0.
fn largest(of: &[f64]) -> f64 {
    let most = of.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    if most > 0.0 && most.is_finite() { most } else { 1.0 }
}
