//! What one picture or one mesh of a plot shows: plants grown again and kept at some ages, side by side or as a plot in
//! which each stands in its place.
//!
//! Of the plants of a plot that are equal one is kept: those of one species and one age whose meshes are the same to
//! the bit, as those of a species without draws are. Absent: drawing, which is `phytomer_outputs`'.

use super::RunError;
use super::captions::{caption_of_plot, label_of_plant, list, titles_of};
use super::drawing::options_of;
use super::regrowth::{Regrowth, Standing};
use phytomer_config::scenario::{DrawnObstacle, Site};
use phytomer_config::{Species, Trial};
use phytomer_outputs::meshes::{
    Chunk, Mesh, MeshOptions, OwnForms, PlotBody, PlotMember, PlotMesh, Scene, Seen, Solid,
};
use phytomer_outputs::pictures::{Placed, Stand, Subject};
use phytomer_outputs::tables::Membership;
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use phytomer_sim::plant::Plant;
use phytomer_sim::site::light::Field;
use sha2::{Digest, Sha256};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// What one picture shows, and what is written on it.
#[derive(Debug)]
pub struct Pictured {
    /// What stands side by side: plants at ages, or a plot at ticks.
    pub stands: Vec<PicturedStand<'static>>,
    /// The names of the species.
    pub title: String,
    /// What the file says of itself.
    pub note: String,
}

/// A plant at an age, or a plot at a tick.
#[derive(Debug, Clone)]
pub struct PicturedStand<'p> {
    /// The plants, equal ones once: their own, or lent by what has grown them.
    pub plants: Vec<Cow<'p, Plant>>,
    /// Where they stand.
    pub members: Vec<PicturedMember>,
    /// The obstacles of a plot that are drawn.
    pub obstacles: Vec<Arc<Mesh>>,
    /// What is written below them.
    pub label: String,
    /// The light of a plot, where the scenario has light.
    pub light: Option<Arc<Field>>,
}

/// A plant of a stand.
#[derive(Debug, Clone, Copy, Default)]
pub struct PicturedMember {
    /// The plant's number in the run.
    pub number: u32,
    /// Its plot.
    pub plot: u32,
    /// The treatment of its plot, as an index into those of the trial.
    pub treatment: u32,
    /// The tick of its plot at which it is sown.
    pub sown: Tick,
    /// What stands there, as a place in the stand's `plants`.
    pub plant: usize,
    /// Its species, as an index into those of the run.
    pub species: usize,
    /// Its age; between two ticks that at the later one.
    pub age: Tick,
    /// Its place, metres from that of the plot.
    pub place: [f64; 3],
    /// What of it is drawn, where it is a tree of stems.
    pub seen: Seen,
}

impl Pictured {
    /// What a picture takes; `forms` are those of each species.
    pub fn stands<'a>(&'a self, forms: &[Arc<OwnForms>]) -> Vec<Stand<'a>> {
        self.stands.iter().map(|stand| stand.stand(forms)).collect()
    }

    /// Where each plant of each stand belongs, in the order of [`Pictured::subjects`].
    pub fn memberships(&self) -> Vec<Membership> {
        let each = self.stands.iter().flat_map(|stand| &stand.members);
        let of = |PicturedMember { plot, treatment, species, sown, .. }: &PicturedMember| Membership {
            plot: *plot,
            treatment: *treatment,
            species: *species,
            sown: *sown,
            ..Membership::default()
        };
        each.map(of).collect()
    }

    /// The light of each plant of each stand, in the order of [`Pictured::subjects`].
    pub fn lights(&self) -> Vec<Option<Arc<Field>>> {
        self.stands.iter().flat_map(|stand| stand.members.iter().map(|_| stand.light.clone())).collect()
    }

    /// Each plant of each stand by itself, for what colours them.
    pub fn subjects(&self) -> Vec<Subject<'_>> {
        let each = self.stands.iter().flat_map(|stand| stand.members.iter().map(move |member| (stand, member)));
        each.map(|(stand, member)| Subject {
            plant: &stand.plants[member.plant],
            age: member.age,
            label: stand.label.clone(),
        })
        .collect()
    }
}

impl PicturedStand<'_> {
    /// The same with plants of its own.
    fn owned(self) -> PicturedStand<'static> {
        let plants = self.plants.into_iter().map(|plant| Cow::Owned(plant.into_owned())).collect();
        PicturedStand { plants, members: self.members, obstacles: self.obstacles, label: self.label, light: self.light }
    }

    /// The same as a picture takes it; `forms` are those of each species.
    pub fn stand(&self, forms: &[Arc<OwnForms>]) -> Stand<'_> {
        let placed = |member: &PicturedMember| Placed {
            plant: &self.plants[member.plant],
            age: member.age,
            place: member.place.map(|x| x as f32),
            own: forms.get(member.species).cloned().unwrap_or_default(),
            seen: member.seen,
        };
        Stand {
            plants: self.members.iter().map(placed).collect(),
            obstacles: self.obstacles.clone(),
            label: self.label.clone(),
        }
    }
}

/// Grows some plants again and keeps each at some of its ages: plant after plant, each age by age in the order asked
/// for. The species are those of the scenario.
///
/// # Errors
/// Those of growing.
pub fn pictured_plants(
    regrowth: &Regrowth,
    species: &[&Species],
    plants: &[u32],
    ages: &[Tick],
) -> Result<Pictured, RunError> {
    pictured_plants_at(regrowth, species, plants, &moments(ages))
}

/// As [`pictured_plants`] at ages that may lie between two ticks.
///
/// # Errors
/// Those of growing.
pub fn pictured_plants_at(
    regrowth: &Regrowth,
    species: &[&Species],
    plants: &[u32],
    ages: &[Moment],
) -> Result<Pictured, RunError> {
    let trial = regrowth.trial();
    let mut stands = Vec::new();
    let mut shown = BTreeSet::new();
    for &number in plants {
        let place = trial.species_of_plant(number);
        shown.insert(place);
        let mut seen = BTreeMap::new();
        regrowth.show_at(number, ages, &mut |age, plant| {
            seen.insert(age, plant.clone());
            Ok(())
        })?;
        for &age in ages {
            let whose = if plants.len() > 1 { format!("plant {number}, ") } else { String::new() };
            let Some(plant) = seen.get(&age).cloned() else { continue };
            let mut stand = stand_of_plant(trial, species, Cow::Owned(plant), (age, age));
            stand.label.insert_str(0, &whose);
            stands.push(stand);
        }
    }
    let names: Vec<&str> = shown.iter().map(|place| species[*place].about.name.as_str()).collect();
    let seed = trial.scenario().seed;
    let note = format!("{}: plants {plants:?} at the ages {} of seed {seed}", names.join(", "), list(ages));
    Ok(Pictured { stands, title: titles_of(species, &shown), note })
}

/// Grows a plot again and keeps it at some ticks, in the order asked for: all its plants that are sown. Where `apart`,
/// equal plants are kept each.
///
/// # Errors
/// Those of growing.
pub fn pictured_plot(
    regrowth: &Regrowth,
    species: &[&Species],
    (plot, ticks): (u32, &[Tick]),
    apart: bool,
) -> Result<Pictured, RunError> {
    pictured_plot_at(regrowth, species, (plot, &moments(ticks)), apart)
}

/// As [`pictured_plot`] at ticks and between them.
///
/// # Errors
/// Those of growing.
pub fn pictured_plot_at(
    regrowth: &Regrowth,
    species: &[&Species],
    (plot, ticks): (u32, &[Moment]),
    apart: bool,
) -> Result<Pictured, RunError> {
    let trial = regrowth.trial();
    let scenario = trial.scenario();
    let mut seen = BTreeMap::new();
    regrowth.show_plot(plot, ticks, &mut |tick, standing| {
        seen.entry(tick).or_insert_with(|| kept(standing, apart).owned());
        Ok(())
    })?;
    let obstacles = obstacles_of(trial, plot);
    let of_members = |mut stand: PicturedStand<'static>, tick: Moment| {
        stand.obstacles.clone_from(&obstacles);
        stand_of_plot(trial, species, stand, (plot, tick, tick))
    };
    let stands = ticks.iter().filter_map(|tick| seen.remove(tick).map(|stand| of_members(stand, *tick)));
    let stands: Vec<PicturedStand<'static>> = stands.collect();
    let shown = stands.iter().flat_map(|stand| stand.members.iter().map(|member| member.species)).collect();
    let note = format!("{}: plot {plot} at the ticks {} of seed {}", scenario.name, list(ticks), scenario.seed);
    Ok(Pictured { stands, title: titles_of(species, &shown), note })
}

/// Ages that lie at ticks.
fn moments(ages: &[Tick]) -> Vec<Moment> {
    ages.iter().copied().map(Moment::from).collect()
}

/// A plant at an age, by itself, with the age that is told of it.
pub(super) fn stand_of_plant<'p>(
    trial: &Trial,
    species: &[&Species],
    plant: Cow<'p, Plant>,
    (at, told_age): (Moment, Moment),
) -> PicturedStand<'p> {
    let (number, place) = (plant.id, trial.species_of_plant(plant.id));
    let (of, sown) = (trial.plant(number), trial.sown_at(number));
    let (plot, treatment, age) = (of.plot, of.treatment as u32, at.tick());
    let here = PicturedMember { number, plot, treatment, sown, age, species: place, ..PicturedMember::default() };
    let label = label_of_plant(trial, species, number, told_age);
    PicturedStand { plants: vec![plant], members: vec![here], obstacles: Vec::new(), label, light: None }
}

/// A plot at a tick, with the tick that is told of it; it is still to be filled in where its plants belong.
pub(super) fn stand_of_plot<'p>(
    trial: &Trial,
    species: &[&Species],
    mut stand: PicturedStand<'p>,
    (plot, at, told_tick): (u32, Moment, Moment),
) -> PicturedStand<'p> {
    let of_plot = trial.plot(plot);
    for member in &mut stand.members {
        let place = trial.place_in_plot(member.number);
        (member.plot, member.sown, member.place) = (plot, at.tick().saturating_sub(member.age), place);
        member.treatment = of_plot.treatment as u32;
    }
    stand.label = caption_of_plot(trial, species, plot, told_tick);
    stand
}

/// The meshes of the obstacles of a plot's site that are drawn.
pub(super) fn obstacles_of(trial: &Trial, plot: u32) -> Vec<Arc<Mesh>> {
    drawn(&trial.treatments()[trial.plot(plot).treatment].scenario.site)
}

/// The meshes of the obstacles of a site that are drawn; those that nothing is of are left out.
fn drawn(site: &Site) -> Vec<Arc<Mesh>> {
    let mesh = |obstacle: &DrawnObstacle| Some(Arc::new(Solid::of(&obstacle.shape).ok()?.obstacle(obstacle.colour)));
    site.drawn().iter().filter_map(mesh).collect()
}

/// The mesh of a stand of a plot.
pub fn plot_mesh<'a>(
    stand: &'a PicturedStand<'_>,
    regrowth: &Regrowth,
    (plot, tick): (u32, f64),
    (species, forms): (&[&Species], &[Arc<OwnForms>]),
    sides: u32,
) -> PlotMesh<'a> {
    let scenario = regrowth.trial().scenario();
    let member = |member: &PicturedMember| PlotMember {
        body: member.plant,
        place: member.place,
        name: format!("plant {} species {}", member.number, species[member.species].about.name),
    };
    let body = |(place, plant): (usize, &'a Cow<'_, Plant>)| {
        let of = stand.members.iter().find(|member| member.plant == place);
        let own = of.and_then(|of| forms.get(of.species)).cloned().unwrap_or_default();
        PlotBody { plant: plant.as_ref(), age: of.map_or(0, |of| of.age), options: options_of(sides, &own) }
    };
    PlotMesh {
        bodies: stand.plants.iter().enumerate().map(body).collect(),
        members: stand.members.iter().map(member).collect(),
        obstacles: stand.obstacles.clone(),
        name: format!("plot {plot} tick {tick} seed {}", scenario.seed),
        place: regrowth.plot_place(plot),
    }
}

/// What tells plants apart at a glance: species, age, and how many internodes and organs there are.
type Glance = (usize, Tick, usize, usize);

/// A plant that is kept, by its place among those that are, and the digest of its mesh where one was needed.
type Kept = (usize, Option<[u8; 32]>);

/// The plants of a plot, equal ones once unless they are to be kept apart; where they belong is still to be filled in.
pub(super) fn kept<'p>(standing: &'p [Standing<'_>], apart: bool) -> PicturedStand<'p> {
    let light = standing.first().and_then(|standing| standing.light.clone());
    let (plants, members, obstacles) = (Vec::new(), Vec::new(), Vec::new());
    let mut stand = PicturedStand { plants, members, obstacles, label: String::new(), light };
    let mut alike: BTreeMap<Glance, Vec<Kept>> = BTreeMap::new();
    for Standing { plant, age, species, .. } in standing {
        let known = alike.entry((*species, *age, plant.nodes.len(), plant.organs.len())).or_default();
        // A plant that is like no other at a glance needs no closer look.
        let own = (!known.is_empty()).then(|| look_of(plant, *age));
        let equal = known.iter_mut().find_map(|(kept, look)| {
            let look = *look.get_or_insert_with(|| look_of(&stand.plants[*kept], *age));
            (!apart && own == Some(look)).then_some(*kept)
        });
        let body = equal.unwrap_or(stand.plants.len());
        if body == stand.plants.len() {
            known.push((body, own));
            stand.plants.push(Cow::Borrowed(plant.as_ref()));
        }
        let (number, species, age) = (plant.id, *species, *age);
        let member = PicturedMember { number, plant: body, species, age, ..PicturedMember::default() };
        stand.members.push(member);
    }
    stand
}

/// The digest of a plant's mesh.
fn look_of(plant: &Plant, age: Tick) -> [u8; 32] {
    let mut digest = Sha256::new();
    let scene = Scene::new(plant, age, &MeshOptions::default());
    let told = scene.vertices(&mut Chunk::new(), &mut |chunk| {
        digest.update(chunk.filled());
        chunk.clear();
        Ok(())
    });
    debug_assert!(told.is_ok(), "a digest takes every chunk");
    digest.finalize().into()
}
