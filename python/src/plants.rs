//! The plants of a scenario, a species or a run, grown again from their seeds: as a picture, a mesh, a page.
//!
//! Absent: drawing, which is `phytomer::outputs`', and growing again, which is `phytomer::run::regrowth`'s.

use super::mesh::{Drawn, Mesh};
use super::raise;
use super::scenario::Stated;
use phytomer::cli::named::Recorded;
use phytomer::config::{Resolved, Species, Trial};
use phytomer::outputs::meshes::{OwnForms, Scene, Tolerance};
use phytomer::outputs::pictures::{Compression, Picture as Style, View as From, draw_stands, write_png};
use phytomer::run::drawing::options_of;
use phytomer::run::filming::Filming;
use phytomer::run::picturing::{pictured_plants_at, pictured_plot_at};
use phytomer::run::regrowth::{Regrowth, Whose};
use phytomer::run::viewing::View;
use phytomer::run::{RunError, forms};
use phytomer::sim::between::Moment;
use phytomer::sim::{GrowthModel, Tick};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::Path;
use std::sync::Arc;

/// The most pixels along a side of a picture, and the fewest.
const PIXELS: std::ops::RangeInclusive<u32> = 16..=16_384;

/// What plants grow again from.
pub struct Again {
    trial: Trial,
    models: Vec<Arc<dyn GrowthModel>>,
    species: Vec<Species>,
    forms: Vec<Arc<OwnForms>>,
    mechanics: bool,
}

impl Again {
    /// The plants of a checked scenario.
    ///
    /// # Errors
    /// A mesh of the species' own that cannot be read.
    pub fn of(resolved: Resolved) -> Result<Self, RunError> {
        let species: Vec<Species> = resolved.all_species().into_iter().cloned().collect();
        let forms = species.iter().map(forms::of).collect::<Result<_, _>>()?;
        let (trial, mechanics) = (resolved.trial(), resolved.scenario.output.mechanics);
        let models = [resolved.model].into_iter().chain(resolved.other_models).collect();
        Ok(Self { trial, models, species, forms, mechanics })
    }

    /// The plants of a run folder, without its tables.
    ///
    /// # Errors
    /// A folder that is no run, or whose species cannot be compiled by this version.
    pub fn of_folder(path: &Path) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        let recorded = Recorded::of(path)?;
        let models = recorded.compile()?;
        let forms = recorded.all_species().map(|species| forms::of_run(species, &recorded.run));
        let forms = forms.collect::<Result<_, _>>()?;
        let species = recorded.all_species().cloned().collect();
        Ok(Self { models, forms, species, mechanics: recorded.scenario.output.mechanics, trial: recorded.trial })
    }

    fn regrowth(&self) -> Regrowth<'_> {
        Regrowth::new(self.trial.clone(), self.models.iter().map(AsRef::as_ref).collect(), None)
    }

    fn species(&self) -> Vec<&Species> {
        self.species.iter().collect()
    }

    /// The moment of an age that is asked for.
    fn moment(&self, age: f64, last: Tick) -> PyResult<Moment> {
        let known = Moment::of(age).filter(|moment| moment.age() <= f64::from(last));
        known.ok_or_else(|| PyValueError::new_err(format!("age={age}: the ages are 0 to {last}")))
    }

    fn check_plant(&self, plant: u32) -> PyResult<()> {
        let plants = self.trial.plants();
        if plant >= plants {
            return Err(PyValueError::new_err(format!("plant={plant}: the plants are 0 to {}", plants - 1)));
        }
        Ok(())
    }

    fn check_plot(&self, plot: u32) -> PyResult<()> {
        let plots = self.trial.plots();
        if plot >= plots {
            return Err(PyValueError::new_err(format!("plot={plot}: the plots are 0 to {}", plots - 1)));
        }
        Ok(())
    }
}

/// Plants that grow again from their seeds when they are drawn.
#[pyclass(frozen, module = "phytomer")]
pub struct Plants {
    again: Again,
}

impl Plants {
    /// The plants that grow again from this.
    pub fn new(again: Again) -> Self {
        Self { again }
    }
}

#[pymethods]
impl Plants {
    /// The plants of a scenario or a species; of a species by itself one that lives until `age` at least.
    #[staticmethod]
    #[pyo3(signature = (name, texts, age = None))]
    fn of(py: Python<'_>, name: String, texts: Vec<(String, String)>, age: Option<f64>) -> PyResult<Self> {
        let stated = Stated { name, texts };
        let until = age.and_then(Moment::of).map(Moment::tick);
        let settled = || {
            let mut resolved = stated.resolved_until(until)?;
            forms::settle(&mut resolved)?;
            Ok(resolved)
        };
        let resolved = py.detach(settled).map_err(|report| raise::faulty(py, &report))?;
        Ok(Self { again: Again::of(resolved).map_err(|error| raise::failed(py, &error))? })
    }

    fn __len__(&self) -> usize {
        self.again.trial.plants() as usize
    }

    /// The mesh of a plant at an age; the last if not given. `tolerance_m` simplifies the wood within this distance.
    #[pyo3(signature = (plant = 0, age = None, sides = 8, tolerance_m = None))]
    fn mesh(
        &self,
        py: Python<'_>,
        plant: u32,
        age: Option<f64>,
        sides: u32,
        tolerance_m: Option<f32>,
    ) -> PyResult<Mesh> {
        let again = &self.again;
        again.check_plant(plant)?;
        if !(3..=64).contains(&sides) {
            return Err(PyValueError::new_err(format!("sides={sides}: 3 to 64 sides are expected")));
        }
        if tolerance_m.is_some_and(|within| !(within.is_finite() && within > 0.0)) {
            return Err(PyValueError::new_err("tolerance_m: a distance above 0 is expected, in metres"));
        }
        let last = again.trial.last_age_of(plant);
        let age = again.moment(age.unwrap_or(f64::from(last)), last)?;
        let forms = again.forms.get(again.trial.species_of_plant(plant)).cloned().unwrap_or_default();
        let mut options = options_of(sides, &forms);
        options.tolerance = tolerance_m.map(Tolerance::of);
        let drawn = py.detach(|| {
            let mut drawn = Drawn::default();
            let regrowth = again.regrowth();
            regrowth.show_at(plant, &[age], &mut |age, plant| {
                drawn = Drawn::of(&Scene::new(plant, age.tick(), &options))?;
                Ok(())
            })?;
            Ok(drawn)
        });
        drawn.map_err(|error: RunError| raise::failed(py, &error))?.mesh(py)
    }

    /// A picture as PNG: plants side by side, each at each age, or a whole plot at ticks.
    #[pyo3(signature = (plants, ages, plot, view, size, turn_deg, transparent, ground, caption, sun_deg))]
    #[expect(clippy::too_many_arguments, reason = "each is a key of Python's function")]
    fn picture<'py>(
        &self,
        py: Python<'py>,
        plants: Vec<u32>,
        ages: Vec<f64>,
        plot: Option<u32>,
        view: &str,
        size: [u32; 2],
        turn_deg: Option<f64>,
        transparent: bool,
        ground: bool,
        caption: bool,
        sun_deg: Option<[f32; 2]>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        if !size.iter().all(|side| PIXELS.contains(side)) {
            return Err(PyValueError::new_err(format!(
                "size: two sides of {} to {} pixels",
                PIXELS.start(),
                PIXELS.end()
            )));
        }
        let style = Style {
            size,
            view: view_of(view)?,
            turn: turn_deg.map(|turn| (turn % 360.0).to_radians() as f32),
            transparent,
            ground,
            caption,
            sun: sun_deg.map(|sun| sun.map(f32::to_radians)),
            ..Style::default()
        };
        let whose = self.whose(&plants, plot)?;
        let ages = ages.iter().map(|age| self.moment_of(&whose, *age)).collect::<PyResult<Vec<_>>>()?;
        let drawn = py.detach(|| self.drawn(&whose, ages, &style));
        Ok(PyBytes::new(py, &drawn.map_err(|error| raise::failed(py, &error))??))
    }

    /// The whole life of plants as a page of HTML.
    #[pyo3(signature = (plants, ages, plot))]
    fn page(&self, py: Python<'_>, plants: Vec<u32>, ages: Option<Vec<f64>>, plot: Option<u32>) -> PyResult<String> {
        let whose = self.whose(&plants, plot)?;
        let last = whose.iter().map(|whose| self.last_of(*whose)).min().unwrap_or_default();
        let ages = ages.unwrap_or_else(|| (0..=last).map(f64::from).collect());
        let mut ages = ages.iter().map(|age| self.moment_of(&whose, *age)).collect::<PyResult<Vec<_>>>()?;
        ages.sort_unstable();
        ages.dedup();
        let made = py.detach(|| {
            let (regrowth, species) = (self.again.regrowth(), self.again.species());
            let view = View {
                regrowth: &regrowth,
                species: &species,
                forms: &self.again.forms,
                whose,
                ages,
                tolerance: None,
                mechanics: self.again.mechanics,
                detail: 0,
            };
            let mut bytes = Vec::new();
            view.page(&Filming::default()).map(|page| page.write(&mut bytes).map(|()| bytes))
        });
        let bytes = made.map_err(|error| raise::failed(py, &error))??;
        String::from_utf8(bytes).map_err(|error| PyValueError::new_err(error.to_string()))
    }
}

impl Plants {
    fn whose(&self, plants: &[u32], plot: Option<u32>) -> PyResult<Vec<Whose>> {
        if let Some(plot) = plot {
            self.again.check_plot(plot)?;
            return Ok(vec![Whose::Plot(plot)]);
        }
        plants.iter().try_for_each(|plant| self.again.check_plant(*plant))?;
        if plants.is_empty() {
            return Err(PyValueError::new_err("plants: the number of one plant at least is expected"));
        }
        Ok(plants.iter().copied().map(Whose::Plant).collect())
    }

    /// The last age of a plant, or the last tick of a plot.
    fn last_of(&self, whose: Whose) -> Tick {
        match whose {
            Whose::Plant(plant) => self.again.trial.last_age_of(plant),
            Whose::Plot(_) => self.again.trial.scenario().ages.until,
        }
    }

    fn moment_of(&self, whose: &[Whose], age: f64) -> PyResult<Moment> {
        let last = whose.iter().map(|whose| self.last_of(*whose)).min().unwrap_or_default();
        self.again.moment(age, last)
    }

    /// The picture of these plants, PNG; where no age is given a plant as its species shows it, and a plot at its end.
    fn drawn(&self, whose: &[Whose], mut ages: Vec<Moment>, style: &Style) -> Result<PyResult<Vec<u8>>, RunError> {
        let (regrowth, species) = (self.again.regrowth(), self.again.species());
        let plants: Vec<u32> = whose
            .iter()
            .filter_map(|whose| match whose {
                Whose::Plant(plant) => Some(*plant),
                Whose::Plot(_) => None,
            })
            .collect();
        let pictured = match whose.first() {
            Some(&Whose::Plot(plot)) => {
                if ages.is_empty() {
                    ages.push(self.last_of(Whose::Plot(plot)).into());
                }
                pictured_plot_at(&regrowth, &species, (plot, &ages), false)?
            }
            _ => {
                if ages.is_empty() {
                    let first = plants.first().copied().unwrap_or_default();
                    ages.push(regrowth.shown_at(species[self.again.trial.species_of_plant(first)], first)?.into());
                }
                pictured_plants_at(&regrowth, &species, &plants, &ages)?
            }
        };
        let canvas = draw_stands(&pictured.stands(&self.again.forms), &pictured.title, style);
        let mut png = Vec::new();
        let written = write_png(&canvas, &pictured.note, Compression::Balanced, &mut png);
        Ok(written.map(|()| png).map_err(|error| PyOSError::new_err(error.to_string())))
    }
}

/// The view of this name.
fn view_of(name: &str) -> PyResult<From> {
    match name {
        "perspective" => Ok(From::Perspective),
        "top" => Ok(From::Top),
        "front" => Ok(From::Front),
        "side" => Ok(From::Side),
        "oblique" => Ok(From::Oblique),
        _ => Err(PyValueError::new_err(format!("view={name:?}: perspective, top, front, side or oblique is expected"))),
    }
}
