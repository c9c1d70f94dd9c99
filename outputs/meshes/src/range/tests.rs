//! The curves against Table 2 of Weber & Penn 1995, the ends of elements against the loop of §5, and both against each
//! other at many ranges.

use super::*;

const ALL: [Elements; 8] = [
    Elements::TrunkPolygons,
    Elements::TrunkLines,
    Elements::BranchPolygons,
    Elements::BranchLines,
    Elements::TwigPolygons,
    Elements::TwigLines,
    Elements::LeafPolygons,
    Elements::LeafPoints,
];

/// The ranges of Table 2, m.
const RANGES: [f64; 7] = [5.0, 30.0, 60.0, 120.0, 240.0, 600.0, 1200.0];

/// Table 2: the elements, how many of them there are, the triangles of each, and the numbers at the ranges.
const TABLE_2: [(Elements, u32, u32, [u32; 7]); 8] = [
    (Elements::TrunkPolygons, 36, 40, [1440, 1440, 1440, 1440, 1440, 760, 0]),
    (Elements::TrunkLines, 36, 1, [0, 0, 0, 36, 36, 36, 36]),
    (Elements::BranchPolygons, 240, 4, [960, 960, 960, 0, 0, 0, 0]),
    (Elements::BranchLines, 240, 1, [240, 240, 240, 223, 153, 35, 0]),
    (Elements::TwigPolygons, 5912, 3, [17_736, 14_580, 0, 0, 0, 0, 0]),
    (Elements::TwigLines, 5912, 1, [5912, 5912, 5363, 2648, 0, 0, 0]),
    (Elements::LeafPolygons, 13_312, 4, [53_248, 53_248, 49_800, 28_200, 0, 0, 0]),
    (Elements::LeafPoints, 13_312, 1, [13_312, 13_312, 13_312, 13_312, 11_944, 1664, 1664]),
];

/// The places that are drawn at a range, by the spans of the elements.
fn drawn(scales: &Scales, elements: Elements, total: u32, r: f64) -> Vec<u32> {
    (0..total).filter(|place| Span::of(scales, elements, *place, total).holds(r)).collect()
}

/// The same by the loop that §5 prints, with `change` truncated and at least one point a mass.
fn looped(scales: &Scales, elements: Elements, total: u32, r: f64) -> Vec<u32> {
    let mass = elements.mass();
    let least = if elements == Elements::LeafPoints { 1.0 } else { 0.0 };
    let number = (scales.share(elements, r) * f64::from(mass)).max(least);
    let whole = number.floor();
    let change = (f64::from(total) / f64::from(mass) * (number - whole)).floor() as u32;
    let ends = (0..=total / mass).map(|nth| (nth * mass, whole as u32 + u32::from(nth < change)));
    ends.flat_map(|(start, count)| start..start + count).filter(|place| *place < total).collect()
}

#[test]
fn the_numbers_are_those_of_table_2() {
    for (elements, total, each, numbers) in TABLE_2 {
        for (r, printed) in RANGES.into_iter().zip(numbers) {
            let ours = each * drawn(&Scales::SUMMER, elements, total, r).len() as u32;
            let exact = elements == Elements::BranchLines || printed == 0 || printed == each * total;
            let off = (f64::from(ours) / f64::from(printed.max(1)) - 1.0).abs();
            let bound = if elements == Elements::TrunkPolygons { 0.055 } else { 0.03 };
            assert!(if exact { ours == printed } else { off <= bound }, "{elements:?} at {r} m: {ours}, {printed}");
        }
    }
}

/// Lists of any length, quality and season, ranges in small steps: the set by spans is the set of the printed loop,
/// and that of a range holds that of every greater one.
#[test]
fn spans_tell_what_the_loop_draws_and_what_is_drawn_far_is_drawn_near() {
    for (quality, in_leaf, spring) in [(1.0, true, false), (0.7, false, true), (1.6, false, false), (0.25, true, true)]
    {
        let scales = Scales { quality, in_leaf, spring };
        for elements in ALL {
            for total in [1, 3, 15, 16, 17, 36, 100, 241] {
                let mut nearer: Vec<u32> = (0..total).collect();
                // No step meets a share at which an element ends: there the last digit would decide.
                for r in (0..700).map(|step| 2.937_1 * f64::from(step)) {
                    let now = drawn(&scales, elements, total, r);
                    assert_eq!(now, looped(&scales, elements, total, r), "{elements:?} of {total} at {r}, {scales:?}");
                    let begins = elements == Elements::TrunkLines && r < TRUNK_LINES_FROM;
                    assert!(begins || now.iter().all(|place| nearer.contains(place)), "{elements:?} {total} {r}");
                    if !begins {
                        nearer = now;
                    }
                }
            }
        }
    }
}

/// The end of a share is where the share has fallen to it: f(until(f)) = f inside of the limits.
#[test]
fn until_is_the_inverse_of_the_share() {
    for (quality, in_leaf, spring) in [(1.0, true, false), (1.0, false, true), (3.0, false, false)] {
        let scales = Scales { quality, in_leaf, spring };
        for elements in ALL.into_iter().filter(|elements| *elements != Elements::TrunkLines) {
            for least in (1..=50).map(|step| f64::from(step) / 50.0) {
                let until = scales.until(elements, least);
                let (before, after) = (scales.share(elements, until * (1.0 - 1e-9)), until * (1.0 + 1e-9) + 1e-9);
                assert!(before >= least - 1e-9, "{elements:?} {least}: {before} at {until}");
                assert!(scales.share(elements, after) < least, "{elements:?} {least}: drawn beyond {until}");
            }
        }
    }
}

/// A tree seen through a lens of 6 degrees at 1,200 m is that of 60 degrees at 120 m; half the lines, twice the range.
#[test]
fn a_zoom_brings_trees_nearer() {
    let zoom = Zoom { height: 500.0, field_of_view_deg: 6.0 };
    assert!((zoom.calibrated(1200.0) - 240.0).abs() < 1e-9);
    assert!((zoom.metres(zoom.calibrated(77.0)) - 77.0).abs() < 1e-9);
    assert_eq!(Zoom::default().calibrated(31.0), 31.0);
}
