//! The statements of the A-system (Aono & Kunii 1984, appendix "A-system syntax"), as they are read.
//!
//! The appendix prints 45 statements with their operands, and `release` by name alone. It leaves the operands
//! themselves undefined; here each is what the paper's data structures have (`TREE`, `INIT`, `VECT`, `CTRL`, `SEGMENT`,
//! `EMITTER`, `COLOR`). Absent: how they are written (`grammar`), and what they do, which is the program's.

use super::fault::Place;

/// A name in a script, with its place there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Name {
    /// The name: letters, digits and underscores.
    pub text: String,
    /// Where it stands.
    pub place: Place,
}

/// The type of a tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TreeType {
    /// Two children at constant angles.
    Gmt1,
    /// Two children whose tips deviate.
    Gmt2,
    /// Three children.
    Gmt3,
    /// Two children whose angles change with the growth level.
    Gmt4,
}

/// The numbers of a tree (`TREE` and `INIT`).
#[derive(Debug, Clone, PartialEq)]
pub struct TreeDescriptor {
    /// Where it stands.
    pub place: Place,
    /// The contraction ratio of the centre branch, of a `gmt3`.
    pub r0: Option<f64>,
    /// The contraction ratios of the left and of the right branch.
    pub ratios: [f64; 2],
    /// The angles.
    pub angles: Angles,
    /// Where the first branch begins and ends; from the origin to 10 above it if not given.
    pub init: Option<[[f64; 3]; 2]>,
}

/// The branching angles of a tree, degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Angles {
    /// Left and right.
    Constant([f64; 2]),
    /// The category of Table 3, and the greatest and the smallest angle to the left and to the right.
    Changing {
        /// From 1 to 5.
        category: u32,
        /// h1′ and h1″.
        left: [f64; 2],
        /// h2′ and h2″.
        right: [f64; 2],
    },
}

/// A range of growth levels of `combine`.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// How its branches are borne.
    pub tree_type: TreeType,
    /// The first and the last growth level.
    pub levels: [u32; 2],
    /// The numbers; its first branch counts for the first range alone.
    pub descriptor: TreeDescriptor,
}

/// An attractor or an inhibitor (`CTRL`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Controller {
    /// The first and the last growth level whose branches it moves.
    pub levels: [u32; 2],
    /// How far it moves a tip, towards it above 0.
    pub factor: f64,
    /// Its place.
    pub at: [f64; 3],
}

/// What `deform` gives a tree anew.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Deformation {
    /// The uniform deviator (`VECT`); `None` leaves what the tree has.
    pub deviator: Option<[f64; 3]>,
    /// The controllers; `None` leaves what the tree has.
    pub controllers: Option<Vec<Controller>>,
    /// The place of the root, and what is added to the length of the first branch.
    pub start: Option<([f64; 3], f64)>,
}

/// A colour of a screen.
pub type Colour = [u8; 3];

/// How branches have a girth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GirthForm {
    /// The diameter of the first branch.
    pub first: f64,
    /// A child's diameter over its mother's.
    pub ratio: f64,
    /// How dense the lines of a plotter are, from 0, outlines alone, to 1, filled.
    pub dense: f64,
    /// Whether the side away from the light is darker.
    pub shaded: bool,
    /// Whether the main axis alone has it.
    pub main_axis: bool,
    /// The corners of a branch's cross-section in a model.
    pub corners: u32,
}

/// From where trees are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ViewType {
    /// From above.
    Top,
    /// From the front, against the y axis.
    Front,
    /// From the right, against the x axis.
    Side,
    /// From the front, the right and above.
    Oblique,
    /// From an eye at a place.
    Perspective,
}

/// A view, as `compose` and `view` state it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Viewing {
    /// From where; that of the workstation's ports if not given.
    pub view: Option<ViewType>,
    /// The place of the eye.
    pub point: Option<[f64; 3]>,
}

/// What a workstation writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WorkstationType {
    /// A picture.
    Display,
    /// Lines.
    Plotter,
    /// A mesh.
    Model,
}

/// A logical device of a workstation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Device {
    /// Picks segments.
    Pick,
    /// Reads commands.
    Keyboard,
    /// Tells places.
    Locator,
    /// Tells values.
    Valuator,
    /// Shows.
    Display,
}

/// One statement.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "operands are named as in the appendix, and told in `grammar`")]
pub enum Statement {
    Create { tree_type: TreeType, tree: Name, level: u32, descriptor: TreeDescriptor },
    Delete { tree: Name },
    Copy { from: Name, to: Name },
    Translate { tree: Name, by: [f64; 3], absolute: bool },
    Zoom { tree: Name, factor: f64, absolute: bool },
    Rotate { tree: Name, degrees: f64, absolute: bool },
    Release { tree: Name },
    Animate { tree_type: TreeType, tree: Name, level: u32, lag: Option<f64> },
    Inform { tree: Name },
    Glue { trees: [Name; 2], to: Name },
    Combine { tree: Name, level: u32, parts: Vec<Part> },
    Cluster { cluster: Name, trees: Vec<Name> },
    Remove { cluster: Name },
    Append { cluster: Name, tree: Name },
    Expel { cluster: Name, tree: Name },
    Flush { cluster: Name, lag: Option<f64> },
    Merge { clusters: [Name; 2], to: Name },
    Inquire { cluster: Name },
    Compose { tree: Name, viewing: Viewing },
    View { cluster: Name, viewing: Viewing },
    Color { tree: Option<Name>, colour: Colour },
    Appear { tree: Name, on: bool },
    Visible { cluster: Name, on: bool },
    Girth { tree: Option<Name>, on: bool, form: Option<GirthForm> },
    Cont { on: bool, steps: Option<u32> },
    CutAxis { on: bool, level: Option<u32> },
    CutLateral { on: bool, level: Option<u32>, until: Vec<u32> },
    Divergence { degrees: f64 },
    Deform { tree: Name, deformation: Deformation },
    Leaf { tree: Name, tree_type: TreeType, form: Name, level: u32, colour: Colour, size: Option<[f64; 2]> },
    Shadow { tree: Name, tree_type: TreeType, emitter: [f64; 3], colour: Colour, merged: bool },
    Open { workstation: Name, kind: WorkstationType },
    Close { workstation: Name },
    Port { workstation: Name, view: ViewType, frame: [f64; 4] },
    Window { workstation: Name, frame: [f64; 4] },
    Activate { workstation: Name, device: Device },
    Deactivate { workstation: Name, device: Device },
    Clear { workstation: Name },
    BackColor { colour: Colour },
    Exit,
    Local,
    Defer { lag: f64 },
    Help { command: Option<Name> },
}
