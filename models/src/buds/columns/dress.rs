//! The laws of the organs of nodes that are made at once, looked up as often as they can change from node to node, and
//! the organs that they draw.
//!
//! The formulas of one organ are those of nodes that are made one by one (`lives`).

use super::block::Block;
use super::dressing::{Borne, Dressing};
use crate::buds::compile::{
    Along, Chance, ChanceAt, LeafFall, Measure, MeasureAt, NodeLaws, Number, NumberAt, OrganLaws, Piece,
};
use crate::buds::lives::{Bloom, Drawn, FlowerSite, fall_of_year, fall_when, leaf_fall};
use crate::buds::site;
use crate::law::{At, Varies};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{NewOrgan, NodeId};

/// The laws of leaves.
pub(super) struct LeafLaws<'a> {
    laws: &'a NodeLaws,
    length: Along<'a, Measure>,
    width: Along<'a, Measure>,
    insertion: Along<'a, Measure>,
    area_share: Along<'a, Measure>,
    life: Option<Along<'a, Number>>,
    fall: Option<Fall<'a>>,
    /// How often some of them can change.
    varies: Varies,
    /// The tick at which the leaves of the growth unit appear, and that at which they all fall together; `None` where
    /// each draws it.
    birth: Tick,
    seasonal: Option<Tick>,
}

/// When leaves fall together.
enum Fall<'a> {
    OfYear(u32, Along<'a, Number>),
    When(&'a [Tick]),
}

impl<'a> LeafLaws<'a> {
    /// The laws at the first node of a block.
    pub fn of(block: &Block<'a>, first: &Piece) -> Self {
        let laws = &block.laws.node;
        let OrganLaws { length, width, insertion, area_share, .. } = &laws.leaf;
        let fall = laws.leaf_fall.as_ref().map(|fall| match fall {
            LeafFall::OfYear(year, fall) => Fall::OfYear(*year, Along::of(&**fall, first)),
            LeafFall::When(falls) => Fall::When(falls),
        });
        let mut leaf = Self {
            laws,
            length: Along::of(length, first),
            width: Along::of(width, first),
            insertion: Along::of(insertion, first),
            area_share: Along::of(area_share, first),
            life: laws.leaf_life.as_ref().map(|life| Along::of(life, first)),
            fall,
            varies: Varies::Never,
            birth: first.at.age,
            seasonal: None,
        };
        leaf.varies = leaf.varies();
        leaf
    }

    /// The tick at which all leaves of a birth fall together.
    #[inline]
    fn seasonal(&self) -> Option<Tick> {
        match &self.fall {
            None => Some(NEVER),
            Some(Fall::When(falls)) => Some(fall_when(falls, self.birth)),
            Some(Fall::OfYear(year, Along { now: NumberAt::Fixed(fall), .. })) => {
                Some(fall_of_year(*year, *fall, self.birth))
            }
            Some(Fall::OfYear(..)) => None,
        }
    }

    fn varies(&self) -> Varies {
        let Self { length, width, insertion, area_share, life, fall, .. } = self;
        let fall = match fall {
            Some(Fall::OfYear(_, fall)) => fall.varies(),
            _ => Varies::Never,
        };
        let life = life.as_ref().map_or(Varies::Never, Along::varies);
        [length, width, insertion, area_share].map(Along::varies).into_iter().fold(life.max(fall), Ord::max)
    }

    /// Goes to another growth unit.
    #[inline(always)]
    pub fn go_to(&mut self, piece: &Piece) {
        self.birth = piece.at.age;
        if self.varies > Varies::Never {
            let Self { length, width, insertion, area_share, life, fall, .. } = self;
            for measure in [length, width, insertion, area_share] {
                measure.go_to(piece);
            }
            life.iter_mut().for_each(|life| life.go_to(piece));
            if let Some(Fall::OfYear(_, fall)) = fall {
                fall.go_to(piece);
            }
        }
        self.seasonal = self.seasonal();
    }

    /// Goes to a node.
    #[inline(always)]
    pub fn stand_on(&mut self, piece: &Piece, node: usize) {
        if self.varies != Varies::ByNode {
            return;
        }
        let Self { length, width, insertion, area_share, life, fall, .. } = self;
        for measure in [length, width, insertion, area_share] {
            measure.stand_on(piece, node);
        }
        life.iter_mut().for_each(|life| life.stand_on(piece, node));
        if let Some(Fall::OfYear(_, fall)) = fall {
            fall.stand_on(piece, node);
        }
    }

    /// Writes the leaves of a node with its record.
    #[inline(always)]
    pub fn dress(
        &self,
        dressing: &mut Dressing<'_>,
        words: &[u32],
        (node, first, spacing): (NodeId, f32, f32),
        leaves: u32,
    ) {
        let Self { laws, length, width, insertion, area_share, life, fall, birth, seasonal, .. } = self;
        let birth = *birth;
        for nth in 0..leaves {
            let life = life.as_ref().map(|life| life.now.draw(words, nth));
            let seasonal = match (seasonal, fall) {
                (Some(tick), _) => *tick,
                (None, Some(Fall::OfYear(year, fall))) => fall_of_year(*year, fall.now.draw(words, nth), birth),
                (None, _) => NEVER,
            };
            let (death, cause) = leaf_fall(seasonal, birth, life);
            let (length, width) = (length.now.draw(words, nth), width.now.draw(words, nth));
            let leaf = NewOrgan {
                node,
                kind: laws.leaf.kind,
                position: nth as u16,
                birth,
                death,
                cause,
                form: laws.leaf.form,
                length,
                width,
                area: length * width * area_share.now.draw(words, nth),
                azimuth: first + spacing * nth as f32,
                insertion: insertion.now.draw(words, nth),
            };
            dressing.put(leaf);
        }
    }
}

/// The size and the direction of an organ at a point.
#[derive(Clone, Copy)]
struct OrganAt<'a> {
    length: MeasureAt<'a>,
    width: MeasureAt<'a>,
    insertion: MeasureAt<'a>,
}

impl<'a> OrganAt<'a> {
    #[inline]
    fn of(laws: &'a OrganLaws, at: &At) -> Self {
        let OrganLaws { length, width, insertion, .. } = laws;
        Self { length: length.at_point(at), width: width.at_point(at), insertion: insertion.at_point(at) }
    }

    fn varies(laws: &OrganLaws, shaded: bool) -> Varies {
        let OrganLaws { length, width, insertion, .. } = laws;
        [length, width, insertion].map(|measure| measure.varies(shaded)).into_iter().fold(Varies::Never, Ord::max)
    }
}

/// The laws of flowers and fruits.
pub(super) struct FlowerLaws<'a> {
    laws: &'a NodeLaws,
    opens: Along<'a, Chance>,
    /// Whether the laws of flowers that open can change, but for their delay, and those laws, once a flower has opened.
    vary: bool,
    now: Option<FlowerAt<'a>>,
    /// The last age of the run.
    until: Tick,
    /// The handle of the first node of the block.
    first: NodeId,
}

/// The laws of a flower that opens and of its fruit, at a point.
#[derive(Clone, Copy)]
struct FlowerAt<'a> {
    sets: ChanceAt,
    flower: OrganAt<'a>,
    flower_life: NumberAt<'a>,
    fruit: OrganAt<'a>,
    fruit_life: NumberAt<'a>,
}

impl<'a> FlowerAt<'a> {
    #[inline]
    fn of(laws: &'a NodeLaws, at: &At) -> Self {
        Self {
            sets: laws.fruit_set.at_point(at),
            flower: OrganAt::of(&laws.flower, at),
            flower_life: laws.flower_life.at_point(at),
            fruit: OrganAt::of(&laws.fruit, at),
            fruit_life: laws.fruit_life.at_point(at),
        }
    }

    fn vary(laws: &NodeLaws, shaded: bool) -> bool {
        let numbers = [&laws.flower_life, &laws.fruit_life].map(|number| number.varies());
        let organs = [&laws.flower, &laws.fruit].map(|organ| OrganAt::varies(organ, shaded));
        let mut all = numbers.into_iter().chain(organs).chain([laws.fruit_set.varies(shaded)]);
        all.any(|varies| varies > Varies::Never)
    }
}

impl<'a> FlowerLaws<'a> {
    /// The laws at the first node of a block.
    pub fn of(block: &Block<'a>, first: &Piece) -> Self {
        let laws = &block.laws.node;
        let (opens, vary) = (Along::of(&laws.flower_opens, first), FlowerAt::vary(laws, first.at.shade > 0));
        Self { laws, opens, vary, now: None, until: block.model.until(), first: block.first }
    }

    /// Goes to another growth unit.
    #[inline(always)]
    pub fn go_to(&mut self, piece: &Piece) {
        self.opens.go_to(piece);
    }

    /// Writes the flowers and fruits of a node with its record.
    #[inline(always)]
    pub fn dress(
        &mut self,
        dressing: &mut Dressing<'_>,
        words: &[u32],
        (piece, node): (&Piece, usize),
        borne: &Borne<'_>,
    ) {
        self.opens.stand_on(piece, node);
        let opens = self.opens.now;
        if opens.is_never() {
            return;
        }
        for nth in 0..borne.flowers[node] {
            if opens.happens(words, nth) {
                self.open(dressing, words, nth, (piece, node), borne);
            }
        }
    }

    /// Writes a flower and the fruit that it sets.
    #[inline(always)]
    fn open(
        &mut self,
        dressing: &mut Dressing<'_>,
        words: &[u32],
        nth: u32,
        (piece, node): (&Piece, usize),
        borne: &Borne<'_>,
    ) {
        let at = piece.at(node);
        if self.vary {
            self.now = None;
        }
        let now = self.now.get_or_insert_with(|| FlowerAt::of(self.laws, &at));
        let spacing = site::spacing(borne.flowers[node].max(borne.leaves[node]).max(borne.buds[node]));
        let place = FlowerSite {
            node: NodeId(self.first.0 + node as u32),
            nth,
            birth: at.age.saturating_add(self.laws.flower_delay.at_point(&at).draw(words, nth)),
            azimuth: borne.azimuth[node] + spacing * nth as f32,
            position: nth as u16,
        };
        let draw = |organ: &OrganAt<'_>, life: &NumberAt<'_>| Drawn {
            life: life.draw(words, nth),
            length: organ.length.draw(words, nth),
            width: organ.width.draw(words, nth),
        };
        let (flower, sets) = (draw(&now.flower, &now.flower_life), now.sets.happens(words, nth));
        let insertion = now.flower.insertion.draw(words, nth);
        let of_fruit = || draw(&now.fruit, &now.fruit_life);
        let bloom = Bloom::drawn(self.laws, (place, insertion), (flower, sets), of_fruit, [NEVER; 2]);
        let Bloom { flower, fruit } = bloom;
        if flower.birth <= self.until {
            dressing.put(flower);
        }
        if let Some(fruit) = fruit.filter(|fruit| fruit.birth <= self.until) {
            dressing.put(fruit);
        }
    }
}
