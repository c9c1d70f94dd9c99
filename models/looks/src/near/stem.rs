//! How internodes are drawn from near: swollen nodes, scars and bases of leaves, an urn, the head of a pollard, and the
//! lobes of sepals.
//!
//! An internode is a frustum in tables and at detail 0. Here its radius along it is that of the frustum times a factor
//! that goes smoothly through stated places. Absent: triangles (`phytomer_meshes`), and welded wood, which keeps the
//! frusta.

use super::Unsound;
use phytomer_sim::clock::Tick;

/// How the internodes of an order are drawn from near.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(deny_unknown_fields, default))]
pub struct NearStem {
    /// Places along the internode, each a share of its length and the factor of its radius there; the shares ascend
    /// from 0 to 1, factors are in [0.02, 4], at most 16 places.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "Vec::is_empty"))]
    pub profile: Vec<[f32; 2]>,
    /// The first and the last rank of the internodes that have the profile; left out: all of the order.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "Option::is_none"))]
    pub ranks: Option<[u32; 2]>,
    /// The bases of fallen leaves that stay on the stem.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "Option::is_none"))]
    pub leaf_bases: Option<LeafBases>,
    /// How broad the rounded head is that ends a stem which was cut, over the diameter of the stem, in [1, 3]: a
    /// pollard's.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "Option::is_none"))]
    pub head: Option<f32>,
    /// Of axes whose internodes are blades: on how many sides an axis has lobes, 0, 1 or 2, by the rank of the node
    /// that bears it, from 1 and over again; a lobe stands on each internode but the first and the last.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "Vec::is_empty"))]
    pub lobed_sides: Vec<u8>,
}

/// The bases of leaves that stay on the stem of a palm.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(deny_unknown_fields, default))]
pub struct LeafBases {
    /// How long a base is over the diameter of the stem, in [0.02, 2].
    pub length: f32,
    /// How broad it is over the diameter of the stem, in [0.02, 1.5].
    pub width: f32,
    /// The angle between the stem and a base, degrees, in [5, 90].
    pub angle_deg: f32,
    /// The age of the internode at which its base falls, ticks; left out: never.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "Option::is_none"))]
    pub falls_after: Option<Tick>,
}

impl Default for LeafBases {
    fn default() -> Self {
        Self { length: 0.35, width: 0.4, angle_deg: 35.0, falls_after: None }
    }
}

/// The most places of a profile.
const MOST_PLACES: usize = 16;

impl NearStem {
    /// Everything that is wrong.
    pub fn unsound(&self) -> Vec<Unsound> {
        let mut found = Vec::new();
        let mut wrong = |key: &'static str, what: String, expected: &str| {
            found.push(Unsound { keys: vec![key], found: what, expected: expected.to_owned() });
        };
        let shares: Vec<f32> = self.profile.iter().map(|place| place[0]).collect();
        let goes = shares.windows(2).all(|pair| pair[1] > pair[0]);
        let spans = shares.first() == Some(&0.0) && shares.last() == Some(&1.0);
        let is_sound = goes && spans && shares.len() <= MOST_PLACES;
        if !self.profile.is_empty() && !is_sound {
            let expected = "2 to 16 places whose shares ascend from 0 to 1";
            wrong("profile", format!("shares {shares:?}"), expected);
        }
        if let Some([_, factor]) = self.profile.iter().find(|[_, factor]| !(0.02..=4.0).contains(factor)) {
            wrong("profile", format!("the factor {factor}"), "factors from 0.02 to 4");
        }
        if let Some([first, last]) = self.ranks.filter(|[first, last]| first > last || *first < 1) {
            wrong("ranks", format!("the ranks {first} to {last}"), "a first rank from 1 and a last one not before it");
        }
        if let Some(sides) = self.lobed_sides.iter().find(|sides| **sides > 2) {
            wrong("lobed_sides", format!("{sides} sides"), "0, 1 or 2");
        }
        found.extend(self.head.iter().flat_map(|head| super::sound::outside(&[("head", *head, [1.0, 3.0])], &[])));
        found.extend(self.leaf_bases.iter().flat_map(LeafBases::unsound));
        found
    }
}

impl LeafBases {
    fn unsound(&self) -> Vec<Unsound> {
        let bounds = [
            ("length", self.length, [0.02, 2.0]),
            ("width", self.width, [0.02, 1.5]),
            ("angle_deg", self.angle_deg, [5.0, 90.0]),
        ];
        super::sound::outside(&bounds, &["leaf_bases"])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_of_internodes_that_are_not_sound_are_told_with_their_keys() {
        let sound = NearStem {
            profile: vec![[0.0, 1.0], [0.9, 1.0], [1.0, 1.2]],
            ranks: Some([1, 4]),
            leaf_bases: Some(LeafBases::default()),
            lobed_sides: vec![2, 2, 1, 0, 0],
            head: Some(1.4),
        };
        assert_eq!((sound.unsound(), NearStem::default().unsound()), (Vec::new(), Vec::new()));
        let told = |near: NearStem| -> Vec<Vec<&str>> { near.unsound().into_iter().map(|told| told.keys).collect() };
        for profile in [vec![[0.0, 1.0]], vec![[0.0, 1.0], [0.5, 1.0]], vec![[0.0, 1.0], [0.0, 1.0], [1.0, 1.0]]] {
            assert_eq!(told(NearStem { profile, ..NearStem::default() }), [["profile"]]);
        }
        assert_eq!(told(NearStem { profile: vec![[0.0, 1.0], [1.0, f32::NAN]], ..sound.clone() }), [["profile"]]);
        assert_eq!(
            told(NearStem { ranks: Some([4, 2]), lobed_sides: vec![3], head: Some(0.5), ..sound.clone() }).len(),
            3
        );
        let bases = LeafBases { length: 9.0, ..LeafBases::default() };
        assert_eq!(told(NearStem { leaf_bases: Some(bases), ..sound }), [["leaf_bases", "length"]]);
    }
}
