//! The bits of draws, which no version of a crate, no platform and no change of ours may move.
//!
//! A run that was made before must be made again with the same bytes. Where these bits change, all draws of sites have,
//! and the change belongs into CHANGELOG.md. That the bits are right and not only the same, `distributions.rs` shows.

use phytomer_draws::{Aggregation, Clusters, Draws, Event, Key};

#[test]
fn the_bits_of_draws() {
    let key =
        Key { seed: 1988, replicate: 2, plot: 5, event: Event::named("pest", "berry borer"), plant: 23, season: 4 };
    let mut draws = Draws::of(&key);
    let mut found = vec![draws.uniform()];
    for (a, b) in [(1.8, 7.2), (0.5, 0.5), (0.9, 3.0)] {
        found.extend((0..2).map(|_| draws.beta(a, b).expect("shapes within range")));
    }
    for shape in [0.4, 1.0, 3.7] {
        found.extend((0..2).map(|_| draws.gamma(shape, 1.5).expect("a shape within range")));
    }
    for mean in [3.0, 12.5, 400.0, 1e7] {
        found.extend((0..2).map(|_| draws.poisson(mean).expect("a mean within range") as f64));
    }
    found.extend((0..2).map(|_| draws.normal(1.0, 0.2).expect("parameters within range")));
    found.push(Aggregation::new(0.2, 0.1).and_then(|of| of.susceptibility(&mut draws)).expect("a susceptibility"));
    let clusters = Clusters::new(0.05, 1.0).expect("clusters");
    found.push(clusters.pressure(&key, [3.0, -8.0]).expect("a pressure"));
    let bits: Vec<u64> = found.iter().map(|x| x.to_bits()).collect();
    assert_eq!(bits, BITS, "{found:?}");
}

const BITS: [u64; 25] = [
    0x3f9a_29ae_1143_03e0,
    0x3fc4_8d56_5a09_042b,
    0x3fc9_f160_9dad_35fb,
    0x3f0d_e183_b96b_4a72,
    0x3fdd_08ed_d4c9_eed5,
    0x3f76_39bc_fa5e_91c3,
    0x3fd0_74e7_5c7e_aed9,
    0x3fb7_1243_6ae5_28b8,
    0x3f66_e017_49e6_2522,
    0x3ff0_2a19_3b0f_3037,
    0x4006_5100_7458_2419,
    0x4016_98c8_d22c_21f4,
    0x4013_418b_1724_fe7b,
    0x4008_0000_0000_0000,
    0x3ff0_0000_0000_0000,
    0x4022_0000_0000_0000,
    0x4020_0000_0000_0000,
    0x4076_d000_0000_0000,
    0x407a_1000_0000_0000,
    0x4163_1361_c000_0000,
    0x4163_1288_8000_0000,
    0x3fee_4987_896b_9388,
    0x3ff0_ae31_9bf1_77cb,
    0x3fce_e23b_568d_fb52,
    0x3fc1_3d75_9685_cd5e,
];
