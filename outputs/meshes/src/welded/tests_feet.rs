//! The foot of a trunk with a flare, and forks, against closed forms.
//!
//! Absent: how the surface hangs together whatever stands where (`tests`).

use super::super::{Joints, Mesh, MeshOptions, OwnForms, Textures, mesh_plant};
use super::course::Station;
use super::fork::evened;
use super::tests::{Sketch, assert_sphere, trunk, volume};
use glam::DVec3;
use phytomer_looks::Flare;
use phytomer_sim::math::{atan2, cos, sin};
use phytomer_sim::plant::{NodeId, Plant};
use std::f64::consts::PI;
use std::sync::Arc;

const RADIUS: f64 = 0.1;

fn flared(plant: &Plant, flare: Flare, joints: Joints) -> Mesh {
    let own = Arc::new(OwnForms::default().with(Textures::default(), Some(flare)));
    mesh_plant(plant, 1, &MeshOptions { sides: 16, joints, own, ..MeshOptions::default() })
}

/// The volume that a round flare adds to a cylinder: that between the wood and the wood wider by w f.
fn added(flare: &Flare) -> f64 {
    let (high, steps) = (2.0 * RADIUS * flare.height(), 10_000);
    let ring = |k: i32| {
        let wide = 1.0 + flare.wider((f64::from(k) + 0.5) / f64::from(steps), 0.0);
        PI * RADIUS * RADIUS * (wide * wide - 1.0)
    };
    (0..steps).map(ring).sum::<f64>() * high / f64::from(steps)
}

/// Welded with its flare, a trunk is one closed surface that is as wide as stated at the ground and as the wood above
/// the flare, with the volume of both.
#[test]
fn a_welded_trunk_widens_as_stated() {
    let mut sketch = Sketch::new();
    trunk(&mut sketch, RADIUS);
    for flare in [
        Flare { width: 0.5, height: None, lobes: 0, depth: 0.0 },
        Flare { width: 1.0, height: Some(3.0), lobes: 0, depth: 0.0 },
        Flare { width: 0.8, height: Some(2.0), lobes: 5, depth: 0.7 },
    ] {
        let mesh = flared(&sketch.plant, flare, Joints::Welded);
        assert_sphere(&mesh);
        let end = 2.0 * RADIUS * flare.height();
        let mut widest = [0.0_f64; 2];
        for [x, y, z] in mesh.vertices.iter().map(|vertex| vertex.position().map(f64::from)) {
            let reach = (x * x + y * y).sqrt() / RADIUS;
            let wide = 1.0 + flare.wider((z / end).min(1.0), 0.0);
            assert!(reach <= wide * 1.02, "{reach} of {wide} at {z}");
            let place = usize::from(z > end);
            widest[place] = widest[place].max(reach);
        }
        assert!((widest[0] / (1.0 + 2.0 * flare.width) - 1.0).abs() < 0.02 && widest[1] < 1.02, "{widest:?}");
        if flare.lobes == 0 {
            let expected = PI * RADIUS * RADIUS * 2.0 + added(&flare);
            let measured = volume(&mesh);
            assert!((measured / expected - 1.0).abs() < 0.005, "{measured} {expected}");
        }
    }
}

/// Around tubes the flare is a closed body of its own, nowhere within the polygon of the trunk.
#[test]
fn beside_tubes_the_flare_is_a_closed_body() {
    let mut sketch = Sketch::new();
    trunk(&mut sketch, RADIUS);
    let flare = Flare { width: 0.6, height: Some(2.0), lobes: 4, depth: 1.0 };
    let plain = mesh_plant(&sketch.plant, 1, &MeshOptions { sides: 16, ..MeshOptions::default() });
    let with = flared(&sketch.plant, flare, Joints::Open);
    let vertices = with.vertices.len() - plain.vertices.len();
    // What is not drawn internode by internode stands first.
    let faces = with.faces.len() - plain.faces.len();
    let body = Mesh { vertices: with.vertices[..vertices].to_vec(), faces: with.faces[..faces].to_vec() };
    assert_sphere(&body);
    assert!(volume(&body) > PI * RADIUS * RADIUS * 0.4);
    let part = PI / 16.0;
    let corner = (2.0 * part / sin(2.0 * part)).sqrt();
    for [x, y, z] in body.vertices.iter().map(|vertex| vertex.position().map(f64::from)) {
        let reach = (x * x + y * y).sqrt() / RADIUS;
        let from_middle = atan2(y, x).rem_euclid(2.0 * part) - part;
        let middle = z < 1e-6 && reach < 1e-6;
        // The last ring is within the trunk, a tenth of its radius.
        let is_last = z > 0.4001 && reach < 0.9 * corner + 1e-4;
        assert!(middle || is_last || reach > corner * cos(part) / cos(from_middle) - 1e-4, "{reach} at {z}");
        assert!((-1e-6..=0.4101).contains(&z), "{z}");
    }
    assert_eq!(with.vertices[vertices..], plain.vertices[..], "the wood is as ever");
}

/// A sapling has a flare of half its length at most, and a plant without wood none.
#[test]
fn a_flare_is_no_longer_than_half_its_trunk() {
    let mut sketch = Sketch::new();
    let axis = sketch.axis(None);
    sketch.internode(axis, None, [[0.0; 3], [0.0, 0.0, 0.02]], [0.01; 2]);
    let flare = Flare { width: 2.0, height: Some(20.0), lobes: 16, depth: 1.0 };
    assert_sphere(&flared(&sketch.plant, flare, Joints::Welded));
    let open = flared(&sketch.plant, flare, Joints::Open).vertices;
    let plain = mesh_plant(&sketch.plant, 1, &MeshOptions { sides: 16, ..MeshOptions::default() }).vertices;
    let foot = &open[..open.len() - plain.len()];
    let high = foot.iter().map(|vertex| vertex.position()[2]).fold(0.0, f32::max);
    assert!((high - 0.011).abs() < 1e-6, "{high}");
    let none = Sketch::new();
    assert!(flared(&none.plant, flare, Joints::Open).vertices.is_empty());
    assert!(flared(&none.plant, flare, Joints::Collar).vertices.is_empty());
}

/// A trunk of 1 m, at whose tip two equal axes begin, thinner as Leonardo's rule has it, at half this angle each.
fn fork(sketch: &mut Sketch, half: f64) -> f64 {
    let thin = RADIUS / 2.0_f64.sqrt();
    let axis = sketch.axis(None);
    let below = sketch.internode(axis, None, [[0.0; 3], [0.0, 0.0, 1.0]], [RADIUS; 2]);
    for way in [-1.0, 1.0] {
        let axis = sketch.axis(Some(below));
        let to = [way * sin(half), 0.0, 1.0 + cos(half)];
        sketch.internode(axis, Some(below), [[0.0, 0.0, 1.0], to], [thin; 2]);
    }
    thin
}

/// Along the trunk and the arm that goes on from it the radius never steps: on the outer side, where no other arm is,
/// it falls from that of the trunk to that of the arm over a stretch of one and a half radii of the trunk.
#[test]
fn equal_axes_meet_their_bearer_without_a_step() {
    for half in [0.3, 0.5, 0.7] {
        let mut sketch = Sketch::new();
        let thin = fork(&mut sketch, half);
        let mesh = sketch.welded(24, None);
        // The first arm continues the limb; without bark t is the length along the limb.
        let limb = [0, 1].map(|node| sketch.plant.nodes.component[node] as i32);
        let (tip, way) = (DVec3::Z, DVec3::new(-sin(half), 0.0, cos(half)));
        let outwards = DVec3::new(-cos(0.5 * half), 0.0, -sin(0.5 * half));
        let mut profile: Vec<(f64, f64)> = Vec::new();
        for vertex in mesh.vertices.iter().filter(|vertex| limb.contains(&vertex.tag().component)) {
            let at = DVec3::from_array(vertex.position().map(f64::from));
            let beside = |from: DVec3, way: DVec3| {
                let on = from + way * (at - from).dot(way).clamp(0.0, 1.0);
                (at.distance(on), (at - on).dot(outwards))
            };
            let (trunk, arm) = (beside(DVec3::ZERO, DVec3::Z), beside(tip, way));
            let (radius, out) = if trunk.0 <= arm.0 { trunk } else { arm };
            if out > 0.9 * radius {
                profile.push((f64::from(vertex.texture()[1]), radius));
            }
        }
        profile.retain(|(along, radius)| (along - 1.0).abs() < 0.2 && *radius > 0.03);
        profile.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        assert!(profile.len() > 3, "{half}: {profile:?}");
        for pair in profile.windows(2) {
            let (apart, step) = (pair[1].0 - pair[0].0, (pair[1].1 - pair[0].1).abs());
            // A third of the step that was; the ramp falls by 0.2 of its length, and a mitre is a little narrower.
            assert!(step <= 0.012 + 0.3 * apart, "{half}: {pair:?} of {profile:?}");
        }
        let wood = PI * RADIUS * RADIUS + 2.0 * PI * thin * thin;
        assert!((volume(&mesh) / wood - 1.0).abs() < 0.06, "{half}: {}", volume(&mesh) / wood);
    }
}

/// The stations of a fork have no step, and the wood along them its volume to a hundredth of what steps.
#[test]
fn evened_stations_keep_the_volume() {
    let station = |z: f64, radius: f64, node: u32| Station::new(z, DVec3::new(0.0, 0.0, z), radius, 0, NodeId(node));
    let stations = vec![
        station(0.0, 0.1, 0),
        station(1.0, 0.1, 0),
        station(1.0, 0.07, 1),
        station(2.0, 0.07, 1),
        station(2.0, 0.05, 2),
        station(2.01, 0.05, 2),
    ];
    let of = |stations: &[Station]| -> f64 {
        let part = |pair: &[Station]| {
            let [a, b] = [pair[0].radius, pair[1].radius];
            PI / 3.0 * (a * a + a * b + b * b) * (pair[1].z - pair[0].z)
        };
        stations.windows(2).map(part).sum()
    };
    let before = of(&stations);
    let (even, forks) = evened(stations.clone(), |below, above| below.node != above.node);
    assert_eq!(forks.len(), 2);
    assert!(even.windows(2).all(|pair| pair[1].z > pair[0].z), "no two rings are at one place");
    let steepest = even.windows(2).map(|pair| (pair[0].radius - pair[1].radius).abs() / (pair[1].z - pair[0].z));
    let steepest = steepest.fold(0.0, f64::max);
    // The last fork has a hundredth of a metre of room; the first falls by 0.03 over 0.15.
    assert!((even[1].z - 0.925).abs() < 1e-9 && (even[3].z - 1.075).abs() < 1e-9 && steepest < 2.3, "{even:?}");
    assert!((of(&even) / before - 1.0).abs() < 0.003, "{} {before}", of(&even));
    let (same, none) = evened(stations, |_, _| false);
    assert!(same.len() == 6 && none.is_empty());
}
