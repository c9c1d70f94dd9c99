//! The plots of a run: their plants, the species of each, where each stands in its plot and when it is sown.
//!
//! Plots differ only in their places and in the random draws of their plants: plant number = plot × members + member,
//! and draws are keyed by run seed and plant number. A plot has a tick, and each plant an age: the ticks since it was
//! sown. The list of species begins with the scenario's own; the others follow in the order in which members name them.
//! Absent: growth.

use super::Scenario;
use super::events::Work;
use super::member::{Member, too_late};
use super::planting::Grid;
use super::stand::MOST_PLANTS;
use phytomer_law::fault::{Fault, Path};
use phytomer_sim::management::Successor;
use phytomer_sim::random::PlantRandom;
use std::sync::{Arc, OnceLock};

/// The members of a scenario with a stand and the names of all species, found when they are asked for. Two are always
/// equal, since the scenario decides what is in them.
#[derive(Debug, Clone, Default)]
pub struct Laid {
    members: OnceLock<Vec<Member>>,
    names: OnceLock<Vec<String>>,
}

impl PartialEq for Laid {
    fn eq(&self, _other: &Self) -> bool {
        true
    }
}

impl Scenario {
    /// The members of each plot that are stated, one by one or by a stand; none where a plot is a single plant.
    pub fn stated_members(&self) -> &[Member] {
        match &self.stand {
            Some(stand) => self.laid.members.get_or_init(|| stand.members()),
            None => &self.member,
        }
    }

    /// The number of plants in each plot.
    pub fn members(&self) -> u32 {
        let stated = match &self.stand {
            Some(stand) => stand.plants(),
            None => self.member.len() as u64,
        };
        u32::try_from(stated).unwrap_or(u32::MAX).max(1)
    }

    /// How far a plant stands from the place of its member, metres; `draws` are those of the plant.
    pub fn shift_of(&self, draws: &PlantRandom) -> [f64; 3] {
        let [x, y] = self.stand.as_ref().map_or([0.0; 2], |stand| stand.shift(draws));
        [x, y, 0.0]
    }

    /// The ground that belongs to a member of a plot, m²: in a stand that of its layout, else that of a place of the
    /// grid, shared by all members. `None` where neither is stated.
    pub fn ground_area_m2(&self, member: u32) -> Option<f64> {
        if let Some(stand) = &self.stand {
            return stand.ground_area_m2(member.into());
        }
        let Grid { across, along } = self.grid()?;
        Some((across[0] * along[1] - across[1] * along[0]).abs() / f64::from(self.members().max(1)))
    }

    /// The number of plots.
    pub fn plots(&self) -> u32 {
        self.plants / self.members()
    }

    /// The members of one plot, in their order. A scenario without members has one: a plant of the scenario's species.
    /// A successor that states no place stands at that of the member that it replaces.
    pub fn plot_members(&self) -> Vec<Member> {
        if self.stated_members().is_empty() {
            return vec![Member::default()];
        }
        // A member stands after the one that it replaces, whose place is then known.
        let mut members = self.stated_members().to_vec();
        for number in 1..members.len() {
            let replaced = members[number].replaces.map(|replaced| replaced as usize);
            if let Some(replaced) = replaced.filter(|replaced| *replaced < number && members[number].at_m.is_empty()) {
                members[number].at_m = members[replaced].at_m.clone();
            }
        }
        members
    }

    /// A member by its number; one that states no place, and is the successor of another, has the place of that one.
    pub(crate) fn member_at(&self, number: usize) -> Option<Member> {
        let mut member = self.stated_members().get(number)?.clone();
        let mut last = number;
        while member.at_m.is_empty()
            && let Some(replaced) = self.stated_members()[last].replaces.map(|replaced| replaced as usize)
            && replaced < last
        {
            member.at_m.clone_from(&self.stated_members()[replaced].at_m);
            last = replaced;
        }
        Some(member)
    }

    /// The last tick at which a member may be sown.
    pub(super) fn last_sowing(&self) -> u32 {
        let sown = |member: &Member| if member.replaces.is_some() { self.ages.until } else { member.sown };
        self.stated_members().iter().map(sown).max().unwrap_or(0)
    }

    /// The members that are planted by an event alone.
    pub(super) fn successors(&self) -> Arc<[Successor]> {
        let of = |(member, stated): (usize, &Member)| Some(Successor { member, follows: stated.replaces? as usize });
        self.stated_members().iter().enumerate().filter_map(of).collect()
    }

    /// The number of the plot of a plant, and the index of the plant among the members of the plot.
    pub fn plot_of(&self, plant: u32) -> (u32, u32) {
        (plant / self.members(), plant % self.members())
    }

    /// The tick of its plot at which a plant is sown.
    pub fn sown_at(&self, plant: u32) -> u32 {
        self.stated_members().get(self.plot_of(plant).1 as usize).map_or(0, |member| member.sown)
    }

    /// The age, in ticks, that a plant has at the end of the run.
    pub fn last_age_of(&self, plant: u32) -> u32 {
        self.ages.until.saturating_sub(self.sown_at(plant))
    }

    /// The names of all species that grow, without repetition: the scenario's own first, then the others in the order
    /// of the members.
    pub fn species_names(&self) -> Vec<&str> {
        let Some(stand) = &self.stand else {
            let of_members = self.member.iter().filter_map(|member| member.species.as_deref());
            return distinct([self.species.as_str()].into_iter().chain(of_members));
        };
        let found = self.laid.names.get_or_init(|| {
            let names = distinct([self.species.as_str()].into_iter().chain(stand.species()));
            names.into_iter().map(str::to_owned).collect()
        });
        found.iter().map(String::as_str).collect()
    }

    /// The species of a member, as an index into [`Scenario::species_names`].
    pub fn species_of(&self, member: &Member) -> usize {
        let name = member.species.as_deref().unwrap_or(&self.species);
        self.species_names().iter().position(|known| *known == name).unwrap_or(0)
    }

    /// The species of a plant, as an index into [`Scenario::species_names`].
    pub fn species_of_plant(&self, plant: u32) -> usize {
        self.stated_members().get(self.plot_of(plant).1 as usize).map_or(0, |member| self.species_of(member))
    }

    /// The last age, in ticks, that a plant of a species reaches: that of its member that is sown first. A species is
    /// checked and compiled for the ages up to it.
    pub fn last_age_of_species(&self, species: usize) -> u32 {
        self.ages.until.saturating_sub(self.first_sowing_of(species)).max(1)
    }

    /// The tick at which the member of a species that is sown first is sown.
    pub fn first_sowing_of(&self, species: usize) -> u32 {
        let of_species = self.stated_members().iter().filter(|member| self.species_of(member) == species);
        of_species.map(|member| member.sown).min().unwrap_or(0)
    }

    /// Adds the faults of successors, and of their absence.
    fn check_successors(&self, faults: &mut Vec<Fault>) {
        let replants = self.event.iter().any(|event| event.operation == Work::Replanting);
        let mut replaced_by: Vec<Option<usize>> = vec![None; self.stated_members().len()];
        for (number, member) in self.stated_members().iter().enumerate() {
            let Some(replaced) = member.replaces else { continue };
            let path = Path::root().key("member").index(number);
            let mut fault = |key: &str, problem: String, expected: String| {
                faults.push(Fault::new(&path.key(key), problem, expected));
            };
            if replaced as usize >= number {
                let problem =
                    format!("member {number} replaces {replaced}, which does not stand before it in the list");
                let expected = match number {
                    0 => "no `replaces` at the first member".to_owned(),
                    _ => format!("the number of an earlier member, from 0 to {}", number - 1),
                };
                fault("replaces", problem, expected);
            } else if let Some(other) = replaced_by[replaced as usize].replace(number) {
                let problem = format!("the members {other} and {number} both replace {replaced}");
                fault("replaces", problem, format!("{other}, so that they follow one another"));
            }
            if member.sown > 0 {
                let problem = "a successor is planted when its place is free, at no stated tick".to_owned();
                fault("sown", problem, "`replaces` or `sown`".to_owned());
            }
            if !replants {
                let problem = "no event plants the successor".to_owned();
                fault("replaces", problem, "`[[event]]` with the operation `replanting`".to_owned());
            }
        }
        if replants && self.stated_members().iter().all(|member| member.replaces.is_none()) {
            let path = Path::root().key("event");
            let problem = "`replanting` has no effect: no member is the successor of another";
            faults.push(Fault::new(&path, problem, "a `[[member]]` with `replaces`, the number of the other member"));
        }
        self.check_pests_of_successors(faults);
    }

    /// When a successor is planted is not known before the run, so that it meets pests by its age alone.
    fn check_pests_of_successors(&self, faults: &mut Vec<Fault>) {
        if self.stated_members().iter().all(|member| member.replaces.is_none()) {
            return;
        }
        for (number, _) in self.pest.iter().enumerate().filter(|(_, pest)| pest.dates.is_some()) {
            let path = Path::root().key("pest").index(number).key("dates");
            let problem = "when a successor is planted is not known before the run, nor its age on a day";
            faults.push(Fault::new(&path, problem, "`ages` of the plants"));
        }
    }

    /// Adds the faults of members that the schema cannot state.
    pub(super) fn check_members(&self, faults: &mut Vec<Fault>) {
        self.check_successors(faults);
        let members = self.members();
        // A stand that is too large is told of by itself.
        let is_known = self.stand.as_ref().is_none_or(|stand| stand.plants() <= MOST_PLANTS);
        if is_known && !self.plants.is_multiple_of(members) {
            let problem = format!("{} plants cannot be dealt into plots of {members}", self.plants);
            let below = u64::from(self.plots()) * u64::from(members);
            let above = below + u64::from(members);
            let fitting = if below == 0 { above.to_string() } else { format!("{below} or {above}") };
            let expected = format!("a multiple of the number of members, such as {fitting}");
            faults.push(Fault::new(&Path::root().key("plants"), problem, expected));
        }
        let until = self.ages.until;
        for (number, member) in self.member.iter().enumerate().filter(|(_, member)| member.sown >= until) {
            let path = Path::root().key("member").index(number).key("sown");
            faults.push(too_late(&path, "the member is", member.sown, until));
        }
        let own = |member: &Member| member.species.as_ref().is_none_or(|name| *name == self.species);
        if !self.stated_members().is_empty() && !self.stated_members().iter().any(own) {
            let problem = format!("no plant of `{}` grows: each member names another species", self.species);
            let expected = "the species of a member, which then need not name it";
            faults.push(Fault::new(&Path::root().key("species"), problem, expected));
        }
    }
}

/// The names without repetition, in the order in which they come first.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut distinct: Vec<&str> = Vec::new();
    for name in names {
        if !distinct.contains(&name) {
            distinct.push(name);
        }
    }
    distinct
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scenario(members: &str, plants: u32) -> Scenario {
        let text = format!("name = \"a\"\nspecies = \"coffee\"\nplants = {plants}\nages = {{ until = 12 }}\n{members}");
        toml::from_str(&text).unwrap()
    }

    const THREE: &str =
        "member = [{}, { species = \"phlox\", at_m = [1, 2], sown = 3 }, { species = \"coffee\", sown = 2 }]";

    #[test]
    fn plants_are_dealt_into_plots_member_by_member() {
        let three = scenario(THREE, 6);
        assert_eq!((three.members(), three.plots()), (3, 2));
        assert_eq!([0, 2, 3, 5].map(|plant| three.plot_of(plant)), [(0, 0), (0, 2), (1, 0), (1, 2)]);
        assert_eq!([0, 1, 2, 4].map(|plant| three.sown_at(plant)), [0, 3, 2, 3]);
        assert_eq!([0, 1, 2, 4].map(|plant| three.species_of_plant(plant)), [0, 1, 0, 1]);
        assert_eq!(three.species_names(), ["coffee", "phlox"]);
        assert_eq!([0, 1].map(|species| three.last_age_of_species(species)), [12, 9]);
        assert_eq!(three.member[1].place(), [1.0, 2.0, 0.0]);
        assert!(three.faults().is_empty(), "{:?}", three.faults());
    }

    #[test]
    fn without_members_a_plot_is_a_plant() {
        let alone = scenario("", 5);
        assert_eq!((alone.members(), alone.plots(), alone.plot_of(4)), (1, 5, (4, 0)));
        assert_eq!((alone.plot_members().len(), alone.last_age_of(3)), (1, 12));
    }

    #[test]
    fn the_numbers_of_plants_that_fit_are_told() {
        let told = |plants| scenario(THREE, plants).faults().into_iter().map(|f| f.expected).collect::<Vec<_>>();
        assert_eq!(told(2), ["a multiple of the number of members, such as 3"]);
        assert_eq!(told(7), ["a multiple of the number of members, such as 6 or 9"]);
        assert!(told(9).is_empty());
    }
}
