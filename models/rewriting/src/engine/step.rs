//! A derivation step: every module is rewritten at once, from the string as it stood before.
//!
//! Only modules that a production may rewrite are visited. Where no production looks at contexts, what a module becomes
//! takes its place at once, for nothing looks back at it; else all successors are made first. A step's length is summed
//! before it is made where it is known beforehand, and as it is made elsewhere, and a string that would be too long is
//! told. `%` cuts at the end.

use super::choose::{Frames, choose};
use super::context::{Anchor, bind};
use super::cut::cut;
use super::expand::{Expansion, Root};
use super::pieces::{Moment, Pieces};
use crate::code::{Act, Item, Rule, Rules, Script};
use crate::derived::Derived;
use crate::draws::{Draws, For};
use crate::evaluate::{Machine, Result, halt};
use crate::fault::Place;
use crate::outside::Outside;
use crate::string::{Identity, ModuleString, Slot};
use crate::symbol::{CLOSE, CUT, OPEN};
use phytomer_sim::key::LineageKey;
use phytomer_sim::random::PlantRandom;

/// The most that a derivation may come to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub modules: usize,
    pub rounds: u64,
}

/// The string of the axiom, with its decomposition.
pub(crate) fn sow(script: &Script, derived: &mut Derived, outside: &dyn Outside, bounds: Bounds) -> Result<()> {
    let random = derived.random.clone();
    run_block(script, &script.start, derived, outside, bounds)?;
    let mut pieces = Pieces::default();
    let mut machine = machine(script, derived, outside, &random, bounds);
    machine.draws.turn_to(LineageKey::SEED, 0, For::Rewriting);
    let seed = Identity { key: LineageKey::SEED, birth: 0, predecessor: LineageKey::SEED };
    let axiom = axiom_rule(script);
    pieces.make(&axiom, &mut machine, &[], &[seed], Moment { step: 0, depth: 0 })?;
    if pieces.pieces.len() > bounds.modules {
        let place = script.axiom.first().map_or(Place::default(), |made| made.place);
        return halt(place, format!("the axiom has more than {} modules", bounds.modules), "a shorter axiom");
    }
    let Derived { string, active, .. } = derived;
    let mut last = None;
    let mut brackets = Vec::new();
    let is_active = active_kinds(script);
    for piece in &pieces.pieces {
        let slot = string.insert(last, piece.kind, pieces.of(piece), piece.identity);
        pair(string, &mut brackets, slot);
        if is_active.get(usize::from(piece.kind.0)) == Some(&true) || piece.kind == CUT {
            active.push(slot);
        }
        last = Some(slot);
    }
    rewrite(script, derived, outside, bounds, false)
}

/// Makes a step.
pub(crate) fn step(script: &Script, derived: &mut Derived, outside: &dyn Outside, bounds: Bounds) -> Result<()> {
    derived.step = derived.step.saturating_add(1);
    run_block(script, &script.start_each, derived, outside, bounds)?;
    rewrite(script, derived, outside, bounds, true)?;
    run_block(script, &script.end_each, derived, outside, bounds)
}

/// Carries out a block of the file.
pub(crate) fn run_block(
    script: &Script,
    acts: &[Act],
    derived: &mut Derived,
    outside: &dyn Outside,
    bounds: Bounds,
) -> Result<()> {
    let random = derived.random.clone();
    let mut machine = machine(script, derived, outside, &random, bounds);
    machine.draws.turn_to(LineageKey::SEED, machine.step, For::Block);
    machine.run(acts, &mut [])
}

fn machine<'m>(
    script: &'m Script,
    derived: &'m mut Derived,
    outside: &'m dyn Outside,
    random: &'m PlantRandom,
    bounds: Bounds,
) -> Machine<'m> {
    let (functions, arrays) = (&script.functions, &script.arrays);
    let step = derived.step;
    let draws = Draws::new(random);
    Machine { functions, arrays, outside, variables: &mut derived.variables, draws, step, rounds: bounds.rounds }
}

/// The axiom as what becomes of the seed.
fn axiom_rule(script: &Script) -> Rule {
    Rule {
        place: Place::default(),
        left: Box::default(),
        strict: Box::default(),
        right: Box::default(),
        before: Box::default(),
        condition: None,
        after: Box::default(),
        successor: script.axiom.clone(),
        weight: None,
        locals: 0,
    }
}

/// For each kind whether a step visits its modules.
fn active_kinds(script: &Script) -> Vec<bool> {
    let rules = [&script.rewriting, &script.decomposition];
    let most = rules.iter().map(|rules| rules.by_kind.len()).max().unwrap_or(0);
    let of = |kind: usize| rules.iter().any(|rules: &&Rules| rules.by_kind.get(kind).is_some_and(|list| !list.is_empty()));
    (0..most).map(of).collect()
}

/// What is to become of a module and, with several in a predecessor, of those behind it.
struct Change {
    slot: Slot,
    /// How many modules are rewritten; 0 where the module stays as it is.
    rewritten: u32,
    pieces: std::ops::Range<u32>,
}

/// A step on its way.
struct Rewriting<'r> {
    script: &'r Script,
    is_active: Vec<bool>,
    /// Whether productions rewrite, or the axiom is decomposed alone.
    rewrites: bool,
    expansion: Expansion,
    frames: Frames,
    own: Pieces,
    made: Pieces,
    brackets: Vec<Slot>,
    active: Vec<Slot>,
    cuts: Vec<Slot>,
    /// The length to which the string comes, and the most.
    length: usize,
    parameters: usize,
    most: usize,
}

fn rewrite(script: &Script, derived: &mut Derived, outside: &dyn Outside, bounds: Bounds, rewrites: bool) -> Result<()> {
    let random = derived.random.clone();
    let before = std::mem::take(&mut derived.active);
    let looks = script.rewriting.looks || script.decomposition.looks;
    let mut rewriting = Rewriting {
        script,
        is_active: active_kinds(script),
        rewrites,
        expansion: Expansion::default(),
        frames: Frames::default(),
        own: Pieces::default(),
        made: Pieces::default(),
        brackets: Vec::new(),
        active: Vec::with_capacity(before.len()),
        cuts: Vec::new(),
        length: derived.string.len(),
        parameters: derived.string.parameter_count(),
        most: bounds.modules,
    };
    let mut string = std::mem::replace(&mut derived.string, ModuleString::new(&[]));
    let mut machine = machine(script, derived, outside, &random, bounds);
    let result = rewriting.reserve(&before, &mut string).and_then(|()| {
        if looks { rewriting.all_at_once(&before, &mut string, &mut machine) } else { rewriting.one_by_one(&before, &mut string, &mut machine) }
    });
    let Rewriting { mut active, cuts, .. } = rewriting;
    derived.cut.clear();
    if !cuts.is_empty() {
        cut(&mut string, &cuts, &mut derived.cut);
        active.retain(|&slot| !string.is_free(slot));
    }
    derived.string = string;
    derived.active = active;
    result
}

impl Rewriting<'_> {
    /// Sums the length of the step, where each module has one production that always applies, and makes room for it.
    fn reserve(&self, before: &[Slot], string: &mut ModuleString) -> Result<()> {
        let rules = &self.script.rewriting;
        if !self.rewrites || !self.script.decomposition.rules.is_empty() {
            return Ok(());
        }
        let certain = |kind: usize| {
            let rule = rules.by_kind.get(kind)?.first().map(|&rule| &rules.rules[rule as usize])?;
            rule.is_certain().then_some(rule)
        };
        let by_kind: Vec<Option<&Rule>> = (0..rules.by_kind.len()).map(certain).collect();
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

    fn one_by_one(&mut self, before: &[Slot], string: &mut ModuleString, machine: &mut Machine<'_>) -> Result<()> {
        let mut skipped = 0;
        for (number, &slot) in before.iter().enumerate() {
            if skipped > 0 {
                skipped -= 1;
                continue;
            }
            self.made.clear();
            let change = self.change(slot, string, machine)?;
            skipped = also_rewritten(&change, &before[number + 1..], string);
            self.carry_out(&change, string);
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
            self.carry_out(change, string);
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
        if self.rewrites {
            machine.draws.turn_to(identity.key, step, For::Rewriting);
            let script = self.script;
            let fits = |rule: &Rule, machine: &mut Machine<'_>, frame: &mut [f64]| fits(rule, script, string, slot, machine, frame);
            if let Some(rule) = choose(rules, rules.of(string.kind(slot)), machine, &mut self.frames, fits)? {
                self.length = (self.length + rule.successor.len()).saturating_sub(rule.strict.len());
                self.parameters += rule.successor.iter().map(|made| made.arguments.len()).sum::<usize>();
                if self.length > self.most || self.parameters > 8 * self.most {
                    return self.too_long(rule);
                }
                machine.run(&rule.after, &mut self.frames.frame)?;
                rewritten = rule.strict.len() as u32;
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
            let replaced = self.decompose(anchor, machine)?;
            // A module that neither production nor decomposition touches stays as it is.
            if rewritten == 0 && !replaced {
                return Ok(Change { slot, rewritten: 0, pieces: start..start });
            }
            rewritten = rewritten.max(1);
        }
        Ok(Change { slot, rewritten, pieces: start..self.made.pieces.len() as u32 })
    }

    /// Appends the decomposition of what a production has made; tells whether anything was decomposed.
    fn decompose(&mut self, anchor: Anchor<'_>, machine: &mut Machine<'_>) -> Result<bool> {
        let root = Root { anchor, purpose: For::Decomposition, step: machine.step, most: self.most };
        let (before, start) = (self.own.pieces.len(), self.made.pieces.len());
        self.expansion.begin(&self.own);
        let (length, parameters, most) = (&mut self.length, &mut self.parameters, self.most);
        *length = length.saturating_sub(before);
        let (made, mut replaced) = (&mut self.made, false);
        self.expansion.run(&self.script.decomposition, &root, machine, |piece, values, depth| {
            replaced |= depth > 0;
            *length += 1;
            *parameters += if depth > 0 { values.len() } else { 0 };
            if *length > most || *parameters > 8 * most {
                let problem = format!("the string has more than {most} modules, or eight times as many parameters");
                return halt(Place::default(), problem, "a decomposition that ends sooner");
            }
            made.push(piece.kind, values, piece.identity);
            Ok(())
        })?;
        if self.made.pieces.len() - start != before {
            replaced = true;
        }
        if !replaced && !self.rewrites {
            self.made.pieces.truncate(start);
        }
        Ok(replaced)
    }

    /// Puts what a module has become in its place.
    #[inline]
    fn carry_out(&mut self, change: &Change, string: &mut ModuleString) {
        let slot = change.slot;
        if change.rewritten == 0 {
            if string.kind(slot) == CUT {
                self.cuts.push(slot);
            } else {
                self.active.push(slot);
            }
            return;
        }
        for _ in 1..change.rewritten {
            if let Some(next) = string.after(slot) {
                string.remove(next);
            }
        }
        let pieces = &self.made.pieces[change.pieces.start as usize..change.pieces.end as usize];
        let mut last = None;
        for piece in pieces {
            let values = self.made.of(piece);
            let at = match last {
                None => {
                    string.rewrite(slot, piece.kind, values, piece.identity);
                    slot
                }
                Some(_) => string.insert(last, piece.kind, values, piece.identity),
            };
            last = Some(at);
            match piece.kind {
                OPEN | CLOSE => pair(string, &mut self.brackets, at),
                CUT => self.cuts.push(at),
                _ => {}
            }
            if self.is_active.get(usize::from(piece.kind.0)) == Some(&true) {
                self.active.push(at);
            }
        }
        if last.is_none() {
            string.remove(slot);
        }
    }
}

/// Whether the predecessor and the contexts of a production are there.
#[inline]
fn fits(
    rule: &Rule,
    script: &Script,
    string: &ModuleString,
    slot: Slot,
    machine: &mut Machine<'_>,
    frame: &mut [f64],
) -> Result<bool> {
    let mut last = slot;
    for (number, item) in rule.strict.iter().enumerate() {
        let Item::Module(kind, first) = *item else { return Ok(false) };
        if number > 0 {
            let Some(next) = string.after(last) else { return Ok(false) };
            last = next;
        }
        if string.kind(last) != kind {
            return Ok(false);
        }
        bind(string.parameters(last), first, frame);
    }
    if rule.left.is_empty() && rule.right.is_empty() {
        return Ok(true);
    }
    Anchor { script, string, first: slot, last }.holds(rule, machine, frame)
}

/// The identities of the modules of a predecessor of several, and the last of them; none of a predecessor of one.
fn predecessors(rule: &Rule, string: &ModuleString, slot: Slot, last: &mut Slot, parameters: &mut usize) -> Vec<Identity> {
    *parameters = parameters.saturating_sub(string.parameters(slot).len());
    if rule.strict.len() < 2 {
        return Vec::new();
    }
    let mut identities = vec![string.identity(slot)];
    for _ in 1..rule.strict.len() {
        let Some(next) = string.after(*last) else { break };
        *last = next;
        *parameters = parameters.saturating_sub(string.parameters(next).len());
        identities.push(string.identity(next));
    }
    identities
}

/// How many of the next modules to visit are rewritten with this one.
fn also_rewritten(change: &Change, next: &[Slot], string: &ModuleString) -> usize {
    let (mut at, mut count) = (change.slot, 0);
    for _ in 1..change.rewritten {
        let Some(after) = string.after(at) else { break };
        at = after;
        count += usize::from(next.get(count) == Some(&at));
    }
    count
}

/// Makes brackets partners as they come.
fn pair(string: &mut ModuleString, open: &mut Vec<Slot>, slot: Slot) {
    match string.kind(slot) {
        OPEN => open.push(slot),
        CLOSE => {
            if let Some(partner) = open.pop() {
                string.pair(partner, slot);
            }
        }
        _ => {}
    }
}
