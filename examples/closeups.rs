//! Close-ups: the largest leaf, flower and fruit of every species that ships, at detail 3.
//!
//! `cargo run --release --example closeups [FOLDER [NAME …]]` writes a sheet of each species below `closeups/` of a
//! folder, `docs` if none is given, its organs side by side, and `closeups/index.md`, a page of all; with names those
//! of the species named alone. Species of a group (`wp/…`) have the forms of the library and are drawn if they are
//! named. An organ is drawn at the age at which the largest of its kind stands, up to the age at which the species is
//! shown and ten ticks more. What a species does not bear is left out, and so is a species that has the same sheet as
//! one before it, as those that state another site or another treatment.

use anyhow::{Result, anyhow};
use phytomer::config::{Kind, SPECIES_ALONE_UNTIL, presets, validate_species};
use phytomer::outputs::meshes::{MOST_DETAIL, MeshOptions};
use phytomer::outputs::pictures::{Canvas, Compression, Focus, Picture, Subject, Wanted, draw, write_png};
use phytomer::sim::plant::{Class, Plant, Seed};
use phytomer::sim::{Plot, RecordError, Recorder, Tick, grow};
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

/// The width and the height of the picture of an organ.
const SIDE: u32 = 220;
/// The ticks in which a flower opens.
const OPENS: Tick = 3;
/// The ticks after the age at which a species is shown.
const LONGER: Tick = 10;
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
    let mut drawn: Vec<Organs> = Vec::new();
    for (name, _) in presets(Kind::Species) {
        let wanted = if asked.is_empty() { !name.contains('/') } else { asked.iter().any(|asked| asked == name) };
        if !wanted {
            continue;
        }
        let (organs, called) = of_species(name)?;
        if !organs.is_empty() && drawn.iter().all(|other| !is_same(other, &organs)) {
            page += &sheet(name, &called, &organs, &folder)?;
            drawn.push(organs);
        }
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

/// Writes the pictures of the organs of a species side by side, and returns its part of the page.
fn sheet(name: &str, called: &str, organs: &Organs, folder: &Path) -> Result<String> {
    let mut all = Canvas::new(SIDE * organs.len() as u32, SIDE);
    for ((_, canvas), place) in organs.iter().zip(0..) {
        all.put(canvas, place * SIDE, 0);
    }
    let file = format!("{}-organs.png", name.replace('/', "-"));
    let mut out = BufWriter::new(File::create(folder.join(&file))?);
    let what: Vec<&str> = organs.iter().map(|(what, _)| what.as_str()).collect();
    let what = format!("{name}: {}", what.join(", "));
    write_png(&all, &what, Compression::High, &mut out)?;
    Ok(format!("\n## {name}: {called}\n\n![{name}]({file} \"{what}\")\n"))
}

/// Draws the organs of a species, and says how it is called.
fn of_species(name: &str) -> Result<(Organs, String)> {
    let found = validate_species(name, SPECIES_ALONE_UNTIL).map_err(|report| anyhow!(report.render(false)))?;
    let about = found.species.about.clone();
    let (called, latin) = (about.common_name.unwrap_or_else(|| name.to_owned()), about.scientific_name);
    let until = found.shown_at() + LONGER;
    let resolved = found.alone(name);
    let run_seed = resolved.scenario.seed;
    let seed = Seed { plant: 0, draws: 0, run_seed, component_limit: u32::MAX, keep_events: false };
    let mut largest = LargestOrgans::default();
    grow(&mut Plot::of_one(resolved.model.as_ref(), &seed), until, &mut largest).map_err(|error| anyhow!(error))?;
    let mut organs = Vec::new();
    for ((class, word), found) in CLASSES.into_iter().zip(largest.found) {
        let Some(Found { age, plant, .. }) = found else { continue };
        println!("{name}: {word} at age {age}");
        let title = latin.as_deref().unwrap_or(name);
        organs.push((format!("{word} at age {age}"), of_organ((&plant, age), class, title)));
    }
    Ok((organs, called))
}

/// The plants as they stand when the largest organ of each class stands.
#[derive(Default)]
struct LargestOrgans {
    found: [Option<Found>; CLASSES.len()],
}

/// A plant with the largest organ of a class so far, and when one of its size stood first.
struct Found {
    size: f32,
    first: Tick,
    age: Tick,
    plant: Plant,
}

impl Recorder for LargestOrgans {
    fn wants(&self, _: Tick) -> bool {
        true
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        for (best, (class, _)) in self.found.iter_mut().zip(CLASSES) {
            let Some(size) = Focus::size_of_largest(&plot.plants[0], age, class) else { continue };
            // Of organs of one size a leaf that is young, a flower that has opened, a fruit that is ripe.
            let later = match class {
                Class::Leaf => 0,
                Class::Flower => OPENS,
                _ => Tick::MAX,
            };
            let (most, first) = best.as_ref().map_or((0.0, age), |best| (best.size, best.first));
            let first = if size > 1.02 * most { age } else { first };
            if size > 1.02 * most || (size > 0.98 * most && age - first <= later) {
                *best = Some(Found { size: size.max(most), first, age, plant: plot.plants[0].clone() });
            }
        }
        Ok(())
    }
}

fn of_organ((plant, age): (&Plant, Tick), class: Class, title: &str) -> Canvas {
    let options = MeshOptions { detail: MOST_DETAIL, ..MeshOptions::default() };
    let focus = Focus::of(plant, age, &options, Wanted::Largest(class)).map(Arc::new);
    let style = Picture { size: [SIDE; 2], detail: MOST_DETAIL, focus, ..Picture::default() };
    draw(&[Subject { plant, age, label: format!("age {age}") }], title, &style)
}
