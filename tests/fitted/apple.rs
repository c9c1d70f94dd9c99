//! Fates of axillary buds along the first annual shoot of apple trunks (Costes): the chain of zones of the shipped
//! species against Fuji, and zones of independent buds for all seven cultivars.
//!
//! Buds of one trunk are not independent, so the shipped species is held against sets of as many trunks as were
//! measured, drawn from it: a statistic of the measured set is told by its place among theirs. Zones of six nodes with
//! the counted shares come out as they went in, which tells that the mechanism has no bias; the runs of equal fates
//! refuse them.

use crate::chi2::homogeneity;
use crate::measured::{Row, Table, add, moments};
use crate::simulated::{grown, shipped};
use phytomer_models::buds::Buds;
use phytomer_models::buds::params::{End, Pattern, Rhythmic, Zone, ZoneState};
use phytomer_models::law::{Binomial, Count, CountForm, Law};
use phytomer_sim::plant::{AxisId, Plant};
use std::collections::BTreeMap;

/// The fates in the order of the data's codes from 1; code 0 is latent.
const FATES: [&str; 4] = ["short", "long", "floral", "sylleptic"];

/// Nodes of a zone.
const ZONE: u32 = 6;

/// The tick of the first annual shoot.
const FIRST: u32 = 4;

/// The number of buds of each fate, by rank from the tip.
#[derive(Default)]
struct Fates(Vec<[f64; 5]>);

impl Fates {
    fn add(&mut self, rank: u32, fate: usize) {
        let place = rank as usize - 1;
        if self.0.len() <= place {
            self.0.resize(place + 1, [0.0; 5]);
        }
        self.0[place][fate] += 1.0;
    }

    /// The buds of each fate over the whole shoot.
    fn totals(&self) -> Vec<f64> {
        (0..5).map(|fate| self.0.iter().map(|buds| buds[fate]).sum()).collect()
    }

    /// The buds that are not latent, zone by zone.
    fn awake(&self) -> Vec<f64> {
        self.0.chunks(ZONE as usize).map(|run| run.iter().flat_map(|buds| &buds[1..]).sum()).collect()
    }
}

fn measured(table: &Table, cultivar: &str) -> Fates {
    let mut fates = Fates::default();
    for row in of(table, cultivar) {
        fates.add(row.number("node_rank") as u32, row.number("fate") as usize);
    }
    fates
}

fn of<'a>(table: &'a Table, cultivar: &'a str) -> impl Iterator<Item = Row<'a>> {
    table.rows().filter(move |row| row.text("cultivar") == cultivar)
}

/// The fates along the first shoots of the trunks of `plants` apples.
fn simulated(buds: &Buds, plants: u32) -> Fates {
    let mut fates = Fates::default();
    for plant in grown(buds, plants, FIRST) {
        (1..).zip(from_tip(&plant, &buds.states)).for_each(|(rank, fate)| fates.add(rank, fate));
    }
    fates
}

/// The fates along the first shoot of a trunk, from its tip.
fn from_tip(plant: &Plant, states: &[String]) -> Vec<usize> {
    let trunk = |node: &usize| plant.nodes.axis[*node] == AxisId::TRUNK;
    let nodes = (0..plant.nodes.len()).filter(trunk).count();
    let mut fate = vec![0; nodes];
    for axis in 1..plant.axes.len() {
        let bearer = plant.axes.bearer[axis].some().map_or(0, |node| node.index());
        let state = &states[usize::from(plant.axes.state[axis])];
        let code = FATES.iter().position(|fate| fate == state).expect("a fate") + 1;
        fate[plant.nodes.unit_rank[bearer] as usize - 1] = code;
    }
    fate.reverse();
    fate
}

#[test]
fn fractions_of_the_fates_are_those_published() {
    let Some(table) = Table::read("apple_trunk_axillary_fates.csv") else { return };
    for (cultivar, published) in
        [("fuji", [0.621, 0.070, 0.161, 0.049, 0.099]), ("wij", [0.261, 0.404, 0.033, 0.270, 0.031])]
    {
        let totals = measured(&table, cultivar).totals();
        let buds: f64 = totals.iter().sum();
        for (count, fraction) in totals.iter().zip(published) {
            assert!((count / buds - fraction).abs() <= 6e-4, "{cultivar}: {} {fraction}", count / buds);
        }
    }
}

/// Sets of trunks of the shipped apple, each of as many as were measured.
const SETS: usize = 400;
const TRUNKS: usize = 15;

/// Off by so much in all: Σ (count − expected)² / expected over the cells in which five or more are expected.
fn off(counts: &[f64], expected: &[f64]) -> f64 {
    let cells = counts.iter().zip(expected).filter(|(_, expected)| **expected >= 5.0);
    cells.map(|(count, expected)| (count - expected) * (count - expected) / expected).sum()
}

/// The counts of the fates of shoots, fate by fate, by zones of six ranks from the tip.
fn cells(shoots: &[Vec<usize>]) -> Vec<f64> {
    let mut fates = Fates::default();
    shoots.iter().for_each(|shoot| (1..).zip(shoot).for_each(|(rank, fate)| fates.add(rank, *fate)));
    let zones = fates.0.chunks(ZONE as usize);
    let mut cells: Vec<f64> =
        zones.flat_map(|zone| (0..5).map(|fate| zone.iter().map(|buds| buds[fate]).sum::<f64>())).collect();
    cells.resize(5 * 20, 0.0);
    cells
}

fn runs(shoots: &[Vec<usize>]) -> f64 {
    let changes = |shoot: &Vec<usize>| shoot.windows(2).filter(|pair| pair[0] != pair[1]).count();
    shoots.iter().map(|shoot| (1 + changes(shoot)) as f64).sum()
}

/// The fates of each measured trunk from the tip.
fn trunks(table: &Table, name: &str) -> Vec<Vec<usize>> {
    let mut trunks: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for row in of(table, name) {
        trunks.entry(row.text("trunk_id")).or_default().push(row.number("fate") as usize);
    }
    trunks.into_values().collect()
}

/// Fates by zone, and runs of equal fates, of the measured trunks among those of sets of trunks of the species.
fn among_sets(buds: &Buds, measured: &[Vec<usize>]) -> (f64, f64, [f64; 2]) {
    assert_eq!(measured.len(), TRUNKS);
    let plants = grown(buds, (SETS * TRUNKS) as u32, FIRST);
    let drawn: Vec<Vec<usize>> = plants.iter().map(|plant| from_tip(plant, &buds.states)).collect();
    let expected: Vec<f64> = cells(&drawn).iter().map(|count| count / SETS as f64).collect();
    let own = off(&cells(measured), &expected);
    let beyond = drawn.chunks(TRUNKS).filter(|set| off(&cells(set), &expected) >= own).count();
    let (mean, variance) = moments(&drawn.chunks(TRUNKS).map(runs).collect::<Vec<_>>());
    (beyond as f64 / SETS as f64, (runs(measured) - mean) / variance.sqrt(), [mean, variance.sqrt()])
}

#[test]
fn the_shipped_apple_has_the_fates_and_the_runs_of_fuji() {
    let Some(table) = Table::read("apple_trunk_axillary_fates.csv") else { return };
    let fuji = trunks(&table, "fuji");
    let (p, z, [mean, sd]) = among_sets(&shipped("apple", 2), &fuji);
    println!(
        "| apple, Fuji, fates by zone, as shipped | {p:.3} | runs {} | {mean:.0} ± {sd:.0} | {z:.1} |",
        runs(&fuji)
    );
    assert!(p >= 0.01, "{p}");
    assert!(z.abs() < 3.0, "{z}");
}

/// The shares that were counted, six nodes a zone, have the fates by zone and far too many runs.
#[test]
fn zones_of_independent_buds_have_too_many_runs() {
    let Some(table) = Table::read("apple_trunk_axillary_fates.csv") else { return };
    let (p, z, [mean, sd]) = among_sets(&cultivar(&table, "fuji"), &trunks(&table, "fuji"));
    println!("| apple, Fuji, fates by zone, zones of six | {p:.3} | {mean:.0} ± {sd:.0} | {z:.1} |");
    assert!(p >= 0.01 && z < -8.0, "{p} {z}");
}

/// The apple with the zones of another cultivar, and the length of its shoots.
fn cultivar(table: &Table, name: &str) -> Buds {
    let fates = measured(table, name);
    let mut lengths: BTreeMap<&str, f64> = BTreeMap::new();
    for row in of(table, name) {
        let length = lengths.entry(row.text("trunk_id")).or_default();
        *length = length.max(row.number("node_rank"));
    }
    let mean = lengths.values().sum::<f64>() / lengths.len() as f64;
    let mut apple = shipped("apple", 2);
    let n = (mean / 0.72).round();
    let binomial = Some(Binomial { n: Law::from(n), p: Law::from(mean / n) });
    apple.order[0].growth_unit.nodes = Count::from(CountForm { binomial, ..CountForm::default() });
    let zones = (0_u32..).zip(fates.0.chunks(ZONE as usize)).map(|(place, ranks)| zone(place, ranks)).collect();
    apple.order[0].axillary.pattern = Pattern::Rhythmic(Rhythmic { zones });
    apple
}

fn zone(place: u32, ranks: &[[f64; 5]]) -> Zone {
    let sum = |fate: usize| ranks.iter().map(|buds| buds[fate]).sum::<f64>();
    let awake: f64 = (1..5).map(sum).sum();
    let shares: BTreeMap<String, f64> = (1..).zip(FATES).map(|(code, fate)| (fate.to_owned(), sum(code))).collect();
    Zone {
        name: None,
        from: End::Tip,
        first: Count::from(place * ZONE + 1),
        last: Some(Count::from((place + 1) * ZONE)),
        ramification: Some(Law::from(awake / (awake + sum(0)))),
        state: (awake > 0.0).then_some(ZoneState::Shares(shares)),
    }
}

#[test]
fn the_law_has_the_fates_of_every_cultivar() {
    let Some(table) = Table::read("apple_trunk_axillary_fates.csv") else { return };
    for name in ["belren", "elstar", "fuji", "gala", "granny", "reinet", "wij"] {
        let simulated = simulated(&cultivar(&table, name), 600);
        let measured = measured(&table, name);
        homogeneity(&measured.totals(), &simulated.totals(), 0).assert_fits(&format!("apple, {name}, five fates"));
        let (mut few, mut many) = (Vec::new(), Vec::new());
        for (fates, counts) in [(&measured, &mut few), (&simulated, &mut many)] {
            fates.awake().into_iter().enumerate().for_each(|(zone, count)| add(counts, zone, count));
        }
        homogeneity(&few, &many, 0).assert_fits(&format!("apple, {name}, buds awake by zones"));
    }
}
