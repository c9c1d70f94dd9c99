//! Meshes have the areas and volumes of the tables: over every shipped species the triangles of each kind of organ have
//! the area of its `area_m2`, and the tubes of internodes hold their `wood_volume_m3`, to 1 %.
//!
//! The areas are those of one side: of closed forms half the surface. Tables and meshes are read from the files of one
//! run. Absent: blades and internodes of other forms, which are drawn as sheets without volume.

#[path = "program/side_by_side.rs"]
mod side_by_side;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Int8Type, Int32Type};
use arrow_array::{Array, RecordBatch};
use phytomer::run::{Progress, Settings, run, seed_of};
use phytomer_config::scenario::{MeshAges, MeshFile, MeshPlants, Meshes, Record, Table};
use phytomer_config::{Kind, Resolved, presets, validate};
use phytomer_outputs::read::Run;
use phytomer_sim::{Ending, Plot, Tick, grow};
use phytomer_triangles as triangles;
use side_by_side::each;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Larger plants are measured at an earlier age, at which they have at most so many components.
const MOST_COMPONENTS: u32 = 6_000;

/// The values that the table states of a component.
struct Stated {
    kind: String,
    area: Option<f64>,
    volume: Option<f64>,
}

/// The one plant of a species, grown to an age at which it is not too large.
fn plant_of(name: &str) -> Resolved {
    let mut resolved = validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let last = resolved.species.about.shown_at.unwrap_or(resolved.scenario.ages.until);
    let ages = [1.0, 0.6, 0.35, 0.2, 0.12, 0.07].map(|share| (f64::from(last) * share).max(2.0) as Tick);
    let grows = |until: &Tick| {
        let model = resolved.species.model.compile(*until).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
        let mut seed = seed_of(&resolved.scenario, 0);
        seed.component_limit = MOST_COMPONENTS;
        let mut plot = Plot::of_one(model.as_ref(), &seed);
        let grown = grow(&mut plot, *until, &mut ());
        matches!(grown, Ok(Ending::Complete)).then_some((*until, model))
    };
    let (until, model) = ages.iter().find_map(grows).unwrap_or_else(|| panic!("{name} is too large at any age"));
    resolved.model = model;
    let scenario = &mut resolved.scenario;
    scenario.plants = 1;
    scenario.ages.until = until;
    scenario.ages.record = Record::List(BTreeSet::from([until]));
    scenario.tables = [Table::Records].into_iter().collect();
    let (ages, plants, per) = (MeshAges::default(), MeshPlants::default(), MeshFile::default());
    scenario.meshes = Some(Meshes { ages, plants, sides: 8, per });
    scenario.output.mechanics = true;
    resolved
}

fn stated(run: &Run) -> BTreeMap<i32, Stated> {
    let batches = run.batches(phytomer_outputs::Table::Records).expect("records");
    batches.map(|batch| batch.expect("rows")).flat_map(|batch| rows(&batch)).collect()
}

fn rows(batch: &RecordBatch) -> Vec<(i32, Stated)> {
    let column = |name: &str| batch.column_by_name(name).unwrap_or_else(|| panic!("no column {name}"));
    let kinds = column("kind").as_dictionary::<Int8Type>();
    let words = kinds.values().as_string::<i32>();
    let components = column("component_id").as_primitive::<Int32Type>();
    let number = |name: &str, row: usize| {
        let numbers = column(name).as_primitive::<Float32Type>();
        numbers.is_valid(row).then(|| f64::from(numbers.value(row)))
    };
    let row = |row: usize| {
        let kind = words.value(kinds.keys().value(row) as usize).to_owned();
        let (area, volume) = (number("area_m2", row), number("wood_volume_m3", row));
        (components.value(row), Stated { kind, area, volume })
    };
    (0..batch.num_rows()).map(row).collect()
}

/// The drawn and the stated measures, by kind of component.
#[derive(Default)]
struct Sums {
    areas: BTreeMap<String, [f64; 2]>,
    volumes: BTreeMap<String, [f64; 2]>,
}

fn sums(folder: &Path) -> Sums {
    let run = Run::open(folder).expect("a run");
    let meshes: Vec<_> =
        fs::read_dir(folder.join("meshes")).expect("meshes").map(|file| file.expect("a file").path()).collect();
    let drawn = triangles::of_components(&fs::read(&meshes[0]).expect("a mesh"));
    let mut sums = Sums::default();
    let add = |to: &mut BTreeMap<String, [f64; 2]>, kind: &str, found: f64, stated: f64| {
        let [sum, of_table] = to.entry(kind.to_owned()).or_default();
        *sum += found;
        *of_table += stated;
    };
    for (component, stated) in &stated(&run) {
        let of_one = drawn.get(component).map_or(&[][..], Vec::as_slice);
        let closed = triangles::is_closed(of_one);
        if let Some(area) = stated.area {
            let one_side = if closed { 0.5 } else { 1.0 } * triangles::area(of_one);
            add(&mut sums.areas, &stated.kind, one_side, area);
        }
        if let Some(of_table) = stated.volume.filter(|_| closed && !of_one.is_empty()) {
            add(&mut sums.volumes, &stated.kind, triangles::volume(of_one), of_table);
        }
    }
    sums
}

#[test]
fn meshes_of_every_shipped_species_have_the_areas_and_the_volumes_of_the_tables() {
    let home = tempfile::tempdir().expect("a folder");
    let species: Vec<&str> = presets(Kind::Species).iter().map(|(name, _)| *name).collect();
    let measured = each(species, |name| {
        let folder = home.path().join(name.replace('/', "-"));
        run(&plant_of(name), &Settings::in_folder(&folder), &Progress::default())
            .unwrap_or_else(|error| panic!("{name}: {error:#}"));
        (name, sums(&folder))
    });
    let mut wrong = Vec::new();
    let mut kinds = BTreeSet::new();
    for (name, Sums { areas, volumes }) in measured {
        // Of the first L-system of Synthetic Topiary nothing is drawn: its modules are buds.
        assert!(!volumes.is_empty() || name == "topiary/1", "{name} has no wood");
        for (what, (kind, [drawn, stated])) in
            areas.iter().map(|of| ("area", of)).chain(volumes.iter().map(|of| ("volume", of)))
        {
            let ratio = drawn / stated;
            println!("{name}: {what} of {kind}: {ratio:.4} of {stated:.3e}");
            kinds.insert((what, kind.clone()));
            if (ratio - 1.0).abs() > 0.01 {
                wrong.push(format!("{name}: {what} of {kind}: {ratio:.4}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(kinds.contains(&("area", "leaf".to_owned())) && kinds.contains(&("volume", "internode".to_owned())));
}
