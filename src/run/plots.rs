//! The plots of a scenario as they are sown: each member with its species, its draws, its place and its tick of sowing.
//!
//! Plots stand on the grid of the scenario, members beside the place of their plot, and planes that kill buds with
//! their plot: so a plot differs from the others by its place and by the draws of its plants alone. Where no plant can
//! feel another one, or a plane, a single plant can be sown without its plot. Absent: growing.

use phytomer_config::Scenario;
use phytomer_config::scenario::{Member, Table};
use phytomer_sim::management::Management;
use phytomer_sim::plant::{Seed, ThreadBudget};
use phytomer_sim::site::Site;
use phytomer_sim::{GrowthModel, Plot, Sowing};

/// The plots of a run, to be sown. Costs a few words a member.
#[derive(Clone)]
pub struct Plots<'a> {
    scenario: &'a Scenario,
    management: Management,
    models: Vec<&'a dyn GrowthModel>,
    /// Each member with its species, as a place in `models`.
    members: Vec<(Member, usize)>,
}

impl<'a> Plots<'a> {
    /// The plots of a scenario whose species, in the order of [`Scenario::species_names`], have these models.
    pub fn of(scenario: &'a Scenario, models: Vec<&'a dyn GrowthModel>) -> Self {
        let members = scenario.plot_members();
        let members = members.into_iter().map(|member| (member.clone(), scenario.species_of(&member))).collect();
        Self { scenario, management: scenario.management(), models, members }
    }

    /// The scenario.
    pub fn scenario(&self) -> &'a Scenario {
        self.scenario
    }

    /// The models of its species.
    pub fn models(&self) -> &[&'a dyn GrowthModel] {
        &self.models
    }

    /// A plot before its first tick.
    pub fn sow(&self, plot: u32, budget: ThreadBudget) -> Plot<'a> {
        let mut sown = Plot::new(plot, self.models.clone(), &self.sowings(plot));
        sown.site = self.site(plot);
        sown.manage(self.management.clone());
        sown.plants.iter_mut().for_each(|plant| plant.budget = budget);
        sown
    }

    /// Makes a plot that was grown another one, keeping its memory.
    pub fn sow_again(&self, grown: &mut Plot<'a>, plot: u32) {
        grown.sow_again(plot, &self.sowings(plot));
        grown.site = self.site(plot);
    }

    /// A plant by itself in a plot of one, sown at tick 0, so that tick and age are the same.
    pub fn sow_alone(&self, plant: u32) -> Plot<'a> {
        let (plot, member) = self.scenario.plot_of(plant);
        let species = self.members.get(member as usize).map_or(0, |(_, species)| *species);
        let (seed, place) = (seed_of(self.scenario, plant), place_of(self.scenario, plant));
        let mut alone = Plot::new(plot, self.models.clone(), &[Sowing { species, seed, place, sown: 0 }]);
        alone.site = self.site(plot);
        alone.manage(self.management.clone());
        alone
    }

    /// Whether a plant depends on what else stands in its plot, or on when it was sown in it: events have ticks of the
    /// plot, and may choose among its plants.
    pub fn feed_back(&self) -> bool {
        self.site(0).feeds_back() || !self.management.is_empty()
    }

    fn site(&self, plot: u32) -> Site {
        self.scenario.site.felt_at(plot_place(self.scenario, plot))
    }

    fn sowings(&self, plot: u32) -> Vec<Sowing> {
        let first = plot * self.scenario.members();
        let sowing = |((member, species), plant): (&(Member, usize), u32)| Sowing {
            species: *species,
            seed: seed_of(self.scenario, plant),
            place: place_of(self.scenario, plant),
            sown: member.sown,
        };
        self.members.iter().zip(first..).map(sowing).collect()
    }
}

/// The most components of a plant.
pub fn component_limit(scenario: &Scenario) -> u32 {
    scenario.limits.components()
}

/// What plant number `plant` of a scenario grows from.
pub fn seed_of(scenario: &Scenario, plant: u32) -> Seed {
    Seed {
        plant,
        run_seed: scenario.seed,
        component_limit: component_limit(scenario),
        keep_events: scenario.tables.contains(&Table::Events),
    }
}

/// Where its seed lies, metres: the place of its plot, and from there to that of the member.
pub fn place_of(scenario: &Scenario, plant: u32) -> [f64; 3] {
    let (plot, member) = scenario.plot_of(plant);
    let place = plot_place(scenario, plot);
    let Some(member) = scenario.member.get(member as usize) else { return place };
    let beside = member.place();
    [0, 1, 2].map(|axis| place[axis] + beside[axis])
}

/// The place of a plot, metres: on a square grid; each at an origin of its own where the scenario gives no spacing.
pub fn plot_place(scenario: &Scenario, plot: u32) -> [f64; 3] {
    let Some(spacing) = scenario.spacing_m else { return [0.0; 3] };
    let [column, row] = lattice_of(plot);
    let along = |steps: u32| f64::from(steps) * spacing;
    [along(column), along(row), 0.0]
}

/// The column and the row of a plot on a square grid that grows by shells, whatever the number of plots.
///
/// Shell s holds the 2s + 1 places whose larger coordinate is s, so the shells before it fill the square of s² places,
/// and plot i stands in shell s = ⌊√i⌋ at its place k = i − s². The shell goes up the column s from row 0 to the
/// corner and back along the row s to column 0: (s, k) where k ≤ s, else (2s − k, s). Plot 0 is at the origin.
fn lattice_of(plot: u32) -> [u32; 2] {
    let shell = plot.isqrt();
    let along = plot - shell * shell;
    if along <= shell { [shell, along] } else { [2 * shell - along, shell] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_config::scenario::Limits;
    use phytomer_config::{Resolved, validate};
    use std::collections::BTreeSet;

    fn changed(change: impl FnOnce(&mut Scenario)) -> Resolved {
        let mut resolved = validate("example1").unwrap_or_else(|report| panic!("{}", report.render(false)));
        change(&mut resolved.scenario);
        resolved
    }

    #[test]
    fn plants_keep_their_places_however_many_grow() {
        let place = |plants, spacing_m, plant| {
            let resolved = changed(|scenario| {
                scenario.plants = plants;
                scenario.spacing_m = spacing_m;
            });
            place_of(&resolved.scenario, plant)
        };
        for plants in [3, 4, 9, 10, 1_000_000] {
            let first = [0, 1, 2].map(|plant| place(plants, Some(2.5), plant));
            assert_eq!(first, [[0.0; 3], [2.5, 0.0, 0.0], [2.5, 2.5, 0.0]], "{plants} plants");
        }
        assert_eq!(place(9, Some(1.0), 8), [0.0, 2.0, 0.0]);
        assert_eq!(place(9, None, 8), [0.0; 3]);
    }

    #[test]
    fn members_stand_beside_the_place_of_their_plot() {
        let resolved = changed(|scenario| {
            let aside = Member { at_m: vec![0.5, -1.0], ..Member::default() };
            (scenario.plants, scenario.spacing_m) = (8, Some(10.0));
            scenario.member = vec![Member::default(), aside];
        });
        let places = [0, 1, 2, 5].map(|plant| place_of(&resolved.scenario, plant));
        assert_eq!(places, [[0.0; 3], [0.5, -1.0, 0.0], [10.0, 0.0, 0.0], [10.5, 9.0, 0.0]]);
    }

    #[test]
    fn the_smaller_limit_holds() {
        let limit = |limits: Limits| component_limit(&changed(|scenario| scenario.limits = limits).scenario);
        assert_eq!(limit(Limits::default()), 50_000_000);
        assert_eq!(limit(Limits { max_memory_mb: Some(96), ..Limits::default() }), 1_000_000);
        assert_eq!(limit(Limits { max_components: 5_000, max_memory_mb: Some(96) }), 5_000);
    }

    #[test]
    fn shells_fill_squares_place_by_place() {
        let places: Vec<[u32; 2]> = (0..10_000).map(lattice_of).collect();
        for side in 1..=100_u32 {
            let square: BTreeSet<[u32; 2]> = places[..(side * side) as usize].iter().copied().collect();
            assert_eq!(square.len(), (side * side) as usize, "each place once");
            assert!(square.iter().flatten().all(|step| *step < side), "within the square of side {side}");
        }
        for pair in places.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let steps = a[0].abs_diff(b[0]) + a[1].abs_diff(b[1]);
            let to_next_shell = b[1] == 0;
            assert!(steps == 1 || to_next_shell, "neighbours in a shell are a spacing apart: {a:?} {b:?}");
        }
        // The first and the last of the largest shell that 32 bits number.
        let shell = u32::MAX.isqrt();
        assert_eq!(lattice_of(shell * shell), [shell, 0]);
        assert_eq!(lattice_of(u32::MAX), [0, shell]);
    }
}
