//! Forms from mesh files: a leaf written in three formats by hand reads back as the same triangles.
//!
//! Broken files give their messages, and never a panic or a hang. Absent: the forms of the library (`forms/tests`).

use super::*;
use phytomer_sim::plant::key::scramble;

/// A leaf 4 long and 2 wide of five vertices: a quadrilateral and a triangle.
const POINTS: [[f32; 3]; 5] = [[1.0, 0.0, 0.0], [2.5, -1.0, 0.25], [5.0, 0.0, 0.0], [2.5, 1.0, 0.25], [4.0, 1.0, 0.5]];
const TRIANGLES: [[u32; 3]; 3] = [[0, 1, 2], [0, 2, 3], [3, 2, 4]];

fn in_obj() -> Vec<u8> {
    let mut text = "# a leaf\nmtllib none.mtl\n".to_owned();
    POINTS.iter().for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
    text += "vn 0 0 1\ng leaf\nf 1//1 2//1 3//1 4//1\nf -2/7/1 3//1 5/1/1 # behind\n";
    text.into_bytes()
}

fn in_ply() -> Vec<u8> {
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment a leaf\nelement vertex {}\nproperty float x\nproperty float y\nproperty double z\n\
         element face 2\nproperty list uchar int vertex_indices\nend_header\n",
        POINTS.len()
    );
    POINTS.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
    text += "4 0 1 2 3\n3 3 2 4\n";
    text.into_bytes()
}

fn in_binary_ply() -> Vec<u8> {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        element face 3\nproperty list uchar uint vertex_index\nend_header\n"
        .to_vec();
    POINTS.iter().flatten().for_each(|x| bytes.extend(x.to_le_bytes()));
    for triangle in TRIANGLES {
        bytes.push(3);
        triangle.iter().for_each(|corner| bytes.extend(corner.to_le_bytes()));
    }
    bytes
}

fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let pad = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let mut body = Vec::new();
    for (kind, chunk) in [(b"JSON", pad(json.as_bytes(), b' ')), (b"BIN\0", pad(binary, 0))] {
        body.extend((chunk.len() as u32).to_le_bytes());
        body.extend(kind);
        body.extend(chunk);
    }
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((body.len() as u32 + 12).to_le_bytes());
    bytes.extend(body);
    bytes
}

const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"children":[1],"translation":[0,0,0],"scale":[1,1,1]},{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"},
                 {"bufferView":1,"componentType":5123,"count":9,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":18}],
    "buffers":[{"byteLength":78}]}"#;

fn binary_of_glb() -> Vec<u8> {
    let mut binary = Vec::new();
    // y is up in the file.
    POINTS.iter().for_each(|&[x, y, z]| [x, z, -y].iter().for_each(|x| binary.extend(x.to_le_bytes())));
    TRIANGLES.iter().flatten().for_each(|&corner| binary.extend((corner as u16).to_le_bytes()));
    binary
}

fn in_glb() -> Vec<u8> {
    glb(GLTF, &binary_of_glb())
}

fn files() -> [(&'static str, Vec<u8>); 4] {
    [("leaf.obj", in_obj()), ("leaf.ply", in_ply()), ("Leaf.PLY", in_binary_ply()), ("leaf.glb", in_glb())]
}

/// The triangles by their corners, so that the numbering of vertices does not matter.
fn corners(soup: &Soup) -> Vec<[[f32; 3]; 3]> {
    soup.triangles.iter().map(|triangle| triangle.map(|corner| soup.points[corner as usize])).collect()
}

#[test]
fn the_three_formats_read_as_the_same_triangles() {
    let expected = Soup { points: POINTS.to_vec(), triangles: TRIANGLES.to_vec() };
    for (name, bytes) in files() {
        assert_eq!(corners(&soup(name, &bytes).unwrap()), corners(&expected), "{name}");
    }
}

#[test]
fn a_mesh_is_moved_and_scaled_into_the_unit_box() {
    let files = files();
    let own = OwnForms::read(files.iter().map(|(name, bytes)| (*name, bytes.as_slice()))).unwrap();
    assert_eq!((own.len(), own.is_empty()), (4, false));
    for place in 0..4 {
        let shape = own.shape(place).unwrap();
        let at: Vec<[f32; 3]> = shape.points.iter().map(|point| point.at).collect();
        assert_eq!(at.iter().map(|p| p[0]).fold(f32::MAX, f32::min), 0.0);
        assert!(at.contains(&[0.375, -0.5, 0.125]) && at.contains(&[1.0, 0.0, 0.0]) && at.contains(&[0.75, 0.5, 0.25]));
        assert_eq!((shape.points.len(), shape.faces.len()), (5, 3), "no idle vertices");
        let unit = |p: &Point| (p.normal.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-5;
        assert!(shape.points.iter().all(unit));
        assert!(shape.points[0].normal[2] > 0.9, "it looks up");
    }
    assert!(own.shape(4).is_none());
}

#[test]
fn nodes_of_a_glb_have_their_transforms() {
    let moved = GLTF.replace(
        "\"translation\":[0,0,0],\"scale\":[1,1,1]",
        "\"translation\":[3,4,5],\"rotation\":[0,0.70710677,0,0.70710677],\"scale\":[2,2,2]",
    );
    let soup = soup("leaf.glb", &glb(&moved, &binary_of_glb())).unwrap();
    for (found, [x, y, z]) in soup.points.iter().zip(POINTS) {
        // In the file (x, z, -y) doubled, a quarter turn about y (z to x, x to -z), then moved.
        let [fx, fy, fz] = [2.0 * -y + 3.0, 2.0 * z + 4.0, -2.0 * x + 5.0];
        let expected = [fx, -fz, fy];
        assert!((0..3).all(|k| (found[k] - expected[k]).abs() < 1e-4), "{found:?} {expected:?}");
    }
}

/// What exporters write: statements over several lines, all line ends, tabs, marks, comments in any encoding,
/// exponents, weights and colours of vertices, corners from the end, normals from the end.
#[test]
fn an_obj_is_read_as_exporters_write_it() {
    let square = "v 0 -1 0\nv 2 -1 0\nv 2 1 0\nv 0 1 0\n";
    let plain = soup("x.obj", format!("{square}f 1 2 3 4\n").as_bytes()).unwrap();
    for (what, text) in [
        ("a continued face", format!("{square}f 1 2 \\\n3 4\n")),
        ("a continued face with a comment behind it", format!("{square}f 1 2 \\\n\\\n  3 4 # behind\n")),
        ("a space behind the backslash", format!("{square}f 1 2\\ \n3 4\n")),
        ("a continued vertex", square.replacen("0 -1 0", "0\\\n-1\\\n0", 1) + "f 1 2 3 4"),
        ("a continuation of the last line", format!("{square}f 1 2 3 4 \\")),
        ("a comment that ends in a backslash", format!("# C:\\leaves\\\n{square}f 1 2 3 4#corners\\\n")),
        ("ends of lines of Windows", format!("{square}f 1 2 \\\n3 4\n").replace('\n', "\r\n")),
        ("ends of lines of old Macintoshes", format!("{square}f 1 2 \\\n3 4\n").replace('\n', "\r")),
        ("tabs", format!("{square}f 1 2 3 4\n").replace(' ', "\t ")),
        ("a mark of UTF-8", format!("\u{feff}{square}f 1 2 3 4\n")),
        ("exponents", square.replace("-1", "-1.0e+00").replace("2", "+2.E0") + "f 1 2 3 4\n"),
        ("weights", square.replace(" 0\n", " 0 1.0\n") + "f 1 2 3 4\n"),
        ("colours", square.replace(" 0\n", " 0 0.1 0.2 0.3\n") + "f 1 2 3 4\n"),
        ("corners from the end", format!("{square}f -4 -3 -2 -1\n")),
        ("textures and normals", format!("{square}vt 0 0\nvn 0 0 1\ns off\nf 1/1/1 2/1/1 3/1/-1 4/1/1\n")),
        ("normals alone", format!("vn 0 0 1\n{square}f 1//1 2//1 3//1 4//1\n")),
        ("textures alone", format!("vt 0 0\n{square}f 1/1 2/1 3/ 4//\n")),
        ("the old word for a face", format!("{square}fo 1 2 3 4\n")),
    ] {
        let read = soup("x.obj", text.as_bytes()).unwrap_or_else(|fault| panic!("{what}: {fault}"));
        assert_eq!(corners(&read), corners(&plain), "{what}");
    }
    let latin = [b"# M\xfcller\no Bl\xe4tter\n", format!("{square}f 1 2 3 4\n").as_bytes()].concat();
    assert_eq!(soup("x.obj", &latin).unwrap(), plain);
    assert_eq!(
        fault("x.obj", b"# M\xfcller\nv 0 0\nv 1 2 3"),
        "line 2: a vertex without three numbers; expected `v x y z`"
    );
    assert_eq!(
        fault("x.obj", b"# M\xfcller\nv 0 \xff 0"),
        "byte 14: no UTF-8 text; expected the text of a Wavefront OBJ"
    );
    let obj = "v 0 0 0\r\nv 1 0 0\r\nv 1 1 \\\r\n0\r\nf 1 2 \\\r\n9\r\n";
    assert!(fault("x.obj", obj.as_bytes()).starts_with("line 5: the corner `9`"), "the line where the face begins");
}

/// Equal normals counted from the start and from the end are one normal; a different normal makes another vertex.
#[test]
fn normals_of_an_obj_are_counted_from_either_end() {
    let text = "v 0 -1 0\nv 2 -1 0\nv 2 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nvn 0 1 0\nf 1//-2 2//-1 3//-2\n";
    assert_eq!(soup("x.obj", text.as_bytes()).unwrap().points.len(), 4);
}

#[test]
fn a_ply_is_read_as_exporters_write_it() {
    let text = String::from_utf8(in_ply()).unwrap();
    let plain = soup("x.ply", &in_ply()).unwrap();
    for (what, text) in [
        ("ends of lines of Windows", text.replace('\n', "\r\n")),
        ("other words of the header", text.replace("comment a leaf\n", "obj_info 3\ncomment by\ncomment\n")),
        ("tabs and spaces at the ends", text.replace("\n4 0 1 2 3\n", " \n4 0 1\t2 3 \n")),
        ("exponents", text.replace("2.5", "2.5e+00")),
        ("the names of types with their sizes", text.replace("float x", "float32 x").replace("double z", "float64 z")),
    ] {
        let read = soup("x.ply", text.as_bytes()).unwrap_or_else(|fault| panic!("{what}: {fault}"));
        assert_eq!(corners(&read), corners(&plain), "{what}");
    }
}

fn fault(name: &str, bytes: &[u8]) -> String {
    check(name, bytes).unwrap_err().to_string()
}

#[test]
fn bad_meshes_give_their_messages() {
    let obj = |text: &str| fault("x.obj", text.as_bytes());
    assert_eq!(obj("v 1 2\n"), "line 1: a vertex without three numbers; expected `v x y z`");
    assert_eq!(obj("v 0 0 0\nf 1 2 3\n"), "line 2: the corner `2`; expected one of the 1 vertices before it");
    assert_eq!(obj("v 0 0 0\nv 1 1 0\nf 1 2\n"), "line 3: a face of 2 corners; expected at least 3");
    assert_eq!(obj("f -1 -2 -3\n"), "line 1: the corner `-1`; expected one of the 0 vertices before it");
    assert_eq!(obj(""), "the whole: a mesh without triangles; expected at least one");
    assert!(
        obj("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").starts_with("the whole: a mesh 2 long (x) and 0 to each side (y)")
    );
    assert!(
        obj("v 0 1 0\nv nan 0 0\nv 2 0 0\nf 1 2 3\n").starts_with("a vertex: a coordinate that is no finite number")
    );
    assert!(obj("v 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 3\n").starts_with("the whole: no triangle has an area"));
    assert_eq!(fault("x.obj", b"v 1 2 \xff"), "byte 7: no UTF-8 text; expected the text of a Wavefront OBJ");
    assert!(fault("x.stl", b"").starts_with("its name: a mesh of no known format"));
    let crowd = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned() + &"f 1 2 3\n".repeat(MOST_TRIANGLES + 1);
    assert!(obj(&crowd).starts_with("line 10004: more than 10000 triangles"), "{}", obj(&crowd));
    assert!(fault("x.ply", b"plx\n").starts_with("line 1: "));
    assert!(fault("x.ply", &in_ply()[..150]).contains(": "));
    let huge = b"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n";
    assert!(fault("x.ply", huge).starts_with("the header: 4000000000 elements `vertex`"), "{}", fault("x.ply", huge));
    let flat = String::from_utf8(in_ply()).unwrap().replace("property double z", "property double w");
    assert!(fault("x.ply", flat.as_bytes()).starts_with("vertex 0: a vertex without the numbers x, y and z"));
    assert!(fault("x.glb", b"glTF").starts_with("byte 0: no head of a binary glTF 2.0"));
    let with = |from: &str, to: &str| fault("x.glb", &glb(&GLTF.replace(from, to), &binary_of_glb()));
    assert!(
        with("\"count\":5", "\"count\":500")
            .starts_with("mesh 0, accessor 0: a stretch of the binary chunk that is not there")
    );
    assert!(with("\"children\":[1]", "\"children\":[0]").starts_with("node 0: nodes within nodes without end"));
    assert!(with("\"indices\":1", "\"indices\":1,\"mode\":5").starts_with("mesh 0: points, lines, strips or fans"));
    assert!(with("\"scene\":0", "\"extensionsRequired\":[\"x\"]").starts_with("extensionsRequired: "));
    assert!(with("\"asset\"", "asset").starts_with("the JSON chunk: "));
}

/// A small file cannot demand much memory or time by naming the same part many times.
#[test]
fn a_part_that_is_named_again_and_again_is_a_fault() {
    let idle = GLTF
        .replace("\"count\":5", "\"count\":30000")
        .replace("\"byteLength\":60}", "\"byteLength\":60,\"byteStride\":0}")
        .replace("\"count\":9", "\"count\":0");
    let nodes = idle.replace("\"children\":[1]", &format!("\"children\":[{}]", ["1"; 4000].join(",")));
    let told = fault("x.glb", &glb(&nodes, &binary_of_glb()));
    assert!(told.starts_with("mesh 0: more than 300000 vertices in all"), "{told}");
    let primitive = "{\"attributes\":{\"POSITION\":0},\"indices\":1}";
    let none = idle.replace("\"count\":30000", "\"count\":0");
    let primitives = none.replace(primitive, &[primitive; 5000].join(","));
    let told = fault("x.glb", &glb(&primitives, &binary_of_glb()));
    assert!(told.starts_with("mesh 0: more than 4096 nodes and primitives"), "{told}");
}

/// Bytes are changed, doubled and cut, by fixed draws: each result is a mesh or a fault, within a short time.
#[test]
fn no_broken_file_panics_or_hangs() {
    let files = files();
    let mut meshes = 0;
    for case in 0..4000_u64 {
        let (name, bytes) = &files[case as usize % files.len()];
        let mut bytes = bytes.clone();
        for change in 0..1 + scramble(case) % 6 {
            let draw = scramble(case << 8 | change);
            let (at, byte) = ((draw >> 16) as usize % bytes.len().max(1), draw as u8);
            match draw >> 8 & 7 {
                0 if bytes.len() > 8 => bytes.truncate(at.max(bytes.len() / 2)),
                1 => bytes.insert(at, byte),
                2 if bytes.len() > 1 => drop(bytes.remove(at)),
                _ if at < bytes.len() => bytes[at] = byte,
                _ => {}
            }
        }
        let Ok(shape) = shape_of(name, &bytes) else { continue };
        meshes += 1;
        let shape = shape.shape;
        assert!(shape.faces.len() <= MOST_TRIANGLES && !shape.faces.is_empty(), "case {case}");
        assert!(shape.faces.iter().flatten().all(|corner| (*corner as usize) < shape.points.len()), "case {case}");
        assert!(shape.points.iter().all(|p| p.normal.iter().all(|x| x.is_finite())), "case {case}");
    }
    assert!((50..3950).contains(&meshes), "{meshes} of 4000 are still meshes: both ends are reached");
}

/// A kite of half its length × width, leaning like a ridge, once and as a sheet of two sides; and a closed needle.
#[test]
fn a_mesh_has_the_area_of_one_side_in_the_proportions_of_its_file() {
    let share = |text: &str| OwnForms::read([("leaf.obj", text.as_bytes())]).unwrap().area_share(0).unwrap();
    let kite = "v 0 0 0\nv 2 -1 0\nv 3 0 0\nv 2 1 0\nf 1 2 3 4\n";
    assert!((share(kite) - 0.5).abs() < 1e-6);
    assert!((share(&format!("{kite}f 4 3 2 1\n")) - 0.5).abs() < 1e-6, "two sides are one sheet");
    let roof = kite.replace("v 2 -1 0", "v 2 -1 1").replace("v 2 1 0", "v 2 1 1");
    let roof = roof.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 4");
    assert!((share(&roof) - 0.5 * 2_f64.sqrt()).abs() < 1e-4, "{}", share(&roof));
    // A cuboid 8 × 2 × 2: half of 4 · 16 + 2 · 4, of 16.
    let mut cuboid = String::new();
    for (x, y, z) in (0..8).map(|k| (8 * (k & 1), (k & 2) - 1, (k >> 1 & 2) - 1)) {
        cuboid += &format!("v {x} {y} {z}\n");
    }
    cuboid += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    assert!((share(&cuboid) - 36.0 / 16.0).abs() < 1e-4, "{}", share(&cuboid));
}
