//! The models that parts are instances of, as meshes.
//!
//! Absent: which models there are, which is `phytomer_life`'s.

use super::changing::begin_mesh;
use super::layer::{Attribute, Data, Layer, Value};
use super::paint::{self, Palette};
use phytomer_life::{Model, Models};
use phytomer_meshes::Vertex;
use phytomer_sim::plant::Kind;
use std::io;

/// The kinds of all models, each once.
pub fn kinds(models: &Models) -> Vec<Kind> {
    let all = Kind::ALL.into_iter();
    all.filter(|kind| models.made().iter().any(|(of, _)| of == kind)).collect()
}

/// Writes the models as meshes.
///
/// # Errors
/// Those of the file.
pub fn write(models: &Models, layer: &mut dyn Layer, root: &str) -> io::Result<()> {
    for (name, (kind, model)) in models.names().iter().zip(models.made()) {
        begin_mesh(layer, name)?;
        write_model(layer, model)?;
        layer.relationship("material:binding", &[paint::path_of(root, kind.tag())])?;
        layer.end()?;
    }
    Ok(())
}

fn write_model(layer: &mut dyn Layer, model: &Model) -> io::Result<()> {
    let (vertices, faces) = (&model.mesh.vertices, &model.mesh.faces);
    let mut always = |attribute, data: Data| layer.attribute(attribute, Value::Always(data));
    let corners: Vec<i32> = faces.iter().flat_map(|face| face.indices().map(|corner| corner as i32)).collect();
    always(Attribute::new("faceVertexCounts", "int[]"), Data::Ints(&vec![3; faces.len()]))?;
    always(Attribute::new("faceVertexIndices", "int[]"), Data::Ints(&corners))?;
    let of = |read: fn(&Vertex) -> [f32; 3]| vertices.iter().map(read).collect::<Vec<_>>();
    let points = of(Vertex::position);
    always(Attribute::new("points", "point3f[]"), Data::Triples(&points))?;
    let extent = super::changing::extent(points.iter().copied());
    always(Attribute::new("extent", "float3[]"), Data::Triples(&extent))?;
    always(Attribute::over("normals", "normal3f[]", "vertex"), Data::Triples(&of(Vertex::normal)))?;
    let texture: Vec<[f32; 2]> = vertices.iter().map(Vertex::texture).collect();
    always(Attribute::over("primvars:st", "texCoord2f[]", "vertex"), Data::Pairs(&texture))?;
    let mut palette = Palette::default();
    let places: Vec<i32> = vertices.iter().map(|vertex| palette.place(rgb(vertex))).collect();
    let colours = Attribute::over("primvars:displayColor", "color3f[]", "vertex");
    always(colours, Data::Triples(palette.colours()))?;
    always(Attribute::new("primvars:displayColor:indices", "int[]"), Data::Ints(&places))
}

/// The colour of a vertex.
pub fn rgb(vertex: &Vertex) -> [u8; 3] {
    let [red, green, blue, _] = vertex.tag().colour;
    [red, green, blue]
}
