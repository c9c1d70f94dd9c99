//! Lines that pass stems touch none, internode by internode, and few others do not.

use super::tests::{fractions, of_plant, stems};
use super::*;

/// The stems of an axis, which turns a little from one to the next: their ends and their radius.
type Wood = Vec<([f32; 3], [f32; 3], f32)>;

/// The internodes of an axis.
const ALONG: usize = 8;

/// A direction, not quite of length 1.
fn direction(fraction: &mut impl FnMut() -> f32) -> [f32; 3] {
    let at = [0, 1, 2].map(|_| fraction() - 0.5);
    let length = at.iter().map(|x| x * x).sum::<f32>().sqrt().max(0.1);
    at.map(|x| x / length)
}

fn wood(fraction: &mut impl FnMut() -> f32) -> Wood {
    let mut all = Wood::new();
    for _ in 0..500 {
        let (mut at, mut heading) = ([0, 1, 2].map(|_| fraction()), direction(fraction));
        let (length, radius) = (0.01 + 0.03 * fraction(), 0.001 + 0.006 * fraction());
        for _ in 0..ALONG {
            let end = [0, 1, 2].map(|k| at[k] + length * heading[k]);
            all.push((at, end, radius));
            let turn = direction(fraction);
            (at, heading) = (end, [0, 1, 2].map(|k| heading[k] + 0.2 * turn[k]));
        }
    }
    all
}

#[test]
fn a_line_that_passes_all_stems_touches_none() {
    let mut fraction = fractions(29);
    let plants: Vec<OfPlant> = (0..4)
        .map(|number| {
            let mut plant = of_plant(number, [0.8 * f64::from(number), 0.0, 0.3], &wood(&mut fraction));
            plant.stems.iter_mut().for_each(|stem| stem.axis /= ALONG as u32);
            plant
        })
        .collect();
    let stood = [Whose::All, Whose::Neighbours].map(|whose| stems(plants.clone(), whose));
    let (mut passed, mut touched, mut unknown) = (0, 0, 0);
    for round in 0..4_000 {
        let all = &stood[round / 2_000];
        // Every other line begins at a node of an axis as a lateral does, the others anywhere.
        let of = &plants[round % 4];
        let base = of.stems[round * 7 % of.stems.len()].end.map(f64::from);
        let anywhere = [0, 1, 2].map(|_| f64::from(fraction()));
        let start = [0, 1, 2].map(|k| of.place[k] + if round % 2 == 0 { base[k] } else { anywhere[k] });
        let spared = Spared { plant: round as u32 % 5, axis: round as u32 % 60 };
        let (length, room) = (0.002 + 0.02 * f64::from(fraction()), 0.001 + 0.004 * f64::from(fraction()));
        let (mut at, mut heading) = (start, direction(&mut fraction));
        let (mut line, mut beside, mut free) = (Line::default(), Beside::default(), None);
        line.begin(at);
        let internodes = 1 + round % 15;
        for before in 0..internodes {
            let end = [0, 1, 2].map(|k| at[k] + length * f64::from(heading[k]));
            line.go_on(end, room);
            beside.glance(all, at, [1.5 * length + room, 0.001, 0.0], spared);
            if free.is_none() && beside.touched([at, end], room, true).is_some() {
                free = Some(before);
            }
            let turn = direction(&mut fraction);
            (at, heading) = (end, [0, 1, 2].map(|k| heading[k] + 0.1 * turn[k]));
        }
        let (past, free) = (all.passed_by(&line, spared), free.unwrap_or(internodes));
        assert!(past <= free, "line {round} touches a stem behind {free} internodes, not behind {past}");
        match (past == internodes, free == internodes) {
            (true, _) => passed += 1,
            (false, true) => unknown += 1,
            (false, false) => touched += 1,
        }
    }
    assert!(passed > 1_000 && touched > 300 && 20 * unknown < touched, "{passed} {touched} {unknown}");
}
