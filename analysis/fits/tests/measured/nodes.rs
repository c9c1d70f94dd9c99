//! Nodes per growth unit: cherry (Fournier), poplar (Caraglio & Rey), beech, Nothofagus (Puntieri 2002).

use crate::table::{Table, is};
use phytomer_fits::nodes::laws::{Counts, Fitted};
use phytomer_fits::nodes::{Family, Part, fit_all, fit_mixture, fit_single};

const P: Family = Family::Poisson;
const B: Family = Family::Binomial;
const NB: Family = Family::NegativeBinomial;

fn histogram(dataset: &str) -> Option<Vec<f64>> {
    let table = Table::read("nodes_per_growth_unit_histograms.csv")?;
    let mut counts = Vec::new();
    for [nodes, count] in table.of(("dataset", dataset), ["n_nodes", "count"]) {
        let nodes: usize = nodes.parse().unwrap();
        counts.resize(counts.len().max(nodes + 1), 0.0);
        counts[nodes] += count.parse::<f64>().unwrap();
    }
    Some(counts)
}

#[track_caller]
fn bic(fitted: &Fitted, expected: f64, decimals: u32) {
    is(&fitted.1.law, fitted.1.bic().unwrap(), expected, decimals);
}

/// The law that is taken, and those within 2 of the best.
fn taken(counts: &[f64]) -> (Counts, Vec<String>) {
    let (laws, choice) = fit_all(counts).unwrap();
    (laws[choice.taken].clone(), choice.fits[..choice.rivals].iter().map(|fit| fit.law.clone()).collect())
}

#[test]
fn wild_cherry() {
    let Some(meri1) = histogram("meri1") else { return };
    let trunk = fit_single(&meri1, P, 0).unwrap();
    is("mean", trunk.1.value("mean"), 18.026, 3);
    bic(&trunk, 443.90, 2);
    assert_eq!(taken(&meri1).0.words(), "P(18.03)");
    let short = histogram("meri5").unwrap();
    let (law, fit) = fit_single(&short, B, 0).unwrap();
    assert_eq!(fit.value("n"), 7.0);
    is("p", fit.value("p"), 0.6255, 4);
    bic(&(law, fit), 226.10, 2);
    assert_eq!(taken(&short).0.words(), "B(7, 0.626)");
    let meri3 = histogram("meri3").unwrap();
    let (law, fit) = fit_mixture(&meri3, [B, B]).unwrap();
    assert_eq!((fit.value("n_1"), fit.value("n_2")), (10.0, 23.0));
    is("weight", fit.value("weight_1"), 0.215, 3);
    is("p", fit.value("p_1"), 0.685, 3);
    is("p", fit.value("p_2"), 0.635, 3);
    bic(&(law, fit), 652.54, 2);
}

#[test]
fn poplar_of_orders_two_and_three() {
    let Some(peup1) = histogram("peup1") else { return };
    let mixture = fit_mixture(&peup1, [P, NB]).unwrap();
    is("weight", mixture.1.value("weight_1"), 0.046, 3);
    is("mean", mixture.1.value("mean_1"), 8.50, 2);
    is("r", mixture.1.value("r_2"), 21.28, 2);
    is("p", mixture.1.value("p_2"), 0.414, 3);
    bic(&mixture, 1270.37, 2);
    bic(&fit_single(&peup1, NB, 0).unwrap(), 1277.92, 2);
    let peup2 = histogram("peup2").unwrap();
    let mixture = fit_mixture(&peup2, [P, NB]).unwrap();
    is("weight", mixture.1.value("weight_1"), 0.279, 3);
    is("mean", mixture.1.value("mean_1"), 12.24, 2);
    is("r", mixture.1.value("r_2"), 22.26, 2);
    is("p", mixture.1.value("p_2"), 0.469, 3);
    bic(&mixture, 2482.43, 2);
    bic(&fit_single(&peup2, NB, 0).unwrap(), 2486.60, 2);
}

/// Three laws say the counts of order 4 equally well. The shipped one, .529 P(9.43) + .471 NB(41.26, .688), is worse.
#[test]
fn poplar_of_order_four_is_a_tie() {
    let Some(peup3) = histogram("peup3") else { return };
    bic(&fit_mixture(&peup3, [B, NB]).unwrap(), 1525.3, 1);
    let shifted = fit_single(&peup3, NB, 4).unwrap();
    is("r", shifted.1.value("r"), 3.149, 3);
    is("p", shifted.1.value("p"), 0.243, 3);
    bic(&shifted, 1525.7, 1);
    bic(&fit_mixture(&peup3, [P, P]).unwrap(), 1526.3, 1);
    bic(&fit_mixture(&peup3, [P, NB]).unwrap(), 1529.0, 1);
    let (law, rivals) = taken(&peup3);
    assert_eq!((law.words().as_str(), rivals.len()), ("4 + NB(3.15, 0.243)", 3), "{rivals:?}");
}

/// The shipped .843 B(13, .622) + .157 B(35, .489) is of another n, which the profile refuses: its least n is 41, and
/// it has no largest.
#[test]
fn poplar_of_order_five() {
    let Some(peup4) = histogram("peup4") else { return };
    let mixture = fit_mixture(&peup4, [B, P]).unwrap();
    assert_eq!(mixture.1.value("n_1"), 12.0);
    is("weight", mixture.1.value("weight_1"), 0.815, 3);
    is("p", mixture.1.value("p_1"), 0.667, 3);
    is("mean", mixture.1.value("mean_2"), 16.12, 2);
    bic(&mixture, 736.52, 2);
    assert_eq!(taken(&peup4).0, mixture.0);
    let both = fit_mixture(&peup4, [B, B]).unwrap().1;
    let n = both.estimate("n_2").unwrap();
    assert_eq!((n.low, n.high), (Some(41.0), None), "{both:?}");
    assert!(both.notes.iter().any(|note| note.contains("n_2 has no upper limit")), "{:?}", both.notes);
    let shipped = [(0.843, Part::Binomial { n: 13, p: 0.622 }), (0.157, Part::Binomial { n: 35, p: 0.489 })];
    let mass = |k: u32| shipped.iter().map(|(w, part)| w * phytomer_sim::math::exp(part.ln_mass(k))).sum::<f64>();
    let l: f64 =
        peup4.iter().zip(0..).filter(|(c, _)| **c > 0.0).map(|(c, k)| c * phytomer_sim::math::log(mass(k))).sum();
    is("BIC as shipped", 5.0 * phytomer_sim::math::log(145.0) - 2.0 * l, 747.20, 2);
}

#[test]
fn beech_and_nothofagus() {
    let Some(beech) = histogram("fagus1") else { return };
    let (law, fit) = fit_single(&beech, B, 0).unwrap();
    assert_eq!((fit.value("n"), fit.value("p")), (10.0, 0.775));
    bic(&(law, fit), 308.13, 2);
    let buds = histogram("nothofagus_antarctica_bud_2").unwrap();
    let fitted = fit_single(&buds, P, 8).unwrap();
    is("mean", fitted.1.value("mean"), 0.84, 2);
    bic(&fitted, 128.08, 2);
    assert_eq!(taken(&buds).0, fitted.0);
    let shoots = histogram("nothofagus_antarctica_shoot_2").unwrap();
    let plain = fit_single(&shoots, P, 0).unwrap();
    is("mean", plain.1.value("mean"), 12.22, 2);
    bic(&plain, 440.3, 1);
    bic(&fit_single(&shoots, NB, 7).unwrap(), 442.6, 1);
}
