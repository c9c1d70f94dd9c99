//! The library of forms (de Reffye 1988 §6): the one list of them.
//!
//! All facts about a form stand in its row of [`crate::forms!`]: its name in files, what it looks like, how large its
//! area is, and the function of `phytomer_meshes::forms` that makes its triangles. Its number, which the plant carries,
//! is its place in the list: a new form is added at the end. Absent: the triangles.

use phytomer_sim::plant::Form;

/// The table of forms, a row each, passed to the caller's macro. A row has a sentence on what the form looks like, its
/// name in the program and in species files, its share of area ([`FormName::area_share`]), and the function that makes
/// its mesh.
#[macro_export]
macro_rules! forms {
    ($then:ident) => {
        $then! {
            /// A broad blade, widest in its middle.
            Elliptic, "elliptic", 0.6006, blade::elliptic;
            /// A narrow blade, widest below its middle.
            Lanceolate, "lanceolate", 0.5758, blade::lanceolate;
            /// A blade as broad as long, heart-shaped or triangular, as a poplar's.
            Deltoid, "deltoid", 0.4394, blade::deltoid;
            /// A needle.
            Needle, "needle", 0.6403, blade::needle;
            /// A pinnate palm leaf.
            Palm, "palm", 0.2891, palm::palm;
            /// An open flower of five petals.
            Corolla, "corolla", 0.6385, flower::corolla;
            /// A round fruit.
            Berry, "berry", 1.1445, fruit::berry;
            /// A cone, standing or hanging.
            Cone, "cone", 1.0515, round::cone;
            /// A blade widest above its middle, as an oak's or a frangipani's.
            Obovate, "obovate", 0.5839, blade::obovate;
            /// A heart-shaped blade on a long stalk, as a lime's.
            Cordate, "cordate", 0.5124, blade::cordate;
            /// A blade of three pointed lobes on a long stalk, as a maple's, a cotton's or a fig's.
            Palmate, "palmate", 0.4273, blade::palmate;
            /// A long narrow blade of even width, as a bamboo's.
            Linear, "linear", 0.6789, blade::linear;
            /// A long narrow blade that arches over, as a grass's.
            Arching, "arching", 0.7133, arch::arching;
            /// A great oblong blade that arches over, as a banana's.
            Paddle, "paddle", 0.7252, arch::paddle;
            /// A pleated fan on a long stalk, as a fan palm's or a ginkgo's.
            Fan, "fan", 0.4874, blade::fan;
            /// A leaf of nine leaflets, as an ash's or a walnut's.
            Pinnate, "pinnate", 0.3168, palm::pinnate;
            /// A leaflet of a palm: a narrow blade folded along its middle, on no stalk.
            Leaflet, "leaflet", 0.7536, blade::leaflet;
            /// A pair of needles, as a Scots pine's.
            Fascicle, "fascicle", 0.3614, blade::fascicle;
            /// A small pointed scale, hollow towards its stem.
            Scale, "scale", 0.6485, blade::scale;
            /// A petal: narrow below, broad and hollow above.
            Petal, "petal", 0.8081, arch::petal;
            /// A sepal: broad below, pointed above, hollow.
            Sepal, "sepal", 0.8031, arch::sepal;
            /// A filament with its anther.
            Stamen, "stamen", 0.5258, flower::stamen;
            /// A style with its stigma.
            Pistil, "pistil", 0.8287, flower::pistil;
            /// An open flower of five broad petals around its stamens, as a cherry's.
            Rosette, "rosette", 0.3697, flower::rosette;
            /// A catkin or a spike: a spindle of scales.
            Catkin, "catkin", 1.3364, round::catkin;
            /// A spikelet of a grass.
            Spikelet, "spikelet", 0.9288, round::spikelet;
            /// A round fruit on a long stalk.
            Cherry, "cherry", 0.6592, fruit::cherry;
            /// A round fruit, hollow at both ends, on a short stalk.
            Apple, "apple", 1.1880, fruit::apple;
            /// An egg-shaped capsule, as a cotton's boll.
            Capsule, "capsule", 0.9367, fruit::capsule;
            /// A nut in its cup, as an acorn.
            Nut, "nut", 1.4961, fruit::nut;
            /// A fruit longer than broad, as a date or a mango.
            Drupe, "drupe", 1.2641, fruit::drupe;
            /// A curved fruit of five sides, as a banana.
            Finger, "finger", 1.1557, fruit::finger;
            /// A flat pod.
            Pod, "pod", 0.7702, fruit::pod;
            /// A rosette of needles on a short shoot, as a cedar's or a larch's.
            Tuft, "tuft", 0.5326, cluster::tuft;
            /// A piece of shoot with a row of needles on either side, as a fir's or a yew's.
            Spray, "spray", 0.2774, cluster::spray;
            /// A pyramid of small flowers on side branches, as a mango's.
            Panicle, "panicle", 1.2938, cluster::panicle;
            /// Some five-petalled flowers on a dome of stalks, as a frangipani's.
            Cyme, "cyme", 0.8898, cluster::cyme;
            /// A plane hexagon of four triangles, as the leaves of parametric trees.
            Oval, "oval", 0.7500, flat::oval;
            /// A plane triangle, widest at its base.
            Triangle, "triangle", 0.5000, flat::triangle;
            /// A plane leaf of three blunt lobes, as some oaks'.
            ThreeLobeOak, "three_lobe_oak", 0.5364, flat::three_lobe_oak;
            /// A plane leaf of three pointed lobes, as some maples'.
            ThreeLobeMaple, "three_lobe_maple", 0.4452, flat::three_lobe_maple;
            /// A plane leaf of five pointed lobes, as most maples'.
            FiveLobeMaple, "five_lobe_maple", 0.4120, flat::five_lobe_maple;
            /// A plane leaf of three leaflets.
            ThreeLeaflets, "three_leaflets", 0.3200, flat::three_leaflets;
        }
    };
}

/// Makes [`FormName`] of the table.
macro_rules! form_name {
    ($(#[doc = $prose:tt] $form:ident, $name:tt, $share:literal, $module:ident :: $mesh:ident;)*) => {
        /// A form of the library by name.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        #[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
        pub enum FormName {
            $(
                #[doc = $prose]
                #[cfg_attr(feature = "files", serde(rename = $name))]
                $form,
            )*
        }

        impl FormName {
            /// Every form of the library, in the order of their numbers.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$form),*];

            /// Its name in species files.
            pub const fn word(self) -> &'static str {
                match self {
                    $(Self::$form => $name,)*
                }
            }

            /// What it looks like, a sentence.
            pub const fn about(self) -> &'static str {
                match self {
                    $(Self::$form => $prose.trim_ascii(),)*
                }
            }

            /// The area of one side as a share of length × width, of an organ half as wide as long: that of its
            /// triangles; of a closed form half of that. The triangles are in `phytomer_meshes`, where a test checks
            /// that they have these areas.
            pub const fn area_share(self) -> f32 {
                match self {
                    $(Self::$form => $share,)*
                }
            }
        }
    };
}

forms!(form_name);

impl FormName {
    /// The number that the plant carries.
    #[inline]
    pub const fn form(self) -> Form {
        Form(self as u8)
    }

    /// The form of the library that has a number; `None` for a user's mesh.
    #[inline]
    pub fn of(form: Form) -> Option<Self> {
        Self::ALL.get(usize::from(form.0)).copied()
    }
}

/// The number of a user's mesh at a place among the meshes that its species names. A place too far has the number of
/// the last: a species names at most 64.
pub const fn own_form(place: u8) -> Form {
    Form((FormName::ALL.len() as u8).saturating_add(place))
}

/// The place of a user's mesh among the meshes that its species names; `None` for a form of the library.
#[inline]
pub fn place_of_own(form: Form) -> Option<u8> {
    form.0.checked_sub(FormName::ALL.len() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_form_has_a_name_of_its_own_and_a_number() {
        let names: BTreeSet<_> = FormName::ALL.into_iter().map(FormName::word).collect();
        assert_eq!(names.len(), FormName::ALL.len());
        for (number, form) in (0..).zip(FormName::ALL) {
            assert_eq!((form.form(), FormName::of(Form(number))), (Form(number), Some(form)));
            assert!(form.about().ends_with('.') && form.about().starts_with(char::is_uppercase), "{form:?}");
        }
        let last = FormName::ALL.len() as u8;
        assert_eq!(
            (own_form(2), place_of_own(own_form(2)), FormName::of(own_form(2))),
            (Form(last + 2), Some(2), None)
        );
        assert_eq!((own_form(255), place_of_own(Form(0))), (Form(255), None));
    }
}
