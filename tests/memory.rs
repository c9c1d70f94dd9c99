//! The memory of plants, as the allocator counts it; nothing here depends on the columns.
//!
//! A component takes at most 96 bytes for topology, fates and pose together, and the peak of a population does not
//! depend on its size. A pass over a tick of a plot takes the memory of its largest plant. A film of a life, and a file
//! of it, take at most half as much again as one picture. A measure of a run takes the memory of a part and of what it
//! keeps of plants. The clone of a plant has no spare capacity, so its allocation
//! is the size of its columns; the plant itself also has the spare capacity of its vectors. Absent: the optional log of
//! events, the memory of a mesh, and freed memory that the system's allocator keeps.

use peak_alloc::PeakAlloc;
use phytomer::analysis::measure::{Asked as Measuring, MEASURES, measure};
use phytomer::config::scenario::{BYTES_A_COMPONENT, Every, Record};
use phytomer::config::{Resolved, validate};
use phytomer::models::buds::LivingBuds;
use phytomer::outputs::films::{Film, Timeline, WebP};
use phytomer::outputs::life::{Maker, Nearness};
use phytomer::outputs::meshes::MeshOptions;
use phytomer::outputs::pictures::{Picture, draw_stands};
use phytomer::outputs::usd::{Asked, Encoding, Member, Organs, Pace, Plants, write_life};
use phytomer::outputs::{Destination, Mode, RunFolder, Table};
use phytomer::run::filming::{Filming, Scene};
use phytomer::run::picturing::pictured_plants;
use phytomer::run::regrowth::{Regrowth, Whose};
use phytomer::run::{self, Outcome, Program, Progress, Settings, plan_of, seed_of};
use phytomer::sim::mechanics::{Scratch, bend};
use phytomer::sim::plant::{Plant, Seed};
use phytomer::sim::{Plot, Recorder, Sowing, Tick, grow};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

#[global_allocator]
static ALLOCATED: PeakAlloc = PeakAlloc;

/// Only one test at a time allocates: the allocations of another test would count too.
static ALONE: Mutex<()> = Mutex::new(());

/// A plant of a shipped scenario, grown to an age, shed, thickened and posed, without a log of events; its living buds,
/// and the number of bytes that it has allocated.
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

/// The bytes of a plant's columns, without the spare capacity of its vectors.
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

/// A run of coffee plants. Parts have one size, since the smaller parts of a small run would take less.
fn coffee(plants: u32) -> Resolved {
    let mut resolved = validate("coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let scenario = &mut resolved.scenario;
    scenario.plants = plants;
    scenario.ages.until = 36;
    scenario.ages.record = Record::Every(Every { every: 12, from: None });
    scenario.meshes = None;
    scenario.output.plants_per_part = Some(100);
    resolved
}

/// The most bytes that a run of `plants` coffee plants has allocated at once, in one thread, so that no coincidence of
/// threads is measured.
fn peak_of(plants: u32) -> usize {
    let (outcome, peak) = run_alone(&coffee(plants));
    println!("{plants} plants, {} components in {} parts: {peak} bytes", outcome.report.components, outcome.shards);
    assert_eq!(outcome.shards, plants / 100);
    peak
}

/// What came of a run by one thread, and its peak of memory above what was allocated before, bytes.
fn run_alone(resolved: &Resolved) -> (Outcome, usize) {
    let home = tempfile::tempdir().expect("a temporary folder");
    let settings = Settings { threads: 1, ..Settings::in_folder(home.path().join("run")) };
    let before = ALLOCATED.current_usage();
    ALLOCATED.reset_peak_usage();
    let outcome = run::run(resolved, &settings, &Progress::default()).expect("a run");
    (outcome, ALLOCATED.peak_usage() - before)
}

/// As [`peak_of`], of the shipped million of coffee trees: their sample is of two hundred, whatever their number.
fn peak_of_million(plants: u32) -> usize {
    let mut resolved = validate("million_coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    resolved.scenario.plants = plants;
    resolved.scenario.output.plants_per_part = Some(250);
    let (outcome, peak) = run_alone(&resolved);
    println!("{plants} plants, {} components, a sample of 200: {peak} bytes", outcome.report.components);
    peak
}

/// The plants that are not in the sample cost no rows, and their number no memory.
#[test]
fn the_peak_of_a_population_with_a_sample_does_not_depend_on_its_size() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let [few, many] = [1_000, 10_000].map(peak_of_million);
    assert!(few > 100_000, "{few} bytes: nothing is measured");
    assert!(many as f64 <= few as f64 * 1.25, "{few} bytes for 1,000 plants, {many} for 10,000");
    assert!(many < 256_000_000, "{many} bytes");
}

#[test]
fn the_peak_of_a_population_does_not_depend_on_its_size() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let [few, many] = [200, 2_000].map(peak_of);
    assert!(few > 1_000_000, "{few} bytes: nothing is measured");
    assert!(many as f64 <= few as f64 * 1.25, "{few} bytes for 200 plants, {many} for 2,000");
}

/// The most bytes that each measure of a run of coffee plants allocates, and the rows of its records and components.
fn peaks_of_measures(plants: u32) -> (Vec<usize>, u64) {
    let home = tempfile::tempdir().expect("a temporary folder");
    let folder = home.path().join("run");
    let settings = Settings { threads: 2, ..Settings::in_folder(folder.clone()) };
    let outcome = run::run(&coffee(plants), &settings, &Progress::default()).expect("a run");
    let asked = Measuring { difference: Some(0.1), by: None, ..Measuring::default() };
    let peak = |card| peak_while(|| drop(measure(&[&folder], card, &asked).expect("a finished run")));
    // The threads of the run give back what they keep for their plants when they end, which is a little later than the
    // run: memory that is given back during a measure would be taken off what it allocates.
    peak(&MEASURES[0]);
    (MEASURES.iter().map(peak).collect(), outcome.report.components)
}

/// What measures keep of a plant, at most: its row of `plants`, and a few numbers.
const OF_A_PLANT: usize = 256;

/// Ten times the plants, and ten times the rows.
#[test]
fn the_memory_of_measures_does_not_grow_with_the_run() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let [(few, components), (many, more)] = [100, 1_000].map(peaks_of_measures);
    assert!(more > 9 * components && components > 50_000, "{components} components and {more}");
    for (card, (few, many)) in MEASURES.iter().zip(few.into_iter().zip(many)) {
        println!("{}: {few} bytes of 100 plants, {many} of 1,000", card.name);
        assert!(few > 100_000, "{}: {few} bytes: nothing is measured", card.name);
        let most = few as f64 * 1.25 + (900 * OF_A_PLANT) as f64;
        assert!(many as f64 <= most, "{}: {few} bytes of 100 plants, {many} of 1,000", card.name);
        // All rows of one column of four bytes would be more than that.
        assert!(most < 4.0 * more as f64 + few as f64, "{}: the bound tells nothing", card.name);
    }
}

/// The most bytes that a table allocates for its pass over the last tick of a plot of these coffee plants, and the
/// number of components of the largest plant. The table is the summary: it keeps only a few numbers of its rows.
fn pass_over(plants: Range<u32>) -> (usize, u32) {
    const UNTIL: Tick = 48;
    let resolved = validate("coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let mut plan = plan_of(&resolved, &Program::default()).expect("a plan");
    (plan.tables, plan.recorded, plan.until, plan.plots) = (vec![Table::Summary], vec![UNTIL], UNTIL, 1);
    let home = tempfile::tempdir().expect("a temporary folder");
    let folder = RunFolder::create(&home.path().join("run"), plan, Mode::New).expect("a run folder");
    let mut shard = folder.shard(0).expect("a shard");
    let seed = |plant| Seed { keep_events: false, ..seed_of(&resolved.scenario, plant) };
    let sowings: Vec<Sowing> =
        plants.map(|plant| Sowing { species: 0, seed: seed(plant), place: [0.0; 3], sown: 0 }).collect();
    let mut plot = Plot::new(0, vec![resolved.model.as_ref()], &sowings);
    plot.grow_to(UNTIL).expect("room to grow");
    plot.stand(UNTIL);
    let before = ALLOCATED.current_usage();
    ALLOCATED.reset_peak_usage();
    shard.record(UNTIL, &plot).expect("a tick that is written");
    let peak = ALLOCATED.peak_usage() - before;
    (peak, plot.plants.iter().map(Plant::components).max().unwrap_or_default())
}

/// A plot of fifty plants against each of them as a plot of its own. The rows of the summary count too.
#[test]
fn a_pass_over_a_plot_takes_the_memory_of_its_largest_plant() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    const PLANTS: u32 = 50;
    const A_ROW: usize = 256;
    let alone = (0..PLANTS).map(|plant| pass_over(plant..plant + 1).0).max().expect("plants");
    let (together, largest) = pass_over(0..PLANTS);
    println!("{PLANTS} plants, the largest of {largest} components: {together} bytes, at most {alone} for one alone");
    // An index has three numbers a component.
    assert!(alone > 12 * largest as usize, "{alone} bytes: nothing is measured");
    let most = 2 * alone + PLANTS as usize * A_ROW;
    assert!(together <= most, "{together} bytes for {PLANTS} plants, {alone} for one");
}

/// The memory that a plant keeps for bending from tick to tick; the scratch of a tick belongs to a worker and does not
/// grow with the number of plants. The number is printed and not asserted.
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

/// The size of pictures, and the last age of the willow that they show.
const SIZE: [u32; 2] = [1280, 720];
const LAST: Tick = 92;

/// What some work allocates at most above what was allocated before, bytes.
fn peak_while(work: impl FnOnce()) -> usize {
    let before = ALLOCATED.current_usage();
    ALLOCATED.reset_peak_usage();
    work();
    ALLOCATED.peak_usage() - before
}

/// A picture of the willow at its last age, grown for it.
fn picture_of(resolved: &Resolved) -> usize {
    peak_while(|| {
        let species = resolved.all_species();
        let pictured = pictured_plants(&Regrowth::of(resolved), &species, &[0], &[LAST]).expect("a plant");
        draw_stands(&pictured.stands(&[]), "", &Picture { size: SIZE, ..Picture::default() });
    })
}

/// A film of its whole life, with a picture of every thirteenth age.
fn film_of(resolved: &Resolved) -> usize {
    let (regrowth, species) = (Regrowth::of(resolved), resolved.all_species());
    let time = Timeline { first: 1.0, last: f64::from(LAST), step: 13.0, frames: 8 };
    let scene = Scene {
        regrowth: &regrowth,
        species: &species,
        forms: &[],
        whose: Whose::Plant(0),
        style: Picture { size: SIZE, ..Picture::default() },
        time,
        every_tick: true,
        fps: 24,
        orbit: 0.0,
        follow: false,
        air_from: None,
    };
    let film = Film { size: SIZE, fps: 24, frames: 8, pictures: scene.pictures(), note: String::new() };
    peak_while(|| {
        let surveyed = scene.survey(false, &Filming::default()).expect("a plant");
        let mut encoder = WebP::new(&film, 80, Vec::new()).expect("memory takes it");
        let shot = scene.shoot(&surveyed, &Filming::default(), &mut encoder).expect("memory takes it");
        assert_eq!((scene.pictures(), shot.frames), (8, 8));
    })
}

/// Its life at every age as binary USD.
fn usd_of(resolved: &Resolved) -> usize {
    let home = tempfile::tempdir().expect("a temporary folder");
    let ages: Vec<Tick> = (1..=LAST).collect();
    peak_while(|| {
        let mut maker = Maker::new(Nearness::of(1e-3), &MeshOptions::default());
        let shown = Regrowth::of(resolved).show(0, &ages, &mut |age, plant| {
            maker.show(plant, age);
            Ok(())
        });
        shown.expect("a plant");
        let (lives, options, members) = ([maker.finish()], [MeshOptions::default()], [Member::default()]);
        let asked = Asked {
            encoding: Encoding::Binary,
            organs: Organs::Instances,
            words: String::new(),
            pictures: Default::default(),
        };
        let (plants, pace) = (Plants::of(&lives, &options, &members), Pace { a_tick: 1.0, a_second: 24.0 });
        let mut file = Destination::create(&home.path().join("life.usdc")).expect("a file");
        write_life(&asked, &plants, 1e-3, &pace, &mut file).expect("room on the disk");
    })
}

#[test]
fn a_film_and_a_file_of_a_life_take_at_most_half_more_than_a_picture() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let resolved = validate("willow").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let [picture, film, usd] = [picture_of(&resolved), film_of(&resolved), usd_of(&resolved)];
    println!("{picture} bytes for a picture, {film} for a film, {usd} for a life as USD");
    assert!(picture > 20_000_000, "{picture} bytes: nothing is measured");
    for (what, peak) in [("a film", film), ("a life as USD", usd)] {
        assert!(peak as f64 <= 1.5 * picture as f64, "{peak} bytes for {what}, {picture} for a picture");
    }
}
