//! Plants at one age, each in its place, of which wood and organs are drawn apart: wood as triangles, organs as lives
//! of that one age, whose parts are instances of models.
//!
//! Absent: models (`models`) and files, which are the writers'.

use super::{Life, Maker, Nearness};
use phytomer_meshes::{MeshOptions, PlotBody, PlotMember, PlotMesh, Scene};
use phytomer_sim::plant::{Class, Kind};
use std::sync::Arc;

/// How near the organs of a still are to those of its meshes, metres; they have one age, so nothing is left out.
const NEAR: f32 = 1e-3;

/// How a file has organs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Organs {
    /// As instances of their models.
    #[default]
    Instances,
    /// Merged into one mesh.
    Merged,
}

/// A plant of a file.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Member {
    /// Its life, by its place.
    pub life: usize,
    /// Where it stands, metres.
    pub offset: [f32; 3],
    /// What is added to its component numbers, times 2³², to make them ids that no other plant of the file has.
    pub number: u32,
}

impl Member {
    /// The id of a component.
    pub fn id_of(&self, component: u32) -> i64 {
        i64::from(self.number) << 32 | i64::from(component)
    }
}

/// The organs of plants that stand at one age.
pub struct StillOrgans {
    /// The lives of that age, equal ones once.
    pub lives: Vec<Life>,
    /// The options of each life.
    pub options: Vec<MeshOptions>,
    /// What stands where.
    pub members: Vec<Member>,
    /// What the members are called.
    pub names: Vec<String>,
}

impl StillOrgans {
    /// The organs of a plant.
    pub fn of_plant(scene: &Scene) -> Self {
        Self {
            lives: vec![organs_of(scene)],
            options: vec![scene.options().clone()],
            members: vec![Member::default()],
            names: vec![format!("plant {}", scene.plant().id)],
        }
    }

    /// The organs of the plants of a plot.
    pub fn of_plot(plot: &PlotMesh) -> Self {
        let scenes = plot.bodies.iter().map(|body| Scene::new(body.plant, body.age, &body.options));
        let member = |(number, member): (usize, &PlotMember)| Member {
            life: member.body,
            offset: member.place.map(|x| x as f32),
            number: number as u32,
        };
        Self {
            lives: scenes.map(|scene| organs_of(&scene)).collect(),
            options: plot.bodies.iter().map(|body| body.options.clone()).collect(),
            members: plot.members.iter().enumerate().map(member).collect(),
            names: plot.members.iter().map(|member| member.name.clone()).collect(),
        }
    }
}

/// The options of the wood alone.
pub fn wood_of(options: &MeshOptions) -> MeshOptions {
    let kinds = Kind::ALL.map(|kind| options.kinds[kind as usize] && is_wood(kind));
    MeshOptions { kinds, ..options.clone() }
}

/// The options of the organs alone.
pub fn organs_alone(options: &MeshOptions) -> MeshOptions {
    let kinds = Kind::ALL.map(|kind| options.kinds[kind as usize] && !is_wood(kind));
    MeshOptions { kinds, ..options.clone() }
}

/// A plot without its wood and its obstacles.
pub fn organs_of_plot<'p>(plot: &PlotMesh<'p>) -> PlotMesh<'p> {
    let mut organs = wood_of_plot(plot);
    let of = |body: &PlotBody<'p>| PlotBody { plant: body.plant, age: body.age, options: organs_alone(&body.options) };
    organs.bodies = plot.bodies.iter().map(of).collect();
    organs.obstacles.clear();
    organs
}

/// A plot without its organs.
pub fn wood_of_plot<'p>(plot: &PlotMesh<'p>) -> PlotMesh<'p> {
    let wood = |of: &PlotBody<'p>| PlotBody { plant: of.plant, age: of.age, options: wood_of(&of.options) };
    PlotMesh {
        bodies: plot.bodies.iter().map(wood).collect(),
        members: plot.members.clone(),
        obstacles: plot.obstacles.iter().map(Arc::clone).collect(),
        name: plot.name.clone(),
        place: plot.place,
    }
}

fn is_wood(kind: Kind) -> bool {
    kind.class() == Class::Internode
}

/// The organs of a plant at its age.
fn organs_of(scene: &Scene) -> Life {
    let mut maker = Maker::new(Nearness::of(NEAR), &organs_alone(scene.options()));
    maker.show(scene.plant(), scene.age());
    maker.finish()
}
