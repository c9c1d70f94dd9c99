//! Triangles from a Wavefront OBJ: lines `v x y z` and `f` with the numbers of vertices, from 1 or, if negative, back
//! from the last; of `1/2/3` the first number counts. Metres, z upward.
//!
//! Absent: all other lines, which are skipped, lines that go on with `\`, and free-form surfaces.

use super::triangles::{MOST_ELEMENTS, Refused, Triangles};

/// Reads the triangles of an OBJ file.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles, Refused> {
    let text = std::str::from_utf8(bytes)
        .map_err(|_| Refused::new("as a whole", "it is no text", "an OBJ: lines `v` and `f`"))?;
    let mut triangles = Triangles::default();
    for (number, line) in text.lines().enumerate() {
        let place = || format!("line {}", number + 1);
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                if triangles.points.len() == MOST_ELEMENTS {
                    let problem = format!("there are more than {MOST_ELEMENTS} vertices");
                    return Err(Refused::new(place(), problem, "a smaller mesh"));
                }
                triangles.points.push(point(&place, words)?);
            }
            Some("f") => {
                let corners: Result<Vec<u32>, Refused> =
                    words.map(|word| corner(&place, word, triangles.points.len())).collect();
                triangles.add(place, &corners?)?;
            }
            _ => {}
        }
    }
    if triangles.faces.is_empty() {
        return Err(Refused::new("as a whole", "there are no triangles", "lines `v` with points and `f` with faces"));
    }
    Ok(triangles)
}

fn point<'t>(place: &impl Fn() -> String, words: impl Iterator<Item = &'t str>) -> Result<[f64; 3], Refused> {
    let numbers: Vec<f64> =
        words.take(3).filter_map(|word| word.parse().ok()).filter(|x: &f64| x.is_finite()).collect();
    <[f64; 3]>::try_from(numbers)
        .map_err(|_| Refused::new(place(), "it has no three finite numbers", "`v x y z`, metres"))
}

/// A corner of a face, counted from 0, of which there are `points` so far.
fn corner(place: &impl Fn() -> String, word: &str, points: usize) -> Result<u32, Refused> {
    let first = word.split('/').next().unwrap_or_default();
    let number: Option<i64> = first.parse().ok();
    let found = number.and_then(|number| match number {
        1.. => Some(number - 1),
        0 => None,
        back => Some(points as i64 + back),
    });
    let found = found.and_then(|found| u32::try_from(found).ok()).filter(|found| (*found as usize) < points);
    found.ok_or_else(|| {
        let shown: String = word.chars().take(40).collect();
        let problem = format!("`{shown}` is none of the {points} vertices before it");
        Refused::new(place(), problem, "the number of a vertex, from 1, or back from the last, from -1")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: &str = "# a tetrahedron\no solid\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.5\nvn 0 0 1\n\
        f 1 3 2\nf 1/1 2/2/2 4//1\nf -3 -2 -1\nf 1 4 3\n";

    #[test]
    fn faces_name_vertices_from_either_end() {
        let read = read(TETRAHEDRON.as_bytes()).expect("a tetrahedron");
        assert_eq!(read.points[3], [0.0, 0.0, 1.5]);
        assert_eq!(read.faces, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]);
        let square = super::read(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").expect("a square");
        assert_eq!(square.faces.len(), 2);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let told = |from: &str, to: &str| {
            let refused = read(TETRAHEDRON.replace(from, to).as_bytes()).expect_err("a fault");
            format!("{}: {}", refused.place, refused.problem)
        };
        assert_eq!(told("f 1 3 2", "f 1 9 2"), "line 8: `9` is none of the 4 vertices before it");
        assert_eq!(told("f 1 3 2", "f 1 0 2"), "line 8: `0` is none of the 4 vertices before it");
        assert_eq!(told("f -3 -2", "f -5 -2"), "line 10: `-5` is none of the 4 vertices before it");
        assert_eq!(told("f 1 3 2", "f 1 3"), "line 8: it has 2 corners");
        assert_eq!(told("v 1 0 0", "v 1 0 inf"), "line 4: it has no three finite numbers");
        assert_eq!(told("f", "g"), "as a whole: there are no triangles");
        assert!(read(b"\xff\xfe").is_err());
    }
}
