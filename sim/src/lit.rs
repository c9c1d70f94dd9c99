//! The light at the end of a tick: found for the plants as they stand, and told to the buds that read it.
//!
//! All plants of a plot are lit together, so what grows at the next tick sees the state at its start, and no order of
//! plants shows. Absent: the light itself (`site::light`).

use crate::clock::Tick;
use crate::plot::Plot;
use crate::shape::Point;
use crate::site::light::field::grid_of;
use crate::site::light::{Borders, Canopy, Field, Lighting, Lit, Piece, Standing};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use std::sync::Arc;

/// A plant of a stand, by itself.
struct Alone<'a>(Standing<'a>, usize);

impl Canopy for Alone<'_> {
    fn plants(&self) -> usize {
        1
    }

    fn pieces(&self, _: usize, longest: f64, show: &mut dyn FnMut(Piece)) {
        self.0.pieces(self.1, longest, show);
    }

    fn buds(&self, _: usize, _: &mut dyn FnMut(usize, Point)) {}
}

impl Plot<'_> {
    /// Whether buds of some member read the light of the site.
    pub(crate) fn feels_light(&self) -> bool {
        self.site.light.as_ref().is_some_and(|light| light.felt)
    }

    /// States of the site's light whether some member reads it.
    pub fn ask_light(&mut self) {
        let felt = self.members.iter().any(|member| self.species[member.species].sees_light());
        if let Some(light) = &mut self.site.light {
            light.felt = felt;
        }
    }

    /// Finds the light of the plants as they stand at `tick`, and tells it to their buds; nothing where nobody asks.
    pub(crate) fn shine(&mut self, tick: Tick) {
        let Some(light) = self.site.light.as_mut().filter(|light| light.felt || light.told) else { return };
        let (species, members, plants) = (&self.species, &self.members, &mut self.plants);
        let feel: Vec<bool> = members.iter().map(|member| species[member.species].sees_light()).collect();
        let ages: Vec<Option<Tick>> = members.iter().map(|member| member.age_at(tick)).collect();
        let standing = Standing { plants, ages: &ages, wood: light.lighting.wood, feel: &feel };
        let mut buds = std::mem::take(&mut light.counted.buds);
        buds.resize(standing.plants(), Vec::new());
        buds.par_iter_mut().enumerate().for_each(|(plant, buds)| {
            buds.clear();
            standing.buds(plant, &mut |axis, place| buds.push((axis, place)));
        });
        let counted = light.counted.grid(&light.lighting, &standing, &buds);
        let grid = counted.unwrap_or_else(|| grid_of(&light.lighting, &standing));
        let field = Field::in_grid(&light.lighting, grid, &light.lighting.sources(tick));
        if light.felt {
            plants.par_iter_mut().zip(&buds).for_each(|(plant, buds)| {
                let lit = buds.iter().map(|(axis, place)| (*axis, field.share_at(*place)));
                plant.shade.set(plant.axes.len(), lit);
            });
        }
        light.counted.buds = buds;
        light.found = Some(Arc::new(field));
    }

    fn ages(&self, tick: Tick) -> Vec<Option<Tick>> {
        self.members.iter().map(|member| member.age_at(tick)).collect()
    }

    /// The area of one side of all leaves that stand at `tick`, m².
    pub fn leaf_area(&self, tick: Tick) -> f64 {
        let (plants, ages) = (&self.plants, self.ages(tick));
        let standing = Standing { plants, ages: &ages, wood: false, feel: &[] };
        let mut sum = 0.0;
        let mut add = |piece: Piece| sum += piece.area;
        (0..plants.len()).for_each(|plant| standing.pieces(plant, f64::INFINITY, &mut add));
        sum
    }

    /// The light that a member keeps at `tick`, when the plants stand and their light has been found, and the light
    /// that it would keep without its neighbours, m² of open ground; `None` where there is no light. The second is
    /// found for the plant by itself, on open ground, so it costs as much as the light of a plot of this plant.
    pub fn intercepted(&self, member: usize, tick: Tick) -> Option<(f64, f64)> {
        let light = self.site.light.as_ref()?;
        let (field, lighting) = (light.found.as_deref()?, &light.lighting);
        let (plants, ages) = (&self.plants, self.ages(tick));
        let standing = Standing { plants, ages: &ages, wood: lighting.wood, feel: &[] };
        let kept = |field: &Field| {
            let mut sum = 0.0;
            standing.pieces(member, lighting.voxel_m / 2.0, &mut |piece| sum += field.kept_by(&piece));
            sum
        };
        let together = kept(field);
        if plants.len() == 1 && lighting.borders == Borders::Open {
            return Some((together, together));
        }
        let open = Lighting { borders: Borders::Open, ..lighting.clone() };
        let alone = Field::of(&open, &Alone(Standing { feel: &[], ..standing }, member), &field.sources);
        Some((together, kept(&alone)))
    }
}
