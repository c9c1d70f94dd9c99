//! The string of modules of one plant: symbols, parameters in one flat column, and the identity of each module.
//!
//! A module keeps its [`Slot`] as long as it lives, so that a step touches what it rewrites and nothing else, and a
//! closing bracket knows its opening one. A slot that is free is used again. Absent: which module becomes what.

use crate::links::{Links, NONE};
use crate::origins::Origins;
use crate::parameters::{Parameters, most_of};
use crate::symbol::{CLOSE, Kind, OPEN, Symbol};
use phytomer_sim::key::LineageKey;

/// Where a module is kept while it lives; no order of the string.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Slot(pub(crate) u32);

impl Slot {
    /// A number below [`ModuleString::slots`], for tables of what is known of modules.
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The slot so many places later in the columns.
    pub(crate) fn later(self, places: u32) -> Self {
        Self(self.0 + places)
    }
}

/// The kind of a slot that holds no module.
const FREE: Kind = Kind(u16::MAX);

/// Whence a module comes, and since when it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Identity {
    /// Names the module at every step, as long as it lasts.
    pub key: LineageKey,
    /// The step in which it was made; 0 for the axiom.
    pub birth: u32,
    /// The key of the module that was rewritten into it at its birth; that of the seed for the axiom.
    pub predecessor: LineageKey,
}

/// A module of a string.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Module<'s> {
    /// Where it is kept.
    pub slot: Slot,
    /// Its name.
    pub symbol: Symbol,
    /// Its parameters.
    pub parameters: &'s [f64],
    /// Its key, its birth and its predecessor.
    pub identity: Identity,
}

/// The modules of a string in their order.
#[derive(Debug, Clone)]
pub struct Modules<'s> {
    string: &'s ModuleString,
    at: u32,
}

impl Modules<'_> {
    /// Passes the next module; its slot.
    #[inline]
    pub fn pass(&mut self) -> Option<Slot> {
        let slot = (self.at != NONE).then_some(Slot(self.at))?;
        self.at = self.string.links.behind(slot.0);
        Some(slot)
    }
}

impl<'s> Iterator for Modules<'s> {
    type Item = Module<'s>;

    #[inline]
    fn next(&mut self) -> Option<Module<'s>> {
        self.pass().map(|slot| self.string.module(slot))
    }
}

/// A string of modules in its order.
#[derive(Debug, Clone)]
pub struct ModuleString {
    /// The symbol and the number of parameters of each kind.
    kinds: Box<[(Symbol, u16)]>,
    kind: Vec<Kind>,
    links: Links,
    /// Where the parameters begin; at a bracket the slot of its partner.
    first: Vec<u32>,
    key: Vec<LineageKey>,
    /// The number of its origin: predecessor and birth.
    origin: Vec<u32>,
    origins: Origins,
    parameters: Parameters,
    free: Vec<u32>,
    length: usize,
}

impl ModuleString {
    /// A string of no module. Where it is not linked `both_ways`, [`ModuleString::before`] tells nothing.
    pub(crate) fn new(kinds: &[(Symbol, u16)], both_ways: bool) -> Self {
        Self {
            kinds: kinds.into(),
            kind: Vec::new(),
            links: Links::new(both_ways),
            first: Vec::new(),
            key: Vec::new(),
            origin: Vec::new(),
            origins: Origins::default(),
            parameters: Parameters::new(most_of(kinds)),
            free: Vec::new(),
            length: 0,
        }
    }

    /// Becomes a string of no module, of these kinds, and keeps the memory.
    pub(crate) fn clear(&mut self, kinds: &[(Symbol, u16)], both_ways: bool) {
        self.kinds = kinds.into();
        self.kind.clear();
        self.links.clear(both_ways);
        self.key.clear();
        [&mut self.first, &mut self.origin, &mut self.free].into_iter().for_each(Vec::clear);
        self.origins.clear();
        self.parameters.clear(most_of(kinds));
        self.length = 0;
    }

    /// How many modules there are.
    pub fn len(&self) -> usize {
        self.length
    }

    /// How many bytes its modules take: their kinds, links, keys, origins and parameters.
    pub fn bytes(&self) -> usize {
        let of_module = size_of::<Kind>() + 2 * size_of::<u32>() + self.links.bytes_each() + size_of::<LineageKey>();
        self.length * of_module + self.parameter_count() * size_of::<f64>() + self.origins.bytes()
    }

    /// Whether there is no module.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// One more than the greatest index of a slot so far.
    pub fn slots(&self) -> usize {
        self.kind.len()
    }

    /// The modules in their order.
    pub fn modules(&self) -> Modules<'_> {
        Modules { string: self, at: self.links.ends()[0] }
    }

    /// The slots of the modules in their order.
    pub fn slots_in_order(&self) -> impl Iterator<Item = Slot> {
        let mut modules = self.modules();
        std::iter::from_fn(move || modules.pass())
    }

    /// The module in a slot that [`ModuleString::modules`] has told.
    #[inline]
    pub fn module(&self, slot: Slot) -> Module<'_> {
        let index = slot.index();
        let (symbol, _) = self.kinds[usize::from(self.kind[index].0)];
        Module { slot, symbol, parameters: self.parameters(slot), identity: self.identity(slot) }
    }

    /// The closing bracket of an opening one and the reverse; `None` for what is no bracket.
    pub fn partner(&self, slot: Slot) -> Option<Slot> {
        let kind = self.kind[slot.index()];
        (kind == OPEN || kind == CLOSE).then(|| Slot(self.first[slot.index()]))
    }

    /// Sets the first parameters of a module, as many as it has.
    pub fn set_parameters(&mut self, slot: Slot, values: &[f64]) {
        let range = self.parameter_range(slot);
        for (parameter, value) in self.parameters.values[range].iter_mut().zip(values) {
            *parameter = *value;
        }
    }

    #[inline]
    pub(crate) fn parameters(&self, slot: Slot) -> &[f64] {
        &self.parameters.values[self.parameter_range(slot)]
    }

    /// The symbol, the parameters and the key of the module in a slot.
    #[inline(always)]
    pub(crate) fn shown(&self, slot: Slot) -> (Symbol, &[f64], LineageKey) {
        let index = slot.index();
        let (symbol, arity) = self.kinds[usize::from(self.kind[index].0)];
        let first = if arity == 0 { 0 } else { self.first[index] as usize };
        (symbol, &self.parameters.values[first..first + usize::from(arity)], self.key[index])
    }

    #[inline]
    fn parameter_range(&self, slot: Slot) -> std::ops::Range<usize> {
        let index = slot.index();
        let (_, arity) = self.kinds[usize::from(self.kind[index].0)];
        let first = if arity == 0 { 0 } else { self.first[index] as usize };
        first..first + usize::from(arity)
    }

    #[inline]
    pub(crate) fn kind(&self, slot: Slot) -> Kind {
        self.kind[slot.index()]
    }

    /// Whether no module is kept in the slot any more.
    #[inline]
    pub(crate) fn is_free(&self, slot: Slot) -> bool {
        self.kind[slot.index()] == FREE
    }

    /// Whence the module in a slot comes.
    #[inline]
    pub fn identity(&self, slot: Slot) -> Identity {
        let (predecessor, birth) = self.origins.of(self.origin[slot.index()]);
        Identity { key: self.key[slot.index()], birth, predecessor }
    }

    #[inline]
    pub(crate) fn key(&self, slot: Slot) -> LineageKey {
        self.key[slot.index()]
    }

    #[inline]
    pub(crate) fn after(&self, slot: Slot) -> Option<Slot> {
        let next = self.links.behind(slot.0);
        (next != NONE).then_some(Slot(next))
    }

    #[inline]
    pub(crate) fn before(&self, slot: Slot) -> Option<Slot> {
        let previous = self.links.before(slot.0);
        (previous != NONE).then_some(Slot(previous))
    }

    pub(crate) fn first_slot(&self) -> Option<Slot> {
        self.links.ends().first().filter(|slot| **slot != NONE).map(|slot| Slot(*slot))
    }

    pub(crate) fn last_slot(&self) -> Option<Slot> {
        self.links.ends().last().filter(|slot| **slot != NONE).map(|slot| Slot(*slot))
    }

    /// How many parameters all modules have.
    pub(crate) fn parameter_count(&self) -> usize {
        self.parameters.count()
    }

    /// How many parameters the column holds, with those of no module.
    #[cfg(test)]
    pub(crate) fn parameter_column(&self) -> usize {
        self.parameters.values.len()
    }

    /// Makes room for so many modules.
    pub(crate) fn reserve(&mut self, modules: usize) {
        let more = modules.saturating_sub(self.kind.len());
        self.kind.reserve_exact(more);
        self.links.reserve(more);
        self.first.reserve_exact(more);
        self.key.reserve_exact(more);
        self.origin.reserve_exact(more);
    }

    /// Makes two brackets partners.
    pub(crate) fn pair(&mut self, open: Slot, close: Slot) {
        self.first[open.index()] = close.0;
        self.first[close.index()] = open.0;
    }

    /// Rewrites a module where it stands: another kind, parameters and identity.
    #[inline]
    pub(crate) fn rewrite(&mut self, slot: Slot, kind: Kind, values: &[f64], identity: Identity) {
        let index = slot.index();
        let arity = self.arity(self.kind[index]);
        if arity != values.len() {
            self.parameters.release(self.first[index], arity);
            self.first[index] = self.parameters.claim(values);
        } else if !values.is_empty() {
            let first = self.first[index] as usize;
            self.parameters.values[first..first + values.len()].copy_from_slice(values);
        }
        self.kind[index] = kind;
        self.key[index] = identity.key;
        self.origins.release(self.origin[index]);
        self.origin[index] = self.origins.claim(identity.predecessor, identity.birth);
    }

    /// Puts a new module behind `slot`, or before all others.
    pub(crate) fn insert(&mut self, after: Option<Slot>, kind: Kind, values: &[f64], identity: Identity) -> Slot {
        let first = self.parameters.claim(values);
        let slot = match self.free.pop() {
            Some(free) => free,
            None => {
                self.kind.push(FREE);
                self.links.add();
                self.first.push(0);
                self.key.push(identity.key);
                self.origin.push(0);
                (self.kind.len() - 1) as u32
            }
        };
        let index = slot as usize;
        (self.kind[index], self.first[index], self.key[index]) = (kind, first, identity.key);
        self.origin[index] = self.origins.claim(identity.predecessor, identity.birth);
        self.links.insert(after.map_or(NONE, |slot| slot.0), slot);
        self.length += 1;
        Slot(slot)
    }

    /// Whether modules that are put in one after the other stand one after the other in the columns: nothing is free.
    #[inline]
    pub(crate) fn is_dense(&self) -> bool {
        self.free.is_empty() && self.parameters.is_dense()
    }

    /// Puts a row of new modules behind `after`, of a string that is dense; returns the slot of the first, which the
    /// slots of the others follow. Each has its kind, its identity, and where its parameters begin in `parameters`.
    pub(crate) fn insert_row(
        &mut self,
        after: Slot,
        modules: impl ExactSizeIterator<Item = (Kind, u32, Identity)> + Clone,
        parameters: &[f64],
    ) -> Slot {
        let (count, base) = (modules.len() as u32, self.parameters.values.len() as u32);
        if count == 0 {
            return after;
        }
        self.parameters.values.extend_from_slice(parameters);
        self.kind.extend(modules.clone().map(|module| module.0));
        self.first.extend(modules.clone().map(|module| base + module.1));
        self.key.extend(modules.clone().map(|module| module.2.key));
        let origins = &mut self.origins;
        self.origin.extend(modules.map(|module| origins.claim(module.2.predecessor, module.2.birth)));
        self.length += count as usize;
        Slot(self.links.insert_row(after.0, count))
    }

    /// As [`ModuleString::insert_row`], by columns: kinds, where the parameters of each begin, and keys of at least one
    /// module. All come of one predecessor in one step, but for the one as which it goes on.
    pub(crate) fn insert_successor(
        &mut self,
        after: Slot,
        (kinds, first, keys): (&[Kind], impl Iterator<Item = u32>, impl Iterator<Item = LineageKey>),
        parameters: &[f64],
        (predecessor, birth): (LineageKey, u32),
        kept: Option<(u32, Identity)>,
    ) -> Slot {
        let (count, base) = (kinds.len() as u32, self.parameters.values.len() as u32);
        self.parameters.values.extend_from_slice(parameters);
        self.kind.extend_from_slice(kinds);
        self.first.extend(first.map(|first| base + first));
        self.key.extend(keys);
        let origin = self.origins.claim_for(predecessor, birth, count);
        self.origin.resize(self.kind.len(), origin);
        self.length += count as usize;
        let start = Slot(self.links.insert_row(after.0, count));
        if let Some((place, identity)) = kept {
            self.origins.release(origin);
            self.origin[start.later(place).index()] = self.origins.claim(identity.predecessor, identity.birth);
        }
        start
    }

    /// Takes a module out; returns the slot before it.
    pub(crate) fn remove(&mut self, slot: Slot) -> Option<Slot> {
        let index = slot.index();
        let previous = self.links.remove(slot.0);
        self.parameters.release(self.first[index], self.arity(self.kind[index]));
        self.origins.release(self.origin[index]);
        self.kind[index] = FREE;
        self.free.push(slot.0);
        self.length -= 1;
        (previous != NONE).then_some(Slot(previous))
    }

    #[inline]
    fn arity(&self, kind: Kind) -> usize {
        self.kinds.get(usize::from(kind.0)).map_or(0, |&(_, arity)| usize::from(arity))
    }

    /// Puts the parameters close together where most of their column belongs to no module.
    pub(crate) fn close_up(&mut self) {
        if !self.parameters.is_loose() {
            return;
        }
        let mut closed = self.parameters.anew();
        for slot in (0..self.kind.len() as u32).map(Slot) {
            if !self.is_free(slot) && self.arity(self.kind(slot)) > 0 {
                let first = closed.claim(self.parameters(slot));
                self.first[slot.index()] = first;
            }
        }
        self.parameters = closed;
    }
}
