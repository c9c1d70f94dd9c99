//! The reverse scan: the load on each internode, the moment of this load in its middle, and its turn in response.
//!
//! With F the sum of all forces beyond the middle x of an internode and N their torque about the origin, the moment
//! there is M = N − x × F. A turn of all that lies beyond by small angles Φ about horizontal axes changes M by the sum
//! of G Φ over the internodes beyond, with G = −ℓ·F for a chord ℓ that carries F (positive under a load on top). The
//! equations of a Newton step, E I / L (Φᵢ − Φₚ) = M − E I (κ − κ₀) + Σ G Φ, are solved by elimination from the tips:
//! the sum of each branch is an affine function of the turn at its base. The solution is exact in a vertical plane and
//! nearly so in space, where torsion and a second term ℓ (Φ·F) are left out. The pivot is the stiffness left under
//! load: where it is not positive the plant buckles.

use super::section::Section;

use crate::clock::Tick;
use crate::plant::borne::{Borne, Down};
use crate::plant::standing::{Run, Standing};
use crate::plant::{AxisId, OrganId, Part, Plant, Wood};
use crate::site::Fields;
use crate::vector::Vector;

/// An internode holds while more than this share of its own stiffness is left under load. Where less is left, the step
/// uses the whole stiffness of the internode, so that a plant that buckles still moves away from the shape that it
/// cannot hold.
const LEFT: f64 = 1e-3;

/// The largest response of an internode, rad; far more than any internode may turn in a step.
const MOST_TURN: f64 = 1e3;

/// The load on a point of an axis: the sums over everything beyond the point. For weights the mass and its first
/// moments are enough to have F and N.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Load {
    /// The mass, kg.
    mass: f64,
    /// Its first moments about the origin along x and y, kg·m; weight acts along z.
    level: [f64; 2],
    /// The change of the moments of everything beyond for a turn at this point, N·m/rad.
    follows: f64,
    /// The change of these moments for the turns beyond that do not depend on the turn at this point, N·m.
    moves: Vector,
    /// The area in the wind; zero where there is no wind.
    sail: Sail,
}

/// Area in the wind.
#[derive(Debug, Clone, Copy, Default)]
struct Sail {
    /// The area, m².
    area: f64,
    /// Its first moments about the origin, m³.
    at: Vector,
}

/// The response of an internode in this step: it turns by `gain` times the turn of its base, plus `turn`, radians about
/// `up` and `heading × up`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Response {
    pub gain: f32,
    pub turn: [f32; 2],
}

/// The columns that the reverse scan reads and writes.
pub(super) struct Scan<'a> {
    pub plant: &'a Plant,
    pub wood: &'a Wood,
    pub age: Tick,
    pub fields: Fields,
    /// The lengths of the internodes at the age, m.
    pub lengths: &'a [f32],
    /// The curvature that each internode would have without load, rad/m.
    pub natural: &'a [[f32; 2]],
    /// Scratch, one entry an axis.
    pub loads: &'a mut Vec<Load>,
    pub responses: &'a mut [Response],
}

impl Load {
    #[inline]
    fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        self.level = [self.level[0] + other.level[0], self.level[1] + other.level[1]];
        self.follows += other.follows;
        self.moves = self.moves + other.moves;
        self.sail.put(other.sail.at, other.sail.area);
    }

    #[inline]
    fn put(&mut self, at: Vector, mass: f64) {
        self.mass += mass;
        self.level = [self.level[0] + at.x * mass, self.level[1] + at.y * mass];
    }

    /// The moment of the weight about a point, N·m.
    #[inline]
    fn moment(&self, about: Vector, gravity: f64) -> Vector {
        let arm = [self.level[0] - about.x * self.mass, self.level[1] - about.y * self.mass];
        Vector::new(-arm[1] * gravity, arm[0] * gravity, 0.0)
    }
}

impl Sail {
    /// Adds an area by its first moments.
    #[inline]
    fn put(&mut self, moments: Vector, area: f64) {
        self.area += area;
        self.at = self.at + moments;
    }

    /// The moment of the drag about a point, N·m.
    #[inline]
    fn moment(&self, about: Vector, drag: Vector) -> Vector {
        (self.at - about * self.area).cross(drag)
    }
}

/// An internode in two halves, of which the scan passes the outer one first.
struct Piece {
    length: f64,
    heading: Vector,
    foot: Vector,
    /// Diameters, or widths of a blade, at the base, in the middle and at the tip, m.
    diameters: [f64; 3],
    section: Section,
    density: f64,
}

/// The load on an internode.
struct Felt {
    /// The moment in its middle, N·m.
    moment: Vector,
    /// G of its outer half, and of the whole internode, N·m/rad.
    near: f64,
    whole: f64,
}

impl Piece {
    /// Adds the two halves of an internode to the load. Returns the load on the internode.
    #[inline(always)]
    fn pass<const WINDY: bool>(&self, load: &mut Load, fields: &Fields) -> Felt {
        let [base, middle, tip] = self.diameters;
        let half = 0.5 * self.length;
        let mass = |base, tip| self.density * self.section.volume(half, base, tip);
        let (outer, inner) = (mass(middle, tip), mass(base, middle));
        let place = |share: f64| self.foot + self.heading * (share * self.length);
        let beyond = load.mass;
        load.put(place(0.75), outer);
        let centre = place(0.5);
        let moment = load.moment(centre, -fields.gravity.z);
        load.put(place(0.25), inner);
        let stands = -fields.gravity.z * self.heading.z * self.length;
        let near = stands * (0.5 * beyond + 0.25 * outer);
        let whole = stands * (beyond + 0.75 * outer + 0.25 * inner);
        let felt = Felt { moment, near, whole };
        if WINDY { self.pass_sail(&mut load.sail, fields.drag, felt) } else { felt }
    }

    /// Adds the two halves of an internode to the area in the wind. Returns `felt` with the wind's part added.
    #[inline]
    fn pass_sail(&self, sail: &mut Sail, drag: Vector, felt: Felt) -> Felt {
        let [base, middle, tip] = self.diameters;
        let half = 0.5 * self.length;
        let (outer, inner) = (half * 0.5 * (middle + tip), half * 0.5 * (base + middle));
        let place = |share: f64| self.foot + self.heading * (share * self.length);
        let beyond = sail.area;
        sail.put(place(0.75) * outer, outer);
        let moment = felt.moment + sail.moment(place(0.5), drag);
        sail.put(place(0.25) * inner, inner);
        let leans = -self.heading.dot(drag) * self.length;
        Felt {
            moment,
            near: felt.near + leans * (0.5 * beyond + 0.25 * outer),
            whole: felt.whole + leans * (beyond + 0.75 * outer + 0.25 * inner),
        }
    }
}

impl Scan<'_> {
    /// Scans every internode that stands, from the tips down. Returns the axis nearest to the seed that does not hold
    /// its load, if any.
    pub fn weigh(self, standing: &Standing, laterals: &Borne, organs: &Borne) -> Option<AxisId> {
        let calm = self.fields.drag == Vector::default();
        if calm {
            self.scan::<false>(standing, laterals, organs)
        } else {
            self.scan::<true>(standing, laterals, organs)
        }
    }

    fn scan<const WINDY: bool>(mut self, standing: &Standing, laterals: &Borne, organs: &Borne) -> Option<AxisId> {
        self.loads.clear();
        self.loads.resize(self.plant.axes.len(), Load::default());
        let mut laterals = Down::new(laterals, &self.plant.axes.bearer);
        let mut organs = Down::new(organs, &self.plant.organs.node);
        let mut yields = None;
        for run in standing.runs.iter().rev() {
            if !self.weigh_run::<WINDY>(run, &mut laterals, &mut organs) {
                yields = Some(run.axis);
            }
        }
        yields
    }

    #[inline]
    fn weigh_run<const WINDY: bool>(&mut self, run: &Run, laterals: &mut Down<'_>, organs: &mut Down<'_>) -> bool {
        let Plant { own_looks, stated, strain, .. } = self.plant;
        let section = Section::of(self.plant.look_of(run.axis));
        let free = !stated.has_starts_of_axes() && !strain.has_holds();
        let plain = section == Section::Round && own_looks.is_empty() && free;
        // Most plants: a scan that knows it in advance makes a tenth fewer steps.
        if plain {
            self.weigh_along::<WINDY, true>(run, Section::Round, laterals, organs)
        } else {
            self.weigh_along::<WINDY, false>(run, section, laterals, organs)
        }
    }

    /// `PLAIN`: the internodes are round, none has a look of its own or is held, and each axis begins at the tip of its
    /// bearer.
    #[inline(always)]
    fn weigh_along<const WINDY: bool, const PLAIN: bool>(
        &mut self,
        run: &Run,
        of_axis: Section,
        laterals: &mut Down<'_>,
        organs: &mut Down<'_>,
    ) -> bool {
        let tissue = self.wood.tissue(self.plant.axes.order[run.axis.index()]);
        let mut load = self.loads[run.axis.index()];
        let starts = !PLAIN && self.plant.stated.has_starts_of_axes();
        let (mut low, mut holds) = (Vec::new(), true);
        for node in run.nodes().rev() {
            while let Some(axis) = laterals.on(node) {
                if starts && self.begins_below(node, axis) {
                    low.push(axis);
                } else {
                    load.add(&self.loads[axis]);
                }
            }
            while let Some(organ) = organs.on(node) {
                self.hang(&mut load, node, organ);
            }
            let own_age = self.age - self.plant.nodes.birth[node];
            let section = if PLAIN { Section::Round } else { of_axis.at(self.plant, node) };
            let piece = self.piece(node, section, tissue.density(own_age));
            let felt = piece.pass::<WINDY>(&mut load, &self.fields);
            let modulus = tissue.modulus(own_age);
            let flexural = section.second_moments(piece.diameters[1]).map(|moment| modulus * moment);
            let hold = if PLAIN { None } else { self.plant.strain.hold_of(node, self.age) };
            // What is held turns with its base, as what has no stiffness of its own does.
            let flexural = if hold.is_some() { [0.0; 2] } else { flexural };
            let answered;
            (load, answered) = self.answer::<PLAIN>(load, node, &felt, flexural, piece.length);
            holds &= answered;
            if hold.is_some_and(|hold| hold.bears) {
                load = Load::default();
            }
            if starts {
                low.drain(..).for_each(|axis| load.add(&self.loads[axis]));
            }
        }
        self.loads[run.axis.index()] = load;
        holds
    }

    /// Whether `axis` begins nearer to the base of the internode of `node` than to its tip, so that it is no load on
    /// the middle of the internode.
    fn begins_below(&self, node: usize, axis: usize) -> bool {
        let [along, ..] = self.plant.stated.start(Part::Axis(AxisId(axis as u32)));
        along < -0.5 * self.lengths[node]
    }

    /// Adds an organ to the load at its node.
    #[inline]
    fn hang(&self, load: &mut Load, node: usize, organ: usize) {
        let organs = &self.plant.organs;
        if organs.birth[organ] > self.age || organs.death[organ] <= self.age {
            return;
        }
        let frames = &self.plant.frames;
        let along = Vector::from(frames.heading[node]) * f64::from(self.lengths[node]);
        let at = Vector::from(frames.base[node]) + along;
        load.put(at, self.wood.organs.of(self.plant, organ, self.age));
        let area: f64 = self.plant.organ_area(OrganId(organ as u32), self.age);
        load.sail.put(at * area, area);
    }

    #[inline(always)]
    fn piece(&self, node: usize, section: Section, density: f64) -> Piece {
        let Plant { nodes, frames, .. } = self.plant;
        let (base, tip) = (f64::from(nodes.diameter[node]), f64::from(nodes.diameter_tip[node]));
        Piece {
            length: f64::from(self.lengths[node]),
            heading: Vector::from(frames.heading[node]),
            foot: Vector::from(frames.base[node]),
            diameters: [base, 0.5 * (base + tip), tip],
            section,
            density,
        }
    }

    /// Computes the response of an internode of this flexural stiffness about `up` and about `heading × up`, N·m².
    /// Returns the load on the base of the internode, and whether the internode holds. A blade is far stiffer about
    /// `up`; the gain is that of the weaker axis for both, which slows the steps where a blade stands on edge and
    /// leaves the equilibrium as it is. Inlined, so that loads stay in registers.
    #[inline(always)]
    fn answer<const ROUND: bool>(
        &mut self,
        mut load: Load,
        node: usize,
        felt: &Felt,
        flexural: [f64; 2],
        length: f64,
    ) -> (Load, bool) {
        let Felt { moment, near, whole } = *felt;
        let stiffness = flexural[1] / length;
        if !(stiffness.is_finite() && stiffness > 0.0) {
            // An internode without length or without stiffness turns with its base.
            load.follows += whole;
            self.responses[node] = Response { gain: 1.0, turn: [0.0; 2] };
            return (load, true);
        }
        let left = stiffness - 0.5 * near - load.follows;
        let holds = left > LEFT * stiffness;
        let (pivot, near, past) = if holds { (left, near, 0.5 * whole + load.follows) } else { (stiffness, 0.0, 0.0) };
        let Plant { frames, strain, .. } = self.plant;
        let (heading, up) = (Vector::from(frames.heading[node]), Vector::from(frames.up[node]));
        let axes = [up, heading.cross(up)];
        let (curvature, natural, per_pivot) = (strain.curvature[node], self.natural[node], 1.0 / pivot);
        let stiffer = if ROUND { 0.0 } else { (flexural[0] - flexural[1]) / length };
        let per_pivot = [if stiffer == 0.0 { per_pivot } else { 1.0 / (pivot + stiffer) }, per_pivot];
        let moment = moment + load.moves;
        let answer = |k: usize| {
            let excess = f64::from(curvature[k]) - f64::from(natural[k]);
            ((moment.dot(axes[k]) - flexural[k] * excess) * per_pivot[k]).clamp(-MOST_TURN, MOST_TURN)
        };
        let turn = [answer(0), answer(1)];
        let gain = (stiffness + 0.5 * near) * per_pivot[1];
        load.moves = load.moves + (axes[0] * turn[0] + axes[1] * turn[1]) * past;
        load.follows = if holds { past * gain + 0.5 * whole } else { 0.0 };
        self.responses[node] = Response { gain: gain as f32, turn: [turn[0] as f32, turn[1] as f32] };
        (load, holds)
    }
}
