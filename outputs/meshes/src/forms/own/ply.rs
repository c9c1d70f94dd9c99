//! Triangles from a PLY, ASCII or binary, by the crate ply-rs-bw: `vertex` with x, y, z and `face` with
//! `vertex_indices` or `vertex_index`; polygons become triangles.
//!
//! The header is compared with the size of the file before the rest is read, so that it cannot announce more than there
//! is. Absent: all other elements and properties, which are read and skipped.

use super::{MOST_TRIANGLES, MeshFault, Read, Soup};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, Header, Property};

/// Reads the triangles of a PLY file.
pub fn read(bytes: &[u8]) -> Read<Soup> {
    let parser = Parser::<DefaultElement>::new();
    let mut reader = Reader::new(bytes);
    let header = parser.read_header(&mut reader).map_err(|error| refused(&error))?;
    check(&header, bytes.len())?;
    let payload = parser.read_payload(&mut reader, &header).map_err(|error| refused(&error))?;
    let elements = |name: &str| payload.get(name).map(Vec::as_slice).unwrap_or_default();
    let mut soup = Soup::default();
    for (number, vertex) in elements("vertex").iter().enumerate() {
        let axis = |name: &str| vertex.get(name).and_then(real);
        let (Some(x), Some(y), Some(z)) = (axis("x"), axis("y"), axis("z")) else {
            let problem = "a vertex without the numbers x, y and z";
            return Err(MeshFault::new(format!("vertex {number}"), problem, "three scalar properties x, y, z"));
        };
        soup.points.push([x, y, z]);
    }
    for (number, face) in elements("face").iter().enumerate() {
        let place = || format!("face {number}");
        let corners = ["vertex_indices", "vertex_index"].iter().find_map(|name| face.get(*name)).and_then(indices);
        let corners = corners.ok_or_else(|| {
            MeshFault::new(place(), "no list of vertices from 0", "a list property `vertex_indices` of whole numbers")
        })?;
        soup.polygon(&corners, place)?;
    }
    Ok(soup)
}

/// Refuses a header that announces more elements than the file can hold or a form may have.
fn check(header: &Header, bytes: usize) -> Read<()> {
    for (name, element) in &header.elements {
        let most = if name == "face" { MOST_TRIANGLES } else { bytes };
        if element.count > most || (element.properties.is_empty() && element.count > 0) {
            let problem = format!("{} elements `{name}`", element.count);
            return Err(MeshFault::new("the header", problem, format!("at most {most}, each with a property")));
        }
    }
    Ok(())
}

fn refused(error: &ParseError) -> MeshFault {
    let place = error.line().map_or_else(|| "the file".to_owned(), |line| format!("line {line}"));
    let problem: String = error.to_string().chars().take(200).collect();
    let problem = problem
        .split_once(": ")
        .filter(|(head, _)| head.starts_with("Line "))
        .map_or(problem.as_str(), |(_, rest)| rest)
        .to_owned();
    MeshFault::new(place, problem, "a PLY, ASCII or binary")
}

fn real(property: &Property) -> Option<f32> {
    Some(match *property {
        Property::Char(x) => f32::from(x),
        Property::UChar(x) => f32::from(x),
        Property::Short(x) => f32::from(x),
        Property::UShort(x) => f32::from(x),
        Property::Int(x) => x as f32,
        Property::UInt(x) => x as f32,
        Property::Float(x) => x,
        Property::Double(x) => x as f32,
        _ => return None,
    })
}

fn indices(property: &Property) -> Option<Vec<u32>> {
    fn whole<T: Copy + TryInto<u32>>(list: &[T]) -> Option<Vec<u32>> {
        list.iter().map(|&x| x.try_into().ok()).collect()
    }
    match property {
        Property::ListChar(list) => whole(list),
        Property::ListUChar(list) => whole(list),
        Property::ListShort(list) => whole(list),
        Property::ListUShort(list) => whole(list),
        Property::ListInt(list) => whole(list),
        Property::ListUInt(list) => whole(list),
        _ => None,
    }
}
