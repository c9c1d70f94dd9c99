//! Colours the plants of a picture by a column of `records`, with the values that the table holds, or by species.
//!
//! Words, booleans and orders are classes; any other value is an amount. A column in which no component has a value is
//! refused, with the reason. Absent: the colours themselves (`phytomer_pictures`).

use crate::tables::columns::RECORDS;
use crate::tables::schema::{Column, Type};
use crate::tables::{Membership, TableError, light_values, record_values};
use phytomer_pictures::{Colouring, Scale, Subject};
use phytomer_sim::site::light::Field;
use std::sync::Arc;

/// Why plants cannot be coloured by a column.
#[derive(Debug, thiserror::Error)]
pub enum ColouringError {
    /// `records` has no such column.
    #[error("`records` has no column `{column}` to colour by")]
    NoSuchColumn {
        /// The column.
        column: String,
    },
    /// No component that is drawn has a value in the column.
    #[error("no component has a value of `{column}` to colour by: {reason}")]
    NothingToColour {
        /// The column.
        column: &'static str,
        /// The reason why the column is empty, in words.
        reason: &'static str,
    },
    /// The values of the column could not be computed.
    #[error(transparent)]
    Table(#[from] TableError),
}

/// The species of each plant, which is a column of `plants`.
const SPECIES: &str = "species";

/// The share of light of leaves and buds, a column of `records` in runs that ask for it.
const LIGHT: &str = "light";

/// The names of the columns that plants can be coloured by.
pub fn colour_columns() -> impl Iterator<Item = &'static str> {
    RECORDS.iter().map(|column| column.name).chain([LIGHT, SPECIES])
}

/// The membership of the plants of a picture: plot, treatment and species, which the plants themselves do not hold.
#[derive(Debug, Clone, Copy)]
pub struct Belonging<'a> {
    /// The membership of each plant, in the order of the plants.
    pub members: &'a [Membership],
    /// The run's list of treatments.
    pub treatments: &'a [String],
    /// The names of the run's species.
    pub species: &'a [String],
    /// The light of the plot of each plant as it stands, in the order of the plants; `None` where it is not known.
    pub lights: &'a [Option<Arc<Field>>],
}

/// The values of a column of `records` for every component of some plants: one list per plant, one number per
/// component, NaN for null. A plant without an entry in `of` counts as the first plant of a plot of its own. Takes as
/// long as making the rows of `records` of these plants.
///
/// # Errors
/// [`ColouringError`], for an unknown column, a column without values, or a plant too large for a table.
pub fn colouring(column: &str, subjects: &[Subject], of: Belonging<'_>) -> Result<Colouring, ColouringError> {
    if column == SPECIES {
        return Ok(by_species(subjects, of));
    }
    if column == LIGHT {
        return by_light(subjects, of.lights);
    }
    let known = RECORDS.iter().find(|known| known.name == column);
    let column = known.ok_or_else(|| ColouringError::NoSuchColumn { column: column.to_owned() })?;
    let members = of.members.iter().copied().chain(std::iter::repeat(Membership::default()));
    let shown = subjects.iter().zip(members);
    let values = shown.map(|(subject, of)| record_values(of, subject.plant, subject.age, column));
    let values: Vec<Vec<f64>> = values.collect::<Result<_, _>>()?;
    let most = values.iter().flatten().copied().filter(|value| !value.is_nan()).fold(f64::NEG_INFINITY, f64::max);
    if most == f64::NEG_INFINITY {
        return Err(ColouringError::NothingToColour { column: column.name, reason: reason(column.name, subjects) });
    }
    Ok(Colouring { name: column.name.to_owned(), values, scale: scale(column, most as usize, of.treatments) })
}

/// Each component by the species of its plant.
fn by_species(subjects: &[Subject], of: Belonging<'_>) -> Colouring {
    let members = of.members.iter().map(|member| member.species as f64).chain(std::iter::repeat(0.0));
    let values = subjects.iter().zip(members);
    let values = values.map(|(subject, species)| vec![species; subject.plant.components() as usize]).collect();
    Colouring { name: SPECIES.to_owned(), values, scale: Scale::Classes { first: 0, names: of.species.to_vec() } }
}

/// Each leaf and apical bud by its share of the light of open ground.
fn by_light(subjects: &[Subject], lights: &[Option<Arc<Field>>]) -> Result<Colouring, ColouringError> {
    let lights = lights.iter().map(Option::as_deref).chain(std::iter::repeat(None));
    let values = subjects.iter().zip(lights).map(|(subject, light)| match light {
        Some(light) => light_values(subject.plant, subject.age, light),
        None => Ok(vec![f64::NAN; subject.plant.components() as usize]),
    });
    let values: Vec<Vec<f64>> = values.collect::<Result<_, _>>()?;
    if values.iter().flatten().all(|value| value.is_nan()) {
        let reason =
            "light is known of whole plots (--plot) of scenarios with `[light]`, and of leaves and apical buds";
        return Err(ColouringError::NothingToColour { column: LIGHT, reason });
    }
    Ok(Colouring { name: LIGHT.to_owned(), values, scale: Scale::Amounts })
}

/// The scale of a column: amounts, or classes with their names; `most` is the largest value.
fn scale(column: &Column, most: usize, treatments: &[String]) -> Scale {
    let classes = |names: Vec<String>| Scale::Classes { first: 0, names };
    match column.holds {
        Type::Word(words) => classes(words.iter().map(|word| word.replace('_', " ")).collect()),
        Type::Bool => classes(vec!["dead".to_owned(), "alive".to_owned()]),
        // Only treatments are names in `records`.
        Type::Name(_) => classes(treatments.to_vec()),
        Type::Int if column.name == "order" => {
            Scale::Classes { first: 1, names: (1..=most).map(|order| format!("order {order}")).collect() }
        }
        _ => Scale::Amounts,
    }
}

/// Why no component of some plants has a value in a column, from what stands at that age and from the wood of the
/// species.
fn reason(column: &str, subjects: &[Subject]) -> &'static str {
    let wood = || subjects.iter().filter_map(|subject| subject.plant.habit.wood.as_ref());
    let of_wood = ["fresh_mass_kg", "curvature_per_m", "bending_moment_N_m"].contains(&column);
    let of_bending = of_wood && column != "fresh_mass_kg";
    match column {
        _ if !any_value("component_id", subjects) => "nothing stands at that age",
        _ if of_wood && wood().next().is_none() => "the species states no `[wood]`",
        _ if of_bending && !wood().any(|wood| wood.bends) => {
            "the wood of the species does not bend (`bends = false` in its `[wood]`)"
        }
        "parent_id" => "everything that stands grows on the seed itself",
        "area_m2" if any_value("length_m", subjects) => "nothing that stands has an area, as leaves have",
        "fresh_mass_kg" if any_value("length_m", subjects) => "the `[wood]` of the species states no `density_kg_m3`",
        "length_m" | "diameter_m" | "area_m2" | "fresh_mass_kg" => "nothing but buds stands at that age",
        _ => "no internode stands at that age",
    }
}

/// Whether a component of some plants has a value in a column.
fn any_value(column: &str, subjects: &[Subject]) -> bool {
    let column = RECORDS.iter().find(|known| known.name == column);
    let values = |subject: &Subject| {
        column.and_then(|column| record_values(Membership::default(), subject.plant, subject.age, column).ok())
    };
    subjects.iter().filter_map(values).flatten().any(|value| !value.is_nan())
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_sim::Tick;
    use phytomer_sim::mechanics::{Tissue, Wood};
    use phytomer_sim::plant::{Habit, NewAxis, NewNode, Plant, Seed, Trend};
    use phytomer_sim::pose::pose;
    use std::sync::Arc;

    /// A plant without a membership.
    const ALONE: Belonging<'_> = Belonging { members: &[], treatments: &[], species: &[], lights: &[] };

    /// One upright internode.
    fn pole(length: f32, diameter: f32) -> Plant {
        let habit = Habit { trends: vec![Trend::STRAIGHT], ..Habit::default() };
        let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 9, keep_events: false };
        let mut plant = Plant::new(&seed, Arc::new(habit));
        plant.add_axis(NewAxis::OF_THE_SEED);
        plant.add_node(NewNode { length, diameter, ..NewNode::OF_THE_TRUNK });
        pose(&mut plant, 1);
        plant
    }

    #[test]
    fn words_and_orders_are_classes_and_lengths_are_amounts() {
        let plant = pole(1.0, 0.1);
        let of = |column: &str| {
            colouring(column, &[Subject { plant: &plant, age: 1, label: String::new() }], ALONE).expect("values")
        };
        // The bud and the internode below it.
        assert_eq!(of("order").scale, Scale::Classes { first: 1, names: vec!["order 1".to_owned()] });
        assert!(matches!(of("kind").scale, Scale::Classes { first: 0, names } if names[5] == "apical bud"));
        let length = of("length_m");
        assert_eq!(length.scale, Scale::Amounts);
        assert!(length.values[0].contains(&1.0) && length.values[0].iter().any(|value| value.is_nan()));
        let none = colouring("beauty", &[], ALONE);
        assert!(matches!(none, Err(ColouringError::NoSuchColumn { .. })));
    }

    /// Two plants of one plot and one plant of another; each is coloured by its own plot, tick and treatment.
    #[test]
    fn plants_are_coloured_by_the_plot_to_which_they_belong() {
        let plants = [3, 4, 5].map(|id| {
            let mut plant = pole(1.0, 0.1);
            plant.id = id;
            plant
        });
        let subjects = plants.each_ref().map(|plant| Subject { plant, age: 1, label: String::new() });
        let member = |plot, treatment, sown| Membership {
            plot,
            treatment,
            sown,
            species: treatment as usize,
            ..Membership::default()
        };
        let members = [member(1, 0, 0), member(1, 0, 7), member(2, 1, 0)];
        let treatments = ["control", "shade"].map(str::to_owned);
        let species = ["apple", "poplar"].map(str::to_owned);
        let of = Belonging { members: &members, treatments: &treatments, species: &species, lights: &[] };
        let values = |column: &str| {
            let found = colouring(column, &subjects, of).expect("values");
            assert!(found.values.iter().all(|plant| plant.iter().all(|value| *value == plant[0])));
            (found.values.iter().map(|plant| plant[0] as u32).collect::<Vec<_>>(), found.scale)
        };
        assert_eq!(values("plot_id"), (vec![1, 1, 2], Scale::Amounts));
        assert_eq!(values("plant_id").0, [3, 4, 5]);
        assert_eq!(values("tick").0, [1, 8, 1]);
        assert_eq!(values("age").0, [1, 1, 1]);
        assert_eq!(values("species"), (vec![0, 0, 1], Scale::Classes { first: 0, names: species.to_vec() }));
        assert_eq!(values("treatment"), (vec![0, 0, 1], Scale::Classes { first: 0, names: treatments.to_vec() }));
    }

    /// The message names what the plant lacks for this column, not for another column.
    #[test]
    fn nothing_to_colour_by_has_the_reason_of_its_column() {
        let reason = |plant: &Plant, age: Tick, column: &str| {
            let subject = Subject { plant, age, label: String::new() };
            colouring(column, &[subject], ALONE).expect_err("nothing to colour by").to_string()
        };
        let told = |plant: &Plant, age: Tick, column: &str, meant: &str| {
            let reason = reason(plant, age, column);
            assert_eq!(reason, format!("no component has a value of `{column}` to colour by: {meant}"));
        };
        let mut plant = pole(1.0, 0.1);
        told(&plant, 1, "area_m2", "nothing that stands has an area, as leaves have");
        told(&plant, 1, "parent_id", "everything that stands grows on the seed itself");
        for column in ["fresh_mass_kg", "curvature_per_m", "bending_moment_N_m"] {
            told(&plant, 1, column, "the species states no `[wood]`");
        }
        let wood = Wood { tissues: vec![Tissue::default()], ..Wood::default() };
        plant.habit = Arc::new(Habit { wood: Some(Wood { bends: false, ..wood }), ..(*plant.habit).clone() });
        told(&plant, 1, "fresh_mass_kg", "the `[wood]` of the species states no `density_kg_m3`");
        for column in ["curvature_per_m", "bending_moment_N_m"] {
            told(&plant, 1, column, "the wood of the species does not bend (`bends = false` in its `[wood]`)");
        }
        told(&plant, 0, "area_m2", "nothing but buds stands at that age");
        told(&plant, 0, "diameter_tip_m", "no internode stands at that age");
    }
}
