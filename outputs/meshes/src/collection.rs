//! Several scenes in one PLY file, one after another: a plant at all its ages, or all plants at an age.
//!
//! The counts in the header are known only at the end. So room is kept for the header, vertices go straight into the
//! file and triangles into a second file, which is appended at the end; memory does not grow with the number of scenes.
//! The file has the profile of a single scene; its comments name the first and the last scene. Plants stand as they do
//! in the plot, relative to the seed of the first plant, whose place is in the comments. Single precision then holds
//! them to 0.06 mm at a distance of a kilometre; a file per plant has no such limit.

use super::chunk::{Chunk, Face, MOST_VERTICES, Vertex};
use super::ply::{header_of, place_comment};
use super::{About, Counts, Scene, Tolerance};
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The bytes that are kept for the header; the rest of them is filled with a comment.
const HEADER: usize = 1024;

/// A PLY file to which scenes are added.
#[derive(Debug)]
pub struct Collection {
    vertices: BufWriter<File>,
    faces: BufWriter<File>,
    faces_path: PathBuf,
    counts: Counts,
    ends: Option<[About; 2]>,
    scenes: u64,
    /// The tolerance of the last scene; all scenes of a file have the same.
    tolerance: Option<Tolerance>,
}

impl Collection {
    /// Begins the file at `path`. A second file stands beside it until [`Collection::finish`].
    ///
    /// # Errors
    /// Where a file cannot be created.
    pub fn create(path: &Path) -> io::Result<Self> {
        let faces_path = path.with_extension("faces.tmp");
        let mut vertices = BufWriter::new(File::create(path)?);
        vertices.write_all(&[b' '; HEADER])?;
        let faces =
            BufWriter::new(File::options().read(true).write(true).create(true).truncate(true).open(&faces_path)?);
        Ok(Self { vertices, faces, faces_path, counts: Counts::default(), ends: None, scenes: 0, tolerance: None })
    }

    /// Writes a scene after the scenes that were added before.
    ///
    /// # Errors
    /// Where the file cannot be written, or would have more vertices than its format can count.
    pub fn add(&mut self, scene: &Scene, about: &About) -> io::Result<()> {
        let first = self.counts.vertices;
        let more = scene.counts();
        if first + more.vertices > MOST_VERTICES {
            return Err(io::Error::other(format!("more than {MOST_VERTICES} vertices in one mesh file")));
        }
        let mut chunk = Chunk::new();
        let apart = self.apart_from_first(about);
        scene.vertices(&mut chunk, &mut |chunk| {
            if apart != [0.0; 3] {
                chunk.filled_mut::<Vertex>().iter_mut().for_each(|vertex| vertex.move_by(apart));
            }
            put(chunk, &mut self.vertices)
        })?;
        scene.faces(&mut chunk, &mut |chunk| {
            shift(chunk, first as u32, &mut self.faces)?;
            chunk.clear();
            Ok(())
        })?;
        self.counts.components += more.components;
        self.counts.vertices += more.vertices;
        self.counts.faces += more.faces;
        self.ends = Some([self.ends.map_or(*about, |[first, _]| first), *about]);
        self.scenes += 1;
        self.tolerance = scene.tolerance();
        Ok(())
    }

    /// The offset from the seed of the first plant of the file to the seed of another plant, metres.
    fn apart_from_first(&self, about: &About) -> [f64; 3] {
        let first = self.ends.map_or(about.place, |[first, _]| first.place);
        [0, 1, 2].map(|k| about.place[k] - first[k])
    }

    /// Appends the triangles, writes the header, and returns the counts of the whole file.
    ///
    /// # Errors
    /// Where a file cannot be read or written.
    pub fn finish(mut self) -> io::Result<Counts> {
        self.vertices.flush()?;
        self.faces.flush()?;
        let header = self.header()?;
        let (file, faces) = (self.vertices.get_mut(), self.faces.get_mut());
        faces.seek(SeekFrom::Start(0))?;
        io::copy(faces, file)?;
        file.seek(SeekFrom::Start(0))?;
        file.write_all(&header)?;
        Ok(self.counts)
    }

    /// The header, filled up to [`HEADER`] bytes.
    fn header(&self) -> io::Result<Vec<u8>> {
        let mut comments = vec![format!("{} scenes, one after another", self.scenes)];
        for (word, about) in ["first", "last"].iter().zip(self.ends.iter().flatten()) {
            comments.push(format!("{word}: {}", about.in_words()));
        }
        comments.extend(self.ends.map(|[first, _]| place_comment(first.place)));
        let short = header_of(self.tolerance, comments.clone(), self.counts)?;
        let filling = HEADER.checked_sub(short.len() + "comment \n".len());
        let filling = filling.ok_or_else(|| io::Error::other("the header does not fit into its room"))?;
        comments.push(".".repeat(filling));
        header_of(self.tolerance, comments, self.counts)
    }
}

impl Drop for Collection {
    fn drop(&mut self) {
        // A failure here is harmless: the name of the file marks it as one to be removed.
        let _ = fs::remove_file(&self.faces_path);
    }
}

fn put(chunk: &mut Chunk, out: &mut impl Write) -> io::Result<()> {
    out.write_all(chunk.filled())?;
    chunk.clear();
    Ok(())
}

/// Writes triangles after `first` has been added to the indices of their vertices.
fn shift(chunk: &Chunk, first: u32, out: &mut impl Write) -> io::Result<()> {
    let faces: &[Face] = bytemuck::cast_slice(chunk.filled());
    let shifted: Vec<Face> = faces.iter().map(|face| Face::new(face.indices().map(|corner| corner + first))).collect();
    out.write_all(bytemuck::cast_slice(&shifted))
}

#[cfg(test)]
mod tests {
    use super::super::{MeshOptions, MeshWriter, Ply};
    use super::*;
    use crate::tests::{LAST, specimen};
    use phytomer_sim::pose::pose;

    fn payload(bytes: &[u8]) -> &[u8] {
        let end = b"end_header\n";
        let at = bytes.windows(end.len()).position(|window| window == end).expect("a header");
        &bytes[at + end.len()..]
    }

    #[test]
    fn one_scene_is_that_of_its_own_file_and_a_second_follows_it() {
        let folder = tempfile::tempdir().unwrap();
        let plant = specimen();
        let scene = Scene::new(&plant, 6, &MeshOptions::default());
        let about = scene.about(1);
        let mut alone = Vec::new();
        Ply.write(&scene, &about, &mut alone).unwrap();
        let file = |name: &str, times: u32| {
            let path = folder.path().join(name);
            let mut collection = Collection::create(&path).unwrap();
            (0..times).for_each(|_| collection.add(&scene, &about).unwrap());
            let counts = collection.finish().unwrap();
            assert_eq!(counts.vertices, u64::from(times) * scene.counts().vertices);
            fs::read(path).unwrap()
        };
        let (once, twice) = (file("once.ply", 1), file("twice.ply", 2));
        assert_eq!(payload(&once), payload(&alone));
        assert!(once[..HEADER].ends_with(b"end_header\n"));
        let vertices = payload(&alone).len() - scene.counts().faces as usize * size_of::<Face>();
        assert_eq!(payload(&twice).len(), 2 * payload(&alone).len());
        assert_eq!(payload(&twice)[..vertices], payload(&twice)[vertices..2 * vertices]);
        let last: &[Face] = bytemuck::cast_slice(&payload(&twice)[payload(&twice).len() - size_of::<Face>()..]);
        assert!(last[0].indices().iter().all(|corner| u64::from(*corner) >= scene.counts().vertices));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "no triangles are left beside the files");
    }

    /// The first plant stands at its own seed, whose place is in the header; the second is as far from it as in the
    /// plot.
    #[test]
    fn plants_stand_apart_as_they_do_in_the_plot() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("two.ply");
        let mut plants = [0, 1].map(|id| {
            let mut plant = specimen();
            plant.id = id;
            plant.nodes.length[0] += 0.01 * id as f32;
            plant
        });
        let mut collection = Collection::create(&path).unwrap();
        let mut alone = Vec::new();
        for (plant, place) in plants.iter_mut().zip([[1e6, 0.5, 0.0], [1e6 + 3.0, -1.5, 0.25]]) {
            plant.place = place;
            pose(plant, LAST);
            let scene = Scene::new(plant, 6, &MeshOptions::default());
            collection.add(&scene, &scene.about(1)).unwrap();
            alone.push(crate::mesh_plant(plant, 6, &MeshOptions::default()).vertices);
        }
        collection.finish().unwrap();
        let bytes = fs::read(path).unwrap();
        assert!(String::from_utf8_lossy(&bytes[..HEADER]).contains("comment place_m 1000000.0 0.5 0.0\n"));
        let count = alone[0].len() + alone[1].len();
        let vertices: &[Vertex] = bytemuck::cast_slice(&payload(&bytes)[..count * Vertex::BYTES]);
        assert_eq!(vertices[..alone[0].len()], alone[0]);
        for (moved, home) in vertices[alone[0].len()..].iter().zip(&alone[1]) {
            let [x, y, z] = home.position().map(f64::from);
            assert_eq!(moved.position(), [(x + 3.0) as f32, (y - 2.0) as f32, (z + 0.25) as f32]);
            assert_eq!((moved.normal(), moved.tag()), (home.normal(), home.tag()));
        }
    }
}
