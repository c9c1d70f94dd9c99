//! One parametric blade in the words of leaf botanists: outline, margin, and how it bends.
//!
//! Words are those of the Manual of Leaf Architecture (Ellis et al. 2009): the shape of the base, the shape of the
//! apex, where the blade is widest, and its margin. Half the width of an outline at a share s of the way from the
//! widest place to an end is ½ (1 − sᵖ)ᵏ: k = ½ and p = 2 are half an ellipse, a larger k is a sharper end, and a
//! larger p keeps the edges parallel for longer. Petals are blades with a claw, a notch and a cup. Absent: triangles
//! (`phytomer_meshes`).

use phytomer_sim::math::{cosf, pow, sincosf};
use std::f32::consts::TAU;

/// The base of a blade.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum Base {
    /// Drawn out along the stalk, its edges hollow.
    Attenuate,
    /// A wedge with nearly straight edges.
    Cuneate,
    /// Its edges bulge a little.
    #[default]
    Convex,
    /// A round arc.
    Rounded,
    /// Cut off straight.
    Truncate,
    /// Two lobes stand behind the end of the stalk.
    Cordate,
}

/// The apex of a blade.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum Apex {
    /// A long drawn-out tip.
    Acuminate,
    /// A tip with nearly straight edges.
    #[default]
    Acute,
    /// A blunt tip.
    Convex,
    /// A round arc.
    Rounded,
    /// Cut off straight.
    Truncate,
}

/// The margin of a blade.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum Margin {
    /// Without teeth.
    #[default]
    Entire,
    /// Teeth that point to the apex.
    Toothed,
    /// Lobes along the midrib, as an oak's.
    Lobed,
    /// Lobes around the end of the stalk, as a maple's.
    Palmate,
}

/// A blade.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(deny_unknown_fields, default))]
pub struct Blade {
    /// The share of the length that is stalk, in [0, 0.9].
    pub stalk: f32,
    /// Where it is widest, as a share of the blade from its base, in [0.02, 0.98].
    pub widest_at: f32,
    /// The shape of its base.
    pub base: Base,
    /// The shape of its apex.
    pub apex: Apex,
    /// How long its edges are parallel, in [1, 12]: 2 is an ellipse, 6 nearly a rectangle.
    pub oblong: f32,
    /// How far the lobes of a cordate base stand behind the end of the stalk, as a share of the blade, in [0, 0.6].
    pub heart: f32,
    /// How deep its apex is notched, as a share of the blade, in [0, 0.6].
    pub notch: f32,
    /// The share of the blade that is a narrow claw, in [0, 0.9].
    pub claw: f32,
    /// Its margin.
    pub margin: Margin,
    /// Teeth or lobes: on each side, of a palmate blade in all, in [1, 60].
    pub divisions: u8,
    /// The depth of teeth or lobes as a share of half the width, of a palmate blade of a lobe's length, in [0, 0.95].
    pub depth: f32,
    /// The angle through which the lobes of a palmate blade spread, degrees, in [30, 350].
    pub spread_deg: f32,
    /// How far each half rises from the midrib, degrees, in [−85, 85].
    pub fold_deg: f32,
    /// The angle through which it arches down from base to apex, degrees, in [−300, 300]; below 0 it rises.
    pub arch_deg: f32,
    /// The angle through which it is twisted from base to apex, degrees, in [−360, 360].
    pub twist_deg: f32,
    /// The height of the waves of its margin as a share of its width, in [0, 0.5].
    pub wave: f32,
    /// How hollow it is across, as a share of its width, in [−1, 1]; below 0 it is vaulted.
    pub cup: f32,
    /// Side veins on each side, in [0, 60]; the blade bulges between them.
    pub veins: u8,
    /// Pairs of leaflets of a compound blade, in [0, 60]; the outline is then that of a leaflet, and the longest reach
    /// half the width aside. 0: it is simple.
    pub leaflets: u8,
    /// The width of a leaflet over its length, in [0.01, 2].
    pub leaflet_width: f32,
    /// The angle between the rachis and its leaflets, degrees, in [5, 120].
    pub leaflet_deg: f32,
    /// How far the halves hang at their edges, degrees, in [−85, 85], beyond the fold at the midrib.
    pub droop_deg: f32,
    /// The share of its side veins along which the oldest blade is torn, in [0, 1].
    pub tears: f32,
    /// How much paler its underside is, in [0, 1].
    pub pale: f32,
}

impl Default for Blade {
    fn default() -> Self {
        Self {
            stalk: 0.08,
            widest_at: 0.45,
            base: Base::Convex,
            apex: Apex::Acute,
            oblong: 2.0,
            heart: 0.2,
            notch: 0.0,
            claw: 0.0,
            margin: Margin::Entire,
            divisions: 12,
            depth: 0.1,
            spread_deg: 240.0,
            fold_deg: 14.0,
            arch_deg: 25.0,
            twist_deg: 0.0,
            wave: 0.0,
            cup: 0.0,
            veins: 8,
            leaflets: 0,
            leaflet_width: 0.35,
            leaflet_deg: 62.0,
            droop_deg: 0.0,
            tears: 0.0,
            pale: 0.25,
        }
    }
}

/// A place on an outline: from the midrib's place how far along the blade, as a share of its length, and how far
/// aside, as a share of the width, at most ½.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rim {
    /// Along.
    pub along: f32,
    /// Aside.
    pub aside: f32,
}

/// Half the width of a claw, as a share of the width.
const CLAW: f64 = 0.07;

impl Blade {
    /// Half its width at a share u of the blade, as a share of the width, without teeth and lobes.
    fn half(&self, u: f64) -> f64 {
        let widest = f64::from(self.widest_at).clamp(0.02, 0.98);
        let claw = f64::from(self.claw).clamp(0.0, 0.9);
        let (above, beyond) = (((u - claw) / (1.0 - claw)).clamp(0.0, 1.0), u < widest.max(claw));
        let place = widest.max(claw + 0.02).min(0.98);
        let widest = (place - claw) / (1.0 - claw);
        let to_end = if above < widest { 1.0 - above / widest } else { (above - widest) / (1.0 - widest) };
        let (sharp, oblong) = if above < widest { self.base.sharpness() } else { self.apex.sharpness() };
        let free = (1.0 - pow(to_end.clamp(0.0, 1.0), oblong * f64::from(self.oblong) * 0.5)).max(0.0);
        let half = 0.5 * pow(free, sharp);
        if claw > 0.0 && beyond { half.max(CLAW) } else { half }
    }

    /// The rim of its right half where the midrib is at a share u of the blade; a palmate blade has none of these.
    pub fn rim(&self, u: f32) -> Rim {
        let (u, half) = (f64::from(u), self.half(f64::from(u)));
        let widest = f64::from(self.widest_at).clamp(0.02, 0.98);
        let near = |share: f64| share.max(0.0) * share.max(0.0);
        let heart = if self.base == Base::Cordate { f64::from(self.heart) } else { 0.0 };
        let back = heart * 2.0 * half * near(1.0 - u / widest);
        let ahead = f64::from(self.notch) * 2.0 * half * near((u - widest) / (1.0 - widest));
        let cut = match self.margin {
            Margin::Lobed => f64::from(self.depth) * self.sinus(u) * 4.0 * u.min(0.25) * (4.0 * (1.0 - u)).min(1.0),
            _ => 0.0,
        };
        Rim { along: (ahead - back) as f32, aside: (half * (1.0 - cut)) as f32 }
    }

    /// The depth of a lobed margin at a share u: 0 on a lobe, 1 between two of them.
    fn sinus(&self, u: f64) -> f64 {
        0.5 + 0.5 * f64::from(cosf(TAU * f32::from(self.divisions) * u as f32))
    }

    /// By what share the edge is cut in between teeth, at a share u of the blade: a saw whose teeth point to the apex.
    pub fn tooth(&self, u: f32) -> f32 {
        if self.margin != Margin::Toothed {
            return 0.0;
        }
        let place = u * f32::from(self.divisions);
        let within = place - place.floor();
        self.depth * if within < 0.8 { 1.0 - within / 0.8 } else { (within - 0.8) / 0.2 }
    }

    /// The length of a palmate blade in a direction, as a share of its length from the end of the stalk to the middle
    /// lobe's tip; `turn` goes from −1 to 1 over its spread.
    pub fn reach(&self, turn: f32) -> f32 {
        let lobes = f64::from(self.divisions.max(1));
        let place = (f64::from(turn) * 0.5 + 0.5) * lobes;
        let within = 2.0 * (place - place.floor()) - 1.0;
        let middle = (2.0 * (place.floor().min(lobes - 1.0) + 0.5) / lobes - 1.0).abs();
        let lobe = 1.0 - 0.38 * pow(middle, 1.5);
        let sharp = self.apex.sharpness().0;
        let round = pow((1.0 - pow(within.abs(), 1.6)).max(0.0), sharp.min(1.4));
        (lobe * (1.0 - f64::from(self.depth) * (1.0 - round))) as f32
    }

    /// Whether its parts cross one another, as far as their outline and their bend can tell: what turns at a place
    /// must not be wider than the turn, and lobes must leave one another room.
    pub fn crosses(&self, aspect: f32) -> bool {
        let arch = f64::from(self.arch_deg).to_radians();
        let rise = f64::from(sincosf(self.fold_deg.to_radians()).0);
        let steps = 64;
        let mut before = self.rim(0.0);
        (1..=steps).any(|step| {
            let u = step as f32 / steps as f32;
            let rim = self.rim(u);
            let advance = f64::from(rim.along - before.along) + 1.0 / steps as f64;
            let wider = f64::from(rim.aside - before.aside);
            // The rim must stay on one side of the rows that lead to it.
            let area = advance * f64::from(rim.aside) - f64::from(rim.along) * wider;
            before = rim;
            let height = f64::from(rim.aside) * f64::from(aspect) * (rise.abs() + f64::from(self.cup).abs());
            let inward = if rise * arch < 0.0 { arch.abs() * height } else { 0.0 };
            (u < 0.98 && area < -1e-4) || inward > 1.0
        })
    }
}

impl Base {
    fn sharpness(self) -> (f64, f64) {
        match self {
            Self::Attenuate => (1.8, 2.0),
            Self::Cuneate => (1.0, 2.0),
            Self::Convex => (0.72, 2.0),
            Self::Rounded => (0.5, 2.0),
            Self::Truncate => (0.25, 3.0),
            Self::Cordate => (0.36, 2.2),
        }
    }
}

impl Apex {
    fn sharpness(self) -> (f64, f64) {
        match self {
            Self::Acuminate => (1.7, 2.0),
            Self::Acute => (1.05, 2.0),
            Self::Convex => (0.72, 2.0),
            Self::Rounded => (0.5, 2.0),
            Self::Truncate => (0.25, 3.0),
        }
    }
}
