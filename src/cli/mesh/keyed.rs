//! A life as a GLB file: morph targets at some of its ages, and an animation.
//!
//! Absent: growing (`run::keying`) and the file (`phytomer_outputs::gltf`).

use super::super::budget::{Asked, in_words};
use super::super::regrown::{Breeze, Regrown};
use super::super::span::shown;
use super::super::{Misuse, Verdict, amounts, out};
use super::Mesh;
use anyhow::{Context, Result};
use phytomer::run::keying::{Keying, keyed};
use phytomer::run::regrowth::Whose;
use phytomer_outputs::Destination;
use phytomer_outputs::gltf::write_growth;
use phytomer_outputs::meshes::Tolerance;

/// How near the wood of a life is drawn where no tolerance is given, metres.
const NEARNESS: f32 = 1e-3;
/// The keys where no number is given.
const KEYS: u32 = 16;
/// How long the animation is where no length is given, seconds.
const SECONDS: f64 = 12.0;

/// Grows the plant or the plot of a mesh and writes its life.
pub fn write(mesh: &Mesh, regrown: &Regrown) -> Result<Verdict> {
    let (whose, ages) = shown(regrown, (mesh.plant, mesh.plot), mesh.growing.ages, "--ages")?;
    if ages.first == ages.last {
        return Err(Misuse(format!("--ages {}: a life has two ages at least", ages.first)).into());
    }
    let tolerance = match mesh.budget.asked() {
        Asked::Within(tolerance) => tolerance,
        Asked::Full | Asked::Triangles(_) => Tolerance::of(NEARNESS),
    };
    let seconds = mesh.growing.seconds.unwrap_or(SECONDS);
    let (ages_of_keys, detail) = (ages.keys(mesh.growing.keys.unwrap_or(KEYS)), mesh.dressing.detail());
    let keying = Keying { ages: ages_of_keys, tolerance, seconds, detail };
    let mut file = Destination::create(&mesh.out)?;
    let growth = keyed(&regrown.regrowth(&Breeze::default())?.falling(mesh.fall.fall), whose, &keying, &regrown.forms)?;
    let written = write_growth(&growth, &mut file).with_context(|| mesh.failing())?;
    let (what, unit) = match whose {
        Whose::Plant(plant) => (format!("plant {plant}"), "age"),
        Whose::Plot(plot) => (format!("plot {plot}"), "tick"),
    };
    let told = format!(
        "{what} from {unit} {} to {}, {} keys in {seconds} s{}, places to {:.2} mm, {} triangles, {}",
        ages.first,
        ages.last,
        keying.ages.len(),
        in_words(Some(&tolerance)),
        1000.0 * written.step,
        amounts::count(written.faces),
        amounts::bytes(file.finish()? as f64),
    );
    out::tell(&mesh.out, &told)?;
    Ok(Verdict::Done)
}
