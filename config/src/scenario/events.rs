//! Events: what people do to the plants of a run, as a calendar of operations in `[[event]]`.
//!
//! An event has an operation, its times and the parts of plants that it takes. Its conditions are read here, against
//! the columns that are known of the thing that it takes. Heading shortens an axis, thinning takes a branch off where
//! it arises. Absent: dates, which need a calendar, and what an operation does (`phytomer_sim::management`).

mod act;
mod faults;
mod times;
mod work;

pub use work::Work;

use super::Scenario;
use super::site::Plane;
use phytomer_law::condition::formula;
use phytomer_law::fault::{Fault, Path};
use phytomer_models::shapes::{MOST_PARTS, Named, ShapeOrName, one};
use phytomer_sim::management::{Choice, Column, Management, Operation, SharedFormula, Thing, When};
use phytomer_sim::site::calendar::Calendar;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Something that people do to plants, between two ticks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Event {
    /// What is done.
    pub operation: Work,
    /// The tick of the plot at which it is done for the first time: on the plant as it stood at the end of the tick
    /// before. What it takes does not stand at this tick any more.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 65_535))]
    pub tick: Option<u32>,
    /// The age of each plant at which it is done for the first time, instead of `tick`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 65_535))]
    pub age: Option<u32>,
    /// The day on which it is done for the first time, as YYYY-MM-DD, instead of `tick`: at the tick that spans the
    /// day.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub date: Option<String>,
    /// The day of a harvest, as YYYY-MM-DD: `date` by its ICASA name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub harvest_operations_date: Option<String>,
    /// Whether it is done again on the same day of each later year, where a date is given. Once if not given.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub yearly: bool,
    /// A condition on the plant, such as `"height_m > 2"`: it is done for the first time when this holds. Asked at each
    /// tick from `tick`, `age` or `date` on, from the first if none is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<String>,
    /// The ticks from one time to the next. Done once if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 65_535))]
    pub every: Option<u32>,
    /// The last tick, or the last age where `age` is given, at which it is done.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 65_535))]
    pub until: Option<u32>,
    /// A condition on the plants to which it is done. All plants if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plants: Option<String>,
    /// A condition on the branches or fruits that are taken, such as `"order >= 3 and height_m > 2.5"`. All if not
    /// given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only: Option<String>,
    /// A condition on the branches, fruits or plants that are kept, with what bears them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub protect: Option<String>,
    /// The rank in which they are taken, where `share` or `at_most` limits their number: the greatest value first, so
    /// that `"diameter_m"` takes the strongest first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first: Option<String>,
    /// The largest share of those that may be taken: at most this share of them is. All if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0))]
    pub share: Option<f64>,
    /// The largest number of them on a plant; of a removal, of plants in a plot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<u32>,
    /// The height above the seed from which on nothing is left, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1000))]
    pub height_m: Option<f64>,
    /// The height of harvest, cm: everything above it is harvested. The fruits that are ripe if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 100_000))]
    pub harvest_cut_height: Option<f64>,
    /// The nodes that each axis keeps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keep_nodes: Option<u32>,
    /// The share of its length that each axis keeps, cut at a node; 1 takes the bud at the tip alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub keep_share: Option<f64>,
    /// The length that each axis keeps, metres, cut at a node.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1000))]
    pub keep_length_m: Option<f64>,
    /// The planes of a hedge, metres from the seed of each plant; nothing is left on the side of their normals.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub planes: Vec<Plane>,
    /// The box of a hedge around the seed of each plant: its extents eastward, northward and upward, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0.001, max = 1000)))]
    pub box_m: Option<[f64; 3]>,
    /// The shape of a hedge around the seed of each plant, metres from the seed: a table, or the name of a shape of the
    /// site. Nothing is left outside it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<ShapeOrName>,
    /// The share of its life on the plant that a fruit has behind it when it is ripe. 0.9 if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub ripe_share: Option<f64>,
    /// The angle to the upward vertical at which each chosen branch stands from then on, degrees. The angle that it has
    /// if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 180))]
    pub angle_deg: Option<f64>,
    /// The direction of each chosen branch from then on, or of the wires, degrees from north to east: 90 is east. If
    /// not given, a branch keeps its direction, and wires run along the rows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 360))]
    pub azimuth_deg: Option<f64>,
    /// The heights of the horizontal wires above the seed, metres. Each chosen branch is tied along the wire that is
    /// nearest in height to its base.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 100), inner(range(min = 0, max = 1000)))]
    pub wires_m: Vec<f64>,
    /// The ticks for which the support of trained wood stays. It is not taken away if not given. Of effect on wood that
    /// bends: when the support is gone, it sags under its load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 65_535))]
    pub stays: Option<u32>,
}

impl Event {
    /// The event in a few words: what, when, and on which parts.
    pub fn in_words(&self) -> String {
        let start = match (self.tick, self.age, self.stated_day()) {
            (Some(tick), ..) => format!(" at tick {tick}"),
            (None, Some(age), _) => format!(" at age {age}"),
            (None, None, Some((_, day))) => {
                format!(" on {day}{}", if self.yearly { " and each year after" } else { "" })
            }
            _ => String::new(),
        };
        let number = |before: &str, value: Option<u32>| value.map(|value| format!("{before} {value}"));
        let text = |before: &str, value: &Option<String>| value.as_ref().map(|value| format!("{before} {value}"));
        let more = [
            text("first when", &self.when),
            number("every", self.every),
            number("until", self.until),
            text("plants", &self.plants),
            text("only", &self.only),
            text("but", &self.protect),
        ];
        let more = more.into_iter().flatten().map(|part| format!(", {part}")).collect::<String>();
        format!("{}{start}{more}", self.operation.word())
    }

    /// The keys of the event that belong to some operations alone.
    fn stated(&self) -> Vec<&'static str> {
        let all = [
            ("only", self.only.is_some()),
            ("protect", self.protect.is_some()),
            ("first", self.first.is_some()),
            ("share", self.share.is_some()),
            ("at_most", self.at_most.is_some()),
            ("height_m", self.height_m.is_some()),
            ("harvest_cut_height", self.harvest_cut_height.is_some()),
            ("keep_nodes", self.keep_nodes.is_some()),
            ("keep_share", self.keep_share.is_some()),
            ("keep_length_m", self.keep_length_m.is_some()),
            ("planes", !self.planes.is_empty()),
            ("box_m", self.box_m.is_some()),
            ("shape", self.shape.is_some()),
            ("ripe_share", self.ripe_share.is_some()),
            ("angle_deg", self.angle_deg.is_some()),
            ("azimuth_deg", self.azimuth_deg.is_some()),
            ("wires_m", !self.wires_m.is_empty()),
            ("stays", self.stays.is_some()),
            ("harvest_operations_date", self.harvest_operations_date.is_some()),
        ];
        all.into_iter().filter(|(_, stated)| *stated).map(|(key, _)| key).collect()
    }

    /// The operation that the event asks for; `None` where its day does not lie in the calendar. Where the calendar is
    /// not known yet, the first age of a plant stands for the day.
    ///
    /// # Errors
    /// The faults of its keys, of its times in the run of the scenario, of its conditions and of its shape.
    fn operation(
        &self,
        (of, shapes): (&Scenario, &Named),
        calendar: Option<&Calendar>,
        path: &Path,
    ) -> Result<Option<Operation>, Vec<Fault>> {
        let mut faults = Vec::new();
        self.check_keys(path, &mut faults);
        self.check_times(of, path, &mut faults);
        let mut read = |text: &Option<String>, key: &str, thing: Thing| -> Option<SharedFormula> {
            let read = formula(text.as_deref()?, thing, &path.key(key));
            read.map_err(|fault| faults.push(fault)).ok()
        };
        let condition = read(&self.when, "when", Thing::Plant);
        let plants = read(&self.plants, "plants", Thing::Plant);
        let thing = if self.harvest_cut_height.is_some() { Thing::Wood } else { self.operation.thing() };
        let [only, protect, first] =
            [(&self.only, "only"), (&self.protect, "protect"), (&self.first, "first")].map(|(t, k)| read(t, k, thing));
        for (formula, key) in [(&condition, "when"), (&plants, "plants")] {
            let of_dates = formula.iter().flat_map(|formula| formula.columns()).find(|column| column.is_of_the_date());
            faults.extend(of_dates.and_then(|column| of.fault_of_unknown_date(column, calendar, &path.key(key))));
        }
        let shape = self.shape.as_ref().map(|shape| one(shape, shapes, &path.key("shape"), &mut faults));
        // A named shape with faults is told where it is stated.
        if !faults.is_empty() || shape == Some(None) {
            return Err(faults);
        }
        let Some(start) = self.start(calendar) else { return Ok(None) };
        let when = When { start, condition, every: self.every, last: self.until };
        let choice = Choice { only, protect, first, share: self.share, most: self.at_most };
        Ok(Some(Operation { act: self.act(shape.flatten(), of.planting.row_direction), when, plants, choice }))
    }
}

impl Scenario {
    /// What people do to the plants of each plot, whose ticks have the dates of `calendar`. What a fault was told of is
    /// left out.
    pub fn management(&self, calendar: Option<&Arc<Calendar>>) -> Management {
        let (path, shapes) = (Path::root(), self.site.shapes(&mut Vec::new()));
        let of = |event: &Event| event.operation((self, &shapes), calendar.map(Arc::as_ref), &path).ok().flatten();
        let management = Management::of(self.event.iter().filter_map(of).collect());
        management.dated(calendar.cloned()).with_successors(self.successors())
    }

    /// The first age of a plant at which an event may cut it; `None` where no event cuts.
    pub(crate) fn first_cut(&self, calendar: Option<&Calendar>) -> Option<u32> {
        let last_sown = self.last_sowing();
        let cuts = |event: &&Event| event.operation.cuts() || event.harvest_cut_height.is_some();
        self.event.iter().filter(cuts).filter_map(|event| event.first_age(calendar, last_sown)).min()
    }

    /// Adds the faults of events that the schema cannot state.
    pub(super) fn check_events(&self, shapes: &Named, faults: &mut Vec<Fault>) {
        let mut parts = 0;
        for (number, event) in self.event.iter().enumerate() {
            let path = Path::root().key("event").index(number);
            match event.operation((self, shapes), None, &path) {
                Ok(operation) => parts += operation.map_or(0, |operation| event.own_parts(&operation.act)),
                Err(found) => faults.extend(found),
            }
            if parts > MOST_PARTS {
                let problem = format!("the shapes of events up to this one have more than {MOST_PARTS} parts");
                faults.push(Fault::new(&path.key("shape"), problem, "fewer parts, or shapes by their names"));
                break;
            }
        }
    }

    /// Adds the faults of events whose days do not lie in the calendar, or whose conditions ask what it does not tell.
    pub(super) fn check_days_of_events(&self, calendar: &Calendar, faults: &mut Vec<Fault>) {
        let shapes = self.site.shapes(&mut Vec::new());
        for (number, event) in self.event.iter().enumerate() {
            let path = Path::root().key("event").index(number);
            faults.extend(event.fault_of_day(calendar, &path));
            // What is wrong without a calendar has been told.
            if event.operation((self, &shapes), None, &path).is_ok() {
                faults.extend(event.operation((self, &shapes), Some(calendar), &path).err().into_iter().flatten());
            }
        }
    }

    /// The fault of a condition that asks a column of the date which is not known.
    fn fault_of_unknown_date(&self, column: Column, calendar: Option<&Calendar>, path: &Path) -> Option<Fault> {
        let (problem, expected) = match (column, calendar) {
            (_, None) if self.calendar.is_none() => {
                (format!("`{}` is told by a calendar, and the scenario has none", column.name()), super::days::CALENDAR)
            }
            (Column::DegreeDays, Some(calendar)) if calendar.at(0).degree_day_sum.is_none() => (
                "the calendar does not tell degree-days".to_owned(),
                "`calendar.degree_days` with `method` and `base_celsius`, and `[weather]`",
            ),
            (Column::DayLength, Some(calendar)) if calendar.at(0).day_length_h.is_none() => {
                ("the latitude is not known, which decides day length".to_owned(), "`site.latitude_deg`")
            }
            _ => return None,
        };
        Some(Fault::new(path, problem, expected))
    }

    /// The fault of a scenario with events whose species `name` is made anew at each age, so that nothing that was cut
    /// stays cut.
    pub(crate) fn fault_of_uncuttable(name: &str) -> Fault {
        let problem = format!("plants of `{name}` are made anew at each age, so that no event can change them");
        Fault::new(&Path::root().key("event"), problem, "a species of the model `buds`, or no events")
    }
}

#[cfg(test)]
mod tests {
    use super::act::RIPE;
    use super::*;
    use phytomer_sim::NEVER;
    use phytomer_sim::management::{Act, Kept, Region, Start, Support, Training};
    use std::f64::consts::PI;

    fn train(support: Support, stays: u32) -> Act {
        Act::Train(Training { support, stays })
    }

    #[test]
    fn every_operation_becomes_what_its_keys_say() {
        let text = r#"
name = "a"
species = "coffee"
plants = 4
ages = { until = 60 }
event = [
  { operation = "heading", age = 5, keep_share = 0.5, only = "order == 1", every = 12, until = 40 },
  { operation = "thinning", tick = 7, only = "order >= 3", first = "diameter_m", share = 0.3, protect = "age < 3" },
  { operation = "topping", when = "height_m > 2", height_m = 1.8 },
  { operation = "hedging", age = 9, box_m = [1, 2, 3] },
  { operation = "stumping", age = 9, keep_nodes = 4 },
  { operation = "removal", age = 9, plants = "member > 2" },
  { operation = "fruit_thinning", age = 9, only = "position > 0" },
  { operation = "harvest", age = 9, every = 1 },
  { operation = "harvest", age = 9, harvest_cut_height = 25 },
  { operation = "bending", age = 9, angle_deg = 60, only = "order == 2", stays = 12 },
  { operation = "staking", age = 1, every = 1, height_m = 2 },
  { operation = "tying", age = 9, wires_m = [0.5, 1], every = 6 },
  { operation = "tying", age = 9, wires_m = [0.5], azimuth_deg = 90 },
]
planting = { row_spacing = 300, plant_spacing = 200, row_direction = 180 }"#;
        let scenario: Scenario = toml::from_str(text).unwrap();
        assert_eq!(scenario.faults(), []);
        let management = scenario.management(None);
        let acts: Vec<Act> = management.operations().iter().map(|operation| operation.act.clone()).collect();
        let expected = [
            Act::Head(Kept::Share(0.5)),
            Act::Thin,
            Act::Clear(Region::Above(1.8), u8::MAX),
            Act::Clear(Region::outside_box([1.0, 2.0, 3.0]), u8::MAX),
            Act::Stump(4),
            Act::Remove,
            Act::ThinFruits,
            Act::Harvest(RIPE),
            Act::Mow(0.25),
            train(Support::Spreader { inclination: Some(60_f64.to_radians()), azimuth: None }, 12),
            train(Support::Stake(2.0), NEVER),
            train(Support::Wires { heights: vec![0.5, 1.0], azimuth: PI }, NEVER),
            train(Support::Wires { heights: vec![0.5], azimuth: PI / 2.0 }, NEVER),
        ];
        assert_eq!(acts, expected);
        let starts: Vec<Start> = management.operations().iter().map(|operation| operation.when.start.clone()).collect();
        assert_eq!(starts[..3], [Start::Age(5), Start::Tick(7), Start::Age(1)]);
        // What is written is read as it was.
        let again: Scenario = toml::from_str(&toml::to_string(&scenario).unwrap()).unwrap();
        assert_eq!(again, scenario);
    }

    /// Ticks of 30 days from 15 January 2020 on: 10 April is day 86, in the third tick, and in the years after it lies
    /// 366, 731 … days after planting's year began.
    #[test]
    fn days_become_the_ticks_that_span_them() {
        use phytomer_sim::site::calendar::{Terms, TickLength};
        use phytomer_sim::site::date::Date;
        let text = r#"
name = "a"
species = "coffee"
plants = 4
ages = { until = 40 }
planting_date = "2020-01-15"
calendar = { tick = { days = 30 } }
event = [
  { operation = "topping", date = "2020-04-10", height_m = 1 },
  { operation = "harvest", harvest_operations_date = "2020-04-10", yearly = true },
  { operation = "harvest", date = "2019-12-31" },
  { operation = "thinning", date = "2020-04-10", every = 4, when = "date > 200" },
]"#;
        let scenario: Scenario = toml::from_str(text).unwrap();
        assert_eq!(scenario.faults(), []);
        let (planted, tick) = (Date::parse("2020-01-15").unwrap(), TickLength::Days(30));
        let terms = Terms { planted, tick, degree_days: None, latitude: None, soil: None };
        let calendar = Arc::new(Calendar::of(&terms, 40, |_| None).unwrap());
        let starts: Vec<Start> =
            scenario.management(Some(&calendar)).operations().iter().map(|of| of.when.start.clone()).collect();
        let days = [86, 86 + 365, 86 + 730, 86 + 1095].map(|days: u32| days / 30 + 1);
        assert_eq!(days, [3, 16, 28, 40]);
        assert_eq!(starts, [Start::Tick(3), Start::Each(days.into()), Start::Tick(3)], "the third lies before the run");
        let faults = scenario.faults_of_days(&calendar);
        assert_eq!(faults.len(), 1, "{faults:?}");
        assert_eq!(scenario.first_cut(Some(&calendar)), Some(3));
    }
}
