//! Views: from a place in space to a plane, with the distance from the viewer.
//!
//! The plane has x to the right and y up, in metres. In perspective it stands where the eye looks, so that what stands
//! there has its size.

use super::Place;
use phytomer_sim::math::sincos;

/// From where a drawing is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum View {
    /// From above, north (y) up.
    Top,
    /// From the front, along the y axis: x to the right, z up.
    Front,
    /// From the right, against the x axis: y to the right, z up.
    Side,
    /// From the front, the right and above, in parallel projection: 30° to the right, 30° above.
    Oblique,
    /// From an eye towards a place.
    Perspective {
        /// Where the eye is.
        eye: Place,
        /// Where it looks; what stands there, across the gaze, has its size.
        target: Place,
    },
}

/// The oblique view is turned by so many degrees to the right, and looks down by as many.
const OBLIQUE: f64 = 30.0;
/// What lies nearer to an eye is not drawn, metres.
const NEAREST: f64 = 1e-3;

/// A place of the plane, and how far from the viewer it lies.
pub type Seen = ([f64; 2], f64);

impl View {
    /// Where a place is seen, and the scale there; `None` behind the eye.
    pub fn seen(self, place: Place) -> Option<(Seen, f64)> {
        let [x, y, z] = place;
        match self {
            Self::Top => Some((([x, y], -z), 1.0)),
            Self::Front => Some((([x, z], y), 1.0)),
            Self::Side => Some((([y, z], -x), 1.0)),
            Self::Oblique => {
                let (sin, cos) = sincos(OBLIQUE.to_radians());
                // Turned so that the viewer stands to the right of the front.
                let (right, ahead) = (x * cos + y * sin, y * cos - x * sin);
                Some((([right, z * cos + ahead * sin], ahead * cos - z * sin), 1.0))
            }
            Self::Perspective { eye, target } => perspective([eye, target], place),
        }
    }
}

fn perspective([eye, target]: [Place; 2], place: Place) -> Option<(Seen, f64)> {
    let sub = |a: Place, b: Place| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: Place, b: Place| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |a: Place| {
        let length = dot(a, a).sqrt();
        (length > 0.0).then(|| a.map(|x| x / length))
    };
    let forward = unit(sub(target, eye))?;
    // An eye straight above sees north up.
    let right = unit([forward[1], -forward[0], 0.0]).unwrap_or([1.0, 0.0, 0.0]);
    let up = [
        right[1] * forward[2] - right[2] * forward[1],
        right[2] * forward[0] - right[0] * forward[2],
        right[0] * forward[1] - right[1] * forward[0],
    ];
    let way = sub(place, eye);
    let (ahead, plane) = (dot(way, forward), dot(sub(target, eye), forward));
    let scale = plane / ahead;
    (ahead > NEAREST).then_some((([dot(way, right) * scale, dot(way, up) * scale], ahead), scale))
}
