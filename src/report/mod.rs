//! A report of runs, as one page: how plants grew, which lived, how treatments differ, how they branch, how
//! the run stands to what was measured, and where it all comes from.
//!
//! Plants are the unit: bands and intervals are Student's, of plant values, at 95 %. Absent: how a page looks
//! (`phytomer_reports`), and the statistics (`phytomer_measures`).

mod architecture;
mod comparison;
mod contrasts;
mod fates;
pub mod field;
mod growth;
pub mod laws;
mod plants;
mod provenance;

use field::Field;
use laws::Asked;
use phytomer_config::{Species, Trial};
use phytomer_outputs::Error;
use phytomer_outputs::read::Run;
use phytomer_reports::{Part, Picture, Report, Section};
use plants::Grown;

/// The level of all intervals.
const LEVEL: f64 = 0.95;

/// A run that is reported.
pub struct Reported<'a> {
    /// Its name in legends.
    pub name: String,
    /// The run folder.
    pub run: &'a Run,
    /// Its treatments and plots; `None` where its plants were measured.
    pub trial: Option<&'a Trial>,
    /// Its species; none where its plants were measured.
    pub species: Vec<&'a Species>,
}

/// The report of some runs, beside measured plants and distributions where there are some, with pictures of plants.
///
/// # Errors
/// Where a table cannot be read.
pub fn report(
    title: &str,
    runs: &[Reported],
    (field, asked): (Option<&Field>, &Asked),
    pictures: Vec<Picture>,
) -> Result<Report, Error> {
    let grown = Grown::read(runs)?;
    let mut sections = vec![
        section("Methods", vec![Part::Text(provenance::methods(runs, &grown))]),
        section("Growth", growth::parts(&grown, field)),
    ];
    // Whoever measures plants does not tell when those died that are not in the file.
    let some_grow = runs.iter().any(|reported| reported.trial.is_some());
    sections.extend(some_grow.then(|| section("Life and death", fates::parts(&grown))));
    sections.extend([
        section("Architecture", architecture::parts(runs)),
        section("Distributions", laws::parts(runs, asked)),
    ]);
    let compared = contrasts::parts(&grown);
    sections.extend((!compared.is_empty()).then(|| section("Treatments", compared)));
    sections.extend(field.map(|field| section("Measured plants", comparison::parts(&grown, field))));
    let shown = pictures.into_iter().map(Part::Picture).collect::<Vec<_>>();
    sections.extend((!shown.is_empty()).then(|| section("Plants", shown)));
    sections.push(section("Provenance", provenance::parts(runs)));
    Ok(Report { title: title.to_owned(), about: provenance::about(runs, &grown), sections })
}

fn section(heading: &str, parts: Vec<Part>) -> Section {
    Section { heading: heading.to_owned(), parts }
}

/// "95 %".
fn percent(level: f64) -> String {
    format!("{} %", (100.0 * level).round())
}
