//! The organs of a node: its leaves, and flowers with the fruits that they set.
//!
//! An organ has its end from its birth on: that of its life, of the season, or of the pest that eats it. Absent: the
//! fall of branches, with which organs fall too (`sim::shed`).

use super::compile::{LeafFall, PLACE_OF_EATEN_FLOWERS, PLACE_OF_EATEN_FRUITS, PLACE_OF_EATEN_LEAVES};
use super::grow::Axis;
use super::lives::{Bloom, FlowerSite, TERMINAL, fall_of_year, fall_when, first_end, flower_fall, leaf_fall};
use crate::law::At;
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{NewOrgan, NodeId};

impl Axis<'_> {
    /// Adds a leaf to the node that is being dressed.
    pub(super) fn leaf(&mut self, node: NodeId, nth: u32, azimuth: f32, at: At) {
        let laws = &self.laws.node;
        let words = &self.words.on_node;
        let life = laws.leaf_life.as_ref().map(|life| life.draw(words, nth, at));
        let seasonal = laws.leaf_fall.as_ref().map_or(NEVER, |fall| match fall {
            LeafFall::OfYear(year, fall) => fall_of_year(*year, fall.draw(words, nth, at), self.tick),
            LeafFall::When(falls) => fall_when(falls, self.tick),
        });
        let own = leaf_fall(seasonal, self.tick, life);
        let eaten = self.eaten(|exposure| &exposure.leaf, self.tick, PLACE_OF_EATEN_LEAVES + nth);
        let (death, cause) = first_end(own, eaten);
        let words = &self.words.on_node;
        let (length, width) = (laws.leaf.length.draw(words, nth, at), laws.leaf.width.draw(words, nth, at));
        let leaf = self.plant.add_organ(NewOrgan {
            node,
            kind: laws.leaf.kind,
            position: nth as u16,
            birth: self.tick,
            death,
            cause,
            form: laws.leaf.form,
            length,
            width,
            area: length * width * laws.leaf.area_share.draw(words, nth, at),
            azimuth,
            insertion: laws.leaf.insertion.draw(words, nth, at),
        });
        self.lay_leaf(leaf);
    }

    /// Adds a lateral flower, where it opens.
    pub(super) fn lateral_flower(&mut self, node: NodeId, nth: u32, azimuth: f32, at: At) {
        let laws = &self.laws.node;
        if laws.flower_opens.happens(&self.words.on_node, nth, at) {
            let birth = self.tick.saturating_add(laws.flower_delay.draw(&self.words.on_node, nth, at));
            self.flower(FlowerSite { node, nth, birth, azimuth, position: nth as u16 }, at);
        }
    }

    /// Adds the flower that an apex has become, on the last node of its axis. The apex is spent when the flower and its
    /// fruit have fallen.
    pub(super) fn terminal_flower(&mut self) {
        let Some(node) = self.own_last_node() else {
            return;
        };
        // The flower uses the record of the node that this bud will never make.
        self.read_node();
        let at = self.at(self.plant.nodes.unit_rank[node.index()].into());
        let past = self.flower(FlowerSite { node, nth: 0, birth: self.tick, azimuth: 0.0, position: TERMINAL }, at);
        self.plant.axes.spent[self.bud.axis.index()] = past;
    }

    /// Adds a flower, and the fruit that it may set. Returns the tick at which the last of them falls.
    fn flower(&mut self, site: FlowerSite, at: At) -> Tick {
        let laws = &self.laws.node;
        let fall = flower_fall(laws, &self.words.on_node, site, at);
        let eaten = [
            self.eaten(|exposure| &exposure.flower, site.birth, PLACE_OF_EATEN_FLOWERS + site.nth),
            self.eaten(|exposure| &exposure.fruit, fall, PLACE_OF_EATEN_FRUITS + site.nth),
        ];
        let bloom = Bloom::of(laws, &self.words.on_node, site, eaten, at);
        bloom.by(self.model.until()).for_each(|organ| {
            self.plant.add_organ(organ);
        });
        bloom.end()
    }
}
