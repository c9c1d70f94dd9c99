//! The pictures of a mesh, each once, with the names that they have beside its file.
//!
//! A name begins with that of the mesh, so that the picture that a species names is never written over. Equal pictures
//! are one file. Absent: writing them.

use super::slots::Slots;
use super::texture::Picture;
use std::sync::Arc;

/// The pictures of a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pictures {
    list: Vec<(Arc<Picture>, String)>,
}

impl Pictures {
    /// Those of the slots of a mesh whose file has this name without its ending.
    pub fn of(slots: &Slots, stem: &str) -> Self {
        let mut found = Self::default();
        for texture in slots.list().iter().filter_map(|slot| slot.texture.as_ref()) {
            for picture in [Some(&texture.colours), texture.normals.as_ref()].into_iter().flatten() {
                found.add(picture, stem);
            }
        }
        found
    }

    fn add(&mut self, picture: &Arc<Picture>, stem: &str) {
        if self.list.iter().any(|(known, _)| known == picture) {
            return;
        }
        let of = picture.name.rsplit_once('.').map_or(picture.name.as_str(), |(name, _)| name);
        let plain = word_of(&format!("{stem}_{of}"));
        let names = [plain.clone()].into_iter().chain((2..).map(|k| format!("{plain}_{k}")));
        let mut names = names.map(|name| format!("{name}.{}", picture.ending()));
        let is_free = |name: &String| self.list.iter().all(|(_, taken)| !taken.eq_ignore_ascii_case(name));
        let name = names.find(is_free).unwrap_or_default();
        self.list.push((Arc::clone(picture), name));
    }

    /// The name of a picture.
    pub fn name_of(&self, picture: &Arc<Picture>) -> &str {
        self.list.iter().find(|(known, _)| known == picture).map_or("", |(_, name)| name)
    }

    /// The pictures with their names.
    pub fn files(&self) -> &[(Arc<Picture>, String)] {
        &self.list
    }
}

/// A name that every format takes: letters, digits, underscores and lines.
fn word_of(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect()
}
