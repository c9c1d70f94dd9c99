//! Levels of detail: `mesh --lods 4`, or `--lods 20k,5k,1k` with the triangles of each further level.
//!
//! A GLB or USD file holds all levels; of other formats there is a file for each, `NAME_lod0.ply` and so on. Absent:
//! which levels there are (`phytomer_outputs::pictures::levels`), and the files of a level.

use super::super::budget::{length, triangles};
use super::super::regrown::Regrown;
use super::super::{Misuse, Verdict, amounts, out};
use super::Mesh;
use super::formats::Format;
use anyhow::{Context, Result};
use clap::Args;
use phytomer::run::drawing::check_size;
use phytomer_outputs::Destination;
use phytomer_outputs::destination::is_stdout;
use phytomer_outputs::gltf::{self, write_levels};
use phytomer_outputs::meshes::{Cards, PlantDrawing, Scene};
use phytomer_outputs::pictures::Apart;
use phytomer_outputs::pictures::cards::cards;
use phytomer_outputs::pictures::levels::{Level, SCREEN, TooCoarse, each_level, levels};
use phytomer_outputs::usd::Organs;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::thread;

/// The most levels.
const MOST: usize = 8;
/// The largest difference of the area that cards cover, as a share.
const MOST_OF_CARDS: f64 = 0.03;

/// Levels of detail.
#[derive(Debug, Clone, Default, Args)]
pub struct Lods {
    /// Levels of detail: their number, from 1 to 8, each of a quarter of the triangles of the one before; or the most
    /// triangles of each level after the first, such as 20k,5k,1k. All of them keep the outline of the plant from eight
    /// sides within 3 %. One GLB or USD file has all; other formats have a file for each, such as NAME_lod1.ply.
    #[arg(long, value_name = "LEVELS|COUNTS", value_parser = asked, allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["ages", "rig", "range"])]
    lods: Option<Asked>,
    /// Let the last of the --lods of a GLB file be crossed cards: four upright pictures of the plant in planes 45
    /// degrees apart, with an atlas of colour, opacity and normals.
    #[arg(long, requires = "lods", conflicts_with = "plot")]
    cards: bool,
}

/// The most triangles of each level after the first; `None`: a quarter of the one before.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Asked(Vec<Option<u64>>);

impl Lods {
    /// What is asked for.
    pub fn asked(&self) -> Option<&Asked> {
        self.lods.as_ref()
    }

    /// The most triangles of each level after the first.
    pub fn most(&self) -> Vec<Option<u64>> {
        self.lods.as_ref().map(|asked| asked.0.clone()).unwrap_or_default()
    }

    /// Refuses what cannot have levels.
    ///
    /// # Errors
    /// The format, or the name.
    pub fn check(&self, out: &Path, format: Format) -> Result<(), Misuse> {
        if self.lods.is_none() {
            return Ok(());
        }
        let further = self.lods.as_ref().map_or(0, |asked| asked.0.len());
        match format {
            _ if self.cards && !matches!(format, Format::Glb(_)) => {
                Err(Misuse("--cards: they have textures, which are written into GLB files (.glb)".to_owned()))
            }
            _ if self.cards && further == 0 => {
                Err(Misuse("--cards: they are the last of at least two levels; state --lods 2 or more".to_owned()))
            }
            Format::Glb(Organs::Instances) => Err(Misuse(
                "--lods: organs that stand for others are larger than their model; leave out --leaves instances"
                    .to_owned(),
            )),
            Format::Ply | Format::Stl | Format::Obj if is_stdout(out) => Err(Misuse(
                "--lods: each level is a file, and stdout is one: name a file, to whose name _lod0 and so on are added"
                    .to_owned(),
            )),
            _ => Ok(()),
        }
    }
}

/// Writes the levels of the plant of a mesh.
pub fn write(mesh: &Mesh, regrown: &Regrown, format: Format) -> Result<Verdict> {
    let mut most = mesh.lods.most();
    let asked = most.len() + 1;
    let of_cards = if mesh.lods.cards { most.pop().flatten() } else { None };
    let seed = regrown.scenario.seed;
    let mut written = Vec::new();
    mesh.show_plant(regrown, &mut |what, scene| {
        check_size(scene).with_context(|| mesh.failing())?;
        let (found, pending) = match with_files(mesh, format, (scene, seed), &most)? {
            Ok(found) => found,
            Err(fault) => return Ok(Err(too_coarse(what, fault))),
        };
        let cards = match last_cards(mesh, what, scene, (asked - 1, of_cards)) {
            Ok(cards) => cards,
            Err(misuse) => return Ok(Err(misuse)),
        };
        let of_level = |level: &Level| Scene::new(scene.plant(), scene.age(), &level.options);
        let scenes = || found.iter().map(of_level).collect::<Vec<_>>();
        let files = match format {
            Format::Glb(_) => vec![(mesh.out.clone(), write_glb(mesh, (&found, &scenes()), cards.as_ref(), seed)?)],
            Format::Usd(..) => vec![(mesh.out.clone(), write_usd(mesh, format, (&found, &scenes()), seed)?)],
            Format::Obj => {
                let write = |(number, scene)| write_file(mesh, format, (number, scene), seed);
                finished((0..).zip(&scenes()).map(write).collect::<Result<_>>()?)?
            }
            Format::Ply | Format::Stl => finished(pending)?,
        };
        written = told(what, (&found, cards.as_ref()), asked, files);
        Ok(Ok(String::new()))
    })?;
    for (path, words) in &written {
        out::tell(path, words)?;
    }
    Ok(Verdict::Done)
}

/// A file that is whole but has not its name yet.
type Pending = (PathBuf, Destination);

/// The levels of a plant, and the files that were written of them.
type LevelsAndFiles = (Vec<Level>, Vec<Pending>);

/// The levels of a plant, and of PLY and STL their files: one is written while the next level is
/// sought. They have their names only when all levels are found, so that a fault leaves nothing.
fn with_files(
    mesh: &Mesh,
    format: Format,
    (scene, seed): (&Scene, u64),
    most: &[Option<u64>],
) -> Result<Result<LevelsAndFiles, TooCoarse>> {
    let (plant, age) = (scene.plant(), scene.age());
    // What stands beside an OBJ file would stay after a fault.
    if !matches!(format, Format::Ply | Format::Stl) {
        return Ok(levels(plant, age, scene.options(), most).map(|found| (found, Vec::new())));
    }
    thread::scope(|scope| {
        let first = scope.spawn(move || write_file(mesh, format, (0, scene), seed));
        let mut writing = vec![first];
        let found = each_level(plant, age, scene.options(), most, &mut |options| {
            let (number, options) = (writing.len(), options.clone());
            writing
                .push(scope.spawn(move || write_file(mesh, format, (number, &Scene::new(plant, age, &options)), seed)));
        });
        let joined = |file: thread::ScopedJoinHandle<Result<Pending>>| {
            file.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        let files = writing.into_iter().map(joined).collect::<Result<Vec<Pending>>>();
        match found {
            Ok(found) => Ok(Ok((found, files?))),
            Err(fault) => Ok(Err(fault)),
        }
    })
}

/// Gives files their names, and returns them with their sizes.
fn finished(files: Vec<Pending>) -> Result<Vec<(PathBuf, u64)>> {
    files.into_iter().map(|(path, file)| Ok((path, file.finish()?))).collect()
}

/// What is told of each file.
fn told(
    what: &str,
    (found, cards): (&[Level], Option<&LastCards>),
    asked: usize,
    files: Vec<(PathBuf, u64)>,
) -> Vec<(PathBuf, String)> {
    let one = files.len() == 1;
    let lines = found.iter().enumerate().map(|(number, level)| format!("level {number}: {}", in_words(level)));
    let mut lines: Vec<String> = lines.collect();
    if found.len() + usize::from(cards.is_some()) < asked
        && let Some(last) = lines.last_mut()
    {
        *last += "; further levels would have hardly fewer, or another outline";
    }
    if let Some((cards, apart)) = cards {
        let (number, faces) = (lines.len(), amounts::of(cards.faces(), "triangle"));
        lines.push(format!("level {number}: {faces}, cards, outline within {:.1} %", 100.0 * apart.area));
    }
    if one {
        let (path, bytes) = files.into_iter().next().unwrap_or_default();
        let levels = amounts::of(lines.len() as u64, "level");
        return vec![(path, format!("{what}, {levels}, {}\n  {}", amounts::bytes(bytes as f64), lines.join("\n  ")))];
    }
    let of_file = |((path, bytes), line)| (path, format!("{what}, {line}, {}", amounts::bytes(bytes as f64)));
    files.into_iter().zip(lines).map(of_file).collect()
}

/// A level in words.
fn in_words(level: &Level) -> String {
    let within = level.options.tolerance.map(|tolerance| format!(", within {}", length(f64::from(tolerance.distance))));
    let kept = level.options.thinned.map(|thinned| {
        let [leaves, ..] = thinned.larger;
        format!(", {:.0} % of the organs, leaves of {leaves:.2} times their area", 100.0 * thinned.share)
    });
    let apart = format!(", outline within {:.1} %", 100.0 * level.apart.area);
    format!("{}{}{}{apart}", amounts::of(level.faces, "triangle"), within.unwrap_or_default(), kept.unwrap_or_default())
}

/// A level in a file.
fn extras(level: &Level) -> Map<String, Value> {
    let mut told = Map::new();
    told.insert("triangles".to_owned(), json!(level.faces));
    told.insert("tolerance_m".to_owned(), json!(level.options.tolerance.map(|tolerance| tolerance.distance)));
    let [leaves, flowers, fruits] = level.options.thinned.map_or([1.0; 3], |thinned| thinned.larger);
    told.insert("organs_kept".to_owned(), json!(level.options.thinned.map_or(1.0, |thinned| thinned.share)));
    told.insert("leaf_area_times".to_owned(), json!(leaves));
    told.insert("flower_area_times".to_owned(), json!(flowers));
    told.insert("fruit_area_times".to_owned(), json!(fruits));
    told.insert("outline_area_apart".to_owned(), json!(level.apart.area));
    told.insert("outline_apart".to_owned(), json!(level.apart.either));
    told
}

/// Cards, and how far their outline is.
type LastCards = (Cards, Apart);

/// The cards that are asked for, as a level that may have so many triangles.
fn last_cards(
    mesh: &Mesh,
    what: &str,
    scene: &Scene,
    (level, most): (usize, Option<u64>),
) -> Result<Option<LastCards>, Misuse> {
    let Some((cards, apart)) = mesh.lods.cards.then(|| cards(scene)).flatten() else { return Ok(None) };
    if let Some(most) = most.filter(|most| *most < cards.faces()) {
        return Err(too_coarse(what, TooCoarse { level, most, least: cards.faces() }));
    }
    if apart.area > MOST_OF_CARDS {
        return Err(Misuse(format!(
            "--cards: cards of {what} would cover an area {:.1} % off that of the plant, and at most 3 % is allowed: its crown \
             is too open for them; leave out --cards",
            100.0 * apart.area
        )));
    }
    Ok(Some((cards, apart)))
}

fn write_glb(mesh: &Mesh, (found, scenes): (&[Level], &[Scene]), cards: Option<&LastCards>, seed: u64) -> Result<u64> {
    let drawings: Vec<PlantDrawing> =
        scenes.iter().map(|scene| PlantDrawing { scene, about: scene.about(seed) }).collect();
    let levels: Vec<gltf::Level> = found
        .iter()
        .zip(&drawings)
        .map(|(level, mesh)| gltf::Level { mesh, screen: level.screen, told: extras(level) })
        .collect();
    let mut file = Destination::create(&mesh.out)?;
    let last = cards.map(|(cards, apart)| {
        let mut told = Map::new();
        told.insert("triangles".to_owned(), json!(cards.faces()));
        told.insert("cards".to_owned(), json!(cards.cards.len()));
        told.insert("outline_area_apart".to_owned(), json!(apart.area));
        told.insert("outline_apart".to_owned(), json!(apart.either));
        gltf::LastCards { cards, told }
    });
    write_levels(&levels, last.as_ref(), &mut file).with_context(|| mesh.failing())?;
    Ok(file.finish()?)
}

fn write_usd(mesh: &Mesh, format: Format, (found, scenes): (&[Level], &[Scene]), seed: u64) -> Result<u64> {
    let words = (0..).zip(found).map(|(number, level)| format!("lod{number}: {}", in_words(level)));
    let words = words.collect::<Vec<_>>().join("; ");
    let mut file = Destination::create(&mesh.out)?;
    format.write_levels(scenes, (seed, &words), &mut file, &mesh.out).with_context(|| mesh.failing())?;
    Ok(file.finish()?)
}

fn write_file(mesh: &Mesh, format: Format, (number, scene): (usize, &Scene), seed: u64) -> Result<Pending> {
    let path = named(&mesh.out, number);
    let mut file = Destination::create(&path)?;
    format.write_plant(scene, seed, &mut file, &path).with_context(|| format!("cannot write {}", path.display()))?;
    file.sync()?;
    Ok((path, file))
}

/// The name of the file of a level.
pub fn named(out: &Path, number: usize) -> PathBuf {
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let ending = out.extension().unwrap_or_else(|| "ply".as_ref()).to_string_lossy();
    out.with_file_name(format!("{stem}_lod{number}.{ending}"))
}

/// The part of the area of the screen that what is shown covers down to which a level of these triangles is shown.
pub fn screen_of(faces: &[u64], level: usize) -> f64 {
    match faces.get(level + 1) {
        Some(_) => SCREEN * faces[level] as f64 / faces[0].max(1) as f64,
        None => 0.0,
    }
}

/// That a level cannot have so few triangles.
pub fn too_coarse(what: &str, TooCoarse { level, most, least }: TooCoarse) -> Misuse {
    let [most, least] = [most, least].map(amounts::count);
    Misuse(format!(
        "--lods: level {level} of {what} may have {most} triangles, and has at least {least} where its outline stays \
         within 3 %; state more, or fewer levels"
    ))
}

/// A number of levels, or the most triangles of each after the first.
fn asked(text: &str) -> Result<Asked, String> {
    let text = text.trim();
    let expected = format!(
        "a number of levels from 1 to {MOST} is expected, or the most triangles of each level after the first, such as \
         20k,5k,1k"
    );
    if text.chars().all(|letter| letter.is_ascii_digit()) {
        let levels = text.parse::<usize>().ok().filter(|levels| (1..=MOST).contains(levels));
        return levels.map(|levels| Asked(vec![None; levels - 1])).ok_or(expected);
    }
    let counts = text.split(',').map(|count| triangles(count.trim())).collect::<Result<Vec<u64>, String>>();
    let counts = counts.map_err(|_| expected.clone())?;
    if counts.len() >= MOST {
        return Err(expected);
    }
    if let Some(pair) = counts.windows(2).find(|pair| pair[1] >= pair[0]) {
        return Err(format!("{} triangles after {}: each level has fewer than the one before", pair[1], pair[0]));
    }
    Ok(Asked(counts.into_iter().map(Some).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_counted_or_stated() {
        assert_eq!(asked("4"), Ok(Asked(vec![None; 3])));
        assert_eq!(asked("1"), Ok(Asked(Vec::new())));
        assert_eq!(asked("20k, 5k,1000"), Ok(Asked(vec![Some(20_000), Some(5000), Some(1000)])));
        assert_eq!(asked("5k"), Ok(Asked(vec![Some(5000)])));
        for text in ["0", "9", "-1", "", "a", "1.5", "5k,", "5k,0", "9k,8k,7k,6k,5k,4k,3k,2k", "99999999999999999999"] {
            let told = asked(text).expect_err(text);
            assert!(told.contains("from 1 to 8 is expected"), "{text}: {told}");
        }
        assert!(asked("5k,5k").expect_err("as many").contains("each level has fewer"));
    }

    #[test]
    fn each_level_has_a_name() {
        assert_eq!(named(Path::new("a/tree.ply"), 2), Path::new("a/tree_lod2.ply"));
        assert_eq!(named(Path::new("tree"), 0), Path::new("tree_lod0.ply"));
        assert_eq!(named(Path::new("a.b.STL"), 1), Path::new("a.b_lod1.STL"));
    }
}
