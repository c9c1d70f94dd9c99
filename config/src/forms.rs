//! Mesh files that a species uses as forms: `form = { mesh = "leaf.ply" }`, a file beside the species file.
//!
//! A file name is relative to the species file that states it, which after inheritance may be an ancestor's file. So
//! each name is replaced by the path of the mesh file. Absent: the triangles in these files (`phytomer_outputs`).

use crate::document::{Node, Value};
use crate::library::shown;
use crate::report::Fault;
use crate::source::{Origin, Sources};
use phytomer_models::fault::Path;
use phytomer_models::parameters::Keys;

/// Replaces the file name of each mesh by the path of the file; a file that does not exist is a fault.
pub(crate) fn resolve(species: &mut Node, keys: &Keys, sources: &Sources, faults: &mut Vec<Fault>) {
    let Some(tables) = &keys.by_place else { return };
    let Some(Value::Array(orders)) = entry(species, tables.list).map(|orders| &mut orders.value) else { return };
    for (index, order) in orders.iter_mut().enumerate() {
        for part in keys.formed {
            let path = Path::root().key(tables.list).index(index).key(part).key("form");
            let Some(form) = entry(order, part).and_then(|part| entry(part, "form")) else { continue };
            match entry(form, "by_state").map(|states| &mut states.value) {
                Some(Value::Table(states)) => {
                    let path = path.key("by_state");
                    states
                        .iter_mut()
                        .for_each(|state| of_form(&mut state.node, &path.key(&state.key), sources, faults));
                }
                _ => of_form(form, &path, sources, faults),
            }
        }
    }
}

fn entry<'n>(node: &'n mut Node, key: &str) -> Option<&'n mut Node> {
    let Value::Table(entries) = &mut node.value else { return None };
    entries.iter_mut().find(|entry| entry.key == key).map(|entry| &mut entry.node)
}

fn of_form(form: &mut Node, path: &Path, sources: &Sources, faults: &mut Vec<Fault>) {
    let Some(mesh) = entry(form, "mesh") else { return };
    let (path, span) = (path.key("mesh"), mesh.span);
    let Some(name) = mesh.text().filter(|name| !name.is_empty()).map(str::to_owned) else { return };
    let Origin::File(file) = &sources.get(span.source).origin else {
        let species = match &sources.get(span.source).origin {
            Origin::Memory(_) => "a species in memory",
            _ => "a species that ships",
        };
        let problem = format!("{species} names the file `{name}`");
        return faults.push(Fault::new(span, &path, problem, "a form of the library (`phytomer list forms` has them)"));
    };
    let beside = file.parent().map_or_else(|| name.clone().into(), |folder| folder.join(&name));
    if beside.is_file() {
        mesh.value = Value::Text(shown(&beside));
    } else {
        let expected = "a PLY, OBJ or GLB file, by its path from this file's folder";
        faults.push(Fault::new(span, &path, format!("there is no mesh file `{}`", shown(&beside)), expected));
    }
}
