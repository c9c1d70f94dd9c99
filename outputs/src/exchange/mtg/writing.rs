//! From a description to a file: a line an entity, in the columns of their branching.
//!
//! What openalea.mtg and MultiScaleTreeGraph.jl trip over is avoided: DESCRIPTION is never empty, columns stand in the
//! order of FEATURES, no line is empty after the name of a section, numbers are plain decimals, texts are of letters,
//! digits, `_`, `.` and `-`, and no feature has the name of an argument of theirs. Places are told to a nanometre.

mod order;
mod rows;

use super::names::{MARK, Meaning, TAKEN, WRITTEN};
use crate::exchange::contract::{MOST_BYTES, Outgoing};
use crate::exchange::description::{Description, Entity, FeatureType, Link};
use crate::exchange::losses::Losses;
use std::collections::{BTreeSet, HashSet};
use std::io::{self, Write};

/// What the columns of features hold.
pub(super) struct Written {
    /// Those of the fields, in their order, as far as any entity has one.
    fields: Vec<(&'static str, &'static str, Meaning)>,
    /// Those beyond, with the place of each in the description, its name here and its type.
    others: Vec<(u32, String, &'static str)>,
    has_dates: bool,
}

/// Writes all plants into one file.
pub fn write(description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()> {
    tell(description, losses);
    let written = Written::of(description, losses);
    let columns = description.individuals.iter().map(order::width).max().unwrap_or(1);
    check_size(description, columns)?;
    let mut told = Losses::default();
    out.file(None, &mut |file| {
        let mut file = io::BufWriter::with_capacity(1 << 16, file);
        head(description, &written, columns, &mut file)?;
        told = Losses::default();
        for individual in &description.individuals {
            rows::write(description, individual, (&written, columns), &mut file, &mut told)?;
        }
        file.flush()
    })?;
    told.told().iter().for_each(|loss| losses.add(&loss.what, loss.count, &loss.instead));
    Ok(())
}

/// Refuses plants whose file nothing could read. A line has a column for each step of branching, so a chain of branches
/// that bear one another makes a file as large as the square of their number, and a range such as `A1++A999999` states
/// one in a few letters.
fn check_size(description: &Description, columns: usize) -> io::Result<()> {
    let entities: usize = description.individuals.iter().map(|individual| individual.entities.len()).sum();
    if entities.saturating_mul(columns) <= MOST_BYTES {
        return Ok(());
    }
    Err(io::Error::other(format!(
        "branches stand {columns} deep in one another, and each of {entities} lines would have so many columns: an MTG of \
         more than {MOST_BYTES} bytes, which no reader takes; OPF has no such columns"
    )))
}

fn head(description: &Description, written: &Written, columns: usize, file: &mut dyn Write) -> io::Result<()> {
    writeln!(file, "{MARK}\nCODE:\tFORM-A\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION")?;
    writeln!(file, "$\t0\tFREE\tFREE\tIMPLICIT")?;
    for (symbol, scale) in rows::symbols(description) {
        writeln!(file, "{symbol}\t{scale}\tFREE\tFREE\tIMPLICIT")?;
    }
    writeln!(file, "DESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX")?;
    for (left, right, link) in relations(description) {
        let (sign, most) = if link == Link::Follows { ('<', '1') } else { ('+', '?') };
        writeln!(file, "{left}\t{right}\t{sign}\t{most}")?;
    }
    writeln!(file, "FEATURES:\nNAME\tTYPE")?;
    for (name, kind) in written.names() {
        writeln!(file, "{name}\t{kind}")?;
    }
    write!(file, "MTG:\nENTITY-CODE{}", "\t".repeat(columns - 1))?;
    for (name, _) in written.names() {
        write!(file, "\t{name}")?;
    }
    writeln!(file)
}

/// Which classes follow and branch from which; at least one, since a reader takes an empty section for no plant.
fn relations(description: &Description) -> Vec<(String, String, Link)> {
    let symbols: Vec<String> = rows::symbols(description).map(|(symbol, _)| symbol).collect();
    let mut found = HashSet::new();
    for individual in &description.individuals {
        for entity in &individual.entities {
            let (Some(bearer), Some(link)) = (entity.bearer, entity.link) else { continue };
            let scale = description.class_of(entity).scale;
            let same = |whole: &Entity| description.class_of(whole).scale <= scale;
            let bearer = individual.within(bearer, same).unwrap_or(bearer);
            found.insert((individual.entities[bearer as usize].class, entity.class, link));
        }
    }
    let name = |class: u32| symbols.get(class as usize).cloned().unwrap_or_default();
    let mut found: Vec<_> = found.into_iter().collect();
    found.sort_unstable();
    let mut rows: Vec<_> = found.into_iter().map(|(left, right, link)| (name(left), name(right), link)).collect();
    if rows.is_empty() && !symbols.is_empty() {
        rows.push((name(0), name(0), Link::Branches));
    }
    rows
}

/// What the format has no place for.
fn tell(description: &Description, losses: &mut Losses) {
    let individuals = &description.individuals;
    let standing = individuals.iter().filter(|individual| individual.standing.is_some()).count();
    losses.add("places of plants in their plot", standing as u64, "places in the file are those within each plant");
    let species = individuals.iter().filter(|individual| individual.species.is_some()).count();
    losses.add("names of species", species as u64, "");
    let forms = individuals.iter().flat_map(|individual| &individual.entities).filter(|entity| entity.form.is_some());
    losses.add("forms of components", forms.count() as u64, "the format has no meshes");
    losses.add("ticks of a year", u64::from(description.ticks_per_year.is_some()), "ages are ticks without a length");
}

impl Written {
    fn of(description: &Description, losses: &mut Losses) -> Self {
        let mut used = [false; WRITTEN.len()];
        let (mut features, mut has_dates) = (vec![false; description.features.len()], false);
        for individual in &description.individuals {
            for entity in &individual.entities {
                for (used, (.., meaning)) in used.iter_mut().zip(WRITTEN).filter(|(used, _)| !**used) {
                    *used = rows::has(individual, entity, meaning);
                }
                for seen in &entity.observations {
                    has_dates |= seen.date.is_some();
                    seen.values.iter().for_each(|(feature, _)| features[*feature as usize] = true);
                }
            }
            used[WRITTEN.len() - 1] |= individual.age.is_some();
        }
        let fields: Vec<_> = WRITTEN.into_iter().zip(used).filter(|(_, used)| *used).map(|(field, _)| field).collect();
        let mut names: BTreeSet<String> = WRITTEN.iter().map(|(name, ..)| name.to_ascii_lowercase()).collect();
        names.extend(["date".to_owned(), "alias".to_owned()]);
        let others = description.features.iter().enumerate().filter(|(place, _)| features[*place]);
        let others = others.map(|(place, feature)| {
            let name = free_name(&feature.name, &names);
            losses.add(
                "names of features",
                u64::from(name != feature.name),
                "they are changed where a reader trips over them",
            );
            names.insert(name.to_ascii_lowercase());
            let kind = match feature.kind {
                FeatureType::Int => "INT",
                FeatureType::Real => "REAL",
                FeatureType::Text => "ALPHA",
                FeatureType::Truth => "BOOLEAN",
                FeatureType::Date => "DD/MM/YY",
            };
            (place as u32, name, kind)
        });
        Self { others: others.collect(), fields, has_dates }
    }

    fn names(&self) -> impl Iterator<Item = (&str, &str)> {
        let date = self.has_dates.then_some(("Date", "DD/MM/YY"));
        let fields = self.fields.iter().map(|(name, kind, _)| (*name, *kind));
        fields.chain(date).chain(self.others.iter().map(|(_, name, kind)| (name.as_str(), *kind)))
    }
}

/// A name without what cuts a line, that nothing else has.
fn free_name(name: &str, taken: &BTreeSet<String>) -> String {
    let mut free = rows::word(name);
    if !free.starts_with(|c: char| c.is_ascii_alphabetic()) {
        free.insert_str(0, "f_");
    }
    while taken.contains(&free.to_ascii_lowercase()) || TAKEN.contains(&free.to_ascii_lowercase().as_str()) {
        free.push('_');
    }
    free
}
