//! The form in which an organ is drawn: a name from the library of forms (de Reffye 1988 §6), or a mesh of the user's.
//!
//! The numbers of this list may grow at its end, never change. Absent: how a form looks, which
//! `phytomer_outputs::meshes` knows.

/// The form in which an organ is drawn, or an internode that is no tube.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Form {
    /// A broad blade, widest in its middle.
    Elliptic,
    /// A narrow blade, widest below its middle.
    Lanceolate,
    /// A blade as broad as long, heart-shaped or triangular, as a poplar's.
    Deltoid,
    /// A needle.
    Needle,
    /// A pinnate palm leaf.
    Palm,
    /// An open flower of five petals.
    Corolla,
    /// A round fruit.
    Berry,
    /// A cone, standing or hanging.
    Cone,
    /// A blade widest above its middle, as an oak's or a frangipani's.
    Obovate,
    /// A heart-shaped blade on a long stalk, as a lime's.
    Cordate,
    /// A blade of three pointed lobes on a long stalk, as a maple's, a cotton's or a fig's.
    Palmate,
    /// A long narrow blade of even width, as a bamboo's.
    Linear,
    /// A long narrow blade that arches over, as a grass's.
    Arching,
    /// A great oblong blade that arches over, as a banana's.
    Paddle,
    /// A pleated fan on a long stalk, as a fan palm's or a ginkgo's.
    Fan,
    /// A leaf of nine leaflets, as an ash's or a walnut's.
    Pinnate,
    /// A leaflet of a palm: a narrow blade folded along its middle, on no stalk.
    Leaflet,
    /// A pair of needles, as a Scots pine's.
    Fascicle,
    /// A small pointed scale, hollow towards its stem.
    Scale,
    /// A petal: narrow below, broad and hollow above.
    Petal,
    /// A sepal: broad below, pointed above, hollow.
    Sepal,
    /// A filament with its anther.
    Stamen,
    /// A style with its stigma.
    Pistil,
    /// An open flower of five broad petals around its stamens, as a cherry's.
    Rosette,
    /// A catkin or a spike: a spindle of scales.
    Catkin,
    /// A spikelet of a grass.
    Spikelet,
    /// A round fruit on a long stalk.
    Cherry,
    /// A round fruit, hollow at both ends, on a short stalk.
    Apple,
    /// An egg-shaped capsule, as a cotton's boll.
    Capsule,
    /// A nut in its cup, as an acorn.
    Nut,
    /// A fruit longer than broad, as a date or a mango.
    Drupe,
    /// A curved fruit of five sides, as a banana.
    Finger,
    /// A flat pod.
    Pod,
    /// A rosette of needles on a short shoot, as a cedar's or a larch's.
    Tuft,
    /// A piece of shoot with a row of needles on either side, as a fir's or a yew's.
    Spray,
    /// A pyramid of small flowers on side branches, as a mango's.
    Panicle,
    /// Some five-petalled flowers on a dome of stalks, as a frangipani's.
    Cyme,
    /// A mesh of the user's, by its place among those that the species names.
    Own(u8),
}

impl Form {
    /// Every form of the library, in the order of their numbers.
    pub const LIBRARY: [Self; 37] = [
        Self::Elliptic,
        Self::Lanceolate,
        Self::Deltoid,
        Self::Needle,
        Self::Palm,
        Self::Corolla,
        Self::Berry,
        Self::Cone,
        Self::Obovate,
        Self::Cordate,
        Self::Palmate,
        Self::Linear,
        Self::Arching,
        Self::Paddle,
        Self::Fan,
        Self::Pinnate,
        Self::Leaflet,
        Self::Fascicle,
        Self::Scale,
        Self::Petal,
        Self::Sepal,
        Self::Stamen,
        Self::Pistil,
        Self::Rosette,
        Self::Catkin,
        Self::Spikelet,
        Self::Cherry,
        Self::Apple,
        Self::Capsule,
        Self::Nut,
        Self::Drupe,
        Self::Finger,
        Self::Pod,
        Self::Tuft,
        Self::Spray,
        Self::Panicle,
        Self::Cyme,
    ];

    /// Its number: the library's come first, then the user's.
    #[inline]
    pub const fn number(self) -> usize {
        match self {
            Self::Elliptic => 0,
            Self::Lanceolate => 1,
            Self::Deltoid => 2,
            Self::Needle => 3,
            Self::Palm => 4,
            Self::Corolla => 5,
            Self::Berry => 6,
            Self::Cone => 7,
            Self::Obovate => 8,
            Self::Cordate => 9,
            Self::Palmate => 10,
            Self::Linear => 11,
            Self::Arching => 12,
            Self::Paddle => 13,
            Self::Fan => 14,
            Self::Pinnate => 15,
            Self::Leaflet => 16,
            Self::Fascicle => 17,
            Self::Scale => 18,
            Self::Petal => 19,
            Self::Sepal => 20,
            Self::Stamen => 21,
            Self::Pistil => 22,
            Self::Rosette => 23,
            Self::Catkin => 24,
            Self::Spikelet => 25,
            Self::Cherry => 26,
            Self::Apple => 27,
            Self::Capsule => 28,
            Self::Nut => 29,
            Self::Drupe => 30,
            Self::Finger => 31,
            Self::Pod => 32,
            Self::Tuft => 33,
            Self::Spray => 34,
            Self::Panicle => 35,
            Self::Cyme => 36,
            Self::Own(place) => Self::LIBRARY.len() + place as usize,
        }
    }

    /// Its name in species files; none for a mesh of the user's.
    pub const fn name(self) -> Option<&'static str> {
        Some(match self {
            Self::Elliptic => "elliptic",
            Self::Lanceolate => "lanceolate",
            Self::Deltoid => "deltoid",
            Self::Needle => "needle",
            Self::Palm => "palm",
            Self::Corolla => "corolla",
            Self::Berry => "berry",
            Self::Cone => "cone",
            Self::Obovate => "obovate",
            Self::Cordate => "cordate",
            Self::Palmate => "palmate",
            Self::Linear => "linear",
            Self::Arching => "arching",
            Self::Paddle => "paddle",
            Self::Fan => "fan",
            Self::Pinnate => "pinnate",
            Self::Leaflet => "leaflet",
            Self::Fascicle => "fascicle",
            Self::Scale => "scale",
            Self::Petal => "petal",
            Self::Sepal => "sepal",
            Self::Stamen => "stamen",
            Self::Pistil => "pistil",
            Self::Rosette => "rosette",
            Self::Catkin => "catkin",
            Self::Spikelet => "spikelet",
            Self::Cherry => "cherry",
            Self::Apple => "apple",
            Self::Capsule => "capsule",
            Self::Nut => "nut",
            Self::Drupe => "drupe",
            Self::Finger => "finger",
            Self::Pod => "pod",
            Self::Tuft => "tuft",
            Self::Spray => "spray",
            Self::Panicle => "panicle",
            Self::Cyme => "cyme",
            Self::Own(_) => return None,
        })
    }

    /// In the order of the library.
    #[rustfmt::skip]
    const AREA_SHARES: [f32; Self::LIBRARY.len()] = [
        0.6006, 0.5758, 0.4394, 0.6403, 0.2891, 0.6385, 1.1445, 1.0515, 0.5839, 0.5124,
        0.4273, 0.6789, 0.7133, 0.7252, 0.4874, 0.3168, 0.7536, 0.3614, 0.6485, 0.8081,
        0.8031, 0.5258, 0.8287, 0.3697, 1.3364, 0.9288, 0.6592, 1.1880, 0.9367, 1.4961,
        1.2641, 1.1557, 0.7702, 0.5326, 0.2774, 1.2938, 0.8898,
    ];

    /// The area of one side as a share of length × width, of an organ half as wide as long: that of its triangles, of a
    /// closed form half of it. `phytomer_outputs::meshes` holds the triangles, and a test that they have these areas.
    /// Of a mesh of the user's, whose own share is known where the mesh is read, that of a broad blade.
    pub const fn area_share(self) -> f32 {
        match self {
            Self::Own(_) => Self::AREA_SHARES[0],
            form => Self::AREA_SHARES[form.number()],
        }
    }

    /// What it looks like, in a few words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Elliptic => "a broad blade, widest in its middle",
            Self::Lanceolate => "a narrow blade, widest below its middle",
            Self::Deltoid => "a blade as broad as long, heart-shaped or triangular, as a poplar's",
            Self::Needle => "a needle",
            Self::Palm => "a pinnate palm leaf",
            Self::Corolla => "an open flower of five petals",
            Self::Berry => "a round fruit",
            Self::Cone => "a cone, standing or hanging",
            Self::Obovate => "a blade widest above its middle, as an oak's or a frangipani's",
            Self::Cordate => "a heart-shaped blade on a long stalk, as a lime's",
            Self::Palmate => "a blade of three pointed lobes on a long stalk, as a maple's, a cotton's or a fig's",
            Self::Linear => "a long narrow blade of even width, as a bamboo's",
            Self::Arching => "a long narrow blade that arches over, as a grass's",
            Self::Paddle => "a great oblong blade that arches over, as a banana's",
            Self::Fan => "a pleated fan on a long stalk, as a fan palm's or a ginkgo's",
            Self::Pinnate => "a leaf of nine leaflets, as an ash's or a walnut's",
            Self::Leaflet => "a leaflet of a palm: a narrow blade folded along its middle, on no stalk",
            Self::Fascicle => "a pair of needles, as a Scots pine's",
            Self::Scale => "a small pointed scale, hollow towards its stem",
            Self::Petal => "a petal: narrow below, broad and hollow above",
            Self::Sepal => "a sepal: broad below, pointed above, hollow",
            Self::Stamen => "a filament with its anther",
            Self::Pistil => "a style with its stigma",
            Self::Rosette => "an open flower of five broad petals around its stamens, as a cherry's",
            Self::Catkin => "a catkin or a spike: a spindle of scales",
            Self::Spikelet => "a spikelet of a grass",
            Self::Cherry => "a round fruit on a long stalk",
            Self::Apple => "a round fruit, hollow at both ends, on a short stalk",
            Self::Capsule => "an egg-shaped capsule, as a cotton's boll",
            Self::Nut => "a nut in its cup, as an acorn",
            Self::Drupe => "a fruit longer than broad, as a date or a mango",
            Self::Finger => "a curved fruit of five sides, as a banana",
            Self::Pod => "a flat pod",
            Self::Tuft => "a rosette of needles on a short shoot, as a cedar's or a larch's",
            Self::Spray => "a piece of shoot with a row of needles on either side, as a fir's or a yew's",
            Self::Panicle => "a pyramid of small flowers on side branches, as a mango's",
            Self::Cyme => "some five-petalled flowers on a dome of stalks, as a frangipani's",
            Self::Own(_) => "a mesh of the user's",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_form_has_a_name_of_its_own() {
        let names: BTreeSet<_> = Form::LIBRARY.into_iter().filter_map(Form::name).collect();
        assert_eq!(names.len(), Form::LIBRARY.len());
        assert!((0..).zip(Form::LIBRARY).all(|(number, form)| form.number() == number));
        assert_eq!(Form::Own(2).number(), Form::LIBRARY.len() + 2);
    }
}
