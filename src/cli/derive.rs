//! `derive`: the string of an L-system after some steps, without a plant being made of it.
//!
//! The string is that of a plant of a run with the same seed: its queries are answered by the same turtle, its draws
//! are the same. Absent: the language (`phytomer_rewriting`), the turtle and the files beside
//! (`phytomer_models::lsystem`).

use super::constants::Constants;
use super::named::{self, Named};
use super::{Misuse, Verdict, refuse, terminal};
use anyhow::Result;
use clap::Args;
use phytomer_config::{Model, ResolvedSpecies};
use phytomer_models::fault::{Fault, Path};
use phytomer_models::lsystem::text::TextModel;
use phytomer_rewriting::{Derived, Program, Stopped, Unanswered};
use phytomer_sim::Tick;
use phytomer_sim::random::PlantRandom;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Derive the string of an L-system.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer derive topiary/4 --step 94 --counts
  phytomer derive topiary/2 --step 3
  phytomer derive aono_kunii/k1 --step 3
  phytomer derive abop/2.8a --step 2 -D lr=1.2
  phytomer derive topiary/3 --step 10 --json

A file of your own is named by its path, such as plant.l; its view file and what it includes are looked for beside it.
Without --string, --counts or --json the string is told. Exit code 3 where the file is wrong, 1 where a step cannot be
made.")]
pub struct Derive {
    /// The file of an L-system (.l), or a species of the model `lsystem`, by its path or its name.
    #[arg(value_name = "FILE|NAME")]
    name: String,
    /// How many steps are made; those that the file states if not given, and 1 where it states none.
    #[arg(long, value_name = "N")]
    step: Option<Tick>,
    /// The string, module by module.
    #[arg(long, conflicts_with_all = ["counts", "json"])]
    string: bool,
    /// How many modules there are of each symbol, and how many modules are drawn of them.
    #[arg(long, conflicts_with = "json")]
    counts: bool,
    /// The string with the key, the birth and the predecessor of each module, as one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    constants: Constants,
    /// The seed of the run.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// The number of the plant in the run, from 0.
    #[arg(long, default_value_t = 0)]
    plant: u64,
}

impl Derive {
    pub fn obey(self) -> Result<Verdict> {
        let species = match named::find_with(&self.name, &self.constants.surroundings()) {
            Ok(Named::Species(species)) => species,
            Ok(_) => {
                let problem = format!("`{}` is no L-system; a file of one ends in `.l`", self.name);
                return Err(Misuse(problem).into());
            }
            Err(report) => return refuse(&report, self.json),
        };
        let Some(strings) = Strings::of(&species, self.constants.pairs()) else {
            let problem = format!("`{}` has no L-system in a file of its own", self.name);
            return Err(Misuse(problem).into());
        };
        match strings {
            Ok(strings) => self.derive(&strings),
            Err(faults) => refuse(&species.report(faults), self.json),
        }
    }

    fn derive(&self, strings: &Strings) -> Result<Verdict> {
        let program = strings.program();
        for warning in program.warnings() {
            let file = program.files().get(warning.place.file as usize).map_or("", String::as_str);
            let (line, column) = (warning.place.line, warning.place.column);
            terminal::say(&format!(
                "{file}:{line}:{column}: warning: {}; expected {}",
                warning.problem, warning.expected
            ));
        }
        let steps = self.step.or(program.settings().steps).unwrap_or(1);
        let derived = strings.derive(PlantRandom::new(self.seed, self.plant), steps);
        let told = derived.and_then(|derived| {
            let mut drawn = 0_u64;
            program.draw(&derived, |_| drawn += 1)?;
            Ok((derived, drawn))
        });
        match told {
            Ok((derived, drawn)) => self.tell(program, &derived, drawn).map(|()| Verdict::Done),
            Err(stopped) if self.json => {
                terminal::put_json(&json!({"status": "failed", "step": stopped.step, "problem": stopped.to_string()}))?;
                Ok(Verdict::Failed)
            }
            Err(stopped) => Err(stopped.into()),
        }
    }

    fn tell(&self, program: &Program, derived: &Derived, drawn: u64) -> Result<()> {
        if self.json {
            let mut object = as_json(program, derived);
            object.insert("drawn".to_owned(), json!(drawn));
            terminal::put_json(&object)
        } else if self.counts {
            let mut text = format!("step\t{}\nmodules\t{}\ndrawn\t{drawn}\n", derived.step(), derived.string().len());
            for (symbol, count) in counts(program, derived) {
                let _ = writeln!(text, "{symbol}\t{count}");
            }
            terminal::put(text.trim_end())
        } else {
            terminal::put(&as_text(program, derived))
        }
    }
}

/// What derives the strings of a species.
enum Strings {
    /// An L-system, of which queries are answered by its turtle.
    Drawn(Box<TextModel>),
    /// A D0L-system of cells, which has no queries.
    Cells(Box<Program>),
}

impl Strings {
    /// Those of a species, with `constants` of cells of a file; `None` where it has no L-system in a file of its own.
    fn of(species: &ResolvedSpecies, constants: &[(String, f64)]) -> Option<Result<Self, Vec<Fault>>> {
        let Model::Lsystem(stated) = &species.species.model else { return None };
        if let Some(program) = stated.cell_program(&Path::root(), constants) {
            return Some(program.map(|program| Self::Cells(Box::new(program))));
        }
        Some(stated.text_model(&Path::root())?.map(|model| Self::Drawn(Box::new(model))))
    }

    fn program(&self) -> &Program {
        match self {
            Self::Drawn(model) => model.program(),
            Self::Cells(program) => program,
        }
    }

    fn derive(&self, random: PlantRandom, steps: Tick) -> Result<Derived, Stopped> {
        let program = match self {
            Self::Drawn(model) => return model.derive(random, steps),
            Self::Cells(program) => program,
        };
        let mut derived = program.sow(random, &mut Unanswered)?;
        for _ in 0..steps {
            program.step(&mut derived, &mut Unanswered)?;
        }
        Ok(derived)
    }
}

fn counts(program: &Program, derived: &Derived) -> BTreeMap<String, u64> {
    let mut counts = BTreeMap::new();
    for module in derived.string().modules() {
        *counts.entry(program.written(module.symbol).to_owned()).or_insert(0) += 1;
    }
    counts
}

fn as_text(program: &Program, derived: &Derived) -> String {
    let mut text = String::new();
    for module in derived.string().modules() {
        text.push_str(program.written(module.symbol));
        for (number, value) in module.parameters.iter().enumerate() {
            let _ = write!(text, "{}{value}", if number == 0 { '(' } else { ',' });
        }
        text.push_str(if module.parameters.is_empty() { "" } else { ")" });
    }
    text
}

fn as_json(program: &Program, derived: &Derived) -> Map<String, Value> {
    let module = |module: phytomer_rewriting::Module<'_>| {
        // Keys are 64 bits wide, which numbers of JSON are not everywhere.
        let key = |key: u64| format!("{key:016x}");
        let identity = module.identity;
        json!({
            "symbol": program.written(module.symbol),
            "parameters": module.parameters,
            "key": key(identity.key.0),
            "birth": identity.birth,
            "predecessor": key(identity.predecessor.0),
        })
    };
    let modules: Vec<Value> = derived.string().modules().map(module).collect();
    let status = [("status".to_owned(), json!("done")), ("step".to_owned(), json!(derived.step()))];
    let rest = [("counts".to_owned(), json!(counts(program, derived))), ("modules".to_owned(), Value::Array(modules))];
    status.into_iter().chain(rest).collect()
}
