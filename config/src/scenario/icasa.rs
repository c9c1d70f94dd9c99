//! Names of the ICASA dictionary that a scenario does not take as they stand: old names, codes, and names in another
//! table; each with the key that is meant. Capitals make no difference. Keys of the whole run in a level are told too.
//!
//! The dictionary (White et al. 2013, *Computers and Electronics in Agriculture* 96: 1–12) gives each variable a long
//! name and a code; scenarios take the long name with its unit. Absent: the keys themselves, which stand in the types.

use phytomer_law::fault::Segment;

use super::experiment::OF_THE_RUN;
use crate::report::Fault;

/// Names that are not keys, with the key that is meant and its unit.
const MEANT: [(&str, &str, &str); 46] = [
    ("cultivar_name", "genotype_name", "of a level; of the scenario it is `species`"),
    ("CUL_NAME", "genotype_name", "of a level; of the scenario it is `species`"),
    ("CUL_ID", "genotype_name", "of a level; of the scenario it is `species`"),
    ("GENOTYPE_NAME", "genotype_name", "of a level; of the scenario it is `species`"),
    ("genotype_name", "species", "of the scenario; in a level it may be called `genotype_name`"),
    ("PDATE", "planting_date", "YYYY-MM-DD"),
    ("planting_date", "planting_date", "YYYY-MM-DD, a key of the scenario itself"),
    ("sowing_date", "planting_date", "YYYY-MM-DD"),
    ("PLPOP", "planting.plant_pop_at_planting", "number/m²"),
    ("plant_pop_at_planting", "planting.plant_pop_at_planting", "number/m²"),
    ("plant_population", "planting.plant_pop_at_planting", "number/m²"),
    ("plant_pop", "planting.plant_pop_at_planting", "number/m²"),
    ("PLRS", "planting.row_spacing", "cm"),
    ("row_spacing", "planting.row_spacing", "cm"),
    ("PLSP", "planting.plant_spacing", "cm"),
    ("plant_spacing", "planting.plant_spacing", "cm"),
    ("PLRD", "planting.row_direction", "degrees from north"),
    ("row_direction", "planting.row_direction", "degrees from north"),
    ("row_azimuth", "planting.row_direction", "degrees from north"),
    ("germination", "planting.germination", "%"),
    ("germination_percent", "planting.germination", "%"),
    ("FEDATE", "fertilizer.fertilization_date", "YYYY-MM-DD"),
    ("fertilization_date", "fertilizer.fertilization_date", "YYYY-MM-DD"),
    ("fertilizer_date", "fertilizer.fertilization_date", "YYYY-MM-DD"),
    ("FEAMN", "fertilizer.N_in_applied_fertilizer", "kg[N]/ha"),
    ("N_in_applied_fertilizer", "fertilizer.N_in_applied_fertilizer", "kg[N]/ha"),
    ("fertilizer_N", "fertilizer.N_in_applied_fertilizer", "kg[N]/ha"),
    ("fertilizer_events", "fertilizer", "`[[fertilizer]]`, a table for each application"),
    ("harvest_events", "event", "`[[event]]` with `operation = \"harvest\"`"),
    ("WTH_DATASET", "weather.file", "the name of a weather file"),
    ("WST_DATASET", "weather.file", "the name of a weather file"),
    ("weather_station", "weather.file", "the name of a weather file"),
    ("wst_id", "weather.file", "the name of a weather file"),
    ("FL_LAT", "site.latitude_deg", "degrees, north positive"),
    ("WST_LAT", "weather.latitude_deg", "degrees, north positive"),
    ("field_latitude", "site.latitude_deg", "degrees, north positive"),
    ("experimental_design", "experiment.experimental_design", "a word"),
    ("EXP_DESIGN", "experiment.experimental_design", "a word"),
    ("replicates", "experiment.replicates", "a whole number"),
    ("replications", "experiment.replicates", "a whole number"),
    ("NREPS", "experiment.replicates", "a whole number"),
    ("treatment", "experiment.factor", "tables with `name` and `level`"),
    ("treatments", "experiment.factor", "tables with `name` and `level`"),
    ("TRTNO", "experiment.factor", "tables with `name` and `level`"),
    ("TRT_NAME", "experiment.factor", "tables with `name` and `level`"),
    ("treatment_name", "experiment.factor", "tables with `name` and `level`"),
];

/// The number of segments of the path of a level, such as `experiment.factor[0].level[1]`.
const OF_A_LEVEL: usize = 5;

/// Says of each unknown key that is such a name which key is meant, and of a key that is the whole run's where it is
/// set.
pub fn name_keys(faults: &mut [Fault]) {
    for fault in faults {
        let Some(Segment::Key(key)) = fault.path.0.last() else { continue };
        if fault.problem != format!("unknown key `{key}`") {
            continue;
        }
        let told = of_the_run(&fault.path.0, key).or_else(|| meant(&fault.path.0, key));
        if let Some((problem, expected)) = told {
            (fault.problem, fault.expected, fault.suggestion) = (problem, expected, None);
        }
    }
}

/// Problem and expectation of a key of the whole run in a level.
fn of_the_run(path: &[Segment], key: &str) -> Option<(String, String)> {
    let own = OF_THE_RUN.contains(&key) && level_of(path).is_some_and(|below| below.len() == 1);
    own.then(|| {
        let problem = format!("`{key}` belongs to the whole run, so a level cannot set it");
        (problem, format!("`{key}` at the top of the scenario, where it holds for all treatments"))
    })
}

/// Problem and expectation of a name of the dictionary that is no key there.
fn meant(path: &[Segment], key: &str) -> Option<(String, String)> {
    let (_, meant, unit) = MEANT.iter().find(|(name, ..)| name.eq_ignore_ascii_case(key))?;
    let here = path.iter().rev().skip(1).find_map(|segment| match segment {
        Segment::Key(key) => Some(key.as_str()),
        Segment::Index(_) => None,
    });
    let table = meant.rsplit_once('.').map(|(table, _)| table);
    let short = meant.rsplit('.').next().unwrap_or(meant);
    let is_here = here.is_some() && here == table;
    Some((format!("`{key}` is no key here"), format!("`{}` ({unit})", if is_here { short } else { meant })))
}

/// The path below a level; `None` outside of levels.
fn level_of(path: &[Segment]) -> Option<&[Segment]> {
    let is = |segment: &Segment, name: &str| matches!(segment, Segment::Key(key) if key == name);
    let in_level =
        path.len() > OF_A_LEVEL && is(&path[0], "experiment") && is(&path[1], "factor") && is(&path[3], "level");
    in_level.then(|| &path[OF_A_LEVEL..])
}
