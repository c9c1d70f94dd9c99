//! A file that may be broken, taken the way of `phytomer grow`: by the test of mutations and by the fuzz targets.
//!
//! A broken species grows under a small sound scenario. A broken scenario without faults may still ask for a long run:
//! then the numbers of plants, ages and components are lowered in the checked scenario, as `--plants` does it. Absent:
//! how files are broken.

#![allow(dead_code, reason = "each program uses a part of it")]

use phytomer::config::scenario::stand::Layout;
use phytomer::config::scenario::{All, Laid, MeshAges, MeshPlants, Record};
use phytomer::config::{Report, Resolved, Scenario};
use phytomer::run::{self, Outcome, Progress, Settings};
use std::path::Path;

/// The most treatments, plants, ages and components of a mutant without faults; larger numbers are lowered.
const MOST_TREATMENTS: usize = 2;
const MOST_PLANTS: u32 = 2;
/// The most members of a plot that is a stand; a larger stand is one plant.
const MOST_MEMBERS: u32 = 12;
const MOST_AGES: u32 = 12;
const MOST_COMPONENTS: u32 = 2_000;

/// The scenario of a broken species, without the species.
pub const SCENARIO: &str = r#"
name = "mutant"
plants = 2
seed = 7
ages = { until = 8, record = { every = 4 } }
meshes = { sides = 3 }
"#;

/// A report has at least one fault, and as many in each of its forms.
pub fn assert_tells(report: &Report) {
    assert!(!report.faults.is_empty(), "a report without faults");
    assert_eq!(report.records().len(), report.faults.len());
    assert!(report.render(false).ends_with(&format!("{}\n", report.summary())));
}

/// Shortens a long run, and stops a large plant soon. Returns whether plants or ages were too many.
pub fn cap(resolved: &mut Resolved) -> bool {
    resolved.treatments.truncate(MOST_TREATMENTS);
    let of_treatments = resolved.treatments.iter_mut().map(|treatment| &mut treatment.scenario);
    of_treatments.for_each(cap_plots);
    let scenario = &mut resolved.scenario;
    let asked_for = (scenario.plants, scenario.ages.until);
    cap_plots(scenario);
    scenario.experiment.replicates = scenario.experiment.replicates.min(2);
    scenario.limits.max_components = scenario.limits.max_components.min(MOST_COMPONENTS);
    if !scenario.faults().is_empty() {
        // The scenario names plants or ages that have been removed.
        scenario.ages.record = Record::All(All::All);
        if let Some(meshes) = &mut scenario.meshes {
            (meshes.ages, meshes.plants) = (MeshAges::default(), MeshPlants::default());
        }
    }
    assert_eq!(scenario.faults(), []);
    (scenario.plants, scenario.ages.until) != asked_for
}

/// Whole plots, small ones where they are stands, of which the last plant is sown before the last tick; events and
/// attacks begin by the last tick.
fn cap_plots(scenario: &mut Scenario) {
    if scenario.stand.is_some() && scenario.members() > MOST_MEMBERS {
        (scenario.stand, scenario.laid) = (None, Laid::default());
    }
    let members = scenario.members();
    scenario.plants = scenario.plants.min((MOST_PLANTS / members).max(1) * members);
    scenario.ages.until = scenario.ages.until.min(MOST_AGES);
    let last_sowing = scenario.ages.until - 1;
    scenario.member.iter_mut().for_each(|member| member.sown = member.sown.min(last_sowing));
    if let Some(Layout::Places(places)) = scenario.stand.as_mut().map(|stand| &mut stand.layout) {
        places.at.iter_mut().for_each(|place| place.sown = place.sown.map(|sown| sown.min(last_sowing)));
        scenario.laid = Laid::default();
    }
    let last = scenario.ages.until;
    for event in &mut scenario.event {
        let times = [&mut event.tick, &mut event.age, &mut event.until];
        times.into_iter().flatten().for_each(|time| *time = (*time).min(last));
    }
    scenario.pest.iter_mut().for_each(|pest| pest.ages = pest.ages.map(|ages| ages.map(|age| age.min(last))));
}

/// Grows a scenario without faults, in one thread.
pub fn grown(resolved: &Resolved, folder: &Path) -> Outcome {
    let settings = Settings { threads: 1, ..Settings::in_folder(folder) };
    run::run(resolved, &settings, &Progress::default()).expect("a scenario that is right grows")
}
