//! Numbers as people read them: `1 234 567`, `2.4 M`, `31.5 MB`, `1 min 12 s`, and the peak memory of this process.
//!
//! Spaces part thousands; sizes are in powers of a thousand. Absent: JSON, which carries plain numbers.

/// A count with thin groups: `1 234 567`.
pub fn count(number: u64) -> String {
    let digits = number.to_string();
    let mut grouped = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            grouped.push(' ');
        }
        grouped.push(digit);
    }
    grouped
}

/// A count with its word, in the plural where that is due: `1 plant`, `2 plants`.
pub fn of(number: u64, word: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{} {word}{plural}", count(number))
}

/// A number of two or three digits with k, M or G: `2.4 M`.
pub fn about(number: f64) -> String {
    let (scaled, unit) = scale(number, &["", " k", " M", " G", " T", " P"]);
    match scaled {
        _ if unit.is_empty() && number.fract() == 0.0 => format!("{number:.0}"),
        x if x < 10.0 => format!("{x:.2}{unit}"),
        x if x < 100.0 => format!("{x:.1}{unit}"),
        x => format!("{x:.0}{unit}"),
    }
}

/// Bytes in powers of 1000: `31.5 MB`.
pub fn bytes(number: f64) -> String {
    phytomer_outputs::Bytes(number as u64).to_string()
}

fn scale<'u>(number: f64, units: &[&'u str]) -> (f64, &'u str) {
    let mut scaled = number;
    let mut unit = 0;
    while scaled >= 999.5 && unit + 1 < units.len() {
        scaled /= 1000.0;
        unit += 1;
    }
    (scaled, units[unit])
}

/// A length of time: `0.12 s`, `48 s`, `3 min 07 s`, `2 h 14 min`.
pub fn time(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        0..10 => format!("{seconds:.2} s"),
        10..60 => format!("{seconds:.1} s"),
        60..3600 => format!("{} min {:02} s", whole / 60, whole % 60),
        _ => format!("{} h {:02} min", whole / 3600, whole % 3600 / 60),
    }
}

/// The most memory that this process has held so far, bytes; `None` where the system does not tell.
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_as_people_read_them() {
        assert_eq!(count(1_234_567), "1 234 567");
        assert_eq!(count(0), "0");
        assert_eq!((of(1, "plant"), of(2_000, "row")), ("1 plant".into(), "2 000 rows".into()));
        assert_eq!([999.0, 1e3, 2.44e6, 31e6, 999_600.0].map(about), ["999", "1.00 k", "2.44 M", "31.0 M", "1.00 M"]);
        assert_eq!([12.0, 31.46e6, 999_999.0].map(bytes), ["12 B", "31.5 MB", "1.0 MB"]);
        assert_eq!([0.123, 48.26, 187.0, 8040.0].map(time), ["0.12 s", "48.3 s", "3 min 07 s", "2 h 14 min"]);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn linux_tells_the_peak_memory() {
        assert!(peak_memory().unwrap() > 500_000);
    }
}
