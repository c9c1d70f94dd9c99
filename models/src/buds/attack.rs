//! What pests do to an axis: they kill its bud, weaken its growth units, eat what stands on its nodes, or kill the
//! plant whole.
//!
//! An attack joins the mortality of a bud in the same draw: with p the probability that the bud dies of itself and q
//! that of the attack, a word below p is mortality, a word between p and p + q − p q an attack. All other draws are
//! from the streams of responses, so that a plant without pests is the same to the byte. Absent: where the hazards come
//! from (`sim::plant::Exposure`).

use super::compile::{PLACE_OF_DEATH, PLACE_OF_WEAKNESS, join, nodes_times};
use super::grow::Axis;
use crate::law::{At, happens};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{ApexFate, EventKind, Exposure, Survival};

impl Axis<'_> {
    /// Whether a pest kills the bud at this step, which it has survived so far.
    pub(super) fn is_attacked(&mut self, at: At) -> bool {
        let attack = self.plant.exposure.as_ref().map_or(0.0, |exposure| exposure.apex.at(self.tick));
        if attack <= 0.0 {
            return false;
        }
        let death = &self.laws.step.death;
        let word = death.first_word(self.words.step()).unwrap_or_else(|| {
            let key = self.plant.axes.key[self.bud.axis.index()];
            self.words.of_step(&self.plant.random, key, self.bud.cycle - 1, PLACE_OF_DEATH)
        });
        happens(join(death.probability(at), attack), word)
    }

    /// Ends the axis with the whole plant, also one that a resting bud would have begun later: nothing follows its end.
    pub(super) fn die_whole(&mut self) {
        self.plant.axes.end_apex(self.bud.axis, self.whole_death, ApexFate::Attacked);
        self.plant.note_in_state(self.bud.state, self.whole_death, self.bud.axis, EventKind::Attacked, 1);
    }

    /// The preformed and neoformed nodes that a growth unit of a weakened plant makes: ⌊n m + u⌋ of each.
    pub(super) fn weakened(&mut self, unit: u32, nodes: [u32; 2]) -> [u32; 2] {
        let factor = self.plant.exposure.as_ref().map_or(1.0, |exposure| exposure.growth_at(self.tick));
        if factor == 1.0 {
            return nodes;
        }
        let key = self.plant.axes.key[self.bud.axis.index()];
        let mut place = PLACE_OF_WEAKNESS + 2 * unit;
        nodes.map(|number| {
            let word = self.words.of_step(&self.plant.random, key, self.bud.cycle - 1, place);
            place += 1;
            nodes_times(number, factor, word)
        })
    }

    /// The tick at which an organ of the node being dressed is eaten, where pests eat such organs: the word of its draw
    /// has the place `place` in the node's record of responses.
    pub(super) fn eaten(&mut self, of: fn(&Exposure) -> &Survival, birth: Tick, place: u32) -> Tick {
        let Some(exposure) = self.plant.exposure.clone() else {
            return NEVER;
        };
        let key = self.plant.axes.key[self.bud.axis.index()];
        let word = self.words.of_node(&self.plant.random, key, self.bud.rank, place);
        of(&exposure).end(birth, word)
    }
}
