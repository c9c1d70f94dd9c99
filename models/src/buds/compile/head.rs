//! The laws of the quantities that an axis draws once, at its birth: speed, trend, the azimuth of its first leaf, the
//! number of its growth units, the time from its death to its fall.
//!
//! They are evaluated at the plant's age and the axis's state at its birth. Their words stand in one record at the head
//! of the axis's bud stream. Absent: the insertion of axes out of buds, which the bearing node or the ended axis draws.

use super::compiler::{Compiler, LONGEST};
use super::geometry::{DEGREE, first_azimuth};
use super::step::MOST_NODES;
use super::trend::Trends;
use super::words::{Layout, Measure, Number};
use crate::buds::params::Order;
use crate::law::{At, VariateTable};
use phytomer_sim::clock::Speed;
use phytomer_sim::plant::{LineageKey, Trend};
use phytomer_sim::random::{PlantRandom, Purpose};

/// The laws of the head of an axis.
#[derive(Debug, Clone)]
pub struct HeadLaws {
    /// The number of words of the record; each axis has one record, at the head of its bud stream.
    pub width: usize,
    /// Whether growth uses a word of the record, which is then read each time the axis grows on.
    pub guides_growth: bool,
    /// The growth units after which the apex ends.
    pub units: Option<Number>,
    /// The insertion of an axis out of the seed.
    pub insertion: Measure,
    pub speed: SpeedLaws,
    /// `None`: dead wood stays.
    pub shed_after: Option<Number>,
    /// The azimuth of the first leaf.
    pub first_azimuth: Measure,
    pub trends: Trends,
}

/// The speeds of which an axis draws one.
#[derive(Debug, Clone)]
pub struct SpeedLaws {
    speeds: Vec<Speed>,
    pick: Number,
}

impl HeadLaws {
    /// Compiles the laws of the head of an order; its constant trends are added to the habit's.
    pub fn compile(order: &Order, compiler: &mut Compiler, habit: &mut Vec<Trend>) -> Self {
        let mut head = Layout::default();
        let units = order.apex.units.as_ref().map(|units| compiler.count(units, "apex.units", MOST_NODES));
        let units = units.map(|table| head.number(table, 1));
        let angle = match compiler.order_number() {
            1 => compiler.angle(&order.insertion_deg, "insertion_deg"),
            _ => VariateTable::always(0.0),
        };
        let insertion = head.measure(angle, DEGREE, 1);
        let (speeds, pick) = compiler.speeds.clone().into_parts();
        let speed = SpeedLaws { speeds, pick: head.number(pick, 1) };
        let shed_after = order.shed_after.as_ref().map(|ticks| compiler.count(ticks, "shed_after", LONGEST));
        let shed_after = shed_after.map(|table| head.number(table, 1));
        let first_azimuth = head.measure(first_azimuth(order, compiler), DEGREE, 1);
        let trends = Trends::compile(&order.trend, compiler, &mut head, habit);
        let is_drawn = |number: &Number| number.fixed().is_none();
        Self {
            width: head.width(),
            guides_growth: units.as_ref().is_some_and(is_drawn) || is_drawn(&speed.pick) || trends.has_drawn_ranks(),
            units,
            insertion,
            speed,
            shed_after,
            first_azimuth,
            trends,
        }
    }

    /// The most growth units that an axis can make, in the run at hand and in a run of any length. An axis that draws 0
    /// ends with its first growth unit.
    pub fn most_units(&self) -> [u32; 2] {
        let most = |units: &Number| [units.table.max(), units.table.max_in_any_run()].map(|most| most.max(1));
        self.units.as_ref().map_or([u32::MAX; 2], most)
    }

    /// The record of the axis with lineage key `key`. It has at least one word, since a quantity without words still
    /// reads word 0 and ignores it.
    pub fn words(&self, random: &PlantRandom, key: LineageKey) -> Vec<u32> {
        let mut words = vec![0; self.width.max(1)];
        if self.width > 0 {
            random.stream(key, Purpose::Bud).read(&mut words);
        }
        words
    }
}

impl SpeedLaws {
    /// The speed of every axis, where none is drawn.
    #[inline]
    pub fn only(&self) -> Option<Speed> {
        self.pick.fixed().and_then(|pick| self.speeds.get(pick as usize).copied())
    }

    /// The speed of an axis.
    #[inline]
    pub fn draw(&self, words: &[u32]) -> Speed {
        self.speeds[self.pick.draw(words, 0, At::default()) as usize]
    }

    /// Each speed, with the share of the axes that grow at it.
    pub fn shares(&self) -> impl Iterator<Item = (Speed, f64)> {
        self.speeds.iter().copied().zip(self.pick.table.pmf(At::default()))
    }
}
