//! The values of the tables of measured plants, column by column.
//!
//! A column that is not told of below is null in every row: nobody has measured it. Rows are made in groups of one part
//! file's row groups, in the order that the tables state.

use super::Ticks;
use super::parts::{Measured, Part};
use crate::exchange::{Description, Entity, Observation};
use crate::tables::schema::{Column, Type};
use crate::tables::{NO_DATE, NULL, Part as File, ROW_GROUP, Sink, Table, TableError, Values};
use phytomer_sim::plant::key::Place;
use phytomer_sim::plant::{Kind, LineageKey};

/// A row of any of the tables.
#[derive(Clone, Copy)]
struct Row<'d> {
    plant: u32,
    tick: u32,
    number: u32,
    part: Option<(&'d Part, Option<&'d Entity>, Option<&'d Observation>)>,
    of: &'d Measured<'d>,
    sum: Sum,
}

/// What `summary` has of a plant at a tick.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Sum {
    counts: [u32; 6],
    max_order: u32,
    /// Height, crown width, leaf area, wood volume, diameter at the base; NaN where none is told.
    sizes: [f64; 5],
}

/// Writes all rows of a table.
pub fn fill<'d>(
    table: Table,
    (description, plants): (&'d Description, &'d [Measured<'d>]),
    ticks: &Ticks,
    columns: &'static [Column],
    file: &mut File,
) -> Result<(), TableError> {
    let mut waiting: Vec<Row<'d>> = Vec::new();
    let mut put = |row: Row<'d>, file: &mut File| -> Result<(), TableError> {
        waiting.push(row);
        if waiting.len() == ROW_GROUP { flush(&mut waiting, (description, columns), file) } else { Ok(()) }
    };
    let row = |plant: usize, tick: u32| {
        let of = &plants[plant];
        Row { plant: plant as u32, tick, number: 0, part: None, of, sum: Sum::default() }
    };
    let recorded = if matches!(table, Table::Records | Table::Summary) { ticks.recorded.as_slice() } else { &[0] };
    for &tick in recorded {
        for (plant, of) in plants.iter().enumerate() {
            match table {
                Table::Summary => {
                    let standing =
                        of.parts.iter().filter_map(|part| seen_at(of, part, tick, ticks).map(|seen| (part, seen)));
                    let sum = Sum::of(of, standing);
                    put(Row { sum, ..row(plant, tick) }, file)?;
                }
                Table::Components => {
                    for (number, part) in of.parts.iter().enumerate() {
                        let entity = of.entity(part);
                        let told = (part, entity, entity.and_then(Entity::latest));
                        put(Row { number: number as u32, part: Some(told), ..row(plant, tick) }, file)?;
                    }
                }
                Table::Records => {
                    for (number, part) in of.parts.iter().enumerate().filter(|(_, part)| part.kind != Kind::ApicalBud) {
                        let Some(seen) = seen_at(of, part, tick, ticks) else { continue };
                        let told = (part, of.entity(part), seen);
                        put(Row { number: number as u32, part: Some(told), ..row(plant, tick) }, file)?;
                    }
                }
                _ => put(row(plant, tick), file)?,
            }
        }
    }
    flush(&mut waiting, (description, columns), file)
}

fn flush(
    rows: &mut Vec<Row<'_>>,
    (description, columns): (&Description, &[Column]),
    file: &mut File,
) -> Result<(), TableError> {
    if rows.is_empty() {
        return Ok(());
    }
    let values = columns.iter().map(|column| values_of(column, description, rows)).collect();
    file.put(rows.len(), values)?;
    rows.clear();
    Ok(())
}

/// What was observed last of a component by a tick; `None` where it was not there yet, `Some(None)` where nothing but
/// that it was there is told.
fn seen_at<'d>(of: &'d Measured<'d>, part: &Part, tick: u32, ticks: &Ticks) -> Option<Option<&'d Observation>> {
    let entity = &of.individual.entities[part.entity? as usize];
    if entity.observations.is_empty() {
        return Some(None);
    }
    let seen = entity.observations.iter().rev().find(|seen| ticks.tick_of(seen) <= tick)?;
    Some(Some(seen))
}

impl Sum {
    fn of<'d>(of: &Measured<'_>, standing: impl Iterator<Item = (&'d Part, Option<&'d Observation>)>) -> Self {
        let mut sum = Self { sizes: [f64::NAN; 5], ..Self::default() };
        let mut box_of = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        let add = |to: &mut f64, more: f64| *to = if to.is_nan() { more } else { *to + more };
        for (part, seen) in standing {
            let dead = of.entity(part).and_then(|entity| entity.dead) == Some(true);
            let place = match (part.kind, dead) {
                (Kind::Leaf, _) => 1,
                (Kind::Flower, _) => 2,
                (Kind::Fruit, _) => 3,
                (Kind::ApicalBud, _) => continue,
                (_, false) => 0,
                (_, true) => 4,
            };
            sum.counts[place] += 1;
            sum.counts[5] += u32::from(part.rank == Some(1) && part.kind == Kind::Internode);
            sum.max_order = sum.max_order.max(part.order);
            let Some(seen) = seen else { continue };
            if part.kind == Kind::Leaf {
                seen.area.into_iter().for_each(|area| add(&mut sum.sizes[2], area));
                continue;
            }
            if part.kind != Kind::Internode {
                continue;
            }
            let base = seen.base_diameter.or(seen.tip_diameter);
            if let (Some(length), Some(base)) = (seen.length, base) {
                // The frustum of the two radii.
                let (a, b) = (base / 2.0, seen.tip_diameter.unwrap_or(base) / 2.0);
                add(&mut sum.sizes[3], std::f64::consts::PI * length * (a * a + a * b + b * b) / 3.0);
            }
            if part.parent.is_none() && part.order == 1 {
                sum.sizes[4] = seen.base_diameter.unwrap_or(f64::NAN);
            }
            if let (Some(place), false) = (seen.place, dead) {
                let along = seen.direction.unwrap_or([0.0; 3]).map(|x| x * seen.length.unwrap_or(0.0));
                for k in 0..3 {
                    for x in [place[k], place[k] + along[k]] {
                        box_of[k] = [box_of[k][0].min(x), box_of[k][1].max(x)];
                    }
                }
            }
        }
        if box_of[2][1].is_finite() {
            sum.sizes[0] = box_of[2][1];
            sum.sizes[1] = (box_of[0][1] - box_of[0][0] + box_of[1][1] - box_of[1][0]) / 2.0;
        }
        sum
    }
}

/// The values of a column. A name that is not known here is null.
fn values_of(column: &Column, description: &Description, rows: &[Row<'_>]) -> Values {
    match column.holds {
        Type::Bool => Values::Bool(rows.iter().map(|row| truth(column.name, row)).collect()),
        Type::Int => Values::Int(rows.iter().map(|row| whole(column.name, row).map_or(NULL, |n| n as i32)).collect()),
        Type::Key => Values::Key(rows.iter().map(key).collect()),
        Type::Date => Values::Date(vec![NO_DATE; rows.len()]),
        Type::Float => {
            Values::Float(rows.iter().map(|row| real(column.name, row).unwrap_or(f64::NAN) as f32).collect())
        }
        Type::Double => Values::Double(rows.iter().map(|row| real(column.name, row).unwrap_or(f64::NAN)).collect()),
        Type::Word(_) => Values::Word(rows.iter().map(|row| word(column.name, row)).collect()),
        Type::Name(_) => Values::Name(rows.iter().map(|row| name(column.name, description, row)).collect()),
    }
}

/// A key of a measured component is one of its number.
fn key(row: &Row<'_>) -> i64 {
    LineageKey::SEED.child(Place::Numbered.on(row.number)).0 as i64
}

fn truth(column: &str, row: &Row<'_>) -> i8 {
    let dead = row.part.and_then(|(_, entity, _)| entity?.dead) == Some(true);
    match column {
        "alive" => i8::from(!dead),
        "sampled" => 1,
        "guard" => 0,
        _ => -1,
    }
}

fn whole(column: &str, row: &Row<'_>) -> Option<u32> {
    let known = match column {
        "plot_id" | "replicate" => Some(0),
        "plant_id" => Some(row.plant),
        "tick" | "age" => Some(row.tick),
        "internodes" => Some(row.sum.counts[0]),
        "leaves" => Some(row.sum.counts[1]),
        "flowers" => Some(row.sum.counts[2]),
        "fruits" => Some(row.sum.counts[3]),
        "dead_internodes" => Some(row.sum.counts[4]),
        "axes" => Some(row.sum.counts[5]),
        "max_order" => Some(row.sum.max_order),
        _ => None,
    };
    if known.is_some() {
        return known;
    }
    let (part, entity, _) = row.part?;
    match column {
        "component_id" => Some(row.number),
        "parent_id" => part.parent,
        "axis_id" => Some(part.axis),
        "bearing_axis_id" => part.bearing,
        "order" => Some(part.order),
        "rank" => part.rank,
        "position" => part.position,
        "growth_unit" => part.unit,
        "unit_rank" => part.unit_rank,
        "birth_age" => entity?.birth,
        "death_age" => entity?.death,
        _ => None,
    }
}

fn real(column: &str, row: &Row<'_>) -> Option<f64> {
    let standing = row.of.individual.standing;
    match column {
        "height_m" => return Some(row.sum.sizes[0]),
        "crown_width_m" => return Some(row.sum.sizes[1]),
        "leaf_area_m2" => return Some(row.sum.sizes[2]),
        "wood_volume_m3" if row.part.is_none() => return Some(row.sum.sizes[3]),
        "basal_diameter_m" => return Some(row.sum.sizes[4]),
        "x_m" if row.part.is_none() => return standing.map(|standing| standing.place[0]),
        "y_m" if row.part.is_none() => return standing.map(|standing| standing.place[1]),
        "z_m" if row.part.is_none() => return standing.map(|standing| standing.place[2]),
        _ => {}
    }
    let (.., seen) = row.part?;
    let seen = seen?;
    let of = |vector: Option<[f64; 3]>, k: usize| vector.map(|vector| vector[k]);
    match column {
        "x_m" => of(seen.place, 0),
        "y_m" => of(seen.place, 1),
        "z_m" => of(seen.place, 2),
        "dir_x" => of(seen.direction, 0),
        "dir_y" => of(seen.direction, 1),
        "dir_z" => of(seen.direction, 2),
        "up_x" => of(seen.up, 0),
        "up_y" => of(seen.up, 1),
        "up_z" => of(seen.up, 2),
        "length_m" => seen.length,
        "diameter_m" => seen.base_diameter,
        "diameter_tip_m" => seen.tip_diameter,
        "area_m2" => seen.area,
        _ => None,
    }
}

fn word(column: &str, row: &Row<'_>) -> i8 {
    match (column, row.part) {
        ("kind", Some((part, ..))) => part.kind as i8,
        ("origin", Some((part, ..))) => part.origin as i8,
        _ => -1,
    }
}

fn name(column: &str, description: &Description, row: &Row<'_>) -> i32 {
    match column {
        "treatment" => 0,
        "species" => {
            let mut names: Vec<&str> =
                description.individuals.iter().filter_map(|one| one.species.as_deref()).collect();
            names.sort_unstable();
            names.dedup();
            let own = row.of.individual.species.as_deref();
            own.and_then(|own| names.iter().position(|name| *name == own)).map_or(-1, |place| place as i32)
        }
        _ => -1,
    }
}
