//! All plants of a plot in one mesh file, each in its place, in the order of the plot, and its obstacles after them.
//!
//! Vertices are relative to the place of the plot, which is in the comments, so that single precision holds a plot of a
//! hundred metres to 0.004 mm wherever it stands. A comment for each plant states its name and its number of vertices
//! in the file. Vertices of obstacles have the component number −1. A plant that stands at several places is made once
//! and kept. The profile of vertices and triangles is that of a single plant's file.

use super::chunk::{Chunk, Face, Vertex};
use super::drawing::{Drawing, Take};
use super::ply::{header_of, place_comment};
use super::{Counts, Mesh, MeshOptions, Scene, Slots, Tolerance, mesh_plant};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use std::io::{self, Write};
use std::sync::Arc;

/// The most vertices of one mesh file: 32-bit signed indices reach no further.
const MOST_VERTICES: u64 = i32::MAX as u64;

/// A plant that stands at one or several places of a plot.
#[derive(Debug)]
pub struct PlotBody<'a> {
    /// The plant, with the frames and diameters of the age.
    pub plant: &'a Plant,
    /// Its age.
    pub age: Tick,
    /// Options for drawing it.
    pub options: MeshOptions,
}

/// A plant of a plot.
#[derive(Debug, Clone)]
pub struct PlotMember {
    /// The index of its plant in the list of bodies.
    pub body: usize,
    /// The place of its seed, metres from the place of the plot.
    pub place: [f64; 3],
    /// The name of the plant for the comments: its number and its species.
    pub name: String,
}

/// The plants of a plot at a tick.
#[derive(Debug)]
pub struct PlotMesh<'a> {
    /// The plants, each once, whatever the number of places where it stands.
    pub bodies: Vec<PlotBody<'a>>,
    /// The members of the plot, in their order.
    pub members: Vec<PlotMember>,
    /// Closed meshes of what stands among the plants, metres from the place of the plot.
    pub obstacles: Vec<Arc<Mesh>>,
    /// The name of the plot for the comments: its number, tick and run.
    pub name: String,
    /// The place of the plot, metres. Added to the vertices, it gives their places in the run.
    pub place: [f64; 3],
}

/// A plot that is ready to be drawn in any format.
pub struct PlotDrawing<'a> {
    mesh: &'a PlotMesh<'a>,
    bodies: Vec<Ready<'a>>,
}

/// A body that is ready to be drawn.
struct Ready<'a> {
    scene: Scene<'a>,
    counts: Counts,
    /// The mesh of the plant, kept where it stands at several places.
    kept: Option<Mesh>,
}

impl PlotMesh<'_> {
    /// Draws the wood of all plants within a tolerance.
    pub fn within(&mut self, tolerance: Tolerance) {
        self.bodies.iter_mut().for_each(|body| body.options.tolerance = Some(tolerance));
    }

    /// The number of triangles of the file, were its wood drawn within a tolerance.
    pub fn faces_within(&self, tolerance: &Tolerance) -> u64 {
        let faces = |body: &PlotBody| {
            let options = MeshOptions { tolerance: Some(*tolerance), ..body.options.clone() };
            Scene::new(body.plant, body.age, &options).counts().faces
        };
        let faces: Vec<u64> = self.bodies.iter().map(faces).collect();
        let of_plants: u64 = self.members.iter().filter_map(|member| faces.get(member.body)).sum();
        of_plants + self.obstacles.iter().map(|mesh| mesh.faces.len() as u64).sum::<u64>()
    }

    /// The plot, ready to be drawn. Plants that stand at one place are made while they are drawn.
    ///
    /// # Errors
    /// Where it has more vertices than the formats can index.
    pub fn drawing(&self) -> io::Result<PlotDrawing<'_>> {
        let bodies = self.bodies.iter().enumerate().map(|(place, body)| self.ready(place, body)).collect();
        let drawing = PlotDrawing { mesh: self, bodies };
        let vertices = drawing.counts().vertices;
        if vertices > MOST_VERTICES {
            return Err(io::Error::other(format!(
                "the mesh of {} would have {vertices} vertices, and a mesh file holds at most {MOST_VERTICES}: choose \
                 fewer sides or a larger tolerance",
                self.name
            )));
        }
        Ok(drawing)
    }

    /// Writes the PLY file.
    ///
    /// # Errors
    /// The errors of `out`, or an error where the file would have more vertices than its format can index.
    pub fn write(&self, out: &mut (dyn Write + Send)) -> io::Result<()> {
        let drawing = self.drawing()?;
        let mut comments = drawing.notes();
        comments.insert(1, place_comment(self.place));
        comments.extend(self.bodies.first().and_then(|body| body.options.joints.in_words()).map(str::to_owned));
        out.write_all(&header_of(drawing.tolerance(), comments, drawing.counts())?)?;
        drawing.vertices(&mut |vertices| out.write_all(bytemuck::cast_slice(vertices)))?;
        drawing.faces(&mut |faces| out.write_all(bytemuck::cast_slice(faces)))
    }

    fn ready<'s>(&self, place: usize, body: &'s PlotBody) -> Ready<'s> {
        let scene = Scene::new(body.plant, body.age, &body.options);
        let several = self.members.iter().filter(|member| member.body == place).nth(1).is_some();
        let kept = several.then(|| mesh_plant(body.plant, body.age, &body.options));
        Ready { counts: scene.counts(), scene, kept }
    }
}

impl PlotDrawing<'_> {
    fn members(&self) -> impl Iterator<Item = (&PlotMember, &Ready<'_>)> {
        self.mesh.members.iter().filter_map(|member| Some((member, self.bodies.get(member.body)?)))
    }
}

impl Drawing for PlotDrawing<'_> {
    fn counts(&self) -> Counts {
        let mut all = Counts::default();
        for (_, Ready { counts, .. }) in self.members() {
            all.components += counts.components;
            all.vertices += counts.vertices;
            all.faces += counts.faces;
        }
        for mesh in &self.mesh.obstacles {
            all.vertices += mesh.vertices.len() as u64;
            all.faces += mesh.faces.len() as u64;
        }
        all
    }

    fn tolerance(&self) -> Option<Tolerance> {
        self.mesh.bodies.first().and_then(|body| body.options.tolerance)
    }

    fn notes(&self) -> Vec<String> {
        let member = |(member, Ready { scene, counts, .. }): (&PlotMember, &Ready)| {
            format!("{} age {} vertices {}", member.name, scene.shown_age(), counts.vertices)
        };
        let obstacle =
            |(number, mesh): (usize, &Arc<Mesh>)| format!("obstacle {number} vertices {}", mesh.vertices.len());
        let obstacles = self.mesh.obstacles.iter().enumerate().map(obstacle);
        [self.mesh.name.clone()].into_iter().chain(self.members().map(member)).chain(obstacles).collect()
    }

    fn place(&self) -> [f64; 3] {
        self.mesh.place
    }

    fn slots(&self) -> Slots {
        Slots::of(self.members().filter_map(|(member, ready)| {
            let body = self.mesh.bodies.get(member.body)?;
            Some((body.plant, &body.options, ready.counts.vertices))
        }))
    }

    fn vertices(&self, take: &mut Take<'_, Vertex>) -> io::Result<()> {
        self.members().try_for_each(|(member, body)| body.vertices(member.place, take))?;
        self.mesh.obstacles.iter().try_for_each(|mesh| take(&mesh.vertices))
    }

    fn faces(&self, take: &mut Take<'_, Face>) -> io::Result<()> {
        let mut first = 0;
        let mut shifted = |first: u32, faces: &[Face]| {
            let faces = faces.iter().map(|face| Face::new(face.indices().map(|corner| corner + first)));
            take(&faces.collect::<Vec<_>>())
        };
        for (_, body) in self.members() {
            body.faces(&mut |faces| shifted(first, faces))?;
            first += body.counts.vertices as u32;
        }
        for mesh in &self.mesh.obstacles {
            shifted(first, &mesh.faces)?;
            first += mesh.vertices.len() as u32;
        }
        Ok(())
    }
}

impl Ready<'_> {
    fn vertices(&self, place: [f64; 3], take: &mut Take<'_, Vertex>) -> io::Result<()> {
        let mut put = |vertices: &mut [Vertex]| {
            if place != [0.0; 3] {
                vertices.iter_mut().for_each(|vertex| vertex.move_by(place));
            }
            take(vertices)
        };
        if let Some(mesh) = &self.kept {
            return put(&mut mesh.vertices.clone());
        }
        self.scene.vertices(&mut Chunk::new(), &mut |chunk| {
            put(chunk.filled_mut::<Vertex>())?;
            chunk.clear();
            Ok(())
        })
    }

    fn faces(&self, take: &mut Take<'_, Face>) -> io::Result<()> {
        if let Some(mesh) = &self.kept {
            return take(&mesh.faces);
        }
        self.scene.faces(&mut Chunk::new(), &mut |chunk| {
            take(bytemuck::cast_slice(chunk.filled()))?;
            chunk.clear();
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::specimen;
    use crate::{MeshWriter, Ply, Solid};
    use phytomer_sim::shape::{Cuboid, Shape};

    fn payload(bytes: &[u8]) -> (&str, &[u8]) {
        let end = b"end_header\n";
        let at = bytes.windows(end.len()).position(|window| window == end).expect("a header") + end.len();
        (std::str::from_utf8(&bytes[..at]).expect("a text"), &bytes[at..])
    }

    fn plot(places: &[[f64; 3]], bodies: [usize; 3]) -> Vec<u8> {
        plot_with(places, bodies, Vec::new())
    }

    fn plot_with(places: &[[f64; 3]], bodies: [usize; 3], obstacles: Vec<Arc<Mesh>>) -> Vec<u8> {
        let plant = specimen();
        let body = || PlotBody { plant: &plant, age: 6, options: MeshOptions::default() };
        let member = |(place, body): (&[f64; 3], usize)| PlotMember { body, place: *place, name: "plant".to_owned() };
        let members = places.iter().zip(bodies).map(member).collect();
        let count = bodies.into_iter().max().map_or(0, |most| most + 1);
        let bodies = (0..count).map(|_| body()).collect();
        let mesh =
            PlotMesh { bodies, members, obstacles, name: "plot 0 tick 6 seed 1".to_owned(), place: [100.0, 0.0, 0.0] };
        let mut bytes = Vec::new();
        mesh.write(&mut bytes).expect("written");
        bytes
    }

    /// The first plant is as in its own file, and the others are copies of it that are moved. The bytes are equal
    /// whether the list of bodies has the plant once or three times.
    #[test]
    fn plants_stand_in_their_places_one_after_another() {
        let plant = specimen();
        let scene = Scene::new(&plant, 6, &MeshOptions::default());
        let mut alone = Vec::new();
        Ply.write(&scene, &scene.about(1), &mut alone).expect("written");
        let places = [[0.0; 3], [3.0, -2.0, 0.25], [-1.0, 0.5, 0.0]];
        let shared = plot(&places, [0, 0, 0]);
        assert_eq!(shared, plot(&places, [0, 1, 2]), "equal plants share a mesh");
        let (header, bytes) = payload(&shared);
        assert!(header.contains("comment place_m 100.0 0.0 0.0\n"), "{header}");
        let counts = scene.counts();
        let size = counts.vertices as usize * Vertex::BYTES;
        let (_, home) = payload(&alone);
        assert_eq!(bytes[..size], home[..size]);
        let vertices = |bytes: &[u8]| -> Vec<Vertex> { read(bytes) };
        let (moved, first) = (vertices(&bytes[size..2 * size]), vertices(&home[..size]));
        for (moved, home) in moved.iter().zip(&first) {
            let [x, y, z] = home.position().map(f64::from);
            assert_eq!(moved.position(), [(x + 3.0) as f32, (y - 2.0) as f32, (z + 0.25) as f32]);
            assert_eq!((moved.normal(), moved.tag()), (home.normal(), home.tag()));
        }
        let faces: Vec<Face> = read(&bytes[3 * size..]);
        assert_eq!(faces.len() as u64, 3 * counts.faces);
        let last = faces.iter().flat_map(Face::indices).max();
        assert_eq!(last, Some(3 * counts.vertices as u32 - 1));
    }

    /// The house stands behind the plants, which it does not move.
    #[test]
    fn obstacles_follow_the_plants() {
        let places = [[0.0; 3], [3.0, -2.0, 0.25], [-1.0, 0.5, 0.0]];
        let house = Shape::Cuboid(Cuboid::on([5.0, 0.0, 0.0], [2.0, 3.0, 4.0]));
        let mesh = Arc::new(Solid::of(&house).expect("it has an end").obstacle(Some([1, 2, 3])));
        assert_eq!((mesh.vertices.len(), mesh.faces.len()), (24, 12));
        let (alone, with) = (plot(&places, [0, 0, 0]), plot_with(&places, [0, 0, 0], vec![Arc::clone(&mesh)]));
        let ((_, alone), (header, with)) = (payload(&alone), payload(&with));
        assert!(header.contains("comment obstacle 0 vertices 24\n"), "{header}");
        assert_eq!(with.len() - alone.len(), 24 * Vertex::BYTES + 12 * Face::BYTES);
        let plants = 3 * Scene::new(&specimen(), 6, &MeshOptions::default()).counts().vertices as usize;
        assert_eq!(with[..plants * Vertex::BYTES], alone[..plants * Vertex::BYTES]);
        let vertices: Vec<Vertex> = read(&with[plants * Vertex::BYTES..(plants + 24) * Vertex::BYTES]);
        assert!(vertices.iter().all(|vertex| (vertex.tag().component, vertex.tag().colour) == (-1, [1, 2, 3, 255])));
        let faces: Vec<Face> = read(&with[with.len() - 12 * Face::BYTES..]);
        let corners: Vec<u32> = faces.iter().flat_map(Face::indices).collect();
        let ends = [corners.iter().min(), corners.iter().max()].map(|end| end.copied().unwrap_or(0) as usize);
        assert_eq!(ends, [plants, plants + 23]);
    }

    /// A plot of more than 2³¹ − 1 vertices is refused before anything is drawn.
    #[test]
    fn more_vertices_than_a_file_can_count_are_told() {
        let plant = specimen();
        let options = MeshOptions { sides: 255, ..MeshOptions::default() };
        let each = Scene::new(&plant, 6, &options).counts().vertices;
        let count = (1_u64 << 31) / each + 1;
        let member = PlotMember { body: 0, place: [0.0; 3], name: String::new() };
        let bodies = vec![PlotBody { plant: &plant, age: 6, options }];
        let members = vec![member; count as usize];
        let mesh = PlotMesh { bodies, members, obstacles: Vec::new(), name: "plot 7".to_owned(), place: [0.0; 3] };
        let told = mesh.drawing().err().expect("too many").to_string();
        let expected = format!(
            "the mesh of plot 7 would have {} vertices, and a mesh file holds at most 2147483647",
            each * count
        );
        assert!(told.starts_with(&expected) && told.ends_with("choose fewer sides or a larger tolerance"), "{told}");
    }

    /// Packed entries of a file, wherever they lie in memory.
    fn read<T: bytemuck::AnyBitPattern>(bytes: &[u8]) -> Vec<T> {
        bytes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned).collect()
    }
}
