//! What a program asks of the world around it: functions that the file calls and does not state.
//!
//! Curves (`func`, `curveX`) and forms (`prune`, `inside_NAME`, `field_NAME`) stand outside this crate.

use std::fmt::Debug;

/// Functions that a file may call and does not define.
pub trait Outside: Debug + Send + Sync {
    /// The number under which the function `name` is called with so many arguments; `None` where there is none.
    /// `func(n, x)`, `curveX(n, s)`, `curveY`, `curveZ` and `curveGAL(n)` are asked for by these names.
    fn function(&self, name: &str, arguments: usize) -> Option<u32>;

    /// The number of a curve that a file names instead of numbering it: `func(elasticity, x)`.
    fn curve(&self, name: &str) -> Option<f64>;

    /// The value of a function.
    ///
    /// # Errors
    /// What is wrong with the arguments, and what would be right.
    fn call(&self, function: u32, arguments: &[f64]) -> Result<f64, (String, String)>;

    /// How much work a function is, where 1 is that of a formula: a step has a bound of what its calls cost.
    fn parts(&self, _function: u32) -> u64 {
        1
    }

    /// What would be right where a file calls the function `name` and there is none of so many arguments; `None` where
    /// nothing more is known of the name.
    fn missing(&self, _name: &str) -> Option<String> {
        None
    }

    /// The names of all functions, for the nearest spelling in a fault.
    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// A world without functions.
#[derive(Debug, Clone, Copy, Default)]
pub struct Nothing;

impl Outside for Nothing {
    fn function(&self, _name: &str, _arguments: usize) -> Option<u32> {
        None
    }

    fn curve(&self, _name: &str) -> Option<f64> {
        None
    }

    fn call(&self, _function: u32, _arguments: &[f64]) -> Result<f64, (String, String)> {
        Ok(0.0)
    }
}
