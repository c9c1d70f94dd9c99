//! From the ends of components, which digitised plants tell as XX, YY and ZZ, to their bases and directions.
//!
//! A component begins where its bearer ends. The first of a complex begins at the point of the complex, unless that is
//! its own end, as of branches of which the insertion was not digitised. The point of a complex is its own base. Where
//! no point is told before a component, its base stays unknown. Its length is that between the points, where the file
//! tells none.

use crate::exchange::description::{Description, Individual, Observation};

/// Turns points into bases, for all plants.
pub fn to_bases(description: &mut Description) {
    description.individuals.iter_mut().for_each(of_one);
}

fn of_one(individual: &mut Individual) {
    let count = individual.entities.len();
    let mut has_parts = vec![false; count];
    for entity in &individual.entities {
        entity.complex.into_iter().for_each(|complex| has_parts[complex as usize] = true);
    }
    let point = |place: usize| individual.entities[place].observations.iter().rev().find_map(|seen| seen.place);
    let mut ends: Vec<Option<[f64; 3]>> = vec![None; count];
    let mut starts = vec![None; count];
    for place in 0..count {
        let entity = &individual.entities[place];
        let own = point(place);
        let before = entity.bearer.and_then(|bearer| ends[bearer as usize]);
        let of_complex = entity.complex.filter(|_| entity.bearer.is_none()).map(|complex| complex as usize);
        let begun =
            of_complex.and_then(|complex| point(complex).filter(|point| Some(*point) != own).or(starts[complex]));
        starts[place] = before.or(begun);
        ends[place] = own.or(starts[place]);
    }
    for (place, entity) in individual.entities.iter_mut().enumerate() {
        if has_parts[place] {
            continue;
        }
        for seen in &mut entity.observations {
            if let Some(end) = seen.place {
                between(seen, starts[place], end);
            }
        }
    }
}

fn between(seen: &mut Observation, start: Option<[f64; 3]>, end: [f64; 3]) {
    seen.place = start;
    let Some(start) = start else { return };
    let apart = [0, 1, 2].map(|k| end[k] - start[k]);
    let length = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length.is_finite() && length > 0.0 {
        seen.direction = Some(apart.map(|x| x / length));
        seen.length = seen.length.or(Some(length));
    }
}
