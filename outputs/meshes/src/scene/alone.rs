//! What a scene draws by itself, component by component: what lives in files are made of beside their tubes.
//!
//! These are organs, and internodes along which no tube of several runs. Absent: tubes (`reduced`).

use super::super::chunk::Vertex;
use super::{Scene, with_room};
use std::convert::Infallible;

impl Scene<'_> {
    /// Calls `take` with the vertices and the triangles of each component that is drawn by itself, in the order of the
    /// mesh: organs, and internodes along which no tube of several runs. Triangles refer to the component's own
    /// vertices.
    pub fn each_alone(&self, take: &mut dyn FnMut(&[Vertex], &[[u32; 3]])) {
        let mut vertices = Vec::new();
        let Ok::<(), Infallible>(()) = self.each_stem(0..self.stem_places(), |node| {
            let stem = self.stems.form(node);
            vertices.clear();
            self.stems.write(stem, node, with_room(&mut vertices, stem.vertices()));
            take(&vertices, stem.faces());
            Ok(())
        });
        for organ in self.organs() {
            let form = self.form(organ);
            vertices.clear();
            self.write_organ(form, organ, with_room(&mut vertices, form.vertices()));
            take(&vertices, form.faces());
        }
    }
}
