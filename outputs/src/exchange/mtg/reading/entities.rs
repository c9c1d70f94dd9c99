//! From labels to entities: classes, ranges, and where each entity hangs.

use super::super::code::{Labelled, Sign, symbol_and_index};
use super::super::header::column;
use super::{Here, MOST_RANGED, Reader};
use crate::exchange::contract::MOST_ENTITIES;
use crate::exchange::description::{Entity, Individual, Link, Role};
use crate::exchange::text::said;

impl Reader<'_> {
    /// Adds an entity of a code, or those of a range; where the code then is.
    pub(super) fn labelled(
        &mut self,
        (number, line): (usize, &str),
        Labelled { sign, label }: Labelled<'_>,
        here: Here,
        (first_column, each): (bool, &mut Vec<u32>),
    ) -> Here {
        let place = (number, column(line, label));
        let Some((symbol, index, letters)) = symbol_and_index(label) else {
            let problem = format!("the label `{}` has no number as its index", said(label));
            self.report.fault(place, problem, "a symbol and an index, such as `U12` or `U1.5`");
            return Here::Lost;
        };
        if !letters.is_empty() {
            let told = format!("the letters behind the index of `{}` are left out", said(label));
            self.report.warn((number, column(line, label)), "letters", told);
        }
        let Some(class) = self.header.class(symbol) else {
            if here == Here::Nowhere && !self.begun && first_column && !symbol.is_empty() {
                let told = format!(
                    "the root `{}` is of no declared class: it stands for the file and is left out",
                    said(label)
                );
                self.report.warn((number, 0), "", told);
                return Here::Scene;
            }
            let known: Vec<&str> = self.header.classes.iter().take(12).map(|class| class.symbol.as_str()).collect();
            let problem = format!("no class `{}` is declared", said(symbol));
            let expected = format!("one of the classes {}", known.join(", "));
            self.report.fault(place, problem, expected);
            return Here::Lost;
        };
        if here == Here::Nowhere && sign != Sign::Decomposes {
            let problem = format!("`{}` begins a plant", said(label));
            self.report.fault(place, problem, "`/` before what begins a plant, such as `/P1`");
            return Here::Lost;
        }
        match sign {
            Sign::Decomposes => self.add((number, line, label), class, index, here, None),
            Sign::Follows => self.add((number, line, label), class, index, here, Some(Link::Follows)),
            Sign::Branches => self.add((number, line, label), class, index, here, Some(Link::Branches)),
            Sign::FollowTo { each: all } => {
                let keep = all.then_some(each);
                self.range((number, line, label), (class, index), here, (Link::Follows, keep))
            }
            Sign::BranchTo { each: all } => {
                let keep = all.then_some(each);
                self.range((number, line, label), (class, index), here, (Link::Branches, keep))
            }
        }
    }

    /// Adds the entities of a range: those after `here` up to an index. `each` takes them, where all have the values.
    fn range(
        &mut self,
        (number, line, label): (usize, &str, &str),
        (class, until): (usize, Option<f64>),
        here: Here,
        (link, mut each): (Link, Option<&mut Vec<u32>>),
    ) -> Here {
        let Here::At(plant, entity) = here else { return Here::Lost };
        let from = &self.description.individuals[plant as usize].entities[entity as usize];
        let (same, first) = (from.class == self.classes[class], from.index);
        let whole = |index: Option<f64>| index.filter(|index| index.fract() == 0.0);
        let (Some(first), Some(until)) = (whole(first).filter(|_| same), whole(until)) else {
            let problem = format!("the range to `{}` has no beginning of the same class with an index", said(label));
            self.report.fault((number, column(line, label)), problem, "a range such as `E1<<E35`");
            return Here::Lost;
        };
        if until < first {
            let problem = format!("the range to `{}` goes down from {first}", said(label));
            self.report.fault((number, column(line, label)), problem, "a range that rises, such as `E1<<E35`");
            return Here::Lost;
        }
        let count = (until - first) as u64;
        self.ranged = self.ranged.saturating_add(count);
        if self.ranged > MOST_RANGED {
            let problem = format!(
                "with the range to `{}` the ranges of the file stand for {} entities",
                said(label),
                self.ranged
            );
            self.report.fault((number, column(line, label)), problem, format!("at most {MOST_RANGED}"));
            return Here::Lost;
        }
        if let Some(each) = each.as_mut() {
            each.push(entity);
        }
        let mut at = here;
        for step in 1..=count {
            at = self.add((number, line, label), class, Some(first + step as f64), at, Some(link));
            if let (Some(each), Here::At(_, added)) = (each.as_mut(), at) {
                each.push(added);
            }
        }
        at
    }

    fn add(
        &mut self,
        (number, line, label): (usize, &str, &str),
        class: usize,
        index: Option<f64>,
        here: Here,
        link: Option<Link>,
    ) -> Here {
        if self.entities == MOST_ENTITIES {
            let problem = "the file stands for too many entities";
            self.report.fault((number, column(line, label)), problem, format!("at most {MOST_ENTITIES}"));
            return Here::Lost;
        }
        let scale = self.header.classes[class].scale;
        let around = match here {
            Here::At(plant, _) if link.is_some() && self.is_plant(class) && self.begins_as_plant(plant) => {
                let told = format!("`{}` hangs on another plant; it is read as a plant by itself", said(label));
                self.report.warn((number, 0), "plants that hang together", told);
                None
            }
            Here::At(plant, entity) => {
                let individual = &self.description.individuals[plant as usize];
                let classes = &self.description.classes;
                let complex = individual.within(entity, |whole| classes[whole.class as usize].scale < scale);
                Some((plant, entity, complex)).filter(|(.., complex)| link.is_some() || complex.is_some())
            }
            Here::Lost => return Here::Lost,
            Here::Nowhere | Here::Scene => None,
        };
        self.entities += 1;
        let mut entity = Entity { index, ..Entity::of(self.classes[class]) };
        let Some((plant, from, complex)) = around else {
            self.tell_finer((number, label), scale);
            self.description.individuals.push(Individual { entities: vec![entity], ..Individual::default() });
            return Here::At(self.description.individuals.len() as u32 - 1, 0);
        };
        entity.complex = complex;
        if let Some(link) = link {
            (entity.bearer, entity.link) = (Some(from), Some(link));
        }
        let entities = &mut self.description.individuals[plant as usize].entities;
        entities.push(entity);
        Here::At(plant, entities.len() as u32 - 1)
    }

    fn is_plant(&self, class: usize) -> bool {
        self.description.classes[self.classes[class] as usize].role == Role::Plant
    }

    /// Whether what the file says of an individual begins with a plant, and not with a scene of several.
    fn begins_as_plant(&self, plant: u32) -> bool {
        let first = self.description.individuals[plant as usize].entities.first();
        first.is_some_and(|first| self.description.classes[first.class as usize].role == Role::Plant)
    }

    /// Tells of a plant that begins at a finer scale than the first: in files without `^` such a label goes on from the
    /// line above.
    fn tell_finer(&mut self, (number, label): (usize, &str), scale: u32) {
        let Some(first) = self.description.individuals.first().and_then(|plant| plant.entities.first()) else { return };
        let first = &self.description.classes[first.class as usize];
        if scale > first.scale {
            let told = format!(
                "`{}` is read as a plant, of a finer scale than the first plant ({}): where it belongs to the entity above, write \
                 `^` before it",
                said(label),
                said(&first.symbol)
            );
            self.report.warn((number, 0), "finer plant", told);
        }
    }
}
