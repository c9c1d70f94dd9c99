//! The gallery: every species that ships, drawn in its prime, every plot that ships, and the life of a tree as a strip.
//!
//! `cargo run --release --example gallery [FOLDER]` writes `gallery.md`, its pictures below `gallery/`, the pages of
//! some species below `pages/` and `life.png` into a folder, `docs` if none is given. `cargo run --release --example
//! gallery pages FOLDER` writes the page of every species, as `phytomer view` does, and an index of them. A species is
//! grown by the shipped scenario of its name if there is one, else by itself, and drawn at the age that `phytomer
//! picture` chooses; a scenario with members is drawn as `phytomer picture --plot` draws it. Every shipped species and
//! plot is drawn; a tree of stems stands in leaf and bare side by side, as in Plate 1 of Weber & Penn 1995. Names stand
//! here of the pages alone that ship, and of the trees of Plates 6 and 7.

use anyhow::{Context, Result, anyhow};
use phytomer::config::{
    Kind, Resolved, SPECIES_ALONE_UNTIL, Scenario, Species, Trial, presets, validate, validate_species,
};
use phytomer::outputs::meshes::MOST_DETAIL;
use phytomer::outputs::pictures::{Canvas, Compression, Picture, draw_stands, write_png};
use phytomer::run::filming::Filming;
use phytomer::run::picturing::{Pictured, PicturedStand, pictured_plants, pictured_plot};
use phytomer::run::regrowth::{Regrowth, Whose};
use phytomer::run::viewing::View;
use phytomer::sim::between::Moment;
use phytomer::sim::{GrowthModel, Tick};
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

/// The size of a picture of the gallery, and of the strip.
const SIZE: [u32; 2] = [360, 480];
const STRIP: [u32; 2] = [1600, 460];
/// The size of a picture of a tree in two forms.
const PAIR: [u32; 2] = [640, 480];
/// The size of a picture of a plot.
const PLOT_SIZE: [u32; 2] = [960, 640];
/// The species and the ages, in months, of the strip: robusta coffee.
const LIFE_OF: &str = "coffee";
const LIFE: [Tick; 9] = [4, 9, 16, 26, 40, 56, 76, 96, 106];

/// The species whose pages ship: of several models, and none with a page of more than half a megabyte.
const PAGES: [&str; 7] = ["borchert_slade", "coffee", "cotton", "dog_rose", "frangipani", "gmt1/5a", "topiary/4"];

const INTRODUCTION: &str = "# Gallery\n\n\
    Every species that ships but `topiary/1`, which draws no line, drawn by `phytomer picture` at the age that it \
    states, or else in its prime:\nthe last year with nine tenths of the largest leaf area that it ever bears, as soon \
    as it bears it. `cargo run --release --example gallery` makes this page. Each can be seen to grow: `phytomer \
    animate NAME --out film.webp` makes a film ([films.md](films.md)), and `phytomer view NAME --out life.html` a page \
    of its whole life to turn and to ask ([view.md](view.md)); NAME is the first word of a picture's title. ";
const MORE_PAGES: &str =
    "`cargo run --release --example gallery pages FOLDER` makes those of all species, with an index.";

/// A form of a species: its words, and what its file states besides.
type Form<'a> = (&'a str, &'a str);

/// The trees that Weber & Penn 1995 show in two forms: the name, the title, and the forms.
const PLATES: [(&str, &str, [Form; 2]); 2] = [
    (
        "wp/sassafras",
        "Plate 6",
        [("leaves as they grow", "LeafBend = 0"), ("leaves turned to the light", "LeafBend = 1")],
    ),
    ("wp/weeping_willow", "Plate 7", [("unpruned", "PruneRatio = 0"), ("pruned", "PruneRatio = 1")]),
];

struct Sitter {
    scenario: Scenario,
    species: Species,
    model: Arc<dyn GrowthModel>,
}

fn main() -> Result<()> {
    let mut words = std::env::args().skip(1);
    let folder = words.next().unwrap_or_else(|| "docs".to_owned());
    if folder == "pages" {
        return all_pages(Path::new(&words.next().unwrap_or(folder)));
    }
    let folder = Path::new(&folder);
    let mut page = String::from(INTRODUCTION);
    let linked: Vec<String> = PAGES.iter().map(|name| format!("[{name}]({})", page_of(name))).collect();
    writeln!(page, "Pages are here of {}. {MORE_PAGES}", linked.join(", "))?;
    let of = |name: &'static str| name.rsplit_once('/').map_or("", |(group, _)| group);
    let mut names = names();
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
    page += "\n## Plants in two forms\n\nLeaves that turn to the light, and pruning.\n\n";
    for (name, title, forms) in PLATES {
        let file = format!("gallery/wp/{}.png", title.to_lowercase().replace(' ', "_"));
        let [first, second] = forms.map(|(words, _)| words);
        let pictured = in_forms(name, &forms).with_context(|| title)?;
        save(&drawn(&pictured, PAIR), &pictured.note, &folder.join(&file))?;
        writeln!(page, "![{title}]({file} \"{title}: {name}, {first} and {second}\")")?;
    }
    page += "\n## Plots\n\nEvery scenario that ships with several members, drawn by `phytomer picture --plot` at its last \
             tick.\n\n";
    for (name, _) in presets(Kind::Scenario) {
        page += &plot(name, folder).with_context(|| format!("the scenario {name}"))?;
    }
    fs::write(folder.join("gallery.md"), page)?;
    PAGES.iter().try_for_each(|name| write_page(name, &folder.join(page_of(name))).map(|_| ()))?;
    strip(&folder.join("life.png"))
}

/// The species that are drawn: of the first L-system of Synthetic Topiary there are buds alone.
fn names() -> Vec<&'static str> {
    presets(Kind::Species).iter().map(|(name, _)| *name).filter(|name| *name != "topiary/1").collect()
}

/// The place of the page of a species that ships.
fn page_of(name: &str) -> String {
    format!("pages/{}.html", name.replace('/', "-"))
}

/// Writes the pages of all species into a folder, with an index.
fn all_pages(folder: &Path) -> Result<()> {
    let mut index = String::from("<!DOCTYPE html><meta charset=\"utf-8\"><title>phytomer: pages</title><ul>\n");
    for name in names() {
        let file = format!("{}.html", name.replace('/', "-"));
        let bytes = write_page(name, &folder.join(&file)).with_context(|| format!("the species {name}"))?;
        writeln!(index, "<li><a href=\"{file}\">{name}</a>, {:.1} MB", bytes as f64 / 1e6)?;
    }
    Ok(fs::write(folder.join("index.html"), index + "</ul>\n")?)
}

/// Writes the page of a species, as `phytomer view NAME` does; its bytes.
fn write_page(name: &str, path: &Path) -> Result<u64> {
    let sitter = Sitter::of(name)?;
    let regrowth = sitter.regrowth();
    let view = View {
        regrowth: &regrowth,
        species: &[&sitter.species],
        forms: &[],
        whose: vec![if sitter.scenario.site.drawn().is_empty() { Whose::Plant(0) } else { Whose::Plot(0) }],
        ages: (0..=regrowth.trial().last_age_of(0)).map(Moment::from).collect(),
        tolerance: None,
        mechanics: sitter.scenario.output.mechanics,
        detail: 0,
    };
    let doing = || format!("cannot write {}", path.display());
    fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).with_context(doing)?;
    let page = view.page(&Filming::default())?;
    page.write(&mut BufWriter::new(File::create(path).with_context(doing)?)).with_context(doing)?;
    let bytes = fs::metadata(path)?.len();
    println!("{}: {bytes} bytes", path.display());
    Ok(bytes)
}

/// Draws one species and returns its caption.
fn sit(name: &str, folder: &Path) -> Result<String> {
    let sitter = Sitter::of(name)?;
    let regrowth = sitter.regrowth();
    let age = regrowth.shown_at(&sitter.species, 0)?;
    // A plant among obstacles is drawn with them.
    let mut pictured = if sitter.scenario.site.drawn().is_empty() {
        pictured_plants(&regrowth, &[&sitter.species], &[0], &[age])?
    } else {
        pictured_plot(&regrowth, &[&sitter.species], (0, &[age]), false)?
    };
    let file = format!("gallery/{name}.png");
    let has_leaves = name.starts_with("wp/") && pictured.stands.iter().any(has_organs);
    let size = if has_leaves { PAIR } else { SIZE };
    if has_leaves {
        pictured.stands.extend(in_forms(name, &[("", "Leaves = 0")])?.stands);
        pictured.stands.iter_mut().for_each(|stand| stand.label.clear());
    }
    save(&drawn(&pictured, size), &pictured.note, &folder.join(&file))?;
    println!("{name}: age {age}");
    let about = &sitter.species.about;
    let called = about.common_name.as_deref().unwrap_or(&about.name);
    let latin = about.scientific_name.as_ref().map(|latin| format!(", *{latin}*")).unwrap_or_default();
    let model = about.architectural_model.map(|model| format!(", {model:?}'s model")).unwrap_or_default();
    let picture = format!("![{called}]({file} \"{name}: {called}{latin}{model}, age {age}\")");
    Ok(if PAGES.contains(&name) { format!("[{picture}]({})\n", page_of(name)) } else { format!("{picture}\n") })
}

/// Whether a plant of a stand has organs.
fn has_organs(stand: &PicturedStand) -> bool {
    stand.plants.iter().any(|plant| !plant.organs.is_empty())
}

/// A species as it is in several forms.
fn in_forms(name: &str, forms: &[Form]) -> Result<Pictured> {
    let folder = tempfile::tempdir()?;
    let mut all: Option<Pictured> = None;
    for (words, states) in forms {
        let file = folder.path().join("form.toml");
        fs::write(&file, format!("inherits = \"{name}\"\nname = \"{name}\"\n{states}\n"))?;
        let sitter = Sitter::of(&file.to_string_lossy())?;
        let regrowth = sitter.regrowth();
        let age = regrowth.shown_at(&sitter.species, 0)?;
        let mut pictured = pictured_plants(&regrowth, &[&sitter.species], &[0], &[age])?;
        pictured.stands.iter_mut().for_each(|stand| stand.label = (*words).to_owned());
        match &mut all {
            Some(all) => all.stands.append(&mut pictured.stands),
            None => all = Some(pictured),
        }
    }
    all.context("no form is asked for")
}

/// Draws the first plot of a scenario, if it has several members, and returns its caption.
fn plot(name: &str, folder: &Path) -> Result<String> {
    let found = validate(name).map_err(|report| anyhow!(report.render(false)))?;
    if found.scenario.members() < 2 {
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
    let style = Picture { size, detail: MOST_DETAIL, ..Picture::default() };
    draw_stands(&pictured.stands(&[]), &pictured.title, &style)
}

fn save(canvas: &Canvas, note: &str, path: &Path) -> Result<()> {
    let doing = || format!("cannot write {}", path.display());
    fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).with_context(doing)?;
    let out = BufWriter::new(File::create(path).with_context(doing)?);
    write_png(canvas, note, Compression::High, out).with_context(doing)
}
