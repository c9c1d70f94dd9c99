//! Ages on the command line: `48` or `3.5`, and of a film `1..96`, `1..96/5`, or one age.

use super::regrown::Regrown;
use anyhow::Result;
use phytomer::run::regrowth::Whose;
use phytomer_outputs::films::Timeline;
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;

/// Ages from the first to the last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The first age.
    pub first: f64,
    /// The last age.
    pub last: f64,
    /// The ticks from one to the next, above 0, where they are stated; the last age is then among them.
    pub step: Option<f64>,
}

/// The shortest step, ticks.
const LEAST_STEP: f64 = 0.001;

impl Span {
    /// The ages over so many frames: those of the steps, else each frame its own where there are more frames than
    /// ticks, else those that lie whole ticks after the first.
    pub fn timeline(&self, frames: u32) -> Timeline {
        let Self { first, last, step } = *self;
        let own = (last - first) / f64::from(frames.saturating_sub(1).max(1));
        let step = step.unwrap_or(if 0.0 < own && own < 1.0 { own } else { 1.0 });
        Timeline { first, last, step, frames }
    }

    /// The age that is so many steps after the first, or any where no step is stated.
    pub fn has(&self, age: f64) -> bool {
        let steps = (age - self.first) / self.step.unwrap_or(1.0);
        let whole = self.step.is_none() || (steps - steps.round()).abs() < 1e-6;
        self.first <= age && age <= self.last && whole
    }

    /// How many steps there are from the first age to the last; without a stated step of a tick each.
    pub fn steps(&self) -> u64 {
        ((self.last - self.first) / self.step.unwrap_or(1.0) + 1e-6).floor().max(0.0) as u64
    }

    /// The age after so many steps.
    pub fn after(&self, steps: u64) -> Moment {
        let age = self.first + steps as f64 * self.step.unwrap_or(1.0);
        Moment::of(age).unwrap_or_else(|| Moment::from(self.until()))
    }

    /// The ages of all steps, and the last.
    pub fn moments(&self) -> Vec<Moment> {
        let mut all: Vec<Moment> = (0..=self.steps()).map(|steps| self.after(steps)).collect();
        let last = Moment::of(self.last);
        all.extend(last.filter(|last| all.last().is_none_or(|end| end < last)));
        all
    }

    /// So many of the ages of the steps, evenly from the first to the last of them; all where there are not as many.
    pub fn keys(&self, keys: u32) -> Vec<Moment> {
        let steps = self.steps();
        let gaps = steps.min(u64::from(keys.saturating_sub(1)));
        let key = |key: u64| if gaps == 0 { 0 } else { (2 * key * steps + gaps) / (2 * gaps) };
        (0..=gaps).map(|number| self.after(key(number))).collect()
    }

    /// The tick to which the plants must grow.
    pub fn until(&self) -> Tick {
        until(self.last)
    }
}

/// The tick to which plants must grow for an age.
pub fn until(age: f64) -> Tick {
    age.ceil() as Tick
}

/// Reads an age.
///
/// # Errors
/// What is expected.
pub fn age(text: &str) -> std::result::Result<Moment, String> {
    let moment = text.trim().parse::<f64>().ok().and_then(Moment::of);
    moment.ok_or_else(|| "an age in ticks is expected, such as 48, or 3.5 for halfway between two".to_owned())
}

/// Reads a span; of one that its steps do not fill the last age is that of the last step.
///
/// # Errors
/// What is expected.
pub fn span(text: &str) -> std::result::Result<Span, String> {
    let expected = || "ages in ticks are expected, such as 1..96, 1..96/4 for every fourth, or 60".to_owned();
    let number = |text: &str| age(text).map(Moment::age).map_err(|_| expected());
    let (ages, step) = match text.split_once('/') {
        Some((ages, step)) => (ages, Some(step.trim().parse::<f64>().map_err(|_| expected())?)),
        None => (text, None),
    };
    let (first, last) = match ages.split_once("..") {
        Some((first, last)) => (number(first)?, number(last)?),
        None => (number(ages)?, number(ages)?),
    };
    if last < first {
        return Err(format!("the first age, {first}, is after the last, {last}"));
    }
    match step {
        Some(step) if !step.is_finite() || step < LEAST_STEP => {
            Err(format!("a step of at least {LEAST_STEP} is expected after the slash"))
        }
        Some(step) => Ok(Span { first, last: first + ((last - first) / step + 1e-6).floor() * step, step: Some(step) }),
        None => Ok(Span { first, last, step: None }),
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
    let all = |until: Tick| Span { first: until.min(1).into(), last: until.into(), step: None };
    if let Some(plot) = plot {
        let ages = ages.unwrap_or_else(|| all(regrown.scenario.ages.until));
        regrown.check_plot((option, &[ages.last]), plot)?;
        return Ok((Whose::Plot(plot), ages));
    }
    regrown.check((option, &[] as &[f64]), ("--plant", &[plant]))?;
    let ages = ages.unwrap_or_else(|| all(regrown.trial.last_age_of(plant)));
    regrown.check((option, &[ages.last]), ("--plant", &[plant]))?;
    Ok((Whose::Plant(plant), ages))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_even_and_each_is_once() {
        let keys =
            |text: &str, keys| span(text).expect(text).keys(keys).into_iter().map(Moment::age).collect::<Vec<_>>();
        assert_eq!(keys("1..96", 2), [1.0, 96.0]);
        assert_eq!(keys("0..12", 4), [0.0, 4.0, 8.0, 12.0]);
        assert_eq!(keys("0..12/6", 4), [0.0, 6.0, 12.0]);
        assert_eq!(keys("1..4", 16), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(keys("1..2/0.25", 3), [1.0, 1.5, 2.0]);
        assert_eq!(keys("7", 16), [7.0]);
        assert_eq!(keys("1..8", 5), [1.0, 3.0, 5.0, 6.0, 8.0]);
        let many = keys(&format!("0..{}", u32::MAX), 256);
        assert!(many.len() == 256 && many.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(many.last(), Some(&f64::from(u32::MAX)));
    }

    #[test]
    fn all_ages_of_a_span_have_its_last() {
        let all = |text: &str| span(text).expect(text).moments().into_iter().map(Moment::age).collect::<Vec<_>>();
        assert_eq!(all("1..3"), [1.0, 2.0, 3.0]);
        assert_eq!(all("1..2.5"), [1.0, 2.0, 2.5]);
        assert_eq!(all("1..2/0.5"), [1.0, 1.5, 2.0]);
    }

    #[test]
    fn spans_are_read_and_the_rest_is_refused() {
        let of = |first, last, step| Span { first, last, step };
        for (text, meant) in [
            ("1..96", of(1.0, 96.0, None)),
            (" 1 .. 96 / 5 ", of(1.0, 96.0, Some(5.0))),
            ("1..95/5", of(1.0, 91.0, Some(5.0))),
            ("60", of(60.0, 60.0, None)),
            ("1..2/0.001", of(1.0, 2.0, Some(0.001))),
            ("0..0", of(0.0, 0.0, None)),
            ("3..4/9", of(3.0, 3.0, Some(9.0))),
            ("1.5..3", of(1.5, 3.0, None)),
            ("5..6/0.25", of(5.0, 6.0, Some(0.25))),
            ("0..4294967295/4294967295", of(0.0, 4_294_967_295.0, Some(4_294_967_295.0))),
        ] {
            assert_eq!(span(text), Ok(meant), "{text}");
        }
        for text in [
            "",
            "..",
            "1..",
            "..9",
            "9..1",
            "1..9/0",
            "1..9/",
            "-1..9",
            "1..4294967296",
            "a",
            "1,2",
            "1..=9",
            "nan..3",
            "1..inf",
            "1..9/nan",
            "1..9/-1",
            "1..9/0.0001",
            "1..2..3",
        ] {
            assert!(span(text).is_err(), "{text}");
        }
    }

    /// A film of more frames than ticks shows an age of its own in each; its first and last are whole.
    #[test]
    fn frames_between_ticks_have_ages_of_their_own() {
        let ages = |text: &str, frames| -> Vec<f64> {
            let time = span(text).unwrap().timeline(frames);
            time.held().iter().map(|(number, _)| Moment::of(time.age(*number)).unwrap().age()).collect()
        };
        assert_eq!(ages("1..3", 5), [1.0, 1.5, 2.0, 2.5, 3.0]);
        assert_eq!(ages("1..3/1", 5), [1.0, 2.0, 3.0]);
        assert_eq!(ages("1..9", 5), [1.0, 3.0, 5.0, 7.0, 9.0]);
        assert_eq!(ages("5..6/0.25", 5), [5.0, 5.25, 5.5, 5.75, 6.0]);
        assert_eq!(ages("4..4", 5), [4.0]);
        let many = ages("1..96", 289);
        assert_eq!((many.len(), many[0], many[288]), (289, 1.0, 96.0));
        for text in ["", "-1", "nan", "inf", "1e99", "3.5.1", "x"] {
            assert!(age(text).is_err(), "{text}");
        }
        assert!(span("2..12/5").unwrap().has(7.0) && !span("2..12/5").unwrap().has(8.0));
    }
}
