//! `fit gmt`: the numbers of a geometric tree from its height, or from measured branches (Aono & Kunii 1984).
//!
//! Three lengths give the ratios by Eqs. 1 to 3; a table of branches, or a run, gives all numbers with intervals, and
//! perhaps a picture. Either is written as a species that `grow` takes. Absent: the estimates, which are the library's.

mod told;

use super::super::{Misuse, Verdict, refuse, terminal};
use super::{hash_of, load};
use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use phytomer::fitted::{self, Pictured, Source};
use phytomer_config::validate_texts;
use phytomer_fits::data::Fault;
use phytomer_fits::gmt::skeleton::{SAMPLE, read};
use phytomer_fits::gmt::{Piece, Skeleton, TreeModel, Wish, fit};
use phytomer_fits::proportions::{Measures, exact, printed};
use phytomer_outputs::destination::{Destination, is_stdout};
use serde_json::{Value, json};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The numbers of a geometric tree, from three lengths or from its branches.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer fit gmt --height 5.747 --first-branch 1 --lateral 3.56 --level 7 --ternary    a young ginkgo, Eqs. 1 to 3
  phytomer fit gmt --height 12 --first-branch 2 --lateral 5 --level 9 --angles 5,-60 --out my_fir.toml
  phytomer fit gmt --sample                     a table of branches as it is read
  phytomer fit gmt --data branches.csv --confidence 80 --picture beside.svg --out my_tree.toml
  phytomer fit gmt --data runs/coffee --age 24  the branches of a run at an age

A table has a row for each branch, with the columns id, parent, x, y, z and diameter, and perhaps plant. x, y and z are
the tip of the branch; it begins at the tip of its parent, and the first branch of a plant, which has no parent, at
--origin. z is up. Lengths are metres where a species is written. A diameter may be left empty. A branch that bears one
other alone is one with it, so that curved branches may be measured in pieces.

Left is the side of h1. Of two children the one with the smaller angle continues the axis. The model is the one of the
least BIC unless --model names it: gmt1 has constant angles, gmt2 a deviation of all tips, gmt3 three children, gmt4
angles by a category of Table 3. Controllers are not fitted. The species has intervals of 95 %; fit.json, beside it, all
rivals, and the means of each growth level with intervals of --confidence.")]
pub struct Gmt {
    /// H: the height of the tree, from the root to the top.
    #[arg(long, value_name = "H", conflicts_with = "data", allow_negative_numbers = true)]
    #[arg(requires_all = ["first_branch", "lateral", "level"])]
    height: Option<f64>,
    /// H0: from the root to the first branching.
    #[arg(long, value_name = "H0", requires = "height", allow_negative_numbers = true)]
    first_branch: Option<f64>,
    /// L: from the first branching to the farthest tip of the lateral branches that begin there.
    #[arg(long, value_name = "L", requires = "height", allow_negative_numbers = true)]
    lateral: Option<f64>,
    /// The growth level of the tree.
    #[arg(long, value_name = "N", requires = "height")]
    level: Option<u32>,
    /// The ratios as the paper has them, of growth without end; else they are those of the growth level.
    #[arg(long, requires = "height")]
    printed: bool,
    /// Of a tree of three children.
    #[arg(long, requires = "height")]
    ternary: bool,
    /// h1 and h2 of the species, degrees; left out: assumed.
    #[arg(long, value_name = "H1,H2", requires = "height", allow_hyphen_values = true)]
    angles: Option<String>,
    /// The table of branches: .csv, .txt or .parquet; or a run folder.
    #[arg(long, value_name = "DATA", required_unless_present_any = ["height", "sample"])]
    data: Option<PathBuf>,
    /// The level of intervals, percent.
    #[arg(long, value_name = "PERCENT", default_value_t = 95.0)]
    confidence: f64,
    /// The type of the tree.
    #[arg(long, value_enum, requires = "data")]
    model: Option<Word>,
    /// Where first branches begin.
    #[arg(long, value_name = "X,Y,Z", requires = "data", allow_hyphen_values = true)]
    origin: Option<String>,
    /// The age at which the branches of a run are taken; left out: the last that it recorded.
    #[arg(long, requires = "data")]
    age: Option<u32>,
    /// The fitted tree beside the data: .svg or .png.
    #[arg(long, value_name = "FILE", requires = "data")]
    picture: Option<PathBuf>,
    /// The species file that is written; fit.json comes beside it.
    #[arg(long, value_name = "SPECIES.toml")]
    out: Option<PathBuf>,
    /// Where the data come from, for `source`; left out: the name of the file.
    #[arg(long, value_name = "TEXT")]
    source: Option<String>,
    /// Print a sample table instead.
    #[arg(long)]
    sample: bool,
    /// The contents of fit.json on stdout.
    #[arg(long)]
    json: bool,
}

/// The types of trees.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Word {
    Gmt1,
    Gmt2,
    Gmt3,
    Gmt4,
}

impl Word {
    fn model(self) -> TreeModel {
        match self {
            Self::Gmt1 => TreeModel::Gmt1,
            Self::Gmt2 => TreeModel::Gmt2,
            Self::Gmt3 => TreeModel::Gmt3,
            Self::Gmt4 => TreeModel::Gmt4,
        }
    }
}

/// Measured branches with the hash of their file, or what is wrong with it.
type Measured = std::result::Result<(Vec<Piece>, String), Vec<Fault>>;

impl Gmt {
    pub fn obey(self) -> Result<Verdict> {
        if self.sample {
            terminal::put(SAMPLE.trim_end())?;
            return Ok(Verdict::Done);
        }
        if !(self.confidence > 0.0 && self.confidence < 100.0) {
            let told = format!("--confidence {}: a share above 0 and below 100 % is expected", self.confidence);
            return Err(Misuse(told).into());
        }
        for (option, path, endings) in
            [("--out", &self.out, &["toml"][..]), ("--picture", &self.picture, &["svg", "png"])]
        {
            check_ending(option, path.as_deref(), endings)?;
        }
        match (&self.data, self.height, self.first_branch, self.lateral, self.level) {
            (Some(data), ..) => self.of_branches(data),
            (None, Some(height), Some(first_branch), Some(lateral), Some(level)) => {
                self.of_lengths(&Measures { height, first_branch, lateral }, level)
            }
            _ => {
                Err(Misuse("`fit gmt` needs --data, or --height, --first-branch, --lateral and --level".to_owned())
                    .into())
            }
        }
    }

    fn of_lengths(&self, measures: &Measures, level: u32) -> Result<Verdict> {
        let angles = self.angles.as_ref().map(|text| numbers::<2>("--angles", text, "27,-37")).transpose()?;
        let found = if self.printed { printed(measures) } else { exact(measures, level) };
        let found = match found {
            Ok(found) => found,
            Err(misfit) => return self.refused(&misfit.to_string()),
        };
        let how = if self.printed { "growth without end" } else { "its own growth level" };
        let grown = found.measures(measures.first_branch, level);
        let Measures { height, first_branch, lateral } = *measures;
        let data = format!("H {height}, H0 {first_branch}, L {lateral}, growth level {level}");
        let data = self.source.as_ref().map_or_else(|| data.clone(), |source| format!("{source}: {data}"));
        let words = format!("Aono & Kunii 1984, Eqs. 1 to 3 at {how}: {data}");
        let names = told::names(self.ternary);
        let ratios = match self.ternary {
            true => json!({"r0": found.main, "r1": found.lateral, "r2": found.lateral}),
            false => json!({"r1": found.main, "r2": found.lateral}),
        };
        let object = json!({
            "status": "done", "model": if self.ternary { "gmt3" } else { "gmt1" }, "printed": self.printed,
            "height": height, "first_branch": first_branch, "lateral": lateral, "level": level,
            "ratios": ratios,
            "grown": {"height": grown.height, "lateral": grown.lateral},
        });
        let species = |name: &str| {
            let source = Source { name, data: &words };
            fitted::of_proportions((measures, &found), level, self.ternary, angles, &source)
        };
        if let Some(verdict) = self.write(species, &object)? {
            return Ok(verdict);
        }
        if self.json {
            terminal::put_json(&object)?;
        } else {
            terminal::put(&told::in_words(&found, names, &grown, measures, level))?;
        }
        Ok(Verdict::Done)
    }

    /// The branches of a table, or of a run.
    fn measured(&self, path: &Path) -> Result<Measured> {
        let origin = self.origin.as_ref().map_or(Ok([0.0; 3]), |text| numbers::<3>("--origin", text, "0,0,0.3"))?;
        if path.is_dir() {
            let json = path.join("run.json");
            return Ok(match fitted::of_run(path, self.age) {
                Ok(pieces) => {
                    let bytes = std::fs::read(&json).with_context(|| format!("cannot read {}", json.display()))?;
                    Ok((pieces, hash_of(&bytes)))
                }
                Err(problem) => Err(vec![Fault {
                    file: path.display().to_string(),
                    line: None,
                    column: None,
                    problem,
                    expected: "a finished run that recorded its plants".to_owned(),
                }]),
            });
        }
        if self.age.is_some() {
            return Err(Misuse(format!("{}: --age is for a run; a table has one age", path.display())).into());
        }
        let (table, hash) = match load(path)? {
            Ok(loaded) => loaded,
            Err(faults) => return Ok(Err(faults)),
        };
        let text = std::fs::read(path).ok().filter(|bytes| !bytes.starts_with(b"PAR1"));
        Ok(read(&table, text.as_deref(), origin).map(|pieces| (pieces, hash)))
    }

    fn of_branches(&self, path: &Path) -> Result<Verdict> {
        let (pieces, hash) = match self.measured(path)? {
            Ok(measured) => measured,
            Err(faults) => return super::decline(&faults, self.json),
        };
        let skeleton = Skeleton::of(&pieces);
        let wish = Wish { confidence: self.confidence / 100.0, model: self.model.map(Word::model), course: None };
        let found = match fit(&skeleton, &wish) {
            Ok(found) => found,
            Err(problem) => return self.refused(&format!("{}: {problem}", path.display())),
        };
        // A species documents intervals of 95 %.
        let same = Wish { confidence: 0.95, model: Some(found.model), course: Some(found.course) };
        let stated = fit(&skeleton, &same).unwrap_or_else(|_| found.clone());
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let data = self.source.clone().unwrap_or(name);
        let object = told::object(&found, &path.display().to_string(), &hash);
        let species = |name: &str| fitted::of_branches(&stated, &Source { name, data: &data });
        if let Some(verdict) = self.write(species, &object)? {
            return Ok(verdict);
        }
        if let Some(picture) = &self.picture {
            let is_lines = picture.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg"));
            let format = if is_lines { Pictured::Svg } else { Pictured::Png };
            let bytes =
                fitted::picture(&skeleton, &species("fitted"), format).map_err(|problem| anyhow::anyhow!(problem))?;
            put(picture, &bytes)?;
        }
        if self.json {
            terminal::put_json(&object)?
        } else {
            terminal::put(&told::told(&found))?
        }
        Ok(Verdict::Done)
    }

    fn refused(&self, problem: &str) -> Result<Verdict> {
        if self.json {
            terminal::put_json(&json!({"status": "not estimated", "problem": problem}))?;
        } else {
            terminal::say(problem);
        }
        Ok(Verdict::Invalid)
    }

    /// Checks the species by its model, and writes it with fit.json; a verdict where the model refuses it.
    fn write(&self, species: impl Fn(&str) -> String, object: &Value) -> Result<Option<Verdict>> {
        let Some(out) = &self.out else { return Ok(None) };
        let name = out.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let (shown, text) = (out.display().to_string(), species(&name));
        if let Err(report) = validate_texts(&shown, &[(shown.as_str(), text.as_str())]) {
            return refuse(&report, self.json).map(Some);
        }
        put(out, text.as_bytes())?;
        put(&out.with_file_name("fit.json"), format!("{object:#}\n").as_bytes())?;
        Ok(None)
    }
}

fn put(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut file = Destination::create(path)?;
    file.write_all(bytes).with_context(|| format!("cannot write {}", path.display()))?;
    file.finish()?;
    terminal::say(&format!("{} is written", path.display()));
    Ok(())
}

fn check_ending(option: &str, path: Option<&Path>, endings: &[&str]) -> Result<(), Misuse> {
    let Some(path) = path else { return Ok(()) };
    if is_stdout(path) {
        return Err(Misuse(format!("{option} -: name a file; stdout has the estimates")));
    }
    let has = |ending: &&str| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending));
    if endings.iter().any(has) {
        return Ok(());
    }
    Err(Misuse(format!("{option} {}: a file that ends in .{} is expected", path.display(), endings.join(" or ."))))
}

/// So many numbers with commas between them.
fn numbers<const N: usize>(option: &str, text: &str, example: &str) -> Result<[f64; N], Misuse> {
    let read: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse::<f64>().ok().filter(|number| number.is_finite())).collect();
    let read = read.and_then(|read| <[f64; N]>::try_from(read).ok());
    read.ok_or_else(|| Misuse(format!("{option} {text}: {N} numbers are expected, such as {example}")))
}
