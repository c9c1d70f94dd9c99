//! The light of a plot found by voxels: the one model of light that plots use.
//!
//! Sources are followed side by side, each by one thread from its first beam to its last, and their sums are added in
//! the order of the sources: so no number of threads shows. Of a source a voxel has the share of its light that beams
//! have in it on average, and keeps what they leave there. A voxel that the beams of a source miss is asked at its
//! middle. Absent: beams (`beam`), and what a canopy is (`canopy`).

use super::beam::{self, Shone, depth_towards};
use super::canopy::{Canopy, Piece};
use super::grid::{BITS, Grid, UNITS, VOXELS};
use super::normals::{CLASSES, axes, met};
use super::shadow::Shadows;
use super::spot::Spot;
use super::{Balance, LightModel, Lighting, Lit, Projection, Source};
use crate::math::exp;
use crate::shape::Point;
use rayon::iter::{
    IndexedParallelIterator, IntoParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator,
    ParallelIterator,
};

/// The sources that are followed at once: each takes 16 bytes a voxel.
const AT_ONCE: usize = 8;

/// The fewest plants whose leaf area a thread adds up in a grid of its own.
const FEWEST_PLANTS: usize = 16;

/// The fewest voxels to which a thread adds the light of sources.
const FEWEST_VOXELS: usize = 4_096;

/// A way so short that nothing is kept on it, metres.
const NO_WAY: f64 = 1e-150;

/// The light of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// The voxels.
    pub grid: Grid,
    /// What lit them.
    pub sources: Vec<Source>,
    /// The share of open light in each voxel, its mean over the voxel.
    pub light: Vec<f64>,
    /// The light that each voxel keeps, m² of open ground.
    pub kept: Vec<f64>,
    balance: Balance,
    lighting: Lighting,
}

impl LightModel for Lighting {
    fn light(&self, canopy: &dyn Canopy, sources: &[Source]) -> Box<dyn Lit> {
        Box::new(Field::of(self, canopy, sources))
    }
}

/// The leaf area of a canopy in voxels; also the voxels of its buds, so that their light is found.
pub fn grid_of(lighting: &Lighting, canopy: &dyn Canopy) -> Grid {
    let with_plant = |mut grid: Grid, plant: usize| {
        canopy.pieces(plant, lighting.voxel_m / 2.0, &mut |piece| grid.add(&piece));
        canopy.buds(plant, &mut |_, place| grid.mark(place));
        grid
    };
    let joined = |one: Grid, two: Grid| {
        let (mut more, fewer) = if one.bricks.len() < two.bricks.len() { (two, one) } else { (one, two) };
        more.join(&fewer);
        more
    };
    // Sums of whole numbers: how plants are shared among threads does not show.
    let plants = (0..canopy.plants()).into_par_iter().with_min_len(FEWEST_PLANTS);
    let mut grid = plants.fold(|| Grid::of(lighting), with_plant).reduce(|| Grid::of(lighting), joined);
    let anchor = grid.voxel(canopy.anchor());
    grid.anchor = [anchor[0], anchor[1]];
    grid.sort();
    grid
}

impl Field {
    /// The light of a canopy under these sources. Costs about 30 ns a voxel and source.
    pub fn of(lighting: &Lighting, canopy: &dyn Canopy, sources: &[Source]) -> Self {
        Self::in_grid(lighting, grid_of(lighting, canopy), sources)
    }

    /// The light in voxels that hold this leaf area.
    pub fn in_grid(lighting: &Lighting, grid: Grid, sources: &[Source]) -> Self {
        let shadows = Shadows::of(&lighting.opaque, lighting.borders, lighting.origin);
        let voxels = grid.area.len();
        let mut field = Self {
            grid,
            sources: sources.to_vec(),
            light: vec![0.0; voxels],
            kept: vec![0.0; voxels],
            balance: Balance::default(),
            lighting: lighting.clone(),
        };
        let even = field.even_extinction();
        for some in sources.chunks(AT_ONCE) {
            let one = |source: &Source| {
                let extinction = field.extinction(&even, source.towards);
                let mut shone = beam::shine(&field.grid, &extinction, &shadows, source);
                field.fill_missed(&mut shone, &extinction, &shadows, source);
                // What is kept stands in the place of the ways, which are no longer needed.
                for (sums, k) in shone.along.iter_mut().zip(&*extinction) {
                    let share = if sums[1] > 0.0 { (sums[0] / sums[1]).min(1.0) } else { 0.0 };
                    *sums = [share, sums[0] * k];
                }
                shone
            };
            let shone: Vec<Shone> = some.par_iter().map(one).collect();
            field.add(some, &shone);
        }
        field.light.iter_mut().for_each(|light| *light = light.min(1.0));
        field
    }

    /// Adds the light of sources, in their order in each voxel.
    fn add(&mut self, sources: &[Source], shone: &[Shone]) {
        // Light across a beam of 1 m² falls on 1/sine m² of level ground.
        let on_ground = |source: &Source| source.weight / source.towards[2];
        let scale = |(source, shone): (&Source, &Shone)| (source.weight, on_ground(source) * shone.section);
        let scales: Vec<(f64, f64)> = sources.iter().zip(shone).map(scale).collect();
        let voxels = self.light.par_iter_mut().zip(&mut self.kept).enumerate().with_min_len(FEWEST_VOXELS);
        voxels.for_each(|(voxel, (light, kept))| {
            for (shone, (of_light, of_kept)) in shone.iter().zip(&scales) {
                let [share, lost] = shone.along[voxel];
                *light += of_light * share;
                *kept += of_kept * lost;
            }
        });
        for (source, shone) in sources.iter().zip(shone) {
            let Balance { sent, kept, stopped, passed } = shone.balance;
            let [sent, kept, stopped, passed] = [sent, kept, stopped, passed].map(|of| of * on_ground(source));
            self.balance = self.balance.with(Balance { sent, kept, stopped, passed });
        }
    }

    /// Finds the light in the middle of each voxel that is wanted and that the beams of a source have missed.
    fn fill_missed(&self, shone: &mut Shone, extinction: &[f64], shadows: &Shadows, source: &Source) {
        for (index, sums) in shone.along.iter_mut().enumerate().filter(|(_, sums)| sums[1] == 0.0) {
            if !self.grid.is_wanted(index) {
                continue;
            }
            let middle = Spot { voxel: self.voxel_of(index), inner: [0.5; 3] };
            let share = share_of(&self.grid, extinction, shadows, (middle, source));
            *sums = [share * NO_WAY, NO_WAY];
        }
    }

    fn voxel_of(&self, index: usize) -> [i32; 3] {
        let (place, inner) = (self.grid.bricks[index / VOXELS], (index % VOXELS) as i32);
        let inner = [inner & 7, (inner >> BITS) & 7, inner >> (2 * BITS)];
        [0, 1, 2].map(|k| (place[k] << BITS) + inner[k])
    }

    /// The extinction of each voxel, 1/m, where it is the same in all directions; else nothing.
    fn even_extinction(&self) -> Vec<f64> {
        let Projection::Even(g) = self.lighting.projection else { return Vec::new() };
        let of_unit = g / UNITS / self.grid.volume();
        self.grid.area.iter().map(|units| *units as f64 * of_unit).collect()
    }

    fn extinction<'a>(&self, even: &'a [f64], towards: Point) -> std::borrow::Cow<'a, [f64]> {
        if self.lighting.projection != Projection::OfLeaves {
            return even.into();
        }
        let of_unit = 1.0 / UNITS / self.grid.volume();
        let met = axes().map(|axis| met(axis, towards) * of_unit);
        let of = |classes: &[u64]| classes.iter().zip(met).map(|(units, met)| *units as f64 * met).sum();
        self.grid.by_normal.chunks_exact(CLASSES).map(of).collect()
    }

    /// The share of open light at a place, by a ray to each source: exact within the voxels, slower than
    /// [`Lit::share_at`].
    pub fn share_by_rays(&self, place: Point) -> f64 {
        let shadows = Shadows::of(&self.lighting.opaque, self.lighting.borders, self.lighting.origin);
        let (even, spot) = (self.even_extinction(), self.grid.spot(place));
        let one = |source: &Source| {
            let extinction = self.extinction(&even, source.towards);
            source.weight * share_of(&self.grid, &extinction, &shadows, (spot, source))
        };
        self.sources.iter().map(one).sum()
    }

    /// The mean share of open light on a rectangle of level ground, by rays from `count` × `count` places.
    pub fn share_of_ground(&self, [low, high]: [[f64; 2]; 2], height: f64, count: u32) -> f64 {
        let shadows = Shadows::of(&self.lighting.opaque, self.lighting.borders, self.lighting.origin);
        let even = self.even_extinction();
        let count = count.max(1);
        let place = |cell: u32| {
            let along = |k: usize, cell: u32| low[k] + (high[k] - low[k]) * (f64::from(cell) + 0.5) / f64::from(count);
            self.grid.spot([along(0, cell % count), along(1, cell / count), height])
        };
        let one = |source: &Source| {
            let extinction = self.extinction(&even, source.towards);
            let share = |cell| share_of(&self.grid, &extinction, &shadows, (place(cell), source));
            source.weight * (0..count * count).map(share).sum::<f64>()
        };
        let sums: Vec<f64> = self.sources.par_iter().map(one).collect();
        sums.iter().sum::<f64>() / f64::from(count * count)
    }
}

/// The share of the light of a source that reaches a place.
fn share_of(grid: &Grid, extinction: &[f64], shadows: &Shadows, (spot, source): (Spot, &Source)) -> f64 {
    if !shadows.is_empty() && shadows.hide(grid.place(spot), source.towards) {
        return 0.0;
    }
    exp(-depth_towards(grid, extinction, spot, source.towards))
}

impl Lit for Field {
    fn share_at(&self, place: Point) -> f64 {
        match self.grid.index(self.grid.within(self.grid.voxel(place))) {
            Some(index) if self.grid.is_wanted(index) => self.light[index],
            _ => self.share_by_rays(place),
        }
    }

    fn kept_by(&self, piece: &Piece) -> f64 {
        let index = self.grid.index(self.grid.within(self.grid.voxel(piece.place)));
        let share = |index: usize| piece.area * UNITS / self.grid.area[index].max(1) as f64;
        index.map_or(0.0, |index| self.kept[index] * share(index).min(1.0))
    }

    fn balance(&self) -> Balance {
        self.balance
    }
}
