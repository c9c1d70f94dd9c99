//! Pests of a run: what each attacks, how severely, at which ages, and how its attacks are spread over plants and
//! field.
//!
//! A severity is the probability that a thing which stands through the attack is attacked: stated as such, as the
//! percentage that scouts have found, or, for leaves, by what larvae eat: larvae a m² × m² a larva and day × days, m²
//! of leaf a m² of leaf (10 × 0.00144 × 10 = 0.144). It is spread evenly over the ticks of an attack, so that each has
//! the hazard 1 − (1 − s)^(1/n). An attack has ages of the plants, or days of the calendar (`attack`). Absent: what an
//! attack does to a plant (`sim::plant::Exposure`, `models::buds`).

mod attack;
mod exposed;

use super::field_plot::{FieldPlot, Spread};
use attack::Attack;
use exposed::Exposed;
use phytomer_draws::{Aggregation, Clusters, Draws, Event, Key, NONE};
use phytomer_law::fault::{Fault, Path};
use phytomer_sim::math::{expm1, log1p};
use phytomer_sim::plant::Exposure;
use phytomer_sim::site::calendar::Calendar;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A pest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pest {
    /// Its name. The draws of a pest belong to its name: they stay when another pest is added.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// What it attacks.
    pub attacks: Attacked,
    /// The probability that a thing which stands through an attack is attacked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 1))]
    pub probability: Option<f64>,
    /// The percentage of things found attacked after it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 100))]
    pub scouted_percent: Option<f64>,
    /// Larvae that eat leaves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Larvae")]
    pub larvae: Option<Larvae>,
    /// The first and the last age of the plants, ticks, at which it attacks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[u32; 2]", inner(range(min = 1, max = 65_535)))]
    pub ages: Option<[u32; 2]>,
    /// The first and the last day on which it attacks, as YYYY-MM-DD, instead of `ages`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[String; 2]")]
    pub dates: Option<[String; 2]>,
    /// Whether it attacks on the same days of each later year, where `dates` are given. Once if not given.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub yearly: bool,
    /// The ticks of a season: it attacks again after so many. Once if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32", range(min = 1, max = 65_535))]
    pub every: Option<u32>,
    /// The correlation of attacks within a plant: 0 at random, 1 a plant whole or not at all. Each plant has a
    /// susceptibility of its own in each season, by a Beta distribution. 0 if not given.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 1))]
    pub aggregation: f64,
    /// Clusters in the field, a Thomas process; they multiply the severity at each place, with mean 1. None if not
    /// given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Clustered")]
    pub clusters: Option<Clustered>,
    /// The standard deviation by which the severity differs between the blocks of the experiment: the treatments of a
    /// block share its pests, in all seasons. 0 if not given.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 1))]
    pub block_sd: f64,
    /// The standard deviation by which it differs between field plots, each one replicate of one treatment, in all
    /// seasons. 0 if not given.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 1))]
    pub field_plot_sd: f64,
    /// The standard deviation by which it differs between plots, which share a site (often a single plant), in each
    /// season anew. 0 if not given.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 1))]
    pub plot_sd: f64,
    /// The share of its growth that a plant loses in the next season for each share of its leaves that is eaten: a
    /// growth unit of n nodes has ⌊n (1 − next_season × share) + u⌋. 0 if not given.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 1))]
    pub next_season: f64,
}

/// What a pest attacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Attacked {
    /// Apical buds: a bud is killed at a clock step.
    Apex,
    /// Leaves: a leaf is eaten whole, so that a share of the leaf area goes.
    Leaf,
    /// Flowers: a flower that is eaten sets no fruit.
    Flower,
    /// Fruits.
    Fruit,
    /// Plants: every bud is killed at one tick of the attack.
    Plant,
}

/// Larvae that eat leaves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Larvae {
    /// Larvae a square metre of leaf.
    #[schemars(range(min = 0, max = 1e6))]
    pub per_m2: f64,
    /// The leaf that a larva eats a day, m².
    #[schemars(range(min = 0, max = 1))]
    pub eats_m2_per_day: f64,
    /// The days for which they eat.
    #[schemars(range(min = 0, max = 366))]
    pub days: f64,
}

/// Clusters of a pest in the field.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Clustered {
    /// Clusters a square metre of field.
    #[schemars(range(max = 1e4), extend("exclusiveMinimum" = 0))]
    pub per_m2: f64,
    /// The standard deviation of a cluster in either direction, metres.
    #[schemars(range(min = 0.001, max = 1e6))]
    pub spread_m: f64,
}

/// A plant as pests find it.
#[derive(Debug, Clone, Copy)]
pub struct Host<'a> {
    /// The field plot in which it stands.
    pub field_plot: FieldPlot<'a>,
    /// Its plot, counted within the treatment and replicate.
    pub plot: u32,
    /// The plant, counted within the treatment and replicate.
    pub plant: u32,
    /// Where it stands in the field, metres.
    pub place: [f64; 2],
    /// The last age that it reaches.
    pub until: u32,
    /// The tick of its plot at which it is sown.
    pub sown: u32,
    /// The dates of the ticks of its plot, where they have dates.
    pub calendar: Option<&'a Calendar>,
}

fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

impl Larvae {
    /// The leaf area eaten, m² a m² of leaf; it may be above 1, when they eat all.
    pub fn eaten(&self) -> f64 {
        self.per_m2 * self.eats_m2_per_day * self.days
    }
}

impl Pest {
    /// The probability that a thing which stands through an attack is attacked, in the mean over plots and plants.
    pub fn severity(&self) -> f64 {
        let eaten = self.larvae.as_ref().map(Larvae::eaten);
        let stated = self.probability.or(self.scouted_percent.map(|percent| percent / 100.0)).or(eaten);
        stated.unwrap_or(0.0).clamp(0.0, 1.0)
    }

    /// The severity for one plant in one season.
    fn of_plant(&self, host: &Host<'_>, season: u32) -> f64 {
        let Host { field_plot, plot, plant, place, .. } = *host;
        let FieldPlot { seed, replicate, .. } = field_plot;
        let event = Event::named("pest", &self.name);
        let of = |plot, event, plant| Key { seed, replicate, plot, event, plant, season };
        let mut severity = self.severity();
        let spread = Spread { block_sd: self.block_sd, field_plot_sd: self.field_plot_sd };
        if spread.is_any() {
            severity = field_plot.shifted(&format!("pest {}", self.name), severity, spread, [0.0, 1.0]);
        }
        if self.plot_sd > 0.0 {
            let mut draws = Draws::of(&of(plot, Event::named("pest of plot", &self.name), NONE));
            severity = draws.shifted(severity, self.plot_sd, [0.0, 1.0]).unwrap_or(severity);
        }
        if let Some(Clustered { per_m2, spread_m }) = self.clusters {
            let clusters = Clusters::new(per_m2, spread_m);
            let pressure = clusters.and_then(|clusters| clusters.pressure(&of(NONE, event, NONE), place));
            severity = (severity * pressure.unwrap_or(1.0)).min(1.0);
        }
        let own = Aggregation::new(severity, self.aggregation);
        own.and_then(|own| own.susceptibility(&mut Draws::of(&of(plot, event, plant)))).unwrap_or(severity)
    }

    /// Adds one season of attacks on a plant.
    fn attack(&self, host: &Host<'_>, attack: &Attack, exposed: &mut Exposed) {
        let Attack { season, from, ticks, .. } = *attack;
        let severity = self.of_plant(host, season);
        let each = -expm1(log1p(-severity) / f64::from(ticks));
        let until = attack.until.min(host.until);
        let hazard = match self.attacks {
            Attacked::Apex => &mut exposed.apex,
            Attacked::Leaf => &mut exposed.leaf,
            Attacked::Flower => &mut exposed.flower,
            Attacked::Fruit => &mut exposed.fruit,
            Attacked::Plant => {
                let Host { field_plot: FieldPlot { seed, replicate, .. }, plot, plant, .. } = *host;
                let event = Event::named("death by pest", &self.name);
                let mut draws = Draws::of(&Key { seed, replicate, plot, event, plant, season });
                let killed = (from..=until).find(|_| draws.happens(each));
                exposed.death = exposed.death.min(killed.unwrap_or(exposed.death));
                (from..=until).for_each(|age| exposed.plant.join(age, each));
                return;
            }
        };
        (from..=until).for_each(|age| hazard.join(age, each));
        if let Some([next, end]) = attack.next.filter(|_| self.next_season > 0.0 && self.attacks == Attacked::Leaf) {
            exposed.weaken(next..end.min(host.until + 1), 1.0 - self.next_season * severity);
        }
    }

    /// Adds the faults that the schema cannot state.
    fn check(&self, path: &Path, run: Run, faults: &mut Vec<Fault>) {
        self.check_times(path, run, faults);
        let mut fault = |key: &str, problem: String, expected: &str| {
            faults.push(Fault::new(&path.key(key), problem, expected));
        };
        let given = [self.probability.is_some(), self.scouted_percent.is_some(), self.larvae.is_some()];
        let (count, kinds) = (given.iter().filter(|given| **given).count(), "probability, scouted_percent, larvae");
        if count != 1 {
            let count = if count == 0 { "no severity".to_owned() } else { format!("{count} severities") };
            let problem = format!("the pest `{}` states {count}", self.name);
            fault("attacks", problem, &format!("exactly one of {kinds}"));
        }
        if self.larvae.is_some() && self.attacks != Attacked::Leaf {
            fault("larvae", "larvae eat leaves, and the pest attacks something else".into(), "attacks = \"leaf\"");
        }
        let comes_again = self.every.is_some() || self.yearly;
        if self.next_season > 0.0 && (self.attacks != Attacked::Leaf || !comes_again) {
            let problem = "growth of the next season is lost with leaves, and a season has a length".to_owned();
            fault("next_season", problem, "attacks = \"leaf\", and `every` or `yearly`");
        }
        if let Some(Clustered { per_m2, spread_m }) = self.clusters {
            if let Err(error) = Clusters::new(per_m2, spread_m) {
                fault("clusters", error.to_string(), "fewer or narrower clusters");
            } else if !run.has_places {
                fault("clusters", "plants have no places in a field".into(), "`spacing_m`, the distance between plots");
            }
        }
    }
}

/// What the pests of a run do to one plant; `None` without pests. A plant of the same replicate and number meets the
/// same draws in every treatment.
pub fn exposure(pests: &[Pest], host: &Host<'_>) -> Option<Arc<Exposure>> {
    if pests.is_empty() {
        return None;
    }
    let mut exposed = Exposed::default();
    for pest in pests {
        pest.attacks_on(host).iter().for_each(|attack| pest.attack(host, attack, &mut exposed));
    }
    Some(Arc::new(exposed.into_exposure()))
}

/// What the faults of pests depend on in their scenario.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    /// The last tick.
    pub until: u32,
    /// Whether plants have places in a field.
    pub has_places: bool,
    /// Whether ticks have dates.
    pub has_calendar: bool,
}

/// The faults of the pests of a run.
pub(super) fn check(pests: &[Pest], run: Run, path: &Path, faults: &mut Vec<Fault>) {
    for (number, pest) in pests.iter().enumerate() {
        let path = path.index(number);
        if pests[..number].iter().any(|other| other.name == pest.name) {
            let problem = format!("two pests are named `{}`", pest.name);
            faults.push(Fault::new(&path.key("name"), problem, "a name of its own, to which its draws belong"));
        }
        pest.check(&path, run, faults);
    }
}

/// The faults of days that do not lie in the calendar.
pub(super) fn check_days(pests: &[Pest], calendar: &Calendar, path: &Path, faults: &mut Vec<Fault>) {
    for (number, pest) in pests.iter().enumerate() {
        faults.extend(pest.fault_of_days(calendar, &path.index(number)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_sim::NEVER;

    fn pest(toml: &str) -> Pest {
        toml::from_str(&format!("name = \"borer\"\nattacks = \"leaf\"\nages = [11, 14]\n{toml}")).expect("a pest")
    }

    fn host(plant: u32) -> Host<'static> {
        let field_plot = FieldPlot { seed: 7, treatment: "control", replicate: 0, block: None };
        let place = [3.0 * f64::from(plant), 0.0];
        Host { field_plot, plot: plant, plant, place, until: 40, sown: 0, calendar: None }
    }

    /// Ten larvae a m² that eat .00144 m² a day for ten days eat .144 m²/m²: so many of the leaves that stand through
    /// the attack, whatever its number of ticks.
    #[test]
    fn larvae_eat_their_area() {
        let larvae = pest("larvae = { per_m2 = 10, eats_m2_per_day = 0.00144, days = 10 }");
        assert!((larvae.severity() - 0.144).abs() < 1e-15);
        assert!((pest("scouted_percent = 14.4").severity() - 0.144).abs() < 1e-15);
        let exposure = exposure(&[larvae], &host(0)).expect("an exposure");
        let words = || (0..10_000).map(|k| k * 429_496 + 214_748_u32);
        let eaten = words().filter(|word| exposure.leaf.end(3, *word) < NEVER).count();
        assert_eq!(eaten, 1440);
        let at = |tick| words().filter(|word| exposure.leaf.end(3, *word) == tick).count();
        assert!((11..=14).all(|tick| at(tick) > 330) && at(10) + at(15) == 0);
        // A leaf that is born in the attack meets the rest of it.
        let late = words().filter(|word| exposure.leaf.end(12, *word) < NEVER).count();
        assert!((late as f64 / 1e4 - (1.0 - f64::sqrt(1.0 - 0.144))).abs() < 2e-4, "{late}");
    }

    /// Seasons come again; what was eaten in a season weakens the growth of the next.
    #[test]
    fn seasons_come_again_and_weaken_the_next() {
        let again = pest("probability = 0.4\nevery = 12\nnext_season = 0.5");
        let exposure = exposure(&[again], &host(1)).expect("an exposure");
        assert_eq!((22..36).map(|age| exposure.growth_at(age)).filter(|growth| *growth == 1.0).count(), 1);
        let close = |age, expected: f64| (exposure.growth_at(age) - expected).abs() < 1e-12;
        assert!(
            close(22, 1.0) && close(23, 0.8) && close(34, 0.8) && close(35, 0.8) && close(40, 0.8) && close(41, 1.0)
        );
        assert!(exposure.leaf.end(22, u32::MAX) == NEVER && exposure.leaf.end(22, 0) == 23);
    }

    /// The mean severity over plants is that stated, with and without aggregation, and its variance that of the Beta
    /// distribution, p (1 − p) ρ; clusters and plots keep their places in it, and a name its draws.
    #[test]
    fn attacks_are_spread_over_plants() {
        let plants = 4000;
        let of = |pest: &Pest| (0..plants).map(|plant| pest.of_plant(&host(plant), 0)).collect::<Vec<f64>>();
        let moments = |all: &[f64]| {
            let n = all.len() as f64;
            let mean = all.iter().sum::<f64>() / n;
            (mean, all.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n)
        };
        assert!(of(&pest("probability = 0.2")).iter().all(|own| *own == 0.2));
        let (mean, variance) = moments(&of(&pest("probability = 0.2\naggregation = 0.1")));
        assert!(
            (mean - 0.2).abs() < 4.0 * f64::sqrt(0.016 / 4000.0) && (variance - 0.016).abs() < 0.0016,
            "{mean} {variance}"
        );
        let (mean, variance) = moments(&of(&pest("probability = 0.3\nplot_sd = 0.05")));
        assert!((mean - 0.3).abs() < 4.0 * 0.05 / f64::sqrt(4000.0) && (variance - 0.0025).abs() < 0.000_25);
        let clustered = of(&pest("probability = 0.1\nclusters = { per_m2 = 0.1, spread_m = 3 }"));
        let (mean, variance) = moments(&clustered);
        assert!((mean - 0.1).abs() < 0.01 && variance > 1e-4, "{mean} {variance}");
        let other = Pest { name: "another".into(), ..pest("probability = 0.2\naggregation = 0.1") };
        assert_ne!(of(&other), of(&pest("probability = 0.2\naggregation = 0.1")));
    }

    /// A pest that kills whole plants with the probability 0.4 kills that share of 3,000 plants, at ages of its attack.
    #[test]
    fn whole_plants_are_killed() {
        let of = Pest { attacks: Attacked::Plant, ..pest("probability = 0.4") };
        let deaths: Vec<u32> = (0..3000)
            .filter_map(|plant| exposure(std::slice::from_ref(&of), &host(plant)))
            .map(|of| of.death)
            .collect();
        let killed = deaths.iter().filter(|death| **death < NEVER).count() as f64 / 3000.0;
        assert!((killed - 0.4).abs() < 4.0 * f64::sqrt(0.24 / 3000.0), "{killed}");
        assert!(deaths.iter().all(|death| (11..=14).contains(death) || *death == NEVER));
        assert!(exposure(&[], &host(0)).is_none());
    }
}
