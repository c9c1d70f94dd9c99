//! Files of our own in the formats of cpfg, against closed forms of the curves and surfaces that they state, and what
//! is told of files that are wrong.

use super::{Colours, Contour, Function, LineStyle, Surface, TextFault, View};

const VIEW: &str = "\
/* a view
   of two lines */
angle factor: 8   // eight turns
initial color: 3
color increment: 2 4
initial line width: 0.25
line width increment:0.05
line style: cylinder
tapered lines: off
viewpoint: 0,0,1
tropism direction: -0.02,-1.0,0
initial elasticity: 0.27
elasticity increment: -0.06
tropism: T: 0.0 2.0 0.0 A:90 E: 0.3
initial scale: 2
scale multiplier: 0.5
surface: l leaf.s 1.5 8 4
surface: p petal.s 0
function: width.func 100
function: length.func
contour: 2 blade.con
contour sides: 100
twist of cylinders: on
torque: T: 0 0 2
light: V: 0 1 0.5
";

#[test]
fn a_view_file_is_read_and_what_has_no_meaning_is_listed() {
    let view = View::read(VIEW).expect("it can be read");
    assert_eq!((view.angle_deg, view.colour, view.colour_increment), (45.0, [3, 3], [2, 4]));
    assert_eq!((view.line_width, view.line_width_increment, view.width_in_units), (0.25, 0.05, true));
    assert_eq!((view.line_style, view.tapered_lines), (LineStyle::Cylinder, false));
    assert_eq!((view.tropism, view.elasticity, view.elasticity_increment), ([-0.02, -1.0, 0.0], 0.27, -0.06));
    assert_eq!((view.scale, view.scale_multiplier), (2.0, 0.5));
    let tropism = view.tropisms[0];
    assert_eq!((tropism.direction, tropism.angle_deg, tropism.elasticity), ([0.0, 1.0, 0.0], 90.0, 0.3));
    let surfaces: Vec<_> = view.surfaces.iter().map(|s| (s.symbol, s.file.as_str(), s.size, s.steps)).collect();
    assert_eq!(surfaces, [('l', "leaf.s", 1.5, [8, 4]), ('p', "petal.s", 1.0, [0, 0])]);
    assert_eq!(view.functions, ["width.func", "length.func"]);
    assert_eq!(view.contours, [(2, "blade.con".to_owned())]);
    assert_eq!((view.contour_sides, view.cylinders_twist), (64, true));
    assert_eq!(
        view.tropisms.iter().map(|of| (of.direction, of.rolls)).collect::<Vec<_>>(),
        [([0.0, 1.0, 0.0], false), ([0.0, 0.0, 1.0], true)]
    );
    let skipped: Vec<_> = view.skipped.iter().map(|line| (line.line, line.text.as_str())).collect();
    assert_eq!(skipped, [(10, "viewpoint: 0,0,1"), (25, "light: V: 0 1 0.5")]);
    assert_eq!(View::read("").expect("an empty file"), View::default());
    let pixels = View::read("initial line width: 2 pixels\nfunction set: all.fset").expect("it can be read");
    assert_eq!((pixels.line_width, pixels.width_in_units, pixels.line_style), (2.0, false, LineStyle::Pixel));
    assert_eq!(pixels.function_set.as_deref(), Some("all.fset"));
}

/// Each fault by its line and column, its problem and what was expected.
fn told(faults: &[TextFault]) -> Vec<String> {
    faults.iter().map(ToString::to_string).collect()
}

#[test]
fn every_line_that_is_wrong_is_told_at_its_word() {
    let text = "angle factor: 0\ninitial color: red\n/* β */ line style: \tround\ntropism direction: 1,2\n\
                surface: leaf l.s 1\ntropism: T: 0 0 0\ntropism: B: 1\ntapered lines: maybe\ninitial line width: -1\n";
    let faults = View::read(text).expect_err("all lines are wrong");
    assert_eq!(
        told(&faults),
        [
            "line 1, column 15: `0` stands here; expected the number of turns in a full circle",
            "line 2, column 16: `red` stands here; expected a whole number from -255 to 255",
            "line 3, column 22: `round` stands here; expected `pixel`, `polygon` or `cylinder`",
            "line 4, column 23: the line ends here; expected three numbers, such as 0,-1,0",
            "line 5, column 10: `leaf` stands here; expected the symbol of the surface, one character",
            "line 6, column 18: the line ends here; expected `T:` with a vector that is not 0",
            "line 7, column 10: `B` stands here; expected `T:`, `I:`, `A:`, `E:` or `S:` with numbers",
            "line 8, column 16: `maybe` stands here; expected `on` or `off`",
            "line 9, column 21: `-1` stands here; expected a width of at least 0",
        ]
    );
    let long = " ".repeat(super::MOST_BYTES + 1);
    assert_eq!(View::read(&long).expect_err("too long").len(), 1);
    let many = "contour: 1 a.con\n".repeat(257);
    assert_eq!(View::read(&many).expect_err("too many")[0].line, 257);
}

fn function(points: &str, count: usize) -> Function {
    let text = format!("fver 1 1\nname: f\nsamples: 7\nflip: off\npoints: {count}\n{points}");
    Function::read(&text).unwrap_or_else(|fault| panic!("{fault}"))
}

/// Four points are a Bézier curve; where x rises evenly, x is the parameter.
#[test]
fn a_function_of_four_points_is_a_polynomial_of_bernstein() {
    let cubic = function("0 0.2\n0.333333333333333333 1\n0.666666666666666667 -1\n1 0.5\n", 4);
    for step in 0..=50 {
        let x = f64::from(step) / 50.0;
        let y = 1.0 - x;
        let expected = 0.2 * y * y * y + 3.0 * x * y * y - 3.0 * x * x * y + 0.5 * x * x * x;
        assert!((cubic.at(x) - expected).abs() < 1e-14, "{x}: {} is not {expected}", cubic.at(x));
    }
    assert_eq!([-1.0, 0.0, 1.0, 7.0, f64::NAN].map(|x| cubic.at(x)), [0.2, 0.2, 0.5, 0.5, 0.2]);
}

/// Affine: where every point lies on a line the curve does, wherever its knots are and however the points are spread.
/// At the middle knot of five points the weights are ¼, ½ and ¼.
#[test]
fn a_function_is_solved_for_x() {
    let line = function("0 1\n0.05 1.1\n0.2 1.4\n0.7 2.4\n0.71 2.42\n1 3\n", 6);
    for step in 0..=100 {
        let x = f64::from(step) / 100.0;
        assert!((line.at(x) - (1.0 + 2.0 * x)).abs() < 1e-12, "{x}: {}", line.at(x));
    }
    let bump = function("0 0 1\n0.25 1\n0.5 3\n0.75 2\n1 0\n", 5);
    assert!((bump.at(0.5) - (1.0 + 2.0 * 3.0 + 2.0) / 4.0).abs() < 1e-12, "{}", bump.at(0.5));
    // A point that counts three times is on the curve.
    let corner = function("0 0 2\n0.5 2 3\n1 0\n1 0\n", 4);
    assert!((corner.at(0.5) - 2.0).abs() < 1e-12, "{}", corner.at(0.5));
}

#[test]
fn sets_of_functions_and_the_format_before_versions_are_read() {
    let old = Function::read("range: 0 1\npoints: 4\n0 1\n0.3 1\n0.6 1\n1 1\n").expect("it can be read");
    assert_eq!((old.name.as_str(), old.at(0.4)), ("", 1.0));
    let one = "fver 1 1\nname: one\nsamples: 5\nflip: off\npoints: 4\n0 1\n0.3 1\n0.6 1\n1 1\n";
    let two = one.replace("one", "two").replace("flip: off", "background: 0\nflip: on").replace(" 1\n", " 2\n");
    let two = two.replace("fver 1 2", "fver 1 1");
    let set = Function::read_set(&format!("funcgalleryver 1 1\nitems: 2\n{one}{two}")).expect("it can be read");
    let values: Vec<_> = set.iter().map(|function| (function.name.as_str(), function.at(0.5))).collect();
    assert_eq!(values, [("one", 1.0), ("two", 2.0)]);
}

#[test]
fn what_is_wrong_in_a_function_is_told_at_its_word() {
    let of = |text: &str| Function::read(text).expect_err("it is wrong").to_string();
    let head = "fver 1 1\nname: f\nsamples: 5\nflip: off\n";
    assert_eq!(of(""), "line 1, column 1: the file is empty; expected `fver` and its version, or `range:`");
    assert_eq!(of("curve 1\n"), "line 1, column 1: `curve` stands here; expected `fver` and its version, or `range:`");
    assert!(of(&format!("{head}points: 3\n")).starts_with("line 5, column 9: `3` stands here"));
    let wrong = format!("{head}points: 4\n0 0\n0.5 x\n");
    assert_eq!(of(&wrong), "line 7, column 5: `x` stands here; expected two numbers");
    let short = format!("{head}points: 4\n0 0\n0.5 1\n");
    assert_eq!(of(&short), "line 7, column 6: the line ends here; expected a point: two numbers");
    let gone = format!("{head}points: 4\n0 0 0\n0 0 0\n0 0 0\n1 1\n");
    assert_eq!(of(&gone), "line 9, column 4: the line ends here; expected four points, repeated ones included");
    let many = format!("{head}points: 4\n0 0 5000\n0 0\n0 0\n1 1\n");
    assert_eq!(of(&many), "line 6, column 5: `5000` stands here; expected at most 4096 points");
    assert_eq!(
        Function::read_set("fver 1 1\n").expect_err("it is no set").to_string(),
        "line 1, column 1: `fver` stands here; expected `funcgalleryver` and its version"
    );
}

/// A patch over the rectangle of these sides in the plane of x and y, with a hump of height `z` in the middle.
fn patch_text(wide: f64, long: f64, z: f64) -> String {
    let mut text = "Patch_1\nTOP COLOR: 0 DIFFUSE: 0.00 BOTTOM COLOR: 0 DIFFUSE: 0.00\n\
                    AL: ~ A: ~ AR: ~\nL: ~ R: ~\nBL: ~ B: ~ BR: ~\n"
        .to_owned();
    for row in 0..4 {
        for column in 0..4 {
            let inner = [row, column].iter().all(|place| [1, 2].contains(place));
            let (x, y) = (wide * (f64::from(column) / 3.0 - 0.5), long * f64::from(row) / 3.0);
            text += &format!("{x} {y} {} ", if inner { z } else { 0.0 });
        }
        text.push('\n');
    }
    text
}

fn surface_text(patches: &str) -> String {
    format!(
        "-1 1 0 4 0 1\nPRECISION S: 5 T: 5\nCONTACT POINT  X: 0.00 Y: 0.50 Z: 0.00\nEND POINT  X: 0 Y: 1 Z: 0\n\
         HEADING  X: 0.00 Y: 2.00 Z: 0.00\nUP X:0.00 Y: 0.30 Z: 1.00\nSIZE: 4.0\n{patches}"
    )
}

#[test]
fn a_surface_is_told_in_the_coordinates_of_the_turtle() {
    let surface = Surface::read(&surface_text(&patch_text(2.0, 4.0, 0.0))).expect("it can be read");
    let patch = &surface.patches[0];
    // A quarter of the size: heading along y, from the contact point; left along x; the upper side along −U.
    assert_eq!(Surface::point(patch, 0.0, 0.0), [-0.125, -0.25, 0.0]);
    assert_eq!(Surface::point(patch, 1.0, 1.0), [0.875, 0.25, 0.0]);
    let middle = Surface::point(patch, 0.5, 0.5);
    assert!((middle[0] - 0.375).abs() < 1e-15 && middle[1].abs() < 1e-15, "{middle:?}");
    let form = surface.form(3.0, [0, 0]);
    assert_eq!((form.points().len(), form.faces().len(), surface.steps), (36, 50, [5; 2]));
    assert!((form.area([1.0; 3]) - 9.0 * 0.5).abs() < 1e-12, "{}", form.area([1.0; 3]));
    assert_eq!(form.points()[0].at, [-0.375, -0.75, 0.0]);
    assert!(form.points().iter().all(|point| point.normal[..2] == [0.0; 2]), "a plane");
    let humped = surface_text(&format!("{}{}", patch_text(2.0, 4.0, 1.0), patch_text(1.0, 1.0, 0.0)));
    let humped = Surface::read(&humped).expect("it can be read");
    // Of the four inner points each counts 3·½·¼·3·½·¼ in the middle: (¾)² together.
    assert!((Surface::point(&humped.patches[0], 0.5, 0.5)[2] + 0.25 * 0.5625).abs() < 1e-15);
    let form = humped.form(1.0, [8, 4]);
    assert_eq!((form.points().len(), form.faces().len()), (2 * 45, 2 * 64));
    assert!(form.area([1.0; 3]) > 0.5 + 1.0 / 16.0);
}

/// A patch whose rows are equal arcs is a part of a cylinder: a quarter of a circle by one cubic, with the handle
/// k = 4/3 tan 22.5°, is round to 2.7e-4 of its radius (Goldapp 1991). Radius 1, height 2: its area is π.
#[test]
fn a_quarter_of_a_cylinder_has_its_area_and_its_normals() {
    let k = 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0);
    let arc = [[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]];
    let rows = (0..4).map(|row| arc.map(|[x, z]| format!("{x} {} {z}", f64::from(row) * 2.0 / 3.0)).join(" "));
    let rows: Vec<String> = rows.collect();
    let text = surface_text(&format!("p\n{}\n", rows.join("\n"))).replace("SIZE: 4.0", "SIZE: 1");
    let surface = Surface::read(&text).expect("it can be read");
    let area = surface.form(1.0, [10, 1]).area([1.0; 3]);
    // Ten chords of a quarter of a circle are 20 sin 4.5° long together.
    let chords = 2.0 * 20.0 * phytomer_sim::math::sin(4.5_f64.to_radians());
    assert!((area / chords - 1.0).abs() < 1e-3, "{area} {chords}");
    assert!((area / std::f64::consts::PI - 1.0).abs() < 2e-3);
    let form = surface.form(1.0, [10, 3]);
    for point in form.points() {
        // Out from the axis, or in towards it: across the radius there is nothing. The axis is that of y in the file.
        let [_, left, up] = point.at.map(f64::from);
        let normal = point.normal.map(f64::from);
        let along = normal[1] * left + normal[2] * up;
        assert!((along.abs() - 1.0).abs() < 2e-3 && normal[0].abs() < 1e-6, "{point:?}");
    }
}

/// A patch that is drawn together at one end has a normal there too.
#[test]
fn a_pole_of_a_patch_has_the_normal_of_its_triangles() {
    let rows: Vec<String> =
        (0..4).map(|row| [-1.0, -0.3, 0.3, 1.0].map(|x| format!("{} {row} 0", x * f64::from(row))).join(" ")).collect();
    let text = surface_text(&format!("p\n{}\n", rows.join("\n")));
    let form = Surface::read(&text).expect("it can be read").form(1.0, [4, 4]);
    assert!(form.points().iter().all(|point| point.normal[2].abs() == 1.0), "{:?}", form.points());
    // Of 256 patches each is drawn more coarsely: 2 · 4 · 4 triangles, not 2 · 10 · 10.
    let many = surface_text(&format!("p\n{}\n", rows.join("\n")).repeat(256));
    let many = Surface::read(&many).expect("it can be read").form(1.0, [10, 10]);
    assert_eq!(many.faces().len(), 256 * 2 * 16);
}

#[test]
fn what_is_wrong_in_a_surface_is_told_at_its_word() {
    let of = |text: &str| Surface::read(text).expect_err("it is wrong").to_string();
    let whole = surface_text(&patch_text(2.0, 4.0, 0.0));
    assert_eq!(of(""), "line 1, column 1: the file is empty; expected the box of the points: six numbers");
    let told = of(&whole.replace("HEADING  X: 0.00 Y: 2.00", "HEADING  X: 0.00 Y: two"));
    assert_eq!(told, "line 5, column 21: `two` stands here; expected a number");
    let told = of(&whole.replace("Y: 0.30 Z: 1.00", "Y: 1 Z: 0"));
    let expected = "a vector that is not 0, and an upper side that is not along the heading";
    assert_eq!(told, format!("line 6, column 1: `UP` stands here; expected {expected}"));
    assert!(of(&whole.replace("END POINT", "END")).starts_with("line 4, column 1: `END` stands here"));
    assert!(of(&whole.replace("SIZE: 4.0", "SIZE: 0")).starts_with("line 7, column 7: `0` stands here"));
    let cut: Vec<&str> = whole.lines().take(15).collect();
    assert!(of(&cut.join("\n")).ends_with("the line ends here; expected 16 points of three numbers each"));
    assert!(of(&surface_text("")).ends_with("expected a patch"));
    assert!(of(&format!("{whole}1 2 3\n")).contains("expected 16 points"), "{}", of(&format!("{whole}1 2 3\n")));
}

/// The points of a square count three times each: the curve passes through them, straight from each to the next. With
/// four sides the section is the square, turned until it begins on the x axis, along −U. An open contour begins at its
/// first point that counts three times. Blends of four points: a lone point counts 4/6 where it is nearest.
#[test]
fn contours_are_splines_in_sides_of_equal_length() {
    let corners = ["1 1 0 3", "-1 1 0 3", "-1 -1 0 3", "1 -1 0 3"].join("\n");
    let text = |kind: &str| format!("cver 1 3\nname: a b\npoints: 4 12\ntype: {kind}\nsamples: 8\n{corners}\n");
    let near = |one: &[[f32; 2]], other: &[[f32; 2]]| {
        let close = |(a, b): (&[f32; 2], &[f32; 2])| (a[0] - b[0]).abs() < 1e-5 && (a[1] - b[1]).abs() < 1e-5;
        one.len() == other.len() && one.iter().zip(other).all(close)
    };
    let closed = Contour::read(&text("cr")).expect("it can be read").section(4);
    let far = 2.0_f32.sqrt();
    // The first of the pieces ends at the first corner; sides of equal length go on from where it begins.
    assert!(closed.is_closed() && closed.corners().len() == 4);
    for corner in closed.corners() {
        assert!((corner[0] * corner[0] + corner[1] * corner[1] - 2.0).abs() < 1e-4, "{closed:?}");
    }
    assert!(
        closed.corners().iter().any(|corner| near(&[*corner], &[[-far, 0.0]])),
        "it begins on the x axis: {closed:?}"
    );
    let open = Contour::read(&text("open")).expect("it can be read").section(3);
    assert!(near(open.corners(), &[[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]]), "{open:?}");
    let old = Contour::read("4 3 closed\n1 0 5\n0 1 5\n-1 0 5\n0 -1 5\n").expect("it can be read").section(16);
    let farthest = old.corners().iter().map(|[x, y]| x.abs().max(y.abs())).fold(0.0, f32::max);
    assert!((farthest - 4.0 / 6.0).abs() < 1e-6, "{farthest}");
    let lengths: Vec<f32> = (0..16)
        .map(|k| {
            let ([a, b], [x, y]) = (old.corners()[k], old.corners()[(k + 1) % 16]);
            ((x - a) * (x - a) + (y - b) * (y - b)).sqrt()
        })
        .collect();
    assert!(lengths.iter().all(|length| (length / lengths[0] - 1.0).abs() < 1e-2), "{lengths:?}");
}

#[test]
fn what_is_wrong_in_a_contour_is_told_at_its_word() {
    let of = |text: &str| Contour::read(text).expect_err("it is wrong").to_string();
    assert_eq!(of(""), "line 1, column 1: the file is empty; expected a contour");
    assert_eq!(of("3 2 closed"), "line 1, column 1: `3` stands here; expected the number of points, from 4 to 4096");
    assert_eq!(of("4 2 round"), "line 1, column 5: `round` stands here; expected `open` or `closed`");
    let expected = "expected a coordinate of a point, from -1000000 to 1000000";
    assert_eq!(of("4 2 open\n0 0\n1 x\n"), format!("line 3, column 3: `x` stands here; {expected}"));
    assert_eq!(of("4 2 open\n0 0\n1e9 1\n"), format!("line 3, column 1: `1e9` stands here; {expected}"));
    assert!(of("4 2 open\n0 0\n1 1\n").ends_with("expected as many points as the file says, at least four"));
    assert!(of("cver 1 1\nname: a\n0 0 0 1\n").ends_with("expected `points:` and `type:` before the points"));
    assert!(of("cver 1 1\npoints: 2 2\ntype: cr\n0 0 0 1\n1 1 0 1\n").contains("at least four"));
    assert!(of("cver 1 1\npoints: 1 9\ntype: cr\n0 0 0 9999\n").contains("at most 4096 points"));
}

#[test]
fn maps_of_colours_and_materials_are_read_from_their_bytes() {
    let map = Colours::of_map(&[1, 2, 3, 4, 5, 6]).expect("two colours");
    assert_eq!([0, 1, 2, 257, -255].map(|n| map.get(n)), [1, 4, 0, 4, 4].map(|r| (r > 0).then_some([r, r + 1, r + 2])));
    let material = |number: u8, ambient: u8, diffuse: u8| {
        let mut bytes = [0; 15];
        (bytes[0], bytes[2], bytes[5]) = (number, ambient, diffuse);
        bytes
    };
    let bytes = [material(7, 10, 20), material(200, 30, 0)].concat();
    let materials = Colours::of_materials(&bytes).expect("two materials");
    assert_eq!([7, 200, 8].map(|n| materials.get(n)), [Some([20, 0, 0]), Some([30, 0, 0]), None]);
    let fault = Colours::of_map(&[1, 2, 3, 4]).expect_err("one byte too many");
    let told = "line 1, column 4: the file has 4 bytes; expected a multiple of 3, at most 768";
    assert_eq!(fault.to_string(), told);
    assert!(Colours::of_map(&[]).is_err() && Colours::of_materials(&[0; 257 * 15]).is_err());
}

/// Whatever bytes a file has, it is read or refused: five thousand mutations of good files.
#[test]
fn no_bytes_make_a_reader_panic() {
    let surface = surface_text(&patch_text(2.0, 4.0, 0.5));
    let function = "fver 1 1\nname: f\nsamples: 7\nflip: off\npoints: 4\n0 0\n0.3 1 2\n0.6 1\n1 1\n";
    let set = format!("funcgalleryver 1 1\nitems: 1\n{function}");
    let mut state = 1_u64;
    let mut next = |below: usize| {
        state = phytomer_sim::key::scramble(state);
        (state >> 8) as usize % below.max(1)
    };
    for _ in 0..5_000 {
        for good in [VIEW, surface.as_str(), function, set.as_str()] {
            let mut characters: Vec<char> = good.chars().collect();
            for _ in 0..1 + next(4) {
                if characters.is_empty() {
                    break;
                }
                let at = next(characters.len());
                let other = ['\n', ':', '-', '9', 'e', '*', '/', ' ', 'é', '\0', '.', ','][next(12)];
                match next(4) {
                    0 => _ = characters.remove(at),
                    1 => characters.insert(at, other),
                    2 => characters[at] = other,
                    _ => characters.truncate(at + 1),
                }
            }
            let text: String = characters.into_iter().collect();
            let _ = (View::read(&text), Surface::read(&text).map(|surface| surface.form(1.0, [3, 2])));
            let functions = Function::read_set(&text).unwrap_or_default();
            let all = functions.into_iter().chain(Function::read(&text).ok());
            all.for_each(|function| assert!(!function.at(0.3).is_nan(), "{text}"));
            let _ = (Colours::of_map(text.as_bytes()), Colours::of_materials(text.as_bytes()));
        }
    }
}
