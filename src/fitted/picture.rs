//! A picture of measured trees and of the tree that was fitted to them, side by side, from the front and from the side,
//! as Figs. 15 and 17 of Aono & Kunii 1984.
//!
//! The fitted tree is grown from its species file, so that what is seen is what `grow` grows. Absent: the fit.

use crate::asystem::{SIZE, full_grown};
use phytomer_config::{Model, validate_texts};
use phytomer_fits::gmt::Skeleton;
use phytomer_models::geometric::TreeType;
use phytomer_outputs::meshes::{MeshOptions, Scene};
use phytomer_outputs::pictures::{Compression, write_png};
use phytomer_sim::plant::NodeId;
use phytomer_strokes::{Branch, Drawing, Fill, Port, Sheet, View};

/// The colours of what was measured, and of what was fitted.
const COLOURS: [[u8; 3]; 2] = [[30, 70, 150], [0; 3]];
/// The room between trees, as a share of the widest.
const ROOM: f64 = 0.15;

/// A branch as it is drawn: its ends, and its diameter at both.
type Line = ([[f64; 3]; 2], Option<[f64; 2]>);

/// A picture as bytes of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pictured {
    /// Lines.
    Svg,
    /// Pixels.
    Png,
}

/// The picture of trees and of the species that was fitted to them; the trees that were measured are blue.
///
/// # Errors
/// In words: a species that does not grow.
pub fn picture(measured: &Skeleton, species: &str, format: Pictured) -> Result<Vec<u8>, String> {
    let of_data = measured.branches.iter().map(|branch| {
        let tip = [0, 1, 2].map(|k| branch.base[k] + branch.vector[k]);
        ([branch.base, tip], branch.diameter.map(|diameter| [diameter; 2]))
    });
    let of_data: Vec<Line> = of_data.collect();
    let fitted = grown(species)?;
    let mut drawing = Drawing::default();
    let mut right = 0.0;
    for turned in [false, true] {
        for (lines, colour) in [&of_data, &fitted].into_iter().zip(COLOURS) {
            right = beside(&mut drawing, lines, turned, colour, right);
        }
    }
    let ports = vec![Port { view: View::Front, frame: [0.0, 1.0, 1.0, 0.0], window: None }];
    let sheet = Sheet { size: SIZE, background: [255; 3], ports, stars: false };
    match format {
        Pictured::Svg => Ok(sheet.svg(&drawing).into_bytes()),
        Pictured::Png => {
            let mut bytes = Vec::new();
            write_png(&sheet.pixels(&drawing), "phytomer fit gmt", Compression::High, &mut bytes)
                .map_err(|error| error.to_string())?;
            Ok(bytes)
        }
    }
}

/// Draws lines to the right of `from`, turned so that their side is seen or not. Returns where the next ones begin.
fn beside(drawing: &mut Drawing, lines: &[Line], turned: bool, colour: [u8; 3], from: f64) -> f64 {
    let seen = |[x, y, z]: [f64; 3]| if turned { [y, -x, z] } else { [x, y, z] };
    let across = || lines.iter().flat_map(|(ends, _)| ends).map(|end| seen(*end)[0]);
    let [low, high] = across().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    if low > high {
        return from;
    }
    for (ends, girth) in lines {
        let ends = ends.map(|end| {
            let [x, y, z] = seen(end);
            [x - low + from, y, z]
        });
        drawing.branches.push(Branch { ends, girth: *girth, colour, fill: Fill::FULL });
    }
    from + (1.0 + ROOM) * (high - low).max(0.05 * height(lines))
}

fn height(lines: &[Line]) -> f64 {
    lines.iter().flat_map(|(ends, _)| ends).map(|end| end[2]).fold(0.0, f64::max)
}

/// The branches of a full-grown tree of a species.
fn grown(species: &str) -> Result<Vec<Line>, String> {
    let resolved = validate_texts("fitted.toml", &[("fitted.toml", species)]).map_err(|report| report.render(false))?;
    let (of, tree) = match &resolved.species.model {
        Model::Gmt1(tree) => (TreeType::Gmt1, &tree.0),
        Model::Gmt2(tree) => (TreeType::Gmt2, &tree.0),
        Model::Gmt3(tree) => (TreeType::Gmt3, &tree.0),
        Model::Gmt4(tree) => (TreeType::Gmt4, &tree.0),
        other => return Err(format!("the species is of {:?}, and a geometric tree is expected", other.name())),
    };
    let (plant, age) = full_grown(tree, of)?;
    let options = MeshOptions::default();
    let scene = Scene::new(&plant, age, &options);
    let line = |node: NodeId| {
        let frustum = scene.stems().frustum(node);
        let base = frustum.base.map(f64::from);
        let tip = [0, 1, 2].map(|k| base[k] + f64::from(frustum.heading[k] * frustum.length));
        ([base, tip], Some(frustum.radii.map(|radius| 2.0 * f64::from(radius))))
    };
    Ok((0..plant.nodes.len() as u32).map(NodeId).filter(|node| plant.stands(*node, age)).map(line).collect())
}
