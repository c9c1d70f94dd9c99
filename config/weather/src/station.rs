//! Where a station stands: its latitude, longitude and height, checked and in the units that are kept.
//!
//! −99 means not known, for longitudes too, as DSSAT writes it. Absent: whether a longitude has the right sign, which
//! no file shows.

use crate::fault::{Faults, Kind, Place};
use crate::names::Column;
use crate::number::{Cell, cell};
use crate::weather::Station;

/// Takes the place of a station from a cell, where its column is one of a place.
pub(crate) fn locate(station: &mut Station, column: Column, token: &[u8], place: Place, faults: &mut Faults<'_>) {
    let (known, words, least, most, unit) = match column {
        Column::Latitude => (&mut station.latitude, "latitude", -90.0, 90.0, "°"),
        Column::Longitude => (&mut station.longitude, "longitude", -180.0, 360.0, "°"),
        Column::Elevation => (&mut station.elevation_m, "elevation", -500.0, 9000.0, " m"),
        _ => return,
    };
    match cell(token, b'.').0 {
        Cell::Missing => *known = None,
        Cell::Value(value) if value >= least && value <= most => {
            *known = Some(if column == Column::Elevation { value } else { value.to_radians() });
        }
        _ => {
            let problem = format!("`{}` is no {words}", faults.said(place));
            let expected = format!("a number in [{least}, {most}]{unit}, or -99 where it is not known");
            faults.tell(Kind::Impossible, place, problem, expected);
        }
    }
}
