//! What is wrong with stated settings: a number out of its range, or a blade that crosses itself.

use super::Near;
use super::blade::Blade;
use super::cluster::{Brush, Cluster};
use super::head::{Capitulum, Flower};

/// A number of a setting: its key, its value, and the least and the most that it may be.
pub(super) type Bound = (&'static str, f32, [f32; 2]);

/// What is wrong with a setting: its keys, what was found and what is expected.
#[derive(Debug, Clone, PartialEq)]
pub struct Unsound {
    /// The keys from the setting down.
    pub keys: Vec<&'static str>,
    /// What was found.
    pub found: String,
    /// What is expected.
    pub expected: String,
}

impl Near {
    /// Everything that is wrong, for an organ of this width over its length.
    pub fn unsound(&self, aspect: f32) -> Vec<Unsound> {
        match self {
            Self::Blade(blade) => of_blade(blade, aspect, &["blade"]),
            Self::Flower(flower) => of_flower(flower, &[]),
            Self::Capitulum(head) => outside(&bounds_of_head(head), &["capitulum"]),
            Self::Brush(brush) => outside(&bounds_of_brush(brush), &["brush"]),
            Self::Cluster(cluster) => {
                let mut found = outside(&bounds_of_cluster(cluster), &["cluster"]);
                found.extend(cluster.flower.iter().flat_map(|flower| of_flower(flower, &["cluster"])));
                found
            }
        }
    }
}

/// What is wrong with a flower, whose table stands below some keys.
fn of_flower(flower: &Flower, above: &[&'static str]) -> Vec<Unsound> {
    let keys: Vec<&'static str> = above.iter().copied().chain(["flower"]).collect();
    let mut found = outside(&bounds_of_flower(flower), &keys);
    let keys: Vec<&'static str> = keys.into_iter().chain(["petal"]).collect();
    found.extend(of_blade(&flower.petal, flower.petal_width, &keys));
    found
}

fn of_blade(blade: &Blade, aspect: f32, keys: &[&'static str]) -> Vec<Unsound> {
    let mut found = outside(&bounds_of_blade(blade), keys);
    let aspect = if blade.leaflets > 0 { blade.leaflet_width } else { aspect };
    if found.is_empty() && blade.crosses(aspect) {
        found.push(Unsound {
            keys: keys.to_vec(),
            found: "the blade crosses itself".to_owned(),
            expected: "a smaller heart, notch, depth, fold or cup, or less arch against the fold".to_owned(),
        });
    }
    found
}

/// The numbers that are outside of their bounds. A number that is none is outside of all.
pub(super) fn outside(bounds: &[Bound], keys: &[&'static str]) -> Vec<Unsound> {
    let bad = bounds.iter().filter(|(_, value, [least, most])| !(least..=most).contains(&value));
    let told = |&(key, value, [least, most]): &Bound| Unsound {
        keys: keys.iter().copied().chain([key]).collect(),
        found: format!("{value}"),
        expected: format!("from {least} to {most}"),
    };
    bad.map(told).collect()
}

fn bounds_of_blade(blade: &Blade) -> [Bound; 21] {
    [
        ("stalk", blade.stalk, [0.0, 0.9]),
        ("widest_at", blade.widest_at, [0.02, 0.98]),
        ("oblong", blade.oblong, [1.0, 12.0]),
        ("heart", blade.heart, [0.0, 0.6]),
        ("notch", blade.notch, [0.0, 0.6]),
        ("claw", blade.claw, [0.0, 0.9]),
        ("divisions", f32::from(blade.divisions), [1.0, 60.0]),
        ("depth", blade.depth, [0.0, 0.95]),
        ("spread_deg", blade.spread_deg, [30.0, 350.0]),
        ("fold_deg", blade.fold_deg, [-85.0, 85.0]),
        ("arch_deg", blade.arch_deg, [-300.0, 300.0]),
        ("twist_deg", blade.twist_deg, [-360.0, 360.0]),
        ("wave", blade.wave, [0.0, 0.5]),
        ("cup", blade.cup, [-1.0, 1.0]),
        ("veins", f32::from(blade.veins), [0.0, 60.0]),
        ("leaflets", f32::from(blade.leaflets), [0.0, 60.0]),
        ("leaflet_width", blade.leaflet_width, [0.01, 2.0]),
        ("leaflet_deg", blade.leaflet_deg, [5.0, 120.0]),
        ("pale", blade.pale, [0.0, 1.0]),
        ("tears", blade.tears, [0.0, 1.0]),
        ("droop_deg", blade.droop_deg, [-85.0, 85.0]),
    ]
}

fn bounds_of_flower(flower: &Flower) -> [Bound; 10] {
    [
        ("petals", f32::from(flower.petals), [2.0, 40.0]),
        ("petal_width", flower.petal_width, [0.05, 2.0]),
        ("tube", flower.tube, [0.05, 0.95]),
        ("tube_width", flower.tube_width, [0.01, 0.6]),
        ("spread_deg", flower.spread_deg, [5.0, 120.0]),
        ("stamens", f32::from(flower.stamens), [0.0, 100.0]),
        ("stamen", flower.stamen, [0.0, 1.0]),
        ("sepals", f32::from(flower.sepals), [0.0, 12.0]),
        ("sepal", flower.sepal, [0.05, 1.5]),
        ("sepal_deg", flower.sepal_deg, [5.0, 170.0]),
    ]
}

fn bounds_of_head(head: &Capitulum) -> [Bound; 7] {
    [
        ("florets", f32::from(head.florets), [20.0, 1600.0]),
        ("rays", f32::from(head.rays), [0.0, 90.0]),
        ("bracts", f32::from(head.bracts), [0.0, 60.0]),
        ("disc", head.disc, [0.1, 0.95]),
        ("vault", head.vault, [0.0, 0.5]),
        ("unfolded", head.unfolded, [0.0, 1.0]),
        ("opened", head.opened.unwrap_or(0.0), [0.0, 1.0]),
    ]
}

fn bounds_of_brush(brush: &Brush) -> [Bound; 7] {
    [
        ("needles", f32::from(brush.needles), [2.0, 300.0]),
        ("bundle", f32::from(brush.bundle), [1.0, 8.0]),
        ("shoot", brush.shoot, [0.0, 1.0]),
        ("first_deg", brush.first_deg, [5.0, 120.0]),
        ("last_deg", brush.last_deg, [5.0, 120.0]),
        ("combed", brush.combed, [0.0, 1.0]),
        ("bend_deg", brush.bend_deg, [-90.0, 90.0]),
    ]
}

fn bounds_of_cluster(cluster: &Cluster) -> [Bound; 5] {
    [
        ("count", f32::from(cluster.count), [2.0, 240.0]),
        ("stalk", cluster.stalk, [0.0, 0.9]),
        ("width", cluster.width, [0.05, 4.0]),
        ("spread_deg", cluster.spread_deg, [5.0, 170.0]),
        ("middle", cluster.middle, [0.0, 0.8]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Apex, Base, FormName};

    #[test]
    fn the_settings_of_the_library_are_sound() {
        for form in FormName::ALL {
            for aspect in [0.05, 0.5, 1.2] {
                let unsound = form.near().map(|near| near.unsound(aspect)).unwrap_or_default();
                assert!(unsound.is_empty(), "{form:?}: {unsound:?}");
            }
        }
    }

    #[test]
    fn numbers_out_of_range_and_crossing_blades_are_told_with_their_keys() {
        let of = |blade: Blade| Near::Blade(blade).unsound(0.5);
        assert_eq!(of(Blade::default()), []);
        let told = of(Blade { stalk: 0.95, cup: f32::NAN, ..Blade::default() });
        let keys: Vec<Vec<&str>> = told.iter().map(|unsound| unsound.keys.clone()).collect();
        assert_eq!(keys, [["blade", "stalk"], ["blade", "cup"]]);
        assert_eq!((told[0].found.as_str(), told[0].expected.as_str()), ("0.95", "from 0 to 0.9"));
        // A gutter that is rolled up against its fold: its edges would pass through one another.
        let rolled = of(Blade { fold_deg: 80.0, arch_deg: -280.0, ..Blade::default() });
        assert!(rolled[0].found.contains("crosses itself"));
        assert_eq!(of(Blade { fold_deg: 80.0, arch_deg: 280.0, ..Blade::default() }), []);
        let petal = Flower { petal: Blade { claw: 2.0, ..Blade::default() }, ..Flower::default() };
        assert_eq!(Near::Flower(petal).unsound(1.0)[0].keys, ["flower", "petal", "claw"]);
        let cluster = Cluster { count: 1, flower: Some(petal), ..Cluster::default() };
        let told: Vec<Vec<&str>> = Near::Cluster(cluster).unsound(1.0).into_iter().map(|told| told.keys).collect();
        assert_eq!(told, [vec!["cluster", "count"], vec!["cluster", "flower", "petal", "claw"]]);
        assert_eq!(Near::Brush(Brush { shoot: 2.0, ..Brush::default() }).unsound(1.0)[0].keys, ["brush", "shoot"]);
    }

    /// An outline is widest where it says, half its width there, and closed at both ends.
    #[test]
    fn an_outline_is_widest_where_it_is_said_to_be() {
        for base in [Base::Attenuate, Base::Cuneate, Base::Convex, Base::Rounded, Base::Truncate] {
            for apex in [Apex::Acuminate, Apex::Acute, Apex::Convex, Apex::Rounded, Apex::Truncate] {
                for widest_at in [0.2, 0.5, 0.8] {
                    let blade = Blade { base, apex, widest_at, ..Blade::default() };
                    assert!((blade.rim(widest_at).aside - 0.5).abs() < 1e-6);
                    assert!(blade.rim(0.0).aside < 1e-3 && blade.rim(1.0).aside < 1e-3, "{base:?} {apex:?}");
                    let before = (0..=20).map(|k| blade.rim(widest_at * k as f32 / 20.0).aside);
                    assert!(before.collect::<Vec<_>>().is_sorted());
                }
            }
        }
    }
}
