//! The turtle against the positions of Synthetic Topiary (Fig. 2), the formulas of Prusinkiewicz & Lindenmayer 1990 and
//! the mean tips of their Figs. 2.6a and 2.8a, which an independent interpreter computed.

use super::{Command, Drawing, Query, Turtle, Vector};
use crate::lsystem::view::View;

fn turtle_of(view: &str) -> Turtle {
    Turtle::new(&View::read(view).expect("a view file"))
}

/// Lets a turtle read modules such as `F(2)`, told by name and parameters; each line that it draws.
fn lines(turtle: &mut Turtle, modules: &[(&str, &[f64])]) -> Vec<(Vector, Vector, f64, f64)> {
    let mut lines = Vec::new();
    for (name, parameters) in modules {
        if let Some(Drawing::Line { from, length, width, .. }) = turtle.follow(Command::of(name), parameters) {
            lines.push((from.position, from.heading, length, width));
        }
    }
    lines
}

fn near(one: Vector, other: Vector) -> bool {
    one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-12)
}

/// L-system 2, μ3: F(3)?P(0,3)-F(2)?P(2,3)-F(1)?P(2,2)-A.
#[test]
fn a_query_stands_where_figure_2_shows_it() {
    let mut turtle = turtle_of("angle increment: 90");
    let mut found = Vec::new();
    for name in ["F", "?P", "-", "F", "?P", "-", "F", "?P", "-", "A"] {
        let length = [3.0 - (found.len() as f64)];
        let parameters = if name == "F" { &length[..] } else { &[] };
        let told = turtle.follow(Command::of(name), parameters).is_some();
        if told && name == "?P" {
            found.push(turtle.state().frame.position);
        }
    }
    for (found, expected) in found.into_iter().zip([[0.0, 3.0, 0.0], [2.0, 3.0, 0.0], [2.0, 2.0, 0.0]]) {
        assert!(near(found, expected), "{found:?} is not {expected:?}");
    }
    let query = turtle.follow(Command::of("?U"), &[]);
    assert_eq!(query, Some(Drawing::Query(Query::Axis(super::Axis::Up))));
}

/// What each turn makes of H, L and U at the beginning, and that its opposite takes it back.
#[test]
fn turns_go_the_way_of_the_book() {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let minus = |v: Vector| v.map(|x: f64| -x);
    let cases = [
        ("+", "-", [minus(x), minus(y), z]),
        ("&", "^", [minus(z), minus(x), y]),
        ("/", "\\", [y, z, x]),
        ("|", "|", [minus(y), x, z]),
    ];
    for (turn, back, [heading, left, up]) in cases {
        let mut turtle = turtle_of("angle factor: 4");
        turtle.follow(Command::of(turn), &[]);
        let frame = turtle.state().frame;
        assert!(near(frame.heading, heading) && near(frame.left, left) && near(frame.up, up), "{turn}: {frame:?}");
        turtle.follow(Command::of(back), &[90.0]);
        assert!(near(turtle.state().frame.heading, y) && near(turtle.state().frame.left, minus(x)), "{turn}{back}");
    }
}

/// `$` makes L horizontal and keeps H; upright nothing turns.
#[test]
fn a_roll_makes_the_left_horizontal() {
    for roll in ["$", "@v"] {
        let mut turtle = turtle_of("");
        lines(&mut turtle, &[("/", &[37.0]), (roll, &[])]);
        let rolled = turtle.state().frame.left;
        assert!(rolled[2].abs() > 0.5, "H is vertical, so nothing turns: {rolled:?}");
        lines(&mut turtle, &[("+", &[50.0]), ("&", &[20.0]), ("/", &[70.0])]);
        let before = turtle.state().frame.heading;
        lines(&mut turtle, &[(roll, &[])]);
        let frame = turtle.state().frame;
        assert!(near(frame.heading, before) && frame.left[1] == 0.0, "{frame:?}");
        // L = V × H / |V × H| and U = H × L, V being (0, 1, 0).
        let [a, b, c] = before;
        let length = (a * a + c * c).sqrt();
        assert!(near(frame.left, [c / length, 0.0, -a / length]), "{frame:?}");
        assert!(near(frame.up, [-a * b / length, length, -b * c / length]), "{frame:?}");
    }
}

/// After each segment α = e |H × T| about H × T, T as given: of length 2 and at a right angle to H it is 2 e.
#[test]
fn a_tropism_turns_after_each_step() {
    let mut turtle = turtle_of("tropism direction: 0,-2,0\ninitial elasticity: 0.1\nelasticity increment: 0.05");
    let drawn =
        lines(&mut turtle, &[("F", &[]), ("-", &[90.0]), ("F", &[]), ("F", &[]), ("_", &[]), ("f", &[]), ("F", &[])]);
    let headings: Vec<Vector> = drawn.iter().map(|line| line.1).collect();
    assert_eq!(headings[0], [0.0, 1.0, 0.0]);
    let along = |angle: f64| [phytomer_sim::math::cos(angle), -phytomer_sim::math::sin(angle), 0.0];
    let (first, second) = (0.2, 0.2 + 0.2 * phytomer_sim::math::cos(0.2));
    let third = second + 0.3 * phytomer_sim::math::cos(second);
    for (found, angle) in headings[1..].iter().zip([0.0, first, third]) {
        assert!(near(*found, along(angle)), "{found:?} is not at {angle}");
    }
    lines(&mut turtle, &[("_", &[0.0]), ("F", &[])]);
    let before = turtle.state().frame;
    lines(&mut turtle, &[("F", &[])]);
    assert_eq!(turtle.state().frame.heading, before.heading);
}

/// A numbered tropism turns before its line; by brackets its susceptibility comes back. At 90° to its vector the
/// heading rests.
#[test]
fn a_numbered_tropism_turns_before_its_line() {
    let mut turtle = turtle_of("tropism: T: 0 1 0 E: 0.0 S: 0.1\ntropism: T: 0 3 0 A: 90");
    let told: [(&str, &[f64]); 10] = [
        ("-", &[90.0]),
        ("F", &[]),
        ("[", &[]),
        ("@Ti", &[1.0]),
        ("F", &[]),
        ("]", &[]),
        ("F", &[]),
        ("@Ts", &[2.0, 0.5]),
        ("F", &[]),
        ("@Td", &[9.0]),
    ];
    let drawn = lines(&mut turtle, &told);
    let sines: Vec<f64> = drawn.iter().map(|line| line.1[1]).collect();
    assert!((sines[1] - phytomer_sim::math::sin(0.1)).abs() < 1e-15, "{sines:?}");
    assert!(sines[0].abs() < 1e-15 && sines[2].abs() < 1e-15, "{sines:?}");
    assert!(sines[3].abs() < 1e-12, "at a right angle to its vector it rests: {sines:?}");
}

/// A bracket keeps what changes within it, however many tropisms there are.
#[test]
fn brackets_keep_the_susceptibilities_that_change() {
    let mut turtle = turtle_of(&"tropism: T: 0 1 0 E: 0.0 S: 0.1\n".repeat(256));
    (0..100_000).for_each(|_| _ = turtle.follow(Command::Open, &[]));
    assert!(turtle.changed.is_empty());
    turtle.follow(Command::of("@Ts"), &[256.0, 0.5]);
    for _ in 0..2 {
        turtle.follow(Command::Open, &[]);
        turtle.follow(Command::of("@Ti"), &[256.0]);
        turtle.follow(Command::of("@Ti"), &[1.0]);
    }
    assert_eq!((turtle.elasticities[255], turtle.elasticities[0]), (0.7, 0.2));
    turtle.follow(Command::Close, &[]);
    assert_eq!((turtle.elasticities[255], turtle.elasticities[0]), (0.6, 0.1));
    (0..100_001).for_each(|_| _ = turtle.follow(Command::Close, &[]));
    assert_eq!((turtle.elasticities[255], turtle.changed.len()), (0.0, 0));
}

#[test]
fn widths_colours_and_scales_go_up_and_down_and_brackets_give_them_back() {
    let mut turtle = turtle_of(
        "initial line width: 2\nline width increment: 0.5\ninitial color: 3 9\ncolor increment: 2\nscale multiplier: 2",
    );
    let told: [(&str, &[f64]); 11] = [
        ("#", &[]),
        ("F", &[]),
        ("[", &[]),
        ("!", &[0.25]),
        (";", &[]),
        ("@Di", &[]),
        ("F", &[2.0]),
        ("!", &[]),
        ("F", &[-1.0]),
        ("]", &[]),
        ("F", &[]),
    ];
    let drawn = lines(&mut turtle, &told);
    let sizes: Vec<(f64, f64)> = drawn.iter().map(|line| (line.2, line.3)).collect();
    assert_eq!(sizes, [(1.0, 2.5), (4.0, 0.25), (2.0, 0.0), (1.0, 2.5)]);
    // A line of a negative length is told from where the turtle left.
    assert_eq!((drawn[2].0, drawn[2].1), ([0.0, 5.0, 0.0], [0.0, -1.0, 0.0]));
    assert_eq!(turtle.state().colour, [3, 9]);
    lines(&mut turtle, &[(",", &[]), (",", &[]), ("@;", &[300.0]), ("@D", &[3.0]), ("f", &[])]);
    assert_eq!((turtle.state().colour, turtle.state().frame.position), ([255, 44], [0.0, 5.0, 0.0]));
    assert_eq!(turtle.follow(Command::of("@O"), &[]), Some(Drawing::Mark(super::Mark::Sphere, 2.5)));
    let surface = Drawing::Surface { symbol: 'l', scale: [3.0, 6.0, 9.0] };
    assert_eq!(turtle.follow(Command::of("~l"), &[1.0, 2.0, 3.0]), Some(surface));
}

/// Corners are the ends of `F` and `f` and the dots, of `G` and `g` not; no line is drawn within.
#[test]
fn a_polygon_has_its_corners() {
    let mut turtle = turtle_of("angle factor: 4");
    let polygon = ["{", ".", "F", "-", "G", "g", "[", "f", "]", ".", "{", ".", "-", "f", ".", "}"];
    for name in polygon {
        match turtle.follow(Command::of(name), &[]) {
            Some(Drawing::Polygon { corners, .. }) => assert_eq!(corners.len(), 3, "the inner one"),
            other => assert_eq!(other, None, "{name}"),
        }
    }
    assert!(turtle.in_polygon());
    let Some(Drawing::Polygon { from, corners }) = turtle.follow(Command::PolygonEnd, &[]) else { panic!("it ends") };
    let expected = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [3.0, 1.0, 0.0], [2.0, 1.0, 0.0]];
    assert_eq!(corners.len(), 4);
    assert!(corners.iter().zip(expected).all(|(corner, expected)| near(*corner, expected)), "{corners:?}");
    assert_eq!(from.position, [0.0; 3]);
    assert!(!turtle.in_polygon() && turtle.follow(Command::PolygonEnd, &[]).is_none());
    assert_eq!(lines(&mut turtle, &[("F", &[])]).len(), 1);
}

/// A generalised cylinder goes from point to point, and `F` in it only moves.
#[test]
fn a_generalised_cylinder_goes_from_point_to_point() {
    for [start, end] in [[("@Gs", &[][..]), ("@Ge", &[][..])], [("{", &[1.0][..]), ("}", &[1.0][..])]] {
        let mut turtle = turtle_of("angle factor: 4");
        let told = [start, ("F", &[]), ("-", &[]), ("F", &[]), ("@Gc", &[]), ("@Gc", &[]), ("f", &[]), end, ("F", &[])];
        let drawn = lines(&mut turtle, &told);
        assert_eq!(drawn.len(), 3);
        let half = 0.5_f64.sqrt();
        assert!(near(drawn[0].1, [half, half, 0.0]) && (drawn[0].2 - 2.0_f64.sqrt()).abs() < 1e-15, "{drawn:?}");
        assert!(near(drawn[1].0, [1.0, 1.0, 0.0]) && drawn[2].2 == 1.0, "{drawn:?}");
    }
}

/// Without contours and where `twist of cylinders` is on, a part has the upper side of the turtle where it ends; else
/// it turns no more than the cylinder bends, whatever rolls between.
#[test]
fn cylinders_with_contours_do_not_twist() {
    let ups = |view: &str| {
        let mut turtle = turtle_of(view);
        let told: [(&str, &[f64]); 8] = [
            ("@#", &[3.0]),
            ("@Gs", &[]),
            ("f", &[]),
            ("@Gc", &[]),
            ("/", &[90.0]),
            ("f", &[]),
            ("@Ge", &[]),
            ("F", &[]),
        ];
        let mut ups = Vec::new();
        for (name, parameters) in told {
            if let Some(Drawing::Line { from, contour, .. }) = turtle.follow(Command::of(name), parameters) {
                ups.push((from.up, contour));
            }
        }
        ups
    };
    let [start, rolled] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    for (view, second) in
        [("", rolled), ("contour: 3 a.con\ntwist of cylinders: on", rolled), ("contour: 3 a.con", start)]
    {
        let ups = ups(view);
        assert!(near(ups[0].0, start) && near(ups[1].0, second) && near(ups[2].0, rolled), "{view}: {ups:?}");
        assert_eq!(ups.iter().map(|(_, contour)| *contour).collect::<Vec<_>>(), [3, 3, 0]);
    }
}

/// The source of cpfg, with its U = −H × L: a torque E T rolls the turtle about H towards the part of T across H by E
/// |U × part|, at most 1 rad. H is up, U of cpfg is −z, and T = (3, 0, 4) / 5 of the length 1: the part across H is T,
/// and |U × T| is 0.6. Torques are numbered with tropisms.
#[test]
fn a_torque_rolls_the_turtle_towards_its_vector() {
    let rolled = |strength: f64| {
        let mut turtle = turtle_of("tropism: T: 1 0 0 A: 10\ntorque: T: 3 0 4");
        lines(&mut turtle, &[("@Ts", &[2.0, strength]), ("f", &[])]);
        let frame = turtle.state().frame;
        assert!(near(frame.heading, [0.0, 1.0, 0.0]), "the heading stays");
        frame.up.map(|x| -x)
    };
    let (sin, cos) = phytomer_sim::math::sincos(0.5 * 0.6);
    assert!(near(rolled(0.5), [sin, 0.0, -cos]), "{:?}", rolled(0.5));
    let (sin, cos) = phytomer_sim::math::sincos(1.0);
    assert!(near(rolled(90.0), [sin, 0.0, -cos]), "no more than 1 rad: {:?}", rolled(90.0));
    assert!(near(rolled(0.0), [0.0, 0.0, -1.0]));
    let mut along = turtle_of("torque: T: 0 1 0 E: 1");
    lines(&mut along, &[("f", &[])]);
    assert!(near(along.state().frame.up, [0.0, 0.0, 1.0]), "along H nothing turns");
}

#[test]
fn a_turtle_may_be_placed_and_headed_and_bears_any_number() {
    let mut turtle = turtle_of("");
    lines(&mut turtle, &[("@M", &[1.0, 2.0, 3.0]), ("@R", &[0.0, 0.0, 2.0, 1.0, 0.0, 0.0])]);
    let frame = turtle.state().frame;
    assert!(near(frame.heading, [0.0, 0.0, 1.0]) && near(frame.up, [1.0, 0.0, 0.0]), "{frame:?}");
    assert!(near(frame.left, [0.0, -1.0, 0.0]) && frame.position == [1.0, 2.0, 3.0], "{frame:?}");
    lines(&mut turtle, &[("@R", &[0.0, 0.0]), ("@R", &[0.0, 0.0, -1.0])]);
    assert!(near(turtle.state().frame.heading, [0.0, 0.0, -1.0]));
    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, -1e300] {
        let told = ["F", "f", "+", "&", "/", "!", ";", "@Di", "@M", "@R", "@o", "~l", "_", "@Ti", "F", "]", "}", "."];
        for name in told {
            turtle.follow(Command::of(name), &[number, number, number]);
            let frame = turtle.state().frame;
            let all = [frame.position, frame.heading, frame.left, frame.up].concat();
            assert!(all.iter().all(|x| x.is_finite()), "{name}({number}): {frame:?}");
        }
    }
}

/// Draws the tree of Fig. 2.6a from the apex `name` of length `l` with `left` steps to go; its tips.
fn honda(turtle: &mut Turtle, name: &str, l: f64, left: u32, tips: &mut Vec<Vector>) {
    if left == 0 {
        return tips.push(turtle.state().frame.position);
    }
    let mut told = |modules: &[(&str, &[f64])]| _ = lines(turtle, modules);
    told(&[("F", &[l]), ("[", &[])]);
    let (lateral, straight) = match name {
        "A" => {
            told(&[("&", &[45.0])]);
            ("B", "A")
        }
        "B" => {
            told(&[("-", &[45.0]), ("$", &[])]);
            ("C", "C")
        }
        _ => {
            told(&[("+", &[45.0]), ("$", &[])]);
            ("B", "B")
        }
    };
    honda(turtle, lateral, l * 0.6, left - 1, tips);
    lines(turtle, &[("]", &[])]);
    if name == "A" {
        lines(turtle, &[("/", &[137.5])]);
    }
    honda(turtle, straight, l * 0.9, left - 1, tips);
}

/// Draws an apex of Fig. 2.8a with `left` steps to go; its tips.
fn ternary(turtle: &mut Turtle, left: u32, tips: &mut Vec<Vector>) {
    if left == 0 {
        return tips.push(turtle.state().frame.position);
    }
    let length = 50.0 * phytomer_sim::math::pow(1.109, f64::from(left - 1));
    lines(turtle, &[("F", &[length])]);
    for turn in [94.74, 132.63, 0.0] {
        lines(turtle, &[("[", &[]), ("&", &[18.95]), ("F", &[length])]);
        ternary(turtle, left - 1, tips);
        lines(turtle, &[("]", &[]), ("/", &[turn])]);
    }
}

fn mean(tips: &[Vector]) -> Vector {
    [0, 1, 2].map(|i| tips.iter().map(|tip| tip[i]).sum::<f64>() / tips.len() as f64)
}

#[test]
fn the_mean_tips_of_figures_2_6a_and_2_8a() {
    let mut tips = Vec::new();
    honda(&mut turtle_of(""), "A", 1.0, 10, &mut tips);
    assert_eq!(tips.len(), 1024);
    let (found, expected) = (mean(&tips), [-0.023129, 2.911796, -0.508310]);
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?}");
    let mut turtle = turtle_of("tropism direction: 0.00,-1.00,0.00\ninitial elasticity: 0.22");
    lines(&mut turtle, &[("F", &[200.0 * phytomer_sim::math::pow(1.109, 6.0)]), ("/", &[45.0])]);
    let mut tips = Vec::new();
    ternary(&mut turtle, 6, &mut tips);
    assert_eq!(tips.len(), 729);
    let (found, expected) = (mean(&tips), [-43.179219, 784.271207, 3.687640]);
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{found:?}");
}
