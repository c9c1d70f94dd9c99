//! Files of cylinders, small: each order of columns, and what is odd about them.

use super::{plants, read, text, written};
use crate::exchange::{Description, Link, Role, Value};

/// Six cylinders: radius, length, start, direction, parent, branch, order, position.
const TREE: [([f64; 8], [i64; 4]); 5] = [
    ([0.05, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [0, 1, 0, 1]),
    ([0.04, 0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0], [1, 1, 0, 2]),
    ([0.01, 0.3, 0.0, 0.0, 0.5, 0.6, 0.0, 0.8], [1, 2, 1, 1]),
    ([0.009, 0.25, 0.18, 0.0, 0.74, 0.0, 1.0, 0.0], [3, 2, 1, 2]),
    ([0.004, 0.1, 0.18, 0.0, 0.74, 0.0, -1.0, 0.0], [3, 3, 2, 1]),
];

/// The rows with their last columns in an order: `p` parent, `e` extension, `a` added, `u` unmodified radius, `b`
/// branch, `o` order, `n` position, `m` deviation, `c` coverage.
fn rows(order: &str) -> String {
    let row = |(shared, [parent, branch, order_of, position]): &([f64; 8], [i64; 4])| {
        let mut cells: Vec<String> = shared.iter().map(ToString::to_string).collect();
        cells.extend(order.chars().map(|column| match column {
            'p' => parent.to_string(),
            'b' => branch.to_string(),
            'o' => order_of.to_string(),
            'n' => position.to_string(),
            'u' => format!("{}", shared[0] * 1.25),
            'm' => "0.0125".to_owned(),
            'c' => "0.75".to_owned(),
            _ => "0".to_owned(),
        }));
        cells.join("\t") + "\r\n"
    };
    TREE.iter().map(row).collect()
}

/// Role, bearer, link and whole of an entity.
type Linked = (Role, Option<u32>, Option<Link>, Option<u32>);

fn wide() -> String {
    format!("radius (m)\tlength (m)\tstart_point\taxis_direction\tparent\r\n{}", rows("pebonmcau"))
}

fn links(description: &Description) -> Vec<Linked> {
    let entities = description.individuals[0].entities.iter();
    entities.map(|entity| (description.role_of(entity), entity.bearer, entity.link, entity.complex)).collect()
}

#[test]
fn each_order_of_columns_is_the_same_tree() {
    let expected = [
        (Role::Plant, None, None, None),
        (Role::Axis, None, None, Some(0)),
        (Role::Internode, None, None, Some(1)),
        (Role::Internode, Some(2), Some(Link::Follows), Some(1)),
        (Role::Axis, Some(2), Some(Link::Branches), Some(0)),
        (Role::Internode, None, None, Some(4)),
        (Role::Internode, Some(5), Some(Link::Follows), Some(4)),
        (Role::Axis, Some(5), Some(Link::Branches), Some(0)),
        (Role::Internode, None, None, Some(7)),
    ];
    for (file, features) in [(rows("peaubon"), 1), (rows("pebonau"), 1), (wide(), 3)] {
        let (tree, report) = read("treeqsm", &file);
        assert!(report.warnings().is_empty() && report.faults().is_empty(), "{report:?}");
        assert_eq!(links(&tree), expected);
        let last = tree.individuals[0].entities[8].latest().unwrap();
        assert_eq!((last.length, last.base_diameter, last.tip_diameter), (Some(0.1), Some(0.008), Some(0.008)));
        assert_eq!((last.place, last.direction), (Some([0.18, 0.0, 0.74]), Some([0.0, -1.0, 0.0])));
        // A feature that tells nothing, such as that nothing is added, is none.
        assert_eq!((tree.features.len(), last.values.len()), (features, features));
        assert_eq!(last.values[features - 1].1, Value::Real(0.005));
        let ranks: Vec<_> = tree.individuals[0].entities.iter().map(|entity| entity.index).collect();
        assert_eq!(
            ranks[1..].iter().flatten().copied().collect::<Vec<f64>>(),
            [1.0, 1.0, 2.0, 1.0, 1.0, 2.0, 1.0, 1.0]
        );
    }
}

#[test]
fn sums_are_kept_to_the_last_digits() {
    let tree = plants("treeqsm", &wide());
    let sums = |of: &Description| {
        let seen = of.individuals[0].entities.iter().filter_map(|entity| entity.latest());
        seen.filter_map(|seen| Some((seen.length?, seen.base_diameter?)))
            .fold((0.0, 0.0), |(length, volume), (l, d)| (length + l, volume + std::f64::consts::PI * d * d / 4.0 * l))
    };
    // Closed forms of the rows above.
    let volume: f64 = TREE.iter().map(|(row, _)| std::f64::consts::PI * row[0] * row[0] * row[1]).sum();
    assert!((sums(&tree).0 - 1.65).abs() < 1e-12 && (sums(&tree).1 / volume - 1.0).abs() < 1e-12);
    for word in ["treeqsm", "treeqsm15", "rtwig"] {
        let (out, losses) = written(word, &tree);
        let (found, report) = super::read_with(word, &out.main, &out.beside);
        assert!(!report.is_refused() && losses.is_empty(), "{losses:?} {report:?}");
        assert_eq!((links(&found), sums(&found)), (links(&tree), sums(&tree)), "{word}");
        assert_eq!(written(word, &found).0, out, "{word}");
    }
}

#[test]
fn columns_are_those_of_the_programs() {
    let tree = plants("treeqsm", &wide());
    let lines: Vec<String> = text(&written("treeqsm", &tree).0).lines().map(str::to_owned).collect();
    assert_eq!(lines[0].split('\t').count(), 13, "start and direction have a name each");
    assert_eq!(lines[4], "0.009\t0.25\t0.18\t0\t0.74\t0\t1\t0\t3\t0\t2\t1\t2\t0.0125\t0.75\t0\t0.01125");
    assert_eq!(lines[3], "0.01\t0.3\t0\t0\t0.5\t0.6\t0\t0.8\t1\t4\t2\t1\t1\t0.0125\t0.75\t0\t0.0125");
    let lines: Vec<String> = text(&written("treeqsm15", &tree).0).lines().map(str::to_owned).collect();
    assert_eq!(lines[2], "0.01\t0.3\t0\t0\t0.5\t0.6\t0\t0.8\t1\t4\t0\t0.0125\t2\t1\t1");
    let lines: Vec<String> = text(&written("rtwig", &tree).0).lines().map(str::to_owned).collect();
    assert_eq!(lines[0].split(',').next_back(), Some("branching_order"));
    // Segments go from branching to branching; a node is the segment before.
    let last: Vec<Vec<&str>> = lines[1..].iter().map(|line| line.split(',').skip(12).collect()).collect();
    assert_eq!(
        last,
        [["1", "1", "0", "0"], ["1", "2", "1", "0"], ["2", "3", "1", "1"], ["2", "4", "3", "1"], ["3", "5", "3", "2"]]
    );
    assert!(lines[3].starts_with("0,0,0.5,0.18,0,0.74,3,1,4,0.01,0.3,"), "{}", lines[3]);
}

#[test]
fn tables_of_simple_forest_are_read() {
    let table = "type, ID, parentID, startX, startY, startZ, endX, endY, endZ, radius, length, branchOrder, branchID, treeSpecies\n\
        cylinder, 0, -1, 0, 0, 0, 0, 0, 1, 0.1, 1.0, 0, 0, \"a, b\"\n\
        cylinder, 1, 0, 0, 0, 1, 0, 0, 3, 0.1, 2.0, 0, 0, x\n\
        cylinder, 2, 0, 0, 0, 1, 1, 0, 1, 0.05, 1.0, 1, 7, x\n";
    let (tree, report) = read("rtwig", table);
    assert!(report.faults().is_empty() && report.warnings().is_empty(), "{report:?}");
    let branch = &tree.individuals[0].entities[5];
    assert_eq!((tree.individuals[0].entities.len(), branch.complex), (6, Some(4)));
    assert_eq!(tree.individuals[0].entities[4].bearer, Some(2));
    assert_eq!(branch.latest().unwrap().direction, Some([1.0, 0.0, 0.0]));
}

#[test]
fn parents_may_stand_behind_their_children() {
    let mut lines: Vec<String> = rows("peaubon").lines().map(str::to_owned).collect();
    // The first row becomes the last: its number is 5 now, and the others are one less.
    lines.rotate_left(1);
    let renumbered: Vec<String> = lines
        .iter()
        .map(|line| {
            let mut cells: Vec<String> = line.split('\t').map(str::to_owned).collect();
            let parent: i64 = cells[8].parse().unwrap();
            cells[8] = match parent {
                0 => "0".to_owned(),
                1 => "5".to_owned(),
                other => (other - 1).to_string(),
            };
            cells.join("\t")
        })
        .collect();
    let (tree, report) = read("treeqsm", &renumbered.join("\n"));
    assert!(report.faults().is_empty() && report.warnings().is_empty(), "{report:?}");
    assert_eq!(links(&tree), links(&plants("treeqsm", &rows("peaubon"))));
}

#[test]
fn what_is_odd_about_axes_is_read_with_a_warning() {
    let table = "cyl_ID,parent_ID,axis_ID,startX,startY,startZ,endX,endY,endZ,radius_cyl,branching_order\n\
        1,0,1,0,0,0,0,0,1,0.1,1\n2,1,2,0,0,1,1,0,1,0.05,2\n3,2,1,1,0,1,2,0,1,0.05,3\n4,0,9,5,0,0,5,0,1,0.1,1\n\
        5,1,2,0,0,1,0,1,1,0.05,7\n";
    let (tree, report) = read("rtwig", table);
    let told: Vec<String> = report.warnings().iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "plant:4: the axis of the cylinder is begun already, and its parent does not lead to it: read as an axis of its \
             own (and 1 more like it)",
            "plant:5: the cylinder has no parent, as the base of the tree has none: read as an axis that springs from nothing",
            "plant:6: the order 7 is 2 by the parents: the parents count",
        ]
    );
    assert_eq!(tree.entities(), 11);
    assert_eq!(read("rtwig", &text(&written("rtwig", &tree).0)).0.entities(), 11);
}

#[test]
fn numbers_beyond_all_whole_ones_are_told() {
    let row = |parent: &str| format!("0.1 1 0 0 0 0 0 1 {parent} 0 0 0.1 1 0 1\n").replace(' ', "\t");
    for parent in ["-1e300", "1e300", "0.5"] {
        let (_, report) = read("treeqsm15", &row(parent));
        assert!(report.is_refused(), "{parent}");
        assert!(
            report.faults().iter().any(|fault| fault.problem.starts_with("the parent is")),
            "{:?}",
            report.faults()
        );
    }
    assert!(!read("treeqsm15", &row("0")).1.is_refused());
}
