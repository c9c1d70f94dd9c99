//! Levels of detail of all plants of a plot (`--plot --lods 4`).
//!
//! Each plant keeps its own outline: level k of the plot has level k of each plant, or the last that it has. Counts are
//! shared out among the plants in proportion to their triangles, after the obstacles, which stay as they are. Absent:
//! the levels of one plant (`phytomer_outputs::pictures::levels`), and cards.

use super::super::{Misuse, Verdict, amounts, out};
use super::Mesh;
use super::formats::Format;
use super::lods::{named, screen_of, too_coarse};
use anyhow::{Context, Result};
use phytomer_outputs::Destination;
use phytomer_outputs::gltf::{self, write_levels};
use phytomer_outputs::meshes::{Drawing, PlotBody, PlotDrawing, PlotMesh, Scene};
use phytomer_outputs::pictures::levels::{Level, levels};
use serde_json::{Map, json};
use std::path::PathBuf;

/// A level of a plot.
struct OfPlot<'p> {
    mesh: PlotMesh<'p>,
    faces: u64,
    /// The farthest that an outline of a plant is, as a share of its area.
    apart: f64,
}

impl OfPlot<'_> {
    fn in_words(&self, number: usize) -> String {
        let faces = amounts::of(self.faces, "triangle");
        format!("level {number}: {faces}, outline of each plant within {:.1} %", 100.0 * self.apart)
    }
}

/// Writes the levels of a plot.
pub fn write(mesh: &Mesh, plot: &PlotMesh, format: Format, what: &str) -> Result<Verdict> {
    let most = mesh.lods.most();
    let (asked, found) = (most.len() + 1, of_plot(plot, what, &most)?);
    let mut lines: Vec<String> = found.iter().enumerate().map(|(number, level)| level.in_words(number)).collect();
    if found.len() < asked
        && let Some(last) = lines.last_mut()
    {
        *last += "; further levels would have hardly fewer, or another outline";
    }
    if let Format::Glb(_) | Format::Usd(..) = format {
        let bytes = match format {
            Format::Usd(..) => write_usd(mesh, format, &found)?,
            _ => write_glb(mesh, &found)?,
        };
        let bytes = amounts::bytes(bytes as f64);
        let levels = amounts::of(lines.len() as u64, "level");
        out::tell(&mesh.out, &format!("{what}, {levels}, {bytes}\n  {}", lines.join("\n  ")))?;
        return Ok(Verdict::Done);
    }
    for ((number, level), line) in found.iter().enumerate().zip(lines) {
        let path: PathBuf = named(&mesh.out, number);
        let mut file = Destination::create(&path)?;
        let written = format.write_plot(&level.mesh, &mut file, &path);
        written.with_context(|| format!("cannot write {}", path.display()))?;
        out::tell(&path, &format!("{what}, {line}, {}", amounts::bytes(file.finish()? as f64)))?;
    }
    Ok(Verdict::Done)
}

/// The levels of all plants, and how many triangles the plot has in each.
fn of_plot<'p>(plot: &PlotMesh<'p>, what: &str, most: &[Option<u64>]) -> Result<Vec<OfPlot<'p>>, Misuse> {
    let faces: Vec<u64> =
        plot.bodies.iter().map(|body| Scene::new(body.plant, body.age, &body.options).counts().faces).collect();
    let standing: u64 = plot.members.iter().filter_map(|member| faces.get(member.body)).sum();
    let obstacles: u64 = plot.obstacles.iter().map(|mesh| mesh.faces.len() as u64).sum();
    let part = |most: u64, faces: u64| {
        (u128::from(most.saturating_sub(obstacles)) * u128::from(faces) / u128::from(standing.max(1))) as u64
    };
    let mut of_bodies: Vec<Vec<Level>> = Vec::new();
    for (body, faces) in plot.bodies.iter().zip(&faces) {
        let most: Vec<Option<u64>> = most.iter().map(|most| most.map(|most| part(most, *faces))).collect();
        let found = levels(body.plant, body.age, &body.options, &most);
        let what = format!("plant {} of {what}", body.plant.id);
        of_bodies.push(found.map_err(|fault| too_coarse(&what, fault))?);
    }
    let count = of_bodies.iter().map(Vec::len).max().unwrap_or(1);
    Ok((0..count)
        .map(|number| {
            let of = |body: usize| &of_bodies[body][number.min(of_bodies[body].len() - 1)];
            let drawn = |(place, body): (usize, &PlotBody<'p>)| PlotBody {
                plant: body.plant,
                age: body.age,
                options: of(place).options.clone(),
            };
            let of_plants: u64 = plot.members.iter().map(|member| of(member.body).faces).sum();
            OfPlot {
                mesh: PlotMesh {
                    bodies: plot.bodies.iter().enumerate().map(drawn).collect(),
                    members: plot.members.clone(),
                    obstacles: plot.obstacles.clone(),
                    name: plot.name.clone(),
                    place: plot.place,
                },
                faces: of_plants + obstacles,
                apart: (0..plot.bodies.len()).map(|body| of(body).apart.area).fold(0.0, f64::max),
            }
        })
        .collect())
}

fn write_glb(mesh: &Mesh, found: &[OfPlot]) -> Result<u64> {
    let drawings = found.iter().map(|level| level.mesh.drawing()).collect::<std::io::Result<Vec<PlotDrawing>>>();
    let drawings = drawings.with_context(|| mesh.failing())?;
    let faces: Vec<u64> = found.iter().map(|level| level.faces).collect();
    let told = |number: usize| {
        let mut told = Map::new();
        told.insert("triangles".to_owned(), json!(faces[number]));
        told.insert("outline_area_apart".to_owned(), json!(found[number].apart));
        told
    };
    let level = |(number, mesh)| gltf::Level { mesh, screen: screen_of(&faces, number), told: told(number) };
    let levels: Vec<gltf::Level> =
        drawings.iter().map(|drawing| drawing as &dyn Drawing).enumerate().map(level).collect();
    let mut file = Destination::create(&mesh.out)?;
    write_levels(&levels, None, &mut file).with_context(|| mesh.failing())?;
    Ok(file.finish()?)
}

fn write_usd(mesh: &Mesh, format: Format, found: &[OfPlot]) -> Result<u64> {
    let words = found.iter().enumerate().map(|(number, level)| level.in_words(number));
    let words = words.collect::<Vec<_>>().join("; ");
    let levels: Vec<&PlotMesh> = found.iter().map(|level| &level.mesh).collect();
    let mut file = Destination::create(&mesh.out)?;
    format.write_plot_levels(&levels, &words, &mut file, &mesh.out).with_context(|| mesh.failing())?;
    Ok(file.finish()?)
}
