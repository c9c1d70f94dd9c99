//! The laws of the end of an apex: relays, forks and traumatic reiteration.
//!
//! De Reffye 1988 §2: sympodial growth and traumatic reiteration. These laws are evaluated at the end of an axis, where
//! there is no rank. Absent: the axes themselves, which `buds::node` adds.

use super::branching::{Branching, MOST_BUDS};
use super::compiler::{Compiler, LONGEST};
use super::words::{Layout, Number};
use crate::buds::params::{ApexEnd, Fork, Order};
use crate::law::{CountTable, ProbabilityTable, VariateTable};

/// The laws of the end of an apex of an order.
#[derive(Debug, Clone)]
pub struct EndLaws {
    /// The number of words of a record in the relay stream.
    pub width: usize,
    relayed: [bool; 3],
    /// How many nodes below the last one the relays stand; drawn once for all of them.
    pub below: Number,
    pub relay: Branching,
    pub traumatic: Branching,
    /// The axes into which a completed apex divides; `None`: it does not divide.
    pub fork: Option<Branching>,
    /// The ticks for which the branch of a completed apex lives on.
    pub persists: Option<Number>,
}

impl EndLaws {
    /// Compiles the laws of the ends of an order. Its nodes have at most `most_buds` axillary buds; its relays without
    /// an angle of their own are inserted as an axis of the order, a trunk at `seed_angle`.
    pub fn compile(order: &Order, most_buds: u32, seed_angle: &VariateTable, compiler: &mut Compiler) -> Self {
        let mut layout = Layout::default();
        let relay = relay(order, seed_angle, compiler, &mut layout);
        let traumatic = traumatic(order, most_buds, compiler, &mut layout);
        let below = compiler.count(&order.relay.below, "relay.below", LONGEST);
        let below = layout.number(below, 1);
        let fork = order.apex.fork.as_ref().map(|of| fork(of, compiler, &mut layout));
        let persists = order.apex.persists.as_ref().map(|ticks| compiler.count(ticks, "apex.persists", LONGEST));
        let on = |end: ApexEnd| order.relay.on.contains(&end);
        Self {
            relayed: [on(ApexEnd::Death), on(ApexEnd::Flower), on(ApexEnd::Completed)],
            below,
            relay,
            traumatic,
            fork,
            persists: persists.map(|ticks| layout.number(ticks, 1)),
            width: layout.width(),
        }
    }

    /// Whether an apex is relayed after some kind of end.
    pub fn is_ever_relayed(&self) -> bool {
        self.relayed.contains(&true)
    }

    /// Whether an apex with this kind of end is relayed.
    pub fn is_relayed(&self, end: ApexEnd) -> bool {
        self.relayed[end as usize]
    }
}

fn relay(order: &Order, seed_angle: &VariateTable, compiler: &mut Compiler, words: &mut Layout) -> Branching {
    let relay = &order.relay;
    let count = compiler.places(&relay.count, "relay.count", MOST_BUDS);
    let chance = compiler.probability(&relay.probability, "relay.probability");
    let delay = compiler.count(&relay.delay, "relay.delay", LONGEST);
    let angle = match &relay.insertion_deg {
        Some(angle) => compiler.angle(angle, "relay.insertion_deg"),
        None if relay.on.is_empty() && !order.transition.iter().any(|passage| passage.relayed) => {
            VariateTable::always(0.0)
        }
        None if compiler.order_number() == 1 => seed_angle.clone(),
        None => compiler.insertion_of_relays(&order.insertion_deg),
    };
    let state = relay.state.as_ref().map(|state| compiler.state(state, "relay.state"));
    Branching::new(words, count, chance, delay, angle, state)
}

fn fork(fork: &Fork, compiler: &mut Compiler, words: &mut Layout) -> Branching {
    let count = compiler.places(&fork.axes, "apex.fork.axes", MOST_BUDS);
    let angle = compiler.angle(&fork.insertion_deg, "apex.fork.insertion_deg");
    let always = ProbabilityTable::certain_or_never(true);
    Branching::new(words, count, always, CountTable::always(0), angle, None)
}

fn traumatic(order: &Order, most_buds: u32, compiler: &mut Compiler, words: &mut Layout) -> Branching {
    let traumatic = &order.traumatic;
    let chance = compiler.probability(&traumatic.probability, "traumatic.probability");
    let most = CountTable::always(if chance.is_never() { 0 } else { most_buds });
    let delay = compiler.count(&traumatic.delay, "traumatic.delay", LONGEST);
    let angle = compiler.angle(&traumatic.insertion_deg, "traumatic.insertion_deg");
    let state = traumatic.state.as_ref().map(|state| compiler.state(state, "traumatic.state"));
    Branching::new(words, most, chance, delay, angle, state)
}
