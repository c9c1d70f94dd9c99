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
use super::{Balance, LightModel, Lighting, Lit, Projection, Source};
use crate::math::exp;
use crate::shape::Point;
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};

/// The sources that are followed at once: each takes 16 bytes a voxel.
const AT_ONCE: usize = 8;

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
    let of_plant = |plant: usize| {
        let mut grid = Grid::of(lighting);
        canopy.pieces(plant, lighting.voxel_m / 2.0, &mut |piece| grid.add(&piece));
        canopy.buds(plant, &mut |_, place| grid.mark(place));
        grid
    };
    let grids: Vec<Grid> = (0..canopy.plants()).into_par_iter().map(of_plant).collect();
    let mut grid = Grid::of(lighting);
    grids.iter().for_each(|of_plant| grid.join(of_plant));
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
            some.iter().zip(&shone).for_each(|(source, shone)| field.add(source, shone));
        }
        field.light.iter_mut().for_each(|light| *light = light.min(1.0));
        field
    }

    fn add(&mut self, source: &Source, shone: &Shone) {
        // Light across a beam of 1 m² falls on 1/sine m² of level ground.
        let on_ground = source.weight / source.towards[2];
        let each = self.light.iter_mut().zip(&mut self.kept).zip(&shone.along);
        for ((light, kept), [share, lost]) in each {
            *light += source.weight * share;
            *kept += on_ground * shone.section * lost;
        }
        let Balance { sent, kept, stopped, passed } = shone.balance;
        let [sent, kept, stopped, passed] = [sent, kept, stopped, passed].map(|of| of * on_ground);
        self.balance = self.balance.with(Balance { sent, kept, stopped, passed });
    }

    /// Finds the light in the middle of each voxel that is wanted and that the beams of a source have missed.
    fn fill_missed(&self, shone: &mut Shone, extinction: &[f64], shadows: &Shadows, source: &Source) {
        for (index, sums) in shone.along.iter_mut().enumerate().filter(|(_, sums)| sums[1] == 0.0) {
            if !self.grid.is_wanted(index) {
                continue;
            }
            let share = share_of(&self.grid, extinction, shadows, (self.middle(index), source));
            *sums = [share * NO_WAY, NO_WAY];
        }
    }

    fn voxel_of(&self, index: usize) -> [i32; 3] {
        let (place, inner) = (self.grid.bricks[index / VOXELS], (index % VOXELS) as i32);
        let inner = [inner & 7, (inner >> BITS) & 7, inner >> (2 * BITS)];
        [0, 1, 2].map(|k| (place[k] << BITS) + inner[k])
    }

    fn middle(&self, index: usize) -> Point {
        let voxel = self.voxel_of(index);
        [0, 1, 2].map(|k| self.grid.origin[k] + (f64::from(voxel[k]) + 0.5) * self.grid.edges[k])
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
        let even = self.even_extinction();
        let one = |source: &Source| {
            let extinction = self.extinction(&even, source.towards);
            source.weight * share_of(&self.grid, &extinction, &shadows, (place, source))
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
            [along(0, cell % count), along(1, cell / count), height]
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
fn share_of(grid: &Grid, extinction: &[f64], shadows: &Shadows, (place, source): (Point, &Source)) -> f64 {
    if !shadows.is_empty() && shadows.hide(place, source.towards) {
        return 0.0;
    }
    exp(-depth_towards(grid, extinction, place, source.towards))
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
