//! The 23 architectural models of Hallé, Oldeman & Tomlinson 1978 (*Tropical Trees and Forests*), each as what must
//! hold and must not hold of the characters of a plant: one function per model, one line per character.
//!
//! A function returns the first character that the plant lacks. Absent: the shapes of crowns and organs, and models
//! that mix two of these.

use super::characters::Characters;
use super::share::Share;
use super::tolerance::{BENT_OVER, HARDLY_ANY, NEARLY_ALL, RELAYED, SEVERAL};

/// `Ok` for a plant that qualifies for a model; else the first character that it lacks, in words.
pub type Lacks = Result<(), &'static str>;

/// A model: its name as species files write it, and its qualifier.
pub struct Architecture {
    /// The word of the key `architectural_model`.
    pub name: &'static str,
    qualifies: fn(&Characters) -> Lacks,
}

impl Architecture {
    /// Whether a plant of these characters qualifies for the model.
    ///
    /// # Errors
    /// The first character of the model that the plant lacks, in words.
    pub fn qualify(&self, characters: &Characters) -> Lacks {
        (self.qualifies)(characters)
    }
}

/// Every model, in the order of Hallé, Oldeman & Tomlinson.
pub static ARCHITECTURES: [Architecture; 23] = [
    Architecture { name: "holttum", qualifies: holttum },
    Architecture { name: "corner", qualifies: corner },
    Architecture { name: "tomlinson", qualifies: tomlinson },
    Architecture { name: "schoute", qualifies: schoute },
    Architecture { name: "chamberlain", qualifies: chamberlain },
    Architecture { name: "mcclure", qualifies: mcclure },
    Architecture { name: "leeuwenberg", qualifies: leeuwenberg },
    Architecture { name: "koriba", qualifies: koriba },
    Architecture { name: "prevost", qualifies: prevost },
    Architecture { name: "fagerlind", qualifies: fagerlind },
    Architecture { name: "petit", qualifies: petit },
    Architecture { name: "nozeran", qualifies: nozeran },
    Architecture { name: "aubreville", qualifies: aubreville },
    Architecture { name: "massart", qualifies: massart },
    Architecture { name: "roux", qualifies: roux },
    Architecture { name: "cook", qualifies: cook },
    Architecture { name: "scarrone", qualifies: scarrone },
    Architecture { name: "stone", qualifies: stone },
    Architecture { name: "rauh", qualifies: rauh },
    Architecture { name: "attims", qualifies: attims },
    Architecture { name: "mangenot", qualifies: mangenot },
    Architecture { name: "champagnat", qualifies: champagnat },
    Architecture { name: "troll", qualifies: troll },
];

fn must(holds: bool, what: &'static str) -> Lacks {
    if holds { Ok(()) } else { Err(what) }
}

fn nearly_all(share: Share) -> bool {
    share.is_at_least(NEARLY_ALL)
}

fn hardly_any(share: Share) -> bool {
    share.value().is_none_or(|share| share <= HARDLY_ANY)
}

fn no_basal_shoots(c: &Characters) -> Lacks {
    must(c.basal == 0, "no axis of order 1 arises from the base of another")
}

fn no_axillary_axes(c: &Characters) -> Lacks {
    must(c.axillary == 0, "no axis arises from an axillary bud")
}

fn no_relays(c: &Characters) -> Lacks {
    must(c.trunk_relays.relays + c.branch_relays.relays == 0, "no axis is relayed")
}

fn no_forks(c: &Characters) -> Lacks {
    must(c.dichotomies.of == 0, "no apex divides")
}

fn no_terminal_flowers(c: &Characters) -> Lacks {
    must(c.flowered_trunks + c.flowered_branches == 0, "no apex becomes a flower")
}

fn lateral_flowers(c: &Characters) -> Lacks {
    must(c.untold.flowers || c.lateral_flowers > 0, "flowers are lateral")
}

fn one_unbranched_axis(c: &Characters) -> Lacks {
    must(c.axes == 1, "there is one axis alone")
}

fn monopodial_trunk(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_forks(c)?;
    must(c.trunks == 1 && c.trunk_relays.relays == 0, "the trunk is one axis (monopodial)")?;
    must(c.flowered_trunks == 0, "the trunk does not end in a flower")?;
    must(hardly_any(c.plagiotropic_trunks), "the trunk is orthotropic")?;
    must(c.axillary > 0, "the trunk bears branches")
}

fn in_tiers(c: &Characters) -> Lacks {
    must(c.untold.units || c.tiers == Some(true), "branches stand in tiers at the tips of growth units")
}

fn not_in_tiers(c: &Characters) -> Lacks {
    must(c.untold.units || c.tiers == Some(false), "branches are continuous or diffuse along the trunk, not in tiers")
}

fn plagiotropic_branches(c: &Characters) -> Lacks {
    must(nearly_all(c.plagiotropic_limbs) && nearly_all(c.plagiotropic_branches), "branches are plagiotropic")
}

fn orthotropic_branches(c: &Characters) -> Lacks {
    let orthotropic = hardly_any(c.plagiotropic_limbs) && hardly_any(c.plagiotropic_branches);
    must(c.plagiotropic_limbs.of > 0 && orthotropic, "branches are orthotropic")
}

/// The branches are sympodia of modules that end in flowers, relayed by substitution.
fn flowering_modules(c: &Characters) -> Lacks {
    must(c.flowered_branches > 0, "branches end in flowers")?;
    must(nearly_all(c.branch_flowers), "the branch modules that are finished end in flowers")?;
    must(c.branch_relays.relays > 0, "branch modules are relayed")?;
    must(hardly_any(c.branch_relays.apposition), "relays of branches take the place of apices that have ended")
}

fn apposition(c: &Characters) -> Lacks {
    must(c.branch_relays.relays > 0, "branch modules are relayed")?;
    must(nearly_all(c.branch_relays.apposition), "branches are plagiotropic by apposition: relayed apices live on")
}

fn holttum(c: &Characters) -> Lacks {
    one_unbranched_axis(c)?;
    must(c.untold.flowers || c.flowered_trunks == 1, "the axis ends in a flower")?;
    must(c.untold.ends || !c.lives, "no bud lives after the flower")
}

fn corner(c: &Characters) -> Lacks {
    one_unbranched_axis(c)?;
    lateral_flowers(c)?;
    no_terminal_flowers(c)
}

fn tomlinson(c: &Characters) -> Lacks {
    must(c.basal > 0, "axes of order 1 arise from the bases of others")?;
    no_axillary_axes(c)?;
    no_relays(c)?;
    no_forks(c)?;
    // An axis that ends in a flower is that of Holttum's model, whatever flowers stand below its tip; any other axis is
    // that of Corner's model.
    must(c.untold.flowers || c.lateral_flowers + c.flowered_trunks > 0, "axes flower, at their tips or on their sides")
}

fn schoute(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    must(c.dichotomies.of > 0, "apices divide")?;
    must(nearly_all(c.dichotomies), "apices divide into two equal axes of their own order")?;
    lateral_flowers(c)?;
    no_axillary_axes(c)?;
    no_relays(c)?;
    no_terminal_flowers(c)
}

fn chamberlain(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_axillary_axes(c)?;
    no_forks(c)?;
    must(c.trunk_relays.relays > 0, "modules are relayed")?;
    must(c.trunk_relays.single.yes == c.trunk_relays.single.of, "no module has a second relay")?;
    must(c.completed_trunks.yes == 0, "each finished module ends in a flower")?;
    must(c.trunk_relays.finished.is_at_least(RELAYED), "finished modules are relayed")?;
    must(hardly_any(c.plagiotropic_trunks), "modules are orthotropic")?;
    must(hardly_any(c.trunk_relays.apposition), "relays take the place of apices that have ended")
}

fn mcclure(c: &Characters) -> Lacks {
    must(c.basal > 0, "axes of order 1 arise from the bases of others")?;
    must(c.axillary > 0, "trunks have aerial branches")?;
    plagiotropic_branches(c)
}

fn leeuwenberg(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_axillary_axes(c)?;
    no_forks(c)?;
    let relays = &c.trunk_relays;
    must(relays.relays > 0, "modules are relayed")?;
    must(relays.early_several.is_at_least(SEVERAL), "modules of the first generations have two relays or more")?;
    must(hardly_any(relays.apposition), "relays take the place of apices that have ended")?;
    must(relays.finished.is_at_least(RELAYED), "finished modules are relayed")?;
    must(nearly_all(relays.orthotropic) && relays.turned.yes == 0, "all modules are orthotropic for life")
}

fn koriba(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_axillary_axes(c)?;
    no_forks(c)?;
    let relays = &c.trunk_relays;
    must(relays.one_leads.of > 0, "siblings equal at birth come to differ: some lie down as branches")?;
    must(nearly_all(relays.one_leads), "exactly one of the siblings at a fork goes on as the trunk")
}

fn prevost(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_forks(c)?;
    must(c.trunk_relays.relays > 0, "the trunk is a sympodium: its modules are relayed")?;
    must(nearly_all(c.trunk_relays.single), "a trunk module has one relay")?;
    must(nearly_all(c.trunk_relays.bears_branches), "trunk modules bear plagiotropic branches")?;
    must(
        nearly_all(c.trunk_relays.below_older_branches),
        "the relay of a trunk module is born later than its branches and below them",
    )?;
    plagiotropic_branches(c)?;
    apposition(c)
}

fn fagerlind(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    in_tiers(c)?;
    plagiotropic_branches(c)?;
    flowering_modules(c)
}

fn petit(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    not_in_tiers(c)?;
    plagiotropic_branches(c)?;
    flowering_modules(c)
}

fn nozeran(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_forks(c)?;
    must(c.trunk_relays.relays > 0, "the trunk is a sympodium: its modules are relayed")?;
    must(nearly_all(c.completed_trunks) && c.flowered_trunks == 0, "trunk modules end without a flower")?;
    must(hardly_any(c.trunk_relays.apposition), "relays take the place of apices that have ended")?;
    must(nearly_all(c.trunk_relays.single), "a trunk module has one relay")?;
    must(nearly_all(c.trunk_relays.orthotropic), "relays of the trunk are orthotropic")?;
    must(nearly_all(c.trunk_relays.bears_branches), "trunk modules bear two plagiotropic branches or more")?;
    plagiotropic_branches(c)
}

fn aubreville(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    in_tiers(c)?;
    plagiotropic_branches(c)?;
    no_terminal_flowers(c)?;
    apposition(c)
}

fn massart(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    in_tiers(c)?;
    plagiotropic_branches(c)?;
    no_relays(c)
}

fn roux(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    not_in_tiers(c)?;
    plagiotropic_branches(c)?;
    no_relays(c)?;
    no_terminal_flowers(c)?;
    lateral_flowers(c)?;
    must(hardly_any(c.determinate_branches), "branches are long-lived: they grow until they die")
}

fn cook(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    not_in_tiers(c)?;
    plagiotropic_branches(c)?;
    no_relays(c)?;
    no_terminal_flowers(c)?;
    must(nearly_all(c.determinate_branches), "branches are determinate")?;
    must(nearly_all(c.simple_branches), "branches bear no branches")?;
    must(c.shed_branches > 0, "branches are shed whole")
}

fn scarrone(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    in_tiers(c)?;
    orthotropic_branches(c)?;
    flowering_modules(c)
}

fn stone(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    not_in_tiers(c)?;
    orthotropic_branches(c)?;
    flowering_modules(c)
}

fn rauh(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    in_tiers(c)?;
    orthotropic_branches(c)?;
    no_relays(c)?;
    no_terminal_flowers(c)
}

fn attims(c: &Characters) -> Lacks {
    monopodial_trunk(c)?;
    not_in_tiers(c)?;
    orthotropic_branches(c)?;
    no_relays(c)?;
    no_terminal_flowers(c)
}

fn mangenot(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_forks(c)?;
    must(c.trunk_relays.relays > 0, "axes are relayed")?;
    must(nearly_all(c.trunk_relays.single), "an axis has one relay")?;
    must(hardly_any(c.plagiotropic_trunks), "axes are born orthotropic")?;
    must(nearly_all(c.trunk_relays.at_the_turn), "axes turn plagiotropic at a node, and are relayed from there")?;
    must(nearly_all(c.trunk_relays.apposition), "axes live on after they have turned")
}

fn champagnat(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_forks(c)?;
    must(c.trunk_relays.relays > 0, "axes are relayed")?;
    must(
        hardly_any(c.plagiotropic_trunks) && hardly_any(c.plagiotropic_branches) && c.trunk_relays.turned.yes == 0,
        "all axes are orthotropic by their trend",
    )?;
    must(
        c.lie.tips_lowered.is_at_least(BENT_OVER),
        "tips are lowered past the horizontal by weight, as the recorded columns of mechanics tell",
    )?;
    must(c.lie.before_the_fall.is_at_least(BENT_OVER), "relays stand near the summits of the arches")
}

fn troll(c: &Characters) -> Lacks {
    no_basal_shoots(c)?;
    no_forks(c)?;
    must(nearly_all(c.plagiotropic_trunks), "every axis is born plagiotropic")?;
    must(c.plagiotropic_branches.of == 0 || nearly_all(c.plagiotropic_branches), "branches are plagiotropic")?;
    must(
        c.lie.base_erected,
        "the base of the first axis is erected later, as the recorded directions and columns of mechanics tell",
    )
}
