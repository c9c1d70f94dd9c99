//! The numbers of a species by their paths, such as `order.1.pause.value`: found, set, and looked for within a prior.
//!
//! A path has the keys of the species file, and places in lists from 1, so that `order.1` is the trunk. Only numbers of
//! the growth model that the species states, or has by default, have a path. A `prior` stands in the table of a law and
//! names numbers of that table. Absent: growing, and what a changed species is written as (`overlay`).

mod overlay;

use phytomer_law::fault::{self, Path, Segment};
use phytomer_law::spelling::nearest;
use serde_json::Value as Json;

use crate::models::ModelName;
use crate::schema::{forms, resolve};
use crate::species::Species;
pub use overlay::Estimated;

/// A number of a species.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// Its path as people type it: `order.1.pause.value`.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// Whether the file can have whole numbers alone at this place.
    pub whole: bool,
    path: Vec<Segment>,
    /// How many steps of the path lead to the value that a file states as one: a law, a distribution, a list.
    unit: usize,
}

/// A number that a species has under a prior, with the limits of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Prior {
    /// The place of the number in [`Numbers::all`].
    pub number: usize,
    /// The least and the largest value.
    pub limits: [f64; 2],
    /// Where it stands in the species.
    pub path: Path,
}

/// A path that leads to no number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the species has no number `{name}`; {expected}")]
pub struct Unknown {
    /// The path as it was typed.
    pub name: String,
    /// The nearest path, or the numbers below the part that is known.
    pub expected: String,
}

/// All numbers of a species.
#[derive(Debug, Clone)]
pub struct Numbers {
    species: Species,
    model: ModelName,
    json: Json,
    all: Vec<Number>,
    /// Every `prior` with the path of its table.
    stated: Vec<(Vec<Segment>, Json)>,
}

/// Keys whose numbers document others.
const DOCUMENTS: [&str; 2] = ["interval", "prior"];
/// The most numbers that a message lists.
const MOST_LISTED: usize = 8;

impl Numbers {
    /// The numbers of a species.
    ///
    /// # Errors
    /// A number that JSON cannot hold, which no checked species has.
    pub fn of(species: &Species) -> serde_json::Result<Self> {
        let json = species.model.to_json()?;
        let model = species.model.name();
        let mut numbers =
            Self { species: species.clone(), model, json: Json::Null, all: Vec::new(), stated: Vec::new() };
        numbers.walk(&json, &mut Vec::new());
        numbers.json = json;
        Ok(numbers)
    }

    /// Every number, in the order of the file.
    pub fn all(&self) -> &[Number] {
        &self.all
    }

    /// The species that has them.
    pub fn species(&self) -> &Species {
        &self.species
    }

    /// The place of a number in [`Numbers::all`]. `order.1.pause` is found too where `pause` is one number, bare or as
    /// the `value` of a table.
    ///
    /// # Errors
    /// [`Unknown`], with the nearest path.
    pub fn find(&self, name: &str) -> Result<usize, Unknown> {
        let of_table = format!("{name}.value");
        let bare = name.strip_suffix(".value");
        let is = |number: &Number| number.name == name || number.name == of_table || Some(number.name.as_str()) == bare;
        self.all.iter().position(is).ok_or_else(|| self.unknown(name))
    }

    /// The species with other numbers. A number that must be whole is rounded.
    ///
    /// # Errors
    /// Where the model refuses a number by its type.
    pub fn with(&self, set: &[(usize, f64)]) -> Result<Species, String> {
        let mut json = self.json.clone();
        for (place, value) in set {
            let number = self.all.get(*place).ok_or("no such number")?;
            let at = at_mut(&mut json, &number.path).ok_or("no such path")?;
            *at = if number.whole { (value.round() as i64).into() } else { (*value).into() };
        }
        let model = self.model.read(json).map_err(|error| error.to_string())?;
        Ok(Species { about: self.species.about.clone(), model })
    }

    /// The numbers that have a prior in the species file.
    ///
    /// # Errors
    /// Every prior that names no number or several, or whose limits are no numbers in order, at its path.
    pub fn priors(&self) -> Result<Vec<Prior>, Vec<fault::Fault>> {
        let (mut priors, mut faults) = (Vec::<Prior>::new(), Vec::new());
        for (table, limits) in &self.stated {
            let of_table = Path(table.clone()).key("prior");
            for (name, limits) in limits.as_object().into_iter().flatten() {
                match self.prior(table, name, limits, &of_table.key(name)) {
                    Ok(prior) if priors.iter().all(|known| known.number != prior.number) => priors.push(prior),
                    Ok(prior) => {
                        let problem = format!("`{}` has two priors", self.all[prior.number].name);
                        faults.push(fault::Fault::new(&of_table.key(name), problem, "one prior for each number"));
                    }
                    Err(fault) => faults.push(fault),
                }
            }
        }
        if faults.is_empty() { Ok(priors) } else { Err(faults) }
    }

    fn prior(&self, table: &[Segment], name: &str, limits: &Json, path: &Path) -> Result<Prior, fault::Fault> {
        let number =
            self.below(table, name).map_err(|(problem, expected)| fault::Fault::new(path, problem, expected))?;
        let limits = [0, 1].map(|place| limits.get(place).and_then(Json::as_f64).unwrap_or(f64::NAN));
        if limits[0] < limits[1] && limits.iter().all(|limit| limit.is_finite()) {
            return Ok(Prior { number, limits, path: path.clone() });
        }
        let problem = format!("the prior of `{name}` is [{}, {}]", limits[0], limits[1]);
        Err(fault::Fault::new(path, problem, "a least and a larger largest value, in this order"))
    }

    /// The one number below a table whose path there is `name` or ends with it; else the problem and what was expected.
    fn below(&self, table: &[Segment], name: &str) -> Result<usize, (String, String)> {
        let inside: Vec<(usize, String)> = self
            .all
            .iter()
            .enumerate()
            .filter(|(_, number)| number.path.starts_with(table))
            .map(|(place, number)| (place, shown(&number.path[table.len()..])))
            .collect();
        // `mean` is found as `normal.mean` too, and as `normal.mean.value`.
        let is = |own: &str| own.strip_suffix(".value").is_some_and(|own| own == name) || own == name;
        let ends = |own: &str| {
            let own = own.strip_suffix(name).or_else(|| own.strip_suffix(".value")?.strip_suffix(name));
            own.is_some_and(|above| above.ends_with('.'))
        };
        let exact = inside.iter().find(|(_, own)| is(own));
        let ended: Vec<&(usize, String)> = inside.iter().filter(|(_, own)| ends(own)).collect();
        match (exact, ended.as_slice()) {
            (Some((place, _)), _) | (None, [(place, _)]) => Ok(*place),
            (None, []) => {
                let last = |own: &String| own.rsplit('.').next().unwrap_or_default().to_owned();
                let names: Vec<String> = inside.iter().map(|(_, own)| last(own)).collect();
                let problem = format!("unknown number `{name}`");
                Err((problem, format!("a number of this table: {}", listed(names.iter().map(String::as_str)))))
            }
            (None, several) => {
                let problem = format!("`{name}` may be {} numbers of this table", several.len());
                Err((problem, format!("more of its path: {}", listed(several.iter().map(|(_, own)| own.as_str())))))
            }
        }
    }

    fn unknown(&self, name: &str) -> Unknown {
        let names = || self.all.iter().map(|number| number.name.as_str());
        let begins = |part: &str| {
            let part = format!("{part}.");
            names().filter(move |own| own.starts_with(&part)).collect::<Vec<_>>()
        };
        let parts: Vec<&str> = name.split('.').collect();
        let known = (1..=parts.len()).rev().map(|n| parts[..n].join(".")).find(|part| !begins(part).is_empty());
        let below: Vec<&str> = known.as_deref().map(begins).unwrap_or_default();
        let near = near_by_steps(name, names()).or_else(|| nearest(name, names()));
        let expected = match (near, known) {
            (Some(near), _) => format!("the nearest is `{near}`"),
            (None, Some(known)) => format!("below `{known}` there are {}", listed(below.into_iter())),
            (None, None) => format!("there are {}", listed(names())),
        };
        Unknown { name: name.chars().take(80).collect(), expected }
    }

    fn walk(&mut self, json: &Json, path: &mut Vec<Segment>) {
        match json {
            Json::Number(number) => {
                let (value, whole) = (number.as_f64().unwrap_or(f64::NAN), !number.is_f64());
                let unit = self.unit(path);
                self.all.push(Number { name: shown(path), value, whole, path: path.clone(), unit });
            }
            Json::Array(items) => {
                for (place, item) in items.iter().enumerate() {
                    path.push(Segment::Index(place));
                    self.walk(item, path);
                    path.pop();
                }
            }
            Json::Object(keys) => {
                for (key, value) in keys {
                    if key == "prior" {
                        self.stated.push((path.clone(), value.clone()));
                    }
                    // The n of a binomial stands beside its p; any other n tells how many were measured.
                    let counts = key == "n" && !keys.contains_key("p") && !path.is_empty();
                    if DOCUMENTS.contains(&key.as_str()) || counts {
                        continue;
                    }
                    path.push(Segment::Key(key.clone()));
                    self.walk(value, path);
                    path.pop();
                }
            }
            _ => {}
        }
    }

    /// How many steps lead to the value that is stated as one: where the schema has several forms, or a list that does
    /// not merge by place.
    fn unit(&self, path: &[Segment]) -> usize {
        let root = self.model.schema();
        let by_place = self.model.card().keys.by_place.as_ref().map(|tables| tables.list);
        let mut schema = Some(root);
        for (steps, segment) in path.iter().enumerate() {
            let Some(here) = schema.and_then(|schema| resolve(root, schema)) else { return steps };
            if !forms(here).is_empty() {
                return steps;
            }
            schema = match segment {
                Segment::Key(key) => here.get("properties").and_then(|keys| keys.get(key)),
                Segment::Index(_) => {
                    let list = matches!(&path[..steps], [Segment::Key(key)] if Some(key.as_str()) == by_place);
                    if !list {
                        return steps;
                    }
                    here.get("items")
                }
            };
        }
        path.len()
    }
}

/// A path as people type it: places from 1.
fn shown(path: &[Segment]) -> String {
    let step = |segment: &Segment| match segment {
        Segment::Key(key) => key.clone(),
        Segment::Index(place) => (place + 1).to_string(),
    };
    path.iter().map(step).collect::<Vec<_>>().join(".")
}

/// The path of as many steps whose steps are each as typed or near it.
fn near_by_steps<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let typed: Vec<&str> = name.split('.').collect();
    let alike = |own: &&str| {
        let steps: Vec<&str> = own.split('.').collect();
        let near = |(typed, own): (&&str, &&str)| typed == own || nearest(typed, [*own]).is_some();
        let same = steps.len() == typed.len() || (steps.len() == typed.len() + 1 && steps.last() == Some(&"value"));
        same && typed.iter().zip(&steps).all(near)
    };
    names.into_iter().find(alike)
}

/// The first names of a list.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    let first: Vec<String> = names.iter().take(MOST_LISTED).map(|name| format!("`{name}`")).collect();
    match names.len() {
        0 => "none".to_owned(),
        n if n > MOST_LISTED => format!("{} and {} more", first.join(", "), n - MOST_LISTED),
        _ => first.join(", "),
    }
}

fn at_mut<'j>(json: &'j mut Json, path: &[Segment]) -> Option<&'j mut Json> {
    path.iter().try_fold(json, |at, segment| match segment {
        Segment::Key(key) => at.get_mut(key),
        Segment::Index(place) => at.get_mut(*place),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{validate_species, validate_texts};

    fn numbers(species: &str) -> Numbers {
        Numbers::of(&validate_species(species, 24).unwrap().species).unwrap()
    }

    #[test]
    fn numbers_are_found_set_and_missed() {
        let coffee = numbers("coffee");
        let pause = coffee.find("order.1.pause").unwrap();
        assert_eq!(coffee.all()[pause].name, "order.1.pause.value");
        assert_eq!(coffee.find("order.1.pause.value").unwrap(), pause);
        let nodes = coffee.find("order.1.death.weibull.scale").unwrap();
        let changed = Numbers::of(&coffee.with(&[(pause, 0.25), (nodes, 40.0)]).unwrap()).unwrap();
        assert_eq!((changed.all()[pause].value, changed.all()[nodes].value), (0.25, 40.0));
        assert_eq!(changed.all().len(), coffee.all().len());
        let told = |name: &str| coffee.find(name).unwrap_err().to_string();
        assert!(
            told("order.1.puase.value").contains("the nearest is `order.1.pause.value`"),
            "{}",
            told("order.1.puase.value")
        );
        assert!(told("order.1.death.weibull.scael").contains("`order.1.death.weibull.scale`"));
        assert!(told("order.9.pause").contains("order."), "{}", told("order.9.pause"));
    }

    /// Any model: its numbers can be set to what they are.
    #[test]
    fn every_model_has_numbers() {
        for species in ["coffee", "aucuba", "wp_willow", "ulam", "poplar_30y", "abop_1_24_a"] {
            let Ok(found) = validate_species(species, 3) else { continue };
            let numbers = Numbers::of(&found.species).unwrap();
            let all: Vec<(usize, f64)> = numbers.all().iter().enumerate().map(|(k, n)| (k, n.value)).collect();
            assert_eq!(numbers.with(&all).unwrap(), found.species, "{species}");
        }
    }

    #[test]
    fn priors_name_numbers_of_their_table() {
        let species = |law: &str| {
            let text = format!("inherits = \"coffee\"\nname = \"mine\"\n[[order]]\npause = {law}\n");
            let resolved = validate_texts("mine", &[("mine", text.as_str())])?;
            let numbers = Numbers::of(&resolved.species).unwrap();
            let priors = numbers.priors().unwrap();
            Ok::<_, crate::Report>(
                priors.iter().map(|p| (numbers.all()[p.number].name.clone(), p.limits)).collect::<Vec<_>>(),
            )
        };
        let told = species("{ value = 0.1, prior = { value = [0.05, 0.5] } }").unwrap();
        assert_eq!(told, [("order.1.pause.value".to_owned(), [0.05, 0.5])]);
        let step = "{ step = { over = \"age\", at = 6, before = 0, after = 0.2 }, prior = { after = [0.1, 0.3] } }";
        assert_eq!(species(step).unwrap()[0].0, "order.1.pause.step.after");
        let refused = |law: &str| species(law).unwrap_err().render(false);
        let wrong = refused("{ value = 0.1, prior = { vaule = [0.05, 0.5] } }");
        assert!(wrong.contains("unknown number `vaule`") && wrong.contains("`value`"), "{wrong}");
        let reversed = refused("{ value = 0.1, prior = { value = [0.5, 0.05] } }");
        assert!(reversed.contains("the prior of `value` is [0.5, 0.05]"), "{reversed}");
    }
}
