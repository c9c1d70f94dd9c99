//! Scenes of AMAPstudio and Archimed (`.ops`): plants of a plot, each a row with the OPF file that it is in and how it
//! stands.
//!
//! A row is scene, plant, file, x, y, z, scale, the azimuth of the lean, the lean and the turn about its own axis:
//! metres and radians. Older files have no scale, name their columns in a comment, or have more than one tab between
//! cells. `#[Archimed] word` tells the functional group of the rows below,
//! which is read as the species of plants whose own file tells none. Written are an OPF file a plant, beside the
//! scene. Absent: chains of scenes, and what is no plant, which are passed over with a warning.

use super::contract::{Format, Incoming, MOST_ENTITIES, Outgoing};
use super::decimals::push;
use super::description::{Description, Individual, Standing};
use super::losses::Losses;
use super::numbers::number;
use super::opf;
use super::report::Report;
use super::text::{decoded, said};
use joined::Joined;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io;

mod joined;

/// The group of plants without a species.
const GROUP: &str = "plant";

/// The most cells of a row.
const CELLS: usize = 10;

/// The format.
pub struct Ops;

impl Format for Ops {
    fn word(&self) -> &'static str {
        "ops"
    }

    fn title(&self) -> &'static str {
        "scenes of AMAPstudio and Archimed, with an OPF file a plant"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["ops"]
    }

    fn read(&self, incoming: &Incoming<'_>, report: &mut Report) -> Description {
        let text = decoded(incoming.bytes, report);
        let mut scene =
            Scene { incoming, joined: Joined::default(), files: BTreeMap::new(), group: String::new(), scaled: true };
        for (place, line) in text.lines().enumerate() {
            scene.line(line, place + 1, report);
        }
        if scene.joined.all.individuals.is_empty() && !report.is_refused() {
            report.fault(
                (0, 0),
                "the scene has no plant",
                "rows of scene, plant, OPF file, place, scale and three angles",
            );
        }
        scene.joined.all
    }

    fn write(&self, description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()> {
        let writing = opf::Writing::of(description, losses);
        let stem = out.stem().to_owned();
        let plants = &description.individuals;
        let name = |plant: usize| format!("{stem}_{}.opf", plant + 1);
        for plant in 0..plants.len() {
            out.file(Some(&name(plant)), &mut |file| writing.file(&[plant], file, losses))?;
        }
        out.file(None, &mut |file| file.write_all(rows(plants, name).as_bytes()))
    }
}

/// A scene that is read.
struct Scene<'a> {
    incoming: &'a Incoming<'a>,
    joined: Joined,
    /// The plants of each file, as they are in the joined description.
    files: BTreeMap<String, Vec<Individual>>,
    group: String,
    /// Whether the columns that a comment has named have a scale among them.
    scaled: bool,
}

impl Scene<'_> {
    fn line(&mut self, line: &str, number_of_line: usize, report: &mut Report) {
        let line = line.trim();
        if let Some(group) = line.strip_prefix("#[Archimed]") {
            group.trim().clone_into(&mut self.group);
            return;
        }
        if let Some(names) = line.strip_prefix('#').map(str::to_ascii_lowercase)
            && names.trim_start().starts_with("sceneid")
        {
            self.scaled = names.split_ascii_whitespace().any(|name| name == "scale");
        }
        let is_terrain = line.starts_with("T ") || line.starts_with("T\t");
        if line.is_empty() || line.starts_with('#') || is_terrain || report.is_refused() {
            return;
        }
        let cells = cells(line);
        if let [_, _, _] = cells[..]
            && cells.iter().all(|cell| number(cell).is_some())
        {
            report.warn((number_of_line, 0), "chain", "a line of three numbers, as of a chain of scenes, is left out");
            return;
        }
        let Some((plant, file, standing)) = row(&cells, self.scaled, number_of_line, report) else { return };
        if !file.to_ascii_lowercase().ends_with(".opf") {
            report.warn((number_of_line, 0), "", format!("`{}` is no OPF file and is left out", said(file)));
            return;
        }
        self.place(plant, file, standing, number_of_line, report);
    }

    /// Puts the plants of a file into the scene.
    fn place(&mut self, plant: &str, file: &str, standing: Standing, line: usize, report: &mut Report) {
        if !self.files.contains_key(file) {
            let Some(read) = self.read(file, line, report) else { return };
            self.files.insert(file.to_owned(), read);
        }
        for template in &self.files[file] {
            self.joined.entities += template.entities.len();
            if self.joined.entities > MOST_ENTITIES {
                report.fault(
                    (line, 0),
                    "the plants of the scene have too many entities",
                    format!("at most {MOST_ENTITIES}"),
                );
                return;
            }
            let mut individual = template.clone();
            individual.standing = Some(standing);
            individual.name = individual.name.or_else(|| Some(plant.to_owned()));
            let group = (!matches!(self.group.as_str(), "" | GROUP)).then(|| self.group.clone());
            individual.species = individual.species.or(group);
            self.joined.all.individuals.push(individual);
        }
    }

    /// The plants of a file; told and none where it cannot be read.
    fn read(&mut self, file: &str, line: usize, report: &mut Report) -> Option<Vec<Individual>> {
        let bytes = match (self.incoming.beside)(file) {
            Ok(bytes) => bytes,
            Err(error) => {
                report.fault(
                    (line, 0),
                    format!("`{}` cannot be read: {error}", said(file)),
                    "an OPF file beside the scene",
                );
                return None;
            }
        };
        let before = report.enter(file);
        let incoming = Incoming { name: file, bytes: &bytes, units: self.incoming.units, beside: self.incoming.beside };
        let read = opf::read(&incoming, report);
        report.enter(&before);
        (!report.is_refused()).then(|| self.joined.take(read))
    }
}

/// The cells of a row. Names of files may have blanks, so tabs part the cells where there are any.
fn cells(line: &str) -> Vec<&str> {
    if !line.contains('\t') {
        return line.split_ascii_whitespace().collect();
    }
    let all: Vec<&str> = line.split('\t').map(str::trim).collect();
    // An empty cell of a whole row is a number that is missing; those of a longer row are further tabs.
    if all.len() > CELLS { all.into_iter().filter(|cell| !cell.is_empty()).collect() } else { all }
}

/// Plant, file and standing of a row; told and none where it is none. A row whose columns have no scale may end with
/// one that is to be ignored.
fn row<'a>(cells: &[&'a str], scaled: bool, line: usize, report: &mut Report) -> Option<(&'a str, &'a str, Standing)> {
    let (plant, file, rest) = match cells {
        [_, plant, file, rest @ ..] if !scaled && matches!(rest.len(), 6 | 7) => (*plant, *file, &rest[..6]),
        [_, plant, file, rest @ ..] if matches!(rest.len(), 6 | 7) => (*plant, *file, rest),
        _ => {
            let expected = "scene, plant, file, x, y, z, scale and three angles; the scale may be missing";
            report.fault((line, 0), format!("the row has {} cells", cells.len()), expected);
            return None;
        }
    };
    let mut found = Vec::with_capacity(7);
    for cell in rest {
        match number(cell) {
            Some(number) => found.push(number),
            None => {
                report.fault((line, 0), format!("`{}` is no number", said(cell)), "a number");
                return None;
            }
        }
    }
    if found.len() == 6 {
        report.warn((line, 0), "scale", "the row has no scale: read as 1");
        found.insert(3, 1.0);
    }
    if found[3] == 0.0 {
        report.warn((line, 0), "scale 0", "the scale is 0: read as 1");
        found[3] = 1.0;
    }
    if found[3] < 0.0 {
        report.fault((line, 0), format!("the scale is {}", found[3]), "a number above 0");
        return None;
    }
    let standing = Standing {
        place: [found[0], found[1], found[2]],
        scale: found[3],
        azimuth: found[4],
        inclination: found[5],
        twist: found[6],
    };
    Some((plant, file, standing))
}

/// The lines of a scene. Its rectangle, which readers ask for, is the smallest in whole metres that holds the places of
/// its plants and has some extent.
fn rows(plants: &[Individual], name: impl Fn(usize) -> String) -> String {
    let standing = |plant: &Individual| {
        plant.standing.unwrap_or(Standing { place: [0.0; 3], scale: 1.0, azimuth: 0.0, inclination: 0.0, twist: 0.0 })
    };
    let places: Vec<[f64; 3]> = plants.iter().map(|plant| standing(plant).place).collect();
    let least = |k: usize| places.iter().map(|place| place[k]).fold(f64::INFINITY, f64::min);
    let most = |k: usize| places.iter().map(|place| place[k]).fold(f64::NEG_INFINITY, f64::max);
    let (mut out, [x, y]) = (String::new(), [0, 1].map(|k| least(k).floor()));
    out.push_str("# T xOrigin yOrigin zOrigin xSize ySize flat\nT");
    for number in [x, y, least(2).floor(), (most(0).floor() + 1.0), (most(1).floor() + 1.0)] {
        out.push(' ');
        push(&mut out, number, 9);
    }
    out.push_str(" flat\n");
    let mut group = None;
    for (place, plant) in plants.iter().enumerate() {
        let own = plant.species.as_deref().map_or(GROUP, |species| species.lines().next().unwrap_or(GROUP).trim());
        if group != Some(own) {
            group = Some(own);
            let _ = writeln!(out, "#[Archimed] {own}");
            out.push_str("#sceneId plantId plantFileName x y z scale inclinationAzimut inclinationAngle stemTwist\n");
        }
        let _ = write!(out, "1\t{}\t{}", place + 1, name(place));
        let Standing { place: [x, y, z], scale, azimuth, inclination, twist } = standing(plant);
        for number in [x, y, z, scale, azimuth, inclination, twist] {
            out.push('\t');
            push(&mut out, number, 9);
        }
        out.push('\n');
    }
    out
}
