//! The ages of a film on the command line: `1..96`, `1..96/5`, or one age.

use super::regrown::Regrown;
use anyhow::Result;
use phytomer::run::regrowth::Whose;
use phytomer_outputs::films::Timeline;
use phytomer_sim::Tick;

/// Ages from the first to the last, a step apart; the last is among them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// The first age.
    pub first: Tick,
    /// The last age.
    pub last: Tick,
    /// The ticks from one to the next, at least 1.
    pub step: Tick,
}

impl Span {
    /// The ages themselves.
    pub fn ticks(&self) -> impl Iterator<Item = Tick> {
        (self.first..=self.last).step_by(self.step as usize)
    }

    /// The ages over so many frames.
    pub fn timeline(&self, frames: u32) -> Timeline {
        let [first, last, step] = [self.first, self.last, self.step].map(f64::from);
        Timeline { first, last, step, frames }
    }
}

/// Reads a span; of one that its steps do not fill the last age is that of the last step.
///
/// # Errors
/// What is expected.
pub fn span(text: &str) -> std::result::Result<Span, String> {
    let expected = || "ages in whole ticks are expected, such as 1..96, 1..96/4 for every fourth, or 60".to_owned();
    let whole = |text: &str| text.trim().parse::<Tick>().map_err(|_| expected());
    let (ages, step) = match text.split_once('/') {
        Some((ages, step)) => (ages, whole(step)?),
        None => (text, 1),
    };
    let (first, last) = match ages.split_once("..") {
        Some((first, last)) => (whole(first)?, whole(last)?),
        None => (whole(ages)?, whole(ages)?),
    };
    match last.checked_sub(first) {
        None => Err(format!("the first age, {first}, is after the last, {last}")),
        Some(_) if step == 0 => Err("a step of at least 1 is expected after the slash".to_owned()),
        Some(length) => Ok(Span { first, last: first + length / step * step, step }),
    }
}

/// What is shown, and its ages, of which those that are not given are all but that of the seed.
///
/// # Errors
/// What the run does not have, by the option that asks for it.
pub fn shown(
    regrown: &Regrown,
    (plant, plot): (u32, Option<u32>),
    ages: Option<Span>,
    option: &'static str,
) -> Result<(Whose, Span)> {
    let all = |until: Tick| Span { first: until.min(1), last: until, step: 1 };
    if let Some(plot) = plot {
        let ages = ages.unwrap_or_else(|| all(regrown.scenario.ages.until));
        regrown.check_plot((option, &[ages.last]), plot)?;
        return Ok((Whose::Plot(plot), ages));
    }
    regrown.check((option, &[]), ("--plant", &[plant]))?;
    let ages = ages.unwrap_or_else(|| all(regrown.trial.last_age_of(plant)));
    regrown.check((option, &[ages.last]), ("--plant", &[plant]))?;
    Ok((Whose::Plant(plant), ages))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_are_read_and_the_rest_is_refused() {
        let of = |first, last, step| Span { first, last, step };
        for (text, meant) in [
            ("1..96", of(1, 96, 1)),
            (" 1 .. 96 / 5 ", of(1, 96, 5)),
            ("1..95/5", of(1, 91, 5)),
            ("60", of(60, 60, 1)),
            ("0..0", of(0, 0, 1)),
            ("3..4/9", of(3, 3, 9)),
            ("0..4294967295/4294967295", of(0, u32::MAX, u32::MAX)),
        ] {
            assert_eq!(span(text), Ok(meant), "{text}");
        }
        for text in
            ["", "..", "1..", "..9", "9..1", "1..9/0", "1..9/", "-1..9", "1.5..3", "1..4294967296", "a", "1,2", "1..=9"]
        {
            assert!(span(text).is_err(), "{text}");
        }
    }
}
