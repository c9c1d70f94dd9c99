//! The shapes of a drawing on its sheet: polygons in pixels, the farther first, shadows before all.

use super::ports::Way;
use super::views::View;
use super::{Branch, Colour, Drawing, Patch, Place, Shadow, Sheet, Star};
use phytomer_sim::math::sincos;
use std::f64::consts::TAU;

/// The width of the pen, pixels.
const PEN: f64 = 1.2;
/// The corners of a joint.
const JOINT: u32 = 12;
/// The light that is left on the darker half of a branch.
const DARK: f64 = 0.6;
/// The opacity of a shadow of its own.
const VEIL: f64 = 0.35;
/// The outer radius of a star, pixels, and the share of it at which its five corners meet: that of a pentagram.
const STAR: f64 = 18.0;
const NOTCH: f64 = 0.381_966;

/// A polygon on the sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Flat {
    /// Its corners, pixels to the right and down.
    pub corners: Vec<[f64; 2]>,
    /// Its colour.
    pub colour: Colour,
    /// Its opacity.
    pub opacity: f64,
}

impl Shadow {
    /// The shadow of a place on the ground: E + (p − E) E_z / (E_z − z). `None` at and above the light.
    pub fn of(&self, [x, y, z]: Place) -> Option<Place> {
        let [ex, ey, ez] = self.emitter;
        let share = ez / (ez - z);
        (z < ez).then_some([ex + (x - ex) * share, ey + (y - ey) * share, 0.0])
    }
}

/// The shapes of a drawing as a view shows them.
pub fn shapes(drawing: &Drawing, sheet: &Sheet, view: View, way: &Way) -> Vec<Flat> {
    let mut flat = shadows(drawing, view, way);
    let eye = Eye { view, way, background: sheet.background };
    let mut items: Vec<(f64, Vec<Flat>)> = Vec::with_capacity(drawing.branches.len() + drawing.patches.len());
    items.extend(drawing.branches.iter().filter_map(|branch| eye.branch(branch)));
    items.extend(drawing.patches.iter().filter_map(|patch| eye.patch(patch)));
    // A stable order, so that equally far shapes keep that of the drawing.
    items.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    flat.extend(items.into_iter().flat_map(|(_, shapes)| shapes));
    flat.extend(sheet.shown(drawing).iter().flat_map(|star| eye.star(star)));
    flat
}

/// The shadows on the ground; those of one light that are merged are of one opaque colour.
fn shadows(drawing: &Drawing, view: View, way: &Way) -> Vec<Flat> {
    let eye = Eye { view, way, background: [0; 3] };
    let mut flat = Vec::new();
    for (shadow, branches, patches) in &drawing.shadows {
        let fallen = |place: Place| shadow.of(place);
        for branch in &drawing.branches[branches[0]..branches[1]] {
            let [Some(base), Some(tip)] = branch.ends.map(fallen) else { continue };
            // A thickness grows as the way to the ground does.
            let wider = |place: Place| shadow.emitter[2] / (shadow.emitter[2] - place[2]);
            let girth = branch.girth.map(|[a, b]| [a * wider(branch.ends[0]), b * wider(branch.ends[1])]);
            let fill = super::Fill::FULL;
            let on_ground = Branch { ends: [base, tip], girth, colour: shadow.colour, fill };
            flat.extend(eye.branch(&on_ground).into_iter().flat_map(|(_, shapes)| shapes));
        }
        for patch in &drawing.patches[patches[0]..patches[1]] {
            let Some(corners) = patch.corners.iter().map(|place| fallen(*place)).collect() else { continue };
            let on_ground = Patch { corners, colour: shadow.colour };
            flat.extend(eye.patch(&on_ground).into_iter().flat_map(|(_, shapes)| shapes));
        }
        if !shadow.merged {
            flat.iter_mut().filter(|shape| shape.colour == shadow.colour).for_each(|shape| shape.opacity = VEIL);
        }
    }
    flat
}

struct Eye<'a> {
    view: View,
    way: &'a Way,
    background: Colour,
}

impl Eye<'_> {
    /// A branch, with its distance; `None` where an end is behind the eye.
    fn branch(&self, branch: &Branch) -> Option<(f64, Vec<Flat>)> {
        let [base, tip] = branch.ends.map(|place| self.view.seen(place));
        let (((base, near), wide), ((tip, far), narrow)) = (base?, tip?);
        let [base, tip] = [base, tip].map(|at| self.way.pixel(at));
        let radii = match branch.girth {
            Some([a, b]) => [0.5 * a * wide * self.way.scale, 0.5 * b * narrow * self.way.scale],
            None => [0.5 * PEN; 2],
        };
        // A twig is never thinner than the pen.
        let radii = radii.map(|radius| radius.max(0.5 * PEN));
        let mut shapes = Vec::new();
        let put = |shapes: &mut Vec<Flat>, corners, colour| shapes.push(Flat { corners, colour, opacity: 1.0 });
        let sides = sides(base, tip, radii);
        match branch.girth {
            None => put(&mut shapes, sides.to_vec(), branch.colour),
            Some(_) => {
                put(&mut shapes, sides.to_vec(), branch.colour);
                put(&mut shapes, joint(tip, radii[1]), branch.colour);
                let inner = mixed(self.background, branch.colour, branch.fill.dense);
                if inner != branch.colour && radii[0] > PEN {
                    let thinner = radii.map(|radius| (radius - PEN).max(0.0));
                    put(&mut shapes, self::sides(base, tip, thinner).to_vec(), inner);
                }
                if branch.fill.shaded && radii[0] > PEN {
                    let [_, _, right_tip, right_base] = sides;
                    let dark = mixed([0; 3], inner, DARK);
                    put(&mut shapes, vec![base, tip, right_tip, right_base], dark);
                }
            }
        }
        Some((0.5 * (near + far), shapes))
    }

    /// A star of the standard size; nothing behind the eye.
    fn star(&self, star: &Star) -> Vec<Flat> {
        let Some(((at, _), _)) = self.view.seen(star.place) else { return Vec::new() };
        let middle = self.way.pixel(at);
        let of = |radius: f64, colour: Colour| Flat { corners: pentagram(middle, radius), colour, opacity: 1.0 };
        let outline = of(STAR, star.colour);
        match star.filled {
            true => vec![outline],
            false => vec![outline, of(0.6 * STAR, self.background)],
        }
    }

    fn patch(&self, patch: &Patch) -> Option<(f64, Vec<Flat>)> {
        let seen: Option<Vec<_>> = patch.corners.iter().map(|place| self.view.seen(*place)).collect();
        let seen = seen?;
        let far = seen.iter().map(|((_, far), _)| far).sum::<f64>() / seen.len().max(1) as f64;
        let corners = seen.iter().map(|((at, _), _)| self.way.pixel(*at)).collect();
        Some((far, vec![Flat { corners, colour: patch.colour, opacity: 1.0 }]))
    }
}

/// The corners of a branch: left at the base and at the tip, right at the tip and at the base.
fn sides(base: [f64; 2], tip: [f64; 2], radii: [f64; 2]) -> [[f64; 2]; 4] {
    let way = [tip[0] - base[0], tip[1] - base[1]];
    let long = (way[0] * way[0] + way[1] * way[1]).sqrt();
    // A branch that is seen from its end is a point.
    let across = if long > 0.0 { [way[1] / long, -way[0] / long] } else { [1.0, 0.0] };
    let at = |place: [f64; 2], radius: f64| [place[0] + across[0] * radius, place[1] + across[1] * radius];
    [at(base, -radii[0]), at(tip, -radii[1]), at(tip, radii[1]), at(base, radii[0])]
}

/// The ten corners of a star with a point up.
fn pentagram([x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let corner = |k: u32| {
        let (sin, cos) = sincos(TAU * f64::from(k) / 10.0);
        let radius = if k.is_multiple_of(2) { radius } else { NOTCH * radius };
        [x + radius * sin, y - radius * cos]
    };
    (0..10).map(corner).collect()
}

fn joint(place: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let corner = |k: u32| {
        let (sin, cos) = sincos(TAU * f64::from(k) / f64::from(JOINT));
        [place[0] + radius * cos, place[1] + radius * sin]
    };
    (0..JOINT).map(corner).collect()
}

/// A colour between two, at a share of the way to the second.
fn mixed(from: Colour, to: Colour, share: f64) -> Colour {
    [0, 1, 2].map(|k| (f64::from(from[k]) + (f64::from(to[k]) - f64::from(from[k])) * share + 0.5) as u8)
}
