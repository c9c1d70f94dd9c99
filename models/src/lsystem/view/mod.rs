//! The files that lie beside an L-system and say how its strings are drawn: view files (`.v`), surfaces (`.s`),
//! functions (`.func`, `.fset`), colours (`.map`, `.mat`), as the interpreter cpfg has them.
//!
//! Each is read from its text or its bytes, which are bounded; what is wrong is told with its line and column. Absent:
//! the texts' files (`config`), and the turtle that draws by them.

mod colours;
mod contour;
mod function;
mod settings;
mod surface;
#[cfg(test)]
mod tests;
mod text;

pub use colours::Colours;
pub use contour::Contour;
pub use function::Function;
pub use settings::{LineStyle, NamedSurface, SkippedLine, Tropism, View};
pub use surface::{Patch, Surface};
pub use text::{MOST_BYTES, TextFault};
