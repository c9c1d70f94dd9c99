//! `shade`: hours of shade on the zones of a plan, and the best trees for its spots.
//!
//! Absent: reading the plan (`phytomer_config::plan`), and the hours (`phytomer::shade`).

use super::{Misuse, Verdict, amounts, bar, interrupt, refuse, terminal};
use anyhow::Result;
use clap::Args;
use phytomer::shade::{Arranged, Check, Ground, ShadeError, Written, arrange, month_in_words, write};
use phytomer_config::plan::{Arrange, Plan, ResolvedPlan, plan};
use phytomer_shade::{Shade, Watch};
use serde_json::{Value as Json, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The place of the year after its months.
const YEAR: usize = 12;

/// Tell how long each zone of a plan lies in the shade of buildings and trees, month by month.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer shade my_court/site.toml
  phytomer shade my_court/site.toml --out court --month 7 --overwrite
  phytomer shade my_court/site.toml --arrange --out planted --overwrite --json

The plan is a TOML file: a latitude, zones, buildings as boxes, trees of any species and age; docs/shade.md has an
example. The folder gets shade.parquet, a row for each zone and month, and plan.svg; with --arrange also arranged.svg
and arrangement.parquet. --arrange chooses a candidate for each spot of the plan's [arrange]: exactly, by the sum of
the hours that each would add by itself, and then checks the shadows together. Exit code 3 where the plan is wrong or
no arrangement keeps its rules.")]
pub struct ShadeVerb {
    /// The file of the plan.
    #[arg(value_name = "SITE.toml")]
    site: String,
    /// The folder that is written; the name of the plan if not given.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Write over the hours that are in the folder.
    #[arg(long)]
    overwrite: bool,
    /// Choose candidates for the spots of the plan.
    #[arg(long)]
    arrange: bool,
    /// The month that is drawn, 1 to 12; the mean of the year if not given.
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=12))]
    month: Option<u8>,
    /// Show no progress.
    #[arg(long, short)]
    quiet: bool,
    /// What was found, as one JSON object.
    #[arg(long)]
    json: bool,
}

/// What was found.
struct Found {
    planned: Shade,
    arranged: Option<Arranged>,
    files: Written,
}

impl ShadeVerb {
    pub fn obey(self) -> Result<Verdict> {
        let resolved = match plan(&self.site) {
            Ok(resolved) => resolved,
            Err(report) => return refuse(&report, self.json),
        };
        let asked = resolved.plan.arrange.as_ref();
        if self.arrange && asked.is_none() {
            return Err(Misuse(format!("--arrange: {} has no [arrange] with spots and candidates", self.site)).into());
        }
        let folder = self.out.clone().unwrap_or_else(|| PathBuf::from(plain(&resolved.plan.name)));
        if folder.join("shade.parquet").exists() && !self.overwrite {
            let shown = folder.display();
            return Err(Misuse(format!("{shown} has hours of shade already; say --overwrite, or another --out")).into());
        }
        let watch = Arc::new(Watch::default());
        let (heard, told) = (Arc::clone(&watch), Arc::clone(&watch));
        interrupt::listen(move || heard.is_stopped(), move || told.stop(), "stopping; nothing is written")?;
        match self.find(&resolved, asked.filter(|_| self.arrange), &folder, &watch) {
            Ok(found) => self.tell(&resolved.plan, &folder, &found),
            Err(ShadeError::Wrong(faults)) => refuse(&resolved.report(faults), self.json),
            Err(ShadeError::Stopped(_)) => {
                terminal::say("stopped; nothing was written");
                Ok(Verdict::Interrupted)
            }
            Err(error) => Err(error.into()),
        }
    }

    fn find(
        &self,
        resolved: &ResolvedPlan,
        asked: Option<&Arrange>,
        folder: &Path,
        watch: &Watch,
    ) -> Result<Found, ShadeError> {
        let mut say = |words: &str| {
            if !self.quiet {
                terminal::say(&format!("  {words}"));
            }
        };
        let ground = Ground::of(resolved, &mut say, watch)?;
        let (planned, arranged) = bar::following(watch, self.quiet, || match asked {
            None => ground.hours(&[], &[], watch).map(|planned| (planned, None)).map_err(ShadeError::from),
            Some(asked) => arrange(&ground, asked, &mut say, watch).map(|(planned, best)| (planned, Some(best))),
        })?;
        let month = self.month.map_or(YEAR, |month| usize::from(month) - 1);
        let files = write(&ground, &planned, asked.zip(arranged.as_ref()), folder, month)?;
        Ok(Found { planned, arranged, files })
    }

    fn tell(&self, plan: &Plan, folder: &Path, found: &Found) -> Result<Verdict> {
        if self.json {
            terminal::put_json(&as_json(plan, folder, found))?;
            return Ok(Verdict::Done);
        }
        let shade = found.arranged.as_ref().map_or(&found.planned, |arranged| &arranged.shade);
        for (zone, months) in plan.zone.iter().zip(&shade.zones) {
            let hours = |month: usize| months[month].shade_h();
            let by = |a: &usize, b: &usize| hours(*a).total_cmp(&hours(*b));
            let [least, most] = [(0..YEAR).min_by(by), (0..YEAR).max_by(by)].map(Option::unwrap_or_default);
            terminal::put(&format!(
                "{}: {:.2} h of shade a day, from {:.2} in {} to {:.2} in {}, of {:.2} h of sun; within about {:.2} h",
                zone.name,
                hours(YEAR),
                hours(least),
                month_in_words(least),
                hours(most),
                month_in_words(most),
                months[YEAR].sun_h,
                months[YEAR].error_h,
            ))?;
        }
        match (&found.arranged, &plan.arrange) {
            (Some(arranged), Some(asked)) => tell_arranged(plan, asked, arranged)?,
            _ => Check::all(plan, &found.planned).iter().try_for_each(|check| tell_check(plan, check, false))?,
        }
        found.files.iter().try_for_each(|file| terminal::put(&folder.join(file).display().to_string()))?;
        Ok(Verdict::Done)
    }
}

fn tell_arranged(plan: &Plan, asked: &Arrange, arranged: &Arranged) -> Result<()> {
    for (spot, chosen) in asked.spot.iter().zip(&arranged.chosen) {
        let chosen = chosen.map_or("nothing", |chosen| &asked.candidate[chosen].name);
        terminal::put(&format!("{}: {chosen}", spot.name))?;
    }
    let budget = asked.budget.map(|budget| format!(" of {budget}")).unwrap_or_default();
    let [summed, together] = arranged.added_h;
    terminal::put(&format!("cost {}{budget}", arranged.cost))?;
    terminal::put(&format!(
        "weighted hours a day that they add: {summed:.3} by their sum, {together:.3} by their shadows together"
    ))?;
    if arranged.refused > 0 {
        let refused = amounts::of(arranged.refused as u64, "arrangement");
        terminal::put(&format!("{refused} with a larger sum refused: their shadows together miss a least"))?;
    }
    arranged.checks.iter().try_for_each(|check| tell_check(plan, check, true))
}

/// What is allowed in a zone, and what there is.
fn tell_check(plan: &Plan, check: &Check, arranged: bool) -> Result<()> {
    let bounds = [("at least", check.least_h), ("at most", check.most_h)];
    let bounds = bounds.into_iter().filter_map(|(words, bound)| bound.map(|bound| format!("{words} {bound}")));
    let hours = if arranged {
        format!("{:.2} h by the sum, {:.2} h by the shadows together", check.summed_h, check.together_h)
    } else {
        format!("{:.2} h", check.planned_h)
    };
    terminal::put(&format!(
        "{}, {}: {hours}; allowed {}: {}",
        plan.zone[check.zone].name,
        month_in_words(check.month),
        bounds.collect::<Vec<String>>().join(" and "),
        if check.holds() { "holds" } else { "does not hold" }
    ))
}

fn as_json(plan: &Plan, folder: &Path, found: &Found) -> Json {
    let zones = |shade: &Shade| -> Vec<Json> {
        let zone = |(zone, months): (&phytomer_config::plan::Zone, &[phytomer_shade::MonthOfZone; 13])| {
            let hours: Vec<f64> = months[..YEAR].iter().map(|month| month.shade_h()).collect();
            let (year, error) = (months[YEAR].shade_h(), months[YEAR].error_h);
            json!({"zone": zone.name, "shade_h": year, "error_h": error, "shade_h_by_month": hours})
        };
        plan.zone.iter().zip(&shade.zones).map(zone).collect()
    };
    let check = |check: &Check| {
        json!({
            "zone": plan.zone[check.zone].name,
            "month": (check.month < YEAR).then_some(check.month + 1),
            "least_h": check.least_h,
            "most_h": check.most_h,
            "planned_h": check.planned_h,
            "summed_h": check.summed_h,
            "together_h": check.together_h,
            "holds": check.holds(),
        })
    };
    let checks = match &found.arranged {
        Some(arranged) => arranged.checks.iter().map(check).collect::<Vec<Json>>(),
        None => Check::all(plan, &found.planned).iter().map(check).collect(),
    };
    let arranged = found.arranged.as_ref().zip(plan.arrange.as_ref()).map(|(arranged, asked)| {
        let spots = asked.spot.iter().zip(&arranged.chosen);
        let spots = spots.map(|(spot, chosen)| {
            json!({"spot": spot.name, "candidate": chosen.map(|chosen| asked.candidate[chosen].name.as_str())})
        });
        json!({
            "spots": spots.collect::<Vec<Json>>(),
            "cost": arranged.cost,
            "added_h_summed": arranged.added_h[0],
            "added_h_together": arranged.added_h[1],
            "refused": arranged.refused,
            "zones": zones(&arranged.shade),
        })
    });
    json!({
        "status": "done",
        "folder": folder.display().to_string(),
        "files": found.files,
        "zones": zones(&found.planned),
        "allowed": checks,
        "arranged": arranged,
    })
}

/// A name for a folder: letters and digits of a plan's name.
fn plain(name: &str) -> String {
    name.chars().map(|letter| if letter.is_alphanumeric() || letter == '-' { letter } else { '_' }).collect()
}
