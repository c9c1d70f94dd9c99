//! Internodes as they are drawn, each by itself: the form of each look, and how it is placed, sized and tagged.
//!
//! An internode is a closed tube, a strip where it is a blade, a tube of a cross section of its own, or the form of an
//! organ where its species says so. It stands from its birth until its branch falls; one that stands dead has the age
//! of its death. Absent: tubes that run along several internodes (`reduced`), and organs, which are the scene's.

use super::chunk::{Tag, Vertex};
use super::colour;
use super::detail::{Detail, Primitive};
use super::dress::Bark;
use super::forms::{FormMesh, Placement};
use super::lamina::{Lamina, Piece};
use super::node_leaves::{LeafOf, leaves_of_nodes};
use super::section::{Prism, Ring};
use super::tube::{Frustum, Strip, Tube};
use super::turned::{Choice, Turned};
use super::{Joints, MeshOptions};
use phytomer_looks::{Flare, Paints};
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{AxisId, InternodeLook, Kind, NodeId, Plant, Shape as Stem};
use std::ops::Range;

/// The internodes of a plant at an age, ready to be drawn.
#[derive(Debug)]
pub struct Stems<'a> {
    pub(super) plant: &'a Plant,
    pub(super) age: Tick,
    kinds: [bool; Kind::ALL.len()],
    pub(super) paints: &'a Paints,
    /// The forms by the index of their look in the habit; the last entry is for internodes without a look.
    forms: Vec<Drawn>,
    /// The forms of internodes with a cross section of their own, in the places of the sections.
    sections: Vec<Drawn>,
    /// The next node of each node's axis; empty where no internode has a section, is a piece of a smooth blade, or may
    /// end in a head.
    pub(super) next: Vec<NodeId>,
    /// What of the plant is drawn; `None`: all.
    pub(super) detail: Option<Detail>,
    /// The form of a segment that is drawn as a line.
    line: Drawn,
    /// Bark of the same density on all stems, where it is asked for.
    pub(super) bark: Option<Bark>,
    /// How the foot of the trunk widens.
    pub(super) flare: Option<Flare>,
    /// The leaf of each node, where bases of fallen leaves stay; else empty.
    pub(super) leaves: Vec<Option<LeafOf>>,
    /// The least diameter of an internode that is drawn from near, metres.
    pub(super) thin: f32,
    /// The options, for the colours that are stated for components; `None` where none are.
    coloured: Option<MeshOptions>,
}

/// An internode is drawn from near where its diameter is so many times the distance within which it is drawn.
const FINE: f32 = 12.0;

/// The sides of the tube that stands for a line.
const OF_A_LINE: u8 = 3;

/// The form of an internode.
#[derive(Debug)]
pub enum Drawn {
    /// A tube; the flag tells whether the species states the number of its sides.
    Tube(Tube, bool),
    /// A plane strip.
    Strip,
    /// A piece of a smooth blade.
    Lamina(Lamina),
    /// A tube with a cross section of its own.
    Prism(Prism),
    /// A form of an organ, with the internode's length and diameter.
    Form(FormMesh),
    /// A tube from near.
    Turned(Turned),
    /// The forms of a look from near, of which an internode has one: as afar, and those of [`Turned::each`].
    Near(Box<[Self; 4]>, Choice),
}

impl Drawn {
    fn of(look: &InternodeLook, paints: &Paints, options: &MeshOptions) -> Self {
        let paint = paints.internode(look.paint);
        let near = paints.near_stem(paint).filter(|_| options.detail > 0 && options.joints != Joints::Welded);
        match (paint.form, look.shape) {
            (Some(form), _) => Self::Form(options.shape(form).clone()),
            (None, Stem::Blade) if options.detail > 0 => Self::Lamina(Lamina::new(options.detail)),
            (None, Stem::Blade) => Self::Strip,
            (None, Stem::Cylinder | Stem::Cone) => {
                let sides = paint.sides.unwrap_or(options.sides);
                let tube = Self::Tube(Tube::new(sides), paint.sides.is_some());
                match near {
                    Some(near) => {
                        let [turned, based, headed] = Turned::each(near, sides, options.detail).map(Self::Turned);
                        Self::Near(Box::new([tube, turned, based, headed]), Choice::of(near))
                    }
                    None => tube,
                }
            }
        }
    }

    /// The number of its vertices.
    #[inline]
    pub fn vertices(&self) -> usize {
        match self {
            Self::Tube(tube, _) => tube.vertices(),
            Self::Strip => Strip::VERTICES,
            Self::Lamina(lamina) => lamina.vertices(),
            Self::Prism(prism) => prism.vertices(),
            Self::Form(shape) => shape.points.len(),
            Self::Turned(turned) => turned.vertices(),
            Self::Near(each, _) => each[0].vertices(),
        }
    }

    /// How many of its vertices, from the first on, stand around a stem.
    fn around(&self) -> usize {
        match self {
            Self::Tube(tube, _) => tube.around(),
            Self::Prism(prism) => prism.around(),
            Self::Turned(turned) => turned.around(),
            Self::Strip | Self::Lamina(_) | Self::Form(_) | Self::Near(..) => 0,
        }
    }

    /// Its triangles, by the indices of its own vertices.
    #[inline]
    pub fn faces(&self) -> &[[u32; 3]] {
        match self {
            Self::Tube(tube, _) => tube.faces(),
            Self::Strip => &Strip::FACES,
            Self::Lamina(lamina) => lamina.faces(),
            Self::Prism(prism) => prism.faces(),
            Self::Form(shape) => &shape.faces,
            Self::Turned(turned) => turned.faces(),
            Self::Near(each, _) => each[0].faces(),
        }
    }
}

impl<'a> Stems<'a> {
    /// The internodes of `plant` at `age`; its frames and diameters must be those of that age.
    pub fn of(plant: &'a Plant, age: Tick, options: &MeshOptions) -> Self {
        let looks = plant.habit.looks.internodes.iter().chain(&plant.habit.looks.apart);
        let paints = Paints::of(&plant.habit);
        let mut forms: Vec<Drawn> = looks.map(|look| Drawn::of(look, paints, options)).collect();
        forms.push(Drawn::Tube(Tube::new(options.sides), false));
        let sections: Vec<Drawn> = paints.sections().iter().map(|section| Drawn::Prism(Prism::new(section))).collect();
        let follows = |form: &Drawn| match form {
            Drawn::Near(_, choice) => choice.headed,
            form => matches!(form, Drawn::Lamina(_)),
        };
        let laminae = forms.iter().any(follows);
        let next = if sections.is_empty() && !laminae { Vec::new() } else { next_on_axis(plant) };
        let (detail, line) = (Detail::of(plant, age, options), Drawn::Tube(Tube::new(OF_A_LINE), true));
        let stated = |order| options.bark_m.map(|metres| [metres; 2]).or_else(|| options.own.textures().bark(order));
        let bark = Bark::of(plant, age, stated);
        let flare = options.own.flare().copied();
        let coloured = options.colours.is_some().then(|| options.clone());
        let based = |form: &Drawn| matches!(form, Drawn::Near(_, choice) if choice.bases.is_some());
        let leaves = if forms.iter().any(based) { leaves_of_nodes(plant) } else { Vec::new() };
        let thin = options.tolerance.map_or(0.0, |tolerance| FINE * tolerance.distance);
        let kinds = options.kinds;
        Self { plant, age, kinds, paints, forms, sections, next, detail, line, bark, flare, leaves, thin, coloured }
    }

    /// The internodes of a range of nodes that are drawn.
    pub fn drawn_of(&self, range: Range<usize>) -> impl Iterator<Item = NodeId> {
        range.map(|node| NodeId(node as u32)).filter(|node| self.plant.stands(*node, self.age) && self.shows(*node))
    }

    /// The plant.
    pub fn plant(&self) -> &'a Plant {
        self.plant
    }

    /// Whether an internode is drawn where it stands.
    #[inline]
    pub fn shows(&self, node: NodeId) -> bool {
        let detailed = |detail: &Detail| detail.stem(self.plant, node).is_some();
        self.kinds[self.plant.kind_of(node) as usize] && self.detail.as_ref().is_none_or(detailed)
    }

    /// The form of an internode.
    #[inline]
    pub(super) fn form(&self, node: NodeId) -> &Drawn {
        if self.detail.as_ref().is_some_and(|detail| detail.stem(self.plant, node) == Some(Primitive::Simple)) {
            return &self.line;
        }
        let place = self.place_of_form(node);
        match self.forms.get(place) {
            Some(Drawn::Near(each, choice)) => &each[self.variant(choice, node) as usize],
            Some(form) => form,
            None => &self.sections[place - self.forms.len()],
        }
    }

    /// The place of the form of an internode in one list of forms and sections, which a plant keeps as long as it
    /// lives.
    #[inline]
    pub fn place_of_form(&self, node: NodeId) -> usize {
        let Plant { axes, nodes, habit, own_looks, .. } = self.plant;
        if let Some(section) = own_looks.section_of(node).filter(|place| *place < self.sections.len()) {
            return self.forms.len() + section;
        }
        if let Some(apart) = own_looks.of_node(node).filter(|&place| place < habit.looks.apart.len()) {
            return habit.looks.internodes.len() + apart;
        }
        let axis: AxisId = nodes.axis[node.index()];
        let place = habit.looks.place(axes.order[axis.index()], axes.state[axis.index()]);
        place.unwrap_or(self.forms.len() - 1)
    }

    /// The cross sections of the plant, by their places.
    pub(super) fn sections(&self) -> impl Iterator<Item = &phytomer_looks::Section> {
        self.paints.sections().iter()
    }

    /// The place of the cross section that an internode is drawn with.
    pub(super) fn section_of(&self, node: NodeId) -> Option<usize> {
        self.place_of_form(node).checked_sub(self.forms.len())
    }

    /// Writes the vertices of an internode; `out` must have as many places as its form has vertices.
    #[inline]
    pub(super) fn write(&self, stem: &Drawn, node: NodeId, out: &mut [Vertex]) {
        match stem {
            Drawn::Tube(tube, _) => tube.write(&self.frustum(node), &self.tag(node), out),
            Drawn::Strip => Strip::write(&self.frustum(node), &self.tag(node), out),
            Drawn::Lamina(lamina) => lamina.write(&self.piece(node), &self.tag(node), out),
            Drawn::Prism(prism) => prism.write(self.rings(node), &self.tag(node), out),
            Drawn::Form(shape) => shape.write(&self.stands(node), &[self.tag(node); 2], out),
            Drawn::Turned(turned) => turned.write(&self.frustum(node), self.to_leaf(node), &self.tag(node), out),
            Drawn::Near(each, _) => self.write(&each[0], node, out),
        }
        if let Some(bark) = &self.bark {
            bark.dress(self.plant, node, &mut out[..stem.around()]);
        }
    }

    /// The placement of an internode that has the form of an organ.
    fn stands(&self, node: NodeId) -> Placement {
        let frame = self.plant.frames.at(node);
        let nodes = &self.plant.nodes;
        let size = [self.plant.posed_length(node), nodes.diameter[node.index()]];
        Placement { base: frame.base, heading: frame.heading, up: frame.up, size, fullness: 1.0 }
    }

    /// The rings of an internode with a section, mitred with the internodes with a section that it continues and that
    /// continues it on its axis, if there are such. On its axis it begins as that one ends; a stem that splits off is
    /// turned about, and begins with its own section.
    fn rings(&self, node: NodeId) -> [Ring; 2] {
        let own = self.frustum(node);
        let [base, tip] = [Ring::base(&own), Ring::tip(&own)];
        let nodes = &self.plant.nodes;
        let with_section = |other: &NodeId| self.plant.own_looks.section_of(*other).is_some();
        let before = nodes.parent[node.index()].some().filter(with_section);
        let end = before.map(|parent| (parent, Ring::tip(&self.frustum(parent)))).filter(|(_, end)| end.meets(&base));
        let start = match end {
            Some((parent, end)) if nodes.axis[parent.index()] == nodes.axis[node.index()] => base.after(&end),
            Some((_, end)) => base.mitred(&end),
            None => base,
        };
        let next = self.next.get(node.index()).and_then(|next| next.some()).filter(with_section);
        let next = next.map(|next| Ring::base(&self.frustum(next))).filter(|start| start.meets(&tip));
        [start, next.map_or(tip, |next| tip.mitred(&next))]
    }

    /// An internode that is a piece of a blade, with its neighbours on its axis.
    fn piece(&self, node: NodeId) -> Piece {
        let nodes = &self.plant.nodes;
        let before = nodes.parent[node.index()].some();
        let before = before.filter(|parent| nodes.axis[parent.index()] == nodes.axis[node.index()]);
        let after = self.next.get(node.index()).and_then(|next| next.some());
        let after = after.filter(|next| self.plant.stands(*next, self.age));
        Piece {
            own: self.frustum(node),
            before: before.map(|node| self.frustum(node)),
            after: after.map(|node| self.frustum(node)),
            lobed: self.lobed(node),
        }
    }

    /// An internode as a frustum.
    #[inline]
    pub fn frustum(&self, node: NodeId) -> Frustum {
        let frame = self.plant.frames.at(node);
        let (nodes, length) = (&self.plant.nodes, self.plant.posed_length(node));
        let node = node.index();
        let radii = [nodes.diameter[node] * 0.5, nodes.diameter_tip[node] * 0.5];
        Frustum { base: frame.base, heading: frame.heading, up: frame.up, length, radii }
    }

    /// The tag of an internode.
    #[inline]
    pub fn tag(&self, node: NodeId) -> Tag {
        let (look, nodes) = (self.plant.look_of_node(node), &self.plant.nodes);
        let death = self.plant.death_of(node);
        let dead = death <= self.plant.fallen_by(self.age);
        let colour = self.bark(look, node, death);
        let node = node.index();
        Tag {
            colour,
            birth: nodes.birth[node] as f32,
            death: if dead { death as f32 } else { f32::INFINITY },
            component: nodes.component[node] as i32,
            kind: look.kind(nodes.formation[node].is_short()) as u8,
        }
    }

    /// The colour of an internode.
    pub fn colour(&self, node: NodeId) -> [u8; 3] {
        let [red, green, blue, _] = self.bark(self.plant.look_of_node(node), node, self.plant.death_of(node));
        [red, green, blue]
    }

    /// The bark of an internode; between two ticks it goes from the colour at the one to that at the other.
    #[inline]
    fn bark(&self, look: &InternodeLook, node: NodeId, death: Tick) -> [u8; 4] {
        if let Some(options) = &self.coloured
            && let Some(stated) = options.colour_of(self.plant.nodes.component[node.index()])
        {
            return stated;
        }
        let birth = self.plant.nodes.birth[node.index()];
        let at = |look: &InternodeLook, age: Tick| {
            colour::wood(look.kind, &self.paints.internode(look.paint).bark, age - birth, death <= age)
        };
        match self.plant.partway() {
            Some(share) if birth < self.age => {
                let was = at(self.plant.former_look_of_node(node), self.age - 1);
                colour::between(was, at(look, self.age), share)
            }
            _ => at(look, self.age),
        }
    }
}

/// The next node of each node's axis.
fn next_on_axis(plant: &Plant) -> Vec<NodeId> {
    let nodes = &plant.nodes;
    let mut next = vec![NodeId::NONE; nodes.len()];
    for (place, (&parent, &axis)) in nodes.parent.iter().zip(&nodes.axis).enumerate() {
        if let Some(parent) = parent.some().filter(|parent| nodes.axis[parent.index()] == axis) {
            next[parent.index()] = NodeId(place as u32);
        }
    }
    next
}
