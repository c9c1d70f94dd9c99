//! The light of a run, as `[light]`: the boxes, the sky and the sun by which the light in a plot is found.
//!
//! Without `[light]` every bud has full light, and nothing is computed; with it, light is found where a species has a
//! law of it or the tables ask for it. Absent: the model itself (`phytomer_sim::site::light`), and what buds make of
//! light, which is their species' law.

use super::Scenario;
use super::stand::Borders as StandBorders;
use phytomer_law::fault::{Fault, Path};
use phytomer_sim::site::calendar::{Calendar, CalendarTick};
use phytomer_sim::site::light::{Borders, Lighting, Projection, Sky, SkyKind, SunPath};
use phytomer_sim::site::light::{Light as SimLight, sky::MOST_AZIMUTHS, sky::MOST_RINGS};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The light of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Light {
    /// The edge of the boxes in which leaf area is counted, metres: about the size of a shoot. 0.1 if not given.
    #[schemars(range(min = 0.01, max = 10))]
    pub voxel_m: f64,
    /// How much of the area of leaves light meets: a share that is the same in all directions, or `"leaves"`, by the
    /// directions in which leaves face. 0.5 if not given, as of leaves that face everywhere alike.
    pub projection: StatedProjection,
    /// The width of the plot along X and along Y, metres, if it stands in a field of such plots. If not given, open
    /// ground is all around it, unless the stand has periodic borders.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0.01, max = 100_000)))]
    pub period_m: Option<[f64; 2]>,
    /// Whether wood keeps light as leaves do; it does not if not given.
    pub wood: bool,
    /// Whether the obstacles of the site stop light: those that buds do not enter and that have an end on every side,
    /// unless they state `opaque = false`. They do if not given.
    pub obstacles: bool,
    /// The sky.
    pub sky: StatedSky,
    /// The sun along its path, in a scenario with a calendar and a latitude. If not given, all light is that of the
    /// sky.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sun: Option<StatedSun>,
}

/// How much of the area of leaves light meets.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum StatedProjection {
    /// The same share in all directions.
    Even(#[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0))] f64),
    /// By the directions in which leaves face.
    Leaves(LeavesWord),
}

/// The word `leaves`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LeavesWord {
    /// By the directions in which leaves face.
    Leaves,
}

/// A sky of rings of equal elevation, each of which has so many azimuths.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StatedSky {
    /// How bright its parts are. Uniform if not given.
    pub kind: StatedSkyKind,
    /// The rings; 5 if not given.
    #[schemars(range(min = 1, max = MOST_RINGS))]
    pub rings: u32,
    /// The azimuths of each ring; 8 if not given.
    #[schemars(range(min = 1, max = MOST_AZIMUTHS))]
    pub azimuths: u32,
}

/// How bright the parts of a sky are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StatedSkyKind {
    /// All alike.
    #[default]
    Uniform,
    /// The standard overcast sky: the zenith three times as bright as the horizon.
    Overcast,
}

/// The sun along its path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedSun {
    /// The share of the sky in the light of a day: about 0.25 where days are clear, 1 under cloud; or `"weather"`, by
    /// the solar radiation of the weather file. `"weather"` if not given.
    #[serde(default)]
    pub diffuse: StatedDiffuse,
    /// The places of the sun on a day; 5 if not given.
    #[serde(default = "five")]
    #[schemars(range(min = 1, max = 64))]
    pub instants: u32,
}

/// The share of the sky in the light of a day.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum StatedDiffuse {
    /// The same on all days.
    Share(#[schemars(range(min = 0, max = 1))] f64),
    /// By the solar radiation of the weather.
    Weather(WeatherWord),
}

/// The word `weather`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WeatherWord {
    /// By the solar radiation of the weather.
    Weather,
}

impl Default for StatedDiffuse {
    fn default() -> Self {
        Self::Weather(WeatherWord::Weather)
    }
}

fn five() -> u32 {
    5
}

impl Default for Light {
    fn default() -> Self {
        Self {
            voxel_m: 0.1,
            projection: StatedProjection::Even(0.5),
            period_m: None,
            wood: false,
            obstacles: true,
            sky: StatedSky::default(),
            sun: None,
        }
    }
}

impl Default for StatedSky {
    fn default() -> Self {
        Self { kind: StatedSkyKind::Uniform, rings: 5, azimuths: 8 }
    }
}

impl StatedSky {
    fn felt(self) -> Sky {
        let kind = match self.kind {
            StatedSkyKind::Uniform => SkyKind::Uniform,
            StatedSkyKind::Overcast => SkyKind::Overcast,
        };
        Sky { kind, rings: self.rings, azimuths: self.azimuths }
    }
}

impl Scenario {
    /// The light of the plots of a replicate whose ticks have these dates, of a plot at the origin; `None` without
    /// `[light]`. It is found once a plot asks for it.
    pub fn lit(&self, calendar: Option<&Calendar>) -> Option<SimLight> {
        let light = self.light.as_ref()?;
        let projection = match light.projection {
            StatedProjection::Even(share) => Projection::Even(share),
            StatedProjection::Leaves(LeavesWord::Leaves) => Projection::OfLeaves,
        };
        let lighting = Lighting {
            voxel_m: light.voxel_m,
            projection,
            borders: self.period_m(light).map_or(Borders::Open, Borders::Periodic),
            sky: light.sky.felt(),
            sun: light.sun.and_then(|sun| self.sun_path(sun, calendar)),
            wood: light.wood,
            opaque: if light.obstacles { self.site.opaque() } else { Vec::new() },
            origin: self.stand.as_ref().map_or([0.0; 3], |stand| {
                let [x, y] = stand.ground().least;
                [x, y, 0.0]
            }),
        };
        Some(SimLight::of(lighting))
    }

    /// The widths at which the light of a plot repeats, metres: those of the ground of a stand with periodic borders,
    /// or those that are stated.
    fn period_m(&self, light: &Light) -> Option<[f64; 2]> {
        let of_stand = self.stand.as_ref().filter(|stand| stand.borders == StandBorders::Periodic);
        of_stand.map(|stand| stand.ground().sides()).or(light.period_m)
    }

    /// Whether the radiation of the weather is asked for: the share of the sky is to follow from it.
    pub(crate) fn asks_for_radiation(&self) -> bool {
        let sun = self.light.as_ref().and_then(|light| light.sun);
        sun.is_some_and(|sun| matches!(sun.diffuse, StatedDiffuse::Weather(_)))
    }

    fn sun_path(&self, sun: StatedSun, calendar: Option<&Calendar>) -> Option<SunPath> {
        let (calendar, known) = (calendar?, calendar?.skylight());
        let latitude = self.site.latitude_deg.map(f64::to_radians).or(known.map(|known| known.latitude))?;
        let middle = |tick: &CalendarTick| tick.date.plus(-(tick.days as i32 + 1) / 2);
        let of_sky = |tick: usize| match sun.diffuse {
            StatedDiffuse::Share(share) => Some(share),
            StatedDiffuse::Weather(_) => known?.of_sky.get(tick).copied(),
        };
        let days = calendar.ticks().iter().enumerate().map(|(tick, at)| Some((middle(at), of_sky(tick)?)));
        Some(SunPath { latitude, days: days.collect::<Option<_>>()?, instants: sun.instants })
    }

    /// Adds the faults of the light.
    pub(super) fn check_light(&self, faults: &mut Vec<Fault>) {
        let path = Path::root().key("light");
        if self.light.is_none() && self.output.light {
            let problem = "the columns of light are asked for, and the scenario has no light";
            faults.push(Fault::new(&Path::root().key("output").key("light"), problem, "`[light]`, or `false`"));
        }
        let is_periodic = self.stand.as_ref().is_some_and(|stand| stand.borders == StandBorders::Periodic);
        let borders = || Path::root().key("stand").key("borders");
        if is_periodic && self.light.is_none() {
            let problem = "nothing goes beyond the borders of the stand: the scenario has no light";
            faults.push(Fault::new(&borders(), problem, "`[light]`, or open borders"));
        }
        let Some(light) = &self.light else { return };
        if is_periodic && light.period_m.is_some() {
            let problem = "`period_m` and the borders of the stand both say where the plot repeats";
            faults.push(Fault::new(&path.key("period_m"), problem, "the borders of the stand alone"));
        }
        if let Some(period) = self.period_m(light).filter(|period| period.iter().any(|width| *width < light.voxel_m)) {
            let problem = format!("a plot of {period:?} m is narrower than a box of {} m", light.voxel_m);
            let place = if is_periodic { borders() } else { path.key("period_m") };
            faults.push(Fault::new(&place, problem, "a wider plot, or smaller boxes (`voxel_m`)"));
        }
        // The weather file may have the latitude: where it has none that is told once it is read.
        let has_latitude = self.site.latitude_deg.is_some() || self.asks_for_radiation();
        if light.sun.is_some() && (!has_latitude || self.calendar.is_none()) {
            let problem = "the path of the sun is not known without a date and a latitude";
            let expected = "`planting_date`, `[calendar]` and `site.latitude_deg`, or no `[light.sun]`";
            faults.push(Fault::new(&path.key("sun"), problem, expected));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::validate_texts;

    fn told(light: &str) -> Result<(), String> {
        let text = format!("name = \"a\"\nspecies = \"coffee\"\nplants = 1\nages = {{ until = 2 }}\n{light}\n");
        validate_texts("a", &[("a", &text)]).map(|_| ()).map_err(|report| report.render(false))
    }

    #[test]
    fn light_is_checked_before_the_first_tick() {
        for sound in [
            "[light]",
            "[light]\nprojection = \"leaves\"\nperiod_m = [2, 1]\nsky = { kind = \"overcast\", rings = 9 }",
            "planting_date = \"2001-03-01\"\ncalendar = { tick = { days = 30 } }\nsite = { latitude_deg = 5 }\n\
             [light]\nsun = { diffuse = 0.4 }\n[output]\nlight = true",
        ] {
            assert_eq!(told(sound), Ok(()), "{sound}");
        }
        for (faulty, says) in [
            ("[light]\nvoxel_m = 0", "voxel_m"),
            ("[light]\nvoxel = 0.1", "did you mean `voxel_m`"),
            ("[light]\nprojection = \"leafs\"", "projection"),
            ("[light]\nperiod_m = [2, 0.05]", "narrower than a box"),
            ("[light]\nsun = { diffuse = 0.4 }", "not known without a date and a latitude"),
            ("[light]\nsky = { rings = 65 }", "rings"),
            ("[output]\nlight = true", "the scenario has no light"),
        ] {
            let told = told(faulty).expect_err(faulty);
            assert!(told.contains(says), "{faulty}: {told}");
        }
    }
}
