//! A tree of stems by levels and at ranges: what is drawn of it, as what, and the ranges that its vertices tell; bark
//! in metres, and the columns of a PLY file.

use super::detail::level;
use super::measure::{assert_unit_normals, surface, volume};
use super::range::{Scales, Zoom};
use super::tests::LAST;
use super::*;
use phytomer_looks::FormName;
use phytomer_sim::gusts::Swing;
use phytomer_sim::plant::*;
use phytomer_sim::pose::pose;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use std::collections::BTreeSet;

/// An age at which all stands.
const AGE: Tick = 3;

fn stem(plant: &mut Plant, bearer: Option<NodeId>, order: u8, segments: u32) -> Vec<NodeId> {
    let axis = plant.add_axis(NewAxis {
        bearer,
        order,
        origin: Origin::Axillary,
        azimuth: bearer.map_or(0.0, |bearer| 2.4 * bearer.0 as f32),
        insertion: if bearer.is_some() { 1.0 } else { 0.0 },
        appearance: 1,
        birth: 1,
        ..NewAxis::OF_THE_SEED
    });
    let mut parent = bearer.unwrap_or(NodeId::NONE);
    let mut add = |rank: u32| {
        let thick = 0.3 / f32::from(order) / f32::from(order);
        let diameter = |above: u32| thick * (1.0 - above as f32 / (segments + 1) as f32);
        let length = 0.25 / f32::from(order);
        let node =
            NewNode { parent, axis, birth: 1, rank, length, diameter: diameter(rank - 1), ..NewNode::OF_THE_TRUNK };
        parent = plant.add_node(node);
        plant.nodes.diameter_tip[parent.index()] = diameter(rank);
        parent
    };
    (1..=segments).map(&mut add).collect()
}

/// The trunk and the branches of Table 2: 36 segments, and 30 branches of 8; on each branch 2 twigs of 3, with a leaf a
/// segment.
fn tree() -> Plant {
    let trend = Trend { inclination: 0.0, share: 0.0 };
    let habit = Habit { trends: vec![trend], looks: Looks::of_shape(Shape::Cone), ..Habit::default() };
    let seed = Seed { plant: 7, draws: 7, run_seed: 42, component_limit: 100_000, keep_events: false };
    let mut plant = Plant::new(&seed, Arc::new(habit));
    let trunk = stem(&mut plant, None, 1, 36);
    for bearer in &trunk[6..] {
        let branch = stem(&mut plant, Some(*bearer), 2, 8);
        for bearer in [branch[3], branch[6]] {
            stem(&mut plant, Some(bearer), 3, 3).into_iter().for_each(|node| leaf(&mut plant, node));
        }
    }
    pose(&mut plant, LAST);
    plant
}

fn leaf(plant: &mut Plant, node: NodeId) {
    plant.add_organ(NewOrgan {
        node,
        kind: Kind::Leaf,
        position: 0,
        birth: 1,
        death: 30,
        cause: Cause::LifeLength,
        form: FormName::Elliptic.form(),
        length: 0.12,
        width: 0.05,
        area: 0.004,
        azimuth: 0.8,
        insertion: 1.0,
    });
}

fn at(metres: Option<f64>) -> MeshOptions {
    let afar = Afar { scales: Scales::SUMMER, zoom: Zoom::default(), metres };
    MeshOptions { seen: Seen { levels: None, afar: Some(afar) }, ..MeshOptions::default() }
}

fn of_levels(levels: [u8; 2]) -> Seen {
    Seen { levels: Some(levels), afar: None }
}

/// For each component that is drawn its number of vertices.
fn components(plant: &Plant, options: &MeshOptions) -> Vec<(i32, usize)> {
    let mesh = mesh_plant(plant, AGE, options);
    let numbers: Vec<i32> = mesh.vertices.iter().map(|vertex| vertex.tag().component).collect();
    numbers.chunk_by(|one, next| one == next).map(|chunk| (chunk[0], chunk.len())).collect()
}

fn numbers(plant: &Plant, options: &MeshOptions) -> BTreeSet<i32> {
    components(plant, options).into_iter().map(|(number, _)| number).collect()
}

/// Table 2 for the trunk and the branches, of which a line is drawn where there is no polygon: tubes of 8 sides have 34
/// vertices, tubes of 3 have 14.
#[test]
fn a_range_draws_the_segments_of_table_2() {
    let plant = tree();
    let level_of = |number: i32| {
        let node = plant.nodes.component.iter().position(|component| *component as i32 == number);
        node.map(|node| level(&plant, NodeId(node as u32)))
    };
    for (metres, trunk, branches) in [
        (5.0, [36, 0], [240, 0]),
        (60.0, [36, 0], [240, 0]),
        (120.0, [36, 0], [0, 223]),
        (240.0, [36, 0], [0, 153]),
        (600.0, [20, 16], [0, 35]),
        (1200.0, [0, 36], [0, 0]),
    ] {
        let drawn = components(&plant, &at(Some(metres)));
        let count = |level: u8, vertices: usize| {
            drawn.iter().filter(|(number, size)| level_of(*number) == Some(level) && *size == vertices).count()
        };
        assert_eq!([count(0, 34), count(0, 14)], trunk, "the trunk at {metres} m");
        assert_eq!([count(1, 34), count(1, 14)], branches, "branches at {metres} m");
    }
}

/// Clipped by `until_m` at any range, the whole mesh has the components of the mesh at that range; through a lens too.
#[test]
fn until_tells_what_a_range_draws() {
    let plant = tree();
    let zoom = Zoom { height: 2000.0, field_of_view_deg: 30.0 };
    for zoom in [Zoom::default(), zoom] {
        let seen = |metres| {
            let afar = Afar { scales: Scales::SUMMER, zoom, metres };
            MeshOptions { seen: Seen { levels: None, afar: Some(afar) }, ..MeshOptions::default() }
        };
        let whole = seen(None);
        let scene = Scene::new(&plant, AGE, &whole);
        let columns = scene.columns().expect("ranges are asked for");
        assert_eq!(columns.names(), [UNTIL]);
        let mesh = mesh_plant(&plant, AGE, &whole);
        let mut until = Vec::new();
        mesh.vertices.iter().for_each(|vertex| columns.put(vertex, &mut until));
        for metres in (0..120).map(|step| 0.37 + 11.3 * f64::from(step)) {
            let clipped = mesh.vertices.iter().zip(&until).filter(|(_, until)| f64::from(**until) >= metres);
            let clipped: BTreeSet<i32> = clipped.map(|(vertex, _)| vertex.tag().component).collect();
            assert_eq!(clipped, numbers(&plant, &seen(Some(metres))), "at {metres} m");
        }
        assert!(until.contains(&f32::INFINITY), "the trunk is drawn for ever");
    }
}

#[test]
fn levels_are_drawn_alone() {
    let plant = tree();
    let count = |levels| numbers(&plant, &MeshOptions { seen: of_levels(levels), ..MeshOptions::default() }).len();
    assert_eq!(
        [[0, 0], [0, 1], [1, 1], [2, 2], [0, 2], [3, 3], [0, 9], [4, 9]].map(count),
        [36, 276, 240, 180, 456, 180, 636, 0]
    );
    let tolerance = Some(Tolerance::of(1e-3));
    let options = MeshOptions { seen: of_levels([0, 1]), tolerance, ..MeshOptions::default() };
    assert_eq!(Scene::new(&plant, AGE, &options).counts().components, 276, "within a tolerance too");
}

/// A line has the volume of its segment, a point the area of its leaf.
#[test]
fn lines_keep_the_volume_and_points_the_area() {
    let plant = tree();
    let alone = |levels: [u8; 2], metres| {
        let all = at(metres);
        MeshOptions { seen: Seen { levels: Some(levels), ..all.seen }, ..all }
    };
    let of = |options: &MeshOptions| mesh_plant(&plant, AGE, options);
    let (near, far) = (of(&alone([0, 0], None)), of(&alone([0, 0], Some(1200.0))));
    let (near, far) = (volume(&near.vertices, &near.faces), volume(&far.vertices, &far.faces));
    assert!((far / near - 1.0).abs() < 1e-4, "{near} {far}");
    let points = of(&alone([3, 3], Some(300.0)));
    assert_unit_normals(&points.vertices);
    let area = surface(&points.vertices, &points.faces) / points.faces.len() as f64;
    assert!((area / 0.004 - 1.0).abs() < 1e-5, "{area}");
}

/// Around every segment the texture stands a whole number of times. Along it, it covers its own length, or on an axis
/// that is thinner than it is wide as much less as around it: where the axis has its mean circumference a picture is
/// from 3/4 to 3/2 as wide as it should be for its length. It goes on where the next segment begins.
#[test]
fn bark_is_as_dense_on_twigs_as_on_the_trunk() {
    let plant = tree();
    let options = MeshOptions { bark_m: Some(0.2), seen: of_levels([0, 2]), ..MeshOptions::default() };
    let mesh = mesh_plant(&plant, AGE, &options);
    let mut thin = [0, 0];
    for (node, vertices) in mesh.vertices.chunks(34).enumerate() {
        let node = NodeId(node as u32);
        let of_axis = (0..plant.nodes.len()).filter(|other| plant.nodes.axis[*other] == plant.nodes.axis[node.index()]);
        let [surface, squares] = of_axis.fold([0.0_f32; 2], |[surface, squares], other| {
            let mean = 0.5 * (plant.nodes.diameter[other] + plant.nodes.diameter_tip[other]);
            let length = plant.posed_length(NodeId(other as u32));
            [surface + mean * length, squares + mean * mean * length]
        });
        let around = std::f32::consts::PI * squares / surface;
        let (low, high) = (vertices[0].texture(), vertices[9 + 8].texture());
        let times = high[0];
        assert!(times >= 1.0 && times.fract() == 0.0, "{times}");
        let long = plant.posed_length(node) / (high[1] - low[1]);
        assert!((around < 0.2 || (long / 0.2 - 1.0).abs() < 1e-4) && long <= 0.2001, "{around} {long}");
        let wide = around / times;
        assert!((0.749..=1.501).contains(&(wide / long)), "{wide} {long}");
        assert!(around >= 0.2 || (wide / long - 1.0).abs() < 1e-3, "{wide} {long}");
        let along = (plant.nodes.rank[node.index()] - 1) as f32 * plant.posed_length(node);
        assert!((low[1] * long - along).abs() < 1e-3 * along.max(0.01));
        thin[usize::from(around < 0.2)] += 1;
    }
    assert!(thin[0] > 0 && thin[1] > 0, "{thin:?}");
    let within = MeshOptions { tolerance: Some(Tolerance::of(1e-3)), ..options };
    let most = |options: &MeshOptions| {
        let all = mesh_plant(&plant, AGE, options).vertices;
        let first = plant.nodes.axis[0];
        let of_trunk = (0..plant.nodes.len()).filter(|node| plant.nodes.axis[*node] == first);
        let numbers: Vec<i32> = of_trunk.map(|node| plant.nodes.component[node] as i32).collect();
        let trunk = all.iter().filter(|vertex| numbers.contains(&vertex.tag().component));
        trunk.map(|vertex| vertex.texture()[1]).fold(0.0, f32::max)
    };
    assert!((most(&within) - 36.0 * 0.25 / 0.2).abs() < 1e-4, "tubes of several internodes have it too");
}

/// A reader that is not ours reads the columns of a file, and the properties of every mesh before them.
#[test]
fn a_file_has_its_columns() {
    let plant = tree();
    let swing = Swing { rate: 4.4, phases: [1.0, 2.0], length: 9.0, radius: 0.15, segments: 36, before: 0 };
    let swings = (0..plant.axes.len()).map(|axis| Swing { rate: 4.4 + axis as f64, ..swing }).collect();
    let options = MeshOptions { swings: Some(Arc::new(swings)), ..at(None) };
    let scene = Scene::new(&plant, AGE, &options);
    let mut bytes = Vec::new();
    Ply.write(&scene, &scene.about(42), &mut bytes).expect("memory does not fail");
    let ply = Parser::<DefaultElement>::new().read_ply(&mut &bytes[..]).expect("a PLY file");
    let (vertices, faces) = (&ply.payload["vertex"], &ply.payload["face"]);
    assert_eq!((vertices.len() as u64, faces.len() as u64), (scene.counts().vertices, scene.counts().faces));
    let names = ["until_m", "level", "stem_place", "sway_rate", "sway_phase_x", "sway_phase_y"];
    let float = |vertex: &DefaultElement, name: &str| match vertex[name] {
        Property::Float(number) => number,
        ref other => panic!("{name} is {other:?}"),
    };
    // The sixth segment of the trunk, at its base and at its tip.
    for (vertex, place) in [(34 * 5, 5.0 / 36.0), (34 * 5 + 9, 6.0 / 36.0)] {
        let found = names.map(|name| float(&vertices[vertex], name));
        let expected = [f32::INFINITY, 0.0, place, 4.4, 1.0, 2.0];
        let near = |(found, expected): (&f32, &f32)| found == expected || (found - expected).abs() < 1e-5;
        assert!(found.iter().zip(&expected).all(near), "{found:?}");
    }
    let last = &vertices[vertices.len() - 1];
    assert_eq!([float(last, "level"), float(last, "sway_rate")], [2.0, 4.4 + 90.0], "a leaf sways with its stem");
}
