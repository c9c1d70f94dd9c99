//! The geometric trees that ship (Aono & Kunii 1984): every row of Table 4 with its numbers, and a species for each row
//! of Table 2 whose numbers are those of `docs/geometric/hamano.csv`.
//!
//! Absent: the trees themselves, which are held against the formulas beside the model.

use phytomer_config::{Kind, Model, presets, validate_species};
use phytomer_models::geometric::{GeometricTree, Rule, TreeType};
use phytomer_models::law::{Constant, Variate};

/// The tree of a species that ships, and its type.
fn shipped(name: &str) -> (TreeType, GeometricTree) {
    let species = validate_species(name, 60).unwrap_or_else(|report| panic!("{}", report.render(false)));
    match species.species.model.clone() {
        Model::Gmt1(tree) => (TreeType::Gmt1, *tree.0),
        Model::Gmt2(tree) => (TreeType::Gmt2, *tree.0),
        Model::Gmt3(tree) => (TreeType::Gmt3, *tree.0),
        Model::Gmt4(tree) => (TreeType::Gmt4, *tree.0),
        other => panic!("{name} is of {:?}", other.name()),
    }
}

fn number(law: Option<&Variate>) -> Option<f64> {
    let domain = phytomer_models::law::Domain::ONCE;
    let range = phytomer_models::law::ValueRange { min: -1e9, max: 1e9, what: "a number" };
    law.and_then(|law| law.compile(&domain, &phytomer_models::fault::Path::root(), range).ok()?.exact())
}

/// The numbers of a branching, in the order of Table 4: h1, h2, R0, R1, R2; and R_diam and the divergence.
fn numbers(rule: &Rule) -> [Option<f64>; 7] {
    let laws = [&rule.h1_deg, &rule.h2_deg, &rule.r0, &rule.r1, &rule.r2, &rule.diameter_ratio, &rule.divergence_deg];
    laws.map(|law| number(law.as_ref()))
}

#[test]
fn every_row_of_table_4_is_a_species() {
    let (down, none) = (Some([0.3, 0.3, -0.3]), None);
    let east = [30.0, 0.0, 0.0];
    type Row = (&'static str, Option<[f64; 3]>, Vec<(f64, [f64; 3])>);
    let rows: [Row; 5] = [
        ("11a", down, Vec::new()),
        ("11b", down, Vec::new()),
        ("11c", none, vec![(1.6, east)]),
        ("11d", none, vec![(-1.0, east)]),
        ("11e", none, vec![(-0.6, east), (-1.6, [-30.0, 15.0, 0.0])]),
    ];
    for (row, deviation, controllers) in rows {
        let (of, tree) = shipped(&format!("gmt2/{row}"));
        let rule = &tree.tree.rule;
        assert_eq!((of, rule.deviation_m), (TreeType::Gmt2, deviation), "{row}");
        assert_eq!(
            numbers(rule),
            [Some(0.0), Some(-45.0), None, Some(0.9), Some(0.8), Some(0.7), Some(140.0)],
            "{row}"
        );
        let found: Vec<(f64, [f64; 3])> =
            rule.controller.iter().flatten().map(|one| (one.factor.value(), one.at_m)).collect();
        assert_eq!(found, controllers, "{row}");
        assert_eq!((tree.tree.levels.value(), number(Some(&tree.tree.first_length_m))), (10, Some(10.0)));
    }
    for (row, deviation) in [("12a", None), ("12b", None), ("12c", Some([0.0, 0.0, -0.6]))] {
        let (of, tree) = shipped(&format!("gmt3/{row}"));
        let rule = &tree.tree.rule;
        assert_eq!((of, rule.deviation_m), (TreeType::Gmt3, deviation), "{row}");
        let expected = [Some(60.0), Some(-60.0), Some(0.9), Some(0.6), Some(0.6), Some(0.7), Some(140.0)];
        assert_eq!(numbers(rule), expected, "{row}");
    }
    for (row, category) in [("13a", 1), ("13b", 1), ("13c", 2), ("13d", 3), ("13e", 4), ("13f", 5)] {
        let (of, tree) = shipped(&format!("gmt4/{row}"));
        let rule = &tree.tree.rule;
        assert_eq!((of, rule.category.as_ref().map(|n| n.value())), (TreeType::Gmt4, Some(category)), "{row}");
        assert_eq!(ends(rule), [Some(0.0), Some(0.0), Some(-90.0), Some(-20.0)], "{row}");
        assert_eq!(numbers(rule)[3..], [Some(0.9), Some(0.7), Some(0.7), Some(140.0)], "{row}");
    }
}

/// The greatest and the smallest angle of the left and of the right.
fn ends(rule: &Rule) -> [Option<f64>; 4] {
    [&rule.h1_max_deg, &rule.h1_min_deg, &rule.h2_max_deg, &rule.h2_min_deg]
        .map(|end| end.as_ref().map(Constant::value))
}

const TABLE_2: &str = include_str!("../../docs/geometric/hamano.csv");

/// The sums of the columns of Table 2b as the paper prints it, AVER., MAX., MIN., BOT., TOP, HEIGHT, LATERAL and
/// CATEGORY: computed apart, from its text.
const SUMS: [f64; 8] = [1310.0, 1913.0, 701.0, 1589.0, 1029.0, 182.3, 111.0, 43.0];

#[test]
fn every_row_of_table_2_is_a_species() {
    let mut sums = [0.0; 8];
    let mut trees = std::collections::BTreeSet::new();
    let mut rows = 0;
    for line in TABLE_2.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        // Names of authors have no comma.
        assert_eq!(cells.len(), 14, "{line}");
        let read = |place: usize| cells[place].parse::<f64>().unwrap_or_else(|_| panic!("{line}: {}", cells[place]));
        let [mean, _, _, bottom, top, height, lateral, category] = [5, 6, 7, 8, 9, 10, 11, 12].map(read);
        [5, 6, 7, 8, 9, 10, 11, 12].into_iter().zip(&mut sums).for_each(|(place, sum)| *sum += read(place));
        trees.insert(cells[0]);
        rows += 1;
        let (of, tree) = shipped(cells[13]);
        let rule = &tree.tree.rule;
        assert_eq!((of, rule.category.as_ref().map(|n| f64::from(n.value()))), (TreeType::Gmt4, Some(category)));
        let smallest = (bottom + top) / 2.0;
        let [greatest, smallest] = match category as u32 {
            5 => [smallest + 1.5 * (mean - smallest), smallest],
            _ => [bottom, top],
        };
        assert_eq!(ends(rule), [Some(0.0), Some(0.0), Some(-greatest), Some(-smallest)], "{line}");
        // One tree is wider than high; a ratio of contraction is at most 1.
        assert_eq!(number(rule.r2.as_ref()), Some(f64::min(lateral / height, 1.0)), "{line}");
        // Eqs. 1 and 2 at the growth level of the tree.
        let (levels, r1) = (tree.tree.levels.value(), number(rule.r1.as_ref()).expect("a ratio"));
        let series: f64 = (0..=levels).map(|k| phytomer_sim::math::pow(r1, f64::from(k))).sum();
        let high = number(Some(&tree.tree.first_length_m)).expect("a length") * series;
        assert!((high / height - 1.0).abs() < 1e-5, "{line}: {high} m");
    }
    assert_eq!((trees.len(), rows), (18, 23));
    for (found, expected) in sums.iter().zip(SUMS) {
        assert!((found - expected).abs() < 1e-9, "{sums:?} is not {SUMS:?}");
    }
    let species = presets(Kind::Species).iter().filter(|(name, _)| name.starts_with("hamano/")).count();
    assert_eq!(species, rows);
}

/// The mean of the angles of the tree of category 5 over s is that of the table: h_max − Δ/3.
#[test]
fn the_angles_of_category_5_have_the_mean_of_the_table() {
    let (_, tree) = shipped("hamano/chamaecyparis_pisifera_young");
    let [.., greatest, smallest] = ends(&tree.tree.rule).map(|end| end.expect("an angle").abs());
    assert!((greatest - (greatest - smallest) / 3.0 - 63.0).abs() < 1e-9);
}

/// Figs. 17 and 19: the numbers of the text, and the height and the reach of the exact ginkgo as they were measured:
/// H0/H = .174 and L/h = .75.
#[test]
fn the_fitted_trees_of_the_paper_are_species() {
    let (of, aucuba) = shipped("aono_kunii/aucuba");
    let expected = [Some(27.0), Some(-37.0), None, Some(0.786), Some(0.786), Some(0.7), None];
    assert_eq!((of, aucuba.tree.levels.value(), numbers(&aucuba.tree.rule)), (TreeType::Gmt1, 6, expected));
    for (name, ratios) in [("ginkgo", [0.826, 0.620]), ("ginkgo_exact", [0.902756, 0.677067])] {
        let (of, tree) = shipped(&format!("aono_kunii/{name}"));
        let [main, lateral] = ratios.map(Some);
        let expected = [Some(50.0), Some(-50.0), main, lateral, lateral, Some(0.7), None];
        assert_eq!((of, tree.tree.levels.value(), numbers(&tree.tree.rule)), (TreeType::Gmt3, 7, expected), "{name}");
    }
    let sum = |terms: u32| (0..terms).map(|k| phytomer_sim::math::pow(0.902756, f64::from(k))).sum::<f64>();
    let (height, reach) = (sum(8), 0.677067 * sum(7));
    assert!((1.0 / height - 0.174).abs() < 1e-6 && (reach / (height - 1.0) - 0.75).abs() < 1e-6);
}

/// Figs. 20 and 21: no number of them is printed, and each number of the files says that it is assumed.
#[test]
fn the_pine_and_the_zelkova_are_assumed() {
    let (of, pine) = shipped("aono_kunii/pine");
    let controllers = pine.tree.rule.controller.as_ref().map_or(0, Vec::len);
    assert_eq!((of, controllers, pine.tree.rule.deviation_m.is_some()), (TreeType::Gmt2, 2, true));
    assert!(pine.tree.leaf.is_some() && pine.glue.is_empty());
    let (of, zelkova) = shipped("aono_kunii/zelkova");
    let glued: Vec<TreeType> = zelkova.glue.iter().map(|glued| glued.model).collect();
    assert_eq!((of, glued), (TreeType::Gmt1, vec![TreeType::Gmt3]));
    for name in ["aono_kunii/pine", "aono_kunii/zelkova"] {
        let (_, text) = presets(Kind::Species).iter().find(|(own, _)| *own == name).expect("a species");
        let numbers = text.lines().filter(|line| line.contains("= {"));
        assert!(
            numbers.clone().count() > 12 && numbers.into_iter().all(|line| line.contains("assumed = true")),
            "{name}"
        );
        let bare = |line: &&str| {
            line.split_once("= ").is_some_and(|(_, value)| value.starts_with(|c: char| c.is_ascii_digit() || c == '-'))
        };
        assert_eq!(text.lines().filter(bare).count(), 0, "{name} has a number that does not say that it is assumed");
    }
}
