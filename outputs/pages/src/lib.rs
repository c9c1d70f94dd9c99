//! A page that shows the whole life of plants in a browser: one HTML file, without network and without a server.
//!
//! A [`Page`] has one or several plants, each with its [`Life`] and the rows of its [`Table`], in the streams of whole
//! numbers that `streams` describes, and scripts of ours that draw them by WebGL 2 (`web`). `docs/view.md` has the
//! format of the data. Absent: growth, the tables of a run, and pictures of other formats.

mod carried;
mod forms;
mod hosts;
mod html;
mod parts;
mod roll;
mod streams;
mod table;
#[cfg(test)]
mod tests;
mod wood;

pub use table::{Column, Holds, Table};

use forms::Forms;
use hosts::Hosts;
use phytomer_life::Life;
use phytomer_meshes::{Mesh, MeshOptions};
use phytomer_sim::plant::Kind;
use serde_json::{Value, json};
use std::io::{self, Write};
use std::sync::Arc;
use streams::{LEAST, Last, OCTAVE, Streams, linear, logarithmic};

/// The part of the tolerance that the keyframes of a life may take: the rest is for places that become whole numbers.
pub const OF_A_LIFE: f32 = 0.75;
/// How near to an age of the page a number is that age, ticks.
const NEAR: f32 = 2e-4;
/// The step of places, in tolerances.
const STEP: f64 = 0.25;

/// A plant of a page.
#[derive(Debug)]
pub struct Subject {
    /// Its number in the run.
    pub number: u32,
    /// The number of its species in the run.
    pub species: usize,
    /// What it is called.
    pub name: String,
    /// Where its seed lies on the page, metres.
    pub place: [f64; 3],
    /// The age of the page at which it is sown.
    pub sown: f32,
    /// The values of the columns that are the same at every age: name and value.
    pub constants: Vec<(&'static str, Value)>,
    /// The largest side of the box around it at any age, metres.
    pub reach: f32,
    /// Its life.
    pub life: Life,
    /// Its rows.
    pub table: Table,
    /// The options of its meshes, for its forms.
    pub options: MeshOptions,
}

/// What a page shows.
#[derive(Debug)]
pub struct Page {
    /// The names of the species.
    pub title: String,
    /// What it is, in words: plant and run.
    pub note: String,
    /// The run's name.
    pub run: String,
    /// Its seed.
    pub seed: u64,
    /// How near the page is to the plants, metres.
    pub tolerance: f32,
    /// How finely organs are drawn.
    pub detail: u8,
    /// Whether ages are ticks of a plot.
    pub of_plot: bool,
    /// The ages, with what is said of each.
    pub ages: Vec<(f32, String)>,
    /// What happened: the age, what, and how often.
    pub events: Vec<(f32, &'static str, u64)>,
    /// The columns of the tables.
    pub columns: Vec<Column>,
    /// The plants.
    pub subjects: Vec<Subject>,
    /// What stands among them at every age, such as a roof: places in metres.
    pub obstacles: Vec<Arc<Mesh>>,
}

/// The numbers of ages.
#[derive(Debug)]
struct Numbering<'a> {
    ages: &'a [(f32, String)],
    shift: f32,
}

/// The whole numbers of places.
#[derive(Debug)]
struct Scale {
    step: f64,
    /// The tolerance on the logarithmic scale.
    near: i64,
}

impl Numbering<'_> {
    /// The number of an age of the plant.
    fn place(&self, age: f32) -> i64 {
        // A sum with the age of sowing may be off in its last digits, and ages are a thousandth apart at least.
        let age = age + self.shift - NEAR;
        self.ages.partition_point(|(known, _)| *known < age) as i64
    }

    /// The number of ages from one to another; 0 where the second never comes.
    fn lasts(&self, from: f32, until: f32) -> i64 {
        if until.is_finite() { self.place(until) - self.place(from) } else { 0 }
    }
}

impl Scale {
    fn places(&self, at: [f32; 3]) -> [i64; 3] {
        at.map(|x| linear(f64::from(x), self.step))
    }

    /// A place as the number before; without a radius.
    fn of_place(&self, at: [f32; 3]) -> [Last; 4] {
        let mut last = [Last::default(); 4];
        last.iter_mut().zip(self.places(at)).for_each(|(last, place)| _ = last.step(place));
        last
    }
}

impl Page {
    /// Writes the page. The bytes depend on nothing but the page.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(self, out: &mut dyn Write) -> io::Result<()> {
        let tolerance = f64::from(self.tolerance);
        let scale = Scale { step: STEP * tolerance, near: logarithmic(tolerance) };
        let (mut forms, mut streams, mut plants) = (Forms::default(), Streams::default(), Vec::new());
        for (number, subject) in self.subjects.into_iter().enumerate() {
            let Subject { life, table, options, .. } = subject;
            let numbering = Numbering { ages: &self.ages, shift: subject.sown };
            let components = table.components();
            let name = number.to_string();
            forms.begin(number, subject.species, &options);
            let mut hosts = Hosts::of(&life, self.tolerance);
            wood::write(&life, &scale, &numbering, &mut hosts, &mut streams, &name);
            parts::write(&life, (&scale, &numbering), &mut hosts, &mut forms, &mut streams, &name);
            table.write(&format!("{name}.row"), &|age| numbering.place(age) as u32, &mut streams);
            plants.push(json!({
                "number": subject.number, "name": subject.name, "place": subject.place, "sown": subject.sown,
                "reach": subject.reach,
                "constants": subject.constants.into_iter().map(|(name, value)| json!([name, value])).collect::<Vec<_>>(),
                "lines": life.lines.len(), "points": life.points.len(), "parts": life.parts.len(),
                "components": components,
            }));
        }
        let lengths: Vec<Value> = streams.lengths().map(|(name, length)| json!([name, length])).collect();
        let header = json!({
            "format": 1, "version": env!("CARGO_PKG_VERSION"), "title": self.title, "note": self.note,
            "run": self.run, "seed": self.seed.to_string(), "tolerance_m": self.tolerance, "detail": self.detail, "of_plot": self.of_plot,
            "step_m": scale.step, "turn": roll::STEPS, "octave": OCTAVE, "least": LEAST, "near": scale.near,
            "ages": self.ages.iter().map(|(age, _)| *age).collect::<Vec<f32>>(),
            "captions": self.ages.iter().map(|(_, caption)| caption.as_str()).collect::<Vec<&str>>(),
            "events": self.events, "columns": self.columns.iter().map(of_column).collect::<Vec<Value>>(),
            "kinds": Kind::ALL.map(|kind| json!([kind.tag(), format!("{:?}", kind.class())])).to_vec(),
            "solids": self.obstacles.iter().map(|mesh| forms::of_solid(mesh)).collect::<Vec<Value>>(),
            "forms": forms.list(), "plants": plants, "streams": lengths,
        });
        html::write(&self.title, &header, streams.bytes(), out)
    }
}

fn of_column(column: &Column) -> Value {
    let holds = match &column.holds {
        Holds::Whole => json!("whole"),
        Holds::Truth => json!("truth"),
        Holds::Real => json!("real"),
        Holds::Words(words) => json!(words),
    };
    json!({"name": column.name, "unit": column.unit, "description": column.description, "holds": holds, "kept": column.kept})
}
