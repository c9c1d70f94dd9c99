//! Fates of axillary buds on the first annual shoots of apple trunks (Costes), of seven cultivars.

use crate::table::{Table, is};
use phytomer_fits::branching::chain::{self, Asked};
use phytomer_fits::branching::order::orders;
use phytomer_fits::branching::runs::runs;
use phytomer_fits::branching::{Shoots, zones};

const CULTIVARS: [&str; 7] = ["belren", "elstar", "fuji", "gala", "granny", "reinet", "wij"];

fn shoots(cultivar: &str) -> Option<Shoots> {
    let table = Table::read("apple_trunk_axillary_fates.csv")?;
    let mut shoots: Vec<Vec<usize>> = Vec::new();
    let mut last = "";
    for [trunk, fate] in table.of(("cultivar", cultivar), ["trunk_id", "fate"]) {
        if trunk != last {
            shoots.push(Vec::new());
            last = trunk;
        }
        shoots.last_mut().unwrap().push(fate.parse().unwrap());
    }
    Some(Shoots::new(5, shoots).unwrap())
}

#[test]
fn zones_and_chain_of_fuji() {
    let Some(fuji) = shoots("fuji") else { return };
    let (law, zones) = zones::fit(&fuji, 6);
    is("zones", zones.log_likelihood.unwrap(), -1011.80, 2);
    assert_eq!((zones.parameters, fuji.runs()), (37, 399));
    let told = runs(&fuji, 1988, 1000, |buds, draws| law.draw(buds, draws));
    println!("zones: {} runs, {:.0} ± {:.0}", told.measured, told.mean, told.sd);
    assert!((told.mean - 567.0).abs() < 4.0 && (told.sd - 18.0).abs() < 2.0, "{told:?}");
    let asked = Asked { zones: 7, ends: Some(0), seed: 1988, beginnings: 40 };
    let (law, chain) = chain::fit(&fuji, &asked).unwrap();
    println!("{:?} {} {:?}", chain.log_likelihood, chain.parameters, law);
    assert!(chain.log_likelihood.unwrap() >= -898.3, "{:?}", chain.log_likelihood);
    assert!(chain.bic() < zones.bic());
    let told = runs(&fuji, 1988, 1000, |buds, draws| law.draw(buds, draws));
    println!("chain: {} runs, {:.0} ± {:.0}", told.measured, told.mean, told.sd);
    assert!((told.mean - 429.0).abs() < 12.0 && told.z().abs() < 3.0, "{told:?}");
}

#[test]
fn independent_buds_are_refused_in_every_cultivar() {
    for cultivar in CULTIVARS {
        let Some(shoots) = shoots(cultivar) else { return };
        let (law, _) = zones::fit(&shoots, 6);
        let told = runs(&shoots, 1988, 600, |buds, draws| law.draw(buds, draws));
        println!("{cultivar}: {} runs, {:.0} ± {:.0}, z {:.1}", told.measured, told.mean, told.sd, told.z());
        assert!((-11.6..-8.4).contains(&told.z()), "{cultivar}: {told:?}");
    }
}

/// Along a shoot a fate tells more of the next than the shares alone do.
#[test]
fn fates_of_fuji_have_a_memory() {
    let Some(fuji) = shoots("fuji") else { return };
    let fits = orders(&fuji).unwrap();
    assert!(fits[1].bic() < fits[0].bic());
}
