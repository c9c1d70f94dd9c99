//! The files of a plan: `shade.parquet`, `plan.svg`, and of an arrangement `arranged.svg` and `arrangement.parquet`.
//!
//! Absent: how a table or a drawing is made, which is `phytomer_shade`'s.

use super::arranged::Arranged;
use super::{Ground, Planted, ShadeError, month_in_words};
use phytomer_config::plan::Arrange;
use phytomer_outputs::Destination;
use phytomer_shade::drawing::{Drawing, Outlined, plan};
use phytomer_shade::table::{Spot, write_hours, write_spots};
use phytomer_shade::{Caster, Shade};
use phytomer_sim::math::sincos;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// The version that tables name.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The names of the files that were written.
pub type Written = Vec<&'static str>;

/// Writes the files of a plan into a folder; drawings show a month from 0, or the year for 12.
///
/// # Errors
/// Where a file cannot be written.
pub fn write(
    ground: &Ground<'_>,
    planned: &Shade,
    arranged: Option<(&Arrange, &Arranged)>,
    folder: &Path,
    month: usize,
) -> Result<Written, ShadeError> {
    fs::create_dir_all(folder).map_err(failed(folder))?;
    let mut states = vec![("planned", planned)];
    states.extend(arranged.map(|(_, arranged)| ("arranged", &arranged.shade)));
    let zones = ground.plan.zone.iter().zip(&ground.samples.areas_m2);
    let zones: Vec<(&str, f64)> = zones.map(|(zone, area)| (zone.name.as_str(), *area)).collect();
    let mut file = Destination::create(&folder.join("shade.parquet"))?;
    write_hours(&states, &zones, VERSION, &mut file)?;
    file.finish()?;
    // Both drawings have the same colours.
    let of_points = states.iter().flat_map(|(_, shade)| shade.points.iter().map(|months| months[month]));
    let most_h = f64::from(of_points.fold(0.0_f32, f32::max)).ceil().max(1.0);
    let draw = |name: &str, shade: &Shade, planted: &[Planted]| -> Result<(), ShadeError> {
        let text = plan(&drawing(ground, shade, planted, (month, most_h)));
        let text = text.map_err(|error| ShadeError::Drawing(io::Error::other(error)))?;
        let path = folder.join(name);
        let mut file = Destination::create(&path)?;
        file.write_all(text.as_bytes()).map_err(failed(&path))?;
        file.finish()?;
        Ok(())
    };
    draw("plan.svg", planned, &[])?;
    let Some((asked, arranged)) = arranged else { return Ok(vec!["shade.parquet", "plan.svg"]) };
    let planted = arranged.chosen.iter().enumerate();
    let planted = planted.filter_map(|(spot, chosen)| chosen.map(|candidate| Planted { spot, candidate }));
    draw("arranged.svg", &arranged.shade, &planted.collect::<Vec<Planted>>())?;
    let mut file = Destination::create(&folder.join("arrangement.parquet"))?;
    write_spots(&spots(ground, asked, arranged), VERSION, &mut file)?;
    file.finish()?;
    Ok(vec!["shade.parquet", "plan.svg", "arranged.svg", "arrangement.parquet"])
}

fn failed(path: &Path) -> impl FnOnce(io::Error) -> ShadeError {
    let path = path.display().to_string();
    move |error| ShadeError::Write(path, error)
}

fn spots(ground: &Ground<'_>, asked: &Arrange, arranged: &Arranged) -> Vec<Spot> {
    let spot = |(spot, chosen): (&phytomer_config::plan::Spot, &Option<usize>)| Spot {
        name: spot.name.clone(),
        place: spot.place_m,
        row: spot.row,
        planted: chosen.map(|chosen| {
            let candidate = &asked.candidate[chosen];
            (candidate.name.clone(), candidate.cost, ground.height_m(chosen))
        }),
    };
    asked.spot.iter().zip(&arranged.chosen).map(spot).collect()
}

/// What a drawing shows.
fn drawing<'a>(
    ground: &'a Ground<'_>,
    shade: &Shade,
    planted: &[Planted],
    (month, most_h): (usize, f64),
) -> Drawing<'a> {
    let plan = ground.plan;
    let zones = plan.zone.iter().zip(&shade.zones).map(|(zone, months)| Outlined {
        name: format!("{}\n{:.1} h", zone.name, months[month].shade_h()),
        corners: zone.corners_m.clone(),
        at: middle(&zone.corners_m),
    });
    let casters = ground.standing();
    let (buildings, trees) = casters.split_at(plan.building.len());
    let buildings = plan.building.iter().zip(buildings).map(|(building, caster)| {
        let [x, y] = [building.size_m[0] / 2.0, building.size_m[1] / 2.0];
        let corners = [[-x, -y], [x, -y], [x, y], [-x, y]];
        outlined(&building.name, caster, &corners)
    });
    let trees = plan.tree.iter().zip(trees).map(|(tree, caster)| {
        let name = if tree.name.is_empty() { &tree.species } else { &tree.name };
        outlined(name, caster, &caster.body.outline())
    });
    let arrange = plan.arrange.as_ref();
    let chosen = planted.iter().filter_map(|planted| {
        let (caster, arrange) = (ground.candidate(*planted)?, arrange?);
        let (spot, candidate) = (&arrange.spot[planted.spot].name, &arrange.candidate[planted.candidate].name);
        Some(outlined(&format!("{spot}: {candidate}"), &caster, &caster.body.outline()))
    });
    let empty = arrange.into_iter().flat_map(|arrange| arrange.spot.iter().enumerate());
    let empty = empty.filter(|(number, _)| planted.iter().all(|planted| planted.spot != *number));
    let spots = empty.map(|(_, spot)| Outlined { name: spot.name.clone(), corners: Vec::new(), at: spot.place_m });
    Drawing {
        title: plan.name.clone(),
        subtitle: format!(
            "Hours of shade a day in {}, at {}° {}",
            month_in_words(month),
            plan.latitude_deg.abs(),
            if plan.latitude_deg < 0.0 { "south" } else { "north" }
        ),
        zones: zones.collect(),
        samples: &ground.samples,
        hours: shade.points.iter().map(|months| months[month]).collect(),
        most_h,
        buildings: buildings.collect(),
        crowns: trees.chain(chosen).collect(),
        spots: spots.collect(),
    }
}

/// The outline of a caster in its place.
fn outlined(name: &str, caster: &Caster<'_>, corners: &[[f64; 2]]) -> Outlined {
    let (sin, cos) = sincos(caster.turn);
    let put = |[x, y]: &[f64; 2]| [caster.place[0] + cos * x - sin * y, caster.place[1] + sin * x + cos * y];
    Outlined { name: name.to_owned(), corners: corners.iter().map(put).collect(), at: caster.place }
}

/// The middle of the rectangle around some corners.
fn middle(corners: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| {
        let of_axis = || corners.iter().map(|corner| corner[k]);
        (of_axis().fold(f64::INFINITY, f64::min) + of_axis().fold(f64::NEG_INFINITY, f64::max)) / 2.0
    })
}
