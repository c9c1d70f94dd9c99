//! The answer of buds to contact, compiled: numbers in metres, the cone by its sine.

use crate::buds::params::{Answer, Buds, Contact};
use crate::fault::{Fault, Path};
use crate::law::{Constant, ValueRange};
use phytomer_sim::math::sin;
use phytomer_sim::site::solids::{CLEARANCE, Cone};

const DISTANCE: ValueRange = ValueRange { min: 0.0, max: 100.0, what: "a distance in metres" };
/// From the clearance that every shoot keeps.
const BESIDE: ValueRange = ValueRange { min: CLEARANCE, max: 100.0, what: "a distance in metres" };
const HALF_ANGLE: ValueRange = ValueRange { min: 0.0, max: 85.0, what: "an angle in degrees" };
const SUPPORT: ValueRange = ValueRange { min: 0.0, max: 10_000.0, what: "a diameter in centimetres" };
/// Where a species states none, metres.
const CLING: f64 = 0.005;
const HOLD: f64 = 0.05;
const SUPPORT_RADIUS: f64 = 0.005;

/// The answer of a species.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaws {
    pub answer: Answer,
    pub cone: Cone,
    /// The distance at which a climber lies, metres.
    pub cling: f64,
    /// The greatest distance at which it holds.
    pub hold: f64,
    /// The least radius of wood to which it holds, metres.
    pub support: f64,
}

/// The answer of a species; that of one that states none is to turn along what it meets.
pub fn compile(buds: &Buds, path: &Path, faults: &mut Vec<Fault>) -> ContactLaws {
    let none = Contact::default();
    let stated = buds.contact.as_ref().unwrap_or(&none);
    let path = path.key("contact");
    let mut read = |key: &str, constant: &Constant, range: ValueRange| {
        constant.within(&path.key(key), range).unwrap_or_else(|fault| {
            faults.push(fault);
            range.min
        })
    };
    let length = read("reach_m", &stated.reach_m, DISTANCE);
    let sine = sin(read("half_angle_deg", &stated.half_angle_deg, HALF_ANGLE).to_radians());
    let cling = stated.cling_m.as_ref().map_or(CLING, |cling| read("cling_m", cling, BESIDE));
    let hold = stated.hold_m.as_ref().map_or(HOLD.max(cling), |hold| read("hold_m", hold, BESIDE));
    let support = stated.support_cm.as_ref().map_or(SUPPORT_RADIUS, |least| 0.005 * read("support_cm", least, SUPPORT));
    if hold < cling {
        let problem = format!("a shoot would lie at {cling} m, where it does not hold any more");
        faults.push(Fault::new(&path.key("hold_m"), problem, format!("at least {cling}, the distance of `cling_m`")));
    }
    let unused = [("cling_m", &stated.cling_m), ("hold_m", &stated.hold_m), ("support_cm", &stated.support_cm)];
    for (key, _) in unused.into_iter().filter(|(_, key)| stated.answer != Answer::Fasten && key.is_some()) {
        let problem = format!("`{key}` has no effect, since the buds do not hold to what they meet");
        faults.push(Fault::new(&path.key(key), problem, "`answer = \"fasten\"` beside it, or no such key"));
    }
    ContactLaws { answer: stated.answer, cone: Cone { length, sine }, cling, hold, support }
}
