//! The forms of the library as settings of the blade and of flowers.
//!
//! Outlines are those of the species that the forms are named for in the table of forms. Absent: solids, of which only
//! the number of sides changes (`phytomer_meshes`), and inflorescences, which stay as they are.

use super::Near;
use super::blade::{Apex, Base, Blade, Margin};
use super::cluster::Brush;
use super::head::Flower;
use crate::FormName;

impl FormName {
    /// How the form is drawn from near; `None`: as a solid that is rounder, or as it is.
    pub fn near(self) -> Option<Near> {
        blade(self)
            .map(Near::Blade)
            .or_else(|| flower(self).map(Near::Flower))
            .or_else(|| needles(self).map(Near::Brush))
    }
}

/// The blade of a form that is one.
fn blade(form: FormName) -> Option<Blade> {
    use FormName::*;
    let plain = Blade::default();
    let flat = Blade { fold_deg: 0.0, arch_deg: 0.0, ..plain };
    Some(match form {
        Elliptic => Blade { apex: Apex::Acuminate, widest_at: 0.46, wave: 0.02, ..plain },
        Lanceolate => {
            Blade { widest_at: 0.32, stalk: 0.05, margin: Margin::Toothed, divisions: 40, depth: 0.04, ..plain }
        }
        Deltoid => Blade {
            stalk: 0.3,
            widest_at: 0.2,
            base: Base::Truncate,
            margin: Margin::Toothed,
            divisions: 14,
            depth: 0.06,
            veins: 6,
            ..plain
        },
        Obovate => Blade { stalk: 0.06, widest_at: 0.66, base: Base::Cuneate, apex: Apex::Convex, ..plain },
        Cordate => Blade {
            stalk: 0.3,
            widest_at: 0.3,
            base: Base::Cordate,
            heart: 0.16,
            apex: Apex::Acuminate,
            margin: Margin::Toothed,
            divisions: 22,
            depth: 0.05,
            ..plain
        },
        Linear => {
            Blade { stalk: 0.03, widest_at: 0.35, base: Base::Rounded, oblong: 4.0, veins: 0, arch_deg: 40.0, ..plain }
        }
        Palmate | FiveLobeMaple => Blade {
            stalk: 0.3,
            margin: Margin::Palmate,
            divisions: 5,
            depth: 0.5,
            spread_deg: 230.0,
            fold_deg: 8.0,
            veins: 0,
            ..plain
        },
        ThreeLobeMaple => {
            Blade { stalk: 0.2, margin: Margin::Palmate, divisions: 3, depth: 0.5, spread_deg: 190.0, veins: 0, ..flat }
        }
        Fan => Blade {
            stalk: 0.42,
            margin: Margin::Palmate,
            divisions: 30,
            depth: 0.42,
            spread_deg: 220.0,
            fold_deg: 8.0,
            arch_deg: 20.0,
            veins: 0,
            ..plain
        },
        ThreeLobeOak => {
            Blade { widest_at: 0.6, margin: Margin::Lobed, divisions: 4, depth: 0.45, apex: Apex::Rounded, ..plain }
        }
        Needle => Blade { stalk: 0.0, widest_at: 0.2, oblong: 6.0, fold_deg: 38.0, arch_deg: 12.0, veins: 0, ..plain },
        Scale => Blade {
            stalk: 0.0,
            widest_at: 0.35,
            base: Base::Truncate,
            fold_deg: 0.0,
            cup: 0.3,
            arch_deg: -20.0,
            veins: 0,
            ..plain
        },
        Leaflet => Blade { stalk: 0.0, widest_at: 0.4, oblong: 3.0, fold_deg: 26.0, arch_deg: 35.0, veins: 0, ..plain },
        Arching => Blade {
            stalk: 0.0,
            widest_at: 0.3,
            base: Base::Truncate,
            fold_deg: 12.0,
            arch_deg: 109.0,
            veins: 0,
            twist_deg: 12.0,
            ..plain
        },
        Paddle => Blade {
            stalk: 0.18,
            widest_at: 0.5,
            base: Base::Rounded,
            apex: Apex::Convex,
            oblong: 3.0,
            fold_deg: 18.0,
            arch_deg: 75.0,
            wave: 0.02,
            veins: 40,
            droop_deg: 45.0,
            ..plain
        },
        Oval => Blade { stalk: 0.04, ..flat },
        Triangle => Blade { stalk: 0.04, widest_at: 0.06, base: Base::Truncate, ..flat },
        Petal => Blade {
            stalk: 0.0,
            widest_at: 0.68,
            base: Base::Cuneate,
            apex: Apex::Rounded,
            notch: 0.08,
            fold_deg: 0.0,
            arch_deg: -18.0,
            cup: 0.22,
            wave: 0.02,
            veins: 0,
            pale: 0.1,
            ..plain
        },
        Sepal => Blade {
            stalk: 0.0,
            widest_at: 0.3,
            base: Base::Truncate,
            fold_deg: 0.0,
            cup: 0.25,
            arch_deg: -14.0,
            veins: 0,
            ..plain
        },
        Palm => Blade {
            stalk: 0.18,
            leaflets: 36,
            leaflet_width: 0.075,
            leaflet_deg: 62.0,
            widest_at: 0.3,
            oblong: 3.0,
            fold_deg: 22.0,
            arch_deg: 72.0,
            veins: 0,
            ..plain
        },
        Pinnate => Blade {
            stalk: 0.18,
            leaflets: 4,
            leaflet_width: 0.36,
            leaflet_deg: 64.0,
            margin: Margin::Toothed,
            divisions: 16,
            depth: 0.06,
            arch_deg: 20.0,
            ..plain
        },
        ThreeLeaflets => Blade { stalk: 0.3, leaflets: 1, leaflet_width: 0.45, leaflet_deg: 70.0, ..plain },
        _ => return None,
    })
}

/// The flower of a form that is one.
fn flower(form: FormName) -> Option<Flower> {
    let petal = Blade { stalk: 0.0, fold_deg: 0.0, veins: 0, pale: 0.1, ..Blade::default() };
    Some(match form {
        FormName::Corolla => Flower {
            petal: Blade { widest_at: 0.45, apex: Apex::Convex, cup: 0.1, arch_deg: 30.0, ..petal },
            petal_width: 0.42,
            tube: 0.5,
            tube_width: 0.1,
            spread_deg: 62.0,
            ..Flower::default()
        },
        FormName::Rosette => Flower {
            petal: Blade {
                widest_at: 0.6,
                base: Base::Rounded,
                apex: Apex::Rounded,
                notch: 0.07,
                cup: 0.25,
                arch_deg: -30.0,
                wave: 0.02,
                ..petal
            },
            petal_width: 0.84,
            tube: 0.62,
            tube_width: 0.05,
            spread_deg: 88.0,
            stamens: 20,
            stamen: 0.5,
            sepals: 5,
            sepal: 0.4,
            sepal_deg: 140.0,
            ..Flower::default()
        },
        _ => return None,
    })
}

/// The needles of a form that is a piece of shoot: those of a cedar's rosette (20 to 45 in floras), of a fir's shoot of
/// some centimetres, and three bundles of a pine.
fn needles(form: FormName) -> Option<Brush> {
    Some(match form {
        FormName::Tuft => Brush { needles: 36, ..Brush::default() },
        FormName::Spray => Brush {
            needles: 28,
            shoot: 0.75,
            first_deg: 72.0,
            last_deg: 42.0,
            combed: 0.8,
            bend_deg: -12.0,
            ..Brush::default()
        },
        FormName::Fascicle => Brush {
            needles: 6,
            bundle: 2,
            shoot: 0.06,
            first_deg: 26.0,
            last_deg: 14.0,
            bend_deg: 14.0,
            ..Brush::default()
        },
        _ => return None,
    })
}
