//! The walk of `docs/from-counts-to-report.md`: its commands, run as they stand on the page, and the numbers that it
//! tells.
//!
//! The measured trunks are outside the project (`absent`). Absent: the statistics, which have tests of their own.

#![cfg(unix)]

#[path = "program/absent.rs"]
mod absent;
mod program;

use program::PROGRAM;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::tempdir;

const PAGE: &str = "docs/from-counts-to-report.md";
const COUNTS: &str = "apple_trunk_axillary_fates.csv";
const FATES: [&str; 5] = ["latent", "short", "long", "floral", "sylleptic"];

/// The commands of the page, block after block.
fn commands(page: &str) -> Vec<&str> {
    page.split("```sh\n").skip(1).map(|block| block.split("```").next().expect("an end")).collect()
}

/// Runs commands as a shell does that finds the program.
fn shell(folder: &Path, commands: &str) {
    let own = Path::new(PROGRAM).parent().expect("a folder").to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths([own].into_iter().chain(std::env::split_paths(&path))).expect("a path");
    let mut shell = Command::new("sh");
    shell.args(["-e", "-c", commands]).current_dir(folder).env("PATH", path).env("NO_COLOR", "1");
    let done = shell.output().expect("a shell");
    assert!(done.status.success(), "{commands}\n{}", String::from_utf8_lossy(&done.stderr));
}

/// The measured trunks of Fuji: fates from the tip.
fn trunks(counts: &str) -> Vec<Vec<usize>> {
    let mut trunks: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for line in counts.lines().filter(|line| line.starts_with("fuji,")) {
        let [_, trunk, _, fate] = line.split(',').collect::<Vec<_>>()[..] else { panic!("{line}") };
        trunks.entry(trunk).or_default().push(fate.parse().expect("a fate"));
    }
    trunks.into_values().collect()
}

/// The rows of a CSV file of a figure: series, place, value.
fn rows(path: &Path) -> Vec<(String, f64, f64)> {
    let text = fs::read_to_string(path).expect("the numbers of a figure");
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        // The name of a measured series has a comma, and so quotes.
        let numbers = cells.iter().rev().take(4).collect::<Vec<_>>();
        let name = cells[..cells.len() - 4].join(",").trim_matches('"').to_owned();
        (name, numbers[3].parse().expect("a place"), numbers[2].parse().expect("a value"))
    };
    text.lines().skip(1).map(row).collect()
}

/// The mean of a row of a table in the page of the report: the cell after the name and the number of units.
fn mean_of(report: &str, name: &str) -> f64 {
    let row = report.split(&format!("<td>{name}</td>")).nth(1).unwrap_or_else(|| panic!("no row of {name}"));
    let cells: Vec<&str> = row.split("<td class=\"number\">").skip(1).map(|of| of.split('<').next().unwrap()).collect();
    cells[1].parse().expect("a mean")
}

#[test]
fn the_commands_of_the_page_go_from_counts_to_a_report() {
    let Some(counts) = absent::measured(COUNTS) else { return };
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE)).expect("the page");
    let folder = tempdir().expect("a folder");
    let folder = folder.path();
    program::write(folder, COUNTS, &counts);
    let commands = commands(&page);
    assert_eq!(commands.len(), 5, "a block a step");
    commands.iter().for_each(|block| shell(folder, block));
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let tells = |words: &str| assert!(page.contains(words), "the page does not tell {words}");

    // The fit: the chain is taken, and the page has its BIC and its runs.
    let fit: Value = serde_json::from_str(&read("fit.json")).expect("JSON");
    assert_eq!(fit["taken"], "chain of 7 zones, latent alone at both ends");
    for fitted in fit["fits"].as_array().expect("fits") {
        tells(&format!("{:.2}", fitted["bic"].as_f64().expect("a BIC")));
    }
    let told = read("fit.txt");
    let runs = told.lines().find(|line| line.contains("runs of equal fates")).expect("the runs");
    assert!(runs.contains("399, expected 432 ± 30"), "{runs}");
    assert!(read("fuji.toml").contains("inherits = \"apple\""));

    // The measures.
    let nodes = read("nodes.txt");
    let trunk: Vec<&str> =
        nodes.lines().find(|line| line.trim_start().starts_with("1 ")).expect("order 1").split_whitespace().collect();
    assert_eq!(format!("{:.1}", trunk[3].parse::<f64>().expect("a mean")), "74.0", "{nodes}");

    // The figures: measured shares by zone are those counted here once more, and the law sums to 1 at each rank.
    let trunks = trunks(&counts);
    assert_eq!(trunks.len(), 15);
    let mut law = [0.0; 60];
    for (fate, word) in FATES.into_iter().enumerate() {
        let rows = rows(&folder.join(format!("figures/fates-1-{word}.csv")));
        for (name, place, share) in &rows {
            let zone = ((place - 3.5) / 6.0) as usize;
            let buds = trunks.iter().flat_map(|trunk| trunk.chunks(6).nth(zone).unwrap_or_default());
            let (of, all) = buds.fold((0, 0), |(of, all), bud| (of + u32::from(*bud == fate), all + 1));
            if name.starts_with("measured") {
                assert!((share - f64::from(of) / f64::from(all)).abs() < 1e-12, "{word} {place}: {share}");
            }
            if name == "law" && *place <= 60.0 {
                law[*place as usize - 1] += share;
            }
        }
        for ending in ["svg", "png", "vl.json"] {
            assert!(folder.join(format!("figures/fates-1-{word}.{ending}")).is_file(), "{word}.{ending}");
        }
    }
    assert!(law.iter().all(|sum| (sum - 1.0).abs() < 1e-9), "{law:?}");

    // The report tells the runs of measured and of grown trunks.
    let report = read("fuji.html");
    assert!(report.contains("<h2>Distributions</h2>") && !report.contains("<script"));
    let runs = |trunk: &Vec<usize>| 1 + trunk.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let counted = trunks.iter().map(runs).sum::<usize>() as f64 / 15.0;
    let (measured, grown) = (mean_of(&report, "measured, fuji.csv"), mean_of(&report, "grown"));
    assert!((measured / counted - 1.0).abs() < 1e-3, "{measured} {counted}");
    tells(&format!("{measured:.1} runs of equal fates"));
    tells(&format!("a grown one {grown:.1}"));
}
