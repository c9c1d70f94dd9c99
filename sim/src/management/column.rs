//! The columns by which wood, fruits and plants are chosen: each is declared once with its name, its unit and its
//! meaning, and with the things of which it is known.
//!
//! The names are those of the tables where the tables have them. In a condition on wood or on fruits, what is known of
//! the whole plant begins with `plant_`. Absent: how a column is measured (`wood`, `fruits`, `plants`).

/// What a condition is asked of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Thing {
    /// A branch: an axis with all that it bears.
    Wood,
    /// A fruit.
    Fruit,
    /// A whole plant.
    Plant,
}

impl Thing {
    /// The thing in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wood => "a branch",
            Self::Fruit => "a fruit",
            Self::Plant => "a plant",
        }
    }
}

/// What a column's values are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Values {
    /// Numbers, in the unit that the name tells.
    Numbers,
    /// The kinds of components, by their tags.
    Kinds,
    /// The origins of axes, by their tags.
    Origins,
}

macro_rules! columns {
    ($(
        $(#[doc = $meaning:literal])+
        $name:ident = $tag:literal, [$($thing:ident),+], $values:ident, $needs:ident;
    )+) => {
        /// A column that a condition can name.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Column {
            $($(#[doc = $meaning])+ $name,)+
        }

        impl Column {
            /// Every column, in the order of the lists that people see.
            pub const ALL: &[Self] = &[$(Self::$name),+];

            /// The name in conditions.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$name => $tag,)+
                }
            }

            /// What it tells, for people.
            pub const fn meaning(self) -> &'static str {
                match self {
                    $(Self::$name => concat!($($meaning),+).trim_ascii(),)+
                }
            }

            /// The things of which it is known.
            pub const fn things(self) -> &'static [Thing] {
                match self {
                    $(Self::$name => &[$(Thing::$thing),+],)+
                }
            }

            /// What its values are.
            pub const fn values(self) -> Values {
                match self {
                    $(Self::$name => Values::$values,)+
                }
            }

            /// Whether the plant must stand to tell it: be thickened, bent and posed.
            pub const fn is_of_the_pose(self) -> bool {
                match self {
                    $(Self::$name => columns!(@$needs),)+
                }
            }
        }
    };
    (@pose) => { true };
    (@growth) => { false };
}

columns! {
    /// Ticks since it appeared; of a plant, since it was sown.
    Age = "age", [Wood, Fruit, Plant], Numbers, growth;
    /// The order of its axis; the trunk is 1.
    Order = "order", [Wood, Fruit], Numbers, growth;
    /// How the axis came to be, as in the table `components`.
    Origin = "origin", [Wood], Origins, growth;
    /// The kind, as in the tables: of the first internode of a branch, or of the fruit.
    Kind = "kind", [Wood, Fruit], Kinds, growth;
    /// The state of the axis, from 0, in the order of the species' `states`.
    State = "state", [Wood, Fruit], Numbers, growth;
    /// The rank, from 1, of the node that bears it.
    Rank = "rank", [Wood, Fruit], Numbers, growth;
    /// The position among the buds or organs of that node, from 0.
    Position = "position", [Wood, Fruit], Numbers, growth;
    /// The internodes of the axis that stand.
    Nodes = "nodes", [Wood], Numbers, growth;
    /// The axes that the axis bears itself.
    Branches = "branches", [Wood], Numbers, growth;
    /// 1 where every bud of the branch is dead, else 0.
    Dead = "dead", [Wood], Numbers, growth;
    /// The share of its life on the plant that a fruit has behind it; 1 at the tick at which it would fall.
    LifeShare = "life_share", [Fruit], Numbers, growth;
    /// The length of the axis along its internodes, or of the fruit, metres.
    Length = "length_m", [Wood, Fruit], Numbers, pose;
    /// The diameter at the base of the branch, of the fruit, or at the base of the trunk of a plant, metres.
    Diameter = "diameter_m", [Wood, Fruit, Plant], Numbers, pose;
    /// The height of the base of the branch, or of the fruit, above the seed; of a plant that of its highest internode,
    /// metres.
    Height = "height_m", [Wood, Fruit, Plant], Numbers, pose;
    /// The height of the tip of the axis above the seed, metres.
    TipHeight = "tip_height_m", [Wood], Numbers, pose;
    /// The distance of the tip of the axis from the vertical through the seed, metres.
    Reach = "reach_m", [Wood], Numbers, pose;
    /// The angle between the axis and its bearer at its insertion, degrees.
    Insertion = "insertion_deg", [Wood], Numbers, growth;
    /// The angle between the first internode of the axis and the upward vertical, degrees.
    Inclination = "inclination_deg", [Wood], Numbers, pose;
    /// The compass direction of the first internode of the axis, degrees from north to east, from 0 to 360.
    Azimuth = "azimuth_deg", [Wood], Numbers, pose;
    /// Components that the plant ever had.
    Components = "components", [Plant], Numbers, growth;
    /// Internodes that stand.
    Internodes = "internodes", [Plant], Numbers, growth;
    /// Leaves on the plant.
    Leaves = "leaves", [Plant], Numbers, growth;
    /// Fruits on the plant.
    Fruits = "fruits", [Plant], Numbers, growth;
    /// The area of one side of its leaves, square metres.
    LeafArea = "leaf_area_m2", [Plant], Numbers, growth;
    /// The number of the plant among those of its plot, from 0.
    Member = "member", [Plant], Numbers, growth;
    /// The day of the year, from 1, that begins when the operation is done.
    Date = "date", [Plant], Numbers, growth;
    /// The degree-days since the plant was sown.
    DegreeDays = "degree_days", [Plant], Numbers, growth;
    /// The hours from sunrise to sunset on that day.
    DayLength = "day_length_h", [Plant], Numbers, growth;
    /// The age of the whole plant, ticks.
    PlantAge = "plant_age", [Wood, Fruit], Numbers, growth;
    /// The height of the whole plant, metres.
    PlantHeight = "plant_height_m", [Wood, Fruit], Numbers, pose;
}

impl Column {
    /// Whether the calendar of the plot tells it.
    pub const fn is_of_the_date(self) -> bool {
        matches!(self, Self::Date | Self::DegreeDays | Self::DayLength)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_distinct_and_every_thing_has_columns() {
        let names: BTreeSet<_> = Column::ALL.iter().map(|column| column.name()).collect();
        assert_eq!(names.len(), Column::ALL.len());
        for thing in [Thing::Wood, Thing::Fruit, Thing::Plant] {
            assert!(Column::ALL.iter().any(|column| column.things().contains(&thing)), "{thing:?}");
        }
        assert!(Column::ALL.iter().all(|column| !column.meaning().is_empty() && !column.things().is_empty()));
    }
}
