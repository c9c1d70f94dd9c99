//! SQL over the tables of runs: views with the names of the tables, and macros such as `at_age(a)`.
//!
//! Each body is SQL that DuckDB and DataFusion both read: no `GROUP BY ALL`, no `**`, columns grouped and sorted by
//! name. DuckDB takes the bodies from `views.sql` as views and macros, `phytomer query` takes them as views and table
//! functions. Every view with the column `order`, a reserved word of SQL, has `axis_order` too; where species state the
//! ticks of a year, ages are told in years and days beside ticks. Absent: the engines, and which tables a run folder
//! has (`views_of_run`).

mod macros;

use crate::tables::columns::SITE;
use crate::tables::{Provenance, RunPlan, Table};
use macros::{MACROS, MECHANICS, WORLD};
use phytomer_sim::site::date::DAYS_OF_A_YEAR;

/// The columns of ages in ticks, each with the names of those in years and in days.
const AGES: [[&str; 3]; 3] = [
    ["age", "age_years", "age_days"],
    ["birth_age", "birth_years", "birth_days"],
    ["death_age", "death_years", "death_days"],
];

/// The year of the species of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Year {
    /// No species states the ticks of a year.
    NotStated,
    /// All state the same number of ticks.
    Of(f64),
    /// They differ: `plants` has the ticks of each plant.
    BySpecies,
}

impl Year {
    /// That of species by the ticks of their years.
    pub fn of(ticks: &[Option<f64>]) -> Self {
        match ticks.first() {
            None => Self::NotStated,
            Some(first) if ticks.iter().any(|ticks| ticks != first) => Self::BySpecies,
            Some(first) => first.map_or(Self::NotStated, Self::Of),
        }
    }
}

/// The tables of one run, as the bodies of views name them.
#[derive(Debug, Clone)]
pub struct Tables {
    /// The value of the column `run`; `None` leaves the column out, which only views of one run can.
    pub run: Option<String>,
    /// Each table of the run with what stands for it after `FROM`.
    pub sources: Vec<(Table, String)>,
    /// Whether `records` has the columns of mechanics.
    pub mechanics: bool,
    /// The year of its species.
    pub year: Year,
}

impl Tables {
    /// Those of a plan, by paths from the run folder, without a column `run`.
    pub fn of_plan(plan: &RunPlan) -> Self {
        let source = |table: &Table| (*table, format!("read_parquet('{}/part-*.parquet')", table.name()));
        let Provenance { ticks_per_year, .. } = &plan.provenance;
        Self {
            run: None,
            sources: plan.tables.iter().map(source).collect(),
            mechanics: plan.mechanics,
            year: Year::of(ticks_per_year),
        }
    }

    fn source(&self, table: Table) -> Option<&str> {
        self.sources.iter().find(|(known, _)| *known == table).map(|(_, source)| source.as_str())
    }

    /// The rows of a table of the run, with what views add.
    fn select(&self, table: Table) -> Option<String> {
        let run = self.run.as_ref().map(|run| format!("{} AS run, ", quoted(run))).unwrap_or_default();
        let columns = table.columns(false);
        let has = |name: &str| columns.iter().any(|column| column.name == name);
        let plants = self.source(Table::Plants);
        let ticks = match self.year {
            Year::Of(ticks) => Some(real(ticks)),
            Year::BySpecies => plants.map(|_| "y.ticks_per_year".to_owned()),
            Year::NotStated => None,
        };
        let mut joined = String::new();
        let mut added = if has("order") { ", t.\"order\" AS axis_order".to_owned() } else { String::new() };
        for [age, years, days] in AGES {
            // `records` and `summary` tell other ages only beside that of the row.
            if !has(age) || age != "age" && table != Table::Components {
                continue;
            }
            added += &match &ticks {
                Some(ticks) => format!(
                    ", CAST(t.{age} AS DOUBLE) / {ticks} AS {years}, CAST(t.{age} AS DOUBLE) * {} / {ticks} AS {days}",
                    real(DAYS_OF_A_YEAR)
                ),
                None => format!(", CAST(NULL AS DOUBLE) AS {years}, CAST(NULL AS DOUBLE) AS {days}"),
            };
            if let (Year::BySpecies, Some(plants)) = (self.year, plants) {
                joined = format!(" LEFT JOIN {plants} y ON y.plot_id = t.plot_id AND y.plant_id = t.plant_id");
            }
        }
        Some(format!("SELECT {run}t.*{added} FROM {} t{joined}", self.source(table)?))
    }
}

/// A view, or a macro with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Relation {
    /// Its name.
    pub name: &'static str,
    /// The names of its parameters; `None` for a view.
    pub parameters: Option<&'static [&'static str]>,
    /// One line about it.
    pub comment: &'static str,
    /// Its SQL, with the name of each parameter in braces.
    body: String,
}

impl Relation {
    /// The SQL with something in the place of each parameter, by its number from 0.
    pub fn body(&self, argument: impl Fn(usize, &str) -> String) -> String {
        let parameters = self.parameters.unwrap_or_default().iter().enumerate();
        parameters
            .fold(self.body.clone(), |body, (place, name)| body.replace(&format!("{{{name}}}"), &argument(place, name)))
    }

    /// The statement that makes it in DuckDB.
    pub fn for_duckdb(&self) -> String {
        let (name, body) = (self.name, self.body(|_, name| name.to_owned()));
        match self.parameters {
            None => format!("CREATE OR REPLACE VIEW {name} AS {body};"),
            Some(parameters) => {
                format!("CREATE OR REPLACE MACRO {name}({}) AS TABLE {body};", parameters.join(", "))
            }
        }
    }
}

/// The views and macros over the tables of runs, each after those that it names. Where there are several runs, each has
/// a name in its [`Tables::run`].
pub fn relations(runs: &[Tables]) -> Vec<Relation> {
    let has = |table: &Table| runs.iter().any(|run| run.source(*table).is_some());
    let of_table = |table: Table| {
        let body = runs.iter().filter_map(|run| run.select(table)).collect::<Vec<_>>().join(" UNION ALL BY NAME ");
        Relation { name: table.name(), parameters: None, comment: table.description(), body }
    };
    let mut made: Vec<Relation> = Table::ALL.into_iter().filter(has).map(of_table).collect();
    let located = has(&Table::Records) && has(&Table::Plants);
    let records = if located { "records_world" } else { "records" };
    let run = if runs.iter().any(|run| run.run.is_some()) { "run, " } else { "" };
    let pressures = mean_pressures();
    let filled =
        |body: &str| body.replace("{records}", records).replace("{run}", run).replace("{pressures}", &pressures);
    let wanted = MACROS.iter().filter(|of| of.tables.iter().all(has));
    let world = located.then_some(&WORLD);
    let mechanics = (has(&Table::Records) && runs.iter().any(|run| run.mechanics)).then_some(&MECHANICS);
    made.extend(world.into_iter().chain(wanted).chain(mechanics).map(|of| Relation {
        name: of.name,
        parameters: of.parameters,
        comment: of.comment,
        body: filled(of.body),
    }));
    made
}

/// The text that makes the views and macros in DuckDB, below a line about where it can be read.
pub fn for_duckdb(about: &str, runs: &[Tables]) -> String {
    let mut sql = format!("-- For DuckDB. {about}\n");
    for relation in relations(runs) {
        sql += &format!("\n-- {}\n{}\n", relation.comment, relation.for_duckdb());
    }
    sql
}

/// A text as SQL states it.
pub fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}

/// A number as both engines read it as one of double precision: bare, DuckDB would take it as a decimal.
fn real(number: f64) -> String {
    format!("CAST({number:?} AS DOUBLE)")
}

/// The means of the pressures of pests over the rows of several parts, each row with the weight of its living plants.
fn mean_pressures() -> String {
    let pressures = SITE.iter().map(|column| column.name).filter(|name| name.starts_with("pest_pressure"));
    let mean = |name: &str| {
        let living = format!("sum(living_plants) FILTER (WHERE {name} IS NOT NULL)");
        format!("sum({name} * living_plants) / nullif({living}, 0) AS {name}")
    };
    pressures.map(mean).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_year_is_that_of_all_species_or_is_looked_up() {
        assert_eq!(Year::of(&[]), Year::NotStated);
        assert_eq!(Year::of(&[None, None]), Year::NotStated);
        assert_eq!(Year::of(&[Some(12.0), Some(12.0)]), Year::Of(12.0));
        assert_eq!(Year::of(&[Some(12.0), None]), Year::BySpecies);
        assert_eq!(Year::of(&[Some(1.0), Some(4.0)]), Year::BySpecies);
    }

    #[test]
    fn bodies_are_read_by_both_engines_as_far_as_words_tell() {
        let all = |name: &str| Tables {
            run: Some(name.to_owned()),
            sources: Table::ALL.map(|table| (table, table.name().to_owned())).to_vec(),
            mechanics: true,
            year: Year::BySpecies,
        };
        for relation in relations(&[all("a"), all("b")]) {
            let body = relation.body(|place, _| format!("${}", place + 1));
            for foreign in ["GROUP BY ALL", "ORDER BY ALL", "**", "{", "}"] {
                assert!(!body.contains(foreign), "{}: `{foreign}` in {body}", relation.name);
            }
        }
    }

    #[test]
    fn texts_are_quoted() {
        assert_eq!(quoted("O'Hara"), "'O''Hara'");
    }
}
