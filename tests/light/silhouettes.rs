//! What a coffee keeps from sixteen directions: its silhouettes as the rasteriser of pictures draws them, against the
//! exact rays on the same leaves.
//!
//! Leaves that let nothing pass keep of a beam what they cover. Both count a lattice of points, so each is off by its
//! own standard error, √(.0724 B a³) with the outline B and the mesh a (`phytomer_pictures::silhouette`). The bounds
//! are four errors of the difference.

use crate::rays::{Rays, leaves};
use crate::{SKY, coffee};
use phytomer_config::validate;
use phytomer_outputs::pictures::silhouette::silhouette;

/// How far rays, and the samples of the rasteriser, are apart, metres.
const APART: [f64; 2] = [0.004, 0.0023];

#[test]
fn rays_find_what_the_rasteriser_draws() {
    let resolved = validate("coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let plot = coffee(&resolved);
    let (rays, mesh) = (Rays::of(&plot.plants[0], 36, APART[0]), leaves(&plot.plants[0], 36));
    let (mut by_rays, mut drawn, mut variance) = (0.0, 0.0, 0.0);
    for source in SKY.sources() {
        let seen = silhouette(&mesh, source.towards, APART[1] as f32).expect("it fits");
        let [area, outline, error] = [seen.area_m2, seen.outline_m, seen.error_m2].map(f64::from);
        let shadow = rays.shadow(&source);
        let both = (error * error + 0.0724 * outline * APART[0] * APART[0] * APART[0]).sqrt();
        assert!((shadow - area).abs() <= 4.0 * both, "{source:?}: {shadow} by rays, {area} drawn, ± {both}");
        assert!(4.0 * both < 0.02 * area, "the bound tells something: {both} of {area}");
        let on_ground = source.weight / source.towards[2];
        by_rays += on_ground * shadow;
        drawn += on_ground * area;
        variance += on_ground * on_ground * both * both;
    }
    let error = variance.sqrt();
    println!("kept: {by_rays:.4} m² by rays, {drawn:.4} m² as drawn, ± {error:.4}");
    assert!((by_rays - drawn).abs() <= 4.0 * error, "{by_rays} {drawn} {error}");
}
