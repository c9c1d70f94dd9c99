//! The light of a plot found by voxels: the one model of light that plots use.
//!
//! Sources are followed side by side, each by one thread from its first beam to its last, and their sums are added in
//! the order of the sources as soon as those before are (`added`): so no number of threads shows. Of a source a voxel
//! has the share of its light that beams have in it on average, and keeps what they leave there. A voxel that the beams
//! of a source miss is asked at its middle. Absent: beams (`sweep`, `beam`), and what a canopy is (`canopy`).

use super::added;
use super::beam::{self, Along, Shone, depth_towards};
use super::canopy::{Canopy, Piece};
use super::grid::{BITS, Grid, UNITS, VOXELS};
use super::normals::{CLASSES, axes, met};
use super::shadow::Shadows;
use super::spot::Spot;
use super::sweep;
use super::wanted::Wanted;
use super::{Balance, LightModel, Lighting, Lit, Projection, Source};
use crate::math::exp;
use crate::shape::Point;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::borrow::Cow;

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
    /// The voxels whose light is wanted.
    wanted: Wanted,
    /// The share of open light in each of them, its mean over the voxel.
    pub light: Vec<f64>,
    /// The light that each of them keeps, m² of open ground; the others keep none.
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
        let mut field = Self {
            wanted: Wanted::of(&grid),
            grid,
            sources: sources.to_vec(),
            light: Vec::new(),
            kept: Vec::new(),
            balance: Balance::default(),
            lighting: lighting.clone(),
        };
        let lit = field.lit();
        (field.light, field.kept, field.balance) = lit;
        field
    }

    /// Of the wanted voxels the light and what they keep; what becomes of all light.
    fn lit(&self) -> (Vec<f64>, Vec<f64>, Balance) {
        let (wanted, shadows) = (&self.wanted, self.shadows());
        let indices = wanted.indices().par_iter().with_min_len(FEWEST_VOXELS);
        let even: Vec<f64> = indices.map(|index| self.extinction(*index as usize, None)).collect();
        let one = |source: &Source, room: Along| self.shone(wanted, &even, &shadows, source, room);
        let (sums, balance) = added::sums(&self.sources, wanted.count(), one);
        let parts = sums.into_par_iter().with_min_len(FEWEST_VOXELS).map(|[share, lost]| (share.min(1.0), lost));
        let (mut light, mut kept) = (Vec::new(), Vec::new());
        parts.unzip_into_vecs(&mut light, &mut kept);
        (light, kept, balance)
    }

    /// The light of one source. `along` has of each wanted voxel the share of its light and what it keeps of it.
    fn shone(&self, wanted: &Wanted, even: &[f64], shadows: &Shadows, source: &Source, room: Along) -> Shone {
        let extinction: Cow<[f64]> = match self.lighting.projection {
            Projection::Even(_) => even.into(),
            Projection::OfLeaves => {
                let met = self.met(source.towards);
                wanted.indices().iter().map(|index| self.extinction(*index as usize, met.as_ref())).collect()
            }
        };
        let mut shone = if self.grid.repeats() || !shadows.is_empty() {
            beam::shine(&self.grid, (wanted, &extinction), shadows, source, room)
        } else {
            sweep::shine(&self.grid, wanted, &extinction, source, room)
        };
        let missed = shone.along.iter_mut().zip(wanted.indices()).filter(|(sums, _)| sums[1] == 0.0);
        for (sums, index) in missed {
            let middle = Spot { voxel: self.voxel_of(*index as usize), inner: [0.5; 3] };
            *sums = [self.share_of(shadows, middle, source) * NO_WAY, NO_WAY];
        }
        for (sums, k) in shone.along.iter_mut().zip(&*extinction) {
            *sums = [(sums[0] / sums[1]).min(1.0), sums[0] * k];
        }
        shone
    }

    fn shadows(&self) -> Shadows {
        Shadows::of(&self.lighting.opaque, self.lighting.borders, self.lighting.origin)
    }

    fn voxel_of(&self, index: usize) -> [i32; 3] {
        let (place, inner) = (self.grid.bricks[index / VOXELS], (index % VOXELS) as i32);
        let inner = [inner & 7, (inner >> BITS) & 7, inner >> (2 * BITS)];
        [0, 1, 2].map(|k| (place[k] << BITS) + inner[k])
    }

    /// How much a beam meets of a unit of leaf area of each class of normals, by the volume of a voxel, 1/m; `None`
    /// where normals do not matter.
    fn met(&self, towards: Point) -> Option<[f64; CLASSES]> {
        let of_unit = 1.0 / UNITS / self.grid.volume();
        let of_leaves = self.lighting.projection == Projection::OfLeaves;
        of_leaves.then(|| axes().map(|axis| met(axis, towards) * of_unit))
    }

    /// The extinction of a voxel, 1/m, for light that meets so much of its leaves.
    fn extinction(&self, index: usize, met: Option<&[f64; CLASSES]>) -> f64 {
        match (self.lighting.projection, met) {
            (Projection::Even(g), _) => self.grid.area[index] as f64 * (g / UNITS / self.grid.volume()),
            (Projection::OfLeaves, Some(met)) => {
                let classes = &self.grid.by_normal[index * CLASSES..(index + 1) * CLASSES];
                classes.iter().zip(met).map(|(units, met)| *units as f64 * met).sum()
            }
            (Projection::OfLeaves, None) => 0.0,
        }
    }

    /// The share of the light of a source that reaches a place.
    fn share_of(&self, shadows: &Shadows, spot: Spot, source: &Source) -> f64 {
        if !shadows.is_empty() && shadows.hide(self.grid.place(spot), source.towards) {
            return 0.0;
        }
        let met = self.met(source.towards);
        exp(-depth_towards(&self.grid, |index| self.extinction(index, met.as_ref()), spot, source.towards))
    }

    /// The share of open light at a place, by a ray to each source: exact within the voxels, slower than
    /// [`Lit::share_at`].
    pub fn share_by_rays(&self, place: Point) -> f64 {
        let (shadows, spot) = (self.shadows(), self.grid.spot(place));
        self.sources.iter().map(|source| source.weight * self.share_of(&shadows, spot, source)).sum()
    }

    /// The mean share of open light on a rectangle of level ground, by rays from `count` × `count` places.
    pub fn share_of_ground(&self, [low, high]: [[f64; 2]; 2], height: f64, count: u32) -> f64 {
        let shadows = self.shadows();
        let count = count.max(1);
        let place = |cell: u32| {
            let along = |k: usize, cell: u32| low[k] + (high[k] - low[k]) * (f64::from(cell) + 0.5) / f64::from(count);
            self.grid.spot([along(0, cell % count), along(1, cell / count), height])
        };
        let one = |source: &Source| {
            let share = |cell| self.share_of(&shadows, place(cell), source);
            source.weight * (0..count * count).map(share).sum::<f64>()
        };
        let sums: Vec<f64> = self.sources.par_iter().map(one).collect();
        sums.iter().sum::<f64>() / f64::from(count * count)
    }
}

impl Lit for Field {
    fn share_at(&self, place: Point) -> f64 {
        let index = self.grid.index(self.grid.within(self.grid.voxel(place)));
        let number = index.and_then(|index| self.wanted.number(index));
        number.map_or_else(|| self.share_by_rays(place), |number| self.light[number])
    }

    fn kept_by(&self, piece: &Piece) -> f64 {
        let index = self.grid.index(self.grid.within(self.grid.voxel(piece.place)));
        let share = |index: usize| piece.area * UNITS / self.grid.area[index].max(1) as f64;
        let kept = |index: usize| self.wanted.number(index).map_or(0.0, |number| self.kept[number]);
        index.map_or(0.0, |index| kept(index) * share(index).min(1.0))
    }

    fn balance(&self) -> Balance {
        self.balance
    }
}
