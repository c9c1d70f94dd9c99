//! Whether a growth unit touches no stem, found before its nodes are made: its internodes are drawn, and the line that
//! they take is followed.
//!
//! So an axis that has stems beside it, as each lateral has its bearer, still makes its nodes as in the open. When
//! its nodes are made, its internodes are drawn again, and are the same: each draw has a fixed place in the stream.
//! Absent: what a bud does about a stem (`contact`).

use super::grow::Axis;
use crate::law::At;
use phytomer_sim::pose::{Ahead, Onward};
use phytomer_sim::site::solids::CLEARANCE;
use phytomer_sim::site::stems::{Spared, Stems};

/// The most nodes that are drawn before they are made.
const MOST: u32 = 1_000;

impl Axis<'_> {
    /// How many nodes of a growth unit, which is decided on at a point of the laws, are soon known to touch no stem,
    /// from its first on. Of a tick the first unit alone is followed, since it grows from where the axis is posed.
    pub(super) fn nodes_past(&mut self, at: &At, (short, nodes): (bool, u32), stems: &Stems, of: Spared) -> u32 {
        let Some(start) = self.start.filter(|start| start.grown == 0.0 && nodes <= MOST) else { return 0 };
        let (bud, tick, mut line) = (self.bud, self.tick, std::mem::take(&mut self.words.line));
        self.decide_again(*at);
        let mut onward = Onward::from(&Ahead::of_bud(self.plant, bud.axis, start.node));
        let place = self.plant.place;
        let tip = |onward: &Onward| {
            let base = onward.base();
            [0, 1, 2].map(|k| place[k] + base[k])
        };
        line.begin(tip(&onward));
        let mut is_known = true;
        for rank in 1..=nodes {
            self.read_node();
            let drawn = self.draw_internode(rank, [short, false]);
            is_known &= onward.go_on(self.plant, bud.axis, drawn.trend, f64::from(drawn.length));
            line.go_on(tip(&onward), CLEARANCE + 0.5 * f64::from(drawn.diameter));
            self.bud.rank += 1;
        }
        self.bud = bud;
        self.set_tick(tick);
        let past = if is_known { stems.passed_by(&line, of) as u32 } else { 0 };
        self.words.line = line;
        past
    }
}
