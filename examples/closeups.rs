//! Close-ups: the largest leaf, flower and fruit of every species that ships, at detail 3.
//!
//! `cargo run --release --example closeups [FOLDER [NAME …]]` writes a sheet of each species below `closeups/` of a
//! folder, `docs` if none is given, its organs side by side, one sheet of each group (`wp`, `abop` …), a row for each
//! species that bears organs, and `closeups/index.md`, a page of all; with names the sheets of the species named alone.
//! An organ is drawn at the age at which the largest of its kind stands, found among the ages up to one and a half
//! times that at which the species is shown. What a species does not bear is left out, and so is a species that has the
//! same sheet as one before it, as those that state another site or another treatment.

use anyhow::{Result, anyhow};
use phytomer::config::{Kind, Resolved, SPECIES_ALONE_UNTIL, presets, validate_species};
use phytomer::outputs::meshes::MeshOptions;
use phytomer::outputs::pictures::{Canvas, Compression, Focus, Picture, Wanted, draw_stands, write_png};
use phytomer::run::picturing::pictured_plants;
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use phytomer::sim::plant::Class;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

/// The width and the height of the picture of an organ.
const SIDE: u32 = 300;
/// The same in the sheet of a group.
const SMALL: u32 = 200;
/// The pictures in a row of the sheet of a group.
const ROW: u32 = 6;
const DETAIL: u8 = 3;
const CLASSES: [(Class, &str); 3] = [(Class::Leaf, "leaf"), (Class::Flower, "flower"), (Class::Fruit, "fruit")];

/// The organs of a species: what each is, and its picture.
type Organs = Vec<(String, Canvas)>;

fn main() -> Result<()> {
    let mut words = std::env::args().skip(1);
    let folder = words.next().unwrap_or_else(|| "docs".to_owned());
    let folder = Path::new(&folder).join("closeups");
    let asked: Vec<String> = words.collect();
    fs::create_dir_all(&folder)?;
    let mut page = String::from(
        "# Close-ups\n\nThe largest leaf, flower and fruit of each species that ships, at detail 3 \
         ([closeups.md](../closeups.md)).\n`cargo run --release --example closeups` makes this page.\n",
    );
    let mut groups: BTreeMap<&str, Organs> = BTreeMap::new();
    let mut drawn: Vec<Organs> = Vec::new();
    for (name, _) in presets(Kind::Species) {
        if !asked.is_empty() && !asked.iter().any(|asked| asked == name) {
            continue;
        }
        let group = name.split_once('/').map(|(group, _)| group);
        let (organs, title) = of_species(name, if group.is_some() { SMALL } else { SIDE })?;
        let is_new = drawn.iter().all(|other| !is_same(other, &organs));
        match group {
            _ if organs.is_empty() || !is_new => continue,
            Some(group) => groups.entry(group).or_default().extend(organs.clone()),
            None => page += &sheet((name, &title), &organs, organs.len() as u32, &folder)?,
        }
        drawn.push(organs);
    }
    for (group, organs) in &groups {
        page += &sheet((group, "a group"), organs, ROW, &folder)?;
    }
    Ok(fs::write(folder.join("index.md"), page)?)
}

/// Whether two species have the same organs in the same pictures, but for the text below them.
fn is_same(one: &Organs, other: &Organs) -> bool {
    let shown = |organs: &Organs| -> Vec<Vec<[u8; 4]>> {
        organs.iter().map(|(_, canvas)| canvas.pixels[..canvas.pixels.len() * 4 / 5].to_vec()).collect()
    };
    shown(one) == shown(other)
}

/// Writes the pictures of organs as one sheet of so many columns, and returns its part of the page.
fn sheet((name, title): (&str, &str), organs: &Organs, columns: u32, folder: &Path) -> Result<String> {
    let side = organs[0].1.width;
    let rows = (organs.len() as u32).div_ceil(columns);
    let mut all = Canvas::new(side * columns.min(organs.len() as u32), side * rows);
    all.pixels.fill([255; 4]);
    for ((_, canvas), place) in organs.iter().zip(0..) {
        all.put(canvas, place % columns * side, place / columns * side);
    }
    let file = format!("{name}.png");
    let mut out = BufWriter::new(File::create(folder.join(&file))?);
    let what: Vec<&str> = organs.iter().map(|(what, _)| what.as_str()).collect();
    write_png(&all, &what.join(", "), Compression::High, &mut out)?;
    let mut part = format!("\n## {name}: {title}\n\n");
    writeln!(part, "![{name}]({file} \"{}\")", what.join(", "))?;
    Ok(part)
}

/// Draws the organs of a species, and says how it is called.
fn of_species(name: &str, side: u32) -> Result<(Organs, String)> {
    let species = validate_species(name, SPECIES_ALONE_UNTIL).map_err(|report| anyhow!(report.render(false)))?;
    let called = species.species.about.common_name.clone().unwrap_or_else(|| name.to_owned());
    let shown = species.shown_at();
    let resolved = species.alone(name);
    let mut organs = Vec::new();
    for ((class, word), age) in CLASSES.into_iter().zip(ages_of(&resolved, shown)?) {
        if let Some(age) = age {
            println!("{name}: {word} at age {age}");
            organs.push((format!("{name}: {word} at age {age}"), draw(&resolved, (class, age), side)?));
        }
    }
    Ok((organs, called))
}

/// The ages at which the largest organs of the classes stand, up to half as old as the species is shown again.
fn ages_of(resolved: &Resolved, shown: Tick) -> Result<[Option<Tick>; CLASSES.len()]> {
    let ages: Vec<Tick> = (1..=(shown + shown / 2 + 1).min(resolved.scenario.ages.until)).collect();
    let mut best: [Option<(f32, Tick)>; CLASSES.len()] = [None; CLASSES.len()];
    Regrowth::of(resolved).show(0, &ages, &mut |age, plant| {
        for (best, (class, _)) in best.iter_mut().zip(CLASSES) {
            let found = Focus::size_of_largest(plant, age, class);
            if let Some(found) = found.filter(|size| best.is_none_or(|best| *size > 1.02 * best.0)) {
                *best = Some((found, age));
            }
        }
        Ok(())
    })?;
    Ok(best.map(|best| best.map(|(_, age)| age)))
}

fn draw(resolved: &Resolved, (class, age): (Class, Tick), side: u32) -> Result<Canvas> {
    let pictured = pictured_plants(&Regrowth::of(resolved), &[&resolved.species], &[0], &[age])?;
    let stand = pictured.stands.first().and_then(|stand| stand.plants.first());
    let options = MeshOptions { detail: DETAIL, ..MeshOptions::default() };
    let focus = stand.and_then(|plant| Focus::of(plant, age, &options, Wanted::Largest(class)));
    let style = Picture { size: [side, side], detail: DETAIL, focus: focus.map(Arc::new), ..Picture::default() };
    Ok(draw_stands(&pictured.stands(&[]), &pictured.title, &style))
}
