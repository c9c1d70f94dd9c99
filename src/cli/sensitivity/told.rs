//! What a sensitivity tells: a table for the terminal, CSV, Parquet and JSON, a row for each summary and number.
//!
//! What is not known is an empty cell or null. Absent: how it is found.

use anyhow::{Context, Result, anyhow};
use phytomer::simulate::Simulator;
use phytomer_fits::sensitivity::{Effect, Evaluation, Indices};
use phytomer_outputs::cells::{self, Written};
use phytomer_outputs::destination::Destination;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// A number with what it does to a summary.
pub struct OfNumber {
    /// Its path.
    pub name: String,
    /// Its range.
    pub limits: [f64; 2],
    /// The screening.
    pub effect: Effect,
    /// The indices; `None` where it was not kept.
    pub indices: Option<Indices>,
}

/// A summary with all numbers.
pub struct OfSummary {
    /// Its name.
    pub name: String,
    /// The numbers, the one with the largest share first.
    pub numbers: Vec<OfNumber>,
}

/// All that is told.
pub struct Told {
    species: String,
    plants: u32,
    /// The summaries.
    pub summaries: Vec<OfSummary>,
    /// The share of the seed's noise in the variance of each summary, with its interval.
    pub noise: Vec<Option<(f64, [f64; 2])>>,
    /// What is to be known.
    pub notes: Vec<String>,
}

/// A summary, a number, and the values of [`COLUMNS`].
type Row<'a> = (&'a OfSummary, &'a OfNumber, [Option<f64>; 14]);

/// The columns of numbers in files, in this order.
const COLUMNS: [&str; 14] = [
    "low",
    "high",
    "effect_size",
    "effect_size_low",
    "effect_size_high",
    "effect_spread",
    "first_order",
    "first_order_low",
    "first_order_high",
    "total",
    "total_low",
    "total_high",
    "noise_share",
    "noise_share_high",
];

impl Told {
    /// What is told of summaries of plants, before anything is known.
    pub fn of(simulator: &Simulator, names: &[String], notes: Vec<String>) -> Self {
        let species = simulator.numbers().species().about.name.clone();
        let noise = vec![None; names.len()];
        Self { species, plants: simulator.plants(), summaries: Vec::new(), noise, notes }
    }

    /// Notes how many simulations have no value of each summary, with the reason of the first.
    pub fn lack(
        &mut self,
        design: &[Evaluation],
        found: &[Option<Vec<f64>>],
        simulator: &Simulator,
        seed: impl Fn(&Evaluation) -> u64,
    ) {
        for (of, summary) in simulator.asked().iter().enumerate() {
            let has = |own: &Option<Vec<f64>>| own.as_ref().is_some_and(|own| own[of].is_finite());
            let lacking = found.iter().filter(|own| !has(own)).count();
            let Some((first, _)) = design.iter().zip(found).find(|(_, own)| !has(own)) else { continue };
            let values = simulator.values(&first.at);
            let why = simulator.lack(of, &values, seed(first)).map_or_else(String::new, |why| format!(": {why}"));
            let at = simulator.varied().iter().zip(&values).map(|(own, value)| format!("{} = {value:.4}", own.name));
            let (at, all): (Vec<String>, usize) = (at.take(4).collect(), found.len());
            let words = format!("{lacking} of {all} simulations are left out{why} ({})", at.join(", "));
            self.notes.push(format!("{}: {words}", summary.name));
        }
    }

    /// The rows of the table.
    pub fn rows(&self) -> usize {
        self.summaries.iter().map(|summary| summary.numbers.len()).sum()
    }

    /// The rows of files.
    fn each(&self) -> Vec<Row<'_>> {
        let mut rows = Vec::with_capacity(self.rows());
        for (summary, noise) in self.summaries.iter().zip(&self.noise) {
            rows.extend(summary.numbers.iter().map(|own| (summary, own, values(own, *noise))));
        }
        rows
    }

    /// The table for a terminal.
    pub fn as_text(&self) -> String {
        let mut text = String::new();
        for (summary, noise) in self.summaries.iter().zip(&self.noise) {
            let wide = summary.numbers.iter().map(|own| own.name.len()).max().unwrap_or(6).max(6);
            let plants = super::super::amounts::of(self.plants.into(), "plant");
            let _ = writeln!(text, "{} of {}, {plants} a simulation", summary.name, self.species);
            let names = ["range", "effect (95 %)", "spread", "first (95 %)", "total (95 %)"];
            let [range, effect, spread, first, total] = names;
            let _ = writeln!(text, "  {:<wide$}  {range:<22}{effect:<28}{spread:<10}{first:<26}{total}", "number");
            for own in &summary.numbers {
                let range = format!("{}..{}", short(own.limits[0]), short(own.limits[1]));
                let effect = within(own.effect.size, own.effect.size_within, short);
                let share = |value: f64| format!("{value:.3}");
                let index = |of: fn(&Indices) -> (f64, [f64; 2])| {
                    own.indices.as_ref().map_or_else(|| "-".to_owned(), |own| within(of(own).0, of(own).1, share))
                };
                let (first, total) =
                    (index(|own| (own.first, own.first_within)), index(|own| (own.total, own.total_within)));
                let spread = short(own.effect.spread);
                let line = format!("  {:<wide$}  {range:<22}{effect:<28}{spread:<10}{first:<26}{total}", own.name);
                let _ = writeln!(text, "{}", line.trim_end());
            }
            if let Some((share, limits)) = noise {
                let noise = within(*share, *limits, |value| format!("{value:.3}"));
                let _ = writeln!(text, "  the seed's share of the variance: {noise}");
            }
            text.push('\n');
        }
        self.notes.iter().for_each(|note| _ = writeln!(text, "note: {note}"));
        text
    }

    /// All as JSON.
    pub fn as_json(&self) -> Value {
        let of = |(summary, noise): (&OfSummary, &Option<(f64, [f64; 2])>)| {
            let numbers = summary.numbers.iter().map(|own| {
                let mut object = json!({"number": own.name});
                COLUMNS.iter().zip(values(own, None)).take(12).for_each(|(name, value)| object[*name] = json!(value));
                object
            });
            json!({
                "summary": summary.name, "numbers": numbers.collect::<Vec<_>>(),
                "noise_share": noise.map(|own| own.0), "noise_share_interval": noise.map(|own| own.1),
            })
        };
        let of: Vec<Value> = self.summaries.iter().zip(&self.noise).map(of).collect();
        json!({"species": self.species, "plants": self.plants, "of": of, "notes": self.notes})
    }

    /// Writes the table in the format of a file's ending; CSV where it has none.
    ///
    /// # Errors
    /// A failed write.
    pub fn write(&self, path: &Path) -> Result<()> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
        let text = match ending.as_str() {
            "parquet" => return self.write_parquet(path),
            "json" => format!("{:#}\n", self.as_json()),
            _ => self.as_csv(),
        };
        let mut file = Destination::create(path)?;
        file.write_all(text.as_bytes()).with_context(|| format!("cannot write {}", path.display()))?;
        file.finish()?;
        Ok(())
    }

    fn as_csv(&self) -> String {
        let quoted = |text: &str| match text.contains([',', '"', '\n']) {
            true => format!("\"{}\"", text.replace('"', "\"\"")),
            false => text.to_owned(),
        };
        let mut text = format!("summary,number,{}\n", COLUMNS.join(","));
        for (summary, own, values) in self.each() {
            let cells = values.map(|value| value.map_or_else(String::new, |value| value.to_string()));
            let _ = writeln!(text, "{},{},{}", quoted(&summary.name), quoted(&own.name), cells.join(","));
        }
        text
    }

    fn write_parquet(&self, path: &Path) -> Result<()> {
        let rows = self.each();
        let texts = |of: &dyn Fn(&Row<'_>) -> String| Written::Texts(rows.iter().map(of).collect());
        let mut columns =
            vec![("summary", texts(&|row| row.0.name.clone())), ("number", texts(&|row| row.1.name.clone()))];
        columns.extend(
            COLUMNS
                .iter()
                .enumerate()
                .map(|(place, name)| (*name, Written::Numbers(rows.iter().map(|row| row.2[place]).collect()))),
        );
        cells::write(path, columns).map_err(|problem| anyhow!(problem))
    }
}

/// The values of [`COLUMNS`].
fn values(own: &OfNumber, noise: Option<(f64, [f64; 2])>) -> [Option<f64>; 14] {
    let (effect, limits) = (own.effect, own.effect.size_within);
    let index = |of: fn(&Indices) -> f64| own.indices.as_ref().map(of);
    let values = [
        Some(own.limits[0]),
        Some(own.limits[1]),
        Some(effect.size),
        Some(limits[0]),
        Some(limits[1]),
        Some(effect.spread),
        index(|own| own.first),
        index(|own| own.first_within[0]),
        index(|own| own.first_within[1]),
        index(|own| own.total),
        index(|own| own.total_within[0]),
        index(|own| own.total_within[1]),
        noise.map(|noise| noise.0),
        noise.map(|noise| noise.1[1]),
    ];
    values.map(|value| value.filter(|value| value.is_finite()))
}

/// "0.31 (0.25 to 0.38)".
fn within(value: f64, [low, high]: [f64; 2], shown: impl Fn(f64) -> String) -> String {
    match value.is_finite() {
        true => format!("{} ({} to {})", shown(value), shown(low), shown(high)),
        false => "-".to_owned(),
    }
}

/// Four digits.
fn short(value: f64) -> String {
    match value.abs() {
        _ if !value.is_finite() => "-".to_owned(),
        0.0 => "0".to_owned(),
        size if !(1e-3..1e5).contains(&size) => format!("{value:.2e}"),
        size if size >= 100.0 => format!("{value:.1}"),
        size if size >= 1.0 => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    }
}
