//! A share of a run: every n-th of its part files, grown into a folder of its own (`--shard 3/16`) and merged later.
//!
//! Share k of n has the parts k − 1, k − 1 + n, k − 1 + 2n …, so that each share has parts of the whole run: shares
//! take about the same time where plots differ from the first to the last, and a finished share is a picture of the
//! whole. Which parts those are depends on the scenario and the two numbers alone. Absent: merging (`merge`).

use serde::Serialize;
use serde_json::Value;
use std::fmt;
use std::str::FromStr;

/// The key of `run.json` that names the share.
pub const SHARE: &str = "shard";

/// The most shares of a run: more than any cluster has places for.
const MOST: u32 = 100_000;

/// One of so many shares of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Share {
    of: u32,
    number: u32,
}

impl Share {
    /// Share `number`, from 1, of `of`; `None` where there is no such share.
    pub fn new(number: u32, of: u32) -> Option<Self> {
        ((1..=of).contains(&number) && of <= MOST).then_some(Self { of, number })
    }

    /// Its number, from 1.
    pub fn number(self) -> u32 {
        self.number
    }

    /// The number of shares of the run.
    pub fn of(self) -> u32 {
        self.of
    }

    /// Whether it has a part.
    pub fn has(self, part: u32) -> bool {
        part % self.of == self.number - 1
    }

    /// The share that a `run.json` names; `None` of a whole run.
    pub fn of_run(run: &Value) -> Option<Self> {
        run[SHARE].as_str()?.parse().ok()
    }

    /// The parts of a run of so many that a share has, ascending; without a share all of them.
    pub fn parts(share: Option<Self>, parts: u32) -> impl Iterator<Item = u32> {
        (0..parts).filter(move |part| share.is_none_or(|share| share.has(*part)))
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl Serialize for Share {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl FromStr for Share {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse::<u32>().ok();
        let pair = text.split_once('/').and_then(|(number_of, of)| Some((number(number_of)?, number(of)?)));
        pair.and_then(|(number, of)| Self::new(number, of)).ok_or_else(|| {
            format!(
                "a shard and the number of all shards are expected, such as 3/16: from 1/16 to 16/16, at most {MOST}"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_part_is_in_one_share() {
        for (of, parts) in [(1, 5), (2, 5), (5, 5), (3, 16), (16, 500)] {
            let shares: Vec<Share> = (1..=of).map(|number| Share::new(number, of).unwrap()).collect();
            for part in 0..parts {
                assert_eq!(shares.iter().filter(|share| share.has(part)).count(), 1, "part {part} of {parts}");
            }
            let sizes: Vec<usize> = shares.iter().map(|share| Share::parts(Some(*share), parts).count()).collect();
            assert!(sizes.iter().max().unwrap() - sizes.iter().min().unwrap() <= 1, "{sizes:?}");
        }
        assert_eq!(Share::parts(Share::new(2, 3), 8).collect::<Vec<_>>(), [1, 4, 7]);
        assert_eq!(Share::parts(None, 3).collect::<Vec<_>>(), [0, 1, 2]);
    }

    #[test]
    fn shares_are_read_as_they_are_told() {
        let share: Share = "3/16".parse().unwrap();
        assert_eq!((share.number(), share.of(), share.to_string().as_str()), (3, 16, "3/16"));
        assert_eq!(Share::of_run(&serde_json::json!({ SHARE: share })), Some(share));
        for bad in ["0/16", "17/16", "3", "3/", "/16", "a/b", "1/0", "-1/4", "1/100001", ""] {
            assert!(bad.parse::<Share>().unwrap_err().contains("such as 3/16"), "{bad}");
        }
    }
}
