//! Close-ups: the largest leaf, flower and fruit of every species that ships, at detail 3.
//!
//! `cargo run --release --example closeups [FOLDER [NAME …]]` writes a picture of each below `closeups/` of a folder,
//! `docs` if none is given, and `closeups/index.md`, a page of all; with names those of the species named alone. An
//! organ is drawn at the age at which the largest of its kind stands, found among the ages up to one and a half times
//! that at which the species is shown. What a species does not bear is left out.

use anyhow::{Result, anyhow};
use phytomer::config::{Kind, Resolved, SPECIES_ALONE_UNTIL, presets, validate_species};
use phytomer::outputs::meshes::MeshOptions;
use phytomer::outputs::pictures::{Compression, Focus, Picture, Wanted, draw_stands, write_png};
use phytomer::run::picturing::pictured_plants;
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use phytomer::sim::plant::Class;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

const SIZE: [u32; 2] = [480, 480];
const DETAIL: u8 = 3;
const CLASSES: [(Class, &str); 3] = [(Class::Leaf, "leaf"), (Class::Flower, "flower"), (Class::Fruit, "fruit")];

fn main() -> Result<()> {
    let mut words = std::env::args().skip(1);
    let folder = words.next().unwrap_or_else(|| "docs".to_owned());
    let folder = Path::new(&folder).join("closeups");
    let asked: Vec<String> = words.collect();
    fs::create_dir_all(&folder)?;
    let mut page =
        String::from("# Close-ups\n\nThe largest leaf, flower and fruit of each species that ships, at detail 3.\n");
    page += "`cargo run --release --example closeups` makes this page.\n";
    for (name, _) in presets(Kind::Species) {
        let wanted = if asked.is_empty() { !name.contains('/') } else { asked.iter().any(|asked| asked == name) };
        if wanted {
            page += &of_species(name, &folder)?;
        }
    }
    fs::write(folder.join("index.md"), page)?;
    Ok(())
}

/// Draws the organs of a species and returns its part of the page.
fn of_species(name: &str, folder: &Path) -> Result<String> {
    let species = validate_species(name, SPECIES_ALONE_UNTIL).map_err(|report| anyhow!(report.render(false)))?;
    let called = species.species.about.common_name.clone().unwrap_or_else(|| name.to_owned());
    let shown = species.shown_at();
    let resolved = species.alone(name);
    let mut part = String::new();
    for (class, word) in CLASSES {
        if let Some(age) = age_of(&resolved, shown, class)? {
            let file = format!("{}-{word}.png", name.replace('/', "-"));
            draw(&resolved, (class, age), &folder.join(&file))?;
            println!("{name}: {word} at age {age}");
            writeln!(part, "![{name}, {word}]({file} \"{name}: {word} at age {age}\")")?;
        }
    }
    Ok(if part.is_empty() { part } else { format!("\n## {name}: {called}\n\n{part}") })
}

/// The age at which the largest organ of a class stands, up to half as old as the species is shown again.
fn age_of(resolved: &Resolved, shown: Tick, class: Class) -> Result<Option<Tick>> {
    let ages: Vec<Tick> = (1..=(shown + shown / 2 + 1).min(resolved.scenario.ages.until)).collect();
    let mut best: Option<(f32, Tick)> = None;
    Regrowth::of(resolved).show(0, &ages, &mut |age, plant| {
        if let Some(found) =
            Focus::size_of_largest(plant, age, class).filter(|size| best.is_none_or(|b| *size > 1.02 * b.0))
        {
            best = Some((found, age));
        }
        Ok(())
    })?;
    Ok(best.map(|(_, age)| age))
}

fn draw(resolved: &Resolved, (class, age): (Class, Tick), path: &Path) -> Result<()> {
    let pictured = pictured_plants(&Regrowth::of(resolved), &[&resolved.species], &[0], &[age])?;
    let stand = pictured.stands.first().and_then(|stand| stand.plants.first());
    let options = MeshOptions { detail: DETAIL, ..MeshOptions::default() };
    let focus = stand.and_then(|plant| Focus::of(plant, age, &options, Wanted::Largest(class)));
    let style = Picture { size: SIZE, detail: DETAIL, focus: focus.map(Arc::new), ..Picture::default() };
    let canvas = draw_stands(&pictured.stands(&[]), &pictured.title, &style);
    let mut file = BufWriter::new(File::create(path)?);
    Ok(write_png(&canvas, &pictured.note, Compression::High, &mut file)?)
}
