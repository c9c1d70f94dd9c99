//! The trees of a plan as bodies: each species, age and seed grown once.
//!
//! Wood stands in every month; leaves, flowers and fruits are what months without leaves do not have. Absent: growing,
//! which is `run::regrowth`'s, and forms, which are those of meshes.

use super::ShadeError;
use crate::run::RunError;
use crate::run::drawing::{check_size, options_of};
use crate::run::forms;
use crate::run::regrowth::Regrowth;
use phytomer_config::plan::ResolvedPlan;
use phytomer_config::{Resolved, ResolvedSpecies, Trial};
use phytomer_models::fault::{Fault, Path};
use phytomer_outputs::meshes::{Keeping, Mesh, MeshOptions, Scene, Tolerance, mesh_plant};
use phytomer_shade::{Body, Stopped, Watch};
use phytomer_sim::plant::{Kind, PartOfPlant};

/// The most components of a tree.
const MOST_COMPONENTS: u32 = 4_000_000;
/// The most triangles of a tree.
const MOST_TRIANGLES: usize = 20_000_000;
/// The sides of tubes that are drawn by themselves.
const SIDES: u32 = 8;

/// What a tree is grown from: its species and age by their place among the mentions, and its seed.
struct Wanted<'a> {
    species: &'a ResolvedSpecies,
    name: &'a str,
    age: u32,
    seed: u64,
    path: Path,
}

/// The bodies of trees and then of candidates.
pub struct Grown {
    bodies: Vec<Body>,
    /// The body of each.
    of: Vec<usize>,
}

impl Grown {
    /// Grows them all.
    pub fn of(resolved: &ResolvedPlan, say: &mut dyn FnMut(&str), watch: &Watch) -> Result<Self, ShadeError> {
        let mut grown = Self { bodies: Vec::new(), of: Vec::new() };
        let mut known: Vec<(&str, u32, u64)> = Vec::new();
        for wanted in wanted(resolved) {
            let key = (wanted.name, wanted.age, wanted.seed);
            let place = known.iter().position(|known| *known == key);
            if let Some(place) = place {
                grown.of.push(place);
                continue;
            }
            if watch.is_stopped() {
                return Err(Stopped.into());
            }
            say(&format!("{} of age {}, seed {}", wanted.name, wanted.age, wanted.seed));
            grown.of.push(grown.bodies.len());
            grown.bodies.push(body(&wanted, resolved.plan.tolerance_m as f32)?);
            known.push(key);
        }
        Ok(grown)
    }

    /// The body of a tree, or of a candidate after all trees.
    pub fn body(&self, number: usize) -> &Body {
        &self.bodies[self.of[number]]
    }
}

/// Trees and candidates in their order.
fn wanted(resolved: &ResolvedPlan) -> Vec<Wanted<'_>> {
    let (plan, root) = (&resolved.plan, Path::root());
    let trees = plan.tree.iter().enumerate();
    let trees = trees.map(|(k, tree)| (tree.species.as_str(), tree.age, tree.seed, root.key("tree").index(k)));
    let candidates = plan.arrange.iter().flat_map(|arrange| arrange.candidate.iter().enumerate());
    let candidates = candidates.map(|(k, candidate)| {
        let path = root.key("arrange").key("candidate").index(k);
        (candidate.species.as_str(), candidate.age, candidate.seed, path)
    });
    let all = trees.chain(candidates).zip(&resolved.species);
    let of = |((name, age, seed, path), species): ((_, Option<u32>, _, Path), _)| {
        let species: &ResolvedSpecies = species;
        Wanted { species, name, age: age.unwrap_or_else(|| species.shown_at()).max(1), seed, path }
    };
    all.map(of).collect()
}

/// Grows a tree and takes its triangles.
fn body(wanted: &Wanted<'_>, tolerance_m: f32) -> Result<Body, ShadeError> {
    let failed = |error: RunError| ShadeError::Tree(wanted.name.to_owned(), Box::new(error));
    let Resolved { mut scenario, species, .. } = wanted.species.clone().alone(wanted.name);
    scenario.ages.until = wanted.age;
    scenario.plants = 1;
    scenario.seed = wanted.seed;
    scenario.limits.max_components = MOST_COMPONENTS;
    let model = species.model.compile(wanted.age).map_err(|faults| too_old(wanted, faults))?;
    let own = forms::of(&species).map_err(failed)?;
    // The width of wood is what casts its shadow.
    let within = Tolerance { keeps: Keeping::Width, organs: true, ..Tolerance::of(tolerance_m) };
    let options = MeshOptions { tolerance: Some(within), ..options_of(SIDES, &own) };
    let regrowth = Regrowth::new(Trial::of(&scenario, &[]), vec![model.as_ref()], None);
    let mut mesh = Mesh::default();
    let mut too_many = None;
    let shown = regrowth.show(0, &[wanted.age], &mut |age, plant| {
        let scene = Scene::new(plant, age, &options);
        check_size(&scene)?;
        let triangles = scene.counts().faces as usize;
        if triangles > MOST_TRIANGLES {
            too_many = Some(triangles);
        } else {
            mesh = mesh_plant(plant, age, &options);
        }
        Ok(())
    });
    shown.map_err(failed)?;
    match too_many {
        Some(triangles) => {
            let problem = format!("{} has {triangles} triangles, and {MOST_TRIANGLES} are the most", wanted.name);
            let expected = "a larger `tolerance_m`, a smaller age, or another species";
            Err(ShadeError::Wrong(vec![Fault::new(&wanted.path.key("species"), problem, expected)]))
        }
        None => Ok(parted(&mesh)),
    }
}

/// A model that refuses the age, told at the tree that asks for it.
fn too_old(wanted: &Wanted<'_>, faults: Vec<Fault>) -> ShadeError {
    let first = faults.into_iter().next().map(|fault| fault.to_string()).unwrap_or_default();
    let problem =
        format!("{} cannot be grown to the age {}: {}", wanted.name, wanted.age, first.trim_start_matches(": "));
    ShadeError::Wrong(vec![Fault::new(&wanted.path.key("species"), problem, "an age that its model has")])
}

/// Wood and what it bears.
fn parted(mesh: &Mesh) -> Body {
    let mut body = Body::default();
    for face in &mesh.faces {
        let corners = face.indices().map(|index| &mesh.vertices[index as usize]);
        let kind = Kind::ALL[usize::from(corners[0].tag().kind)];
        let part = if kind.part() == PartOfPlant::Shoot { &mut body.lasting } else { &mut body.seasonal };
        part.push(corners.map(|corner| corner.position()));
    }
    body
}
