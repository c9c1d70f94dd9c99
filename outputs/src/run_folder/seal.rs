//! Checksums inside JSON: a line of the journal and `run.json` end with a `check` of all text before it.
//!
//! The check is the first sixteen hexadecimal digits of the SHA-256 of the text, so any changed byte is found, also
//! between the values. It detects damage, not forgery.

use crate::storage::durable::sha256_of;

/// The number of digits of a check.
const DIGITS: usize = 16;

/// The text of a check before the end of a JSON object.
#[derive(Debug, Clone, Copy)]
pub struct Seal {
    /// The end of the object without a check.
    end: &'static str,
    /// The text between the object and the digits.
    before: &'static str,
    /// The text after the digits.
    after: &'static str,
}

/// The check of an object on one line.
pub const LINE: Seal = Seal { end: "}", before: ",\"check\":\"", after: "\"}\n" };

/// The check of an object on many lines.
pub const DOCUMENT: Seal = Seal { end: "\n}", before: ",\n  \"check\": \"", after: "\"\n}\n" };

impl Seal {
    /// The text of an object, with its check added.
    pub fn put(self, mut object: Vec<u8>) -> Vec<u8> {
        if object.ends_with(self.end.as_bytes()) {
            object.truncate(object.len() - self.end.len());
        }
        let check = check_of(&object);
        [&object, self.before.as_bytes(), check.as_bytes(), self.after.as_bytes()].concat()
    }

    /// Whether the text is exactly as [`Seal::put`] returned it.
    pub fn holds(self, text: &[u8]) -> bool {
        let content = text.strip_suffix(self.after.as_bytes()).and_then(|rest| {
            let (rest, digits) = rest.split_at_checked(rest.len().checked_sub(DIGITS)?)?;
            Some((rest.strip_suffix(self.before.as_bytes())?, digits))
        });
        content.is_some_and(|(content, digits)| check_of(content).as_bytes() == digits)
    }
}

/// The digits of the check of some bytes.
pub fn check_of(bytes: &[u8]) -> String {
    let mut check = sha256_of(bytes);
    check.truncate(DIGITS);
    check
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_changed_byte_and_every_cut_is_found() {
        let value = serde_json::json!({"shard": 7, "files": [{"path": "a"}]});
        for (seal, text) in [(LINE, serde_json::to_vec(&value)), (DOCUMENT, serde_json::to_vec_pretty(&value))] {
            let whole = seal.put(text.unwrap());
            assert!(seal.holds(&whole));
            assert_eq!(serde_json::from_slice::<serde_json::Value>(&whole).unwrap()["shard"], 7);
            for at in 0..whole.len() {
                assert!(!seal.holds(&whole[..at]));
                for bit in 0..8 {
                    let mut damaged = whole.clone();
                    damaged[at] ^= 1 << bit;
                    assert!(!seal.holds(&damaged), "byte {at}, bit {bit}");
                }
            }
        }
    }
}
