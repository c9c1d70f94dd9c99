//! Events: what people do to the plants of a run, as a calendar of operations in `[[event]]`.
//!
//! An event has an operation, its times and the parts of plants that it takes. Its conditions are read here, against
//! the columns that are known of the thing that it takes. Heading shortens an axis, thinning takes a branch off where
//! it arises. Absent: dates, which need a calendar, and what an operation does (`phytomer_sim::management`).

mod faults;

use super::Scenario;
use super::site::Plane;
use phytomer_law::condition::formula;
use phytomer_law::fault::{Fault, Path};
use phytomer_models::shapes::{Named, ShapeOrName, one};
use phytomer_sim::management::{Act, Choice, Kept, Management, Operation, Region, SharedFormula, Start, Thing, When};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The share of its life on the plant from which a fruit is ripe, where a harvest states none.
const RIPE: f64 = 0.9;

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
    /// A condition on the plant, such as `"height_m > 2"`: it is done for the first time when this holds. Asked at each
    /// tick from `tick` or `age` on, from the first if neither is given.
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
}

/// What is done to plants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Work {
    /// Axes are shortened.
    Heading,
    /// Branches are taken off where they arise.
    Thinning,
    /// Everything above a height is taken.
    Topping,
    /// Everything beyond planes, outside a box or outside a shape is taken.
    Hedging,
    /// The trunk, and every other axis of its order, is cut above a height or above a node.
    Stumping,
    /// Whole plants are taken.
    Removal,
    /// Fruits are picked so that the others have more.
    FruitThinning,
    /// Ripe fruits are picked, or everything above a height is taken.
    Harvest,
}

impl Work {
    /// The word in files.
    const fn word(self) -> &'static str {
        match self {
            Self::Heading => "heading",
            Self::Thinning => "thinning",
            Self::Topping => "topping",
            Self::Hedging => "hedging",
            Self::Stumping => "stumping",
            Self::Removal => "removal",
            Self::FruitThinning => "fruit_thinning",
            Self::Harvest => "harvest",
        }
    }

    /// What its conditions choose among.
    const fn thing(self) -> Thing {
        match self {
            Self::FruitThinning | Self::Harvest => Thing::Fruit,
            Self::Removal => Thing::Plant,
            _ => Thing::Wood,
        }
    }

    /// Lists of keys of which each asks for exactly one, and the keys that are allowed beside them.
    const fn keys(self) -> (&'static [&'static str], &'static [&'static str]) {
        const CHOICE: &[&str] = &["only", "protect", "first", "share", "at_most"];
        match self {
            Self::Heading => (&["keep_nodes", "keep_share", "keep_length_m"], CHOICE),
            Self::Thinning | Self::FruitThinning => (&[], CHOICE),
            Self::Topping => (&["height_m"], CHOICE),
            Self::Hedging => (&["planes", "box_m", "shape"], CHOICE),
            Self::Stumping => (&["height_m", "keep_nodes"], &["protect"]),
            Self::Removal => (&[], &["protect", "first", "share", "at_most"]),
            Self::Harvest => {
                (&[], &["only", "protect", "first", "share", "at_most", "ripe_share", "harvest_cut_height"])
            }
        }
    }
}

impl Event {
    /// The event in a few words: what, when, and on which parts.
    pub fn in_words(&self) -> String {
        let start = match (self.tick, self.age) {
            (Some(tick), _) => format!(" at tick {tick}"),
            (None, Some(age)) => format!(" at age {age}"),
            (None, None) => String::new(),
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
        ];
        all.into_iter().filter(|(_, stated)| *stated).map(|(key, _)| key).collect()
    }

    /// The operation that the event asks for.
    ///
    /// # Errors
    /// The faults of its keys, of its times in a run to the tick `until`, of its conditions and of its shape.
    fn operation(&self, until: u32, shapes: &Named, path: &Path) -> Result<Operation, Vec<Fault>> {
        let mut faults = Vec::new();
        self.check_keys(path, &mut faults);
        self.check_times(until, path, &mut faults);
        let mut read = |text: &Option<String>, key: &str, thing: Thing| -> Option<SharedFormula> {
            let read = formula(text.as_deref()?, thing, &path.key(key));
            read.map_err(|fault| faults.push(fault)).ok()
        };
        let condition = read(&self.when, "when", Thing::Plant);
        let plants = read(&self.plants, "plants", Thing::Plant);
        let thing = if self.harvest_cut_height.is_some() { Thing::Wood } else { self.operation.thing() };
        let [only, protect, first] =
            [(&self.only, "only"), (&self.protect, "protect"), (&self.first, "first")].map(|(t, k)| read(t, k, thing));
        let shape = self.shape.as_ref().map(|shape| one(shape, shapes, &path.key("shape"), &mut faults));
        // A named shape with faults is told where it is stated.
        if !faults.is_empty() || shape == Some(None) {
            return Err(faults);
        }
        let hedged = shape.flatten().map_or_else(|| self.hedged(), Region::Outside);
        let start = match (self.tick, self.age) {
            (Some(tick), _) => Start::Tick(tick),
            (None, age) => Start::Age(age.unwrap_or(1)),
        };
        let when = When { start, condition, every: self.every, last: self.until };
        let choice = Choice { only, protect, first, share: self.share, most: self.at_most };
        Ok(Operation { act: self.act(hedged), when, plants, choice })
    }

    /// What a checked event does; as a hedge it clears `hedged`.
    fn act(&self, hedged: Region) -> Act {
        let above = |height: Option<f64>| Region::Above(height.unwrap_or(f64::MAX));
        match self.operation {
            Work::Heading => Act::Head(match (self.keep_nodes, self.keep_share, self.keep_length_m) {
                (Some(nodes), _, _) => Kept::Nodes(nodes),
                (_, Some(share), _) => Kept::Share(share),
                (.., length) => Kept::Length(length.unwrap_or(f64::MAX)),
            }),
            Work::Thinning => Act::Thin,
            Work::Topping => Act::Clear(above(self.height_m), u8::MAX),
            Work::Hedging => Act::Clear(hedged, u8::MAX),
            Work::Stumping => match self.keep_nodes {
                Some(nodes) => Act::Stump(nodes),
                None => Act::Clear(above(self.height_m), 1),
            },
            Work::Removal => Act::Remove,
            Work::FruitThinning => Act::ThinFruits,
            Work::Harvest => match self.harvest_cut_height {
                Some(height) => Act::Mow(height / 100.0),
                None => Act::Harvest(self.ripe_share.unwrap_or(RIPE)),
            },
        }
    }

    /// What a hedge without a shape of its own clears.
    fn hedged(&self) -> Region {
        let planes = || Region::Outside(Arc::new(Plane::before_all(&self.planes)));
        self.box_m.map_or_else(planes, Region::outside_box)
    }
}

impl Scenario {
    /// What people do to the plants of each plot. What a fault was told of is left out.
    pub fn management(&self) -> Management {
        let (path, shapes) = (Path::root(), self.site.shapes(&mut Vec::new()));
        let operations = self.event.iter().filter_map(|event| event.operation(self.ages.until, &shapes, &path).ok());
        Management::of(operations.collect())
    }

    /// The first age of a plant at which an event may cut it; `None` where no event cuts.
    pub(crate) fn first_cut(&self) -> Option<u32> {
        let last_sown = self.member.iter().map(|member| member.sown).max().unwrap_or(0);
        let fruits = |event: &&Event| event.operation.thing() == Thing::Fruit && event.harvest_cut_height.is_none();
        let age = |event: &Event| match (event.tick, event.age) {
            (Some(tick), _) => tick.saturating_sub(last_sown),
            (None, age) => age.unwrap_or(1),
        };
        self.event.iter().filter(|event| !fruits(event)).map(age).min()
    }

    /// Adds the faults of events that the schema cannot state.
    pub(super) fn check_events(&self, shapes: &Named, faults: &mut Vec<Fault>) {
        for (number, event) in self.event.iter().enumerate() {
            let path = Path::root().key("event").index(number);
            faults.extend(event.operation(self.ages.until, shapes, &path).err().into_iter().flatten());
        }
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
    use super::*;

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
]"#;
        let scenario: Scenario = toml::from_str(text).unwrap();
        assert_eq!(scenario.faults(), []);
        let management = scenario.management();
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
        ];
        assert_eq!(acts, expected);
        let starts: Vec<Start> = management.operations().iter().map(|operation| operation.when.start).collect();
        assert_eq!(starts[..3], [Start::Age(5), Start::Tick(7), Start::Age(1)]);
        // What is written is read as it was.
        let again: Scenario = toml::from_str(&toml::to_string(&scenario).unwrap()).unwrap();
        assert_eq!(again, scenario);
    }
}
