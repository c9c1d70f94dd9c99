//! Elements that the format does not have.

use super::super::report::Report;
use super::super::text::said;
use super::super::xml::{Element, Xml};

/// Goes past an element that the format does not have.
pub(super) fn left_out(element: &Element<'_>, xml: &mut Xml<'_>, report: &mut Report) {
    let place = xml.place(element.at);
    let text = format!("`<{}>` is not known here and is left out", said(&element.name));
    report.warn(place, "", text);
    xml.skip(report);
}
