//! How entities are drawn: by the shapes that they bring along, else by a shape for each role, put where they are.
//!
//! Wood is a cylinder of unit length and width along x, organs are forms of the library of `phytomer_meshes`, whose
//! length and width are 1 as well. An entity without a place, a direction, a length and a width has no shape, since
//! its file does not tell what it looks like. Absent: how formats write it.

use super::description::{Description, Entity, Form, Material, Mesh, Role, Shape};
use super::vectors::{frame, upward};
use phytomer_looks::FormName;
use phytomer_meshes::{Depth, MeshOptions};
use phytomer_sim::plant;

/// The corners around the cylinder that stands for wood.
const SIDES: u32 = 12;
/// Reference meshes are so long and so wide, m: what formats in centimetres write as 1.
const UNIT: f64 = 0.01;
/// What is shorter or thinner is not drawn, m.
const LEAST: f64 = 1e-9;

/// All that a description draws with.
#[derive(Debug)]
pub struct Drawn {
    /// Meshes: those of the description, then those that are added.
    pub meshes: Vec<Mesh>,
    /// Materials: those of the description, then those that are added.
    pub materials: Vec<Material>,
    /// Shapes: those of the description, then those that are added.
    pub shapes: Vec<Shape>,
    /// Of each mesh whether widths taper it: all but those that entities are drawn with without any.
    pub tapered: Vec<bool>,
    /// The added shape of each role.
    added: Vec<(Role, u32)>,
}

impl Drawn {
    /// Meshes, materials and shapes of a description, and those that its entities need beside them.
    pub fn of(description: &Description) -> Self {
        let mut drawn = Self {
            meshes: description.meshes.clone(),
            materials: description.materials.clone(),
            shapes: description.shapes.clone(),
            tapered: Vec::new(),
            added: Vec::new(),
        };
        let entities = || description.individuals.iter().flat_map(|plant| &plant.entities);
        // Whether some entity is drawn with each mesh without widths, and whether some is with them.
        let mut ways = vec![[false; 2]; description.meshes.len()];
        for form in entities().filter_map(|entity| entity.form.as_ref()) {
            if let Some(shape) = drawn.shapes.get(form.shape as usize) {
                ways[shape.mesh as usize][usize::from(form.taper.is_some())] = true;
            }
        }
        drawn.tapered = ways.into_iter().map(|way| way != [true, false]).collect();
        for role in [Role::Internode, Role::Leaf, Role::Flower, Role::Fruit] {
            let lacks = |entity: &&Entity| entity.form.is_none() && description.role_of(entity) == role;
            if entities().filter(lacks).any(|entity| placed(entity).is_some()) {
                drawn.add(role);
            }
        }
        drawn
    }

    fn add(&mut self, role: Role) {
        let Some((name, mesh, colour)) = stock(role) else { return };
        self.added.push((role, self.shapes.len() as u32));
        self.shapes.push(Shape {
            name: name.to_owned(),
            mesh: self.meshes.len() as u32,
            material: Some(self.materials.len() as u32),
        });
        self.meshes.push(mesh);
        self.tapered.push(true);
        self.materials.push(material(name, colour));
    }

    /// The shape of an entity; `None` where it is not drawn.
    pub fn shape(&self, role: Role, entity: &Entity) -> Option<u32> {
        match &entity.form {
            Some(form) => Some(form.shape),
            None => {
                let (_, shape) = self.added.iter().find(|(known, _)| *known == role)?;
                placed(entity).map(|_| *shape)
            }
        }
    }

    /// How an entity is drawn; `None` where it is not.
    pub fn form(&self, role: Role, entity: &Entity) -> Option<Form> {
        if let Some(form) = &entity.form {
            return Some((**form).clone());
        }
        let (_, shape) = self.added.iter().find(|(known, _)| *known == role)?;
        let (matrix, taper) = placed(entity)?;
        Some(Form { shape: *shape, matrix, taper: Some(taper) })
    }
}

/// The matrix of a reference mesh of unit length for an entity, and its widths in units of the mesh.
fn placed(entity: &Entity) -> Option<([[f64; 4]; 3], [f64; 2])> {
    let seen = entity.latest()?;
    let (length, base) = (seen.length?, seen.base_diameter?);
    let (along, place) = (seen.direction?, seen.place?);
    let tip = seen.tip_diameter.unwrap_or(base);
    if length < LEAST || base.max(tip) < LEAST {
        return None;
    }
    let up = seen.up.unwrap_or_else(|| upward(along));
    let matrix = frame(along.map(|x| x * (length / UNIT)), up, place);
    Some((matrix, [base / UNIT, tip / UNIT]))
}

/// Name, mesh and colour of what stands for entities of a role.
fn stock(role: Role) -> Option<(&'static str, Mesh, [f64; 3])> {
    match role {
        Role::Internode => Some(("internode", cylinder("internode"), [0.45, 0.34, 0.22])),
        Role::Leaf => Some(("leaf", organ("leaf", FormName::Elliptic), [0.25, 0.45, 0.14])),
        Role::Flower => Some(("flower", organ("flower", FormName::Corolla), [0.9, 0.6, 0.7])),
        Role::Fruit => Some(("fruit", organ("fruit", FormName::Berry), [0.75, 0.15, 0.12])),
        _ => None,
    }
}

fn material(name: &str, [red, green, blue]: [f64; 3]) -> Material {
    let colour = [red, green, blue, 1.0];
    Material {
        name: name.to_owned(),
        emission: [0.0, 0.0, 0.0, 1.0],
        ambient: colour,
        diffuse: colour,
        specular: [0.1, 0.1, 0.1, 1.0],
        shininess: 10.0,
    }
}

/// An open cylinder from x = 0 to x = 1 unit, of width 1 unit.
fn cylinder(name: &str) -> Mesh {
    let mut mesh = Mesh { name: name.to_owned(), ..Mesh::default() };
    for (x, u) in [(0.0, 0.0), (UNIT, 1.0)] {
        for side in 0..SIDES {
            let turn = phytomer_sim::math::sincos(std::f64::consts::TAU * f64::from(side) / f64::from(SIDES));
            mesh.points.push([x, 0.5 * UNIT * turn.1, 0.5 * UNIT * turn.0]);
            mesh.normals.push([0.0, turn.1, turn.0]);
            mesh.texture.push([u, f64::from(side) / f64::from(SIDES)]);
        }
    }
    for side in 0..SIDES {
        let next = (side + 1) % SIDES;
        mesh.triangles.push([side, next, next + SIDES]);
        mesh.triangles.push([side, next + SIDES, side + SIDES]);
    }
    mesh
}

/// A form of the library, of length and width 1 unit.
fn organ(name: &str, form: FormName) -> Mesh {
    let options = MeshOptions::default();
    let shape = options.shape(plant::Form(form as u8));
    debug_assert!(shape.depth() == Depth::Width, "z is tapered as y is");
    let point = |at: [f32; 3]| at.map(|x| f64::from(x) * UNIT);
    Mesh {
        name: name.to_owned(),
        points: shape.points.iter().map(|corner| point(corner.at)).collect(),
        normals: shape.points.iter().map(|corner| corner.normal.map(f64::from)).collect(),
        texture: shape.points.iter().map(|corner| corner.texture.map(f64::from)).collect(),
        triangles: shape.faces.clone(),
    }
}
