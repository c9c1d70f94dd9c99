//! Organs, and internodes that are no tubes, while a life is made.
//!
//! A part has one track of its base, two directions and sizes, and one of its colour. Of the tolerance a quarter each
//! goes to the base, to what the two directions move its farthest point, and to its size. Absent: forms, which are
//! named and not made.

use super::kept::{Kept, Keyed};
use super::lists::{Blocks, Places};
use super::{Life, Nearness, Part, What};
use phytomer_looks::{Paints, Surface};
use phytomer_meshes::{Model, OwnForm, Scene, Stems};
use phytomer_sim::plant::{Kind, NodeId, OrganId, Plant};
use phytomer_sim::pose::{OrganInputs, organ_follows_from};

const NONE: u32 = u32::MAX;
/// The place of the form of a flare among those of internodes.
const FLARE: usize = usize::MAX;

/// The parts of a plant, up to the last age that was shown.
#[derive(Debug, Clone, Default)]
pub struct Parts {
    /// All of them, in the order in which they appeared.
    parts: Blocks<Part>,
    states: Places<State>,
    /// The place of each component that stands, by its number.
    of_component: Vec<u32>,
    /// The places of those that stand.
    standing: Vec<u32>,
    outlines: Vec<Vec<[f32; 3]>>,
    /// The curved surfaces that were met, with their places in the habit.
    surfaces: Vec<(usize, Surface)>,
    /// The forms of internodes that were met, with their places.
    stems: Vec<(usize, Model)>,
    /// The place of the flare of the trunk, which has the number of an internode that may be a part too.
    foot: Option<u32>,
    poses: Kept<12>,
    tints: Kept<3>,
}

#[derive(Debug, Clone)]
struct State {
    /// Its place among all parts.
    part: u32,
    component: u32,
    what: What,
    seen: f32,
    /// The extent of its outline or surface; 1 for other parts, whose sizes are metres.
    extent: f32,
    /// All that its pose followed from when it was last looked at.
    from: Option<OrganInputs>,
    pose: Keyed<12>,
    tint: Keyed<3>,
}

/// A part as it stands at an age.
struct Shown {
    pose: [f32; 12],
    tint: [f32; 3],
    /// All that its pose follows from, where that is known.
    from: Option<OrganInputs>,
}

impl Parts {
    /// Takes every organ of a scene, and some internodes.
    pub fn show(&mut self, scene: &Scene, apart: &[NodeId], age: f32, nearness: Nearness) {
        let organs = &scene.plant().organs;
        for organ in scene.organs() {
            let component = organs.component[organ.index()];
            let known = self.known_organ(scene, organ);
            let from = organ_follows_from(scene.plant(), organ, scene.age());
            if from.is_some() && self.states.get(known).is_some_and(|state| state.from == from) {
                self.hold(known, scene.organ_colours(organ), age, nearness);
                continue;
            }
            let drawn = scene.organ(organ);
            let [blade, stalk] = drawn.colours;
            let shown = Shown { pose: pose(drawn.base, drawn.heading, drawn.up, drawn.size), tint: rgb(blade), from };
            if known == NONE {
                let part = Part {
                    bearer: scene.plant().nodes.component[organs.node[organ.index()].index()],
                    axis: axis_of(scene.plant(), organs.node[organ.index()]),
                    fullness: drawn.fullness,
                    stalk: [stalk[0], stalk[1], stalk[2]],
                    what: self.what(scene, organ, drawn.own),
                    ..begun(component, organs.kind[organ.index()], organs.birth[organ.index()] as f32, age)
                };
                self.begin(part, &shown);
            } else {
                self.take(known, &shown, age, nearness);
            }
        }
        apart.iter().for_each(|node| self.show_internode(scene.stems(), *node, age, nearness));
        self.show_foot(scene.stems(), age, nearness);
        self.end_unseen(age);
    }

    /// Takes the flare of the trunk, as a part that narrows as internodes do.
    fn show_foot(&mut self, stems: &Stems, age: f32, nearness: Nearness) {
        let Some(foot) = stems.foot() else { return };
        let (frustum, colour, plant) = (foot.frustum, stems.colour(foot.node), stems.plant());
        let size = [frustum.length, 2.0 * frustum.radii[0], 2.0 * frustum.radii[1]];
        let pose = pose(frustum.base, frustum.heading, frustum.up, size);
        let shown = Shown { pose, tint: colour.map(f32::from), from: None };
        let component = plant.nodes.component[foot.node.index()];
        let known = self.foot.filter(|place| self.states.get(*place).is_some_and(|state| state.component == component));
        if let Some(known) = known {
            return self.take(known, &shown, age, nearness);
        }
        self.stems.push((FLARE, stems.flare_model(foot.node)));
        let (stem, birth) = (self.stems.len() as u32 - 1, plant.nodes.birth[foot.node.index()] as f32);
        let axis = axis_of(plant, foot.node);
        let part = Part { axis, stem, stalk: colour, ..begun(component, plant.kind_of(foot.node), birth, age) };
        let internode = self.of_component.get(component as usize).copied().unwrap_or(NONE);
        self.begin(part, &shown);
        // The number of the component names the internode, where that is a part.
        self.foot = Some(std::mem::replace(&mut self.of_component[component as usize], internode));
    }

    fn show_internode(&mut self, stems: &Stems, node: NodeId, age: f32, nearness: Nearness) {
        let frustum = stems.frustum(node);
        let size = [frustum.length, 2.0 * frustum.radii[0], 2.0 * frustum.radii[1]];
        let colour = stems.colour(node);
        let shown = Shown {
            pose: pose(frustum.base, frustum.heading, frustum.up, size),
            tint: colour.map(f32::from),
            from: None,
        };
        let plant = stems.plant();
        let component = plant.nodes.component[node.index()];
        let known = self.known(component);
        if known == NONE {
            let birth = plant.nodes.birth[node.index()] as f32;
            let (axis, stem) = (axis_of(plant, node), self.stem(stems, node));
            self.begin(Part { axis, stem, stalk: colour, ..begun(component, plant.kind_of(node), birth, age) }, &shown);
        } else {
            self.take(known, &shown, age, nearness);
        }
    }

    /// The place of the form of an internode.
    fn stem(&mut self, stems: &Stems, node: NodeId) -> u32 {
        let place = stems.place_of_form(node);
        let known = self.stems.iter().position(|(known, _)| *known == place);
        let number = known.unwrap_or_else(|| {
            self.stems.push((place, stems.model(node)));
            self.stems.len() - 1
        });
        number as u32
    }

    /// The part of a component that stands.
    fn known(&self, component: u32) -> u32 {
        let known = self.of_component.get(component as usize).copied().unwrap_or(NONE);
        let stands = self.states.get(known).is_some_and(|state| state.component == component);
        if stands { known } else { NONE }
    }

    /// The part of an organ that stands, while it has the form that it had: a model that writes its plant anew may give
    /// it another, which is another part.
    fn known_organ(&self, scene: &Scene, organ: OrganId) -> u32 {
        let plant = scene.plant();
        let known = self.known(plant.organs.component[organ.index()]);
        let Some(state) = self.states.get(known) else { return NONE };
        let surface = || plant.stated_organs.surface(organ).map(|(place, _)| place);
        let same = match state.what {
            What::Organ(form) => {
                let same = form == plant.organs.form[organ.index()] && plant.outline_of(organ).is_empty();
                same && scene.near(organ).is_none()
            }
            What::Near(form) => {
                plant.outline_of(organ).is_empty() && scene.near(organ).map(|(own, _)| own) == Some(form)
            }
            What::Outlined(outline) => plant.outline_of(organ) == self.outlines[outline as usize],
            What::Surface(number) => surface() == Some(self.surfaces[number as usize].0),
            What::Internode => false,
        };
        if same { known } else { NONE }
    }

    fn what(&mut self, scene: &Scene, organ: OrganId, own: OwnForm) -> What {
        let plant = scene.plant();
        match own {
            OwnForm::None => What::Organ(plant.organs.form[organ.index()]),
            OwnForm::Near(form) => What::Near(form),
            OwnForm::Outline => {
                let corners = plant.outline_of(organ);
                // Neighbouring organs of one kind mostly have one outline.
                if self.outlines.last().is_none_or(|last| last != corners) {
                    self.outlines.push(corners.to_vec());
                }
                What::Outlined(self.outlines.len() as u32 - 1)
            }
            OwnForm::Surface(place) => {
                let known = self.surfaces.iter().position(|(known, _)| *known == place);
                let number = known.unwrap_or_else(|| {
                    let surface = Paints::of(&plant.habit).surface(place).cloned().unwrap_or_default();
                    self.surfaces.push((place, surface));
                    self.surfaces.len() - 1
                });
                What::Surface(number as u32)
            }
        }
    }

    fn begin(&mut self, part: Part, shown: &Shown) {
        let Part { component, what, from: seen, .. } = part;
        let extent = match what {
            What::Outlined(outline) => extent_of(self.outlines[outline as usize].iter().copied()),
            What::Surface(surface) => {
                extent_of(self.surfaces[surface as usize].1.points().iter().map(|point| point.at))
            }
            What::Organ(_) | What::Near(_) | What::Internode => 1.0,
        };
        let (pose, tint) = (Keyed::begin((seen, shown.pose)), Keyed::begin((seen, shown.tint)));
        let part = self.parts.push(part);
        let place = self.states.add(State { part, component, what, seen, extent, from: shown.from, pose, tint });
        let component = component as usize;
        self.of_component.resize(self.of_component.len().max(component + 1), NONE);
        self.of_component[component] = place;
        self.standing.push(place);
    }

    /// A part stands as it stood; its colour may change.
    fn hold(&mut self, place: u32, [blade, _]: [[u8; 4]; 2], age: f32, nearness: Nearness) {
        let Some(state) = self.states.get_mut(place) else { return };
        state.seen = age;
        state.pose.hold(age);
        state.tint.take((age, rgb(blade)), &[nearness.colour; 3]);
    }

    fn take(&mut self, place: u32, shown: &Shown, age: f32, nearness: Nearness) {
        let Some(state) = self.states.get_mut(place) else { return };
        (state.seen, state.from) = (age, shown.from);
        // A quarter of the tolerance in three coordinates together.
        let part = 0.25 * nearness.distance / 3.0_f32.sqrt();
        let [length, width, tip] = [9, 10, 11].map(|k| shown.pose[k]);
        let reach = (length.max(width).max(tip) * state.extent).max(part);
        let (turn, size) = (part / reach, part / state.extent);
        let near = [part, part, part, turn, turn, turn, turn, turn, turn, size, size, size];
        state.pose.take((age, shown.pose), &near);
        state.tint.take((age, shown.tint), &[nearness.colour; 3]);
    }

    fn end_unseen(&mut self, age: f32) {
        let mut standing = std::mem::take(&mut self.standing);
        standing.retain(|place| {
            let stands = self.states.get(*place).is_some_and(|state| state.seen == age);
            if !stands {
                self.end(*place, age);
            }
            stands
        });
        self.standing = standing;
    }

    /// Ends a part at an age; its keys have their places from then on.
    fn end(&mut self, place: u32, death: f32) {
        let Some(state) = self.states.take(place) else { return };
        let Some(part) = self.parts.get_mut(state.part) else { return };
        part.death = death;
        (part.poses, part.tints) = (self.poses.end(state.pose), self.tints.end(state.tint));
    }

    /// Writes all parts into a life.
    pub fn finish(mut self, life: &mut Life) {
        for place in std::mem::take(&mut self.standing) {
            self.end(place, f32::INFINITY);
        }
        drop(self.states);
        life.parts = self.parts.into_list();
        (life.poses, life.tints_of_parts) = (self.poses, self.tints);
        life.outlines = self.outlines;
        life.stems = self.stems.into_iter().map(|(_, model)| model).collect();
        life.surfaces = self.surfaces.into_iter().map(|(_, surface)| surface).collect();
    }
}

/// A part that is no organ, until more is said of it.
fn begun(component: u32, kind: Kind, birth: f32, from: f32) -> Part {
    Part {
        component,
        bearer: component,
        axis: component,
        kind,
        what: What::Internode,
        stem: 0,
        fullness: 1.0,
        stalk: [0; 3],
        birth,
        from,
        death: f32::INFINITY,
        poses: 0..0,
        tints: 0..0,
    }
}

/// The number of the apical bud of an internode's axis.
fn axis_of(plant: &Plant, node: NodeId) -> u32 {
    plant.axes.component[plant.nodes.axis[node.index()].index()]
}

fn pose(base: [f32; 3], heading: [f32; 3], up: [f32; 3], size: [f32; 3]) -> [f32; 12] {
    std::array::from_fn(|k| [base, heading, up, size][k / 3][k % 3])
}

fn rgb([red, green, blue, _]: [u8; 4]) -> [f32; 3] {
    [red, green, blue].map(f32::from)
}

/// The farthest distance of a corner of an outline, or of a point of a surface, from its base along an axis.
fn extent_of(points: impl Iterator<Item = [f32; 3]>) -> f32 {
    points.flatten().map(f32::abs).fold(f32::MIN_POSITIVE, f32::max)
}
