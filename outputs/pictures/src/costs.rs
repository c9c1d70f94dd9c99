//! How many triangles the organs of a plant have as a tolerance grows and as organs become fewer.
//!
//! Each organ has at most three coarser forms, each from a distance on. So the triangles of all organs are known for
//! every tolerance and every share after one scan. Absent: wood, and which tolerance and share a level has (`levels`).

use phytomer_meshes::{ClassSums, OrganBox, Room, Scene, TakePlaces, Thinned, organ_class, organ_number};
use phytomer_sim::plant::OrganId;
use rayon::prelude::*;
use std::ops::Range;

/// The parts of which a share is a whole number.
const PARTS: usize = 4096;

/// The coarser forms of an organ.
const COARSER: usize = 3;

/// The organs that are looked at together.
const TOGETHER: usize = 4096;

/// An organ.
#[derive(Debug, Clone, Copy)]
struct Cost {
    organ: OrganId,
    /// The number by which it is kept.
    number: f64,
    /// Its class among those that become fewer, and its area, m².
    class: Option<u8>,
    area: f64,
    /// Its triangles in its own form and in the coarser ones, and the step from which on it has each of these.
    faces: [u32; COARSER + 1],
    steps: [u32; COARSER],
    held: Option<OrganBox>,
}

impl Cost {
    fn of(scene: &Scene, organ: OrganId, distances: &[f32]) -> Self {
        let (plant, age) = (scene.plant(), scene.age());
        let class = organ_class(plant, organ);
        let mut cost = Self {
            organ,
            // An organ of a kind that never becomes fewer has a number that every share keeps.
            number: if class.is_some() { organ_number(plant, organ) } else { -1.0 },
            class: class.map(|class| class as u8),
            area: plant.organ_area(organ, age),
            faces: [scene.faces_of(organ) as u32; COARSER + 1],
            steps: [u32::MAX; COARSER],
            held: scene.box_of(organ),
        };
        let mut count = 0;
        scene.coarser_of(organ, &mut |distance, faces| {
            let step = distances.partition_point(|step| *step < distance);
            if count < COARSER && step < distances.len() {
                cost.steps[count] = step as u32;
                count += 1;
                cost.faces[count..].fill(faces);
            }
        });
        cost
    }

    fn at(&self, step: u32) -> u64 {
        u64::from(self.faces[self.steps.iter().filter(|from| **from <= step).count()])
    }
}

/// The organs of a plant that are drawn.
#[derive(Debug, Default)]
pub struct Costs {
    organs: Vec<Cost>,
    /// The triangles of all at each step.
    all: Vec<u64>,
}

impl Costs {
    /// The organs of a scene, for steps of tolerances of these distances, metres, in their order.
    pub fn of(scene: &Scene, distances: &[f32]) -> Self {
        let count = scene.plant().organs.len();
        let of_part = |part: usize| -> Vec<Cost> {
            let organs = part * TOGETHER..((part + 1) * TOGETHER).min(count);
            scene.organs_of(organs).map(|organ| Cost::of(scene, organ, distances)).collect()
        };
        let parts: Vec<Vec<Cost>> = (0..count.div_ceil(TOGETHER)).into_par_iter().map(of_part).collect();
        let organs = parts.concat();
        let mut changes = vec![0_i64; distances.len()];
        for cost in &organs {
            for (count, step) in cost.steps.iter().enumerate().filter(|(_, step)| **step < u32::MAX) {
                changes[*step as usize] += i64::from(cost.faces[count + 1]) - i64::from(cost.faces[count]);
            }
        }
        let mut sum = organs.iter().map(|cost| i64::from(cost.faces[0])).sum::<i64>();
        let all = changes.iter().map(|change| {
            sum += change;
            sum as u64
        });
        Self { all: all.collect(), organs }
    }

    /// The triangles of the organs at a step of which a share is kept.
    pub fn faces(&self, step: u32, share: f64) -> u64 {
        if share >= 1.0 {
            return self.all.get(step as usize).copied().unwrap_or(0);
        }
        self.organs.iter().filter(|cost| cost.number < share).map(|cost| cost.at(step)).sum()
    }

    /// The fewest triangles that all organs have at any step.
    pub fn least_faces(&self) -> u64 {
        self.all.iter().copied().min().unwrap_or(0)
    }

    /// The largest share, of some parts of the whole, of which the organs have at most so many triangles.
    pub fn share_of(&self, step: u32, most: u64) -> f64 {
        let mut parts = vec![0; PARTS];
        self.organs.iter().for_each(|cost| parts[(cost.number * PARTS as f64) as usize] += cost.at(step));
        let mut sum = 0;
        let fits = parts.iter().take_while(|part| {
            sum += **part;
            sum <= most
        });
        fits.count() as f64 / PARTS as f64
    }

    /// The next lower share that is a whole number of parts: of a number of triangles that such a share has, the
    /// largest share within that number is none smaller.
    pub fn in_parts(share: f64) -> f64 {
        if share < 1.0 { (share * PARTS as f64) as u32 as f64 / PARTS as f64 } else { share }
    }

    /// The number of organs.
    pub fn len(&self) -> usize {
        self.organs.len()
    }

    /// Tells the places of some organs of a scene, but of those that it leaves out; places that are not asked for are
    /// not made.
    pub fn places(&self, organs: Range<usize>, scene: &Scene, room: &mut Room, take: &mut dyn TakePlaces) {
        let thinned = scene.options().thinned;
        let share = thinned.map_or(f64::INFINITY, |thinned| thinned.share);
        for cost in self.organs[organs].iter().filter(|cost| cost.number < share) {
            let factor = thinned.map_or(1.0, |thinned| thinned.factor(scene.plant(), cost.organ));
            if cost.held.is_none_or(|held| take.wants(&held.times(factor))) {
                scene.places_of_organ(cost.organ, cost.held.as_ref(), room, take);
            }
        }
    }

    /// The organs of which about a share is kept.
    pub fn thinned(&self, share: f64) -> Option<Thinned> {
        let mut sums = ClassSums::default();
        if share < 1.0 {
            let of_class = self.organs.iter().filter_map(|cost| Some((usize::from(cost.class?), cost)));
            of_class.for_each(|(class, cost)| sums.add(class, cost.area, cost.number < share));
        }
        sums.thinned(share)
    }
}
