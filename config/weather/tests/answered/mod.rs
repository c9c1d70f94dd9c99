//! What must come of any bytes: weather that holds together, or faults with places in the text.
//!
//! The first byte chooses the format, whether gaps are filled and whether the weather comes again; the rest is the
//! file. It is the fuzz target `weather`, and the test of broken files runs it too. Absent: whether a value is right.

use phytomer_weather::{Asked, Beyond, Format, MOST_FAULTS, Refused, Weather, decode, read};

const FORMATS: [Format; 4] = [Format::Dssat, Format::Agmip, Format::Apsim, Format::Csv];

/// The first byte of a file of a format, whose gaps are to be filled.
pub fn choice(format: Format) -> u8 {
    FORMATS.iter().position(|one| *one == format).unwrap_or(0) as u8 | 4
}

/// Reads what follows the first byte; whether it was weather.
pub fn answer(data: &[u8]) -> bool {
    let Some((&choice, file)) = data.split_first() else { return false };
    let asked = Asked {
        format: Some(FORMATS[usize::from(choice & 3)]),
        interpolate_days: if choice & 4 == 0 { 0 } else { u32::from(choice >> 4) },
        beyond: if choice & 8 == 0 { Beyond::Refuse } else { Beyond::Repeat },
    };
    match read("mutant", file, &asked) {
        Ok(weather) => hold(&weather, asked.beyond == Beyond::Repeat),
        Err(refused) => tell(&refused, &decode(file)),
    }
}

fn hold(weather: &Weather, comes_again: bool) -> bool {
    assert_eq!(weather.last().since(weather.first()) as usize + 1, weather.days().len());
    for day in weather.days() {
        assert!(day.minimum <= day.maximum && day.minimum >= -90.0 && day.maximum <= 60.0, "{day:?}");
        let others = [day.rain, day.radiation, day.wind, day.dew_point, day.vapour_pressure, day.humidity];
        assert!(others.iter().flatten().all(|value| value.is_finite()), "{day:?}");
    }
    for away in [-100_000, -366, -1, 366, 100_000] {
        let is_there = [weather.first(), weather.last()].map(|end| weather.day(end.plus(away)).is_some());
        assert!(!comes_again || is_there == [true, true], "{away} days away there is no weather");
    }
    true
}

fn tell(refused: &Refused, text: &str) -> bool {
    assert!(!refused.faults.is_empty() && refused.faults.len() <= MOST_FAULTS, "{} faults", refused.faults.len());
    let lines = text.split(['\n', '\r']).count();
    for fault in &refused.faults {
        // UTF-16 is no text of ours: its fault stands at the beginning.
        assert!(fault.bytes.end <= text.len() || fault.bytes.end == 1, "{fault:?}");
        assert!(fault.line >= 1 && fault.line <= lines, "{fault:?}");
        assert!(!fault.problem.is_empty() && !fault.problem.ends_with('.') && !fault.expected.is_empty(), "{fault:?}");
        assert!(!fault.problem.chars().any(|c| c.is_control()), "a file's text must not steer a terminal: {fault:?}");
    }
    assert!(refused.to_string().lines().count() >= refused.faults.len());
    false
}
