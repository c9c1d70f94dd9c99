//! The functions of a view file, as an L-system calls them: `func(1, x)` by number, `func(name, x)` by name.
//!
//! Absent: what else an L-system may call (`world`), and the graphs of the functions (`view`).

use crate::lsystem::view::Function;

/// The functions of a view file in their order, counted from 1.
#[derive(Debug, Clone, Default)]
pub(super) struct Curves(pub Vec<Function>);

/// The number of `func`.
const BY_NUMBER: u32 = 0;

impl Curves {
    /// The number of a function.
    pub fn function(&self, name: &str, arguments: usize) -> Option<u32> {
        (name == "func" && arguments == 2).then_some(BY_NUMBER)
    }

    /// The number of a curve by its name.
    pub fn curve(&self, name: &str) -> Option<f64> {
        let place = self.0.iter().position(|function| function.name == name)?;
        Some(place as f64 + 1.0)
    }

    /// The value of `func` for the number of a curve and x.
    pub fn call(&self, arguments: &[f64]) -> Result<f64, (String, String)> {
        let [number, x, ..] = *arguments else { return Ok(0.0) };
        let most = self.0.len();
        let place = if number >= 1.0 && number < most as f64 + 1.0 { number as usize - 1 } else { most };
        let problem = || match most {
            0 => ("the view file states no function".to_owned(), "a view file with a line `function:`".to_owned()),
            _ => (format!("there is no function {number}"), format!("a function from 1 to {most} of the view file")),
        };
        self.0.get(place).map(|function| function.at(x)).ok_or_else(problem)
    }

    /// The names of all functions and curves.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let own = self.0.iter().map(|function| function.name.clone()).filter(|name| !name.is_empty());
        ["func".to_owned()].into_iter().chain(own)
    }
}
