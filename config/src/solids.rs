//! Closed meshes from PLY, OBJ and GLB files, as shapes: `{ form = "mesh", file = "house.ply" }`, a file in the folder
//! of the file that names it. The ending of the name tells the format; any other is read as a PLY.
//!
//! The points and triangles of the file take the place of its name in the tree, at the place of the name, so that a run
//! is drawn again without the file. Its text is kept among the sources, by which a run knows its inputs. Absent: how
//! meshes of organs are read (`forms`), and what each format is (`ply`,
//! `obj`, `glb`).

mod glb;
mod obj;
mod ply;
mod triangles;

use crate::document::{Entry, Node, Value};
use crate::library::Library;
use crate::report::Fault;
use crate::source::{Sources, Span};
use phytomer_models::fault::Path;
use phytomer_sim::shape::Mesh;
use triangles::Triangles;

/// The most bytes of all mesh files that one file names.
const MOST_BYTES: usize = 16 << 20;

/// The texts that are read while meshes are put into a tree.
pub(crate) struct Reading<'f> {
    pub library: &'f Library,
    pub sources: &'f mut Sources,
    pub faults: &'f mut Vec<Fault>,
}

/// Replaces the file name of each mesh in a tree by the mesh.
pub(crate) fn fill(node: &mut Node, reading: Reading<'_>) {
    Filling { reading, bytes: 0 }.walk(node, &Path::root());
}

struct Filling<'f> {
    reading: Reading<'f>,
    /// The bytes read so far.
    bytes: usize,
}

impl Filling<'_> {
    fn walk(&mut self, node: &mut Node, path: &Path) {
        if node.get("form").and_then(Node::text) == Some("mesh") {
            return self.fill(node, path);
        }
        match &mut node.value {
            Value::Table(entries) => {
                entries.iter_mut().for_each(|entry| self.walk(&mut entry.node, &path.key(&entry.key)));
            }
            Value::Array(items) if items.iter().any(|item| matches!(item.value, Value::Table(_) | Value::Array(_))) => {
                items.iter_mut().enumerate().for_each(|(number, item)| self.walk(item, &path.index(number)));
            }
            _ => {}
        }
    }

    /// Replaces the file of a mesh by its points and triangles. Where it is at fault a tetrahedron takes its place, so
    /// that nothing else is told of it.
    fn fill(&mut self, node: &mut Node, path: &Path) {
        let stated = node.get("points_m").is_some() || node.get("faces").is_some();
        let file = node.get("file").map(|file| (file.text().map(str::to_owned), file.span));
        let expected = "`file` alone, or `points_m` and `faces`";
        let (triangles, span) = match file {
            Some((Some(name), span)) if !stated => (self.read(&name, span, &path.key("file")), span),
            Some((Some(_), span)) => {
                let problem = "the mesh has a file, and points or triangles of its own";
                (Err(Box::new(Fault::new(span, &path.key("file"), problem, expected))), span)
            }
            None if !stated => {
                (Err(Box::new(Fault::new(node.span, path, "the mesh has no triangles", expected))), node.span)
            }
            // What is stated is checked with all other keys.
            _ => return,
        };
        let triangles = triangles.unwrap_or_else(|fault| {
            self.reading.faults.push(*fault);
            Triangles::tetrahedron()
        });
        for key in ["file", "points_m", "faces"] {
            node.remove(key);
        }
        let Value::Table(entries) = &mut node.value else { return };
        let put = |key: &str, items: Vec<Node>| Entry {
            key: key.to_owned(),
            key_span: span,
            node: Node { span, value: Value::Array(items) },
        };
        let three =
            |values: [Value; 3]| Node { span, value: Value::Array(values.map(|value| Node { span, value }).into()) };
        let points = triangles.points.iter().map(|point| three(point.map(Value::Float)));
        let faces = triangles.faces.iter().map(|face| three(face.map(|corner| Value::Integer(corner.into()))));
        let (points, faces) = (put("points_m", points.collect()), put("faces", faces.collect()));
        entries.extend([points, faces]);
    }

    fn read(&mut self, name: &str, span: Span, path: &Path) -> Result<Triangles, Box<Fault>> {
        let fault = |problem: String, expected: &str| Box::new(Fault::new(span, path, problem, expected));
        let Reading { library, sources, .. } = &mut self.reading;
        let beside = sources.get(span.source).origin.clone();
        let source = library.beside(name, &beside).map_err(|missing| {
            let fault = fault(missing.problem, "a PLY, OBJ or GLB file in the folder of this file");
            Box::new(fault.suggest(missing.suggestion))
        })?;
        let bytes = source.bytes.clone().unwrap_or_else(|| source.text.as_bytes().into());
        sources.add(source);
        self.bytes += bytes.len();
        if self.bytes > MOST_BYTES {
            let problem = format!("the meshes up to `{name}` have more than {} MiB", MOST_BYTES >> 20);
            return Err(fault(problem, "fewer meshes, or smaller ones"));
        }
        let ends_in = |ending: &str| name.to_ascii_lowercase().ends_with(ending);
        let read = match () {
            () if ends_in(".obj") => obj::read(&bytes),
            () if ends_in(".glb") => glb::read(&bytes),
            () => ply::read(&bytes),
        };
        let triangles = read.map_err(|refused| {
            fault(format!("the mesh `{name}`, {}: {}", refused.place, refused.problem), &refused.expected)
        })?;
        let closed = Mesh::of(&triangles.points, &triangles.faces);
        let expected = "triangles that enclose space, each edge between two of them that face the same way";
        closed.map_err(|error| fault(format!("the mesh `{name}`: {error}"), expected))?;
        Ok(triangles)
    }
}
