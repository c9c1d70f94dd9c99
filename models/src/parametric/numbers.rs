//! The parameters of a parametric tree as plain numbers, checked, for its formulas. Names are those of the paper (Weber
//! & Penn 1995, appendix); lengths are in metres, angles in degrees.
//!
//! Absent: sources and defaults (`params`), and the checks (`checks`).

use super::params::Sway;
use phytomer_looks::FormName;
use phytomer_sim::clock::{NEVER, Tick};

/// The parameters of a tree.
#[derive(Debug, Clone, PartialEq)]
pub struct Numbers {
    /// Shape, from 0 to 8.
    pub shape: u32,
    /// BaseSize.
    pub base_size: f64,
    /// Scale.
    pub scale: f64,
    /// ScaleV.
    pub scale_v: f64,
    /// Levels, of which leaves are not one.
    pub levels: u8,
    /// Ratio.
    pub ratio: f64,
    /// RatioPower.
    pub ratio_power: f64,
    /// Lobes.
    pub lobes: u32,
    /// LobeDepth.
    pub lobe_depth: f64,
    /// Flare.
    pub flare: f64,
    /// 0Scale, the factor of the trunk's radius.
    pub radius_scale: f64,
    /// 0ScaleV.
    pub radius_scale_v: f64,
    /// 0BaseSplits.
    pub base_splits: u32,
    /// Leaves; below 0 in a fan.
    pub leaves: f64,
    /// LeafShape.
    pub leaf_form: FormName,
    /// LeafScale.
    pub leaf_scale: f64,
    /// LeafScaleX.
    pub leaf_scale_x: f64,
    /// LeafBend.
    pub leaf_bend: f64,
    /// AttractionUp.
    pub attraction_up: f64,
    /// The quality of §4.5.
    pub quality: f64,
    /// The rate of sway (§4.7).
    pub sway: Sway,
    /// PruneRatio.
    pub prune_ratio: f64,
    /// The envelope of pruning, and of Shape 8.
    pub envelope: Envelope,
    /// Whether all branches of the trunk stand above its bare part.
    pub above_base: bool,
    /// Levels 0 to 3.
    pub level: [Level; 4],
    /// The tree by its age.
    pub ages: Ages,
}

/// The envelope of §4.6.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Envelope {
    /// PruneWidth, a radius over the size of the tree.
    pub width: f64,
    /// PruneWidthPeak.
    pub peak: f64,
    /// PrunePowerLow.
    pub low: f64,
    /// PrunePowerHigh.
    pub high: f64,
}

/// The parameters of a level. Those that only branches have are 0 on level 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Level {
    /// nDownAngle.
    pub down_angle: f64,
    /// nDownAngleV.
    pub down_angle_v: f64,
    /// nRotate.
    pub rotate: f64,
    /// nRotateV.
    pub rotate_v: f64,
    /// nBranches; below 0 in a fan.
    pub branches: f64,
    /// nLength.
    pub length: f64,
    /// nLengthV.
    pub length_v: f64,
    /// nTaper.
    pub taper: f64,
    /// nSegSplits.
    pub seg_splits: f64,
    /// nSplitAngle.
    pub split_angle: f64,
    /// nSplitAngleV.
    pub split_angle_v: f64,
    /// nCurveRes.
    pub curve_res: u32,
    /// nCurve.
    pub curve: f64,
    /// nCurveBack.
    pub curve_back: f64,
    /// nCurveV; below 0 a helix.
    pub curve_v: f64,
}

/// The tree by its age, in ticks.
#[derive(Debug, Clone, PartialEq)]
pub struct Ages {
    /// The size over the full size at each age from 0; ages past the last have that of the last.
    pub scale: Vec<f64>,
    /// The age at which the stems of each level appear; [`NEVER`] where they do not appear in the run.
    pub births: Vec<Tick>,
    /// When leaves come and fall.
    pub season: Option<Season>,
}

/// The season of leaves: the ticks of a year, and those at which leaves appear and fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Season {
    /// The ticks of a year.
    pub year: Tick,
    /// The tick of the year at which leaves appear.
    pub out: Tick,
    /// The tick of the year at which they fall.
    pub fall: Tick,
}

impl Numbers {
    /// The parameters of a level: those of level 3 for levels beyond (§4.5).
    pub fn of(&self, level: u8) -> &Level {
        &self.level[usize::from(level.min(3))]
    }

    /// The parameters of level 3 for levels beyond, for leaves those of the level after the last of the stems.
    pub fn of_leaves(&self) -> &Level {
        self.of(self.levels)
    }
}

impl Ages {
    /// The size over the full size at an age.
    pub fn scale_at(&self, age: Tick) -> f64 {
        self.scale.get(age as usize).or(self.scale.last()).copied().unwrap_or(1.0)
    }

    /// The births and falls of the leaves that have appeared by `age`, a pair a generation.
    pub fn generations(&self, age: Tick) -> Vec<(Tick, Tick)> {
        let born = self.births.iter().copied().max().unwrap_or(NEVER);
        if born > age {
            return Vec::new();
        }
        let Some(Season { year, out, fall }) = self.season else { return vec![(born, NEVER)] };
        let mut all = Vec::new();
        let mut begins = born - born % year;
        while begins <= age {
            let (appears, falls) = ((begins + out).max(born), begins + fall);
            if appears < falls && appears <= age {
                all.push((appears, falls));
            }
            begins += year;
        }
        all
    }
}
