//! Plants made for the tests, and their trips: from a description to a file and back.

use super::{again, written};
use crate::exchange::grown::CLASSES;
use crate::exchange::vectors::{cross, unit};
use crate::exchange::{Class, Description, Entity, FeatureType, Individual, Link, Observation, Role, Standing, Value};

/// No plant, with the classes of this program.
fn empty() -> Description {
    let class = |(symbol, scale, role): (&str, u32, Role)| Class { symbol: symbol.to_owned(), scale, role };
    let individual =
        Individual { name: Some("one".to_owned()), species: Some("made".to_owned()), ..Individual::default() };
    Description { individuals: vec![individual], classes: CLASSES.map(class).to_vec(), ..Description::default() }
}

/// A straight stem of internodes: length, and diameters at base and tip, m.
pub fn stem(internodes: &[(f64, f64, f64)]) -> Description {
    let mut made = empty();
    let entities = &mut made.individuals[0].entities;
    entities.push(Entity::of(0));
    entities.push(Entity { complex: Some(0), ..Entity::of(1) });
    let mut height = 0.0;
    for (place, &(length, base, tip)) in internodes.iter().enumerate() {
        let mut entity = Entity { complex: Some(1), index: Some(place as f64 + 1.0), ..Entity::of(3) };
        if place > 0 {
            (entity.bearer, entity.link) = (Some(place as u32 + 1), Some(Link::Follows));
        }
        entity.observations.push(Observation {
            length: Some(length),
            base_diameter: Some(base),
            tip_diameter: Some(tip),
            place: Some([0.0, 0.0, height]),
            direction: Some([0.0, 0.0, 1.0]),
            up: Some([1.0, 0.0, 0.0]),
            ..Observation::default()
        });
        entities.push(entity);
        height += length;
    }
    made
}

/// Numbers from 0 to 1, the same for a seed everywhere.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn direction(&mut self) -> [f64; 3] {
        unit([self.next() - 0.5, self.next() - 0.5, self.next()]).unwrap_or([0.0, 0.0, 1.0])
    }
}

/// A plant of some axes with growth units, internodes and organs, ages and features.
pub fn plant(seed: u64, internodes: usize) -> Description {
    let mut made = empty();
    let vigour = made.feature("vigour", FeatureType::Real);
    let note = made.feature("note", FeatureType::Text);
    let mut numbers = Numbers(seed);
    let plant = &mut made.individuals[0];
    plant.age = Some(internodes as u32);
    plant.entities.push(Entity { birth: Some(0), ..Entity::of(0) });
    // The last internode and the growth unit of each axis.
    let mut tips: Vec<(Option<u32>, u32, u32)> = Vec::new();
    for count in 0..internodes {
        let bearers = plant.entities.iter().enumerate().filter(|(_, entity)| entity.class == 3);
        let bearers: Vec<u32> = bearers.map(|(place, _)| place as u32).collect();
        let mut axis = (numbers.next() * tips.len() as f64) as usize;
        if tips.is_empty() || numbers.next() < 0.2 {
            let bearer = (!bearers.is_empty()).then(|| bearers[(numbers.next() * bearers.len() as f64) as usize]);
            let link = bearer.map(|_| Link::Branches);
            let place = plant.entities.len() as u32;
            plant.entities.push(Entity { bearer, link, complex: Some(0), index: Some(1.0), ..Entity::of(1) });
            plant.entities.push(Entity { complex: Some(place), index: Some(1.0), ..Entity::of(2) });
            axis = tips.len();
            tips.push((None, place + 1, place));
        }
        let (mut before, mut unit_of, axis_of) = tips[axis];
        if before.is_some() && numbers.next() < 0.3 {
            let next =
                Entity { bearer: Some(unit_of), link: Some(Link::Follows), complex: Some(axis_of), ..Entity::of(2) };
            unit_of = plant.entities.len() as u32;
            plant.entities.push(next);
            before = None;
        }
        let internode = plant.entities.len() as u32;
        let mut entity =
            Entity { complex: Some(unit_of), bearer: before, link: before.map(|_| Link::Follows), ..Entity::of(3) };
        entity.birth = Some(count as u32);
        entity.death = (numbers.next() < 0.1).then_some(internodes as u32 - 1);
        entity.dead = entity.death.map(|_| true);
        entity.observations.push(seen(&mut numbers));
        entity.latest_mut().values = vec![(vigour, Value::Real(numbers.next())), (note, Value::Text("a < b".into()))];
        plant.entities.push(entity);
        tips[axis] = (Some(internode), unit_of, axis_of);
        for organ in 4..7 {
            if numbers.next() < 0.4 {
                let mut entity = Entity {
                    bearer: Some(internode),
                    link: Some(Link::Branches),
                    complex: Some(unit_of),
                    index: Some(1.0),
                    ..Entity::of(organ)
                };
                entity.observations.push(Observation {
                    area: Some(numbers.next() * 0.01),
                    tip_diameter: None,
                    ..seen(&mut numbers)
                });
                plant.entities.push(entity);
            }
        }
    }
    made
}

fn seen(numbers: &mut Numbers) -> Observation {
    let direction = numbers.direction();
    let base = 0.001 + 0.05 * numbers.next();
    Observation {
        length: Some(0.001 + 0.3 * numbers.next()),
        base_diameter: Some(base),
        tip_diameter: Some(base * numbers.next()),
        place: Some([numbers.next() * 20.0 - 10.0, numbers.next() * 20.0 - 10.0, numbers.next() * 40.0]),
        direction: Some(direction),
        up: unit(cross(direction, numbers.direction())),
        ..Observation::default()
    }
}

/// What an entity is among the others, with all that it is told of it but its sizes.
type Told = (String, Role, Option<f64>, [Option<u32>; 4], Option<Link>, Option<bool>, Vec<(String, Value)>);

/// All entities in the order in which an OPF file has them, so that descriptions of different order agree: places of
/// entities are told by their own places in that order.
fn told(of: &Description) -> Vec<(Told, Option<Observation>)> {
    let plant = &of.individuals[0];
    // An order that the topology alone tells: children after their parents, by place and class.
    let parent = |entity: &Entity| entity.bearer.or(entity.complex);
    let mut order: Vec<u32> = Vec::new();
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); plant.entities.len()];
    for (place, entity) in plant.entities.iter().enumerate().skip(1) {
        children[parent(entity).unwrap_or(0) as usize].push(place as u32);
    }
    let mut stack = vec![0];
    while let Some(at) = stack.pop() {
        order.push(at);
        let mut next = std::mem::take(&mut children[at as usize]);
        next.sort_by_key(|place| {
            let entity = &plant.entities[*place as usize];
            (entity.link, of.role_of(entity), entity.birth, *place)
        });
        stack.extend(next.into_iter().rev());
    }
    let mut place_of = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, number)| place_of[*number as usize] = place as u32);
    let line = |number: &u32| {
        let entity = &plant.entities[*number as usize];
        let values = entity.latest().map_or(&[][..], |seen| &seen.values).iter();
        let mut values: Vec<(String, Value)> =
            values.map(|(feature, value)| (of.features[*feature as usize].name.clone(), value.clone())).collect();
        values.sort_by(|a, b| a.0.cmp(&b.0));
        let of_place = |number: Option<u32>| number.map(|number| place_of[number as usize]);
        let places = [of_place(entity.bearer), of_place(entity.complex), entity.birth, entity.death];
        let symbol = of.class_of(entity).scale.to_string();
        ((symbol, of.role_of(entity), entity.index, places, entity.link, entity.dead, values), entity.latest().cloned())
    };
    order.iter().map(line).collect()
}

/// Whether two numbers, or none, differ by no more.
fn near(a: Option<f64>, b: Option<f64>, by: f64) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= by,
        (a, b) => a.is_none() && b.is_none(),
    }
}

fn near_all(a: Option<[f64; 3]>, b: Option<[f64; 3]>, by: f64) -> bool {
    (0..3).all(|k| near(a.map(|a| a[k]), b.map(|b| b[k]), by))
}

/// Holds two descriptions of one plant against each other; lengths to a micrometre.
fn agree(a: &Description, b: &Description) {
    let (a, b) = (told(a), told(b));
    assert_eq!(a.len(), b.len());
    for ((told_a, seen_a), (told_b, seen_b)) in a.iter().zip(&b) {
        assert_eq!(told_a, told_b);
        let (Some(x), Some(y)) = (seen_a, seen_b) else {
            assert_eq!(seen_a.is_some(), seen_b.is_some());
            continue;
        };
        let sizes = [(x.length, y.length), (x.base_diameter, y.base_diameter), (x.tip_diameter, y.tip_diameter)];
        assert!(sizes.iter().all(|(a, b)| near(*a, *b, 1e-6)) && near(x.area, y.area, 1e-9), "{x:?} {y:?}");
        assert!(near_all(x.place, y.place, 1e-6) && near_all(x.direction, y.direction, 1e-6), "{x:?} {y:?}");
        assert!(near_all(x.up, y.up, 1e-6), "{x:?} {y:?}");
    }
}

#[test]
fn opf_keeps_all_that_a_plant_has() {
    for seed in 0..30 {
        let made = plant(seed, 1 + 12 * seed as usize);
        let found = again("opf", &made);
        agree(&made, &found);
        let of = |of: &Description| {
            (of.individuals[0].name.clone(), of.individuals[0].species.clone(), of.individuals[0].age)
        };
        assert_eq!(of(&found), of(&made));
        assert_eq!(written("opf", &found).0, written("opf", &made).0, "{seed}");
    }
}

#[test]
fn scenes_keep_how_plants_stand() {
    let mut made = plant(1, 30);
    made.individuals[0].standing =
        Some(Standing { place: [3.25, -1.5, 0.125], scale: 1.5, azimuth: 0.3, inclination: 0.2, twist: 2.0 });
    let mut second = made.individuals[0].clone();
    second.standing = second.standing.map(|standing| Standing { place: [4.0, 0.0, 0.0], ..standing });
    second.entities.truncate(5);
    made.individuals.push(second);
    let found = again("ops", &made);
    agree(&made, &found);
    let standing = |of: &Description| of.individuals.iter().map(|plant| plant.standing).collect::<Vec<_>>();
    assert_eq!(standing(&found), standing(&made));
    assert_eq!(written("ops", &found).0, written("ops", &made).0);
}

/// Total length, and volume by the formula of the truncated cone.
fn sums(of: &Description) -> (f64, f64) {
    let wood = of.individuals[0].entities.iter().filter(|entity| of.role_of(entity) == Role::Internode);
    let seen = wood.filter_map(|entity| entity.latest());
    seen.fold((0.0, 0.0), |(length, volume), seen| {
        let (l, a) = (seen.length.unwrap(), seen.base_diameter.unwrap() / 2.0);
        let b = seen.tip_diameter.unwrap() / 2.0;
        (length + l, volume + std::f64::consts::PI * l * (a * a + a * b + b * b) / 3.0)
    })
}

#[test]
fn cylinders_keep_length_and_volume() {
    for seed in 0..20 {
        let made = plant(seed, 60);
        let (length, volume) = sums(&made);
        for word in ["treeqsm", "treeqsm15", "rtwig"] {
            let found = again(word, &made);
            let (l, v) = sums(&found);
            assert!((l / length - 1.0).abs() < 1e-9 && (v / volume - 1.0).abs() < 1e-9, "{word} {seed}");
            assert_eq!(written(word, &found).0, written(word, &made).0, "{word} {seed}");
            let count = |of: &Description, role: Role| {
                of.individuals[0].entities.iter().filter(|entity| of.role_of(entity) == role).count()
            };
            assert_eq!(count(&found, Role::Internode), count(&made, Role::Internode));
            assert_eq!(count(&found, Role::Axis), count(&made, Role::Axis), "{word} {seed}");
        }
        let (_, losses) = written("treeqsm", &made);
        assert!(losses.iter().any(|loss| loss.starts_with("lost: how wood narrows (60)")), "{losses:?}");
        assert!(losses.iter().any(|loss| loss.starts_with("lost: leaves (")), "{losses:?}");
    }
}

#[test]
fn what_is_not_known_is_not_made_up() {
    let mut made = plant(5, 20);
    for (place, entity) in made.individuals[0].entities.iter_mut().enumerate() {
        let Some(seen) = entity.observations.last_mut() else { continue };
        match place % 5 {
            0 => seen.direction = None,
            1 => (seen.place, seen.direction, seen.up) = (None, None, None),
            2 => seen.length = None,
            3 => (seen.base_diameter, seen.tip_diameter) = (None, None),
            _ => seen.up = None,
        }
    }
    let found = again("opf", &made);
    let seen = |of: &Description| {
        let entities = of.individuals[0].entities.clone();
        let known = |seen: &Observation| {
            [seen.place.is_some(), seen.direction.is_some(), seen.length.is_some(), seen.base_diameter.is_some()]
        };
        entities
            .iter()
            .map(|entity| entity.latest().map_or([false; 4], known))
            .filter(|known| *known != [false; 4])
            .fold([0; 4], |sum: [usize; 4], known| [0, 1, 2, 3].map(|k| sum[k] + usize::from(known[k])))
    };
    assert_eq!(seen(&found), seen(&made));
    assert_eq!(written("opf", &found).0, written("opf", &made).0);
    // Wood without a place has no row, and what it bears springs from its bearer.
    let rows = again("treeqsm", &made);
    assert!(!rows.individuals[0].entities.is_empty());
}
