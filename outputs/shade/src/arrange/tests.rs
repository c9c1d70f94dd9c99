//! Arrangements against trying all of them.

use super::program::pairs;
use super::*;

/// Numbers that look drawn, from a linear congruence (Numerical Recipes), in [0, 1).
struct Drawn(u32);

impl Drawn {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0 >> 8) / f64::from(1 << 24)
    }
}

/// Whether an arrangement keeps a rule, as the rule is worded.
fn keeps(plan: &Plan, rule: Rule, chosen: &Arrangement) -> bool {
    let height = |spot: usize| chosen[spot].map(|candidate| plan.candidates[candidate].height_m);
    match rule {
        Rule::Budget => plan.budget.is_none_or(|budget| plan.cost(chosen) <= budget + 1e-9),
        Rule::Rows => pairs(plan)
            .into_iter()
            .all(|(front, back)| height(front).zip(height(back)).is_none_or(|(front, back)| front <= back)),
        Rule::EverySpot => chosen.iter().all(Option::is_some),
        Rule::AtMost(candidate) => {
            let planted = chosen.iter().filter(|chosen| **chosen == Some(candidate)).count();
            plan.candidates[candidate].at_most.is_none_or(|most| planted <= most as usize)
        }
        Rule::Least(demand) => {
            plan.demands[demand].least.is_none_or(|least| plan.demanded(demand, chosen) >= least - 1e-9)
        }
        Rule::Most(demand) => plan.demands[demand].most.is_none_or(|most| plan.demanded(demand, chosen) <= most + 1e-9),
        Rule::Refused => plan.refused.iter().all(|refused| {
            let beside = chosen.iter().zip(refused).filter(|(chosen, refused)| chosen.is_some() && chosen != refused);
            beside.count() > 0
        }),
    }
}

/// What is worth most is found by asking every arrangement that there is.
fn tried(plan: &Plan, rules: &[Rule]) -> Option<f64> {
    let (spots, choices) = (plan.rows.len() as u32, plan.candidates.len() + 1);
    let all = (0..choices.pow(spots)).map(|number| -> Arrangement {
        (0..spots).map(|spot| (number / choices.pow(spot) % choices).checked_sub(1)).collect()
    });
    let sound = all.filter(|chosen| rules.iter().all(|rule| keeps(plan, *rule, chosen)));
    sound.map(|chosen| worth(plan, &chosen)).reduce(f64::max)
}

/// What is made as large as can be.
fn worth(plan: &Plan, chosen: &Arrangement) -> f64 {
    match plan.aim {
        Aim::Most => plan.sum(&plan.gains, chosen),
        Aim::Least => -plan.sum(&plan.gains, chosen),
        Aim::Cheapest => -plan.cost(chosen),
    }
}

/// A plan of so many spots and candidates, with demands that often contradict each other.
fn drawn(spots: usize, candidates: usize, seed: u32) -> Plan {
    let mut draw = Drawn(seed);
    let candidate = |draw: &mut Drawn| Candidate {
        cost: 50.0 + (400.0 * draw.next()).round(),
        height_m: 2.0 + (8.0 * draw.next()).round(),
        at_most: (draw.next() < 0.5).then(|| (3.0 * draw.next()) as u32),
    };
    let candidates: Vec<Candidate> = (0..candidates).map(|_| candidate(&mut draw)).collect();
    let places = spots * candidates.len();
    let added = |draw: &mut Drawn, most: f64| (0..places).map(|_| most * draw.next()).collect::<Vec<f64>>();
    let demand = |draw: &mut Drawn| {
        let (base, added) = (draw.next(), added(draw, 1.5));
        let least = (draw.next() < 0.5).then(|| 2.5 * draw.next());
        let most = (draw.next() < 0.5).then(|| least.unwrap_or(0.0) + 2.5 * draw.next());
        Demand { base, added, least, most }
    };
    let aim = [Aim::Most, Aim::Least, Aim::Cheapest][(3.0 * draw.next()) as usize];
    Plan {
        rows: (0..spots).map(|_| (draw.next() < 0.8).then(|| 1 + (3.0 * draw.next()) as u32)).collect(),
        budget: (draw.next() < 0.7).then(|| 200.0 + 1000.0 * draw.next()),
        every_spot: draw.next() < 0.3,
        aim,
        gains: added(&mut draw, 1000.0),
        demands: (0..3).map(|_| demand(&mut draw)).collect(),
        refused: Vec::new(),
        candidates,
    }
}

#[test]
fn six_spots_and_three_candidates_equal_brute_force() {
    let (mut solved, mut refused) = (0, 0);
    for seed in 0..60 {
        let plan = drawn(6, 3, seed);
        let rules = plan.rules();
        let (found, known) = (plan.solve().expect("a proof"), tried(&plan, &rules));
        let Some(found) = found else {
            assert_eq!(known, None, "plan {seed} has an arrangement");
            refused += 1;
            continue;
        };
        solved += 1;
        assert!(rules.iter().all(|rule| keeps(&plan, *rule, &found)), "plan {seed}: {found:?}");
        let (worth, known) = (worth(&plan, &found), known.expect("as the program has"));
        assert!((worth - known).abs() < 1e-6, "plan {seed}: {worth}, but {known} is there");
    }
    assert!(solved > 15 && refused > 5, "{solved} with and {refused} without an arrangement");
}

#[test]
fn what_is_refused_is_left_with_all_its_parts() {
    for seed in 0..60 {
        let mut plan = Plan { aim: Aim::Most, every_spot: false, ..drawn(5, 3, seed) };
        let Some(first) = plan.solve().expect("a proof").filter(|chosen| chosen.iter().any(Option::is_some)) else {
            continue;
        };
        plan.refused.push(first.clone());
        let (second, known) = (plan.solve().expect("a proof"), tried(&plan, &plan.rules()));
        assert_eq!(second.is_some(), known.is_some(), "plan {seed}");
        let Some(second) = second else { continue };
        assert!((worth(&plan, &second) - known.expect("one")).abs() < 1e-6, "plan {seed}");
        assert!(keeps(&plan, Rule::Refused, &second) && second != first);
    }
}

#[test]
fn a_conflict_names_what_cannot_hold_together_and_no_more() {
    let mut conflicts = 0;
    for seed in 0..60 {
        let plan = drawn(4, 3, seed);
        if plan.solve().expect("a proof").is_some() {
            continue;
        }
        let rules = conflict(&plan).expect("a proof");
        assert!(!rules.is_empty() && tried(&plan, &rules).is_none(), "plan {seed}: {rules:?}");
        for left_out in &rules {
            let fewer: Vec<Rule> = rules.iter().copied().filter(|rule| rule != left_out).collect();
            assert!(tried(&plan, &fewer).is_some(), "plan {seed}: {left_out:?} of {rules:?} is not needed");
        }
        conflicts += 1;
    }
    assert!(conflicts > 5, "{conflicts}");
}

#[test]
fn one_row_in_front_of_another_never_has_the_taller_tree() {
    let of = |height_m: f64| Candidate { cost: 1.0, height_m, at_most: Some(1) };
    let plan = Plan {
        candidates: vec![of(9.0), of(3.0)],
        rows: vec![Some(1), Some(2)],
        budget: Some(2.0),
        every_spot: true,
        aim: Aim::Most,
        // The tall one is worth far more in front, where it cannot stand.
        gains: vec![100.0, 1.0, 2.0, 50.0],
        demands: Vec::new(),
        refused: Vec::new(),
    };
    assert_eq!(plan.solve().expect("a proof"), Some(vec![Some(1), Some(0)]));
    let free = Plan { rows: vec![None, Some(2)], ..plan.clone() };
    assert_eq!(free.solve().expect("a proof"), Some(vec![Some(0), Some(1)]));
    let poor = Plan { budget: Some(1.0), ..plan };
    assert_eq!(conflict(&poor).expect("a proof"), [Rule::Budget, Rule::EverySpot]);
}

#[test]
fn a_plan_without_spots_has_one_arrangement() {
    let plan = drawn(0, 2, 1);
    let empty = Plan { demands: Vec::new(), every_spot: true, ..plan };
    assert_eq!(empty.solve().expect("a proof"), Some(Vec::new()));
}
