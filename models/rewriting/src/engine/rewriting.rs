//! The string of a step from that before it.
//!
//! Only modules that a production may rewrite are visited. Where no production looks at contexts, what a module becomes
//! takes its place at once, for nothing looks back at it; else all successors are made first. A step's length is summed
//! before it is made where it is known beforehand, and as it is made elsewhere, and a string that would be too long is
//! told. `%` cuts at the end.

use super::bounds::{Bounds, machine};
use super::choose::{Frames, choose};
use super::context::Anchor;
use super::cut::cut;
use super::expand::{Expansion, Root};
use super::pieces::{Moment, Pieces};
use super::placing::{Change, Places, also_rewritten};
use super::predecessor::{fits, predecessors};
use super::rows;
use super::visits::{certain, update, updates, visits};
use crate::code::{Rule, Script};
use crate::derived::Derived;
use crate::draws::For;
use crate::evaluate::{Machine, Result, halt};
use crate::fault::Place;
use crate::outside::Outside;
use crate::string::{ModuleString, Slot};

/// What is done to a string.
pub(super) enum Pass {
    /// Productions rewrite it.
    Rewrites,
    /// It is the axiom, which is decomposed alone; its cuts.
    Decomposes(Vec<Slot>),
}

/// A step on its way.
struct Rewriting<'r> {
    script: &'r Script,
    /// For each kind the production that only changes its parameters, whatever stands around it.
    updates: Vec<Option<&'r Rule>>,
    /// For each kind whether all its productions make rows.
    rows: Vec<bool>,
    values: Vec<f64>,
    /// Whether productions rewrite, or the axiom is decomposed alone.
    rewrites: bool,
    expansion: Expansion,
    frames: Frames,
    own: Pieces,
    made: Pieces,
    places: Places,
    /// The length to which the string comes, and the most.
    length: usize,
    parameters: usize,
    most: usize,
}

pub(super) fn rewrite(
    script: &Script,
    derived: &mut Derived,
    outside: &dyn Outside,
    bounds: Bounds,
    pass: Pass,
) -> Result<()> {
    let (rewrites, cuts) = match pass {
        Pass::Rewrites => (true, Vec::new()),
        Pass::Decomposes(cuts) => (false, cuts),
    };
    let random = derived.random.clone();
    let (before, updated) = (std::mem::take(&mut derived.active), std::mem::take(&mut derived.updated));
    let mut active = std::mem::take(&mut derived.spare);
    active.clear();
    let looks = script.rewriting.looks || script.decomposition.looks;
    let mut rewriting = Rewriting {
        script,
        updates: updates(script, rewrites),
        rows: rows::of_kinds(script),
        values: Vec::new(),
        rewrites,
        expansion: Expansion::default(),
        frames: Frames::default(),
        own: Pieces::default(),
        made: Pieces::default(),
        places: Places { visits: visits(script), active, updated, cuts, ..Places::default() },
        length: derived.string.len(),
        parameters: derived.string.parameter_count(),
        most: bounds.modules,
    };
    let mut string = std::mem::replace(&mut derived.string, ModuleString::new(&[], false));
    let mut machine = machine(script, derived, outside, &random, bounds);
    let result = rewriting.reserve(&before, &mut string).and_then(|()| {
        if looks {
            rewriting.all_at_once(&before, &mut string, &mut machine)
        } else {
            let result = rewriting.update_all(&mut string, &mut machine);
            result.and_then(|()| rewriting.one_by_one(&before, &mut string, &mut machine))
        }
    });
    let Places { mut active, mut updated, cuts, .. } = rewriting.places;
    derived.cut.clear();
    if !cuts.is_empty() {
        cut(&mut string, &cuts, &mut derived.cut);
        active.retain(|&slot| !string.is_free(slot));
        updated.retain(|&slot| !string.is_free(slot));
    }
    string.close_up();
    (derived.string, derived.active, derived.updated, derived.spare) = (string, active, updated, before);
    result
}

impl Rewriting<'_> {
    /// Sums the length of the step, where each module has one production that always applies, and makes room for it.
    fn reserve(&self, before: &[Slot], string: &mut ModuleString) -> Result<()> {
        let rules = &self.script.rewriting;
        if !self.rewrites || !self.script.decomposition.rules.is_empty() {
            return Ok(());
        }
        let by_kind: Vec<Option<&Rule>> = (0..rules.by_kind.len()).map(|kind| certain(rules, kind)).collect();
        let mut length = string.len();
        for &slot in before {
            let Some(Some(rule)) = by_kind.get(usize::from(string.kind(slot).0)) else { return Ok(()) };
            length = (length + rule.successor.len()).saturating_sub(1);
            if length > self.most.saturating_add(rule.successor.len()) {
                return self.too_long(rule);
            }
        }
        string.reserve(length);
        Ok(())
    }

    fn too_long<T>(&self, rule: &Rule) -> Result<T> {
        let problem = format!("the string has more than {} modules, or eight times as many parameters", self.most);
        halt(rule.place, problem, "fewer steps, or fewer modules in a successor")
    }

    /// Changes the parameters of the modules of which nothing else changes.
    fn update_all(&mut self, string: &mut ModuleString, machine: &mut Machine<'_>) -> Result<()> {
        if !self.rewrites {
            return Ok(());
        }
        for &slot in &self.places.updated {
            if let Some(Some(rule)) = self.updates.get(usize::from(string.kind(slot).0)) {
                update(rule, slot, string, machine, &mut self.values)?;
            }
        }
        Ok(())
    }

    fn one_by_one(&mut self, before: &[Slot], string: &mut ModuleString, machine: &mut Machine<'_>) -> Result<()> {
        let mut skipped = 0;
        for (number, &slot) in before.iter().enumerate() {
            if skipped > 0 {
                skipped -= 1;
                continue;
            }
            if let Some(Some(rule)) = self.updates.get(usize::from(string.kind(slot).0)) {
                machine.draws.turn_to(string.key(slot), machine.step, For::Rewriting);
                update(rule, slot, string, machine, &mut self.values)?;
                self.places.active.push(slot);
                continue;
            }
            if self.rewrites && self.put_row(slot, string, machine)? {
                continue;
            }
            self.made.clear();
            let change = self.change(slot, string, machine)?;
            skipped = also_rewritten(&change, &before[number + 1..], string);
            self.places.carry_out(&change, &self.made, string);
        }
        Ok(())
    }

    fn all_at_once(&mut self, before: &[Slot], string: &mut ModuleString, machine: &mut Machine<'_>) -> Result<()> {
        self.made.clear();
        let (mut changes, mut skipped) = (Vec::with_capacity(before.len()), 0);
        for (number, &slot) in before.iter().enumerate() {
            if skipped > 0 {
                skipped -= 1;
                continue;
            }
            let change = self.change(slot, string, machine)?;
            skipped = also_rewritten(&change, &before[number + 1..], string);
            changes.push(change);
        }
        for change in &changes {
            self.places.carry_out(change, &self.made, string);
        }
        Ok(())
    }

    /// Puts what becomes of a module in its place, where all its productions make rows; tells whether they do.
    #[inline]
    fn put_row(&mut self, slot: Slot, string: &mut ModuleString, machine: &mut Machine<'_>) -> Result<bool> {
        let (script, kind) = (self.script, usize::from(string.kind(slot).0));
        if !self.rows.get(kind).copied().unwrap_or(false) {
            return Ok(false);
        }
        let (rules, identity) = (&script.rewriting, string.identity(slot));
        machine.draws.turn_to(identity.key, machine.step, For::Rewriting);
        let of_kind = rules.of(string.kind(slot));
        let seen = &*string;
        let fits =
            |rule: &Rule, machine: &mut Machine<'_>, frame: &mut [f64]| fits(rule, script, seen, slot, machine, frame);
        let chosen = choose(rules, of_kind, machine, &mut self.frames, fits)?;
        let Some((rule, row)) = chosen.and_then(|rule| Some((rule, rule.row.as_ref()?))) else {
            self.places.active.push(slot);
            return Ok(true);
        };
        self.lengthen(rule, row.values.len())?;
        machine.run(&rule.after, &mut self.frames.frame)?;
        self.parameters = self.parameters.saturating_sub(string.parameters(slot).len());
        rows::compute(rule, row, machine, &self.frames.frame, &mut self.values)?;
        rows::put(row, &self.values, (slot, identity), machine.step, string, &mut self.places);
        Ok(true)
    }

    /// Counts what a production makes, with so many parameters, in place of its predecessor.
    #[inline]
    fn lengthen(&mut self, rule: &Rule, parameters: usize) -> Result<()> {
        self.length = (self.length + rule.successor.len()).saturating_sub(rule.strict.len());
        self.parameters += parameters;
        if self.length > self.most || self.parameters > 8 * self.most {
            return self.too_long(rule);
        }
        Ok(())
    }

    /// Finds what becomes of a module: a production first, and then the decomposition of what that makes.
    #[inline]
    fn change(&mut self, slot: Slot, string: &ModuleString, machine: &mut Machine<'_>) -> Result<Change> {
        let start = self.made.pieces.len() as u32;
        let (rules, identity) = (&self.script.rewriting, string.identity(slot));
        let step = machine.step;
        let mut rewritten = 0;
        self.own.clear();
        let decomposes = !self.script.decomposition.rules.is_empty();
        let mut last = slot;
        let mut place = self.script.place();
        if self.rewrites {
            machine.draws.turn_to(identity.key, step, For::Rewriting);
            let script = self.script;
            let fits = |rule: &Rule, machine: &mut Machine<'_>, frame: &mut [f64]| {
                fits(rule, script, string, slot, machine, frame)
            };
            if let Some(rule) = choose(rules, rules.of(string.kind(slot)), machine, &mut self.frames, fits)? {
                self.lengthen(rule, rule.successor.iter().map(|made| made.arguments.len()).sum::<usize>())?;
                machine.run(&rule.after, &mut self.frames.frame)?;
                (rewritten, place) = (rule.strict.len() as u32, rule.place);
                let into = if decomposes { &mut self.own } else { &mut self.made };
                let moment = Moment { step, depth: 0 };
                let predecessors = predecessors(rule, string, slot, &mut last, &mut self.parameters);
                match &predecessors[..] {
                    [] => into.make(rule, machine, &self.frames.frame, &[identity], moment)?,
                    several => into.make(rule, machine, &self.frames.frame, several, moment)?,
                }
            }
        }
        if decomposes {
            if rewritten == 0 {
                self.own.push(string.kind(slot), string.parameters(slot), identity);
            }
            let anchor = Anchor { script: self.script, string, first: slot, last };
            let replaced = self.decompose(anchor, place, machine)?;
            // A module that neither production nor decomposition touches stays as it is.
            if rewritten == 0 && !replaced {
                self.made.pieces.truncate(start as usize);
                return Ok(Change { slot, rewritten: 0, pieces: start..start });
            }
            rewritten = rewritten.max(1);
        }
        Ok(Change { slot, rewritten, pieces: start..self.made.pieces.len() as u32 })
    }

    /// Appends the decomposition of what a production has made; tells whether anything was decomposed.
    fn decompose(&mut self, anchor: Anchor<'_>, place: Place, machine: &mut Machine<'_>) -> Result<bool> {
        let root = Root { anchor, purpose: For::Decomposition, step: machine.step, most: self.most, place };
        let (before, start) = (self.own.pieces.len(), self.made.pieces.len());
        self.expansion.begin(&self.own);
        let (length, parameters, most) = (&mut self.length, &mut self.parameters, self.most);
        *length = length.saturating_sub(before);
        let (made, mut replaced) = (&mut self.made, false);
        self.expansion.run(&self.script.decomposition, &root, machine, |piece, values, depth, place| {
            replaced |= depth > 0;
            *length += 1;
            *parameters += if depth > 0 { values.len() } else { 0 };
            if *length > most || *parameters > 8 * most {
                let problem = format!("the string has more than {most} modules, or eight times as many parameters");
                return halt(place, problem, "a decomposition that ends sooner");
            }
            made.push(piece.kind, values, piece.identity);
            Ok(())
        })?;
        Ok(replaced || self.made.pieces.len() - start != before)
    }
}
