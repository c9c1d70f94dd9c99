//! The pixels of a page of samples: what each sample shows, its light, and the mean of a pixel.
//!
//! Light is computed once for the samples of a pixel that show one surface, such as one leaf: those of one colour and
//! material whose normals differ little. Only whether the sun reaches it is asked at each sample, by a tap of its own.
//! A pixel without plants is its background. Absent: the samples themselves (`film`), light (`shade`).

use super::camera::Camera;
use super::film::{Film, Seen};
use super::ground::{Behind, Ground};
use super::placed::PlacedStand;
use super::raster::{TOGETHER, Window};
use super::shade::{Light, shade};
use super::tone;
use glam::Vec3;

/// The number of samples of a pixel along each side; those of a pixel lie together in memory.
pub const FINE: u32 = TOGETHER;
/// The samples of a pixel.
const SAMPLES: usize = (FINE * FINE) as usize;

/// The least cosine between the normals of samples that are lit as one, 18 degrees. Light goes with the cosine, so that
/// the mean normal of a round twig gives its mean light to within a fiftieth.
const ONE_SURFACE: f32 = 0.95;

/// The content of a picture.
#[derive(Debug)]
pub struct Set<'a> {
    /// The stands, in their places in the picture.
    pub stands: &'a [PlacedStand<'a>],
    /// The light over each stand.
    pub lights: &'a [Light],
    /// The camera.
    pub camera: Camera,
    /// Whether ground is drawn.
    pub ground: bool,
    /// Whether the background is transparent.
    pub transparent: bool,
    /// The middle and the size of the ground around each stand.
    pub around: &'a [(Vec3, f32)],
}

/// Turns samples into pixels.
pub struct Developer<'a> {
    /// The content of the picture.
    pub set: &'a Set<'a>,
    /// Its background.
    pub ground: &'a Ground<'a>,
    /// Its samples.
    pub film: &'a Film,
    /// The place of the samples in the picture.
    pub window: &'a Window,
}

/// A sample that shows a plant.
#[derive(Clone, Copy, Default)]
struct Spot {
    seen: Seen,
    /// The point that it shows, in the coordinates of its stand.
    point: Vec3,
    /// Its tap of the sun's disc.
    tap: usize,
}

/// Room for the samples of a pixel that show plants, which pixels use one after another.
#[derive(Default)]
pub struct Spots([Spot; SAMPLES]);

impl Developer<'_> {
    /// The colour of a pixel.
    pub fn pixel(&self, x: u32, y: u32, room: &mut Spots) -> [u8; 4] {
        let behind = self.ground.behind(x as f32 + 0.5, y as f32 + 0.5);
        let seen = self.window.columns.contains(&(x * FINE)) && self.shows_a_plant(x, y);
        let (sum, covered) = if seen { self.plants([x, y], &behind, room) } else { (Vec3::ZERO, 0.0) };
        let all = SAMPLES as f32;
        let open = (all - covered) * behind.opacity;
        let opacity = covered + open;
        if opacity <= 0.0 {
            return [0; 4];
        }
        let [r, g, b] = tone::colour((sum + behind.roots * open) / opacity);
        [r, g, b, (opacity / all * 255.0 + 0.5) as u8]
    }

    fn shows_a_plant(&self, x: u32, y: u32) -> bool {
        self.window.together(x * FINE, y * FINE).any(|(index, ..)| self.film.covers(index))
    }

    /// The sum of the roots of the light of the samples of a pixel that show plants, and their number.
    fn plants(&self, [x, y]: [u32; 2], behind: &Behind, Spots(room): &mut Spots) -> (Vec3, f32) {
        let mut count = 0;
        for (index, column, row) in self.window.together(x * FINE, y * FINE) {
            if let Some(seen) = self.film.seen(index).filter(|seen| seen.depth >= behind.depth) {
                room[count] = self.spot(seen, column, row);
                count += 1;
            }
        }
        let spots = &room[..count];
        let (mut sum, mut left) = (Vec3::ZERO, (1_u32 << spots.len()) - 1);
        while left != 0 {
            let first = left.trailing_zeros() as usize;
            let one = each(left).filter(|k| of_one_surface(&spots[first].seen, &spots[*k].seen));
            let surface = one.fold(1 << first, |surface, k| surface | 1 << k);
            left &= !surface;
            sum += self.surface(spots, surface);
        }
        (sum, spots.len() as f32)
    }

    fn spot(&self, seen: Seen, column: u32, row: u32) -> Spot {
        let x = self.window.place(column, row) / FINE as f32;
        let y = (row as f32 + 0.5) / FINE as f32;
        let stand = &self.set.stands[usize::from(seen.paint.subject)];
        let point = self.set.camera.unproject(x, y, seen.depth) - stand.offset;
        Spot { seen, point, tap: (row % FINE * FINE + column % FINE) as usize }
    }

    /// The sum of the roots of the light of the samples whose bits are set, which show one surface.
    fn surface(&self, spots: &[Spot], bits: u32) -> Vec3 {
        let paint = spots[bits.trailing_zeros() as usize].seen.paint;
        let subject = usize::from(paint.subject);
        let (normal, point) = each(bits).fold((Vec3::ZERO, Vec3::ZERO), |(normal, point), k| {
            (normal + spots[k].seen.normal, point + spots[k].point)
        });
        let point = point / bits.count_ones() as f32;
        let back = self.set.camera.back(point + self.set.stands[subject].offset);
        let light = &self.set.lights[subject];
        let shaded = shade(paint, normal.normalize_or(back), (point, back), light);
        let lit = |k: &usize| light.shadow.lit(spots[*k].point, shaded.normal, spots[*k].tap);
        let lit = shaded.sunlit.map_or(0, |_| each(bits).filter(lit).count());
        let roots = |light: Vec3, samples: usize| match samples {
            0 => Vec3::ZERO,
            _ => tone::shown(light).sqrt() * samples as f32,
        };
        roots(shaded.shade, bits.count_ones() as usize - lit) + roots(shaded.sunlit.unwrap_or_default(), lit)
    }
}

/// The places of the bits that are set.
fn each(bits: u32) -> impl Iterator<Item = usize> {
    let mut left = bits;
    std::iter::from_fn(move || {
        let place = left.trailing_zeros();
        left &= left.wrapping_sub(1);
        (place < u32::BITS).then_some(place as usize)
    })
}

/// Whether two samples show one surface, as far as light on it goes. Normals between those of corners are shorter than
/// unit vectors.
#[inline]
fn of_one_surface(one: &Seen, other: &Seen) -> bool {
    let (a, b) = (one.normal, other.normal);
    let (dot, least) = (a.dot(b), ONE_SURFACE * ONE_SURFACE * a.length_squared() * b.length_squared());
    one.paint == other.paint && dot > 0.0 && dot * dot >= least
}
