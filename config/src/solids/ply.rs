//! Triangles from a PLY, ASCII or binary, by the crate ply-rs-bw: `vertex` with x, y, z and `face` with
//! `vertex_indices` or `vertex_index`; a polygon, which may be concave, is cut into triangles.
//!
//! The header is compared with what a shape may have before the rest is read. Absent: all other elements and
//! properties, which are read and skipped; and whether the triangles enclose space.

use super::triangles::{MOST_ELEMENTS, MOST_TRIANGLES, Refused, Triangles};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, Header, Property};

/// Reads the triangles of a PLY file.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles, Refused> {
    let parser = Parser::<DefaultElement>::new();
    let mut reader = Reader::new(bytes);
    let header = parser.read_header(&mut reader).map_err(|error| refused(&error))?;
    check(&header, bytes.len())?;
    let payload = parser.read_payload(&mut reader, &header).map_err(|error| refused(&error))?;
    let elements = |name: &str| payload.get(name).map(Vec::as_slice).unwrap_or_default();
    let points: Result<Vec<[f64; 3]>, Refused> = elements("vertex").iter().enumerate().map(point).collect();
    let mut triangles = Triangles { points: points?, faces: Vec::new() };
    for (number, face) in elements("face").iter().enumerate() {
        add(&mut triangles, number, face)?;
    }
    if triangles.faces.is_empty() {
        return Err(Refused::new("as a whole", "there are no triangles", "the elements `vertex` and `face`"));
    }
    Ok(triangles)
}

/// A vertex, by its number.
fn point((number, vertex): (usize, &DefaultElement)) -> Result<[f64; 3], Refused> {
    let place = || format!("vertex {number}");
    let axis = |name: &str| vertex.get(name).and_then(real);
    let (Some(x), Some(y), Some(z)) = (axis("x"), axis("y"), axis("z")) else {
        return Err(Refused::new(place(), "the numbers x, y and z are missing", "three scalar properties x, y and z"));
    };
    if ![x, y, z].iter().all(|x| x.is_finite()) {
        return Err(Refused::new(place(), "a coordinate is no finite number", "metres"));
    }
    Ok([x, y, z])
}

/// Adds the triangles of a polygon.
fn add(triangles: &mut Triangles, number: usize, face: &DefaultElement) -> Result<(), Refused> {
    let place = || format!("face {number}");
    let corners = ["vertex_indices", "vertex_index"].iter().find_map(|name| face.get(*name)).and_then(indices);
    let expected = "a list property `vertex_indices` of whole numbers from 0";
    let corners = corners.ok_or_else(|| Refused::new(place(), "it has no list of vertices", expected))?;
    triangles.add(place, &corners)
}

/// Refuses a header that announces more elements than the file can hold or a shape may have.
fn check(header: &Header, bytes: usize) -> Result<(), Refused> {
    for (name, element) in &header.elements {
        let most = bytes.min(if name == "face" { MOST_TRIANGLES } else { MOST_ELEMENTS });
        if element.count > most || (element.properties.is_empty() && element.count > 0) {
            let problem = format!("it announces {} elements `{name}`", element.count);
            return Err(Refused::new("its header", problem, format!("at most {most}, each with a property")));
        }
    }
    Ok(())
}

fn refused(error: &ParseError) -> Refused {
    let place = error.line().map_or_else(|| "as a whole".to_owned(), |line| format!("line {line}"));
    let problem: String = error.to_string().chars().take(200).collect();
    let rest = problem.split_once(": ").filter(|(head, _)| head.starts_with("Line ")).map(|(_, rest)| rest.to_owned());
    let words: Vec<&str> = rest.as_deref().unwrap_or(&problem).split_whitespace().collect();
    let words = words.join(" ");
    // What follows is the parser's own state.
    let problem = words.split_once(" Error: ").map_or(words.as_str(), |(problem, _)| problem);
    Refused::new(place, problem, "a PLY, ASCII or binary")
}

fn real(property: &Property) -> Option<f64> {
    Some(match *property {
        Property::Char(x) => x.into(),
        Property::UChar(x) => x.into(),
        Property::Short(x) => x.into(),
        Property::UShort(x) => x.into(),
        Property::Int(x) => x.into(),
        Property::UInt(x) => x.into(),
        Property::Float(x) => x.into(),
        Property::Double(x) => x,
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

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty int z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0.1 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

    #[test]
    fn polygons_are_cut_and_numbers_keep_their_precision() {
        let read = read(SQUARE.as_bytes()).expect("a square");
        assert_eq!(read.faces, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(read.points[0], [0.0, 0.1, 0.0], "a double is a double");
        // An arrow head, whose notch no triangle covers: a fan would have the area 1.5 twice over its notch.
        let arrow = SQUARE.replace("0 0.1 0\n1 0 0\n1 1 0\n0 1 0\n", "0 0 0\n2 1 0\n0 2 0\n1 1 0\n");
        let arrow = arrow.replace("4 0 1 2 3", "4 1 2 3 0");
        let arrow = super::read(arrow.as_bytes()).expect("an arrow");
        let area = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|corner| arrow.points[corner as usize]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        let areas: Vec<f64> = arrow.faces.iter().map(area).collect();
        assert!(areas.iter().all(|area| *area > 0.0) && areas.iter().sum::<f64>() == 1.0, "{areas:?}");
    }

    #[test]
    fn a_binary_file_gives_what_the_text_gives() {
        let (head, _) = SQUARE.split_once("0 0.1").expect("a payload");
        for (word, big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
            let mut bytes = head.replace("ascii", word).into_bytes();
            let mut put = |little: &[u8]| {
                let mut little = little.to_vec();
                if big {
                    little.reverse();
                }
                bytes.extend(little);
            };
            for (x, y) in [(0.0_f32, 0.1_f64), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
                put(&x.to_le_bytes());
                put(&y.to_le_bytes());
                put(&0_i32.to_le_bytes());
            }
            put(&[4]);
            (0..4_i32).for_each(|corner| put(&corner.to_le_bytes()));
            assert_eq!(read(&bytes), read(SQUARE.as_bytes()), "{word}");
            assert!(read(&bytes[..bytes.len() - 1]).is_err(), "{word}, cut off");
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let told = |from: &str, to: &str| {
            let refused = read(SQUARE.replace(from, to).as_bytes()).expect_err("a fault");
            format!("{}: {}", refused.place, refused.problem)
        };
        assert_eq!(told("4 0 1 2 3", "4 0 1 2 4"), "face 0: it names the vertex 4, counted from 0");
        assert_eq!(told("4 0 1 2 3", "2 0 1"), "face 0: it has 2 corners");
        assert_eq!(told("4 0 1 2 3", "0"), "face 0: it has 0 corners");
        assert_eq!(told("1 1 0\n", "1e999 1 0\n"), "vertex 2: a coordinate is no finite number");
        assert_eq!(told("property double y", "property double q"), "vertex 0: the numbers x, y and z are missing");
        assert_eq!(told("vertex_indices", "corners"), "face 0: it has no list of vertices");
        assert_eq!(told("element vertex 4", "element vertex 400"), "its header: it announces 400 elements `vertex`");
        assert_eq!(told("element face 1\n", "element face 0\n"), "as a whole: there are no triangles");
        assert!(told("1 0 0\n", "1 a 0\n").starts_with("line 11: "), "{}", told("1 0 0\n", "1 a 0\n"));
        assert!(read(b"").is_err() && read(b"solid stl").is_err());
    }
}
