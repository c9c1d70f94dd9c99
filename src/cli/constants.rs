//! The option `-D`: constants of an L-system that the command line states.
//!
//! They take the place of the `#define` of their names, or stand for names that the file leaves open, so that a file
//! that is wrong alone is sound with them. Absent: what a scenario states (`[define]`).

use super::Misuse;
use super::named::Named;
use clap::Args;
use phytomer_models::law::Variate;
use phytomer_models::parameters::Surroundings;

/// What is told of constants beside a scenario.
pub const OF_A_SCENARIO: &str = "-D is for an L-system by itself; a scenario states its constants in [define]";

/// Constants of an L-system.
#[derive(Debug, Clone, Default, Args)]
pub struct Constants {
    /// Set a constant of the L-system, in place of its `#define`, or one that its file leaves open.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = constant)]
    define: Vec<(String, f64)>,
}

impl Constants {
    /// Whether none is set.
    pub fn is_empty(&self) -> bool {
        self.define.is_empty()
    }

    /// Refuses them for all but an L-system by itself.
    ///
    /// # Errors
    /// Where else constants stand.
    pub fn check(&self, name: &str, found: &Named) -> Result<(), Misuse> {
        let problem = match found {
            _ if self.is_empty() => return Ok(()),
            Named::Species(found) if found.species.reads_surroundings() => return Ok(()),
            Named::Species(_) => format!("-D: `{name}` has no L-system in a file of its own"),
            Named::Scenario(_) => OF_A_SCENARIO.to_owned(),
            Named::Run(_) => format!("-D: `{name}` is a run, which keeps the constants that it was grown with"),
        };
        Err(Misuse(problem))
    }

    /// The names and the numbers.
    pub fn pairs(&self) -> &[(String, f64)] {
        &self.define
    }

    /// What they are to a species.
    pub fn surroundings(&self) -> Surroundings {
        let constants = self.define.iter().map(|(name, value)| (name.clone(), Variate::from(*value)));
        Surroundings { constants: constants.collect(), ..Surroundings::default() }
    }

    /// The words that set them again.
    pub fn words(&self) -> impl Iterator<Item = String> {
        self.define.iter().flat_map(|(name, value)| ["-D".to_owned(), format!("{name}={value}")])
    }
}

/// Reads `NAME=VALUE`.
fn constant(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("a constant is stated as NAME=VALUE, such as -D ANGLE=25")?;
    let number = value.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let number = number.ok_or_else(|| format!("`{value}` is no number"))?;
    Ok((name.trim().to_owned(), number))
}
