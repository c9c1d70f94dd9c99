//! `picture`: plants at ages as one PNG file, grown again from their seeds and drawn without a graphics processor.
//!
//! Plants stand side by side in one scale: each plant at each age. Where no age is given a plant is drawn in its prime.
//! With `--plot` all plants of a plot stand in their places, at each tick.
//! Absent: drawing, which is `phytomer_outputs::pictures`'.

mod focus;
mod measured;

use super::afar::{self, Part};
use super::colouring;
use super::constants::Constants;
use super::measured::Measured;
use super::out::{self, Format};
use super::regrown::{Breeze, Fall, Regrown, finite};
use super::span::{Span, age, shown, span};
use super::{Misuse, Verdict, amounts};
use anyhow::{Context, Result};
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use phytomer::run::filming::{Filming, Scene};
use phytomer::run::picturing::{Pictured, PicturedStand, pictured_plants_at, pictured_plot_at};
use phytomer_outputs::Destination;
use phytomer_outputs::colouring::colour_columns;
use phytomer_outputs::pictures::{
    Canvas, Compression, MOST_SUBJECTS, Picture as Style, View, Wanted, draw_stands, sheet_of_stands, write_png,
};
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use std::path::PathBuf;

/// The formats of pictures.
const FORMATS: [Format; 1] = [Format { name: "PNG", extension: "png" }];

/// The most pixels along a side.
const MOST_PIXELS: u32 = 16_384;

/// Draw plants of a run, a scenario or a species as a PNG picture.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer picture coffee --age 48 --out coffee.png
  phytomer picture willow --ages 44,68,92 --size 2400x900 --out life.png
  phytomer picture fir --ages 5,5.25,5.5,5.75,6 --out year.png
  phytomer picture runs/coffee --plants 0,1,2 --age 48 --view front --out three.png
  phytomer picture my_plant/species.toml --view sheet --out sheet.png
  phytomer picture coffee --age 60 --colour-by birth_age --out ages.png
  phytomer picture coffee --age 24 --transparent --no-caption --sun 200,30 --out cut-out.png
  phytomer picture under_a_roof --plot --ages 3,6,12 --out plot.png
  phytomer picture abop/2.8a --age 5 -D lr=1.2 --out tall.png
  phytomer picture monocarp --age 31 --focus flower --detail 3 --out head.png
  phytomer picture wp/quaking_aspen --range 30,120,600 --out ranges.png
  phytomer picture wp/quaking_aspen --levels 0 --wind 5 --gust 3 --time 0.4 --out trunk.png

A plant whose age is not given is drawn at the age that its species states (shown_at), else in its prime: in its
last year with nine tenths of the largest leaf area that it ever bears, as soon as it bears it.")]
pub struct Picture {
    /// A run folder, a scenario or a species: a shipped one by its name, or a file by its path.
    #[arg(value_name = "RUN|SCENARIO|SPECIES")]
    name: String,
    /// The plant's number, from 0.
    #[arg(long, conflicts_with = "plants")]
    plant: Option<u32>,
    /// Several plants side by side, by their numbers.
    #[arg(long, value_delimiter = ',', value_name = "N,N,…")]
    plants: Vec<u32>,
    /// All plants of a plot in their places, any number of them, with the obstacles of its site; the plot's number,
    /// from 0.
    #[arg(long, value_name = "PLOT", num_args = 0..=1, default_missing_value = "0", conflicts_with_all = ["plant", "plants"])]
    plot: Option<u32>,
    /// Its age in ticks; that of its prime if not given. Of a plot its tick; the last if not given. 3.5 is halfway from
    /// tick 3 to tick 4.
    #[arg(long, conflicts_with = "ages", value_parser = age)]
    age: Option<Moment>,
    /// Several ages, of a plot several ticks, side by side, in one scale.
    #[arg(long, value_delimiter = ',', value_name = "AGE,AGE,…", value_parser = age)]
    ages: Vec<Moment>,
    /// Place the camera as for a film of these ages, of a plot ticks: it holds the largest extent, so that pictures of
    /// several ages lie over one another. The last of them is drawn if no age is given.
    #[arg(long, value_name = "FIRST..LAST[/STEP]", value_parser = span, conflicts_with_all = ["ages", "plants", "colour_by"])]
    framed_for: Option<Span>,
    /// The file to write, `-` for stdout. A link stays, and its target is replaced; a pipe or a device is written
    /// through.
    #[arg(long, value_name = "FILE.png")]
    out: PathBuf,
    /// From where the plants are seen.
    #[arg(long, value_enum, default_value_t = From::Perspective)]
    view: From,
    /// Go on around the plants by so many degrees, counterclockwise from above; a flat plant is seen in perspective
    /// from where it is wide if not given.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = finite)]
    turn: Option<f64>,
    /// Width and height, pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1600x1200", value_parser = size)]
    size: [u32; 2],
    /// Leave the background out; shadows stay, half transparent.
    #[arg(long)]
    transparent: bool,
    /// Draw neither ground nor the shadow on it. The ground is level and passes through the seeds; what lies below it
    /// is seen without it.
    #[arg(long)]
    no_ground: bool,
    /// Write nothing on the picture, not even the scale bar.
    #[arg(long)]
    no_caption: bool,
    /// Where the sun stands: degrees from the X axis (east) to the Y axis (north), and above the horizon. Over the left
    /// shoulder of whoever looks if not given.
    #[arg(long, value_name = "AZIMUTH,ELEVATION", allow_negative_numbers = true, value_parser = sun)]
    sun: Option<[f32; 2]>,
    /// How finely leaves, flowers and fruits are drawn: 0, a few polygons, to 3, for close-ups. An organ that is small
    /// in the picture is drawn with less.
    #[arg(long, value_name = "0…3", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=3))]
    detail: u8,
    /// Fill the picture with one organ of the first plant: the largest `leaf`, `flower` or `fruit`, or a component by
    /// its number.
    #[arg(long, value_name = "leaf|flower|fruit|COMPONENT", value_parser = focus::wanted, conflicts_with_all = ["framed_for", "view"])]
    focus: Option<Wanted>,
    /// Sides of the tube that each internode is drawn as. If not given, wood is drawn along its axes, as round as half
    /// a pixel asks.
    #[arg(long, value_parser = clap::value_parser!(u8).range(3..=64))]
    sides: Option<u8>,
    /// Colour the components by a column of `records`, by `species`, or those of a --plot by their `light`, with a
    /// legend.
    #[arg(long, value_name = "COLUMN", value_parser = PossibleValuesParser::new(colour_columns()), hide_possible_values = true)]
    colour_by: Option<String>,
    #[command(flatten)]
    part: Part,
    /// Draw a tree of stems with what is left of it from so many metres away, as large as it is seen nearby (Weber &
    /// Penn 1995 §5); several ranges stand side by side.
    #[arg(long, value_delimiter = ',', value_name = "METRES,…", allow_negative_numbers = true, value_parser = afar::metres, conflicts_with = "framed_for")]
    range: Vec<f64>,
    #[command(flatten)]
    fall: Fall,
    #[command(flatten)]
    constants: Constants,
    #[command(flatten)]
    breeze: Breeze,
}

/// The views by their words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum From {
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
    /// The four parallel views on one sheet, in one scale.
    Sheet,
}

impl Picture {
    pub fn obey(self) -> Result<Verdict> {
        out::check(&self.out, "picture", &FORMATS)?;
        if let Some(measured) = Measured::of(&self.name)? {
            return measured::obey(&self, &measured);
        }
        let ages: Vec<Moment> = if self.ages.is_empty() { self.age.into_iter().collect() } else { self.ages.clone() };
        colouring::whole(self.age_option(), &ages, self.colour_by.as_ref())?;
        let framed = self.framed_for.map(|framed| framed.until());
        let needed: Vec<Tick> = ages.iter().map(|age| age.tick()).chain(framed).collect();
        let regrown = match Regrown::find(&self.name, &self.constants, &needed)? {
            Ok(regrown) => self.part.of(regrown, if self.range.is_empty() { &[] } else { &["--range"] })?,
            Err(verdict) => return Ok(verdict),
        };
        if self.range.is_empty() {
            self.part.needs_range()?;
        }
        match self.framed_for {
            None => self.write(&regrown, ages),
            Some(framed) => self.write_framed(&regrown, framed),
        }
    }

    /// The picture of one age by the camera of a film of several.
    fn write_framed(&self, regrown: &Regrown, framed: Span) -> Result<Verdict> {
        let Some(view) = self.view() else {
            return Err(Misuse("--framed-for: a sheet has four cameras; choose another --view".to_owned()).into());
        };
        let (whose, _) = shown(regrown, (self.plant.unwrap_or(0), self.plot), Some(framed), "--framed-for")?;
        let age = self.age.or(Moment::of(framed.last)).unwrap_or(Moment::from(0));
        let at = age.age();
        if !framed.has(at) {
            return Err(Misuse(format!("--age {at}: it is none of the ages of --framed-for")).into());
        }
        let regrowth = regrown.regrowth(&self.breeze)?.falling(self.fall.fall);
        let species = regrown.species();
        let scene = Scene {
            regrowth: &regrowth,
            species: &species,
            forms: &regrown.forms,
            whose,
            style: Style { view, ..self.style() },
            time: framed.timeline(((framed.last - framed.first) / framed.step.unwrap_or(1.0)).round() as u32 + 1),
            every_tick: framed.step.is_none(),
            fps: 1,
            orbit: 0.0,
            follow: false,
            air_from: self.breeze.air().map(|air| air.time),
        };
        let file = Destination::create(&self.out)?;
        let surveyed = scene.survey(false, &Filming::default())?;
        let canvas = scene.still(&surveyed, age)?.context("nothing stands at this age")?;
        let note = format!("{} at {at} of the ages {} to {}", regrown.scenario.name, framed.first, framed.last);
        let bytes = amounts::bytes(self.save(&canvas, &note, file)? as f64);
        out::tell(&self.out, &format!("age {at} of {} to {}, {bytes}", framed.first, framed.last))?;
        Ok(Verdict::Done)
    }

    fn write(&self, regrown: &Regrown, ages: Vec<Moment>) -> Result<Verdict> {
        let (file, mut pictured, what) = match self.plot {
            Some(plot) => self.plot(regrown, plot, ages)?,
            None => self.plants(regrown, ages)?,
        };
        self.see(&mut pictured, regrown)?;
        let canvas = self.draw(&pictured, regrown)?;
        let bytes = amounts::bytes(self.save(&canvas, &pictured.note, file)? as f64);
        out::tell(&self.out, &format!("{what}{}, {bytes}", self.breeze.in_words()))?;
        Ok(Verdict::Done)
    }

    /// The plants that are asked for, each at each age, and what they are in words; the file is there before they grow.
    fn plants(&self, regrown: &Regrown, mut ages: Vec<Moment>) -> Result<(Destination, Pictured, String)> {
        let plants = if self.plants.is_empty() { vec![self.plant.unwrap_or(0)] } else { self.plants.clone() };
        let plant_option = if self.plants.is_empty() { "--plant" } else { "--plants" };
        regrown.check((self.age_option(), &in_ticks(&ages)), (plant_option, &plants))?;
        let regrowth = regrown.regrowth(&self.breeze)?.falling(self.fall.fall);
        if ages.is_empty() {
            ages.push(regrowth.shown_at(regrown.species_of(plants[0]), plants[0])?.into());
        }
        self.few(ages.len() * plants.len(), "plants, counted at each age")?;
        let file = Destination::create(&self.out)?;
        let pictured = pictured_plants_at(&regrowth, &regrown.species(), &plants, &ages)?;
        let drawn = pictured.stands.len();
        let whom = if drawn == 1 { format!("plant {}", plants[0]) } else { format!("{drawn} plants") };
        let when = if ages.len() == 1 { format!(" at age {}", ages[0].age()) } else { String::new() };
        Ok((file, pictured, whom + &when))
    }

    /// The plot that is asked for at each tick, and what it is in words; the file is there before it grows.
    fn plot(&self, regrown: &Regrown, plot: u32, mut ticks: Vec<Moment>) -> Result<(Destination, Pictured, String)> {
        regrown.check_plot((self.age_option(), &in_ticks(&ticks)), plot)?;
        if ticks.is_empty() {
            ticks.push(regrown.scenario.ages.until.into());
        }
        self.few(ticks.len(), "plots, counted at each tick")?;
        let regrowth = regrown.regrowth(&self.breeze)?.falling(self.fall.fall);
        // A colour may tell plants apart that look alike.
        let apart = self.colour_by.is_some();
        let file = Destination::create(&self.out)?;
        let pictured = pictured_plot_at(&regrowth, &regrown.species(), (plot, &ticks), apart)?;
        let most = pictured.stands.iter().map(|stand| stand.members.len() as u64).max().unwrap_or_default();
        let when = if ticks.len() == 1 { format!(" at tick {}", ticks[0].age()) } else { String::new() };
        Ok((file, pictured, format!("plot {plot}{when}, {}", amounts::of(most, "plant"))))
    }

    /// Leaves of trees of stems what is asked for, once for each range.
    fn see(&self, pictured: &mut Pictured, regrown: &Regrown) -> Result<()> {
        self.few(pictured.stands.len() * self.range.len().max(1), "plants, counted at each range")?;
        let species = regrown.species();
        let seen = |stand: &PicturedStand<'static>, metres: Option<f64>| {
            let mut stand = stand.clone();
            for member in &mut stand.members {
                member.seen = self.part.seen(species[member.species], member.age, metres, false);
            }
            metres.iter().for_each(|metres| stand.label = format!("{}, {metres} m", stand.label));
            stand
        };
        let ranges: Vec<Option<f64>> = self.range.iter().copied().map(Some).collect();
        let ranges = if ranges.is_empty() { vec![None] } else { ranges };
        pictured.stands = pictured.stands.iter().flat_map(|stand| ranges.iter().map(|r| seen(stand, *r))).collect();
        Ok(())
    }

    fn age_option(&self) -> &'static str {
        if self.ages.is_empty() { "--age" } else { "--ages" }
    }

    fn few(&self, count: usize, what: &str) -> Result<()> {
        if count > MOST_SUBJECTS {
            return Err(Misuse(format!("one picture has at most {MOST_SUBJECTS} {what}")).into());
        }
        Ok(())
    }

    fn draw(&self, pictured: &Pictured, regrown: &Regrown) -> Result<Canvas> {
        let view = self.view();
        let colour_by =
            self.colour_by.as_ref().map(|column| colouring::values(column, pictured, regrown)).transpose()?;
        let focus = self.focus.map(|wanted| focus::of(wanted, pictured, regrown, self.detail)).transpose()?;
        let style = Style { view: view.unwrap_or(View::Front), colour_by, focus, ..self.style() };
        let stands = pictured.stands(&regrown.forms);
        let draw = if view.is_some() { draw_stands } else { sheet_of_stands };
        Ok(draw(&stands, &pictured.title, &style))
    }

    /// The view; `None` for a sheet of several.
    fn view(&self) -> Option<View> {
        match self.view {
            From::Perspective => Some(View::Perspective),
            From::Top => Some(View::Top),
            From::Front => Some(View::Front),
            From::Side => Some(View::Side),
            From::Oblique => Some(View::Oblique),
            From::Sheet => None,
        }
    }

    /// What is asked for but the view and the colours.
    fn style(&self) -> Style {
        Style {
            size: self.size,
            turn: self.turn.map(|turn| (turn % 360.0).to_radians() as f32),
            transparent: self.transparent,
            ground: !self.no_ground,
            caption: !self.no_caption,
            sun: self.sun.map(|sun| sun.map(f32::to_radians)),
            sides: self.sides,
            detail: self.detail,
            ..Style::default()
        }
    }

    fn save(&self, canvas: &Canvas, note: &str, mut file: Destination) -> Result<u64> {
        let written = write_png(canvas, note, Compression::Balanced, &mut file);
        written.with_context(|| format!("cannot write {}", self.out.display()))?;
        Ok(file.finish()?)
    }
}

/// Ages as numbers of ticks.
fn in_ticks(ages: &[Moment]) -> Vec<f64> {
    ages.iter().map(|age| age.age()).collect()
}

pub fn size(text: &str) -> std::result::Result<[u32; 2], String> {
    let sides = text.split_once(['x', '×']).and_then(|(a, b)| Some([a.parse().ok()?, b.parse().ok()?]));
    sides
        .filter(|sides: &[u32; 2]| sides.iter().all(|side| (16..=MOST_PIXELS).contains(side)))
        .ok_or_else(|| format!("two sides of 16 to {MOST_PIXELS} pixels are expected, such as 1920x1080"))
}

pub fn sun(text: &str) -> std::result::Result<[f32; 2], String> {
    let angles = text.split_once(',').and_then(|(a, b)| Some([a.trim().parse().ok()?, b.trim().parse().ok()?]));
    angles
        .filter(|[azimuth, elevation]: &[f32; 2]| azimuth.is_finite() && (3.0..=90.0).contains(elevation))
        .ok_or_else(|| "an azimuth and an elevation of 3 to 90 degrees are expected, such as 220,45".to_owned())
}
