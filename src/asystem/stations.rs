//! Workstations: files that show a stage. A display is a picture, a plotter a drawing of lines, a model a mesh.
//!
//! As in GKS (ISO 7942) a window is a part of the view's plane, and a port a part of the sheet. A workstation without
//! ports shows one view on its whole sheet.

use phytomer_asystem::{ViewType, Viewing, WorkstationType};
use phytomer_strokes::{Colour, Drawing, Place, Port, Sheet, View, Window};

/// The size of a sheet, pixels: the frame buffer of the Seillac 3 on which the A-system drew.
pub const SIZE: [u32; 2] = [1368, 1022];

/// What a workstation shows.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Content {
    /// All trees that are visible.
    #[default]
    All,
    /// One of them.
    Tree(String),
    /// Those of a cluster.
    Cluster(String),
    /// None, until a new view.
    Nothing,
}

/// A workstation.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// What it writes.
    pub kind: WorkstationType,
    /// What it shows.
    pub content: Content,
    ports: Vec<(ViewType, [f64; 4])>,
    window: Option<Window>,
    viewing: Viewing,
    /// How long each of its frames is shown, seconds.
    pub frames: Vec<f64>,
    /// Whether it shows the controllers of its trees: while its valuator is active, by which they are placed.
    pub controllers: bool,
}

impl Station {
    /// A workstation that shows everything from the front.
    pub fn open(kind: WorkstationType) -> Self {
        let (content, viewing) = (Content::default(), Viewing::default());
        let (ports, frames) = (Vec::new(), Vec::new());
        Self { kind, content, ports, window: None, viewing, frames, controllers: false }
    }

    /// The ending of its files.
    pub fn ending(&self) -> &'static str {
        match self.kind {
            WorkstationType::Display => "png",
            WorkstationType::Plotter => "svg",
            WorkstationType::Model => "ply",
        }
    }

    /// Adds a port.
    pub fn add_port(&mut self, view: ViewType, frame: [f64; 4]) {
        self.ports.push((view, frame));
    }

    /// States the window of all ports.
    pub fn set_window(&mut self, window: Window) {
        self.window = Some(window);
    }

    /// Shows something else; a view that is stated takes the whole sheet.
    pub fn show(&mut self, content: Content, viewing: Viewing) {
        if viewing.view.is_some() {
            self.ports.clear();
        }
        (self.content, self.viewing) = (content, viewing);
    }

    /// Takes all ports and shows nothing.
    pub fn clear(&mut self) {
        self.ports.clear();
        self.window = None;
        self.content = Content::Nothing;
    }

    /// Its sheet, for a drawing that is as high as this.
    pub fn sheet(&self, background: Colour, drawing: &Drawing) -> Sheet {
        let whole = [(self.viewing.view.unwrap_or(ViewType::Front), [0.0, 1.0, 1.0, 0.0])];
        let ports = if self.ports.is_empty() { &whole[..] } else { &self.ports };
        let port = |(view, frame): &(ViewType, [f64; 4])| Port {
            view: self.view(*view, drawing),
            frame: *frame,
            window: self.window,
        };
        Sheet { size: SIZE, background, ports: ports.iter().map(port).collect(), stars: self.controllers }
    }

    fn view(&self, view: ViewType, drawing: &Drawing) -> View {
        match view {
            ViewType::Top => View::Top,
            ViewType::Front => View::Front,
            ViewType::Side => View::Side,
            ViewType::Oblique => View::Oblique,
            ViewType::Perspective => {
                let [low, high] = extent(drawing);
                let target = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
                View::Perspective { eye: self.viewing.point.unwrap_or_else(|| before([low, high])), target }
            }
        }
    }
}

/// An eye before a box, three times as far away as that is large, at a third of its height.
fn before([low, high]: [Place; 2]) -> Place {
    let large = (high[0] - low[0]).max(high[2] - low[2]).max(1e-3);
    [0.5 * (low[0] + high[0]), low[1] - 3.0 * large, high[2].max(1e-3) / 3.0]
}

/// The box around the branches of a drawing; a metre at the origin where there are none.
fn extent(drawing: &Drawing) -> [Place; 2] {
    let ends = drawing.branches.iter().flat_map(|branch| branch.ends);
    let none = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let [low, high] = ends.fold(none, |[low, high], place| {
        [[0, 1, 2].map(|k| place[k].min(low[k])), [0, 1, 2].map(|k| place[k].max(high[k]))]
    });
    if low[0] > high[0] { [[0.0; 3], [0.0, 0.0, 1.0]] } else { [low, high] }
}
