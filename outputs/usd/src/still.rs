//! A plant at an age, or a plot at a tick: its wood as meshes have it, and its organs.

use super::changing::{LIVES, begin_mesh, extent};
use super::layer::{Attribute, Data, Layer, Value};
use super::models::rgb;
use super::paint::{self, Palette};
use super::{Asked, Patched, write_still};
use phytomer_life::{StillOrgans, wood_of, wood_of_plot};
use phytomer_meshes::{Drawing, PlantDrawing, PlotMesh, Scene, Vertex};
use std::io;

/// Writes a plant at an age.
///
/// # Errors
/// Those of `out`.
pub fn write_plant(asked: &Asked, scene: &Scene, run_seed: u64, out: &mut dyn Patched) -> io::Result<()> {
    let wood = Scene::new(scene.plant(), scene.age(), &wood_of(scene.options()));
    let about = scene.about(run_seed);
    write_still(asked, &PlantDrawing { scene: &wood, about }, &StillOrgans::of_plant(scene), out)
}

/// Writes the plants of a plot, each in its place, with its obstacles.
///
/// # Errors
/// Those of `out`; more vertices than a mesh can have.
pub fn write_plot(asked: &Asked, plot: &PlotMesh, out: &mut dyn Patched) -> io::Result<()> {
    write_still(asked, &wood_of_plot(plot).drawing()?, &StillOrgans::of_plot(plot), out)
}

/// Writes the mesh of a drawing. Each property is drawn anew, so that memory holds one of them at a time.
///
/// # Errors
/// Those of the file.
pub fn write_wood(layer: &mut dyn Layer, root: &str, name: &str, wood: &dyn Drawing) -> io::Result<()> {
    begin_mesh(layer, name)?;
    let counts = wood.counts();
    let mut corners: Vec<i32> = Vec::with_capacity(3 * counts.faces as usize);
    wood.faces(&mut |faces| {
        corners.extend(faces.iter().flat_map(|face| face.indices().map(|corner| corner as i32)));
        Ok(())
    })?;
    always(layer, Attribute::new("faceVertexIndices", "int[]"), Data::Ints(&corners))?;
    corners.clear();
    corners.resize(counts.faces as usize, 3);
    always(layer, Attribute::new("faceVertexCounts", "int[]"), Data::Ints(&corners))?;
    drop(corners);
    let points = each(wood, Vertex::position)?;
    always(layer, Attribute::new("points", "point3f[]"), Data::Triples(&points))?;
    let extent = extent(points.iter().copied());
    drop(points);
    always(layer, Attribute::new("extent", "float3[]"), Data::Triples(&extent))?;
    always(layer, Attribute::over("normals", "normal3f[]", "vertex"), Data::Triples(&each(wood, Vertex::normal)?))?;
    let st = Attribute::over("primvars:st", "texCoord2f[]", "vertex");
    always(layer, st, Data::Pairs(&each(wood, Vertex::texture)?))?;
    write_tags(layer, wood)?;
    layer.relationship("material:binding", &[paint::path_of(root, "wood")])?;
    layer.end()
}

fn always(layer: &mut dyn Layer, attribute: Attribute, data: Data) -> io::Result<()> {
    layer.attribute(attribute, Value::Always(data))
}

/// A property of every vertex.
fn each<T>(wood: &dyn Drawing, read: impl FnMut(&Vertex) -> T + Copy) -> io::Result<Vec<T>> {
    let mut all = Vec::with_capacity(wood.counts().vertices as usize);
    wood.vertices(&mut |vertices| {
        all.extend(vertices.iter().map(read));
        Ok(())
    })?;
    Ok(all)
}

fn write_tags(layer: &mut dyn Layer, wood: &dyn Drawing) -> io::Result<()> {
    let ints = |name| Attribute::over(name, "int[]", "vertex");
    let age = |age: f32| if age.is_finite() { age as i32 } else { LIVES };
    always(layer, ints("primvars:component_id"), Data::Ints(&each(wood, |vertex| vertex.tag().component)?))?;
    always(layer, ints("primvars:birth_age"), Data::Ints(&each(wood, |vertex| age(vertex.tag().birth))?))?;
    always(layer, ints("primvars:death_age"), Data::Ints(&each(wood, |vertex| age(vertex.tag().death))?))?;
    let mut palette = Palette::default();
    let mut places = Vec::with_capacity(wood.counts().vertices as usize);
    wood.vertices(&mut |vertices| {
        places.extend(vertices.iter().map(|vertex| palette.place(rgb(vertex))));
        Ok(())
    })?;
    let colours = Attribute::over("primvars:displayColor", "color3f[]", "vertex");
    always(layer, colours, Data::Triples(palette.colours()))?;
    always(layer, Attribute::new("primvars:displayColor:indices", "int[]"), Data::Ints(&places))
}
