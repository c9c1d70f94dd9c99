//! The plant that a string describes, in the order of the string and in the coordinates of the turtle.
//!
//! A bracket is an axis once it holds an internode or an apex; what it bears stands on the internode that was drawn
//! last before it, also where that is of an axis further down. What stands before the first internode of the trunk
//! stands on the base of that internode; where the trunk has none, on a foot of length 0, which is an internode.
//! Absent: numbers and ages (`numbers`), and the columns of a plant (`columns`).

use super::form::{Form, ViewForms};
use super::role::{Role, Roles};
use super::script::Script;
use crate::lsystem::turtle::{Command, Drawing, Frame, Turtle, Vector};
use phytomer_rewriting::{Derived, Drawn, Identity, ModuleString, Modules, Slot};
use phytomer_sim::key::LineageKey;
use phytomer_sim::plant::Kind;

/// The place of what stands before the first internode of the trunk.
pub(super) const BASE: u32 = u32::MAX;

/// An internode.
#[derive(Debug, Clone, Copy)]
pub(super) struct Internode {
    pub key: LineageKey,
    /// The key of the module of the string that it is, or that is drawn as it.
    pub module: LineageKey,
    pub axis: u32,
    /// The internode below it, or [`BASE`].
    pub below: u32,
    pub frame: Frame,
    pub length: f64,
    pub width: f64,
    /// The place of its cross section among those of the habit; `None` for a circle.
    pub section: Option<u16>,
    pub kind: Kind,
    pub colour: i32,
}

impl Internode {
    /// Where it ends.
    #[inline]
    pub fn tip(&self) -> Vector {
        let Frame { position: [x, y, z], heading, .. } = self.frame;
        [x + self.length * heading[0], y + self.length * heading[1], z + self.length * heading[2]]
    }
}

/// A leaf, a flower, a fruit, or a bud in an axil.
#[derive(Debug, Clone)]
pub(super) struct Organ {
    pub key: LineageKey,
    /// The key of the module of the string that it is, or that is drawn as it.
    pub module: LineageKey,
    /// The internode that bears it, or [`BASE`].
    pub on: u32,
    pub frame: Frame,
    pub kind: Kind,
    /// The size of what has no outline.
    pub size: f64,
    pub form: Form,
    pub colour: i32,
    /// The module that was rewritten into its module.
    pub predecessor: LineageKey,
}

/// An axis.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    /// The key of its bracket; that of the seed for the trunk.
    pub key: LineageKey,
    /// The key of the module of the string that the bracket is, or that is drawn with it.
    pub module: LineageKey,
    /// The internode that bears it, or [`BASE`].
    pub on: u32,
    pub order: u8,
    /// Its last apex, where it has one: the key of its module and its frame.
    pub apex: Option<(LineageKey, Frame)>,
}

/// A component, by its class and its place there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Item {
    Axis(usize),
    Node(usize),
    Organ(usize),
}

/// A component in the order of the string.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Placed {
    pub item: Item,
    /// Whether its module was made in the last step, so that the component never stood before.
    pub is_new: bool,
}

/// All that a string describes.
#[derive(Debug, Clone, Default)]
pub(super) struct Draft {
    pub nodes: Vec<Internode>,
    pub organs: Vec<Organ>,
    /// The trunk first.
    pub axes: Vec<Axis>,
    /// The corners of outlines, in the coordinates of the turtle.
    pub corners: Vec<Vector>,
    /// Every component but the trunk, in the order of the string.
    pub order: Vec<Placed>,
    /// The internode that bears what stands at the base: the first of the trunk, or a foot.
    pub first: Option<usize>,
    /// Whether anything stands at the base before the first internode of the trunk.
    pub has_base: bool,
}

/// What a bracket holds: its key and its module, its axis once it is one, and the internode drawn last.
#[derive(Debug, Clone, Copy)]
struct Bracket {
    key: LineageKey,
    module: Option<Slot>,
    axis: Option<u32>,
    last: u32,
}

/// A walk along the modules of a string.
pub(super) struct Walk<'w> {
    roles: &'w Roles,
    view: &'w ViewForms,
    turtle: &'w mut Turtle,
    draft: &'w mut Draft,
    open: Vec<Bracket>,
    at: Bracket,
    string: &'w ModuleString,
    /// The step that made the string.
    step: u32,
    /// The modules that come next in the string itself; `None` where each is drawn as it is, so that none is passed.
    following: Option<Modules<'w>>,
    /// The module that is passed or whose drawing is walked along, and whether the species names its kind, with its
    /// organ if it is one.
    of: Option<Slot>,
    named: Option<Option<usize>>,
}

impl<'w> Walk<'w> {
    /// A walk from the beginning of the string, for a draft that forgets what it held.
    pub fn begin(
        Script { program, roles }: &'w Script,
        view: &'w ViewForms,
        turtle: &'w mut Turtle,
        draft: &'w mut Draft,
        derived: &'w Derived,
    ) -> Self {
        turtle.restart();
        draft.clear();
        let at = Bracket { key: LineageKey::SEED, module: None, axis: Some(0), last: BASE };
        let (string, step) = (derived.string(), derived.step());
        let following = (!program.draws_its_modules()).then(|| string.modules());
        Self { roles, view, turtle, draft, open: Vec::new(), at, string, step, following, of: None, named: None }
    }

    /// Goes on by a module as it is drawn; what a query that stands there asks for.
    pub fn go_on(&mut self, drawn: &Drawn<'_>) -> Option<crate::lsystem::turtle::Query> {
        if self.following.is_none() {
            self.of = Some(drawn.of);
        } else if self.of != Some(drawn.of) {
            self.come_to(drawn);
        }
        let (command, role) = self.roles.get(drawn.symbol);
        match command {
            Command::Open => {
                self.open.push(self.at);
                self.at = Bracket { key: drawn.key, module: self.of, axis: None, last: self.at.last };
            }
            Command::Close => self.at = self.open.pop().unwrap_or(self.at),
            _ => {}
        }
        // What is drawn for a module of a stated kind is its form, and no component.
        let silent = self.named.is_some() && drawn.depth > 0;
        if !silent {
            self.state_of(role, drawn.key);
        }
        let Self { turtle, draft, view, .. } = self;
        let colour = turtle.state().colour[0];
        match turtle.follow(command, drawn.parameters)? {
            Drawing::Line { from, length, width, contour } if !silent => {
                let kind = if let Role::Internode(kind) = role { kind } else { Kind::Internode };
                let (key, frame, section) = (drawn.key, from, view.section(contour));
                let (axis, below, module) = self.place_node();
                let node = Internode { key, module, axis, below, frame, length, width, section, kind, colour };
                self.draft.nodes.push(node);
            }
            Drawing::Polygon { from, corners } => {
                let outline = draft.add_outline(corners.iter().copied());
                self.drawn_as(silent, role, drawn.key, from, outline, colour);
            }
            Drawing::Surface { symbol, scale } => {
                let place = view.surfaces.iter().position(|known| *known == symbol);
                let [across, along, above] = scale;
                let frame = turtle.state().frame;
                let form = place.map_or(Form::OfKind, |place| Form::Surface(place, [along, across, above]));
                self.drawn_as(silent, role, drawn.key, frame, form, colour);
            }
            Drawing::Query(query) => return Some(query),
            Drawing::Mark(_, size) => self.size_last(role, drawn.key, size),
            Drawing::Line { .. } => {}
        }
        None
    }

    /// The internode that was drawn last in the bracket or before it, by its place, or [`BASE`].
    pub fn bearer(&self) -> u32 {
        self.at.last
    }

    /// The turtle as it is now.
    pub fn turtle(&self) -> &Turtle {
        self.turtle
    }

    /// Ends the walk: what stands at the base is borne by the first internode of the trunk, or by a foot.
    pub fn end(mut self) {
        self.pass_to(None);
        let draft = self.draft;
        if draft.first.is_none() && draft.has_base {
            let frame = Frame::START;
            let foot = Internode {
                key: foot_key(),
                module: foot_key(),
                axis: 0,
                below: BASE,
                frame,
                length: 0.0,
                width: 0.0,
                section: None,
                kind: Kind::Internode,
                colour: 0,
            };
            draft.nodes.push(foot);
            draft.first = Some(draft.nodes.len() - 1);
        }
    }

    /// Comes to the first module that is drawn for another module of the string.
    #[inline]
    fn come_to(&mut self, drawn: &Drawn<'_>) {
        self.named = None;
        self.pass_to(Some(drawn.of));
        if drawn.depth == 0 {
            return;
        }
        let module = self.string.module(drawn.of);
        let role = self.roles.get(module.symbol).1;
        if matches!(role, Role::Apex | Role::Organ(_)) {
            let before = self.draft.organs.len();
            self.state_of(role, module.identity.key);
            self.named = Some((self.draft.organs.len() > before).then_some(before));
        }
    }

    /// Passes modules of the string up to one, or to the end: those of a stated kind stand where nothing is drawn too.
    #[inline]
    fn pass_to(&mut self, slot: Option<Slot>) {
        while let Some(passed) = self.following.as_mut().and_then(Modules::pass) {
            self.of = Some(passed);
            if self.of == slot {
                return;
            }
            let module = self.string.module(passed);
            let role = self.roles.get(module.symbol).1;
            self.state_of(role, module.identity.key);
        }
    }

    /// Whence a module comes; the seed where there is none.
    #[inline]
    fn identity(&self, module: Option<Slot>) -> Identity {
        let seed = Identity { key: LineageKey::SEED, birth: 0, predecessor: LineageKey::SEED };
        module.map_or(seed, |slot| self.string.identity(slot))
    }

    /// Puts a component that is a module, or that is drawn for it, in the order of the string.
    #[inline]
    fn place(&mut self, item: Item, of: &Identity) {
        self.draft.order.push(Placed { item, is_new: of.birth == self.step });
    }

    /// The component that a module of a stated kind is, beside what it draws; organs that draw an outline come with it.
    #[inline]
    fn state_of(&mut self, role: Role, key: LineageKey) {
        match role {
            Role::Apex => {
                let axis = self.axis();
                let apex = (self.identity(self.of).key, self.turtle.state().frame);
                self.draft.axes[axis as usize].apex = Some(apex);
            }
            Role::Organ(kind) => {
                let state = self.turtle.state();
                let (frame, size, colour) = (state.frame, state.width, state.colour[0]);
                self.add_organ(key, kind, frame, size, Form::OfKind, colour);
            }
            Role::AsDrawn | Role::Internode(_) => {}
        }
    }

    /// The axis of the bracket, which it becomes now if it was none.
    fn axis(&mut self) -> u32 {
        if let Some(axis) = self.at.axis {
            return axis;
        }
        let axis = self.draft.axes.len() as u32;
        let bearing = if self.at.last == BASE { 0 } else { self.draft.nodes[self.at.last as usize].axis };
        let order = self.draft.axes[bearing as usize].order.saturating_add(1);
        let Bracket { key, module, last: on, .. } = self.at;
        self.draft.has_base |= on == BASE;
        let module = self.identity(module);
        self.draft.axes.push(Axis { key, module: module.key, on, order, apex: None });
        self.place(Item::Axis(axis as usize), &module);
        self.at.axis = Some(axis);
        axis
    }

    /// Places an internode that is about to be added: its axis, what is below it, and its module.
    #[inline]
    fn place_node(&mut self) -> (u32, u32, LineageKey) {
        let axis = self.axis();
        let (place, module) = (self.draft.nodes.len(), self.identity(self.of));
        let below = self.at.last;
        if axis > 0 {
            self.draft.has_base |= below == BASE;
        } else if self.draft.first.is_none() {
            self.draft.first = Some(place);
        }
        self.place(Item::Node(place), &module);
        self.at.last = place as u32;
        (axis, below, module.key)
    }

    fn add_organ(&mut self, key: LineageKey, kind: Kind, frame: Frame, size: f64, form: Form, colour: i32) {
        let of = self.identity(self.of);
        self.draft.has_base |= self.at.last == BASE;
        self.place(Item::Organ(self.draft.organs.len()), &of);
        let (module, predecessor) = (of.key, of.predecessor);
        self.draft.organs.push(Organ { key, module, on: self.at.last, frame, kind, size, form, colour, predecessor });
    }

    /// A polygon or a surface: of the module of a stated kind that it is drawn for, its form; else a leaf.
    fn drawn_as(&mut self, silent: bool, role: Role, key: LineageKey, frame: Frame, form: Form, colour: i32) {
        let named = if silent { self.named.flatten() } else { None };
        let own = self.draft.organs.len().checked_sub(1).filter(|last| self.draft.organs[*last].key == key);
        match (named.or(own.filter(|_| matches!(role, Role::Organ(_)))), silent) {
            (Some(organ), _) => {
                let organ = &mut self.draft.organs[organ];
                // What is drawn first is the form.
                if !organ.form.is_drawn() {
                    (organ.form, organ.frame, organ.colour) = (form, frame, colour);
                }
            }
            (None, true) => {}
            (None, false) => self.add_organ(key, Kind::Leaf, frame, 0.0, form, colour),
        }
    }

    /// A mark gives its size to the organ that it is.
    fn size_last(&mut self, role: Role, key: LineageKey, size: f64) {
        let last = self.draft.organs.last_mut().filter(|last| last.key == key);
        if let (Role::Organ(_), Some(organ)) = (role, last) {
            organ.size = size;
        }
    }
}

impl Draft {
    fn clear(&mut self) {
        self.nodes.clear();
        self.organs.clear();
        self.axes.clear();
        self.corners.clear();
        self.order.clear();
        self.first = None;
        self.has_base = false;
        self.axes.push(Axis { key: LineageKey::SEED, module: LineageKey::SEED, on: BASE, order: 1, apex: None });
    }

    fn add_outline(&mut self, corners: impl Iterator<Item = Vector>) -> Form {
        let first = self.corners.len();
        self.corners.extend(corners);
        Form::Outline(first..self.corners.len())
    }

    /// The internodes that are lines: all but a foot, by their places.
    pub fn lines(&self) -> &[Internode] {
        let is_foot = self.nodes.last().is_some_and(|last| last.key == foot_key());
        &self.nodes[..self.nodes.len() - usize::from(is_foot)]
    }
}

/// The key of the foot of a plant whose trunk has no internode.
fn foot_key() -> LineageKey {
    LineageKey::SEED.child(u64::MAX)
}
