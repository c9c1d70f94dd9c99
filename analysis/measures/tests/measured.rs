//! Measured plants: the allometry of 100 taxa (Falster et al. 2015, BAAD) and the annual shoots of sessile oak
//! (Heuret).
//!
//! The numbers that must come out were reckoned by other programs. The files are outside the project (`absent`).

#[path = "../../../tests/program/absent.rs"]
mod absent;
#[path = "../../../tests/fitted/measured.rs"]
#[expect(dead_code, reason = "not every test of counts asks for all of it")]
mod measured;

use measured::Table;
use phytomer_measures::line::Pairs;
use phytomer_measures::moments::Moments;
use phytomer_measures::variance::components;
use phytomer_sim::math::log;

fn scaled(table: &Table, x: &str, y: &str) -> Pairs {
    let mut pairs = Pairs::default();
    for row in table.rows() {
        if let (Some(x), Some(y)) = (row.maybe(x), row.maybe(y)) {
            pairs.add(log(x), log(y));
        }
    }
    pairs
}

#[test]
fn mass_and_height_scale_with_diameter_as_in_baad() {
    let Some(table) = Table::read("baad_subset_CC0.csv") else { return };
    for (y, n, expected) in [("m.so", 564, [2.438, 2.395, 2.483]), ("h.t", 731, [1.075, 1.050, 1.101])] {
        let line = scaled(&table, "d.ba", y).major_axis(0.95).unwrap();
        let found = [line.slope.value, line.slope.interval.low, line.slope.interval.high];
        assert_eq!(line.n, n, "{y}");
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 5e-4, "{y}: {found} is not {expected}");
        }
    }
}

#[test]
fn the_years_of_oak_shoots_differ_with_f_40_1219() {
    let Some(table) = Table::read("sessile_oak_annual_shoots.csv") else { return };
    let mut years = [Moments::default(); 3];
    for row in table.rows() {
        years[row.number("year") as usize - 1995].add(row.number("length_cm"));
    }
    let found = components(&years, 0.95).unwrap();
    assert!((found.f.unwrap() - 40.1219).abs() < 5e-5, "{found:?}");
    assert_eq!((found.df, found.n), ([2, 135], 138));
}
