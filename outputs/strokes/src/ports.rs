//! Ports: parts of a sheet, each with a view, and the way from the plane of a view to the pixels of its port.
//!
//! As in GKS (ISO 7942) a window is a part of the plane, in metres, and a port a part of the sheet, in shares of its
//! width and height from the lower left. Lengths keep their proportions: a window stands as large as it can in the
//! middle of its port.

use super::views::View;
use super::{Drawing, Place, Sheet};

/// A part of the plane of a view, metres: left, right, top, bottom.
pub type Window = [f64; 4];

/// A part of a sheet with a view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Port {
    /// The view.
    pub view: View,
    /// Left, right, top and bottom, in shares of the sheet from its lower left corner.
    pub frame: [f64; 4],
    /// The part of the view's plane that it shows; if not given, all that is drawn, in one scale with the other ports
    /// that have none.
    pub window: Option<Window>,
}

/// The room around a drawing that is shown whole, as a share of its size.
const ROOM: f64 = 0.06;

/// The way from a plane to pixels, to the right and down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way {
    /// Pixels a metre.
    pub scale: f64,
    /// Where the origin of the plane comes to lie.
    origin: [f64; 2],
}

impl Port {
    /// Its left, top, right and bottom on a sheet, pixels.
    pub fn pixels(&self, [width, height]: [u32; 2]) -> [f64; 4] {
        let [left, right, top, bottom] = self.frame;
        let (width, height) = (f64::from(width), f64::from(height));
        [left * width, (1.0 - top) * height, right * width, (1.0 - bottom) * height]
    }
}

impl Way {
    /// The way from a window to a port of a sheet.
    pub fn of(sheet: &Sheet, port: &Port, [left, right, top, bottom]: &Window) -> Self {
        let [west, north, east, south] = port.pixels(sheet.size);
        let scale = ((east - west) / (right - left)).min((south - north) / (top - bottom));
        let origin =
            [0.5 * (west + east) - scale * 0.5 * (left + right), 0.5 * (north + south) + scale * 0.5 * (top + bottom)];
        Self { scale, origin }
    }

    /// The pixel of a place of the plane.
    pub fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.scale * x, self.origin[1] - self.scale * y]
    }
}

/// The window of each port: its own, or one that shows all that is drawn; these have one scale.
pub fn windows(sheet: &Sheet, drawing: &Drawing) -> Vec<Window> {
    let whole = |port: &Port| extent(sheet, drawing, port.view);
    let open = || sheet.ports.iter().filter(|port| port.window.is_none());
    let scales = open().map(|port| Way::of(sheet, port, &whole(port)).scale);
    let scale = scales.fold(f64::INFINITY, f64::min);
    let widened = |port: &Port| {
        let window = whole(port);
        let more = 0.5 * (Way::of(sheet, port, &window).scale / scale - 1.0);
        let [left, right, top, bottom] = window;
        let (wide, tall) = (more * (right - left), more * (top - bottom));
        [left - wide, right + wide, top + tall, bottom - tall]
    };
    sheet.ports.iter().map(|port| port.window.unwrap_or_else(|| widened(port))).collect()
}

/// The window around all that is drawn; a metre around the origin where that is nothing.
fn extent(sheet: &Sheet, drawing: &Drawing, view: View) -> Window {
    let ends = drawing.branches.iter().flat_map(|branch| branch.ends);
    let corners = drawing.patches.iter().flat_map(|patch| patch.corners.iter().copied());
    let stars = sheet.shown(drawing).iter().map(|star| star.place);
    let places = ends.chain(corners).chain(shadow_places(drawing)).chain(stars);
    let seen = places
        .filter_map(|place| view.seen(place))
        .map(|((at, _), _)| at)
        .filter(|at| at.iter().all(|x| x.is_finite()));
    let none = [f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY];
    let [left, right, top, bottom] =
        seen.fold(none, |[left, right, top, bottom], [x, y]| [left.min(x), right.max(x), top.max(y), bottom.min(y)]);
    if left > right {
        return [-0.5, 0.5, 1.0, 0.0];
    }
    let room = ROOM * (right - left).max(top - bottom).max(1e-6);
    [left - room, right + room, top + room, bottom - room]
}

/// Where the ends of branches and the corners of leaves throw their shadows.
fn shadow_places(drawing: &Drawing) -> impl Iterator<Item = Place> {
    drawing.shadows.iter().flat_map(|(shadow, branches, patches)| {
        let ends = drawing.branches[branches[0]..branches[1]].iter().flat_map(|branch| branch.ends);
        let corners = drawing.patches[patches[0]..patches[1]].iter().flat_map(|patch| patch.corners.iter().copied());
        ends.chain(corners).filter_map(|place| shadow.of(place))
    })
}
