//! `sensitivity`: which numbers of a species matter for what its plants become, by the screening of Morris and the
//! indices of Sobol'.
//!
//! The numbers that matter most in the screening have indices; the others stay as the species states them. Absent:
//! designs and estimators, which are `phytomer_fits::sensitivity`'s, growth (`phytomer::simulate`), and the tables
//! (`told`).

mod told;

use super::out::{self, Format};
use super::simulated::{Simulating, Work, declined};
use super::{Misuse, Verdict, terminal};
use anyhow::Result;
use clap::Args;
use phytomer::simulate::Simulator;
use phytomer::simulate::summaries::{self, Summary};
use phytomer_fits::sensitivity::{
    Effect, Evaluation, Indices, morris_design, morris_effects, sobol_design, sobol_indices,
};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde_json::json;
use std::path::PathBuf;
use told::{OfNumber, OfSummary, Told};

/// Tell which numbers of a species matter for its plants: Morris, then Sobol.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer sensitivity coffee --of height_m@48 --vary order.1.pause=0.02..0.3 --vary order.2.pause=0.3..0.7
  phytomer sensitivity my_species.toml --of height_m@60 --of \"sd(leaves)@60\"    every number with a `prior`
  phytomer sensitivity coffee --of living@144 --points 256 --out sensitivity.csv
  phytomer sensitivity coffee --of living@144 --points 256 --out sensitivity.csv --resume

A summary is a column of `summary` at an age (height_m@60), its deviation among plants (sd(height_m)@60), the share of
living plants (living@60), or a measure that tells one number (nodes-per-axis(order=2)@60; `phytomer measure --list`).
A path has the keys of the species file; places in lists count from 1, so order.1 is the trunk. Without --vary all
numbers with a `prior` are varied, and where there are none, all numbers by a tenth of themselves.

The table has, for each summary and number: the mean size and the spread of elementary effects over the range (Morris),
then, for the --keep numbers of the largest effects, the first-order and the total share of the variance (Sobol, by the
estimators of Saltelli and Jansen), with intervals of 95 % by bootstrap; and for each summary the share of the variance
that is the seed's. Plants of one point share their draws, whatever the numbers are. docs/statistics.md has the formulas.")]
pub struct Sensitivity {
    /// The species: the name of a shipped one, or a file.
    #[arg(value_name = "SPECIES")]
    species: String,
    /// A summary of the plants at an age, such as height_m@60.
    #[arg(long, value_name = "SUMMARY@AGE", required = true)]
    of: Vec<String>,
    #[command(flatten)]
    simulating: Simulating,
    /// The random ways of the screening; each takes one simulation more than there are numbers.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(4..=10_000))]
    ways: u32,
    /// The base points of the indices, best a power of 2; each takes three simulations more than numbers are kept. 0
    /// leaves the indices out.
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(0..=65_536))]
    points: u32,
    /// The most numbers that have indices.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=100))]
    keep: u32,
    /// Write the table: .csv, .parquet or .json.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// As one JSON object on stdout.
    #[arg(long)]
    json: bool,
}

const FORMATS: [Format; 3] = [
    Format { name: "CSV", extension: "csv" },
    Format { name: "Parquet", extension: "parquet" },
    Format { name: "JSON", extension: "json" },
];

/// The plants of a simulation where none are said.
const PLANTS: u32 = 4;

/// By how large a share of itself each number is varied where none is named.
const SHARE: f64 = 0.1;

impl Sensitivity {
    pub fn obey(self) -> Result<Verdict> {
        self.check()?;
        let asked: Result<Vec<Summary>, String> = self.of.iter().map(|name| summaries::read(name)).collect();
        let asked = asked.map_err(|problem| Misuse(format!("--of {problem}")))?;
        let plants = self.simulating.plants.unwrap_or(PLANTS);
        let mut notes = Vec::new();
        let ready = Simulator::of(&self.species, asked, plants).and_then(|mut simulator| {
            if !self.simulating.vary(&mut simulator)? {
                let refused = simulator.vary_all(SHARE);
                notes.push(format!("every number is varied by {:.0} % of itself; name some by --vary", 100.0 * SHARE));
                if refused > 0 {
                    notes.push(format!("the model refuses to have {refused} numbers varied alone; they stay"));
                }
            }
            Ok(simulator)
        });
        let simulator = match ready {
            Ok(simulator) => simulator,
            Err(unready) => return declined(unready, self.json),
        };
        let of = self.identity(&simulator)?;
        let work = Work::begin(simulator, self.out.as_deref(), &of, &self.simulating)?;
        match self.analysed(&work, notes)? {
            None => Ok(Verdict::Interrupted),
            Some(told) => {
                work.tell(&self.simulating);
                self.finish(&told)?;
                work.finish()?;
                Ok(Verdict::Done)
            }
        }
    }

    fn check(&self) -> Result<()> {
        let Some(path) = &self.out else { return Ok(()) };
        out::check(path, "sensitivity", &FORMATS)?;
        if phytomer_outputs::destination::is_stdout(path) {
            return Err(Misuse("--out -: name a file; --json writes to stdout".to_owned()).into());
        }
        Ok(())
    }

    /// All that the simulations depend on.
    fn identity(&self, simulator: &Simulator) -> Result<String> {
        let varied: Vec<_> = simulator.varied().iter().map(|own| json!([own.name, own.limits])).collect();
        Ok(json!({
            "species": simulator.numbers().species().to_json()?, "varied": varied, "of": self.of,
            "plants": simulator.plants(), "seed": self.simulating.seed(), "version": env!("CARGO_PKG_VERSION"),
        })
        .to_string())
    }

    /// The screening, then the indices; `None` where it was stopped.
    fn analysed(&self, work: &Work, notes: Vec<String>) -> Result<Option<Told>> {
        let simulator = &work.simulator;
        let (factors, summaries) = (simulator.varied().len(), self.of.len());
        let seed = self.simulating.seed();
        let misuse = |problem: phytomer_fits::Problem| Misuse(problem.to_string());
        let ways = morris_design(factors, self.ways as usize, seed).map_err(misuse)?;
        let kept = factors.min(self.keep as usize);
        let about = ways.len() as u64 + u64::from(self.points) * (kept as u64 + 3);
        let all = |design: &[Evaluation]| -> Vec<Option<Vec<f64>>> {
            design.par_iter().map(|own| work.simulate(&simulator.values(&own.at), mixed(seed, own.seed))).collect()
        };
        let Some(screened) = work.run(&self.simulating, about, || all(&ways))? else { return Ok(None) };
        let effects: Vec<Vec<Effect>> =
            (0..summaries).map(|of| morris_effects(&ways, &results(&screened, of), seed)).collect();
        let chosen = largest(&effects, kept);
        let mut told = Told::of(simulator, &self.of, notes);
        told.lack(&ways, &screened, simulator, |own| mixed(seed, own.seed));
        let mut indices = vec![Vec::new(); summaries];
        if self.points > 0 {
            let stated = simulator.stated_shares();
            let design = sobol_design(kept, self.points, seed as u32).map_err(misuse)?;
            let whole: Vec<Evaluation> = design.iter().map(|own| spread(own, &chosen, &stated)).collect();
            let Some(found) = work.run(&self.simulating, about, || all(&whole))? else { return Ok(None) };
            told.lack(&whole, &found, simulator, |own| mixed(seed, own.seed));
            for (of, indices) in indices.iter_mut().enumerate() {
                match sobol_indices(kept, &results(&found, of), seed as u32) {
                    Ok(sobol) => {
                        told.noise[of] = Some((sobol.noise, sobol.noise_within));
                        *indices = chosen.iter().copied().zip(sobol.indices).collect();
                    }
                    Err(problem) => told.notes.push(format!("{}: no indices: {problem}", self.of[of])),
                }
            }
        }
        told.summaries = (0..summaries).map(|of| self.of_summary(simulator, of, &effects[of], &indices[of])).collect();
        Ok(Some(told))
    }

    fn of_summary(
        &self,
        simulator: &Simulator,
        of: usize,
        effects: &[Effect],
        indices: &[(usize, Indices)],
    ) -> OfSummary {
        let number = |(place, effect): (usize, &Effect)| OfNumber {
            name: simulator.varied()[place].name.clone(),
            limits: simulator.varied()[place].limits,
            effect: *effect,
            indices: indices.iter().find(|(own, _)| *own == place).map(|(_, indices)| *indices),
        };
        let mut numbers: Vec<OfNumber> = effects.iter().enumerate().map(number).collect();
        let total = |own: &OfNumber| own.indices.map_or(-1.0, |indices| indices.total);
        numbers.sort_by(|a, b| total(b).total_cmp(&total(a)).then(b.effect.size.total_cmp(&a.effect.size)));
        OfSummary { name: self.of[of].clone(), numbers }
    }

    fn finish(&self, told: &Told) -> Result<()> {
        match &self.out {
            Some(path) => {
                told.write(path)?;
                if !self.simulating.quiet {
                    told.notes.iter().for_each(|note| terminal::say(&format!("note: {note}")));
                    out::tell(path, &super::amounts::of(told.rows() as u64, "row"))?;
                }
            }
            None if !self.json => terminal::put(told.as_text().trim_end())?,
            None => {}
        }
        if self.json { terminal::put_json(&told.as_json()) } else { Ok(()) }
    }
}

/// The seed of the plants of a way or a point.
fn mixed(seed: u64, own: u64) -> u64 {
    seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ own
}

/// The results of a summary; NaN where a simulation has none.
fn results(found: &[Option<Vec<f64>>], of: usize) -> Vec<f64> {
    found.iter().map(|own| own.as_ref().map_or(f64::NAN, |own| own[of])).collect()
}

/// The places of so many numbers with the largest effects, each summary counting alike, in the order of the numbers.
fn largest(effects: &[Vec<Effect>], kept: usize) -> Vec<usize> {
    let factors = effects.first().map_or(0, Vec::len);
    let share = |place: usize| {
        let of = |effects: &Vec<Effect>| {
            let most = effects.iter().map(|effect| effect.size).filter(|size| size.is_finite()).fold(0.0, f64::max);
            if most > 0.0 && effects[place].size.is_finite() { effects[place].size / most } else { 0.0 }
        };
        effects.iter().map(of).fold(0.0, f64::max)
    };
    let mut places: Vec<(f64, usize)> = (0..factors).map(|place| (share(place), place)).collect();
    places.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut places: Vec<usize> = places.into_iter().take(kept).map(|(_, place)| place).collect();
    places.sort_unstable();
    places
}

/// An evaluation of the chosen numbers, with all others as they are stated.
fn spread(own: &Evaluation, chosen: &[usize], stated: &[f64]) -> Evaluation {
    let mut at = stated.to_vec();
    chosen.iter().zip(&own.at).for_each(|(place, share)| at[*place] = *share);
    Evaluation { at, seed: own.seed }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_effects_of_all_summaries_are_kept() {
        let effect = |size: f64| Effect { size, size_within: [size; 2], spread: 0.0 };
        let effects = [vec![effect(1.0), effect(100.0), effect(2.0)], vec![effect(0.5), effect(f64::NAN), effect(0.1)]];
        assert_eq!(largest(&effects, 2), [0, 1]);
        let own = Evaluation { at: vec![0.1, 0.9], seed: 3 };
        assert_eq!(spread(&own, &[0, 2], &[0.5; 3]).at, [0.1, 0.5, 0.9]);
    }
}
