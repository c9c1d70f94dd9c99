//! A plant at an age, or a plot at a tick: its wood as meshes have it, and its organs.

use super::changing::{LIVES, begin_mesh, extent};
use super::layer::{Attribute, Data, Layer, Value};
use super::models::rgb;
use super::paint::{self, Palette};
use super::{Asked, Organs, Patched, ROOT, in_layer, write_still};
use phytomer_life::{StillOrgans, organs_alone, wood_of, wood_of_plot};
use phytomer_meshes::{About, Drawing, MeshOptions, PlantDrawing, PlotMesh, Scene, Vertex};
use std::io;

/// Writes a plant at an age.
///
/// # Errors
/// Those of `out`.
pub fn write_plant(asked: &Asked, scene: &Scene, run_seed: u64, out: &mut dyn Patched) -> io::Result<()> {
    let wood = Scene::new(scene.plant(), scene.age(), &wood_of(scene.options()));
    if is_apart(scene.options()) || scene.columns().is_some() && asked.organs == Organs::Merged {
        let organs = Scene::new(scene.plant(), scene.age(), &organs_alone(scene.options()));
        return write_drawn(asked, (&wood, &organs), scene.about(run_seed), out);
    }
    let about = scene.about(run_seed);
    write_still(asked, &PlantDrawing { scene: &wood, about }, (&StillOrgans::of_plant(scene), scene.columns()), out)
}

/// Writes the plants of a plot, each in its place, with its obstacles.
///
/// # Errors
/// Those of `out`; more vertices than a mesh can have.
pub fn write_plot(asked: &Asked, plot: &PlotMesh, out: &mut dyn Patched) -> io::Result<()> {
    write_still(asked, &wood_of_plot(plot).drawing()?, (&StillOrgans::of_plot(plot), None), out)
}

/// Whether organs are drawn as no instance shows them: a part of them, as points, with normals or columns of their own.
fn is_apart(options: &MeshOptions) -> bool {
    let far = options.seen.afar.is_some_and(|afar| afar.metres.is_some());
    options.seen.levels.is_some() || far || options.crown_normals || options.swings.is_some() || options.attributes
}

/// Writes the wood and the organs of a plant as two meshes, with all that their vertices tell.
fn write_drawn(asked: &Asked, (wood, organs): (&Scene, &Scene), about: About, out: &mut dyn Patched) -> io::Result<()> {
    in_layer(asked, None, out, &mut |layer| {
        for (name, scene) in [("wood", wood), ("organs", organs)] {
            if scene.counts().faces > 0 {
                write_mesh(layer, (ROOT, name, name), &PlantDrawing { scene, about })?;
            }
        }
        paint::write_materials(layer, ROOT, &[("wood", 0.85), ("organs", 0.6)])
    })
}

/// Writes the mesh of a drawing. Each property is drawn anew, so that memory holds one of them at a time.
///
/// # Errors
/// Those of the file.
pub fn write_mesh(
    layer: &mut dyn Layer,
    (root, name, material): (&str, &str, &str),
    wood: &dyn Drawing,
) -> io::Result<()> {
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
    write_columns(layer, wood)?;
    layer.relationship("material:binding", &[paint::path_of(root, material)])?;
    layer.end()
}

/// Writes the columns of a mesh, one at a time.
fn write_columns(layer: &mut dyn Layer, mesh: &dyn Drawing) -> io::Result<()> {
    let Some(columns) = mesh.columns() else { return Ok(()) };
    for (place, name) in columns.names().iter().enumerate() {
        let (mut all, mut row) = (Vec::with_capacity(mesh.counts().vertices as usize), Vec::new());
        mesh.vertices(&mut |vertices| {
            for vertex in vertices {
                row.clear();
                columns.put(vertex, &mut row);
                all.push(row[place]);
            }
            Ok(())
        })?;
        let name = format!("primvars:{name}");
        always(layer, Attribute::over(&name, "float[]", "vertex"), Data::Floats(&all))?;
    }
    Ok(())
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
