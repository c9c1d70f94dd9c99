//! Light in whole runs: the voxels of a coffee tree against exact rays on the triangles of its leaves (`rays`), these
//! against what the rasteriser draws (`silhouettes`), plots that are shifted (`shifted`), the radiation of the weather
//! (`radiation`), and scenarios with light, whose tables agree with one another on any number of threads.
//!
//! Absent: the closed forms of the light model (`sim/src/site/light`), and what buds make of light (`buds`).

#[path = "program/absent.rs"]
mod absent;
#[path = "light/radiation.rs"]
mod radiation;
#[path = "light/rays.rs"]
mod rays;
#[path = "light/shifted.rs"]
mod shifted;
#[path = "light/silhouettes.rs"]
mod silhouettes;

use arrow_array::RecordBatch;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int8Type};
use phytomer::outputs::Table;
use phytomer::run::{self, Progress, seed_of};
use phytomer_config::{Resolved, validate, validate_texts};
use phytomer_sim::site::light::{Canopy, Light, LightModel, Lighting, Lit, Projection, Sky, Standing};
use phytomer_sim::{Plot, grow};
use rays::Rays;

/// Sixteen directions: two rings of eight.
const SKY: Sky = Sky { kind: phytomer_sim::site::light::SkyKind::Uniform, rings: 2, azimuths: 8 };

/// A coffee tree of three years, standing.
fn coffee(resolved: &Resolved) -> Plot<'_> {
    let mut plot = Plot::of_one(resolved.model.as_ref(), &seed_of(&resolved.scenario, 0));
    grow(&mut plot, 36, &mut ()).expect("nothing is recorded");
    plot.stand(36);
    plot
}

/// What a coffee keeps in voxels, over what exact rays find that its leaves stop, by the size of the voxels. Leaves of
/// a real crown stand in clumps around their shoots: the larger the voxels, the more evenly they seem to be spread, and
/// the more they seem to keep. Leaves of which a beam meets none twice in a voxel that they nearly fill keep less.
#[test]
fn a_coffee_keeps_in_voxels_what_exact_rays_find() {
    let resolved = validate("coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let plot = coffee(&resolved);
    let canopy = Standing { plants: &plot.plants, ages: &[Some(36)], wood: false, feel: &[] };
    let rays = Rays::of(&plot.plants[0], 36, 0.004);
    let exact = rays.light(&canopy, &SKY.sources());
    assert!(exact.balance().kept > 0.5, "{:?}", exact.balance());
    let mut of_leaves = 0.0;
    for (projection, bounds) in [(Projection::Even(0.5), BOUNDS_EVEN), (Projection::OfLeaves, BOUNDS_OF_LEAVES)] {
        let mut smaller = 0.0;
        for (voxel_m, [low, high]) in [0.05, 0.1, 0.2, 0.4].into_iter().zip(bounds) {
            let lighting = Lighting { voxel_m, projection, ..Lighting::default() };
            let voxels = lighting.light(&canopy, &SKY.sources());
            let ratio = voxels.balance().kept / exact.balance().kept;
            println!("{projection:?}, voxels of {voxel_m} m: {ratio:.3} of the exact");
            assert!((low..high).contains(&ratio), "{projection:?}, {voxel_m} m: {ratio}");
            // 1 − e^(−x) is concave: leaves that are spread over a larger voxel, of which the smaller ones are parts,
            // keep more.
            assert!(ratio > smaller, "{projection:?}, {voxel_m} m: {ratio}, in smaller voxels {smaller}");
            smaller = ratio;
            // No leaf keeps more than all that it meets.
            if projection == Projection::Even(0.5) {
                let open: f64 = SKY.sources().iter().map(|source| source.weight / source.towards[2]).sum();
                let met = 0.5 * open * plot.leaf_area(36);
                assert!(voxels.balance().kept < met, "{voxel_m} m: {met}");
            } else if voxel_m == 0.1 {
                of_leaves = ratio;
            }
            let mut kept = 0.0;
            canopy.pieces(0, voxel_m / 2.0, &mut |piece| kept += voxels.kept_by(&piece));
            assert!((kept / voxels.balance().kept - 1.0).abs() < 1e-3, "its leaves keep all that is kept: {kept}");
        }
    }
    // The light inside of the crown, the mean over places all through it. Along the axis alone the eight azimuths of
    // the sky would run between the branches, which stand in four.
    let step = |k: i32| 0.17 * f64::from(k) + 0.05;
    let planes = (-3..=3).flat_map(|x| (-3..=3).map(move |y| [step(x), step(y)]));
    let places: Vec<[f64; 3]> = planes.flat_map(|[x, y]| (1..10).map(move |k| [x, y, 0.19 * f64::from(k)])).collect();
    let mean = |lit: &dyn Lit| places.iter().map(|place| lit.share_at(*place)).sum::<f64>() / places.len() as f64;
    let lighting = Lighting { projection: Projection::OfLeaves, ..Lighting::default() };
    let fields: [Box<dyn Lit>; 2] = [exact, lighting.light(&canopy, &SKY.sources())];
    let [exact, voxels] = [mean(&*fields[0]), mean(&*fields[1])];
    // Between the places light differs by chance, and over them all by what voxels keep too much or too little.
    let off = |place: &[f64; 3]| fields[0].share_at(*place) - fields[1].share_at(*place);
    let squared = |x: f64| x * x;
    let spread = places.iter().map(|place| squared(off(place) - (exact - voxels))).sum::<f64>();
    let error = (spread / places.len() as f64 / (places.len() - 1) as f64).sqrt();
    let bias = (of_leaves - 1.0).abs() * (1.0 - exact);
    println!("light in the crown: {voxels:.3} in voxels, {exact:.3} by rays, ± {error:.4} and a bias of {bias:.4}");
    assert!((voxels - exact).abs() < (4.0 * error + bias).min(0.05), "{voxels} {exact} {error} {bias}");
}

/// What was found, and as much to either side as beams an edge apart may be off: four times √(.0724 B a³ / 16) / A, of
/// sixteen directions with the outline B ≈ 6 m and the area A ≈ 0.8 m² of the crown, is .009 in voxels of 0.05 m, .026
/// in those of 0.1 m, then .074 and .2. In the last two the bounds are narrower.
const BOUNDS_EVEN: [[f64; 2]; 4] = [[0.957, 0.975], [1.017, 1.069], [1.07, 1.18], [1.27, 1.42]];
const BOUNDS_OF_LEAVES: [[f64; 2]; 4] = [[0.93, 0.948], [0.992, 1.044], [1.05, 1.15], [1.26, 1.42]];

/// Four coffee trees a metre apart and one far away, in light.
fn stand(more: &str) -> Resolved {
    let text = format!(
        "name = \"stand\"\nspecies = \"coffee\"\nplants = 10\nseed = 5\nspacing_m = 60\n\
         member = [{{}}, {{ at_m = [1, 0] }}, {{ at_m = [0, 1] }}, {{ at_m = [1, 1] }}, {{ at_m = [30, 0] }}]\n\
         ages = {{ until = 26, record = [13, 26] }}\n{more}"
    );
    validate_texts("stand", &[("stand", &text)]).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn tables(resolved: &Resolved, threads: usize) -> [Vec<RecordBatch>; 3] {
    let run = run::in_memory(resolved, threads, &Progress::default()).expect("the run ends");
    [Table::Summary, Table::Site, Table::Records].map(|table| run.batches[&table].clone())
}

fn doubles(batches: &[RecordBatch], name: &str) -> Vec<f64> {
    let column =
        |batch: &RecordBatch| batch.column_by_name(name).expect("the column").as_primitive::<Float64Type>().clone();
    batches
        .iter()
        .flat_map(|batch| column(batch).iter().map(|value| value.unwrap_or(f64::NAN)).collect::<Vec<_>>())
        .collect()
}

#[test]
fn the_columns_of_light_agree() {
    let lit = stand("[light]\nvoxel_m = 0.1\n[output]\nlight = true\n");
    let [summary, site, records] = tables(&lit, 1);
    for threads in [2, 3, 8] {
        assert!(tables(&lit, threads) == [summary.clone(), site.clone(), records.clone()], "{threads} threads");
    }
    let [competition, kept] = ["light_competition", "intercepted_light_m2"].map(|name| doubles(&summary, name));
    assert_eq!(kept.len(), 2 * 2 * 5);
    let of_member =
        |member: usize, values: &[f64]| -> Vec<f64> { values.iter().skip(member).step_by(5).copied().collect() };
    for member in 0..5 {
        let shares = of_member(member, &competition);
        let last = [shares[1], shares[3]];
        match member {
            // 29 m away no beam of 5 × 8 directions that meets it has met another: the lowest, at 2.7°, come from 22.5°
            // aside, 12 m beside the others.
            4 => assert!(last.iter().all(|share| (share - 1.0).abs() < 1e-9), "far from all others: {last:?}"),
            _ => assert!(last.iter().all(|share| (0.3..0.995).contains(share)), "among neighbours: {last:?}"),
        }
    }
    let ground = doubles(&site, "ground_light");
    assert!(ground.iter().all(|share| (0.2..1.0).contains(share)) && ground[1] < ground[0], "{ground:?}");
    // 60 × 60 m of ground are shared by the plants of a plot.
    let (index, leaf_area) = (doubles(&site, "leaf_area_index"), doubles(&summary, "leaf_area_m2"));
    let of_last: f64 = leaf_area.chunks(5).skip(1).step_by(2).map(|of_plot| of_plot.iter().sum::<f64>()).sum();
    assert!((index[1] / (of_last / 7_200.0) - 1.0).abs() < 1e-5, "{index:?} {of_last}");
    for batch in &records {
        let light = batch.column_by_name("light").expect("light").as_primitive::<Float32Type>();
        let kinds = batch.column_by_name("kind").expect("kind").as_dictionary::<Int8Type>();
        let words = kinds.values().as_string::<i32>();
        for row in 0..batch.num_rows() {
            let told = ["leaf", "apical_bud"].contains(&words.value(kinds.keys().value(row) as usize));
            assert_eq!(told, arrow_array::Array::is_valid(light, row));
            assert!(!told || (0.0..=1.0).contains(&light.value(row)));
        }
    }
}

/// Light that is felt changes the stand; where nobody asks, and without `[light]`, rows are as ever.
#[test]
fn light_changes_only_what_answers_it() {
    let without = |resolved: &Resolved| tables(resolved, 2)[0].clone();
    let open = without(&stand(""));
    assert!(open != without(&stand("[light]\nvoxel_m = 0.2\n")), "a coffee among others loses buds");
    let bare = |more: &str| stand(more).scenario;
    assert!(bare("").light.is_none());
    let far = |more: &str| {
        let text = format!(
            "name = \"far\"\nspecies = \"example1\"\nplants = 4\nages = {{ until = 9 }}\nmember = [{{}}, {{ at_m = [1, 0] }}]\n{more}"
        );
        let resolved =
            validate_texts("far", &[("far", &text)]).unwrap_or_else(|report| panic!("{}", report.render(false)));
        run::in_memory(&resolved, 2, &Progress::default()).expect("the run ends").batches[&Table::Components].clone()
    };
    assert!(far("") == far("[light]\n"), "example1 has no law of light");
}

/// A plot grown with light tick by tick has what the light of its site tells, and a lone plant shades itself.
#[test]
fn a_lone_tree_shades_itself() {
    let resolved = validate("coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let mut plot = Plot::of_one(resolved.model.as_ref(), &seed_of(&resolved.scenario, 0));
    plot.site.light = Some(Light::of(Lighting::default()));
    plot.ask_light();
    grow(&mut plot, 30, &mut ()).expect("nothing is recorded");
    let shade: Vec<u32> = (0..plot.plants[0].axes.len())
        .map(|axis| plot.plants[0].shade.of(phytomer_sim::plant::AxisId(axis as u32)))
        .collect();
    let [lightest, darkest] = [shade.iter().min(), shade.iter().max()].map(|of| of.copied().unwrap_or_default());
    assert!((5..35).contains(&lightest) && (60..95).contains(&darkest), "{shade:?}");
}
