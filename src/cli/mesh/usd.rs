//! A life as a USD file: a plant or a plot at each of some ages, as time samples.
//!
//! Absent: growing (`run::living`), what a life is (`phytomer_outputs::life`), and the file (`phytomer_outputs::usd`).

use super::super::budget::{Asked as Fineness, in_words};
use super::super::regrown::Regrown;
use super::super::span::{Span, shown};
use super::super::{Verdict, amounts};
use super::formats::{beside_usd, stem};
use super::{Format, Mesh};
use anyhow::{Context, Result};
use phytomer::run::drawing::options_of;
use phytomer::run::living::{Living, lives};
use phytomer::run::regrowth::Whose;
use phytomer_outputs::Destination;
use phytomer_outputs::meshes::{Drawing, MeshOptions, Pictures, PlotMesh, Tolerance};
use phytomer_outputs::usd::{self, Asked, Pace, Plants};

/// How near a life is to the plant where nothing is said, metres.
const NEAR: f32 = 1e-3;
/// The most ages of a tick that are shown where no step is stated.
const FINEST: f64 = 4.0;
/// The time codes of a second.
const A_SECOND: f64 = 24.0;

/// Grows the plant or the plot of a mesh and writes its life.
pub fn write(mesh: &Mesh, regrown: &Regrown, format: Format) -> Result<Verdict> {
    let Format::Usd(encoding, organs) = format else { return Err(format.holds_no("ages").into()) };
    let (whose, ages) = shown(regrown, (mesh.plant, mesh.plot), mesh.growing.ages, "--ages")?;
    let regrowth = regrown.regrowth(&mesh.breeze)?.falling(mesh.fall.fall);
    let mut file = Destination::create(&mesh.out)?;
    let within = match mesh.budget.asked() {
        Fineness::Within(tolerance) => tolerance,
        Fineness::Full | Fineness::Triangles(_) => Tolerance::of(NEAR),
    };
    // Lives of a species share the forms from near that their options have met.
    let each = regrown
        .forms
        .iter()
        .map(|forms| MeshOptions { detail: mesh.dressing.detail(), ..options_of(mesh.sides, forms) });
    let each: Vec<MeshOptions> = each.collect();
    let options = |species: usize| each[species].clone();
    let finer = Span { step: ages.step.or_else(|| step_of(ages, mesh.growing.seconds)), ..ages };
    let living = lives(&regrowth, whose, &finer.moments(), (within.distance, &options))?;
    let what = match whose {
        Whose::Plant(plant) => format!("plant {plant} from age {} to age {}", ages.first, ages.last),
        Whose::Plot(plot) => format!("plot {plot} from tick {} to tick {}", ages.first, ages.last),
    };
    let words = format!("{what}, seed {}", regrown.scenario.seed);
    let Living { lives, options, members, obstacles } = &living;
    let obstacles = obstacles.as_ref().map(PlotMesh::drawing).transpose()?;
    let obstacles = obstacles.as_ref().map(|obstacles| obstacles as &dyn Drawing);
    let plants = Plants { obstacles, ..Plants::of(lives, options, members) };
    let pictures = Pictures::of(&usd::slots_of(&plants), stem(&mesh.out));
    let asked = Asked { encoding, organs, words, pictures };
    let pace = pace(ages, mesh.growing.seconds);
    usd::write_life(&asked, &plants, within.distance, &pace, &mut file).with_context(|| mesh.failing())?;
    beside_usd(&asked, &mesh.out).with_context(|| mesh.failing())?;
    let plants = mesh.plot.map(|_| format!(", {}", amounts::of(members.len() as u64, "plant"))).unwrap_or_default();
    mesh.tell(file, &format!("{what}{plants}{}", in_words(Some(&within))))
}

/// The step of a life that has several frames a tick, in ticks: a quarter at most, since between the ages that are
/// shown all goes linearly, and nodes of a growth unit lengthen one after another.
fn step_of(ages: Span, seconds: Option<f64>) -> Option<f64> {
    let frames = (seconds? * A_SECOND / (ages.last - ages.first).max(1.0)).floor();
    (frames >= 2.0).then(|| 1.0 / frames.min(FINEST))
}

fn pace(ages: Span, seconds: Option<f64>) -> Pace {
    let ticks = ages.last - ages.first;
    let a_tick = seconds.filter(|_| ticks > 0.0).map_or(1.0, |seconds| seconds * A_SECOND / ticks);
    Pace { a_tick, a_second: A_SECOND }
}
