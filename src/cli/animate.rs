//! `animate`: a plant, or a plot, from age to age as a film, grown again and drawn without a graphics processor.
//!
//! The format is that of the ending, `-` is a stream of bare frames for a pipe, a folder gets a PNG a frame. Ctrl-C
//! ends the film with what is drawn. Absent: growing and drawing, which is `run::filming`'s, and the formats.

mod formats;

use super::constants::Constants;
use super::regrown::{Breeze, Fall, Regrown, finite};
use super::span::{Span, shown, span};
use super::{Verdict, amounts, bar, interrupt, out, picture, terminal};
use anyhow::Result;
use clap::{Args, ValueEnum};
use formats::{Format, Output};
use phytomer::run::RunError;
use phytomer::run::filming::{FilmError, Filming, Scene, Shot};
use phytomer::run::regrowth::Whose;
use phytomer_outputs::films::Film;
use phytomer_outputs::pictures::{Picture as Style, View};
use phytomer_sim::Tick;
use phytomer_sim::mechanics::sway::GUSTS_S;
use std::path::PathBuf;
use std::sync::Arc;

/// The length of a film that is not given, seconds.
const SECONDS: f64 = 12.0;
/// The longest film, seconds.
const LONGEST: f64 = 600.0;

/// Draw plants of a run, a scenario or a species from age to age as a film.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer animate coffee --out life.webp
  phytomer animate coffee --ages 1..48 --seconds 8 --size 640x480 --out coffee.gif
  phytomer animate fir --ages 1..20 --fall --out years.webp
  phytomer animate coffee --ages 4..48/4 --orbit 90 --follow --out around.apng
  phytomer animate under_a_roof --plot --out plot.mp4
  phytomer animate willow --ages 60 --wind 8 --fps 12 --out wind.webp
  phytomer animate wp/quaking_aspen --ages 1 --wind 5 --gust 3 --loop 6 --out sway.webp
  phytomer animate coffee --ages 12..48 --out frames/
  phytomer animate monocarp --ages 24..34 --detail 3 --out bloom.webp
  phytomer animate coffee --size 960x720 --out - | mpv -

The ending says the format: .webp (small, lossy), .gif (plays everywhere, 255 colours), .apng (no pixel is lost), .y4m
(bare frames for other programs, `-` into a pipe), .mp4 and .webm (through an ffmpeg on the path); a folder, by a slash
at its end, gets a PNG for each frame. The camera holds the largest extent of the film, so that only the plants move. A
frame is the picture of its age: `phytomer picture NAME --age 48 --framed-for 1..96` draws it.")]
pub struct Animate {
    /// A run folder, a scenario or a species: a shipped one by its name, or a file by its path.
    #[arg(value_name = "RUN|SCENARIO|SPECIES")]
    name: String,
    /// The plant's number, from 0.
    #[arg(long, default_value_t = 0)]
    plant: u32,
    /// All plants of a plot in their places; the plot's number, from 0.
    #[arg(long, value_name = "PLOT", num_args = 0..=1, default_missing_value = "0", conflicts_with = "plant")]
    plot: Option<u32>,
    /// The ages, of a plot the ticks, from the first to the last; from 1 to the last of the run if not given. Where
    /// there are more frames than ticks the plants grow on between ticks; with a step after a slash the ages are a step
    /// apart and held. One age by itself is for films of wind and of a walk around the plant.
    #[arg(long, value_name = "FIRST..LAST[/STEP]", value_parser = span)]
    ages: Option<Span>,
    /// The length of the film; 12 if not given, of one age in the wind that of --loop, or of
    /// a gust, 8.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = seconds)]
    seconds: Option<f64>,
    /// Frames a second.
    #[arg(long, default_value_t = 24, value_parser = clap::value_parser!(u32).range(1..=120))]
    fps: u32,
    /// The file to write, `-` for stdout. A link stays, and its target is replaced; a pipe or a device is written
    /// through.
    #[arg(long, value_name = "FILE.webp")]
    out: PathBuf,
    /// Width and height, pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720", value_parser = picture::size)]
    size: [u32; 2],
    /// Walk around the plants by so many degrees over the film, counterclockwise from above; with 360 it goes on from
    /// its end to its beginning.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_negative_numbers = true, value_parser = finite)]
    orbit: f64,
    /// Let the camera hold what has grown until each frame, and so draw back as the plants grow.
    #[arg(long)]
    follow: bool,
    /// From where the plants are seen.
    #[arg(long, value_enum, default_value_t = From::Perspective)]
    view: From,
    /// Go on around the plants by so many degrees before the first frame; a flat plant is seen in perspective from
    /// where it is wide if not given.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = finite)]
    turn: Option<f64>,
    /// Draw neither ground nor the shadow on it.
    #[arg(long)]
    no_ground: bool,
    /// Write nothing on the pictures, not even the scale bar.
    #[arg(long)]
    no_caption: bool,
    /// Where the sun stands: degrees from the X axis (east) to the Y axis (north), and above the horizon. Over the left
    /// shoulder of whoever looks at the first frame if not given.
    #[arg(long, value_name = "AZIMUTH,ELEVATION", allow_negative_numbers = true, value_parser = picture::sun)]
    sun: Option<[f32; 2]>,
    /// How finely leaves, flowers and fruits are drawn: 0, a few polygons, to 3, for close-ups. An organ that is small
    /// in the film is drawn with less.
    #[arg(long, value_name = "0…3", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=3))]
    detail: u8,
    /// Sides of the tube that each internode is drawn as. If not given, wood is drawn along its axes, as round as half
    /// a pixel asks.
    #[arg(long, value_parser = clap::value_parser!(u8).range(3..=64))]
    sides: Option<u8>,
    /// The quality of WebP: small files at 1, fine ones at 100.
    #[arg(long, default_value_t = 80, value_parser = clap::value_parser!(u8).range(1..=100))]
    quality: u8,
    /// Show no progress.
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    fall: Fall,
    #[command(flatten)]
    constants: Constants,
    #[command(flatten)]
    breeze: Breeze,
}

/// The views by their words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum From {
    /// An eye a little above the ground.
    Perspective,
    /// From above, north up.
    Top,
    /// From the south.
    Front,
    /// From the east.
    Side,
    /// From the south-east and above, in parallel projection.
    Oblique,
}

impl Animate {
    pub fn obey(self) -> Result<Verdict> {
        let format = Format::of(&self.out)?;
        format.check(self.size, self.fps)?;
        let asked: Vec<Tick> = self.ages.iter().map(Span::until).collect();
        match Regrown::find(&self.name, &self.constants, &asked)? {
            Ok(regrown) => self.film(&regrown, format),
            Err(verdict) => Ok(verdict),
        }
    }

    fn film(&self, regrown: &Regrown, format: Format) -> Result<Verdict> {
        let (whose, ages) = shown(regrown, (self.plant, self.plot), self.ages, "--ages")?;
        let regrowth = regrown.regrowth(&self.breeze)?.falling(self.fall.fall);
        let air_from = self.breeze.air().map(|air| air.time);
        let of_wind = self.breeze.closes().unwrap_or(GUSTS_S);
        let usual = if air_from.is_some() && ages.first == ages.last { of_wind } else { SECONDS };
        let frames = (self.seconds.unwrap_or(usual) * f64::from(self.fps)).round().max(1.0) as u32;
        let (species, time) = (regrown.species(), ages.timeline(frames));
        let scene = Scene {
            regrowth: &regrowth,
            species: &species,
            forms: &regrown.forms,
            whose,
            style: self.style(),
            time,
            every_tick: ages.step.is_none() && time.step < 1.0,
            fps: self.fps,
            orbit: self.orbit.to_radians() as f32,
            follow: self.follow,
            air_from,
        };
        let note = format!("{}: {} of seed {}", regrown.scenario.name, what(whose, ages), regrown.scenario.seed);
        let film = Film { size: self.size, fps: self.fps, frames, pictures: scene.pictures(), note };
        let mut output = Output::create(&self.out, format, &film)?;
        let filming = Arc::new(Filming::default());
        let (asked, told) = (Arc::clone(&filming), Arc::clone(&filming));
        let words = "stopping; the film ends with the frames that are drawn";
        interrupt::listen(move || asked.is_stopped(), move || told.stop(), words)?;
        let made = bar::filming(&filming, frames, self.quiet, || self.make(&scene, &film, &mut output, &filming));
        let shot = match made {
            Ok(shot) => shot,
            Err(error) => match error.downcast_ref::<FilmError>() {
                Some(FilmError::Run(RunError::Stopped)) => Shot { frames: 0, complete: false },
                _ => return Err(error),
            },
        };
        self.tell(&film, shot, output, &what(whose, ages))
    }

    fn make(&self, scene: &Scene, film: &Film, output: &mut Output, filming: &Filming) -> Result<Shot> {
        let surveyed = scene.survey(output.learns(), filming).map_err(FilmError::Run)?;
        let mut encoder = output.encoder(film, self.quality, &surveyed.samples)?;
        scene.shoot(&surveyed, filming, &mut *encoder).map_err(|error| match error {
            FilmError::Write(error) => {
                anyhow::Error::from(error).context(format!("cannot write {}", self.out.display()))
            }
            error => error.into(),
        })
    }

    fn style(&self) -> Style {
        let view = match self.view {
            From::Perspective => View::Perspective,
            From::Top => View::Top,
            From::Front => View::Front,
            From::Side => View::Side,
            From::Oblique => View::Oblique,
        };
        Style {
            size: self.size,
            view,
            turn: self.turn.map(|turn| (turn % 360.0).to_radians() as f32),
            ground: !self.no_ground,
            caption: !self.no_caption,
            sun: self.sun.map(|sun| sun.map(f32::to_radians)),
            sides: self.sides,
            detail: self.detail,
            ..Style::default()
        }
    }

    fn tell(&self, film: &Film, shot: Shot, output: Output, what: &str) -> Result<Verdict> {
        if shot.frames == 0 {
            terminal::say("stopped before the first frame; nothing was written");
            return Ok(Verdict::Interrupted);
        }
        let bytes = output.finish()?;
        let bytes = bytes.map(|bytes| format!(", {}", amounts::bytes(bytes as f64))).unwrap_or_default();
        let seconds = f64::from(shot.frames) / f64::from(film.fps);
        let frames = amounts::of(shot.frames.into(), "frame");
        let breeze = self.breeze.air().map(|air| format!(" in a wind of {} m/s", air.wind.speed)).unwrap_or_default();
        if shot.complete {
            out::tell(&self.out, &format!("{what}{breeze}, {frames} in {seconds:.1} s{bytes}"))?;
            return Ok(Verdict::Done);
        }
        let shown = self.out.display();
        terminal::say(&format!("stopped; {shown} has the first {} of {} frames{bytes}", shot.frames, film.frames));
        Ok(Verdict::Interrupted)
    }
}

/// What is shown at what ages, in words.
fn what(whose: Whose, Span { first, last, .. }: Span) -> String {
    let (whose, unit) = match whose {
        Whose::Plant(plant) => (format!("plant {plant}"), "age"),
        Whose::Plot(plot) => (format!("plot {plot}"), "tick"),
    };
    if first == last { format!("{whose} at {unit} {first}") } else { format!("{whose} from {unit} {first} to {last}") }
}

fn seconds(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= LONGEST => Ok(seconds),
        _ => Err(format!("a length above 0 and up to {LONGEST} seconds is expected")),
    }
}
