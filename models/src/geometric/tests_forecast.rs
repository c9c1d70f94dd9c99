//! Trees of any parameters: no panic, the forecast of their counts, and growth levels that explode.
//!
//! Parameters come from the keyed streams of the program, so that a failing tree is found again by its number. Absent:
//! where the branches of a tree stand.

use super::tests::rule;
use super::{
    CombinedLevels, Controller, CutLateral, Descriptor, Falloff, GeometricTree, GluedTree, Rule, TreeLeaf, TreeType,
};
use crate::contract;
use crate::fault::Path;
use crate::law::{Constant, Variate};
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose, Stream};

/// A source of parameters, good and bad.
struct Dice(Stream);

impl Dice {
    fn of(number: u32) -> Self {
        Self(PlantRandom::new(1984, number.into()).stream(LineageKey(7), Purpose::Node))
    }

    fn one_of<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.0.word() as usize % all.len()].clone()
    }

    fn happens(&mut self, in_ten: u32) -> bool {
        self.0.word() % 10 < in_ten
    }

    fn mostly(&mut self) -> bool {
        self.0.word() % 100 < 98
    }

    /// A number that is sound in most cases.
    fn number(&mut self, least: f64, most: f64) -> f64 {
        if self.mostly() {
            return least + (most - least) * self.0.share();
        }
        self.one_of(&[0.0, -0.0, 1.0, -1.0, 1e-320, -1e300, f64::NAN, f64::INFINITY, 180.0, 360.0, 1e-12])
    }

    fn law(&mut self, least: f64, most: f64) -> Option<Variate> {
        self.mostly().then(|| self.number(least, most).into())
    }

    fn constant(&mut self, least: f64, most: f64) -> Option<Constant> {
        self.happens(3).then(|| self.number(least, most).into())
    }

    fn level(&mut self) -> u32 {
        let small = self.0.word() % 6;
        if self.mostly() { small } else { self.one_of(&[0, 18, 19, 28, 29, 1000, u32::MAX]) }
    }

    fn rule(&mut self) -> Rule {
        let changes = self.happens(3);
        Rule {
            h1_deg: self.law(-90.0, 90.0),
            h2_deg: self.law(-90.0, 90.0),
            r0: if self.happens(5) { self.law(0.3, 1.0) } else { None },
            r1: self.law(0.3, 1.0),
            r2: self.law(0.3, 1.0),
            diameter_ratio: self.law(0.3, 1.0),
            divergence_deg: self.law(-360.0, 360.0),
            divergence: self.happens(1).then(|| self.one_of(&["2/5", "spiral", "2/4"]).to_owned()),
            delta_deg: if self.happens(3) { self.law(-360.0, 360.0) } else { None },
            deviation_m: self.happens(3).then(|| [0; 3].map(|_| self.number(-2.0, 2.0))),
            controller: self.happens(3).then(|| (0..3).map(|_| self.controller()).collect()),
            category: changes.then(|| (self.0.word() % 7).into()),
            curve: None,
            phi_deg: if changes { self.constant(90.0, 200.0) } else { None },
            peak: if changes { self.constant(0.1, 0.9) } else { None },
            h1_max_deg: if changes { self.constant(0.0, 90.0) } else { None },
            h1_min_deg: if changes { self.constant(0.0, 90.0) } else { None },
            h2_max_deg: if changes { self.constant(-90.0, 0.0) } else { None },
            h2_min_deg: if changes { self.constant(-90.0, 0.0) } else { None },
        }
    }

    fn controller(&mut self) -> Controller {
        Controller {
            factor: self.number(-3.0, 3.0).into(),
            at_m: [0; 3].map(|_| self.number(-30.0, 30.0)),
            from_level: self.happens(3).then(|| self.level().into()),
            to_level: self.happens(3).then(|| self.level().into()),
            falloff: self.one_of(&[Falloff::None, Falloff::Inverse]),
        }
    }

    fn descriptor(&mut self) -> Descriptor {
        let mut tree = Descriptor::new(self.rule(), self.level());
        if self.happens(2) {
            tree.first_length_m = self.number(0.1, 10.0).into();
            tree.first_direction = Some([0; 3].map(|_| self.number(-1.0, 1.0)));
        }
        if self.happens(3) {
            let (from, model) = (self.level(), Some(self.one_of(&TreeType::ALL)));
            let rule = if self.happens(5) { self.rule() } else { Rule::default() };
            let to_level = (from.saturating_add(self.0.word() % 2)).into();
            tree.combine.push(CombinedLevels { model, from_level: from.into(), to_level, rule });
        }
        if self.happens(3) {
            tree.cut_axis = Some(self.level().into());
            let to_level = self.happens(5).then(|| self.level().into());
            tree.cut_lateral.push(CutLateral { level: self.level().into(), to_level });
        }
        if self.happens(3) {
            let number = self.level().into();
            tree.leaf = Some(TreeLeaf { number, from_level: Some(self.level().into()), ..TreeLeaf::default() });
        }
        tree
    }

    fn tree(&mut self) -> GeometricTree {
        let mut tree = GeometricTree::from(self.descriptor());
        if self.happens(2) {
            tree.glue.push(GluedTree { model: self.one_of(&TreeType::ALL), tree: self.descriptor() });
        }
        tree.ticks_per_level = self.happens(3).then(|| (self.level() % 5).into());
        tree
    }
}

/// Each tree is refused with faults, or grows to its forecast: exactly, or at most where deviators can move a branch to
/// nothing.
#[test]
fn any_tree_is_refused_or_grows_as_it_is_foretold() {
    let (mut refused, mut exact, mut at_most) = (0, 0, 0);
    for number in 0..12_000 {
        let mut dice = Dice::of(number);
        let (of, tree) = (dice.one_of(&TreeType::ALL), dice.tree());
        let Ok(model) = tree.compile(of, 60_000, &Path::root()) else {
            refused += 1;
            continue;
        };
        let age = tree.full_grown_at();
        let expected = model.expectation(age).expect("a forecast");
        assert_eq!(expected.components(age), model.components_at(age) as f64, "tree {number}");
        if model.components_at(age) > 3000 {
            continue;
        }
        for age in [1, age.div_ceil(2), age] {
            let plant = contract::grown(&model, age, &contract::seed_of(5, number));
            let (found, told) = (f64::from(plant.components()), expected.components(age));
            let is_exact = expected.least_components(age) == told;
            assert!(
                if is_exact { found == told } else { found <= told },
                "tree {number} at age {age}: {found}, {told}"
            );
            if is_exact {
                exact += 1
            } else {
                at_most += 1
            }
            let all = plant.nodes.length.iter().chain(&plant.nodes.primary_diameter);
            assert!(all.clone().all(|x| x.is_finite() && *x >= 0.0), "tree {number}");
        }
    }
    assert!(refused > 1000 && exact > 1000 && at_most > 100, "{refused} refused, {exact} exact, {at_most} at most");
}

/// What is accepted keeps the contract, whatever it is made of.
#[test]
fn trees_of_any_parameters_keep_the_contract_of_growth_models() {
    let mut kept = 0;
    for number in 0..1500 {
        let mut dice = Dice::of(number);
        let (of, tree) = (dice.one_of(&TreeType::ALL), dice.tree());
        let Ok(model) = tree.compile(of, 60_000, &Path::root()) else { continue };
        let age = tree.full_grown_at();
        if model.components_at(age) < 400 && age < 12 {
            contract::check(&model, age, number.into());
            kept += 1;
        }
    }
    assert!(kept > 50, "{kept} trees");
}

#[test]
fn growth_levels_that_explode_are_refused() {
    let ternary = Rule { r0: Some(0.9.into()), ..rule([60.0, -60.0], [0.9, 0.9], 140.0) };
    let faults = |of: TreeType, rule: &Rule, levels: u32| -> Vec<String> {
        let tree = GeometricTree::from(Descriptor::new(rule.clone(), levels));
        tree.check(of, &Path::root()).iter().map(ToString::to_string).collect()
    };
    assert_eq!(faults(TreeType::Gmt3, &ternary, 18), [""; 0]);
    let told = "levels: levels is 19: a tree of (3^20 − 1)/2 branches; expected at most 18 growth levels";
    assert_eq!(faults(TreeType::Gmt3, &ternary, 19), [told]);
    let told = "levels: levels is 40: a tree of (3^41 − 1)/2 branches; expected at most 18 growth levels";
    assert_eq!(faults(TreeType::Gmt3, &ternary, 40), [told]);
    for of in [TreeType::Gmt1, TreeType::Gmt2, TreeType::Gmt4] {
        let binary = rule([30.0, -60.0], [0.9, 0.9], 140.0);
        assert_eq!(faults(of, &binary, 28), [""; 0]);
        let told = "levels: levels is 29: a tree of 2^30 branches; expected at most 28 growth levels";
        assert_eq!(faults(of, &binary, 29), [told]);
    }
    // A tree that fits alone and not with its like.
    let mut glued = GeometricTree::from(Descriptor::new(ternary.clone(), 18));
    glued.glue = vec![GluedTree { model: TreeType::Gmt3, tree: Descriptor::new(ternary, 18) }];
    let told = glued.check(TreeType::Gmt3, &Path::root());
    assert!(told.len() == 1 && told[0].to_string().starts_with("glue: the trees on one root have"), "{told:?}");
}
