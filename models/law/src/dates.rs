//! What a law can know of the date: a variable that the scenario does not tell is a fault that says what to add to it.
//!
//! The calendar of a plot says for each of its ticks the date, and as far as the scenario states them the degree-days,
//! the day length and the nitrogen. All are functions of the tick, so a law that names them is one of the plant's age:
//! it draws the same words at the same speed. Absent: the calendar itself (`phytomer_sim::site::calendar`).

use super::domain::Domain;
use super::variable::Variable;
use crate::fault::{Fault, Path};

/// The fault of a law that names a variable of the date which is not known in this domain.
pub(super) fn fault_of(variable: Variable, domain: &Domain, path: &Path) -> Option<Fault> {
    if domain.on_date(variable, 1).is_some() {
        return None;
    }
    let name = variable.name();
    let (problem, lacking) = match &domain.dates {
        None => (
            format!("the law depends on {name}, which is known only in a scenario with a calendar"),
            "`planting_date` and `[calendar]`",
        ),
        Some(_) => (format!("the law depends on {name}, which the scenario does not tell"), ""),
    };
    let lacking: Vec<&str> = [lacking, teller(variable)].into_iter().filter(|keys| !keys.is_empty()).collect();
    Some(Fault::new(path, problem, format!("{} in the scenario, or a law without {name}", lacking.join(" with "))))
}

/// The keys of a scenario that tell a variable, beside those of its calendar.
fn teller(variable: Variable) -> &'static str {
    match variable {
        Variable::Nitrogen => "`[soil]`",
        Variable::DegreeDays | Variable::DegreeDaysPerDay => "`[weather]` and `calendar.degree_days`",
        Variable::DayLengthH => "`site.latitude_deg`, or a weather file that states its latitude",
        _ => "",
    }
}
