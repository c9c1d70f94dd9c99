//! What the text of an L-system may call and does not state: functions of its view file, and shapes.
//!
//! Absent: the functions themselves (`curves`), and the shapes (`shapes`).

use super::curves::Curves;
use super::shapes::ShapeFunctions;
use phytomer_rewriting::Outside;

/// The functions around a text.
#[derive(Debug, Clone, Default)]
pub(super) struct World {
    pub curves: Curves,
    pub shapes: ShapeFunctions,
}

/// The functions of view files have numbers below this, those of shapes from this on.
const FIRST_SHAPE: u32 = 1;

impl Outside for World {
    fn function(&self, name: &str, arguments: usize) -> Option<u32> {
        self.curves.function(name, arguments).or_else(|| Some(self.shapes.function(name, arguments)? + FIRST_SHAPE))
    }

    fn curve(&self, name: &str) -> Option<f64> {
        self.curves.curve(name)
    }

    fn call(&self, function: u32, arguments: &[f64]) -> Result<f64, (String, String)> {
        match function.checked_sub(FIRST_SHAPE) {
            Some(form) => Ok(self.shapes.call(form, arguments)),
            None => self.curves.call(arguments),
        }
    }

    fn parts(&self, function: u32) -> u64 {
        function.checked_sub(FIRST_SHAPE).map_or(1, |form| self.shapes.parts(form) as u64)
    }

    fn names(&self) -> Vec<String> {
        self.curves.names().chain(self.shapes.names()).collect()
    }

    fn missing(&self, name: &str) -> Option<String> {
        self.shapes.missing(name)
    }
}
