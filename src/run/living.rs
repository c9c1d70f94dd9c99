//! A plant, or a plot, grown once and described as lives: what a file is made of that plays a whole life.
//!
//! The lives of a plot have its ticks for their ages, so that all of them are shown at the same. Absent: the file,
//! which is a writer's (`phytomer_outputs::usd`).

use super::RunError;
use super::picturing::obstacles_of;
use super::regrowth::{Regrowth, Whose};
use phytomer_outputs::life::{Life, Maker, Member, Nearness};
use phytomer_outputs::meshes::{MeshOptions, PlotMesh};
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use std::collections::BTreeMap;

/// Lives of plants, and where they stand.
pub struct Living {
    /// The lives, all shown at the same ages.
    pub lives: Vec<Life>,
    /// The options of each.
    pub options: Vec<MeshOptions>,
    /// What stands where.
    pub members: Vec<Member>,
    /// The obstacles of a plot, where it has any.
    pub obstacles: Option<PlotMesh<'static>>,
}

/// A plant while its life is made.
struct Growing {
    maker: Maker,
    species: usize,
    sown: Tick,
}

/// Grows a plant or a plot and describes it at some ages, of a plot its ticks, in their order; `options` are those of
/// each species.
///
/// # Errors
/// Those of growing.
pub fn lives(
    regrowth: &Regrowth,
    whose: Whose,
    ages: &[Moment],
    (distance, options): (f32, &dyn Fn(usize) -> MeshOptions),
) -> Result<Living, RunError> {
    let mut growing: BTreeMap<u32, Growing> = BTreeMap::new();
    regrowth.show_timed(whose, ages, &|_| vec![0.0], &mut |at, standing| {
        for one in standing {
            let begin = || {
                let maker = Maker::new(Nearness::of(distance), &options(one.species));
                Growing { maker, species: one.species, sown: at.tick().saturating_sub(one.age) }
            };
            growing.entry(one.plant.id).or_insert_with(begin).maker.show(&one.plant, one.age);
        }
        Ok(())
    })?;
    let ticks: Vec<f32> = ages.iter().map(|age| age.age() as f32).collect();
    let place = |plant: u32| match whose {
        Whose::Plant(_) => [0.0; 3],
        Whose::Plot(_) => regrowth.trial().place_in_plot(plant).map(|x| x as f32),
    };
    let mut living = Living { lives: Vec::new(), options: Vec::new(), members: Vec::new(), obstacles: None };
    for (number, (plant, Growing { maker, species, sown })) in growing.into_iter().enumerate() {
        living.lives.push(maker.finish().in_plot(sown as f32, &ticks));
        living.options.push(options(species));
        living.members.push(Member { life: number, offset: place(plant), number: number as u32 });
    }
    if let Whose::Plot(plot) = whose {
        living.obstacles = obstacles(regrowth, plot);
    }
    Ok(living)
}

fn obstacles(regrowth: &Regrowth, plot: u32) -> Option<PlotMesh<'static>> {
    let obstacles = obstacles_of(regrowth.trial(), plot);
    let place = regrowth.plot_place(plot);
    let mesh = |obstacles| PlotMesh { bodies: Vec::new(), members: Vec::new(), obstacles, name: String::new(), place };
    (!obstacles.is_empty()).then(|| mesh(obstacles))
}
