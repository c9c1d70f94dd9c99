//! A page of measured plants: what was measured at each age, and the rows of `records` as they stand in the table.
//!
//! Between two ages the page goes in a straight line, as it does for plants that grow: nobody measured what was there.
//! Absent: plants that grow (`viewing`).

use super::drawing::options_of;
use super::viewing::{Look, OF_A_RADIUS, ROOM, SIDES, reach_of, tolerance_of};
use phytomer_outputs::life::{Maker, Nearness};
use phytomer_outputs::measured::MeasuredPlants;
use phytomer_outputs::meshes::MeshOptions;
use phytomer_outputs::pages::{OF_A_LIFE, Page, Subject, Table};
use phytomer_outputs::paging::Rows;
use phytomer_sim::Tick;
use std::collections::BTreeMap;
use std::sync::Arc;

/// What a page of measured plants shows.
#[derive(Debug, Clone)]
pub struct MeasuredView<'a> {
    /// The plants.
    pub plants: &'a MeasuredPlants,
    /// The name of the run.
    pub name: String,
    /// Those that are shown, by their numbers.
    pub numbers: Vec<u32>,
    /// Whether they stand in the places of their plot, else side by side.
    pub in_places: bool,
    /// The ages, ascending, with what is said of each.
    pub ages: Vec<(Tick, String)>,
    /// How near the page is to the plants, metres; half a pixel of a screen if not given.
    pub tolerance: Option<f32>,
    /// How finely organs are drawn at most.
    pub detail: u8,
}

/// A plant while its life is shown.
struct Shown {
    maker: Maker,
    table: Table,
    reach: f32,
}

impl MeasuredView<'_> {
    /// Makes the page.
    pub fn page(&self) -> Page {
        let options = options_of(SIDES, &Arc::default());
        let look = self.look(&options);
        let tolerance = self.tolerance.unwrap_or_else(|| tolerance_of(look.reach()));
        let options = MeshOptions { detail: look.detail(self.detail), ..options };
        let rows = Rows::new(false);
        let nearness = Nearness { share: OF_A_RADIUS, ..Nearness::of(tolerance * OF_A_LIFE) };
        let begin = |rows: &Rows| Shown {
            maker: Maker::new(nearness, &options),
            table: Table::new(rows.columns()),
            reach: 0.0,
        };
        let mut shown: BTreeMap<u32, Shown> = self.numbers.iter().map(|number| (*number, begin(&rows))).collect();
        for (age, _) in &self.ages {
            let told: BTreeMap<u32, _> = self.plants.rows(*age).collect();
            for (number, plant) in &self.plants.at(*age) {
                let Some(of) = shown.get_mut(number) else { continue };
                of.maker.show(plant, *age);
                of.reach = of.reach.max(reach_of(plant, *age));
                let told = told.get(number).copied().unwrap_or_default();
                rows.show_told(&mut of.table, plant, told.iter().map(|row| (row.number, &*row.values)), *age as f32);
            }
        }
        self.bound(shown, &rows, tolerance, &options)
    }

    /// How large the plants are at most at these ages, and how many triangles all together have.
    fn look(&self, options: &MeshOptions) -> Look {
        let at = |age: Tick| {
            let mut look = Look::default();
            let plants = self.plants.at(age);
            let shown = plants.iter().filter(|(number, _)| self.numbers.contains(number));
            shown.for_each(|(_, plant)| look.add((plant, age), options, self.detail));
            look
        };
        self.ages.iter().map(|(age, _)| at(*age)).fold(Look::default(), Look::most)
    }

    fn bound(&self, shown: BTreeMap<u32, Shown>, rows: &Rows, tolerance: f32, options: &MeshOptions) -> Page {
        let mut subjects: Vec<Subject> = Vec::new();
        // A page shares forms between subjects of one species; all of these have those of the library.
        for (number, Shown { maker, table, reach }) in shown {
            let place = match subjects.last().filter(|_| !self.in_places) {
                Some(before) => [before.place[0] + f64::from((before.reach + reach) * 0.5 * (1.0 + ROOM)), 0.0, 0.0],
                None if self.in_places => self.plants.place(number),
                None => [0.0; 3],
            };
            let of_species = self.plants.species(number).map(|species| format!(", {species}")).unwrap_or_default();
            subjects.push(Subject {
                number,
                species: 0,
                name: format!("plant {number}{of_species}"),
                place,
                sown: 0.0,
                constants: vec![("treatment", "measured".into()), ("plot_id", 0.into()), ("plant_id", number.into())],
                reach,
                life: maker.finish(),
                table,
                options: options.clone(),
            });
        }
        let mut species: Vec<&str> = self.numbers.iter().filter_map(|number| self.plants.species(*number)).collect();
        species.sort_unstable();
        species.dedup();
        let numbers: Vec<String> = self.numbers.iter().map(u32::to_string).collect();
        Page {
            title: if species.is_empty() { self.name.clone() } else { species.join(", ") },
            note: format!(
                "{} {} of {} as measured",
                if numbers.len() == 1 { "plant" } else { "plants" },
                numbers.join(", "),
                self.name
            ),
            run: self.name.clone(),
            seed: 0,
            tolerance,
            detail: options.detail,
            of_plot: self.in_places,
            ages: self.ages.iter().map(|(age, told)| (*age as f32, told.clone())).collect(),
            events: Vec::new(),
            columns: rows.columns().to_vec(),
            subjects,
            obstacles: Vec::new(),
        }
    }
}
