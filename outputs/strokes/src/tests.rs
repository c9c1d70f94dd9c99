//! Drawings held against closed forms: places in views and ports, shadows, areas of pixels, and SVG as an XML reader
//! reads it.

use super::*;

const RED: Colour = [200, 0, 0];
const WHITE: Colour = [255; 3];

fn pole(height: f64, girth: Option<[f64; 2]>) -> Branch {
    Branch { ends: [[0.0; 3], [0.0, 0.0, height]], girth, colour: RED, fill: Fill::FULL }
}

fn sheet(ports: Vec<Port>, window: Option<Window>) -> Sheet {
    let ports = ports.into_iter().map(|port| Port { window, ..port }).collect();
    Sheet { size: [200, 100], background: WHITE, ports, stars: true }
}

fn whole(view: View) -> Vec<Port> {
    vec![Port { view, frame: [0.0, 1.0, 1.0, 0.0], window: None }]
}

#[test]
fn views_show_places_where_they_are() {
    let place = [1.0, 2.0, 3.0];
    let at = |view: View| view.seen(place).unwrap().0;
    assert_eq!(at(View::Top), ([1.0, 2.0], -3.0));
    assert_eq!(at(View::Front), ([1.0, 3.0], 2.0));
    assert_eq!(at(View::Side), ([2.0, 3.0], -1.0));
    // A parallel projection keeps the length of what lies across it: the sum of squares with the depth is the length.
    let ([x, y], far) = at(View::Oblique);
    assert!((x * x + y * y + far * far - 14.0).abs() < 1e-12);
    // In perspective what stands at the axis has its size, and what is twice as far is half as large.
    let eye = View::Perspective { eye: [0.0, -10.0, 0.0], target: [0.0; 3] };
    assert_eq!(eye.seen([1.0, 0.0, 2.0]).unwrap(), (([1.0, 2.0], 10.0), 1.0));
    assert_eq!(eye.seen([1.0, 10.0, 2.0]).unwrap(), (([0.5, 1.0], 20.0), 0.5));
    assert_eq!(eye.seen([0.0, -11.0, 0.0]), None, "behind the eye");
    let above = View::Perspective { eye: [0.0, 0.0, 10.0], target: [0.0, 0.0, 5.0] }.seen([1.0, 2.0, 5.0]).unwrap().0;
    assert!((above.0[0] - 1.0).abs() < 1e-12 && (above.0[1] - 2.0).abs() < 1e-12, "north is up: {above:?}");
}

#[test]
fn a_shadow_lies_where_the_ray_from_the_light_meets_the_ground() {
    let shadow = Shadow { emitter: [10.0, 0.0, 20.0], colour: [90; 3], merged: true };
    assert_eq!(shadow.of([0.0, 0.0, 0.0]), Some([0.0, 0.0, 0.0]));
    assert_eq!(shadow.of([0.0, 0.0, 10.0]), Some([-10.0, 0.0, 0.0]), "twice the way from the light");
    assert_eq!(shadow.of([3.0, 4.0, 20.0]), None);
    assert_eq!(shadow.of([3.0, 4.0, 25.0]), None, "a tip above the light has no shadow");
}

#[test]
fn a_branch_covers_its_length_times_its_mean_girth() {
    // Ten metres high, one metre wide, 10 pixels a metre: 1,000 pixels, and half of the joint of 12 corners above it.
    let drawing = Drawing { branches: vec![pole(8.0, Some([1.0, 1.0]))], ..Drawing::default() };
    let drawn = sheet(whole(View::Front), Some([-10.0, 10.0, 9.0, -1.0])).pixels(&drawing);
    let red: f64 = drawn.pixels.iter().map(|[_, g, ..]| f64::from(255 - g) / 255.0).sum();
    // Twelve triangles of two radii of 5 pixels, whose angle has the sine 1/2; the lower half lies on the branch.
    let joint = 0.5 * 12.0 * (0.5 * 25.0 * 0.5);
    assert!((red - 800.0 - joint).abs() < 2.0, "{red} pixels, {} expected", 800.0 + joint);
    assert_eq!(drawn.at(100, 50), [200, 0, 0, 255]);
    assert_eq!(drawn.at(90, 50), [255; 4]);
}

#[test]
fn without_a_window_all_is_seen_in_one_scale() {
    let low = Branch { ends: [[-3.0, -1.0, 0.0], [3.0, 1.0, 0.0]], ..pole(1.0, None) };
    let drawing = Drawing { branches: vec![pole(5.0, None), low], ..Drawing::default() };
    let frames = [[0.0, 0.5, 1.0, 0.5], [0.5, 1.0, 1.0, 0.5], [0.5, 1.0, 0.5, 0.0], [0.0, 0.5, 0.5, 0.0]];
    let views = [View::Top, View::Oblique, View::Side, View::Front];
    let four: Vec<Port> =
        views.iter().zip(frames).map(|(view, frame)| Port { view: *view, frame, window: None }).collect();
    let sheet = sheet(four, None);
    let scales: Vec<f64> = ports::windows(&sheet, &drawing)
        .iter()
        .zip(&sheet.ports)
        .map(|(window, port)| ports::Way::of(&sheet, port, window).scale)
        .collect();
    assert!(scales.iter().all(|scale| (scale - scales[0]).abs() < 1e-9), "{scales:?}");
    for (port, shapes) in sheet.flat(&drawing) {
        let [left, top, right, bottom] = port.pixels(sheet.size);
        let inside = |[x, y]: &[f64; 2]| (left..=right).contains(x) && (top..=bottom).contains(y);
        assert!(shapes.iter().flat_map(|shape| &shape.corners).all(inside), "{port:?}");
    }
    // A part of the drawing is seen where it is seen in the whole.
    let part = Drawing { branches: vec![drawing.branches[0]], ..Drawing::default() };
    let framed = sheet.framed(&drawing);
    assert_eq!(
        framed.flat(&part)[3].1[0],
        sheet.flat(&drawing)[3]
            .1
            .iter()
            .find(|shape| shape.corners == framed.flat(&part)[3].1[0].corners)
            .unwrap()
            .clone()
    );
    // Nothing at all is drawn as nothing.
    assert!(sheet.pixels(&Drawing::default()).pixels.iter().all(|pixel| *pixel == [255; 4]));
}

#[test]
fn the_nearer_lies_over_the_farther_and_shadows_lie_below() {
    let leaf = |y: f64, colour: Colour| Patch {
        corners: vec![[-1.0, y, 0.0], [1.0, y, 0.0], [1.0, y, 2.0], [-1.0, y, 2.0]],
        colour,
    };
    let (near, far) = ([0, 200, 0], [0, 0, 200]);
    let shadow = Shadow { emitter: [0.0, -5.0, 4.0], colour: [9; 3], merged: true };
    let patches = vec![leaf(1.0, near), leaf(2.0, far)];
    let drawing = Drawing { patches, shadows: vec![(shadow, [0, 0], [0, 2])], ..Drawing::default() };
    let window = Some([-2.0, 2.0, 2.0, 0.0]);
    assert_eq!(sheet(whole(View::Front), window).pixels(&drawing).at(100, 50), [0, 200, 0, 255]);
    // From above the leaf at y = 2 throws its shadow from there to E + 2 (p − E) = 9.
    let above = sheet(whole(View::Top), Some([-10.0, 10.0, 10.0, 0.0])).pixels(&drawing);
    assert_eq!((above.at(100, 50), above.at(100, 5)), ([9, 9, 9, 255], [255; 4]));
    let apart = Drawing { shadows: vec![(Shadow { merged: false, ..shadow }, [0, 0], [0, 2])], ..drawing };
    let above = sheet(whole(View::Top), Some([-10.0, 10.0, 10.0, 0.0])).pixels(&apart);
    assert!(above.at(100, 50)[0] < above.at(100, 85)[0], "two shadows are darker than one");
}

#[test]
fn an_xml_reader_finds_every_shape_of_the_svg() {
    let drawing = Drawing { branches: vec![pole(2.0, None), pole(3.0, Some([0.4, 0.2]))], ..Drawing::default() };
    let text = sheet(whole(View::Front), None).svg(&drawing);
    let read = roxmltree::Document::parse(&text).unwrap();
    let paths: Vec<_> = read.descendants().filter(|node| node.has_tag_name("path")).collect();
    assert_eq!(paths.len(), 3, "a line, a branch and its joint");
    assert!(paths.iter().all(|path| path.attribute("fill") == Some("#c80000")));
    assert_eq!(read.root_element().attribute("viewBox"), Some("0 0 200 100"));
}

#[test]
fn what_is_no_place_is_not_drawn_and_stops_nothing() {
    let ends = [[f64::NAN, 0.0, 0.0], [1e300, -1e300, f64::INFINITY]];
    let strange = Branch { ends, ..pole(1.0, Some([f64::NAN, 1e300])) };
    let drawing = Drawing { branches: vec![strange, pole(1.0, None)], ..Drawing::default() };
    let eyes = [[0.0; 3], [1.0, -5.0, 2.0]].map(|eye| View::Perspective { eye, target: [0.0; 3] });
    for view in [View::Top, View::Oblique, eyes[0], eyes[1]] {
        sheet(whole(view), None).pixels(&drawing);
        sheet(whole(view), Some([-1.0, 1.0, 1.0, -1.0])).svg(&drawing);
    }
}

/// A pentagram of the outer radius R has the area 5 R² NOTCH sin 36°; here R is 18 pixels.
#[test]
fn a_star_has_its_size_on_the_sheet_and_lies_in_its_window() {
    let star = Star { place: [40.0, 0.0, 5.0], colour: RED, filled: true };
    let drawing = Drawing { branches: vec![pole(10.0, None)], stars: vec![star], ..Drawing::default() };
    let reds = |sheet: &Sheet, drawing: &Drawing| {
        let pole = sheet.pixels(&Drawing { stars: Vec::new(), ..drawing.clone() });
        let both = sheet.pixels(drawing);
        let red = |canvas: &phytomer_pictures::Canvas| {
            canvas.pixels.iter().map(|[_, green, ..]| f64::from(255 - green) / 255.0).sum::<f64>()
        };
        red(&both) - red(&pole)
    };
    let area = 5.0 * 18.0 * 18.0 * 0.381_966 * 0.587_785;
    for window in [[-5.0, 45.0, 15.0, -5.0], [-50.0, 90.0, 60.0, -10.0]] {
        let sheet = sheet(whole(View::Front), Some(window));
        let found = reds(&sheet, &drawing);
        assert!((found - area).abs() < 4.0, "{found} pixels, {area} expected");
        let hollow = Drawing { stars: vec![Star { filled: false, ..star }], ..drawing.clone() };
        assert!((reds(&sheet, &hollow) - area * (1.0 - 0.36)).abs() < 4.0);
    }
    // Without a window the place of the star is seen; a sheet without stars shows the pole alone.
    let whole = sheet(whole(View::Front), None);
    let seen = reds(&whole.framed(&drawing), &drawing);
    assert!(seen > 0.6 * area && seen < area + 4.0, "{seen} pixels");
    let without = Sheet { stars: false, ..whole.clone() };
    let alone = Drawing { stars: Vec::new(), ..drawing.clone() };
    assert_eq!(without.svg(&drawing), without.svg(&alone));
    assert_eq!(whole.svg(&drawing).matches("<path d").count(), 2);
}
