//! A plant at an age, or a plot at a tick: its wood as meshes have it, and its organs.

use super::changing::{LIVES, begin_mesh, extent};
use super::layer::{Attribute, Data, Layer, Value};
use super::models::rgb;
use super::paint::{self, Material, Palette};
use super::{Asked, Organs, Patched, ROOT, Variants, in_layer, in_variants, put_still, write_still};
use phytomer_life::{StillOrgans, organs_alone, organs_of_plot, wood_of, wood_of_plot};
use phytomer_meshes::{Drawing, MeshOptions, PlantDrawing, PlotMesh, Scene, Slot, Slots, Slotting, Vertex};
use phytomer_sim::plant::Class;
use std::io;

/// Writes a plant at an age.
///
/// # Errors
/// Those of `out`.
pub fn write_plant(asked: &Asked, scene: &Scene, run_seed: u64, out: &mut dyn Patched) -> io::Result<()> {
    let about = scene.about(run_seed);
    let wood = Scene::new(scene.plant(), scene.age(), &wood_of(scene.options()));
    let wood = PlantDrawing { scene: &wood, about };
    let merged = asked.organs == Organs::Merged;
    if is_drawn(scene, merged) {
        let organs = Scene::new(scene.plant(), scene.age(), &organs_alone(scene.options()));
        return write_drawn(asked, [&wood, &PlantDrawing { scene: &organs, about }], out);
    }
    write_still(asked, &wood, (&StillOrgans::of_plant(scene), scene.columns()), out)
}

/// Writes levels of detail of a plant, the finest first, as a set of variants `lod` of the prim at the root: `lod0`,
/// `lod1` and so on, of which the first is chosen. That has organs as they are asked for; in the coarser ones they
/// are merged, since they have coarser forms.
///
/// # Errors
/// Those of `out`.
pub fn write_levels(asked: &Asked, levels: &[Scene], run_seed: u64, out: &mut dyn Patched) -> io::Result<()> {
    in_levels(asked, levels.len(), out, &mut |number, layer| {
        let (scene, merged) = (&levels[number], asked.organs == Organs::Merged);
        let about = scene.about(run_seed);
        let wood = Scene::new(scene.plant(), scene.age(), &wood_of(scene.options()));
        let wood = PlantDrawing { scene: &wood, about };
        if number == 0 && !is_drawn(scene, merged) {
            return put_still(layer, asked, &wood, (&StillOrgans::of_plant(scene), scene.columns()));
        }
        let organs = Scene::new(scene.plant(), scene.age(), &organs_alone(scene.options()));
        put_drawn(layer, asked, [&wood, &PlantDrawing { scene: &organs, about }])
    })
}

/// Writes levels of detail of the plants of a plot, as [`write_levels`] does; obstacles are in each of them.
///
/// # Errors
/// As [`write_plot`].
pub fn write_plot_levels(asked: &Asked, levels: &[&PlotMesh], out: &mut dyn Patched) -> io::Result<()> {
    in_levels(asked, levels.len(), out, &mut |number, layer| {
        let (plot, merged) = (levels[number], asked.organs == Organs::Merged);
        let wood = wood_of_plot(plot);
        if number == 0 && !are_slotted(plot.bodies.iter().map(|body| &body.options), merged) {
            return put_still(layer, asked, &wood.drawing()?, (&StillOrgans::of_plot(plot), None));
        }
        let organs = organs_of_plot(plot);
        put_drawn(layer, asked, [&wood.drawing()?, &organs.drawing()?])
    })
}

/// Writes so many variants `lod0`, `lod1` and so on.
fn in_levels(
    asked: &Asked,
    count: usize,
    out: &mut dyn Patched,
    write: &mut dyn FnMut(usize, &mut dyn Layer) -> io::Result<()>,
) -> io::Result<()> {
    let names: Vec<String> = (0..count).map(|number| format!("lod{number}")).collect();
    in_variants(asked, &Variants { set: "lod", names: &names }, out, write)
}

/// Whether organs are drawn into a mesh of their own.
fn is_drawn(scene: &Scene, merged: bool) -> bool {
    is_apart(scene.options())
        || scene.columns().is_some() && merged
        || are_slotted([scene.options()].into_iter(), merged)
}

/// Writes the plants of a plot, each in its place, with its obstacles.
///
/// # Errors
/// Those of `out`; more vertices than a mesh can have.
pub fn write_plot(asked: &Asked, plot: &PlotMesh, out: &mut dyn Patched) -> io::Result<()> {
    let wood = wood_of_plot(plot);
    if are_slotted(plot.bodies.iter().map(|body| &body.options), asked.organs == Organs::Merged) {
        let organs = organs_of_plot(plot);
        return write_drawn(asked, [&wood.drawing()?, &organs.drawing()?], out);
    }
    write_still(asked, &wood.drawing()?, (&StillOrgans::of_plot(plot), None), out)
}

/// Whether organs have materials that instances of their forms do not tell apart: by order, or by species. Where they
/// are merged, any texture.
pub fn are_slotted<'o>(options: impl Iterator<Item = &'o MeshOptions> + Clone, merged: bool) -> bool {
    let of_organs = |options: &'o MeshOptions| {
        let list = &options.own.textures().list;
        list.iter().filter(|texture| texture.of != Class::Internode).collect::<Vec<_>>()
    };
    let by_order = options.clone().any(|options| options.slotting == Slotting::Order);
    let mut lists: Vec<_> = options.map(of_organs).collect();
    let of_order = lists.iter().flatten().any(|texture| texture.order.is_some());
    lists.dedup();
    by_order || of_order || lists.len() > 1 || merged && lists.iter().any(|list| !list.is_empty())
}

/// Whether organs are drawn as no instance shows them: a part of them, as points, with normals or columns of their own.
fn is_apart(options: &MeshOptions) -> bool {
    let far = options.seen.afar.is_some_and(|afar| afar.metres.is_some());
    options.seen.levels.is_some() || far || options.crown_normals || options.swings.is_some() || options.attributes
}

/// Writes wood and organs as two meshes, with all that their vertices tell.
fn write_drawn(asked: &Asked, [wood, organs]: [&dyn Drawing; 2], out: &mut dyn Patched) -> io::Result<()> {
    in_layer(asked, None, out, &mut |layer| put_drawn(layer, asked, [wood, organs]))
}

fn put_drawn(layer: &mut dyn Layer, asked: &Asked, [wood, organs]: [&dyn Drawing; 2]) -> io::Result<()> {
    let both = [("wood", wood, wood.slots()), ("organs", organs, organs.slots())];
    let mut materials = Vec::new();
    for (name, drawing, slots) in &both {
        if drawing.counts().faces > 0 {
            materials.extend(write_mesh(layer, (ROOT, *name, *name), *drawing, slots)?);
        }
    }
    let mut written: Vec<Material> = Vec::new();
    for slot in &materials {
        if !written.iter().any(|known| known.name == slot.name) {
            written.push(Material::of(slot));
        }
    }
    if both.iter().all(|(.., slots)| slots.is_plain()) {
        written = vec![Material::plain("wood", 0.85), Material::plain("organs", 0.6)];
    }
    paint::write_materials(layer, ROOT, &asked.pictures, &written)
}

/// Writes the mesh of a drawing. Each property is drawn anew, so that memory holds one of them at a time. Where slots
/// are plain it has the material of this name. Returns the other slots that it has.
///
/// # Errors
/// Those of the file.
pub fn write_mesh(
    layer: &mut dyn Layer,
    (root, name, material): (&str, &str, &str),
    wood: &dyn Drawing,
    slots: &Slots,
) -> io::Result<Vec<Slot>> {
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
    let found = if slots.is_plain() {
        layer.relationship("material:binding", &[paint::path_of(root, material)])?;
        Vec::new()
    } else {
        bind_slots(layer, root, wood, slots)?
    };
    layer.end()?;
    Ok(found)
}

/// Binds the faces of each slot of the open mesh to its material; the slots that have faces.
fn bind_slots(layer: &mut dyn Layer, root: &str, wood: &dyn Drawing, slots: &Slots) -> io::Result<Vec<Slot>> {
    let (mut in_turn, mut of_vertices) = (slots.in_turn(), Vec::with_capacity(wood.counts().vertices as usize));
    wood.vertices(&mut |vertices| {
        of_vertices.extend(vertices.iter().map(|vertex| in_turn.next(vertex) as u16));
        Ok(())
    })?;
    let (mut faces, mut number) = (vec![Vec::new(); slots.list().len()], 0);
    wood.faces(&mut |drawn| {
        for face in drawn {
            faces[usize::from(of_vertices[face.indices()[0] as usize])].push(number);
            number += 1;
        }
        Ok(())
    })?;
    let filled: Vec<usize> = (0..faces.len()).filter(|slot| !faces[*slot].is_empty()).collect();
    let path = |slot: usize| paint::path_of(root, &slots.list()[slot].name);
    if let [only] = filled[..] {
        layer.relationship("material:binding", &[path(only)])?;
    } else {
        let family = Attribute::uniform("subsetFamily:materialBind:familyType", "token");
        always(layer, family, Data::Token("partition"))?;
        for slot in &filled {
            layer.begin("GeomSubset", &slots.list()[*slot].name, &["MaterialBindingAPI"])?;
            always(layer, Attribute::uniform("elementType", "token"), Data::Token("face"))?;
            always(layer, Attribute::uniform("familyName", "token"), Data::Token("materialBind"))?;
            always(layer, Attribute::new("indices", "int[]"), Data::Ints(&faces[*slot]))?;
            layer.relationship("material:binding", &[path(*slot)])?;
            layer.end()?;
        }
    }
    Ok(filled.into_iter().map(|slot| slots.list()[slot].clone()).collect())
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
