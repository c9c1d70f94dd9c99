//! A film of a plant, or of a plot, that grows: the camera, the captions, and one picture after another.
//!
//! The plants are grown twice, never once a frame: first to find what the camera has to hold, then to be drawn at each
//! age as they come to it. A frame is the picture of its age by that camera, so a film is as many pictures; where
//! neither the viewer nor the air moves, a picture is drawn once for as many frames as it is held. Each is drawn on all
//! threads and handed on in order; a thread of its own encodes it while the next is drawn. Memory holds a plant, a few
//! pictures, and for each age what its camera holds. Absent: formats of films, which are `phytomer_films`'; several
//! treatments side by side.

use super::RunError;
use super::captions::{caption_of_plant, titles_of};
use super::picturing::{PicturedStand, kept, obstacles_of, stand_of_plant, stand_of_plot};
use super::regrowth::{Regrowth, Standing, Whose};
use phytomer_config::{Species, Trial};
use phytomer_outputs::films::{Encoder, Timeline};
use phytomer_outputs::meshes::{Mesh, OwnForms};
use phytomer_outputs::pictures::{Canvas, Framing, Picture, Survey, draw_framed, draw_stands};
use phytomer_sim::between::Moment;
use phytomer_sim::mechanics::sway::GUSTS_S;
use phytomer_sim::{RecordError, Tick};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::f32::consts::TAU;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};
use std::sync::mpsc::sync_channel;
use std::thread;

/// The pictures of which a film in few colours learns them, and the height of each.
const LEARNT_FROM: usize = 16;
const LEARNT_HEIGHT: u32 = 240;
/// The pictures that wait for the encoder.
const WAITING: usize = 1;
/// What looking at an age for the camera costs, and what drawing it does, for the progress.
const COSTS: [u32; 2] = [1, 8];

/// What a film shows, and how.
#[derive(Clone)]
pub struct Scene<'a> {
    /// How the plants grow, and the air that moves them.
    pub regrowth: &'a Regrowth<'a>,
    /// The species of the run.
    pub species: &'a [&'a Species],
    /// Their forms.
    pub forms: &'a [Arc<OwnForms>],
    /// What is shown.
    pub whose: Whose,
    /// How it is drawn; of `turn`, where the viewer stands at the first frame. `colour_by` is not for films.
    pub style: Picture,
    /// The ages, of a plot the ticks.
    pub time: Timeline,
    /// Whether the camera is placed by every tick from the first age to the last, so that one camera serves any age
    /// between; else by the ages that are shown.
    pub every_tick: bool,
    /// Frames a second.
    pub fps: u32,
    /// How far the viewer walks around the plants over the film, counterclockwise from above, radians.
    pub orbit: f32,
    /// Whether the camera holds what has grown until a frame, not what grows in the whole film.
    pub follow: bool,
    /// The moment of the first frame in the air that moves the plants, seconds; `None` in still air.
    pub air_from: Option<f64>,
}

/// What the camera has to hold, and pictures to learn colours from.
#[derive(Debug, Clone, Default)]
pub struct Surveyed {
    /// Of each age that is shown, by its number: all alike unless the camera follows.
    framings: Vec<Option<Framing>>,
    /// Small pictures of ages all over the film, where they are asked for.
    pub samples: Vec<Canvas>,
}

/// How far a film has come.
#[derive(Debug, Default)]
pub struct Filming {
    stop: AtomicBool,
    done: AtomicU32,
    in_all: AtomicU32,
    frames: AtomicU32,
}

/// What came of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shot {
    /// The frames that it has.
    pub frames: u32,
    /// Whether these are all.
    pub complete: bool,
}

/// Why there is no film.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// The plants cannot be grown.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The film cannot be written.
    #[error("cannot write the film")]
    Write(#[source] io::Error),
}

impl Filming {
    /// Asks the film to end with what is drawn.
    pub fn stop(&self) {
        self.stop.store(true, Relaxed);
    }

    /// Whether it was asked to stop.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Relaxed)
    }

    /// The share of the work that is done, in [0, 1].
    pub fn share(&self) -> f64 {
        f64::from(self.done.load(Relaxed)) / f64::from(self.in_all.load(Relaxed).max(1))
    }

    /// The frames that are drawn.
    pub fn frames(&self) -> u32 {
        self.frames.load(Relaxed)
    }

    /// Says how many steps there are in all.
    pub(super) fn begin(&self, steps: u32) {
        self.in_all.store(steps, Relaxed);
    }

    /// A step is done.
    pub(super) fn step(&self) {
        self.done.fetch_add(1, Relaxed);
    }

    pub(super) fn check(&self) -> Result<(), RunError> {
        if self.is_stopped() { Err(RunError::Stopped) } else { Ok(()) }
    }
}

impl Scene<'_> {
    /// How many pictures the film has: one for each age that is shown, or one for each frame where something moves.
    pub fn pictures(&self) -> u32 {
        if self.moves() { self.time.frames } else { self.time.held().len() as u32 }
    }

    /// The names of what is shown, for the corner of each picture.
    pub fn title(&self) -> String {
        let trial = self.regrowth.trial();
        let shown: BTreeSet<usize> = match self.whose {
            Whose::Plant(plant) => [trial.species_of_plant(plant)].into(),
            Whose::Plot(plot) => members_of(trial, plot).map(|plant| trial.species_of_plant(plant)).collect(),
        };
        titles_of(self.species, &shown)
    }

    fn moves(&self) -> bool {
        self.orbit != 0.0 || self.air_from.is_some()
    }

    /// The age with a number.
    fn age(&self, number: u32) -> Moment {
        Moment::of(self.time.age(number)).unwrap_or(Moment::from(0))
    }

    /// The times at which an age is shown, seconds: one for each of its frames where the air moves. A film of one age
    /// lasts as many gusts as come nearest to its length, so that it goes on from its end to its beginning.
    fn times(&self, held: &[(u32, u32)]) -> Vec<(Moment, Vec<f64>)> {
        let one_age = held.len() == 1;
        let seconds = f64::from(self.time.frames) / f64::from(self.fps.max(1));
        let loops = (seconds / GUSTS_S).round().max(1.0) * GUSTS_S;
        let length = if one_age { loops } else { seconds };
        let mut frame = 0;
        let times = |&(number, frames): &(u32, u32)| {
            let first = frame;
            frame += frames;
            let at = |frame: u32| length * f64::from(frame) / f64::from(self.time.frames);
            let times = self.air_from.map_or_else(|| vec![0.0], |from| (first..frame).map(|k| from + at(k)).collect());
            (self.age(number), times)
        };
        held.iter().map(times).collect()
    }

    /// The ages by which the camera is placed, with their times: where it follows and in moving air always those that
    /// are shown.
    fn surveyed(&self, held: &[(u32, u32)]) -> Vec<(Moment, Vec<f64>)> {
        let ends = Moment::of(self.time.first).zip(Moment::of(self.time.last));
        let Some((first, last)) = ends.filter(|_| self.every_tick && !self.follow && self.air_from.is_none()) else {
            return self.times(held);
        };
        let ticks = (first.tick()..=last.tick()).map(Moment::from).filter(|tick| first < *tick && *tick < last);
        let mut ages: Vec<Moment> = [first].into_iter().chain(ticks).chain([last]).collect();
        ages.dedup();
        ages.into_iter().map(|age| (age, vec![0.0])).collect()
    }

    /// Shows the stand at each of some ages, once for each of its times, with its number among them.
    fn each_stand(
        &self,
        times: &[(Moment, Vec<f64>)],
        show: &mut dyn FnMut(usize, &PicturedStand<'_>) -> Result<(), RecordError>,
    ) -> Result<(), RunError> {
        let obstacles = match self.whose {
            Whose::Plot(plot) => obstacles_of(self.regrowth.trial(), plot),
            Whose::Plant(_) => Vec::new(),
        };
        let ages: Vec<Moment> = times.iter().map(|(age, _)| *age).collect();
        let place = |age: Moment| times.binary_search_by_key(&age, |(age, _)| *age).ok();
        let of_age = |age: Moment| place(age).map(|place| times[place].1.clone()).unwrap_or_default();
        self.regrowth.show_timed(self.whose, &ages, &of_age, &mut |age, standing| {
            place(age).map_or(Ok(()), |place| show(place, &self.stand(age, standing, &obstacles)))
        })
    }

    /// What stands at an age, with its caption, among the obstacles of a plot. Between two ticks the caption has the
    /// earlier one: a fraction would flicker.
    fn stand<'p>(&self, at: Moment, standing: &'p [Standing<'_>], obstacles: &[Arc<Mesh>]) -> PicturedStand<'p> {
        let trial = self.regrowth.trial();
        let tick = at.age() as Tick;
        let told = Moment::from(tick);
        match (self.whose, standing) {
            (Whose::Plant(plant), [alone, ..]) => {
                let lent = Cow::Borrowed(alone.plant.as_ref());
                let mut stand = stand_of_plant(trial, self.species, lent, (at, told));
                stand.label = caption_of_plant(trial, self.species, plant, told);
                stand
            }
            (Whose::Plant(_), []) => kept(&[], false),
            (Whose::Plot(plot), standing) => {
                let stand = PicturedStand { obstacles: obstacles.to_vec(), ..kept(standing, false) };
                stand_of_plot(trial, self.species, stand, (plot, at, told))
            }
        }
    }

    /// The point around which the viewer walks.
    fn pivot(&self) -> Option<[f32; 3]> {
        let trial = self.regrowth.trial();
        let places: Vec<[f64; 3]> = match self.whose {
            _ if self.orbit == 0.0 => return None,
            Whose::Plant(_) => Vec::new(),
            Whose::Plot(plot) => members_of(trial, plot).map(|plant| trial.place_in_plot(plant)).collect(),
        };
        let bound = |k: usize, sign: f64| places.iter().map(|place| sign * place[k]).fold(f64::NEG_INFINITY, f64::max);
        let middle = |k: usize| if places.is_empty() { 0.0 } else { 0.5 * (bound(k, 1.0) - bound(k, -1.0)) };
        Some([middle(0) as f32, middle(1) as f32, 0.0])
    }

    /// Looks at all ages of the film: what the camera has to hold and, where asked for, pictures to learn colours from.
    ///
    /// # Errors
    /// Those of growing; [`RunError::Stopped`].
    pub fn survey(&self, samples: bool, filming: &Filming) -> Result<Surveyed, RunError> {
        let held = self.time.held();
        let looks = self.surveyed(&held);
        filming.in_all.store(COSTS[0] * looks.len() as u32 + COSTS[1] * self.pictures(), Relaxed);
        let mut survey = Survey::new(&self.style, self.pivot());
        let mut found = Surveyed { framings: vec![None; looks.len()], samples: Vec::new() };
        let apart = looks.len().div_ceil(LEARNT_FROM);
        let title = self.title();
        self.each_stand(&looks, &mut |place, stand| {
            filming.check()?;
            let stand = stand.stand(self.forms);
            survey.add(&stand);
            let learns = samples && (looks.len() - 1 - place).is_multiple_of(apart) && found.framings[place].is_none();
            if learns {
                found.samples.push(draw_stands(&[stand], &title, &self.sample_style()));
            }
            found.framings[place] = survey.framing();
            filming.done.fetch_add(COSTS[0], Relaxed);
            Ok(())
        })?;
        if !self.follow {
            found.framings = vec![survey.framing(); held.len()];
        }
        Ok(found)
    }

    fn sample_style(&self) -> Picture {
        let [width, height] = self.style.size.map(u64::from);
        let small = LEARNT_HEIGHT.min(self.style.size[1]);
        let wide = (width * u64::from(small) / height.max(1)).clamp(16, 4 * u64::from(LEARNT_HEIGHT));
        Picture { size: [wide as u32, small], colour_by: None, ..self.style.clone() }
    }

    /// The picture of an age by the camera of the film; of one of the ages that are shown, as the film has it.
    ///
    /// # Errors
    /// Those of growing.
    pub fn still(&self, surveyed: &Surveyed, age: Moment) -> Result<Option<Canvas>, RunError> {
        let held = self.time.held();
        let place = held.iter().position(|(number, _)| self.age(*number) == age);
        let framing = place.map_or(surveyed.framings.last(), |place| surveyed.framings.get(place));
        let Some(framing) = framing.copied().flatten() else { return Ok(None) };
        let times = place.map(|place| self.times(&held).swap_remove(place));
        let mut still = None;
        self.each_stand(&[times.unwrap_or_else(|| (age, vec![0.0]))], &mut |_, stand| {
            if still.is_none() {
                still = Some(draw_framed(&stand.stand(self.forms), &self.title(), &self.style, &framing));
            }
            Ok(())
        })?;
        Ok(still)
    }

    /// Draws the film and hands each picture on, with how many frames it is held.
    fn draw(
        &self,
        surveyed: &Surveyed,
        filming: &Filming,
        hand_on: &mut dyn FnMut(Canvas, u32) -> Result<(), RunError>,
    ) -> Result<(), RunError> {
        let (held, title) = (self.time.held(), self.title());
        let firsts: Vec<u32> =
            held.iter().scan(0, |first, (_, frames)| Some(std::mem::replace(first, *first + frames))).collect();
        let mut shown_of = vec![0; held.len()];
        self.each_stand(&self.times(&held), &mut |place, stand| {
            let Some(framing) = surveyed.framings[place] else { return Ok(()) };
            let stand = stand.stand(self.forms);
            // In moving air an age comes once for each of its frames.
            let (first, frames) = (firsts[place] + shown_of[place], held[place].1);
            let pictures = if self.air_from.is_none() && self.moves() { frames } else { 1 };
            let each = if self.moves() { 1 } else { frames };
            shown_of[place] += pictures;
            for frame in first..first + pictures {
                filming.check()?;
                let turn = framing.turn + self.orbit * (frame as f32 / self.time.frames as f32);
                let style = Picture { turn: Some(turn % TAU), ..self.style.clone() };
                hand_on(draw_framed(&stand, &title, &style, &framing), each)?;
                filming.done.fetch_add(COSTS[1], Relaxed);
                filming.frames.fetch_add(each, Relaxed);
            }
            Ok(())
        })
    }

    /// Draws the film and writes it; where it is told to stop, with what is drawn by then.
    ///
    /// # Errors
    /// Those of growing and of the encoder. The film is then not complete.
    pub fn shoot(&self, surveyed: &Surveyed, filming: &Filming, encoder: &mut dyn Encoder) -> Result<Shot, FilmError> {
        let (hand_on, waiting) = sync_channel::<(Canvas, u32)>(WAITING);
        let (drawn, written) = thread::scope(|scope| {
            let encoder = &mut *encoder;
            let writer = scope.spawn(move || {
                let add =
                    |frames: u32, (canvas, held): (Canvas, u32)| encoder.picture(&canvas, held).map(|()| frames + held);
                waiting.into_iter().try_fold(0, add)
            });
            let mut hand_on = Some(hand_on);
            let drawn = self.draw(surveyed, filming, &mut |canvas, held| {
                // An encoder that takes no more has failed; its own words are told.
                hand_on.as_ref().map_or(Ok(()), |to| to.send((canvas, held))).map_err(|_| RunError::Stopped)
            });
            drop(hand_on.take());
            (drawn, writer.join().unwrap_or_else(|_| Err(io::Error::other("the encoder broke off"))))
        });
        let frames = written.map_err(FilmError::Write)?;
        match drawn {
            Err(RunError::Stopped) if filming.is_stopped() => {}
            drawn => drawn?,
        }
        if frames > 0 {
            encoder.finish().map_err(FilmError::Write)?;
        }
        Ok(Shot { frames, complete: frames == self.time.frames })
    }
}

/// The numbers of the plants of a plot.
fn members_of(trial: &Trial, plot: u32) -> impl Iterator<Item = u32> {
    let of = trial.plot(plot);
    let members = trial.treatments()[of.treatment].scenario.members();
    of.first_plant..of.first_plant.saturating_add(members)
}
