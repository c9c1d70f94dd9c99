//! The light in a stand: a direction through its voxels, beside one plain pass over them, which asks of each voxel
//! alone what it keeps of a beam.
//!
//! The stand is 25 crowns of leaves, 650,000 voxels in bricks, of which 411,000 have leaves. With `PHYTOMER_PAIRS=3`,
//! `cargo bench --bench light -- ratios` tells what light costs whole stands: a tick of a hundred poplars, ten thousand
//! coffee trees to four years, and the same stand by one thread and by two. `cargo bench --bench light -- obstacles`
//! tells what obstacles and stems cost such a tick of poplars in light; `PHYTOMER_TREES` of them, 100 if not stated.
//! Absent: runs with tables.

#[path = "specimen/met.rs"]
mod met;
#[path = "specimen/turns.rs"]
mod turns;

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use met::{Met, blocks, solid};
use phytomer::config::{Resolved, validate};
use phytomer::run::seed_of;
use phytomer::sim::math::{cos, exp, sin};
use phytomer::sim::shape::{Mesh, Point, Shape};
use phytomer::sim::site::light::grid::{Grid, UNITS};
use phytomer::sim::site::light::{Field, Light, Lighting, Piece, Sky};
use phytomer::sim::site::stems::Whose;
use phytomer::sim::{Plot, Sowing, Tick, grow};
use std::cell::RefCell;
use std::f64::consts::{PI, TAU};
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};
use turns::by_turns;

/// 25 crowns of 2 m radius, 3.4 m apart, with 3 m² of leaves in each m³, in voxels of 0.125 m.
fn stand() -> (Lighting, Grid) {
    let lighting = Lighting { voxel_m: 0.125, ..Lighting::default() };
    let mut grid = Grid::of(&lighting);
    let edge = 36;
    for crown in 0..25 {
        let middle = [f64::from(crown % 5) * 3.4, f64::from(crown / 5) * 3.4, 4.0];
        for k in 0..edge * edge * edge {
            let at = [k % edge, k / edge % edge, k / edge / edge].map(|k| f64::from(k) * 4.0 / f64::from(edge) - 1.95);
            if at.iter().map(|x| x * x).sum::<f64>() <= 4.0 {
                let place = [0, 1, 2].map(|k| middle[k] + at[k]);
                let area = 3.0 * (64.0 / f64::from(edge * edge * edge));
                grid.add(&Piece { place, normal: [0.0, 0.0, 1.0], area });
            }
        }
    }
    grid.sort();
    (lighting, grid)
}

fn light(criterion: &mut Criterion) {
    let (lighting, grid) = stand();
    let sources = Sky::default().sources();
    let voxels = grid.area.len() as u64;
    let mut group = criterion.benchmark_group(format!("light/{voxels} voxels, {} of them with leaves", filled(&grid)));
    group.sample_size(10).sampling_mode(SamplingMode::Flat).measurement_time(Duration::from_secs(3));
    group.throughput(Throughput::Elements(voxels));
    let g = 0.5 / UNITS / grid.volume() * lighting.voxel_m;
    group.bench_function("one plain pass (baseline)", |bencher| {
        bencher.iter(|| {
            let kept: Vec<f64> = grid.area.iter().map(|units| 1.0 - exp(-g * *units as f64)).collect();
            black_box(kept)
        });
    });
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    group.throughput(Throughput::Elements(voxels * sources.len() as u64));
    group.bench_function("40 directions, one thread", |bencher| {
        bencher.iter(|| one.install(|| black_box(Field::in_grid(&lighting, grid.clone(), &sources))));
    });
    group.finish();
}

/// So many trees of a species in rows, in light if voxels are stated.
fn sown(resolved: &Resolved, (trees, apart): (u32, f64), voxel_m: Option<f64>) -> Plot<'_> {
    let wide = f64::from(trees).sqrt().ceil() as u32;
    let sowing = |tree: u32| {
        let place = [f64::from(tree % wide) * apart, f64::from(tree / wide) * apart, 0.0];
        Sowing { species: 0, seed: seed_of(&resolved.scenario, tree), place, sown: 0 }
    };
    let mut plot = Plot::new(0, vec![resolved.model.as_ref()], &(0..trees).map(sowing).collect::<Vec<_>>());
    plot.site.light = voxel_m.map(|voxel_m| Light::of(Lighting { voxel_m, ..Lighting::default() }));
    plot.ask_light();
    plot
}

fn grown(mut plot: Plot<'_>, until: Tick) -> Plot<'_> {
    grow(&mut plot, until, &mut ()).expect("nothing is recorded");
    plot.stand(until);
    plot
}

fn components(plot: &Plot) -> u64 {
    plot.plants.iter().map(|plant| u64::from(plant.components())).sum()
}

fn species(name: &str) -> Resolved {
    validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn stated(name: &str) -> Option<u32> {
    std::env::var(name).ok()?.parse().ok()
}

/// Whether the words behind `--` name no bench, or this one.
fn is_asked(name: &str) -> bool {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    words.is_empty() || words.iter().any(|word| word == name)
}

/// The ratios of whole stands, where `PHYTOMER_PAIRS` states how often; `PHYTOMER_TREES` coffee trees, 10,000 if not
/// stated.
fn ratios(_: &mut Criterion) {
    let Some(pairs) = stated("PHYTOMER_PAIRS").map(|pairs| pairs as usize).filter(|_| is_asked("ratios")) else {
        return;
    };
    a_pass(pairs);
    a_tick_of_poplars(pairs);
    coffee_trees(pairs, stated("PHYTOMER_TREES").unwrap_or(10_000));
    threads();
}

/// A direction against a plain pass.
fn a_pass(pairs: usize) {
    let (lighting, grid) = stand();
    let sources = Sky::default().sources();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let g = 0.5 / UNITS / grid.volume() * lighting.voxel_m;
    let passes = || {
        for _ in 0..sources.len() {
            black_box(grid.area.iter().map(|units| 1.0 - exp(-g * *units as f64)).collect::<Vec<f64>>());
        }
    };
    let light = || {
        one.install(|| black_box(Field::in_grid(&lighting, grid.clone(), &sources)));
    };
    by_turns("light: a direction over a plain pass (aim: 25)", pairs, || (), light, passes);
    let bytes = 24 * grid.area.len();
    println!(
        "light: {} voxels in bricks, {} with leaves, {bytes} bytes of area and light",
        grid.area.len(),
        filled(&grid)
    );
}

/// The tick at which a poplar comes to 10⁵ components.
fn tick_of_large_poplars(poplar: &Resolved) -> Tick {
    let large_at = |tick: &Tick| components(&grown(sown(poplar, (1, 4.0), None), *tick)) >= 100_000;
    (5..60).find(large_at).expect("a poplar of 100,000 components")
}

/// The last tick of a hundred poplars of 10⁵ components, in voxels of 0.5 m, with its light and without.
fn a_tick_of_poplars(pairs: usize) {
    let poplar = species("poplar");
    let until = tick_of_large_poplars(&poplar);
    let before = grown(sown(&poplar, (100, 4.0), Some(0.5)), until - 1);
    let plot: RefCell<Plot> = RefCell::new(before.clone());
    let tick = |lit: bool| {
        let mut plot = plot.borrow_mut();
        if !lit {
            plot.site.light = None;
        }
        plot.site.begin(until);
        plot.grow_to(until).expect("room to grow");
        plot.stand(until);
    };
    let name = format!("light: tick {until} of 100 poplars with light over the same without (aim: 1 / .7 = 1.43)");
    by_turns(&name, pairs, || _ = plot.replace(before.clone()), || tick(true), || tick(false));
    println!("light: those poplars have {} components", components(&plot.borrow()));
}

/// What obstacles take of the last tick of a hundred poplars of 10⁵ components in light, in voxels of 0.5 m.
fn obstacles(_: &mut Criterion) {
    let Some(pairs) = stated("PHYTOMER_PAIRS").map(|pairs| pairs as usize).filter(|_| is_asked("obstacles")) else {
        return;
    };
    let (poplar, trees) = (species("poplar"), stated("PHYTOMER_TREES").unwrap_or(100));
    let until = tick_of_large_poplars(&poplar);
    let stand = |met: &Met| {
        let mut plot = sown(&poplar, (trees, 4.0), Some(0.5));
        met.lie_on(&mut plot);
        grown(plot, until - 1)
    };
    let open = stand(&Met::default());
    let plots: RefCell<[Plot; 2]> = RefCell::new([open.clone(), open.clone()]);
    let tick = |side: usize| {
        let plot = &mut plots.borrow_mut()[side];
        plot.site.begin(until);
        plot.grow_to(until).expect("room to grow");
        plot.stand(until);
    };
    for (name, met) in cases() {
        let among = stand(&met);
        // A plot that grows owns its stems; one that is copied would copy them again as it follows them.
        let before = || {
            let mut both = [among.clone(), open.clone()];
            both.iter_mut().filter_map(|plot| plot.site.stems.as_mut()).for_each(|stems| _ = Arc::make_mut(stems));
            plots.replace(both);
        };
        let name =
            format!("obstacles: tick {until} of {trees} poplars in light, {name}, over the open (aim: 1 / .75 = 1.33)");
        by_turns(&name, pairs, before, || tick(0), || tick(1));
        let [among, open] = &*plots.borrow();
        println!("  {} components, {} in the open", components(among), components(open));
    }
}

/// What the poplars meet, 4 m apart: all of it stands among them.
fn cases() -> [(&'static str, Met); 5] {
    let ground = Met { ground: Some(0.0), ..Met::default() };
    let between = |k: u32| {
        let aside = [2.0, 0.0][k as usize / 100];
        blocks([f64::from(k % 10) * 4.0 + 1.6, f64::from(k / 10 % 10) * 4.0 - 0.4 + aside, 0.0], [0.8, 0.8, 2.0])
    };
    let house = |row: u32| blocks([-2.0, f64::from(row) * 4.0 + 1.2, 0.0], [40.0, 1.6, 6.0]);
    let globes = [[6.0, 6.0, 1.5], [14.0, 14.0, 1.5], [22.0, 22.0, 1.5]].map(|middle| solid(globe(middle)));
    let stems = |stems| Met { stems, ..Met::default() };
    [
        ("on solid ground with 200 boxes", Met { obstacles: (0..200).map(between).collect(), ..ground.clone() }),
        ("between rows of houses", Met { obstacles: (0..10).map(house).collect(), ..ground.clone() }),
        ("with three meshes of 1,984 triangles", Met { obstacles: globes.into(), ..ground }),
        ("and the stems of neighbours", stems(Whose::Neighbours)),
        ("and all stems", stems(Whose::All)),
    ]
}

/// A closed mesh about a ball of 1.2 m radius.
fn globe(middle: Point) -> Shape {
    let (rings, around) = (32, 32_u32);
    let at = |ring: u32, k: u32| {
        let (down, turn) = (PI * f64::from(ring) / f64::from(rings), TAU * f64::from(k) / f64::from(around));
        let [level, high] = [sin(down), cos(down)].map(|of| 1.2 * of);
        [middle[0] + level * cos(turn), middle[1] + level * sin(turn), middle[2] + high]
    };
    let mut points = vec![at(0, 0), at(rings, 0)];
    points.extend((1..rings).flat_map(|ring| (0..around).map(move |k| (ring, k))).map(|(ring, k)| at(ring, k)));
    let place = |ring: u32, k: u32| match ring {
        0 => 0,
        ring if ring == rings => 1,
        ring => 2 + (ring - 1) * around + k % around,
    };
    let mut faces = Vec::new();
    for (ring, k) in (0..rings).flat_map(|ring| (0..around).map(move |k| (ring, k))) {
        let [a, b, c, d] = [(ring, k), (ring + 1, k), (ring + 1, k + 1), (ring, k + 1)].map(|(ring, k)| place(ring, k));
        faces.extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && a != c));
    }
    Shape::Mesh(Arc::new(Mesh::of(&points, &faces).expect("a closed mesh")))
}

/// Coffee trees 2.5 m apart to four years.
fn coffee_trees(pairs: usize, trees: u32) {
    let coffee = species("coffee");
    for voxel_m in [0.5, 0.25] {
        let lit = || {
            black_box(grown(sown(&coffee, (trees, 2.5), Some(voxel_m)), 48));
        };
        let open = || {
            black_box(grown(sown(&coffee, (trees, 2.5), None), 48));
        };
        let name =
            format!("light: {trees} coffee trees to 48 months in voxels of {voxel_m} m over those without (aim: 10)");
        by_turns(&name, pairs, || (), lit, open);
    }
}

/// A thousand coffee trees in light by one thread over two; by the clock, so on a machine that does nothing else.
fn threads() {
    let coffee = species("coffee");
    let time = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let start = Instant::now();
        pool.install(|| black_box(grown(sown(&coffee, (1_000, 2.5), Some(0.25)), 48)));
        start.elapsed().as_secs_f64()
    };
    let [one, two] = [1, 2].map(|threads| (0..3).map(|_| time(threads)).fold(f64::INFINITY, f64::min));
    println!("light: 1,000 coffee trees in light, one thread over two by the clock: {:.2} x (aim: 1.8)", one / two);
}

fn filled(grid: &Grid) -> usize {
    grid.area.iter().filter(|units| **units > 0).count()
}

criterion_group!(benches, light, ratios, obstacles);
criterion_main!(benches);
