//! What a format could not hold, told once for each kind of thing with its number.

use std::fmt;

/// One kind of thing that the written file does not have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loss {
    /// What is lost, such as `ages of birth and death`.
    pub what: String,
    /// Of how many entities, or of whatever `what` counts.
    pub count: u64,
    /// What stands there instead, or why the format has no place for it; empty where there is nothing to say.
    pub instead: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "lost: {} ({})", self.what, self.count)?;
        if self.instead.is_empty() { Ok(()) } else { write!(f, ": {}", self.instead) }
    }
}

/// All that a format could not hold, in the order in which it was found.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Losses {
    told: Vec<Loss>,
}

impl Losses {
    /// Adds to what is lost of a kind; nothing where `count` is 0.
    pub fn add(&mut self, what: &str, count: u64, instead: &str) {
        if count == 0 {
            return;
        }
        match self.told.iter_mut().find(|loss| loss.what == what) {
            Some(loss) => loss.count += count,
            None => self.told.push(Loss { what: what.to_owned(), count, instead: instead.to_owned() }),
        }
    }

    /// Every kind, each once.
    pub fn told(&self) -> &[Loss] {
        &self.told
    }
}
