//! Fates of axillary buds along the first annual shoot of apple trunks (Costes), against the first shoot of the shipped
//! species, and the same law for the other six cultivars.
//!
//! In the data a zone six nodes wide has its own share of latent buds and of each fate; so the law states that fates do
//! not depend on rank within a zone, and that neighbours are independent. Half zones test the first statement.

use crate::chi2::homogeneity;
use crate::measured::{Row, Table, add};
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

    /// The buds that are not latent, by runs of `width` ranks.
    fn awake(&self, width: usize) -> Vec<f64> {
        self.0.chunks(width).map(|run| run.iter().flat_map(|buds| &buds[1..]).sum()).collect()
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
    grown(buds, plants, FIRST).iter().for_each(|plant| along(plant, &buds.states, &mut fates));
    fates
}

fn along(plant: &Plant, states: &[String], fates: &mut Fates) {
    let trunk = |node: &usize| plant.nodes.axis[*node] == AxisId::TRUNK;
    let nodes = (0..plant.nodes.len()).filter(trunk).count();
    let mut fate = vec![0; nodes];
    for axis in 1..plant.axes.len() {
        let bearer = plant.axes.bearer[axis].some().map_or(0, |node| node.index());
        let state = &states[usize::from(plant.axes.state[axis])];
        let code = FATES.iter().position(|fate| fate == state).expect("a fate") + 1;
        fate[plant.nodes.unit_rank[bearer] as usize - 1] = code;
    }
    (1..).zip(fate.iter().rev()).for_each(|(rank, fate)| fates.add(rank, *fate));
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

#[test]
fn the_shipped_apple_has_the_fates_of_fuji() {
    let Some(table) = Table::read("apple_trunk_axillary_fates.csv") else { return };
    let (fuji, apple) = (measured(&table, "fuji"), simulated(&shipped("apple", 2), 600));
    homogeneity(&fuji.totals(), &apple.totals(), 0).assert_fits("apple, Fuji, five fates");
    // 13 zones have 13 estimates, of which one is spent on the sum.
    homogeneity(&fuji.awake(3), &apple.awake(3), 12).assert_fits("apple, Fuji, buds awake by half zones");
    for (code, fate) in (1..).zip(FATES) {
        let by_zone = |fates: &Fates| -> Vec<f64> {
            fates.0.chunks(ZONE as usize).map(|zone| zone.iter().map(|buds| buds[code]).sum()).collect()
        };
        homogeneity(&by_zone(&fuji), &by_zone(&apple), 0).assert_fits(&format!("apple, Fuji, {fate} by zone"));
    }
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
    for name in ["belren", "elstar", "gala", "granny", "reinet", "wij"] {
        let simulated = simulated(&cultivar(&table, name), 600);
        let measured = measured(&table, name);
        homogeneity(&measured.totals(), &simulated.totals(), 0).assert_fits(&format!("apple, {name}, five fates"));
        let (mut few, mut many) = (Vec::new(), Vec::new());
        for (fates, counts) in [(&measured, &mut few), (&simulated, &mut many)] {
            fates.awake(ZONE as usize).into_iter().enumerate().for_each(|(zone, count)| add(counts, zone, count));
        }
        homogeneity(&few, &many, 0).assert_fits(&format!("apple, {name}, buds awake by zones"));
    }
}
