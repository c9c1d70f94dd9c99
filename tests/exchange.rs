//! Plants in the files of other programs: what is grown goes out and comes back the same, another reader finds in it
//! what the tables of a run have, and bad files are refused with all that is wrong.
//!
//! Absent: each rule of a format, which is tested beside it (`outputs/src/exchange`).

mod program;
mod trips;

use phytomer::outputs::exchange::{Description, InMemory, Value};
use program::run;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::tempdir;
use trips::{near, plant_of, read, species, written};

/// The plant of an MTG file.
fn of_file(file: &Path) -> Description {
    read(&InMemory { main: fs::read(file).unwrap(), ..InMemory::default() }, "mtg")
}

/// What an MTG keeps: the lines of both in the order of the file have the same topology, ranks and ages, and places and
/// sizes to a millionth of a metre.
fn same(name: &str, one: &Description, other: &Description) {
    let (one, other) = (&one.individuals[0], &other.individuals[0]);
    assert_eq!(one.entities.len(), other.entities.len(), "{name}");
    assert_eq!(one.age, other.age, "{name}");
    // Entities come back in the order of the file; their numbers tell which is which.
    let number = |entity: &phytomer::outputs::exchange::Entity| {
        entity.latest().and_then(|seen| match seen.values.first() {
            Some((_, Value::Int(number))) => Some(*number),
            _ => None,
        })
    };
    let mut place_of = std::collections::BTreeMap::new();
    for (place, entity) in other.entities.iter().enumerate() {
        number(entity).into_iter().for_each(|number| _ = place_of.insert(number, place as u32));
    }
    let of = |place: u32, in_other: bool| {
        let entities = if in_other { &other.entities } else { &one.entities };
        let entity = &entities[place as usize];
        (entity.class, number(entity), entity.index)
    };
    for (place, entity) in one.entities.iter().enumerate() {
        let Some(number) = number(entity) else { continue };
        let back = &other.entities[place_of[&number] as usize];
        let told = format!("{name}: entity {place}, number {number}");
        let ages = |entity: &phytomer::outputs::exchange::Entity| {
            (entity.birth, entity.death, entity.dead, entity.index, entity.link)
        };
        assert_eq!(ages(entity), ages(back), "{told}");
        let (bearer, complex) = (entity.bearer.map(|at| of(at, false)), entity.complex.map(|at| of(at, false)));
        assert_eq!(bearer, back.bearer.map(|at| of(at, true)), "{told}: bearer");
        assert_eq!(complex, back.complex.map(|at| of(at, true)), "{told}: complex");
        let (seen, again) = (entity.latest().unwrap(), back.latest().unwrap());
        near(&told, seen, again);
        assert_eq!(seen.values, again.values, "{told}");
    }
}

#[test]
fn a_plant_comes_back_from_an_mtg_as_it_was() {
    for name in species() {
        let plant = plant_of(name);
        assert!(plant.entities() > 10, "{name}");
        let (file, _) = written(&plant, "mtg");
        let back = read(&file, "mtg");
        same(name, &plant, &back);
        assert!(written(&back, "mtg").0 == file, "{name}: a second trip gives other bytes");
    }
}

/// A run of one coffee tree of 48 ticks, without rounding, in the folder `grown`.
fn young(folder: &Path) {
    let scenario = "name = \"young\"\nspecies = \"coffee\"\nplants = 1\nages = { until = 48, record = [24, 48] }\n";
    fs::write(folder.join("young.toml"), scenario).unwrap();
    run(folder, &["grow", "young.toml", "--quiet", "--out", "grown"]).ending(0);
}

#[test]
fn a_description_has_the_rows_of_the_run() {
    let folder = tempdir().unwrap();
    young(folder.path());
    let recorded = phytomer::outputs::read::Run::open(&folder.path().join("grown")).unwrap();
    let columns = ["age", "component_id", "kind", "parent_id", "rank", "birth_age", "x_m", "z_m", "length_m"];
    let rows = phytomer::outputs::cells::of_run(&recorded, phytomer::outputs::Table::Records, &columns).unwrap();
    let (names, rows) = rows;
    let at = |name: &str| names.iter().position(|known| known == name).unwrap();
    let last: u32 = rows.iter().map(|row| row[at("age")].parse().unwrap()).max().unwrap();
    let said = run(folder.path(), &["convert", "grown", "coffee.mtg", "--age", &last.to_string()]).ending(0).stdout;
    assert!(said.contains("1 plant"), "{said}");
    let plant = of_file(&folder.path().join("coffee.mtg"));
    let individual = &plant.individuals[0];
    assert_eq!(individual.age, Some(last));
    let mut entities = std::collections::BTreeMap::new();
    for (place, entity) in individual.entities.iter().enumerate() {
        let Some((_, Value::Int(number))) = entity.latest().and_then(|seen| seen.values.first()) else { continue };
        if plant.class_of(entity).scale == 4 {
            entities.insert(*number, place as u32);
        }
    }
    let is_row = |row: &&Vec<String>| row[at("age")] == last.to_string() && row[at("kind")] != "apical_bud";
    let rows: Vec<_> = rows.iter().filter(is_row).collect();
    assert_eq!(rows.len(), entities.len());
    for row in rows {
        let number: i64 = row[at("component_id")].parse().unwrap();
        let place = entities[&number];
        let entity = &individual.entities[place as usize];
        let seen = entity.latest().unwrap();
        let cell = |name: &str| row[at(name)].parse::<f64>().unwrap();
        assert_eq!(entity.birth, row[at("birth_age")].parse().ok(), "{row:?}");
        assert!(
            (seen.place.unwrap()[0] - cell("x_m")).abs() < 1e-6 && (seen.place.unwrap()[2] - cell("z_m")).abs() < 1e-6
        );
        assert!((seen.length.unwrap() - cell("length_m")).abs() < 1e-6, "{row:?}");
        // What springs from an internode in the tables springs from it here.
        let bearer = individual.bearer_of(place).map(|(bearer, _)| &individual.entities[bearer as usize]);
        let bearer = bearer.and_then(|bearer| bearer.latest()?.values.first().cloned()).map(|(_, value)| value);
        assert_eq!(bearer, row[at("parent_id")].parse().ok().map(Value::Int), "{row:?}");
        if row[at("kind")].ends_with("internode") {
            assert_eq!(entity.index, Some(cell("rank")), "{row:?}");
        }
    }
}

/// Python with the independent readers; `None` where it is not there.
fn python() -> Option<std::path::PathBuf> {
    let python = Path::new(env!("CARGO_MANIFEST_DIR")).join(".venv/bin/python");
    if python.exists() {
        return Some(python);
    }
    assert!(std::env::var_os("CI").is_none(), "{} is missing", python.display());
    eprintln!("skipped: no {}", python.display());
    None
}

#[test]
fn another_reader_of_mtg_finds_what_was_written() {
    let Some(python) = python() else { return };
    let folder = tempdir().unwrap();
    for name in ["coffee", "bamboo", "oil_palm", "halle/leeuwenberg"] {
        let plant = plant_of(name);
        let file = folder.path().join("plant.mtg");
        fs::write(&file, written(&plant, "mtg").0.main).unwrap();
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers/mtg.py");
        let done = Command::new(&python).arg(script).arg(&file).output().expect("python runs");
        assert!(done.status.success(), "{name}: {}", String::from_utf8_lossy(&done.stderr));
        let told = String::from_utf8(done.stdout).unwrap();
        let told: Vec<serde_json::Value> = told.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        let back = of_file(&file);
        let entities = &back.individuals[0].entities;
        assert_eq!(told.len(), entities.len(), "{name}");
        for (line, entity) in told.iter().zip(entities) {
            assert_eq!(line["class"], back.class_of(entity).symbol.as_str(), "{name}");
            assert_eq!(line["index"].as_f64(), entity.index, "{name}");
            assert_eq!(line["bearer"].as_u64(), entity.bearer.map(u64::from), "{name}: {line}");
            assert_eq!(line["complex"].as_u64(), entity.complex.map(u64::from), "{name}: {line}");
            let number = |name: &str| line["values"][name].as_str().and_then(|text| text.parse::<f64>().ok());
            let seen = entity.latest();
            assert_eq!(number("Length"), seen.and_then(|seen| seen.length), "{name}: {line}");
            assert_eq!(number("ZZ"), seen.and_then(|seen| seen.place).map(|place| place[2]), "{name}: {line}");
            assert_eq!(number("birth"), entity.birth.map(f64::from), "{name}: {line}");
        }
    }
}

#[test]
fn bad_files_are_refused_with_all_that_is_wrong() {
    let folder = tempdir().unwrap();
    let head = "CODE:\tFORM-A\nCLASSES:\nP\t1\nA\t2\nDESCRIPTION:\nFEATURES:\nMTG:\nENTITY-CODE\n";
    fs::write(folder.path().join("bad.mtg"), format!("{head}/P1\n^/Q1\n^/A1<<A999999999\n")).unwrap();
    let said = run(folder.path(), &["convert", "bad.mtg", "out.mtg"]).ending(3);
    for words in ["bad.mtg:10:3: no class `Q` is declared", "one of the classes P, A", "1 fault; nothing is written"] {
        assert!(said.stderr.contains(words), "{words} is missing in {}", said.stderr);
    }
    assert!(!folder.path().join("out.mtg").exists());
    let json = run(folder.path(), &["convert", "bad.mtg", "out.mtg", "--json"]).ending(3).json();
    assert_eq!((json["status"].as_str(), json["faults"][0]["line"].as_u64()), (Some("invalid"), Some(10)));
    fs::write(folder.path().join("good.mtg"), format!("{head}/P1/A1<<A3\n")).unwrap();
    let json = run(folder.path(), &["convert", "good.mtg", "out.mtg", "--json"]).ending(0).json();
    assert_eq!((json["plants"].as_u64(), json["entities"].as_u64()), (Some(1), Some(4)));
    for (words, told) in [
        (
            vec!["convert", "good.mtg", "out.mtg", "--age", "3"],
            "--plant, --plot and --age are for plants that are grown",
        ),
        (vec!["convert", "good.mtg", "out.xyz"], "a species file ends in .toml"),
        (vec!["convert", "coffee", "out.mtg", "--age", "100000"], "the run has the ages"),
    ] {
        let said = run(folder.path(), &words).ending(2).stderr;
        assert!(said.contains(told), "{told} is missing in {said}");
    }
}

/// Class, rank and bearer of the components of the first plant of a run, in the order of lines of text.
fn topology(folder: &Path, stands: bool) -> Vec<String> {
    let run = phytomer::outputs::read::Run::open(folder).unwrap();
    let columns =
        ["plant_id", "component_id", "kind", "order", "rank", "growth_unit", "parent_id", "birth_age", "shed_age"];
    let (names, rows) = phytomer::outputs::cells::of_run(&run, phytomer::outputs::Table::Components, &columns).unwrap();
    let at = |name: &str| names.iter().position(|known| known == name).unwrap();
    let of: std::collections::BTreeMap<&str, &Vec<String>> = rows
        .iter()
        .filter(|row| row[at("plant_id")] == "0")
        .map(|row| (row[at("component_id")].as_str(), row))
        .collect();
    let told = |row: &Vec<String>| {
        let bearer = of.get(row[at("parent_id")].as_str());
        let bearer = bearer.map_or(String::new(), |row| format!("{} {}", row[at("order")], row[at("rank")]));
        let name = |name: &str| row[at(name)].as_str();
        format!(
            "{} {} {} {} {} on {bearer}",
            name("kind"),
            name("order"),
            name("rank"),
            name("growth_unit"),
            name("birth_age")
        )
    };
    let is_wood_or_organ =
        |row: &&&Vec<String>| row[at("kind")] != "apical_bud" && (!stands || row[at("shed_age")].is_empty());
    let mut lines: Vec<String> = of.values().filter(is_wood_or_organ).map(|row| told(row)).collect();
    lines.sort();
    lines
}

#[test]
fn a_plant_that_comes_in_has_the_rows_of_the_one_that_went_out() {
    let folder = tempdir().unwrap();
    young(folder.path());
    let until = phytomer::outputs::read::Run::open(&folder.path().join("grown")).unwrap().json()["until"].to_string();
    run(folder.path(), &["convert", "grown", "coffee.mtg", "--age", &until]).ending(0);
    run(folder.path(), &["convert", "coffee.mtg", "measured"]).ending(0);
    let (grown, measured) =
        (topology(&folder.path().join("grown"), true), topology(&folder.path().join("measured"), false));
    assert!(grown.len() > 1000);
    assert_eq!(grown, measured);
    let told = run(folder.path(), &["describe", "measured", "--json"]).ending(0).json();
    assert_eq!((told["measured"]["plants"].as_u64(), told["ages"][0]["age"].to_string()), (Some(1), until));
    assert_eq!(told["measured"]["sha256"].as_str().map(str::len), Some(64));
    assert!(told["architectural_models"].is_array());
    run(folder.path(), &["describe", "measured"]).ending(0);
    let law = |name: &str| {
        let words = ["fit", name, "--law", "crown", "--order", "1", "--json"];
        let said = run(folder.path(), &words);
        (said.code, said.stdout)
    };
    assert_eq!(law("grown").0, law("measured").0);
    run(folder.path(), &["picture", "measured", "--out", "measured.png", "--size", "300x300"]).ending(0);
    assert!(fs::metadata(folder.path().join("measured.png")).unwrap().len() > 5000);
    run(folder.path(), &["mesh", "measured", "--out", "measured.ply"]).ending(0);
    let said = run(folder.path(), &["animate", "measured", "--out", "measured.webp"]).ending(2).stderr;
    assert!(said.contains("its plants were measured (coffee.mtg)"), "{said}");
    let again = run(folder.path(), &["convert", "coffee.mtg", "measured"]);
    assert_ne!(again.code, Some(0), "a run is not replaced");
}

#[test]
fn a_plant_without_places_is_told_and_not_drawn() {
    let folder = tempdir().unwrap();
    let text = "CODE:\tFORM-A\nCLASSES:\nP\t1\nA\t2\nS\t3\nFEATURES:\nDate\tDD/MM/YY\nMTG:\nENTITY-CODE\t\tDate\n/P1/A1/S1<<S3\t\t01/02/2003\n*\t\t03/02/2003\n";
    fs::write(folder.path().join("bare.mtg"), text).unwrap();
    let said = run(folder.path(), &["convert", "bare.mtg", "bare"]).ending(0).stdout;
    assert!(said.contains("places, which the file does not tell, of plants (1)"), "{said}");
    let said = run(folder.path(), &["picture", "bare", "--out", "bare.png"]).ending(2).stderr;
    assert!(said.contains("plant 0 of bare has no places"), "{said}");
    let told = run(folder.path(), &["describe", "bare"]).ending(0).stdout;
    for words in ["2003-02-01, 2003-02-03; ages are days since the first", "cannot be drawn: 1 plant", "SHA-256"] {
        assert!(told.contains(words), "{words} is missing in {told}");
    }
}
