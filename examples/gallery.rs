//! The gallery: every species that ships, drawn in its prime, every plot that ships, and the life of a tree as a strip.
//!
//! `cargo run --release --example gallery [FOLDER]` writes `gallery.md`, its pictures below `gallery/` and `life.png`
//! into a folder, `docs` if none is given. A species is grown by the shipped scenario of its name if there is one, else
//! by itself, and drawn at the age that `phytomer picture` chooses; a scenario with members is drawn as
//! `phytomer picture --plot` draws it. This file lists no names: every shipped species and plot is drawn.

use anyhow::{Context, Result, anyhow};
use phytomer::config::{
    Kind, Resolved, SPECIES_ALONE_UNTIL, Scenario, Species, Trial, presets, validate, validate_species,
};
use phytomer::outputs::pictures::{Canvas, Compression, Picture, draw_stands, write_png};
use phytomer::run::picturing::{Pictured, pictured_plants, pictured_plot};
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::{GrowthModel, Tick};
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

/// The size of a picture of the gallery, and of the strip.
const SIZE: [u32; 2] = [360, 480];
const STRIP: [u32; 2] = [1600, 460];
/// The size of a picture of a plot.
const PLOT_SIZE: [u32; 2] = [960, 640];
/// The species and the ages, in months, of the strip: robusta coffee.
const LIFE_OF: &str = "coffee";
const LIFE: [Tick; 9] = [4, 9, 16, 26, 40, 56, 76, 96, 106];

struct Sitter {
    scenario: Scenario,
    species: Species,
    model: Arc<dyn GrowthModel>,
}

fn main() -> Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "docs".to_owned());
    let folder = Path::new(&folder);
    let mut page = String::from(
        "# Gallery\n\nEvery species that ships but `topiary/1`, which draws no line, drawn by `phytomer picture` at the age that it states, or else in its prime:\nthe last \
         year with nine tenths of the largest leaf area that it ever bears, as soon as it bears it. `cargo run --release --example gallery` makes this page. Each can be seen to grow: `phytomer animate NAME --out film.webp` makes a film ([films.md](films.md)).\n",
    );
    let of = |name: &'static str| name.rsplit_once('/').map_or("", |(group, _)| group);
    // Of the first L-system of Synthetic Topiary there are buds alone.
    let mut names: Vec<&str> =
        presets(Kind::Species).iter().map(|(name, _)| *name).filter(|name| *name != "topiary/1").collect();
    names.sort_by_key(|name| of(name));
    let mut group = None;
    for name in names {
        let of = of(name);
        if group != Some(of) {
            group = Some(of);
            write!(page, "\n## {}\n\n", if of.is_empty() { "Plants and examples" } else { of })?;
        }
        page += &sit(name, folder).with_context(|| format!("the species {name}"))?;
    }
    page += "\n## Plots\n\nEvery scenario that ships with several members, drawn by `phytomer picture --plot` at its last tick.\n\n";
    for (name, _) in presets(Kind::Scenario) {
        page += &plot(name, folder).with_context(|| format!("the scenario {name}"))?;
    }
    fs::write(folder.join("gallery.md"), page)?;
    strip(&folder.join("life.png"))
}

/// Draws one species and returns its caption.
fn sit(name: &str, folder: &Path) -> Result<String> {
    let sitter = Sitter::of(name)?;
    let regrowth = sitter.regrowth();
    let age = regrowth.shown_at(&sitter.species, 0)?;
    // A plant among obstacles is drawn with them.
    let pictured = if sitter.scenario.site.drawn().is_empty() {
        pictured_plants(&regrowth, &[&sitter.species], &[0], &[age])?
    } else {
        pictured_plot(&regrowth, &[&sitter.species], (0, &[age]), false)?
    };
    let file = format!("gallery/{name}.png");
    let canvas = drawn(&pictured, SIZE);
    save(&canvas, &pictured.note, &folder.join(&file))?;
    println!("{name}: age {age}");
    let about = &sitter.species.about;
    let called = about.common_name.as_deref().unwrap_or(&about.name);
    let latin = about.scientific_name.as_ref().map(|latin| format!(", *{latin}*")).unwrap_or_default();
    let model = about.architectural_model.map(|model| format!(", {model:?}'s model")).unwrap_or_default();
    Ok(format!("![{called}]({file} \"{name}: {called}{latin}{model}, age {age}\")\n"))
}

/// Draws the first plot of a scenario, if it has several members, and returns its caption.
fn plot(name: &str, folder: &Path) -> Result<String> {
    let found = validate(name).map_err(|report| anyhow!(report.render(false)))?;
    if found.scenario.member.is_empty() {
        return Ok(String::new());
    }
    let (tick, species) = (found.scenario.ages.until, found.all_species());
    let pictured = pictured_plot(&Regrowth::of(&found), &species, (0, &[tick]), false)?;
    let file = format!("gallery/plots/{name}.png");
    save(&drawn(&pictured, PLOT_SIZE), &pictured.note, &folder.join(&file))?;
    println!("{name}: tick {tick}");
    let about = found.scenario.description.as_deref().unwrap_or_default();
    let about = about.split_whitespace().collect::<Vec<_>>().join(" ").replace('"', "'");
    Ok(format!("![{name}]({file} \"{name}: {about}\")\n"))
}

impl Sitter {
    fn of(name: &str) -> Result<Self> {
        if presets(Kind::Scenario).iter().any(|(scenario, _)| *scenario == name) {
            let found = validate(name).map_err(|report| anyhow!(report.render(false)))?;
            return Ok(Self { scenario: found.scenario, species: found.species, model: found.model });
        }
        let found = validate_species(name, SPECIES_ALONE_UNTIL).map_err(|report| anyhow!(report.render(false)))?;
        let until = found.shown_at();
        let Resolved { scenario, species, .. } = found.alone(name);
        let model = species.model.compile(until).map_err(|faults| anyhow!("{faults:?}"))?;
        Ok(Self { scenario, species, model })
    }

    fn regrowth(&self) -> Regrowth<'_> {
        Regrowth::new(Trial::of(&self.scenario, &[]), vec![self.model.as_ref()], None)
    }
}

/// One tree from a seedling to its death.
fn strip(path: &Path) -> Result<()> {
    let sitter = Sitter::of(LIFE_OF)?;
    let mut pictured = pictured_plants(&sitter.regrowth(), &[&sitter.species], &[0], &LIFE)?;
    pictured.stands.iter_mut().zip(LIFE).for_each(|(stand, age)| stand.label = format!("{age}"));
    pictured.title = format!("{}, ages in months", pictured.title);
    save(&drawn(&pictured, STRIP), &pictured.note, path)
}

fn drawn(pictured: &Pictured, size: [u32; 2]) -> Canvas {
    let style = Picture { size, ..Picture::default() };
    draw_stands(&pictured.stands(&[]), &pictured.title, &style)
}

fn save(canvas: &Canvas, note: &str, path: &Path) -> Result<()> {
    let doing = || format!("cannot write {}", path.display());
    fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).with_context(doing)?;
    let out = BufWriter::new(File::create(path).with_context(doing)?);
    write_png(canvas, note, Compression::High, out).with_context(doing)
}
