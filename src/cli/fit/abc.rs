//! `fit --law abc`: the numbers of a species from summaries of plants, by simulation and without a likelihood.
//!
//! Numbers with a prior are drawn, plants are grown, and those whose summaries are near the observed ones are kept
//! (`phytomer_fits::abc`). Absent: the sampler, growth (`phytomer::simulate`), and the files that every fit writes.

use super::super::simulated::{Simulating, Work, declined};
use super::super::{Misuse, Verdict, terminal};
use super::{Fit, told};
use anyhow::{Result, anyhow};
use clap::Args;
use phytomer::simulate::observed::Observed;
use phytomer::simulate::summaries::{self, Summary};
use phytomer::simulate::{Simulator, Unready};
use phytomer_config::Estimated;
use phytomer_fits::abc::{Asked, Posterior, abc};
use phytomer_fits::calibration::{ranks, uniformity};
use phytomer_fits::data::{Fault, observed};
use phytomer_fits::outcome::Outcome;
use phytomer_fits::{Estimate, Problem, Test, special, stated};
use serde_json::{Value, json};
use std::path::Path;

/// What only `--law abc` has.
#[derive(Debug, Args)]
pub struct Abc {
    /// With --law abc and a run folder as DATA: a summary that is compared, such as height_m@60.
    #[arg(long, value_name = "SUMMARY@AGE")]
    summary: Vec<String>,
    /// With --law abc: particles that are kept of a generation [default: 200].
    #[arg(long, value_parser = clap::value_parser!(u32).range(20..=1_000_000))]
    particles: Option<u32>,
    /// With --law abc: the most generations [default: 6].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=100))]
    generations: Option<u32>,
    #[command(flatten)]
    simulating: Simulating,
}

/// The plants of a simulation where nobody says how many were observed.
const PLANTS: u32 = 20;

/// The most plants of a simulation, unless they are asked for.
const MOST_PLANTS: usize = 200;

/// An interval wider than this share of the prior tells little.
const WIDE: f64 = 0.8;

impl Abc {
    /// An option of ABC that was given.
    pub fn given(&self) -> Option<&'static str> {
        let options = [
            (!self.summary.is_empty(), "--summary"),
            (self.particles.is_some(), "--particles"),
            (self.generations.is_some(), "--generations"),
        ];
        options.into_iter().find(|(given, _)| *given).map(|(_, name)| name).or_else(|| self.simulating.given())
    }

    fn asked(&self, simulator: &Simulator) -> Asked {
        Asked {
            priors: simulator.varied().iter().map(|varied| varied.limits).collect(),
            particles: self.particles.unwrap_or(200) as usize,
            generations: self.generations.unwrap_or(6),
            seed: self.simulating.seed(),
        }
    }
}

/// What was observed.
struct Measured {
    summaries: Vec<Summary>,
    values: Vec<f64>,
    plants: Option<usize>,
    hash: String,
}

/// Fits the numbers that have a prior.
pub fn fit(of: &Fit, path: &Path) -> Result<Verdict> {
    let Some(base) = &of.base else {
        return Err(Misuse("--law abc needs the species that is simulated: --base SPECIES".to_owned()).into());
    };
    let measured = match measured(of, path)? {
        Ok(measured) => measured,
        Err(faults) => return super::decline(&faults, of.json),
    };
    let simulator = match ready(of, base, &measured) {
        Ok(simulator) => simulator,
        Err(unready) => return declined(unready, of.json),
    };
    let asked = of.abc.asked(&simulator);
    let identity = identity(&simulator)?;
    let work = Work::begin(simulator, of.out.as_deref(), &identity, &of.abc.simulating)?;
    let a_fit = asked.particles as u64 * u64::from(asked.generations + 1);
    let simulate = |values: &[f64], seed: u64| work.simulate(values, seed);
    let found = work.run(&of.abc.simulating, a_fit, || abc(&simulate, &measured.values, &asked))?;
    let posterior = match found {
        None => return Ok(Verdict::Interrupted),
        Some(Ok(posterior)) => posterior,
        Some(Err(problem)) => return of.not_estimated(path, &reason(&problem, &work.simulator, &asked)),
    };
    let checked = match of.check {
        None => None,
        Some(times) => {
            let about = a_fit * u64::from(times);
            match work.run(&of.abc.simulating, about, || ranks(&simulate, &asked, times))? {
                None => return Ok(Verdict::Interrupted),
                Some(ranks) => Some(ranks.map_err(|problem| anyhow!("--check: {problem}"))?),
            }
        }
    };
    work.tell(&of.abc.simulating);
    let outcome = outcome(&work.simulator, &posterior, &measured);
    let mut object = phytomer_fits::json::object(&outcome, &path.display().to_string(), &measured.hash);
    object["abc"] = as_json(&work.simulator, &posterior, &measured, &asked);
    let tests = checked.as_ref().map(|ranks| calibrated(&work.simulator, ranks));
    if let (Some(ranks), Some(tests)) = (&checked, &tests) {
        let tests: Vec<Value> =
            tests.iter().map(|t| json!({"name": t.name, "statistic": t.statistic, "df": t.df, "p": t.p})).collect();
        object["check"] = json!({"ranks": ranks, "tests": tests});
    }
    let source = of.source.clone().unwrap_or_else(|| name_of(path));
    let write = |out: &Path| -> Result<Option<Verdict>> {
        let species = species(&work.simulator, &outcome, (out, base), measured.plants, &source)?;
        of.write_files(out, base, species, &object)
    };
    if let Some(verdict) = of.out.as_deref().map(write).transpose()?.flatten() {
        return Ok(verdict);
    }
    if of.json {
        terminal::put_json(&object)?;
    } else {
        terminal::put(&told::table(&outcome))?;
        let lines = tests
            .iter()
            .flatten()
            .map(|t| format!("check: {}: χ² {:.2}, {} df, p {:.3}", t.name, t.statistic, t.df, t.p));
        lines.collect::<Vec<_>>().iter().try_for_each(|line| terminal::put(line))?;
    }
    work.finish()?;
    Ok(Verdict::Done)
}

fn name_of(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// The observed summaries: rows of a table, or those of a run that --summary names.
fn measured(of: &Fit, path: &Path) -> Result<Result<Measured, Vec<Fault>>> {
    if path.is_dir() {
        return of_run(of, path).map(Ok);
    }
    if !of.abc.summary.is_empty() {
        return Err(
            Misuse("--summary is for a run folder as DATA; a table names its summaries itself".to_owned()).into()
        );
    }
    let (table, hash) = match super::load(path)? {
        Ok(loaded) => loaded,
        Err(faults) => return Ok(Err(faults)),
    };
    let table = match of.chosen(table)? {
        Ok(table) => table,
        Err(fault) => return Ok(Err(vec![fault])),
    };
    let rows = match observed::read(&table) {
        Ok(rows) => rows,
        Err(faults) => return Ok(Err(faults)),
    };
    let (mut summaries, mut faults) = (Vec::new(), Vec::new());
    for row in &rows {
        match summaries::read(&row.summary) {
            Ok(summary) => summaries.push(summary),
            Err(problem) => {
                faults.push(table.fault(Some(row.line), problem, "a summary at an age, such as height_m@60"))
            }
        }
    }
    if !faults.is_empty() {
        return Ok(Err(faults));
    }
    let plants = rows.iter().filter_map(|row| row.plants).min().map(|plants| plants as usize);
    let values = rows.iter().map(|row| row.value).collect();
    Ok(Ok(Measured { summaries, values, plants, hash }))
}

fn of_run(of: &Fit, path: &Path) -> Result<Measured> {
    if of.abc.summary.is_empty() {
        let expected = "the summaries of the run that are compared are expected: --summary height_m@60 …";
        return Err(Misuse(format!("{}: {expected}", path.display())).into());
    }
    let read = |name: &String| summaries::read(name).map_err(|problem| Misuse(format!("--summary {problem}")));
    let summaries = of.abc.summary.iter().map(read).collect::<Result<Vec<Summary>, Misuse>>()?;
    let run = Observed::open(path).map_err(|problem| anyhow!(problem))?;
    let values: Result<Vec<f64>, String> = summaries.iter().map(|summary| run.of(summary)).collect();
    let values = values.map_err(|problem| anyhow!(problem))?;
    let plants = run.plants().map_err(|problem| anyhow!(problem))?;
    let hash = super::hash_of(&std::fs::read(path.join("run.json"))?);
    Ok(Measured { summaries, values, plants: Some(plants), hash })
}

/// The simulator with its priors.
fn ready(of: &Fit, base: &str, measured: &Measured) -> Result<Simulator, Unready> {
    let plants =
        of.abc.simulating.plants.unwrap_or_else(|| measured.plants.map_or(PLANTS, |n| n.min(MOST_PLANTS) as u32));
    let mut simulator = Simulator::of(base, measured.summaries.clone(), plants)?;
    if of.abc.simulating.vary(&mut simulator)? {
        return Ok(simulator);
    }
    Err(Unready::Asked(format!(
        "{base}: no number has a prior: give some in the species, such as pause = {{ value = 0.1, prior = {{ value = [0.02, 0.3] }} }}, \
         or on the command line: --vary order.1.pause=0.02..0.3"
    )))
}

/// All that the simulations depend on.
fn identity(simulator: &Simulator) -> Result<String> {
    let varied: Vec<Value> = simulator.varied().iter().map(|own| json!([own.name, own.limits, own.step])).collect();
    let names: Vec<&str> = simulator.asked().iter().map(|summary| summary.name.as_str()).collect();
    Ok(json!({
        "species": simulator.numbers().species().to_json()?, "varied": varied, "of": names,
        "plants": simulator.plants(), "version": env!("CARGO_PKG_VERSION"),
    })
    .to_string())
}

/// Why there is no posterior; where nothing could be simulated, what the middle of the priors says.
fn reason(problem: &Problem, simulator: &Simulator, asked: &Asked) -> String {
    let middle: Vec<f64> = asked.priors.iter().map(|[low, high]| 0.5 * (low + high)).collect();
    let lack = (0..simulator.asked().len()).find_map(|of| simulator.lack(of, &middle, asked.seed));
    lack.map_or_else(|| problem.to_string(), |lack| format!("{problem} (at the middle of the priors: {lack})"))
}

fn outcome(simulator: &Simulator, posterior: &Posterior, measured: &Measured) -> Outcome {
    let numbers = 0..simulator.varied().len();
    let estimate = |place: usize| {
        let at = |share: f64| simulator.rounded(place, posterior.quantile(place, share));
        let mut estimate = Estimate::bare(&simulator.varied()[place].name, at(0.5)).within(at(0.025), at(0.975));
        estimate.error = Some(posterior.moments(place).1);
        estimate
    };
    let estimates: Vec<Estimate> = numbers.clone().map(estimate).collect();
    let covariance = numbers.clone().map(|a| numbers.clone().map(|b| posterior.covariance(a, b)).collect()).collect();
    let tests: Vec<Test> = (0..measured.summaries.len()).map(|place| predicted(posterior, measured, place)).collect();
    let mut notes = vec![format!(
        "{} generations; the particles are worth {:.0} of equal weight",
        posterior.generations,
        posterior.effective()
    )];
    for (varied, own) in simulator.varied().iter().zip(&estimates) {
        let width = own.high.unwrap_or(f64::NAN) - own.low.unwrap_or(f64::NAN);
        if width > WIDE * (varied.limits[1] - varied.limits[0]) {
            notes.push(format!("these summaries tell little of {}: its interval is nearly its prior", varied.name));
        }
    }
    let far = tests.iter().filter(|test| test.statistic.abs() > 3.0).count();
    if far > 0 {
        let words = "observed summaries are more than 3 deviations from what is simulated: the model with these priors does not make them";
        notes.push(format!("{far} {words}"));
    }
    let stated =
        estimates.iter().map(|own| stated::Stated { order: 0, key: own.name.clone(), value: own.value.to_string() });
    let stated = stated.collect();
    let fit = phytomer_fits::Fit {
        law: format!("ABC on {}", summaries_in_words(measured.summaries.len())),
        parameters: estimates.len(),
        n: measured.plants.unwrap_or(measured.summaries.len()),
        estimates,
        covariance,
        log_likelihood: None,
        tests,
        notes,
    };
    Outcome { law: None, fits: vec![fit], taken: 0, rivals: 1, tests: Vec::new(), stated }
}

fn summaries_in_words(n: usize) -> String {
    if n == 1 { "1 summary".to_owned() } else { format!("{n} summaries") }
}

/// An observed summary against those of the particles.
fn predicted(posterior: &Posterior, measured: &Measured, place: usize) -> Test {
    let ((mean, sd), observed) = (posterior.simulated(place), measured.values[place]);
    let z = if sd > 0.0 {
        (observed - mean) / sd
    } else if observed == mean {
        0.0
    } else {
        f64::INFINITY
    };
    let name = format!("{}: observed {observed:.4}, simulated {mean:.4} ± {sd:.4}; z", measured.summaries[place].name);
    Test { name, statistic: z, df: 0.0, p: 2.0 * special::normal_below(-z.abs()) }
}

fn as_json(simulator: &Simulator, posterior: &Posterior, measured: &Measured, asked: &Asked) -> Value {
    let summaries = measured.summaries.iter().enumerate().map(|(place, summary)| {
        let (mean, sd) = posterior.simulated(place);
        json!({"summary": summary.name, "observed": measured.values[place], "simulated": mean, "sd": sd})
    });
    let priors = simulator.varied().iter().map(|own| json!({"number": own.name, "prior": own.limits}));
    json!({
        "particles": posterior.particles.len(), "effective": posterior.effective(), "within": posterior.within,
        "generations": posterior.generations, "plants": simulator.plants(), "seed": asked.seed,
        "priors": priors.collect::<Vec<_>>(), "summaries": summaries.collect::<Vec<_>>(),
    })
}

/// χ² of the ranks of each number.
fn calibrated(simulator: &Simulator, ranks: &[Vec<f64>]) -> Vec<Test> {
    let of = |(place, varied): (usize, &phytomer::simulate::Varied)| {
        uniformity(&varied.name, &ranks.iter().map(|own| own[place]).collect::<Vec<f64>>())
    };
    simulator.varied().iter().enumerate().filter_map(of).collect()
}

/// The species with the estimates.
fn species(
    simulator: &Simulator,
    outcome: &Outcome,
    (out, base): (&Path, &str),
    n: Option<usize>,
    source: &str,
) -> Result<String> {
    let name = out.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let taken = outcome.taken();
    let found = simulator.places().into_iter().zip(&taken.estimates).map(|(number, own)| Estimated {
        number,
        value: own.value,
        interval: [own.low.unwrap_or(own.value), own.high.unwrap_or(own.value)],
    });
    let found: Vec<Estimated> = found.collect();
    let source = format!("{}: {source}", taken.law);
    let text = simulator.numbers().overlay(base, &name, &found, n, &source).map_err(|problem| anyhow!(problem))?;
    Ok(format!("# Fitted by phytomer fit: {}.\n# Everything else is inherited.\n{text}", taken.law))
}
