//! Cameras: from a point in space to a point of the picture with its depth, and back.
//!
//! Picture coordinates are pixels to the right and down, from the upper left corner. Depth is linear across the picture
//! of a plane and grows towards the eye: 1/w in perspective, a share of the reach in parallel projection. It is always
//! positive, so that its bits sort as it does. Absent: clipping, since a camera stands outside the plants.

use super::extent::Extent;
use super::gaze::Gaze;
use glam::Vec3;
use phytomer_sim::math::sincosf;

/// The field of view of the perspective across the height of the picture, degrees: that of a short telephoto lens.
const FIELD: f32 = 26.0;

/// A rectangle of a picture, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Its left edge.
    pub left: f32,
    /// Its upper edge.
    pub top: f32,
    /// Its right edge.
    pub right: f32,
    /// Its lower edge.
    pub bottom: f32,
}

impl Frame {
    fn centre(&self) -> [f32; 2] {
        [(self.left + self.right) / 2.0, (self.top + self.bottom) / 2.0]
    }
}

/// The projection of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lens {
    /// Rays through one point.
    Perspective {
        /// The focal length, pixels.
        focal: f32,
    },
    /// Parallel rays.
    Parallel {
        /// The scale, pixels per metre.
        scale: f32,
        /// The distance from the eye's plane at which depth is 0, metres.
        reach: f32,
    },
}

/// A camera at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The direction in which it looks.
    pub gaze: Gaze,
    /// The position of its eye, metres.
    pub eye: Vec3,
    /// Its projection.
    pub lens: Lens,
    /// The pixel at which straight ahead is seen.
    pub centre: [f32; 2],
}

/// The tangents of the angles to the sides of a frame in perspective: left, right, up, down; zeros in parallel
/// projection.
pub fn tangents(frame: &Frame, height: f32, perspective: bool) -> [f32; 4] {
    if !perspective {
        return [0.0; 4];
    }
    let (focal, [x, y]) = (focal(height), frame.centre());
    [x - frame.left, frame.right - x, y - frame.top, frame.bottom - y].map(|side| side / focal)
}

fn focal(height: f32) -> f32 {
    let (sin, cos) = sincosf(0.5 * FIELD.to_radians());
    0.5 * height * cos / sin
}

impl Camera {
    /// The camera that sees all of `extent` in `frame`, as large as possible. `extent` must be measured with the
    /// [`tangents`] of this frame. A parallel projection has at most `most` pixels per metre.
    pub fn fitting(extent: &Extent, frame: &Frame, height: f32, most: f32) -> Self {
        let (gaze, [left, right, up, down]) = (extent.gaze, extent.tangents);
        let [west, east, north, south] = extent.most;
        let centre = frame.centre();
        if right > 0.0 {
            // The farthest positions ahead of the origin from which the sides of the frame hold the plants, and its top
            // and bottom do.
            let ahead = (-(west + east) / (left + right)).min(-(north + south) / (up + down));
            let across = 0.5 * ((east + right * ahead) - (west + left * ahead));
            let above = 0.5 * ((north + up * ahead) - (south + down * ahead));
            let eye = gaze.right * across + gaze.up * above + gaze.forward * ahead;
            return Self { gaze, eye, lens: Lens::Perspective { focal: focal(height) }, centre };
        }
        let (width, tall) = ((west + east).max(1e-6), (north + south).max(1e-6));
        let scale = ((frame.right - frame.left) / width).min((frame.bottom - frame.top) / tall).min(most);
        let (across, above) = (0.5 * (east - west), 0.5 * (north - south));
        Self::parallel(gaze, [across, above], extent.depths, scale, centre)
    }

    /// A parallel projection of the space between two depths along the gaze; `middle` is its centre, to the right and
    /// up.
    pub fn parallel(gaze: Gaze, middle: [f32; 2], depths: [f32; 2], scale: f32, centre: [f32; 2]) -> Self {
        let room = 0.05 * (depths[1] - depths[0]) + 0.1;
        let eye = gaze.right * middle[0] + gaze.up * middle[1] + gaze.forward * (depths[0] - room);
        Self { gaze, eye, lens: Lens::Parallel { scale, reach: depths[1] - depths[0] + 2.0 * room }, centre }
    }

    /// The place of a point in the picture, and its depth; `None` at and behind the eye.
    #[inline]
    pub fn project(&self, point: Vec3) -> Option<Vec3> {
        let seen = point - self.eye;
        let (x, y, w) = (seen.dot(self.gaze.right), seen.dot(self.gaze.up), seen.dot(self.gaze.forward));
        match self.lens {
            Lens::Perspective { focal } => (w > 1e-4).then(|| {
                let near = 1.0 / w;
                Vec3::new(self.centre[0] + focal * x * near, self.centre[1] - focal * y * near, near)
            }),
            Lens::Parallel { scale, reach } => {
                Some(Vec3::new(self.centre[0] + scale * x, self.centre[1] - scale * y, 1.0 - w / reach))
            }
        }
    }

    /// The point in space at a place of the picture with this depth.
    #[inline]
    pub fn unproject(&self, x: f32, y: f32, depth: f32) -> Vec3 {
        let (right, down) = (x - self.centre[0], y - self.centre[1]);
        let (w, per_pixel) = match self.lens {
            Lens::Perspective { focal } => {
                let w = 1.0 / depth;
                (w, w / focal)
            }
            Lens::Parallel { scale, reach } => ((1.0 - depth) * reach, 1.0 / scale),
        };
        self.eye + self.gaze.forward * w + (self.gaze.right * right - self.gaze.up * down) * per_pixel
    }

    /// The point where the ray through a place of the picture meets the ground, z = 0; `None` where it does not.
    #[inline]
    pub fn ground(&self, x: f32, y: f32) -> Option<Vec3> {
        let (right, down) = (x - self.centre[0], y - self.centre[1]);
        let aside = self.gaze.right * right - self.gaze.up * down;
        let (from, along, eye) = match self.lens {
            Lens::Perspective { focal } => (self.eye, self.gaze.forward + aside / focal, true),
            Lens::Parallel { scale, .. } => (self.eye + aside / scale, self.gaze.forward, false),
        };
        let far = -from.z / along.z;
        // In a parallel projection the ground cannot be behind an eye.
        (along.z < -1e-4 && (far > 0.0 || !eye)).then(|| from + along * far)
    }

    /// The direction from a point towards the eye, a unit vector.
    #[inline]
    pub fn back(&self, point: Vec3) -> Vec3 {
        match self.lens {
            Lens::Perspective { .. } => (self.eye - point).normalize_or_zero(),
            Lens::Parallel { .. } => -self.gaze.forward,
        }
    }

    /// The scale across the gaze at a point, pixels per metre.
    pub fn scale_at(&self, point: Vec3) -> f32 {
        match self.lens {
            Lens::Perspective { focal } => focal / (point - self.eye).dot(self.gaze.forward).max(1e-4),
            Lens::Parallel { scale, .. } => scale,
        }
    }

    /// Whether the ground is seen as a surface; a level gaze sees it as a line.
    pub fn sees_ground(&self) -> bool {
        matches!(self.lens, Lens::Perspective { .. }) || self.gaze.forward.z < -1e-3
    }
}
