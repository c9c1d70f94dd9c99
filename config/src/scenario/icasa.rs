//! Names of the ICASA dictionary that a scenario does not take as they stand: old names, codes, and names in another
//! table; each with the key that is meant.
//!
//! The dictionary (White et al. 2013, *Computers and Electronics in Agriculture* 96: 1–12) gives each variable a long
//! name and a code; scenarios take the long name with its unit. Absent: the keys themselves, which stand in the types.

use phytomer_law::fault::Segment;

use crate::report::Fault;

/// Names that are not keys, with the key that is meant and its unit.
const MEANT: [(&str, &str, &str); 25] = [
    ("cultivar_name", "genotype_name", "of a level; of the scenario it is `species`"),
    ("CUL_NAME", "genotype_name", "of a level; of the scenario it is `species`"),
    ("CUL_ID", "genotype_name", "of a level; of the scenario it is `species`"),
    ("GENOTYPE_NAME", "genotype_name", "of a level; of the scenario it is `species`"),
    ("genotype_name", "species", "of the scenario; in a level it may be called `genotype_name`"),
    ("PDATE", "planting_date", "a date"),
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
    ("experimental_design", "experiment.experimental_design", "a word"),
    ("EXP_DESIGN", "experiment.experimental_design", "a word"),
    ("replicates", "experiment.replicates", "a whole number"),
    ("replications", "experiment.replicates", "a whole number"),
    ("REPLICATES", "experiment.replicates", "a whole number"),
    ("treatment", "experiment.factor", "tables with `name` and `level`"),
];

/// Says of each unknown key that is such a name which key is meant.
pub fn name_keys(faults: &mut [Fault]) {
    for fault in faults {
        let Some(Segment::Key(key)) = fault.path.0.last() else { continue };
        if fault.problem != format!("unknown key `{key}`") {
            continue;
        }
        let in_level = fault.path.0.len() > 4;
        let meant = MEANT.iter().find(|(name, meant, _)| name == key && !(in_level && name == meant));
        let Some((_, meant, unit)) = meant else { continue };
        let here = fault.path.0.iter().rev().nth(1);
        let table = meant.rsplit_once('.').map(|(table, _)| table);
        let short = meant.rsplit('.').next().unwrap_or(meant);
        let is_here = matches!((here, table), (Some(Segment::Key(here)), Some(table)) if here == table);
        fault.problem = format!("`{key}` is no key here");
        fault.expected = format!("`{}` ({unit})", if is_here { short } else { meant });
        fault.suggestion = None;
    }
}
