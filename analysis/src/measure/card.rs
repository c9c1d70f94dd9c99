//! The list of measures: the name of each, one sentence, its formula with the source, its unit and its groups.
//!
//! `phytomer measure --list`, the help and the documents follow from this list. Absent: the work.

use super::activity::Steps;
use super::angles::Angle;
use super::fault::Fault;
use super::form::Form;
use super::lives::Living;
use super::nodes::Nodes;
use phytomer_outputs::Table;

/// A measure.
#[derive(Debug)]
pub struct Card {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it tells.
    pub tells: &'static str,
    /// Its formula and the source of it.
    pub formula: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The columns of its table by which rows can be grouped, beside run, treatment, factor, species, replicate, block
    /// and plot.
    pub groups: &'static [&'static str],
    pub(super) of: Of,
}

impl Card {
    /// Whether it tells one number of a run, or of a group: a mean, a share, a median or a ratio.
    pub fn tells_a_number(&self) -> bool {
        match self.of {
            Of::Life(_) | Of::Activity | Of::Nodes(_) | Of::Branching | Of::Angle(_) | Of::ClearBole => true,
            Of::Size { per_ground, .. } => !per_ground,
            Of::Form(_) | Of::Alive => true,
            Of::Causes(_) | Of::Cover | Of::Profile | Of::Allometry | Of::Contrast | Of::Variance | Of::Power => false,
        }
    }

    /// The table that it reads.
    pub fn table(&self) -> Table {
        match self.of {
            Of::Life(_) | Of::Causes(_) | Of::Nodes(_) | Of::Branching => Table::Components,
            Of::Activity => Table::Events,
            Of::Angle(_) | Of::Form(_) | Of::Cover | Of::Profile | Of::ClearBole => Table::Records,
            _ => Table::Summary,
        }
    }
}

/// How a measure is taken.
#[derive(Debug, Clone, Copy)]
pub(super) enum Of {
    Life(Living),
    Causes(Living),
    Activity,
    Nodes(Nodes),
    Branching,
    Size { column: &'static str, unit: &'static str, per_ground: bool },
    Alive,
    Angle(Angle),
    Form(Form),
    Cover,
    Profile,
    ClearBole,
    Allometry,
    Contrast,
    Variance,
    Power,
}

const KAPLAN_MEIER: &str =
    "Kaplan & Meier 1958; Greenwood 1926; of plants by the infinitesimal jackknife (Lin & Wei 1989)";
const AALEN_JOHANSEN: &str = "Aalen & Johansen 1978, of plants by the infinitesimal jackknife";
const RATIO: &str = "Σy / Σm over plants, interval of plants (Cochran 1977 §6.13), design effect (Kish 1965)";
const STUDENT: &str = "mean of living plants ± t s/√n";
const CIRCULAR: &str = "arg Σ e^{iθ}, interval of plants (Mardia & Jupp 2000 §2.2)";

const fn plain(name: &'static str, tells: &'static str, column: &'static str, unit: &'static str) -> Card {
    let of = Of::Size { column, unit, per_ground: false };
    Card { name, tells, formula: STUDENT, unit, groups: &["age"], of }
}

/// Every measure.
pub static MEASURES: [Card; 29] = [
    Card {
        name: "bud-life",
        tells: "Survival of apical buds by dimension, with the log-rank test between groups.",
        formula: KAPLAN_MEIER,
        unit: "share",
        groups: &Living::GROUPS,
        of: Of::Life(Living::Buds),
    },
    Card {
        name: "axis-life",
        tells: "Survival of axes with all that they bear, from their first internode.",
        formula: KAPLAN_MEIER,
        unit: "share",
        groups: &Living::GROUPS,
        of: Of::Life(Living::Axes),
    },
    Card {
        name: "leaf-life",
        tells: "Survival of leaves by their age.",
        formula: KAPLAN_MEIER,
        unit: "share",
        groups: &Living::GROUPS,
        of: Of::Life(Living::Leaves),
    },
    Card {
        name: "bud-causes",
        tells: "The share of apical buds that each cause has ended by a dimension.",
        formula: AALEN_JOHANSEN,
        unit: "share",
        groups: &Living::GROUPS,
        of: Of::Causes(Living::Buds),
    },
    Card {
        name: "axis-causes",
        tells: "The share of axes that each cause has ended by a dimension.",
        formula: AALEN_JOHANSEN,
        unit: "share",
        groups: &Living::GROUPS,
        of: Of::Causes(Living::Axes),
    },
    Card {
        name: "leaf-causes",
        tells: "The share of leaves that each cause has ended by an age.",
        formula: AALEN_JOHANSEN,
        unit: "share",
        groups: &Living::GROUPS,
        of: Of::Causes(Living::Leaves),
    },
    Card {
        name: "activity",
        tells: "The share of clock steps at which living buds grew and did not pause.",
        formula: RATIO,
        unit: "share",
        groups: &Steps::GROUPS,
        of: Of::Activity,
    },
    Card {
        name: "nodes-per-unit",
        tells: "Nodes per growth unit.",
        formula: RATIO,
        unit: "node",
        groups: &Nodes::GROUPS,
        of: Of::Nodes(Nodes::PerUnit),
    },
    Card {
        name: "nodes-per-axis",
        tells: "Nodes per axis.",
        formula: RATIO,
        unit: "node",
        groups: &Nodes::GROUPS,
        of: Of::Nodes(Nodes::PerAxis),
    },
    Card {
        name: "branching",
        tells: "Axes for one of the order before, and Strahler's bifurcation ratio.",
        formula: "N(k+1)/N(k); antilog of the slope of log N (Horton 1945, Strahler 1957); BCa by plant (Efron 1987)",
        unit: "",
        groups: &[],
        of: Of::Branching,
    },
    Card {
        name: "divergence",
        tells: "The angle about the axis from a leaf to that of the next node.",
        formula: CIRCULAR,
        unit: "deg",
        groups: &["order"],
        of: Of::Angle(Angle::Divergence),
    },
    Card {
        name: "leaf-insertion",
        tells: "The angle between a leaf and the internode that bears it.",
        formula: CIRCULAR,
        unit: "deg",
        // The order of the bearing internode is that of the leaf, since both stand on one axis.
        groups: &[],
        of: Of::Angle(Angle::LeafInsertion),
    },
    Card {
        name: "axis-insertion",
        tells: "The angle between the first internode of an axis and the internode that bears it.",
        formula: CIRCULAR,
        unit: "deg",
        groups: &[],
        of: Of::Angle(Angle::AxisInsertion),
    },
    plain("height", "The height of living plants.", "height_m", "m"),
    plain("crown-width", "The width of the crown of living plants.", "crown_width_m", "m"),
    plain("leaf-area", "The leaf area of living plants, one side.", "leaf_area_m2", "m2"),
    plain("wood-volume", "The volume of the wood of living plants.", "wood_volume_m3", "m3"),
    Card {
        name: "leaf-area-index",
        tells: "Leaf area over the ground of the plant, of living plants.",
        formula: STUDENT,
        unit: "m2/m2",
        groups: &["age"],
        of: Of::Size { column: "leaf_area_m2", unit: "m2/m2", per_ground: true },
    },
    Card {
        name: "effective-leaf-area",
        tells: "What the leaves of a plant cover together, as discs seen from above or from --sun.",
        formula: "union of discs by Green's theorem (Honda & Fisher 1978; Aono & Kunii 1984); mean of plants ± t s/√n",
        unit: "m2",
        groups: &[],
        of: Of::Cover,
    },
    Card {
        name: "axiality",
        tells: "How clear the main axis is at a branching: 0 for a fork, 1 where it goes straight on.",
        formula: "(|h_l| - |h_m|)/(|h_l| + |h_m|) of grown angles (after Aono & Kunii 1984); Σy / Σm over plants",
        unit: "",
        groups: &[],
        of: Of::Form(Form::Axiality),
    },
    Card {
        name: "crown-cone",
        tells: "The half-angle of the cone with the height of the plant and the reach of its widest place.",
        formula: "arctan(reach/height) (after Aono & Kunii 1984); mean of plants",
        unit: "deg",
        groups: &[],
        of: Of::Form(Form::Cone),
    },
    Card {
        name: "widest-place",
        tells: "The height of the widest place of a plant over its height.",
        formula: "of the farthest tip from the vertical through the seed (after Aono & Kunii 1984); mean of plants",
        unit: "",
        groups: &[],
        of: Of::Form(Form::Widest),
    },
    Card {
        name: "living",
        tells: "The share of plants that live.",
        formula: "Wilson 1927",
        unit: "share",
        groups: &["age"],
        of: Of::Alive,
    },
    Card {
        name: "crown-profile",
        tells: "Leaf area by height above the seed.",
        formula: "mean of plants ± t s/√n, by layer",
        unit: "m2",
        groups: &[],
        of: Of::Profile,
    },
    Card {
        name: "clear-bole",
        tells: "The height of the lowest leaf.",
        formula: "mean of plants ± t s/√n",
        unit: "m",
        groups: &[],
        of: Of::ClearBole,
    },
    Card {
        name: "allometry",
        tells: "How one size of plants scales with another: --of against --x.",
        formula: "standardised major axis and least squares of logarithms (Warton et al. 2006)",
        unit: "",
        groups: &[],
        of: Of::Allometry,
    },
    Card {
        name: "contrast",
        tells: "Each treatment, level or run against the first, of pairs of plants that share their draws, and unpaired.",
        formula: "Student 1908, Welch 1947; effect size Hedges 1981, Hedges & Olkin 1985",
        unit: "of --of",
        groups: &[],
        of: Of::Contrast,
    },
    Card {
        name: "variance",
        tells: "The variance between and within groups of plants.",
        formula: "one-way components (Searle, Casella & McCulloch 1992 §3.6)",
        unit: "square of --of",
        groups: &[],
        of: Of::Variance,
    },
    Card {
        name: "power",
        tells: "The plants that a wanted --difference needs, paired and unpaired.",
        formula: "noncentral t (Cohen 1988)",
        unit: "plants",
        groups: &[],
        of: Of::Power,
    },
];

/// The numbers of plants that `summary` may have, with their units.
const SIZES: [(&str, &str); 17] = [
    ("height_m", "m"),
    ("crown_width_m", "m"),
    ("leaf_area_m2", "m2"),
    ("wood_volume_m3", "m3"),
    ("basal_diameter_m", "m"),
    ("diameter_at_1_3_m", "m"),
    ("lowest_leaf_m", "m"),
    ("internodes", "internode"),
    ("leaves", "leaf"),
    ("flowers", "flower"),
    ("fruits", "fruit"),
    ("buds", "bud"),
    ("dead_internodes", "internode"),
    ("axes", "axis"),
    ("max_order", ""),
    ("harvested_fruits", "fruit"),
    ("harvested_fresh_mass_kg", "kg"),
];

/// The column of a number of plants with its unit.
pub(super) fn size(word: Option<&str>, or: &'static str) -> Result<(&'static str, &'static str), Fault> {
    let word = word.unwrap_or(or);
    SIZES.iter().find(|(name, _)| *name == word).copied().ok_or_else(|| {
        let names: Vec<&str> = SIZES.iter().map(|(name, _)| *name).collect();
        Fault::Asked(format!("`{word}` is no number of plants; there are: {}", names.join(", ")))
    })
}
