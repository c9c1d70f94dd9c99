//! `picture` of a run of measured plants: where they were measured, at an age at which they were.

use super::super::measured::Measured;
use super::super::{Misuse, Verdict, amounts, out};
use super::{Picture, Style, focus};
use anyhow::Result;
use phytomer_outputs::Destination;
use phytomer_outputs::meshes::MeshOptions;
use phytomer_outputs::pictures::{MOST_SUBJECTS, Placed, Stand, View, draw_stands, sheet_of_stands};

/// Draws the plants that are asked for.
pub fn obey(picture: &Picture, measured: &Measured) -> Result<Verdict> {
    let shown = measured.shown();
    let part = picture.part.used().next();
    measured.refuse([
        ("--plot", picture.plot.is_some()),
        ("--ages", !picture.ages.is_empty()),
        ("--framed-for", picture.framed_for.is_some()),
        ("--colour-by", picture.colour_by.is_some()),
        ("--range", !picture.range.is_empty()),
        ("--wind", picture.breeze.is_stated()),
        ("--fall", picture.fall.fall),
        ("-D", !picture.constants.is_empty()),
        (part.unwrap_or_default(), part.is_some()),
    ])?;
    let age = measured.age(picture.age)?;
    let plants = measured.plants.at(age);
    let asked = if picture.plants.is_empty() { vec![picture.plant.unwrap_or(0)] } else { picture.plants.clone() };
    if asked.len() > MOST_SUBJECTS {
        return Err(Misuse(format!("one picture has at most {MOST_SUBJECTS} plants")).into());
    }
    let mut stands = Vec::new();
    for number in &asked {
        let (own, seen) = Default::default();
        let plant = measured.plant(&plants, *number)?;
        stands.push(Stand {
            plants: vec![Placed { plant, age, place: [0.0; 3], own, seen }],
            obstacles: Vec::new(),
            label: format!("plant {number}"),
        });
    }
    let focus = match (picture.focus, asked.as_slice()) {
        (None, _) => None,
        (Some(wanted), [number]) => {
            let plant = measured.plant(&plants, *number)?;
            let options = MeshOptions { detail: picture.detail, ..MeshOptions::default() };
            Some(focus::on(wanted, (plant, *number, age), &options)?)
        }
        (Some(_), _) => {
            return Err(Misuse("--focus: this is for one plant; leave out the others".to_owned()).into());
        }
    };
    let view = picture.view();
    let style = Style { view: view.unwrap_or(View::Front), focus, ..picture.style() };
    let file = Destination::create(&picture.out)?;
    let draw = if view.is_some() { draw_stands } else { sheet_of_stands };
    let canvas = draw(&stands, "measured", &style);
    let bytes = amounts::bytes(picture.save(&canvas, &format!("{shown}: measured plants {asked:?}"), file)? as f64);
    out::tell(&picture.out, &format!("{} as measured, {bytes}", amounts::of(asked.len() as u64, "plant")))?;
    Ok(Verdict::Done)
}
