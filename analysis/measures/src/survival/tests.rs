//! The remission times of Freireich et al. (1963), as Kalbfleisch & Prentice (2002) and Klein & Moeschberger (2003)
//! have them, and closed forms.

use super::*;
use crate::Lack;

/// Weeks of remission under 6-mercaptopurine; a negative number is censored.
const SIX_MP: [i32; 21] = [6, 6, 6, 7, 10, 13, 16, 22, 23, -6, -9, -10, -11, -17, -19, -20, -25, -32, -32, -34, -35];
const PLACEBO: [i32; 21] = [1, 1, 2, 2, 3, 4, 4, 5, 5, 8, 8, 8, 8, 11, 11, 12, 12, 15, 17, 22, 23];

fn lives(weeks: &[i32], first: u32) -> Lives {
    let mut lives = Lives::default();
    for (number, weeks) in (first..).zip(weeks) {
        let fate = if *weeks < 0 { Fate::Censored } else { Fate::Ended(0) };
        lives.add(number, weeks.unsigned_abs(), fate);
    }
    lives
}

#[test]
fn freireich_survives_ten_weeks_at_7529() {
    let curve = kaplan_meier(&lives(&SIX_MP, 0), 0.95).unwrap();
    let ten = curve.at(10).unwrap();
    assert!((ten.survival - 0.7529).abs() < 5e-5 && (ten.greenwood.unwrap() - 0.0963).abs() < 5e-5, "{ten:?}");
    assert_eq!((ten.at_risk, ten.ended, ten.censored), (15, 1, 1));
    assert_eq!((curve.outlasted_by(0.5), curve.outlasted_by(0.1)), (Ok(23), Err(Lack::NotReached)));
}

/// Half of 28 lives ended, in five steps whose shares are no binary numbers: the product is the median all the same.
#[test]
fn a_survival_of_one_half_is_at_the_median() {
    let ended = [3, 3, 3, 3, 2].iter().zip(13..).flat_map(|(n, week)| vec![week; *n]);
    let weeks: Vec<i32> = ended.chain([-36; 14]).collect();
    assert_eq!(kaplan_meier(&lives(&weeks, 0), 0.95).unwrap().outlasted_by(0.5), Ok(17));
}

/// Where each life is a plant, the variance of plants is Greenwood's, but for k / (k − 1).
#[test]
fn the_variance_of_plants_of_one_life_is_greenwoods() {
    for weeks in [SIX_MP, PLACEBO] {
        let curve = kaplan_meier(&lives(&weeks, 0), 0.95).unwrap();
        for step in curve.steps.iter().filter(|step| step.survival > 0.0) {
            let (greenwood, of_plants) = (step.greenwood.unwrap(), step.of_plants.unwrap());
            assert!((of_plants / (21.0_f64 / 20.0).sqrt() - greenwood).abs() < 1e-12, "{step:?}");
        }
    }
}

#[test]
fn freireichs_log_rank_is_16_793() {
    let (treated, placebo) = (lives(&SIX_MP, 0), lives(&PLACEBO, 21));
    let test = log_rank(&[&treated, &placebo]).unwrap();
    assert!((test.statistic - 16.793).abs() < 5e-4 && test.df == 1, "{test:?}");
    assert_eq!(log_rank(&[&placebo, &Lives::default(), &treated]).unwrap().df, 1);
    // With 42 plants of one life each the test of plants comes close.
    let of_plants = log_rank_of_plants(&[&treated, &placebo]).unwrap();
    assert!(of_plants.p < 1e-3 && of_plants.of_plants == Some(41), "{of_plants:?}");
}

/// Copies of each life on one plant tell nothing new: the test of plants stays, that of independent lives grows
/// ninefold.
#[test]
fn copies_on_a_plant_do_not_sharpen_the_test_of_plants() {
    let copied = |weeks: &[i32], first: u32| {
        let mut copied = Lives::default();
        for (plant, weeks) in (first..).zip(weeks) {
            let fate = if *weeks < 0 { Fate::Censored } else { Fate::Ended(0) };
            (0..9).for_each(|_| copied.add(plant, weeks.unsigned_abs(), fate));
        }
        copied
    };
    let (one, nine) = ([lives(&SIX_MP, 0), lives(&PLACEBO, 21)], [copied(&SIX_MP, 0), copied(&PLACEBO, 21)]);
    let of = |groups: &[Lives; 2]| log_rank_of_plants(&[&groups[0], &groups[1]]).unwrap().statistic;
    assert!((of(&one) - of(&nine)).abs() < 1e-9);
    let independent = log_rank(&[&nine[0], &nine[1]]).unwrap().statistic;
    assert!(independent > 8.0 * 16.793, "{independent}");
    let error = |lives: &Lives| kaplan_meier(lives, 0.95).unwrap().at(10).unwrap().of_plants.unwrap();
    assert!((error(&one[0]) - error(&nine[0])).abs() < 1e-12);
}

/// Without censoring the share ended by a cause is a plain proportion, with the binomial variance.
#[test]
fn incidence_without_censoring_is_a_proportion() {
    let mut lives = Lives::default();
    for plant in 0..40 {
        lives.add(plant, 1 + plant % 7, Fate::Ended((plant % 5 == 0) as usize));
    }
    let found = aalen_johansen(&lives, 0.95).unwrap();
    for (cause, share) in [(0, 0.8), (1, 0.2)] {
        let last = found.iter().rfind(|row| row.cause == cause).unwrap();
        assert!((last.share - share).abs() < 1e-12, "{last:?}");
        let binomial = (share * (1.0 - share) / 40.0 * 40.0 / 39.0).sqrt();
        assert!((last.of_plants.unwrap() - binomial).abs() < 1e-12, "{last:?} and {binomial}");
    }
}

/// With one cause the incidence is one minus the Kaplan–Meier curve, and its error the same.
#[test]
fn incidence_of_one_cause_is_one_less_survival() {
    let lives = lives(&SIX_MP, 0);
    let curve = kaplan_meier(&lives, 0.95).unwrap();
    for row in aalen_johansen(&lives, 0.95).unwrap() {
        let step = curve.at(row.ticks).unwrap();
        assert!((row.share - (1.0 - step.survival)).abs() < 1e-12);
        assert!((row.of_plants.unwrap() - step.of_plants.unwrap()).abs() < 1e-12);
        assert!((row.interval.unwrap().low - (1.0 - step.interval.unwrap().high)).abs() < 1e-12);
    }
}

#[test]
fn what_is_missing_is_said() {
    let (none, censored) = (Lives::default(), lives(&[-3, -4], 0));
    assert_eq!(kaplan_meier(&none, 0.95), Err(Lack::Empty));
    assert_eq!(aalen_johansen(&censored, 0.95), Err(Lack::NoEvents));
    assert_eq!(log_rank(&[&censored]), Err(Lack::Groups { found: 1, needed: 2 }));
    assert_eq!(log_rank(&[&censored, &censored]), Err(Lack::NoEvents));
    let (early, late) = (lives(&[1, 1], 0), lives(&[2, 3], 2));
    assert!(log_rank(&[&early, &late]).is_ok());
    let one = kaplan_meier(&lives(&[2], 0), 0.95).unwrap();
    assert_eq!((one.steps[0].of_plants, one.steps[0].interval, one.interval_of(0.5)), (None, None, [None, None]));
}
