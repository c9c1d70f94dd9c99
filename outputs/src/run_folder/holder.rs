//! The process that fills a run folder, as its lock file names it: number, machine and start.
//!
//! The name is information for people. Whether a process fills the folder is decided by the lock alone (`lock`).

use serde::{Deserialize, Serialize};
use std::fmt;
use std::fs::File;
use std::io::Read;
use std::time::{SystemTime, UNIX_EPOCH};

/// The most bytes of a lock file that are read.
const MOST_BYTES: u64 = 4096;

/// A process that fills a run folder; an unknown property is `None`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Holder {
    /// The process number.
    pub process: Option<u32>,
    /// The name of the machine that it runs on.
    pub host: Option<String>,
    /// The date and time of its start, in UTC.
    pub started: Option<String>,
}

impl Holder {
    /// This process, with the present time as its start.
    pub fn this_process() -> Self {
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Self { process: Some(std::process::id()), host: host(), started: Some(in_utc(now.as_secs())) }
    }

    /// The process that a lock file names. On Windows only that process can read the file.
    pub fn named_in(file: &File) -> Self {
        let mut text = Vec::new();
        let read = file.take(MOST_BYTES).read_to_end(&mut text);
        read.ok().and_then(|_| serde_json::from_slice(&text).ok()).unwrap_or_default()
    }
}

impl fmt::Display for Holder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.process {
            Some(process) => write!(f, "process {process}")?,
            None => write!(f, "another process")?,
        }
        self.host.iter().try_for_each(|host| write!(f, " on {host}"))?;
        self.started.iter().try_for_each(|started| write!(f, ", started {started}"))
    }
}

#[cfg(unix)]
fn host() -> Option<String> {
    Some(rustix::system::uname().nodename().to_string_lossy().into_owned())
}

#[cfg(not(unix))]
fn host() -> Option<String> {
    std::env::var("COMPUTERNAME").ok()
}

/// A number of seconds since 1970 as date and time, in UTC; the date by Hinnant's `civil_from_days`.
fn in_utc(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    let since_march = days + 719_468;
    let (era, day_of_era) = (since_march / 146_097, since_march % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02} UTC")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_of_the_calendar() {
        assert_eq!(in_utc(0), "1970-01-01 00:00:00 UTC");
        assert_eq!(in_utc(951_782_399), "2000-02-28 23:59:59 UTC");
        assert_eq!(in_utc(951_868_800), "2000-03-01 00:00:00 UTC");
        assert_eq!(in_utc(4_107_542_400), "2100-03-01 00:00:00 UTC");
    }
}
