//! What plants take in memory, as the allocator counts it; nothing here knows a column.
//!
//! A component takes at most 96 bytes for topology, fates and pose together, and the peak of a population does not
//! depend on its size. The clone of a plant has no room to spare, so what it allocates is what its columns hold; the
//! plant itself also has what its vectors keep spare. Absent: the optional log of events, the memory of a mesh, and
//! what the system's allocator keeps of what was given back.

use peak_alloc::PeakAlloc;
use phytomer::config::scenario::{BYTES_A_COMPONENT, Every, Record};
use phytomer::config::validate;
use phytomer::models::buds::LivingBuds;
use phytomer::run::{self, Progress, Settings, seed_of};
use phytomer::sim::mechanics::{Scratch, bend};
use phytomer::sim::plant::{Plant, Seed};
use phytomer::sim::{Plot, Tick, grow};
use std::sync::{Mutex, PoisonError};

#[global_allocator]
static ALLOCATED: PeakAlloc = PeakAlloc;

/// One test at a time: what another allocates meanwhile would count too.
static ALONE: Mutex<()> = Mutex::new(());

/// A plant of a shipped scenario, grown to an age, shed, thickened and posed, without a log of events; its living buds,
/// and the bytes that it has allocated.
fn grown(scenario: &str, until: Option<Tick>) -> (Plant, usize, usize) {
    let resolved = validate(scenario).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let until = until.unwrap_or(resolved.scenario.ages.until);
    let before = ALLOCATED.current_usage();
    let seed = Seed { keep_events: false, ..seed_of(&resolved.scenario, 0) };
    let mut plot = Plot::of_one(resolved.model.as_ref(), &seed);
    plot.grow_to(until).expect("room to grow");
    plot.stand(until);
    let allocated = ALLOCATED.current_usage() - before;
    let living = plot.lives[0].get::<LivingBuds>().0.len();
    (plot.plants.remove(0), living, allocated)
}

/// The bytes that a plant's columns hold, without what its vectors keep spare.
fn held(plant: &Plant) -> usize {
    let before = ALLOCATED.current_usage();
    let copy = plant.clone();
    let held = ALLOCATED.current_usage() - before;
    drop(copy);
    held
}

/// Old plants, in which nearly every bud is dead, and young ones, in which most live and take memory of their own.
#[test]
fn a_component_takes_at_most_96_bytes() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    for (scenario, until) in
        [("poplar_30y", None), ("poplar_30y", Some(15)), ("poplar_5m", None), ("coffee", None), ("coffee", Some(48))]
    {
        let (plant, living, allocated) = grown(scenario, until);
        assert_eq!(plant.frames.base.len(), plant.nodes.len(), "every internode is posed");
        let components = f64::from(plant.components());
        let [held, allocated] = [held(&plant), allocated].map(|bytes| bytes as f64 / components);
        println!(
            "{scenario} at age {}: {components} components ({} axes, {} internodes, {} organs, {} living buds), \
             {held:.1} bytes each, {allocated:.1} with what vectors keep spare",
            plant.age,
            plant.axes.len(),
            plant.nodes.len(),
            plant.organs.len(),
            living
        );
        assert!(components > 500.0, "{scenario}: too small to measure");
        assert!(held <= BYTES_A_COMPONENT as f64, "{scenario}: {held:.1} bytes a component");
        assert!(allocated >= held, "{scenario}: {allocated:.1} allocated, {held:.1} held");
    }
}

/// The most bytes that a run of so many coffee plants has allocated at once, in one thread, so that no coincidence of
/// threads is measured. Parts have one size: those of a small run are smaller by themselves, and take less.
fn peak_of(plants: u32) -> usize {
    let mut resolved = validate("coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let scenario = &mut resolved.scenario;
    scenario.plants = plants;
    scenario.ages.until = 36;
    scenario.ages.record = Record::Every(Every { every: 12, from: None });
    scenario.meshes = None;
    scenario.output.plants_per_part = Some(100);
    let home = tempfile::tempdir().expect("a temporary folder");
    let settings = Settings { threads: 1, ..Settings::in_folder(home.path().join("run")) };
    let before = ALLOCATED.current_usage();
    ALLOCATED.reset_peak_usage();
    let outcome = run::run(&resolved, &settings, &Progress::default()).expect("a run");
    let peak = ALLOCATED.peak_usage() - before;
    println!("{plants} plants, {} components in {} parts: {peak} bytes", outcome.report.components, outcome.shards);
    assert_eq!(outcome.shards, plants / 100);
    peak
}

#[test]
fn the_peak_of_a_population_does_not_depend_on_its_size() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let [few, many] = [200, 2_000].map(peak_of);
    assert!(few > 1_000_000, "{few} bytes: nothing is measured");
    assert!(many as f64 <= few as f64 * 1.25, "{few} bytes for 200 plants, {many} for 2,000");
}

/// What a plant keeps of bending from tick to tick; the scratch of a tick is its worker's and does not grow with the
/// number of plants. It is told, not held.
#[test]
fn bending_keeps_at_most_24_bytes_an_internode() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let resolved = validate("willow").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let seed = Seed { keep_events: false, ..seed_of(&resolved.scenario, 0) };
    let mut plot = Plot::of_one(resolved.model.as_ref(), &seed);
    grow(&mut plot, 60, &mut ()).expect("nothing is written");
    let plant = &mut plot.plants[0];
    let (before, mut scratch) = (ALLOCATED.current_usage(), Scratch::default());
    bend(plant, 60, &plot.site, &mut scratch);
    let scratch = ALLOCATED.current_usage() - before;
    let internodes = plant.nodes.len() as f64;
    let bent = held(plant);
    plant.strain = Default::default();
    let kept = (bent - held(plant)) as f64 / internodes;
    println!("{internodes} internodes: {kept:.1} bytes each kept, {:.1} of scratch", scratch as f64 / internodes);
    assert!(kept > 0.0 && kept <= 24.0, "{kept:.1} bytes an internode");
}
