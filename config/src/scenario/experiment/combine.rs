//! Which treatments an experiment has: the full factorial of its levels less what is skipped, or the combinations that
//! it names.
//!
//! In the factorial the last factor changes fastest, as in a printed table of treatments. All faults are told at once;
//! names that are not known are told with those that are. Absent: what the levels set.

use std::collections::{BTreeMap, BTreeSet};

use phytomer_law::fault::{Fault, Path};
use serde_json::{Map, Value as Json};

use super::{CONTROL, Combination, Experiment, Factor, MOST_TREATMENTS};

/// The columns of the table `treatments` that are not of a factor.
const COLUMNS: [&str; 2] = ["treatment", "treatment_index"];

/// The lists of a scenario that levels add to, which several factors may therefore set.
pub const JOINED: [&str; 3] = ["event", "fertilizer", "pest"];

/// A treatment as the levels that it is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chosen {
    /// The name of the treatment.
    pub name: String,
    /// The level of each factor, as an index into its list.
    pub levels: Vec<usize>,
}

fn place() -> Path {
    Path::root().key("experiment")
}

impl Experiment {
    /// The treatments, in their order.
    ///
    /// # Errors
    /// All faults of names and of combinations.
    pub(crate) fn chosen(&self) -> Result<Vec<Chosen>, Vec<Fault>> {
        let mut faults = Vec::new();
        self.check_factors(&mut faults);
        self.check_shared_keys(&mut faults);
        let skipped = self.skipped(&mut faults);
        let named = self.named(&mut faults);
        let chosen = match self.combination.as_slice() {
            [] if faults.is_empty() => self.factorial(&skipped, &mut faults),
            _ => named,
        };
        self.check_treatments(&chosen, &mut faults);
        if faults.is_empty() { Ok(chosen) } else { Err(faults) }
    }

    fn check_factors(&self, faults: &mut Vec<Fault>) {
        let mut known = BTreeSet::new();
        for (f, factor) in self.factor.iter().enumerate() {
            let path = place().key("factor").index(f);
            let name = &factor.name;
            if !is_column(name) {
                let problem = format!("`{name}` cannot be the name of a column of the table `treatments`");
                let expected = "letters, digits and `_`, a letter first, such as `nitrogen`";
                faults.push(Fault::new(&path.key("name"), problem, expected));
            } else if !known.insert(name.to_ascii_lowercase()) {
                let problem = format!("two factors have the name `{name}` (capitals do not tell names apart)");
                faults.push(Fault::new(&path.key("name"), problem, "a name of its own for each factor"));
            }
            let levels = factor.level.iter().map(|level| level.name.as_str());
            check_alike(levels, &path.key("level"), &format!("levels of `{name}`"), faults);
            if let Some(default) = &factor.default {
                level_of(factor, default, &path.key("default"), faults);
            }
            for (l, level) in factor.level.iter().enumerate() {
                if level.sets.contains_key("species") && level.sets.contains_key("genotype_name") {
                    let path = path.key("level").index(l).key("genotype_name");
                    let problem = format!("the level `{}` states its species twice", level.name);
                    faults.push(Fault::new(&path, problem, "either `species` or `genotype_name`"));
                }
            }
        }
    }

    /// A key that two factors set would have the value of the last of them, and the other would have no effect.
    fn check_shared_keys(&self, faults: &mut Vec<Fault>) {
        let mut set: BTreeMap<String, usize> = BTreeMap::new();
        for (f, factor) in self.factor.iter().enumerate() {
            for (l, level) in factor.level.iter().enumerate() {
                for key in keys_of(&level.sets).into_iter().chain(keys_of_pests(&level.sets)) {
                    let first = *set.entry(key.join(".")).or_insert(f);
                    if first == f {
                        continue;
                    }
                    let path = place().key("factor").index(f).key("level").index(l);
                    let path = key.iter().fold(path, |path, key| path.key(key));
                    let (other, key) = (&self.factor[first].name, key.join("."));
                    let problem =
                        format!("the factor `{}` sets `{key}`, which the factor `{other}` sets too", factor.name);
                    faults.push(Fault::new(&path, problem, "a key that one factor sets alone"));
                }
            }
        }
    }

    /// The levels of each table of `skip`.
    fn skipped(&self, faults: &mut Vec<Fault>) -> Vec<Vec<Option<usize>>> {
        let path = place().key("skip");
        if !self.skip.is_empty() && !self.combination.is_empty() {
            let problem = "`skip` leaves out treatments of the full factorial, and here the treatments are named";
            faults.push(Fault::new(&path, problem, "either `skip` or `[[experiment.combination]]`"));
        }
        let each = self.skip.iter().enumerate();
        each.map(|(number, levels)| self.levels_of(levels, &path.index(number), faults)).collect()
    }

    /// The level that a table names for each factor.
    fn levels_of(&self, levels: &BTreeMap<String, String>, path: &Path, faults: &mut Vec<Fault>) -> Vec<Option<usize>> {
        let mut chosen = vec![None; self.factor.len()];
        for (factor, level) in levels {
            let path = path.key(factor);
            match self.factor.iter().position(|known| known.name == *factor) {
                Some(f) => chosen[f] = level_of(&self.factor[f], level, &path, faults),
                None => {
                    let names = self.factor.iter().map(|factor| factor.name.as_str());
                    faults.push(Fault::new(&path, format!("unknown factor `{factor}`"), one_of(names, "no factor")));
                }
            }
        }
        chosen
    }

    /// The combinations that are named.
    fn named(&self, faults: &mut Vec<Fault>) -> Vec<Chosen> {
        let path = place().key("combination");
        let names = self.combination.iter().map(|combination| combination.name.as_str());
        check_alike(names, &path, "treatments", faults);
        let own: Vec<Vec<Option<usize>>> = self
            .combination
            .iter()
            .enumerate()
            .map(|(c, combination)| self.levels_of(&combination.levels, &path.index(c).key("levels"), faults))
            .collect();
        let elders: Vec<Option<usize>> =
            (0..own.len()).map(|c| self.elder(c, &path.index(c).key("like"), faults)).collect();
        self.check_circles(&elders, faults);
        let chosen = |(c, Combination { name, .. }): (usize, &Combination)| {
            let mut levels = own[c].clone();
            let mut elder = elders[c];
            for _ in 0..own.len() {
                let Some(like) = elder else { break };
                levels.iter_mut().zip(&own[like]).for_each(|(level, elder)| *level = level.or(*elder));
                elder = elders[like];
            }
            let levels = levels.into_iter().zip(&self.factor);
            let levels = levels.map(|(level, factor)| level.unwrap_or_else(|| default_of(factor))).collect();
            Chosen { name: name.clone(), levels }
        };
        self.combination.iter().enumerate().map(chosen).collect()
    }

    /// The combination that a combination is like.
    fn elder(&self, combination: usize, path: &Path, faults: &mut Vec<Fault>) -> Option<usize> {
        let like = self.combination[combination].like.as_ref()?;
        let found = self.combination.iter().position(|known| known.name == *like);
        if found.is_none() {
            let names = self.combination.iter().enumerate().filter(|(c, _)| *c != combination);
            let names = names.map(|(_, known)| known.name.as_str());
            faults.push(Fault::new(path, format!("there is no combination `{like}`"), one_of(names, "another one")));
        }
        found
    }

    fn check_circles(&self, elders: &[Option<usize>], faults: &mut Vec<Fault>) {
        for first in (0..elders.len()).filter(|first| on_circle(elders, *first)) {
            let path = place().key("combination").index(first).key("like");
            let problem = format!("the combination `{}` is like itself, in a circle", self.combination[first].name);
            faults.push(Fault::new(&path, problem, "a combination that is not like this one"));
        }
    }

    /// All combinations of all levels but those that are skipped.
    fn factorial(&self, skipped: &[Vec<Option<usize>>], faults: &mut Vec<Fault>) -> Vec<Chosen> {
        let count = self.factor.iter().fold(1_u64, |n, factor| n.saturating_mul(factor.level.len() as u64));
        if count > MOST_TREATMENTS {
            let problem = format!("the full factorial of these factors has {count} treatments");
            let expected = format!(
                "at most {MOST_TREATMENTS}: fewer factors, or the treatments by name as `[[experiment.combination]]`"
            );
            faults.push(Fault::new(&place().key("factor"), problem, expected));
            return Vec::new();
        }
        let all = (0..count).map(|number| self.combination_of(number));
        let is_skipped = |levels: &Vec<usize>| {
            skipped.iter().any(|skip| skip.iter().zip(levels).all(|(skip, level)| skip.is_none_or(|s| s == *level)))
        };
        let kept = all.filter(|levels| !is_skipped(levels));
        let chosen: Vec<Chosen> = kept.map(|levels| Chosen { name: self.name_of(&levels), levels }).collect();
        if chosen.is_empty() {
            let problem = "every treatment is skipped";
            faults.push(Fault::new(&place().key("skip"), problem, "at least one combination that is grown"));
        }
        chosen
    }

    /// The levels of a treatment of the full factorial; the last factor changes fastest.
    fn combination_of(&self, number: u64) -> Vec<usize> {
        let mut rest = number;
        let mut levels = vec![0; self.factor.len()];
        for (level, factor) in levels.iter_mut().zip(&self.factor).rev() {
            let count = factor.level.len().max(1) as u64;
            *level = (rest % count) as usize;
            rest /= count;
        }
        levels
    }

    /// The name of a treatment of the full factorial: its levels, joined by ` + `.
    fn name_of(&self, levels: &[usize]) -> String {
        let names = self.factor.iter().zip(levels).filter_map(|(factor, level)| factor.level.get(*level));
        let names: Vec<&str> = names.map(|level| level.name.as_str()).collect();
        if names.is_empty() { CONTROL.to_owned() } else { names.join(" + ") }
    }

    fn check_treatments(&self, chosen: &[Chosen], faults: &mut Vec<Fault>) {
        if chosen.len() as u64 > MOST_TREATMENTS {
            let problem = format!("{} treatments are named", chosen.len());
            faults.push(Fault::new(&place().key("combination"), problem, format!("at most {MOST_TREATMENTS}")));
        }
        if self.combination.is_empty() {
            let path = place().key("factor");
            check_alike(chosen.iter().map(|chosen| chosen.name.as_str()), &path, "treatments", faults);
        }
    }
}

/// Whether following `like` from a combination leads back to it.
fn on_circle(elders: &[Option<usize>], first: usize) -> bool {
    let mut at = elders[first];
    for _ in 0..elders.len() {
        match at {
            Some(here) if here == first => return true,
            Some(here) => at = elders[here],
            None => return false,
        }
    }
    false
}

/// Whether a word can be the name of a factor's column.
fn is_column(name: &str) -> bool {
    let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let own = !COLUMNS.iter().any(|column| column.eq_ignore_ascii_case(name));
    plain && own && name.starts_with(|c: char| c.is_ascii_alphabetic())
}

/// The index of a level by its name.
fn level_of(factor: &Factor, level: &str, path: &Path, faults: &mut Vec<Fault>) -> Option<usize> {
    let found = factor.level.iter().position(|known| known.name == level);
    if found.is_none() {
        let names = factor.level.iter().map(|level| level.name.as_str());
        let problem = format!("the factor `{}` has no level `{level}`", factor.name);
        faults.push(Fault::new(path, problem, one_of(names, "no level")));
    }
    found
}

/// The level of a factor that a combination does not name.
fn default_of(factor: &Factor) -> usize {
    let default = factor.default.as_ref();
    default.and_then(|default| factor.level.iter().position(|level| level.name == *default)).unwrap_or(0)
}

/// Adds a fault for each name of a list that stands there before.
fn check_alike<'a>(names: impl Iterator<Item = &'a str>, list: &Path, what: &str, faults: &mut Vec<Fault>) {
    let mut known = BTreeSet::new();
    for (number, name) in names.enumerate() {
        if !known.insert(name) {
            let problem = format!("two {what} have the name `{name}`");
            faults.push(Fault::new(&list.index(number).key("name"), problem, "a name of its own for each"));
        }
    }
}

/// The keys that a level sets, each with the tables that it stands in. Lists that levels add to are left out.
fn keys_of(sets: &Map<String, Json>) -> Vec<Vec<String>> {
    let mut keys = Vec::new();
    for (key, value) in sets.iter().filter(|(key, _)| !JOINED.contains(&key.as_str())) {
        let key = if key == "genotype_name" { "species" } else { key };
        match value {
            Json::Object(below) if !below.is_empty() => {
                keys.extend(keys_of(below).into_iter().map(|path| [vec![key.to_owned()], path].concat()));
            }
            _ => keys.push(vec![key.to_owned()]),
        }
    }
    keys
}

/// The keys that a level sets of pests, which it may share with other factors as long as each sets other keys: `pest`,
/// the name and the key.
fn keys_of_pests(sets: &Map<String, Json>) -> Vec<Vec<String>> {
    let mut keys = Vec::new();
    for pest in sets.get("pest").and_then(Json::as_array).into_iter().flatten().filter_map(Json::as_object) {
        let Some(name) = pest.get("name").and_then(Json::as_str) else { continue };
        let others = pest.keys().filter(|key| *key != "name");
        keys.extend(others.map(|key| vec!["pest".to_owned(), name.to_owned(), key.clone()]));
    }
    keys
}

/// The names in words; `none` where there are none.
fn one_of<'a>(names: impl Iterator<Item = &'a str>, none: &str) -> String {
    let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    match names.as_slice() {
        [] => none.to_owned(),
        [one] => one.clone(),
        names => format!("one of {}", names.join(", ")),
    }
}
