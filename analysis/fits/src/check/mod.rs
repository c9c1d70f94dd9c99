//! Whether a fit can be believed: refits of simulated data, a measure that was not fitted, and cross-validation.
//!
//! (a) Data of the same design are drawn from the law that was taken and fitted again (`design`): bias of each
//! parameter, and how often its interval holds the value that was drawn from (parametric bootstrap, Efron & Tibshirani
//! 1993 §6.5). (b) A measure that is no part of the fit is compared with those of the drawn data (Gelman, Meng & Stern
//! 1996). (c) Parts of the plants are left out in turn and predicted by the laws of the others (`left_out`). Absent:
//! designs of unequal windows.

mod design;
mod left_out;

use crate::data::{Data, Table};
use crate::draws::Draws;
use crate::fit::Estimate;
use crate::mortality::Observed;
use crate::outcome::Outcome;
use crate::special::proportion_interval;
use crate::wanted::Wanted;
use design::Design;

/// What is checked.
#[derive(Clone, Copy)]
pub struct Material<'a> {
    /// The fit.
    pub outcome: &'a Outcome,
    /// The data that were fitted.
    pub data: &'a Data,
    /// The table that they were read from.
    pub table: &'a Table,
    /// What was asked for.
    pub wanted: &'a Wanted,
}

/// What came of the refits for a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Refitted {
    /// The parameter.
    pub name: String,
    /// The value that was drawn from.
    pub truth: f64,
    /// The mean of the refits less the truth.
    pub bias: f64,
    /// The standard error of the bias.
    pub error: f64,
    /// The share of intervals that hold the truth, with its exact interval of 95 %; `None` where the estimate has no
    /// interval.
    pub coverage: Option<(f64, [f64; 2])>,
}

/// A measure that was not fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Predicted {
    /// The measure.
    pub name: &'static str,
    /// Of the data.
    pub measured: f64,
    /// Mean of the drawn data.
    pub mean: f64,
    /// The share of drawn data with at least the measured value.
    pub above: f64,
}

/// The check of a fit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Checked {
    /// Refits that could be made, of how many.
    pub refits: (usize, usize),
    /// Parameters.
    pub parameters: Vec<Refitted>,
    /// The measure that was not fitted.
    pub predicted: Option<Predicted>,
    /// Laws with the mean ln L of an observation that was left out; empty where the data are not divided.
    pub left_out: Vec<(String, f64)>,
}

/// Checks an outcome by so many refits.
pub fn check(material: &Material<'_>, times: usize, seed: u64) -> Checked {
    let mut checked = Checked { left_out: left_out::left_out(material), ..Checked::default() };
    let Some(design) = Design::of(material) else { return checked };
    let own = measure(material.data);
    let (mut fits, mut above, mut sum) = (Vec::new(), 0, 0.0);
    for time in 0..times {
        let drawn = design.draw(&mut Draws::new(seed, time as u64));
        if let Some((_, measured)) = own {
            let value = measure(&drawn).map_or(f64::NAN, |measure| measure.1);
            above += usize::from(value >= measured);
            sum += value;
        }
        fits.extend(design.refit(&drawn));
    }
    checked.refits = (fits.len(), times);
    checked.predicted = own.filter(|_| sum.is_finite()).map(|(name, measured)| {
        let n = times.max(1) as f64;
        Predicted { name, measured, mean: sum / n, above: above as f64 / n }
    });
    let truth = design.truth(material.outcome.taken());
    checked.parameters = truth.iter().filter_map(|own| refitted(&own.name, own.value, &fits)).collect();
    checked
}

fn refitted(name: &str, truth: f64, fits: &[Vec<Estimate>]) -> Option<Refitted> {
    let of = |fit: &'_ Vec<Estimate>| fit.iter().find(|estimate| estimate.name == name).cloned();
    let found: Vec<Estimate> = fits.iter().filter_map(of).filter(|estimate| estimate.value.is_finite()).collect();
    let n = found.len() as f64;
    if found.len() < 10 {
        return None;
    }
    let bias = found.iter().map(|e| e.value - truth).sum::<f64>() / n;
    let variance = found.iter().map(|e| (e.value - truth - bias) * (e.value - truth - bias)).sum::<f64>() / (n - 1.0);
    let holds =
        found.iter().filter(|e| e.low.is_none_or(|low| low <= truth) && e.high.is_none_or(|high| truth <= high));
    let holds = holds.count() as f64;
    let has_limits = found.iter().any(|e| e.low.is_some() || e.high.is_some());
    let (coverage, within) = (holds / n, proportion_interval(holds, n, 0.05));
    let coverage = has_limits.then_some((coverage, within));
    Some(Refitted { name: name.to_owned(), truth, bias, error: (variance / n).sqrt(), coverage })
}

/// A measure that no estimator uses.
fn measure(data: &Data) -> Option<(&'static str, f64)> {
    match data {
        Data::Counts { nodes, .. } => Some(("the largest number of nodes", f64::from(*nodes.iter().max()?))),
        Data::Mortality(Observed::Followed(axes)) => {
            let mut ages: Vec<f64> = axes.iter().filter(|axis| axis.died).map(|axis| axis.age).collect();
            ages.sort_by(f64::total_cmp);
            Some(("the median age of those that died", *ages.get(ages.len() / 2)?))
        }
        Data::Nodes(counts) => {
            let last = counts.iter().rposition(|count| *count > 0.0)?;
            Some(("the largest number of nodes", last as f64))
        }
        Data::Crown(pairs) => {
            let equal = pairs.iter().filter(|pair| pair.nodes[0] == pair.nodes[1]).count();
            Some(("the share of pairs of equal branches", equal as f64 / pairs.len() as f64))
        }
        Data::Days(axes) => {
            let made = axes.iter().filter_map(|days| Some(days.values().next_back()? - days.values().next()?));
            let made: Vec<f64> = made.map(f64::from).collect();
            Some(("the nodes that an axis makes", made.iter().sum::<f64>() / made.len() as f64))
        }
        Data::Branching(shoots, _) => Some(("the number of runs of equal fates", shoots.runs() as f64)),
        Data::Mortality(Observed::SeenOnce(_)) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{Law, columns, read};
    use crate::outcome::fit;

    fn checked(law: Law, sample: &str, wanted: &Wanted, times: usize) -> Checked {
        let table = Table::from_csv("t.csv", sample.as_bytes()).unwrap();
        let data = read(law, &table).unwrap();
        let outcome = fit(law, &data, wanted).unwrap();
        check(&Material { outcome: &outcome, data: &data, table: &table, wanted }, times, 1988)
    }

    fn sample(words: &str) -> &'static str {
        columns::LAWS.iter().find(|law| law.1 == words).unwrap().3
    }

    /// 200 refits: the coverage of 95 % lies within 4 errors, .015 each, of itself.
    #[test]
    fn refits_of_what_was_drawn_hold_the_truth() {
        for (law, words) in [(Law::Activity, "activity"), (Law::Mortality, "mortality, seen once")] {
            let checked = checked(law, sample(words), &Wanted::default(), 200);
            assert!(checked.refits.0 >= 190, "{words}: {:?}", checked.refits);
            assert!(!checked.parameters.is_empty());
            for parameter in &checked.parameters {
                println!("{words}: {parameter:?}");
                let Some((coverage, within)) = parameter.coverage else { continue };
                assert!((coverage - 0.95).abs() <= 0.062, "{words}: {parameter:?}");
                assert!(within[0] <= coverage && coverage <= within[1]);
            }
        }
    }

    /// Forty axes for 400 days, b = .8, ticks of 12 days with a deviation of 2, drawn here and not by the check.
    fn days() -> String {
        let mut draws = Draws::new(7, 1);
        let mut text = "plant,axis,day,nodes\n".to_owned();
        for axis in 0..40 {
            text.push_str(&format!("p{},a{axis},0,0\n", axis / 2));
            let (mut day, mut nodes) = (f64::from(axis % 12), 0);
            loop {
                let ticks = f64::from(draws.geometric(0.8));
                day += (12.0 * ticks + 2.0 * ticks.sqrt() * draws.normal()).round().max(1.0);
                if day >= 400.0 {
                    break;
                }
                nodes += 1;
                text.push_str(&format!("p{},a{axis},{day},{nodes}\n", axis / 2));
            }
            text.push_str(&format!("p{},a{axis},400,{nodes}\n", axis / 2));
        }
        text
    }

    /// 60 refits: an error of .028 of the coverage, and a bias within 4 of its own errors and a tenth of the estimate.
    #[test]
    fn waits_are_drawn_and_fitted_again() {
        let checked = checked(Law::Activity, &days(), &Wanted::default(), 60);
        assert!(checked.refits.0 >= 58, "{:?}", checked.refits);
        assert_eq!(checked.parameters.len(), 3);
        for parameter in &checked.parameters {
            println!("{parameter:?}");
            assert!(parameter.bias.abs() < 4.0 * parameter.error + 0.02 * parameter.truth, "{parameter:?}");
            assert!((parameter.coverage.unwrap().0 - 0.95).abs() <= 0.113, "{parameter:?}");
        }
        // Whole ticks predict plants that were left out better than a constant probability does.
        assert!(checked.left_out.len() == 2 && checked.left_out[0].1 > checked.left_out[1].1 + 0.5, "{checked:?}");
        let counts =
            super::tests::checked(Law::Activity, &days(), &Wanted { window: Some((20, 380)), ..Wanted::default() }, 40);
        assert!(counts.refits.0 >= 38 && counts.left_out.len() == 2, "{counts:?}");
    }

    #[test]
    fn fates_are_drawn_and_fitted_again() {
        let chain = checked(Law::Branching, sample("branching"), &Wanted::default(), 12);
        println!("{chain:?}");
        assert_eq!(chain.refits, (12, 12));
        let told = |words: &str| chain.parameters.iter().any(|own| own.name.starts_with(words));
        assert!(told("length of zone 1") && told("zone 2: "), "{chain:?}");
        assert!(chain.predicted.as_ref().is_some_and(|own| own.name.contains("runs")), "{chain:?}");
        let mut text = "plant,axis,rank,fate\n".to_owned();
        let mut draws = Draws::new(3, 1);
        for axis in 0..60 {
            for rank in 1..=12 {
                let fate = if draws.happens(if rank <= 6 { 0.2 } else { 0.6 }) { "long" } else { "latent" };
                text.push_str(&format!("p{},a{axis},{rank},{fate}\n", axis / 3));
            }
        }
        let wanted = Wanted { chain: 2, ..Wanted::default() };
        let zones = checked(Law::Branching, &text, &wanted, 100);
        println!("{zones:?}");
        assert_eq!(zones.parameters.len(), 4);
        for own in &zones.parameters {
            assert!(own.bias.abs() < 4.0 * own.error, "{own:?}");
            // Exact intervals hold the truth at least as often as they say: 4 errors of .022 below.
            assert!(own.coverage.unwrap().0 >= 0.862, "{own:?}");
        }
    }

    #[test]
    fn what_was_left_out_is_predicted_by_the_better_law() {
        let wanted = Wanted::default();
        let chains = checked(Law::Branching, sample("branching"), &wanted, 0).left_out;
        println!("{chains:?}");
        let best = |words: &str| {
            let of = chains.iter().filter(|law| law.0.starts_with(words)).map(|law| law.1);
            of.fold(f64::NEG_INFINITY, f64::max)
        };
        assert!(best("chain") > best("zones"), "{chains:?}");
        assert_eq!(checked(Law::Mortality, sample("mortality, followed"), &wanted, 0).left_out.len(), 5);
    }

    /// A column `plant` divides any law's rows; without names, or with fewer than ten plants, nothing is left out.
    #[test]
    fn plants_are_left_out_whole() {
        let named = |plants: usize| {
            let mut draws = Draws::new(5, 1);
            let rows = (0..200).map(|k| format!("p{},{}\n", k % plants, draws.binomial(9, 0.7)));
            format!("plant,nodes\n{}", rows.collect::<String>())
        };
        let wanted = Wanted::default();
        for law in [Law::Nodes, Law::Activity] {
            let told = checked(law, &named(20), &wanted, 0).left_out;
            println!("{told:?}");
            assert!(told.len() >= 2 && told.iter().all(|own| own.1 > -4.0 && own.1 < 0.0), "{told:?}");
            assert!(checked(law, &named(6), &wanted, 0).left_out.is_empty());
        }
        let counts = checked(Law::Nodes, &named(20), &wanted, 0).left_out;
        let of = |law: &str| counts.iter().find(|own| own.0 == law).map(|own| own.1).unwrap();
        assert!(of("B") > of("P"), "{counts:?}");
        assert!(checked(Law::Nodes, sample("nodes"), &wanted, 0).left_out.is_empty());
        let mut draws = Draws::new(8, 1);
        let pair = |plant: usize, draws: &mut Draws| {
            let ticks = 12 + draws.binomial(8, 0.3);
            format!("p{plant},10,{},{}\n", draws.binomial(ticks, 0.7), draws.binomial(ticks, 0.7))
        };
        let pairs: String = (0..60).map(|k| pair(k % 12, &mut draws)).collect();
        let crown = checked(Law::Crown, &format!("plant,above,first,second\n{pairs}"), &wanted, 0).left_out;
        assert!(crown.len() == 1 && crown[0].1 < 0.0 && crown[0].1 > -10.0, "{crown:?}");
    }
}
