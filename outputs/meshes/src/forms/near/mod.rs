//! Forms as they are seen from near: at detail 1 to 3, in place of the few polygons of detail 0.
//!
//! A blade that bends or is folded looks right in its own proportions alone, so a form is made for a class of width
//! over length, in steps of √2, when it is first asked for. An organ is fitted to its area as at detail 0, so that it
//! has the area of the tables. What has no settings is a catkin, a solid that becomes rounder, or an inflorescence that
//! stays as it is.
//! Absent: which detail an organ has in a picture (`crate::scene`).

mod area;
mod brush;
mod build;
mod capitulum;
mod catkin;
mod cluster;
mod flower;
mod leaf;
mod rounder;
mod sheet;
#[cfg(test)]
mod tests;

pub use area::fullness;

use super::FormMesh;
use phytomer_looks::{Cluster, FormName, MOST_DETAIL, Near};
use phytomer_sim::plant::Form;
use std::sync::{LazyLock, OnceLock};

/// The classes of width over length: 2^(k/2), from the class of −16 to that of 4.
const CLASSES: usize = 21;
const LEAST_CLASS: i32 = -16;

/// The most steps to the class of an organ that is slimmer or fuller than its form.
const STEPS: usize = 4;

/// Forms that are made when they are first asked for: a class after the other, in each detail after the other.
#[derive(Debug)]
pub struct Made {
    places: Vec<OnceLock<Box<FormMesh>>>,
}

impl Made {
    /// Room for one setting.
    pub fn new() -> Self {
        let mut places = Vec::new();
        places.resize_with(CLASSES * usize::from(MOST_DETAIL), OnceLock::new);
        Self { places }
    }

    /// The form of a setting at a detail from 1, for an organ of this length, width and area, and its place.
    pub fn of(&self, near: &Near, detail: u8, size: [f32; 2], area: f32) -> (&FormMesh, u8) {
        self.fitting(detail, size, area, |aspect, detail| made(near, aspect, detail))
    }

    /// The form at a place, where it was made.
    pub fn at_place(&self, place: u8) -> Option<&FormMesh> {
        self.places.get(usize::from(place))?.get().map(AsRef::as_ref)
    }

    /// The form in the proportions that an organ of this area has: where it is much slimmer or fuller than its form,
    /// those are not its length and width.
    fn fitting(
        &self,
        detail: u8,
        [length, width]: [f32; 2],
        area: f32,
        make: impl Fn(f32, u8) -> FormMesh,
    ) -> (&FormMesh, u8) {
        let (mut form, mut place) = self.at(detail, [length, width], &make);
        if area <= 0.0 || area.is_nan() || form.in_parts {
            return (form, place);
        }
        let mut wide = width;
        for _ in 0..STEPS {
            let share = form.area_share(f64::from(wide / length)) as f32;
            let next = (area / (length * share)).clamp(1e-3 * wide, 1e3 * wide);
            if !next.is_finite() || class([length, next]) == class([length, wide]) {
                break;
            }
            wide = next;
            (form, place) = self.at(detail, [length, wide], &make);
        }
        (form, place)
    }

    fn at(&self, detail: u8, size: [f32; 2], make: &impl Fn(f32, u8) -> FormMesh) -> (&FormMesh, u8) {
        let (detail, class) = (detail.clamp(1, MOST_DETAIL), class(size));
        let place = usize::from(detail - 1) * CLASSES + class;
        (self.places[place].get_or_init(|| Box::new(make(aspect_of(class), detail))), place as u8)
    }
}

impl Default for Made {
    fn default() -> Self {
        Self::new()
    }
}

static LIBRARY: LazyLock<Vec<Made>> = LazyLock::new(|| FormName::ALL.iter().map(|_| Made::new()).collect());

/// The form of the library at a place, where it was made.
pub fn of_library_at(form: Form, place: u8) -> Option<&'static FormMesh> {
    LIBRARY[FormName::of(form).unwrap_or(FormName::Elliptic) as usize].at_place(place)
}

/// The form of the library at a detail from 1, for an organ of this length, width and area, and its place.
pub fn of_library(form: Form, detail: u8, size: [f32; 2], area: f32) -> (&'static FormMesh, u8) {
    let name = FormName::of(form).unwrap_or(FormName::Elliptic);
    LIBRARY[name as usize].fitting(detail, size, area, |aspect, detail| match name.near() {
        Some(near) => made(&near, aspect, detail),
        None if name == FormName::Catkin => catkin::catkin(aspect, detail),
        None => rounder::rounder(super::shape(name.form()), [1, 2, 3, 5][usize::from(detail)]),
    })
}

/// The most corners of a form: a chunk of vertices must hold it.
const MOST_CORNERS: usize = 20_000;

/// The form at a detail, or at the next lower one where it would have more than [`MOST_CORNERS`]; a cluster of which
/// even that has more has half as many parts, or half of these.
fn made(near: &Near, aspect: f32, detail: u8) -> FormMesh {
    let at = |detail: u8| match near {
        Near::Blade(blade) => leaf::leaf(blade, aspect, detail),
        Near::Flower(flower) => flower::flower(flower, aspect, detail),
        Near::Capitulum(head) => capitulum::capitulum(head, aspect, detail),
        Near::Brush(needles) => brush::brush(needles, aspect, detail),
        Near::Cluster(parts) => cluster::cluster(parts, aspect, detail),
    };
    let fits = |form: &FormMesh| form.points.len() <= MOST_CORNERS;
    if let Some(form) = (1..=detail).rev().map(at).find(fits) {
        return form;
    }
    let fewer = |times: u32| match near {
        Near::Cluster(parts) => {
            Some(cluster::cluster(&Cluster { count: (parts.count >> times).max(1), ..*parts }, aspect, 1))
        }
        _ => None,
    };
    let found = (1..u8::BITS).filter_map(fewer).find(fits);
    found.unwrap_or_else(|| leaf::leaf(&phytomer_looks::Blade::default(), aspect, 1))
}

/// The class of an organ of this length and width.
fn class([length, width]: [f32; 2]) -> usize {
    let aspect = width / length;
    let steps = (LEAST_CLASS..LEAST_CLASS + CLASSES as i32 - 1).filter(|k| aspect > edge(*k)).count();
    steps.min(CLASSES - 1)
}

/// The width over the length between a class and the next: 2^(k/2 + 1/4).
fn edge(k: i32) -> f32 {
    power_of_root_two(k) * 1.189_207_1
}

fn aspect_of(class: usize) -> f32 {
    power_of_root_two(LEAST_CLASS + class as i32)
}

/// 2^(k/2), exact products of a power of two and √2.
fn power_of_root_two(k: i32) -> f32 {
    let whole = k.div_euclid(2);
    let power = if whole < 0 { 1.0 / (1_u32 << -whole) as f32 } else { (1_u32 << whole) as f32 };
    if k.rem_euclid(2) == 1 { power * std::f32::consts::SQRT_2 } else { power }
}
