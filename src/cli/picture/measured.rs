//! `picture` of a run of measured plants: where they were measured, at an age at which they were.

use super::super::{Misuse, Verdict, amounts, out};
use super::{Picture, Style};
use anyhow::{Result, anyhow};
use phytomer_outputs::Destination;
use phytomer_outputs::measured::plants_of;
use phytomer_outputs::pictures::{MOST_SUBJECTS, Placed, Stand, View, draw_stands, sheet_of_stands};
use phytomer_outputs::read::Run;
use std::path::Path;

/// Draws the plants that are asked for.
pub fn obey(picture: &Picture, folder: &Path) -> Result<Verdict> {
    let shown = folder.display();
    let stated = [
        ("--plot", picture.plot.is_some()),
        ("--ages", !picture.ages.is_empty()),
        ("--framed-for", picture.framed_for.is_some()),
        ("--colour-by", picture.colour_by.is_some()),
        ("--range", !picture.range.is_empty()),
    ];
    if let Some((option, _)) = stated.into_iter().find(|(_, stated)| *stated) {
        return Err(
            Misuse(format!("{option}: the plants of {shown} were measured, and this is for plants that grow")).into()
        );
    }
    let run = Run::open(folder)?;
    let (age, plants) =
        plants_of(&run, picture.age.map(|age| age.tick())).map_err(|told| anyhow!("{shown}: {told}"))?;
    let asked = if picture.plants.is_empty() { vec![picture.plant.unwrap_or(0)] } else { picture.plants.clone() };
    if asked.len() > MOST_SUBJECTS {
        return Err(Misuse(format!("one picture has at most {MOST_SUBJECTS} plants")).into());
    }
    let mut stands = Vec::new();
    for number in &asked {
        let Some(plant) = plants.get(number) else {
            let count = run.json()["resolved_scenario"]["measured"]["plants"].as_u64().unwrap_or_default();
            let told = if u64::from(*number) < count {
                format!(
                    "plant {number} of {shown} has no places: the file does not tell where its parts are, and it cannot be drawn"
                )
            } else {
                format!("{shown} has the plants 0 to {}", count.saturating_sub(1))
            };
            return Err(Misuse(told).into());
        };
        let (own, seen) = Default::default();
        stands.push(Stand {
            plants: vec![Placed { plant, age, place: [0.0; 3], own, seen }],
            obstacles: Vec::new(),
            label: format!("plant {number}"),
        });
    }
    let view = picture.view();
    let style = Style { view: view.unwrap_or(View::Front), ..picture.style() };
    let file = Destination::create(&picture.out)?;
    let draw = if view.is_some() { draw_stands } else { sheet_of_stands };
    let canvas = draw(&stands, "measured", &style);
    let bytes = amounts::bytes(picture.save(&canvas, &format!("{shown}: measured plants {asked:?}"), file)? as f64);
    out::tell(&picture.out, &format!("{} as measured, {bytes}", amounts::of(asked.len() as u64, "plant")))?;
    Ok(Verdict::Done)
}
