//! What a component is (the tag of de Reffye's record, 1988 §6), and why it ended.
//!
//! The paper's tags are internodes, leaves, flowers and fruits, and, where the simulation is enlarged (§5), rhizome,
//! palm, petal and sepal internodes. All facts about a kind stand in its row of [`crate::kinds!`], which is the one
//! list of kinds. Numbers are part of tables, meshes and lineage keys: they never change, and a new kind has the next
//! one. Absent: the colours of a kind (`phytomer_meshes::palette`).

/// The table of kinds, a row each, passed to the caller's macro. A row has a sentence on what the component is, its
/// name, number, tag, class, the part of the plant that it belongs to, and its Plant Ontology term (Planteome, release
/// 20 and later). A species file can state the kinds of the first block; those of the second follow from growth.
///
/// The ontology has no terms of its own for short internodes, for apical buds, or for the internodes of which a leaf or
/// a part of a flower is grown.
#[macro_export]
macro_rules! kinds {
    ($then:ident) => {
        $then! {
            stated {
                /// An internode of a long growth unit.
                Internode = 0, "internode", Internode, Shoot, "PO:0005005";
                /// A leaf.
                Leaf = 2, "leaf", Leaf, Leaf, "PO:0025034";
                /// A flower or an inflorescence.
                Flower = 3, "flower", Flower, Flower, "PO:0009046";
                /// A fruit.
                Fruit = 4, "fruit", Fruit, Flower, "PO:0009001";
                /// An internode of a shoot that creeps below ground.
                RhizomeInternode = 6, "rhizome_internode", Internode, Shoot, "PO:0025204";
                /// An internode of the jointed stem of a grass or a bamboo.
                CulmInternode = 7, "culm_internode", Internode, Shoot, "PO:0020142";
                /// An internode of a shoot of a grass that rises from the axil of a leaf at the ground.
                TillerInternode = 8, "tiller_internode", Internode, Shoot, "PO:0005005";
                /// An internode of the rachis of a palm or of another leaf that is drawn as an axis with its leaflets.
                PalmInternode = 9, "palm_internode", Internode, Leaf, "PO:0020055";
                /// An internode of a leaflet that is drawn as an axis.
                LeafletInternode = 10, "leaflet_internode", Internode, Leaf, "PO:0020049";
                /// An internode of the axis or a branch of an inflorescence or a bunch of fruits.
                InflorescenceInternode = 11, "inflorescence_internode", Internode, Flower, "PO:0020122";
                /// An internode of the stalk of one flower.
                PedicelInternode = 12, "pedicel_internode", Internode, Flower, "PO:0030112";
                /// An internode of the end of the stalk that bears the parts of a flower.
                ReceptacleInternode = 13, "receptacle_internode", Internode, Flower, "PO:0009064";
                /// An internode of a sepal that is drawn as a growth unit.
                SepalInternode = 14, "sepal_internode", Internode, Flower, "PO:0009031";
                /// An internode of a petal that is drawn as a growth unit.
                PetalInternode = 15, "petal_internode", Internode, Flower, "PO:0009032";
                /// An internode of a stamen that is drawn as a growth unit.
                StamenInternode = 16, "stamen_internode", Internode, Flower, "PO:0009029";
                /// An internode of a style with its stigma that is drawn as a growth unit.
                StigmaInternode = 17, "stigma_internode", Internode, Flower, "PO:0009073";
                /// A leaflet of a leaf that is drawn as an axis.
                Leaflet = 18, "leaflet", Leaf, Leaf, "PO:0020049";
                /// A leaf that bears a flower or an inflorescence in its axil.
                Bract = 19, "bract", Leaf, Leaf, "PO:0009055";
                /// A reduced leaf: of a rhizome, of a bud, the sheath of a young culm.
                ScaleLeaf = 20, "scale_leaf", Leaf, Leaf, "PO:0006003";
                /// A leaf or a leaflet that is a spine.
                Spine = 21, "spine", Leaf, Leaf, "PO:0025173";
                /// A sepal drawn whole.
                Sepal = 22, "sepal", Leaf, Flower, "PO:0009031";
                /// A petal drawn whole.
                Petal = 23, "petal", Leaf, Flower, "PO:0009032";
                /// A petal or sepal of a flower that does not tell them apart.
                Tepal = 24, "tepal", Leaf, Flower, "PO:0009033";
                /// A stamen drawn whole.
                Stamen = 25, "stamen", Leaf, Flower, "PO:0009029";
                /// A style with its stigma drawn whole.
                Stigma = 26, "stigma", Leaf, Flower, "PO:0009073";
                /// An inflorescence drawn as one: a catkin, a spike, a glomerule.
                Inflorescence = 27, "inflorescence", Flower, Flower, "PO:0009049";
                /// A spikelet of a grass.
                Spikelet = 28, "spikelet", Flower, Flower, "PO:0009051";
                /// A bunch of fruits drawn as one.
                Infructescence = 29, "infructescence", Fruit, Flower, "PO:0006342";
                /// A cone of a conifer.
                Strobilus = 30, "strobilus", Fruit, Flower, "PO:0025083";
            }
            grown {
                /// An internode of a short growth unit.
                ShortInternode = 1, "short_internode", Internode, Shoot, "PO:0005005";
                /// The bud at the tip of an axis, growing or waiting.
                ApicalBud = 5, "apical_bud", Bud, Shoot, "PO:0000055";
                /// A bud in the axil of a leaf, waiting, where a model states such buds as components.
                AxillaryBud = 31, "axillary_bud", Bud, Shoot, "PO:0004709";
            }
        }
    };
}

/// The class of a kind: where a component of the kind may stand, and with which others it is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Internodes, whatever they are a part of; their tags end in `internode`.
    Internode,
    /// Components that a node bears as leaves: leaves and leaflets, bracts and scales, the parts of a flower.
    Leaf,
    /// Components that open as flowers: flowers and inflorescences drawn as one.
    Flower,
    /// Components that ripen from a flower.
    Fruit,
    /// Buds.
    Bud,
}

/// The part of a plant to which the components of a kind belong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PartOfPlant {
    /// Stems with their buds.
    Shoot,
    /// Leaves, whole or grown of a rachis with leaflets.
    Leaf,
    /// Inflorescences and flowers with their parts, and fruits.
    Flower,
}

/// Makes [`Kind`] of the table.
macro_rules! kind {
    (stated { $($stated:tt)* } grown { $($grown:tt)* }) => { kind! { $($stated)* $($grown)* } };
    ($(#[doc = $prose:tt] $name:ident = $number:literal, $tag:literal, $class:ident, $part:ident, $term:literal;)*) => {
        /// The tag of a component.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum Kind {
            $(#[doc = $prose] $name = $number,)*
        }

        impl Kind {
            /// Every kind, in the order of their numbers, which leave no gap.
            pub const ALL: [Self; [$($tag),*].len()] = {
                let mut all = [Self::Internode; [$($tag),*].len()];
                $(all[Self::$name as usize] = Self::$name;)*
                all
            };

            /// The tag as it stands in tables.
            pub const fn tag(self) -> &'static str {
                match self {
                    $(Self::$name => $tag,)*
                }
            }

            /// The class of the kind.
            pub const fn class(self) -> Class {
                match self {
                    $(Self::$name => Class::$class,)*
                }
            }

            /// The part of the plant to which components of the kind belong.
            pub const fn part(self) -> PartOfPlant {
                match self {
                    $(Self::$name => PartOfPlant::$part,)*
                }
            }

            /// The Plant Ontology term of the kind.
            pub const fn ontology_term(self) -> &'static str {
                match self {
                    $(Self::$name => $term,)*
                }
            }
        }
    };
}

kinds!(kind);

impl Kind {
    /// Whether the kind is a green blade: its area is leaf area, and a pipe of wood leads to it.
    pub const fn is_foliage(self) -> bool {
        matches!(self, Self::Leaf | Self::Leaflet)
    }
}

/// Why a component ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Cause {
    /// The component lives.
    None = 0,
    /// The mortality test of its bud.
    Mortality = 1,
    /// The bud became a flower.
    Flowered = 2,
    /// The axis made all the growth units that it makes.
    Completed = 3,
    /// Its life length was over.
    LifeLength = 4,
    /// The season of its fall came.
    Season = 5,
    /// Every bud of its branch was dead.
    Branch = 6,
    /// The flower set fruit.
    FruitSet = 7,
    /// A cause outside the plant killed it.
    Killed = 8,
    /// It was cut off, or picked off to thin the fruits.
    Pruned = 9,
    /// It was harvested.
    Harvested = 10,
    /// A pest killed it.
    Attacked = 11,
    /// The rules of its model replaced it by something else, or by nothing.
    Rewritten = 12,
    /// Its bud met an obstacle, and its species gives up there.
    Obstructed = 13,
    /// It died for want of light.
    Shaded = 14,
}

impl Cause {
    /// Every cause of an end, in the order of their numbers.
    pub const ALL: [Self; 14] = [
        Self::Mortality,
        Self::Flowered,
        Self::Completed,
        Self::LifeLength,
        Self::Season,
        Self::Branch,
        Self::FruitSet,
        Self::Killed,
        Self::Pruned,
        Self::Harvested,
        Self::Attacked,
        Self::Rewritten,
        Self::Obstructed,
        Self::Shaded,
    ];

    /// The cause as it stands in tables; `None` for a living component.
    pub const fn tag(self) -> Option<&'static str> {
        Some(match self {
            Self::None => return None,
            Self::Mortality => "mortality",
            Self::Flowered => "flowered",
            Self::Completed => "completed",
            Self::LifeLength => "life_length",
            Self::Season => "season",
            Self::Branch => "branch",
            Self::FruitSet => "fruit_set",
            Self::Killed => "killed",
            Self::Pruned => "pruned",
            Self::Harvested => "harvested",
            Self::Attacked => "attacked",
            Self::Rewritten => "rewritten",
            Self::Obstructed => "obstructed",
            Self::Shaded => "shaded",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_kind_has_a_tag_of_its_own_that_agrees_with_its_class() {
        let tags: BTreeSet<_> = Kind::ALL.map(Kind::tag).into();
        assert_eq!(tags.len(), Kind::ALL.len());
        for kind in Kind::ALL {
            assert_eq!(kind.tag().ends_with("internode"), kind.class() == Class::Internode, "{kind:?}");
            let digits = kind.ontology_term().strip_prefix("PO:").map(str::as_bytes);
            assert!(digits.is_some_and(|of| of.len() == 7 && of.iter().all(u8::is_ascii_digit)), "{kind:?}");
        }
    }

    /// Numbers stand in files of earlier runs.
    #[test]
    fn numbers_never_change() {
        let told = [
            (Kind::ShortInternode, 1),
            (Kind::ApicalBud, 5),
            (Kind::RhizomeInternode, 6),
            (Kind::StigmaInternode, 17),
            (Kind::Leaflet, 18),
            (Kind::Strobilus, 30),
            (Kind::AxillaryBud, 31),
        ];
        assert!(told.into_iter().all(|(kind, number)| kind as u8 == number));
    }
}
