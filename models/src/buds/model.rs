//! The bud model as the loop sees it: sowing, growing axis by axis to an age, and the diameters at an age.

use super::compile::{BudModel, OrderLaws};
use super::grow::{Axis, Full, Words, first_bud};
use super::law::At;
use phytomer_sim::Tick;
use phytomer_sim::expectation::Expectation;
use phytomer_sim::model::{Growth, GrowthModel, Overgrown};
use phytomer_sim::plant::{ApicalBud, AxisId, Habit, LineageKey, NewAxis, Origin, Plant, Shape};
use phytomer_sim::random::Purpose;
use phytomer_sim::site::Site;
use std::sync::Arc;

impl BudModel {
    /// The last age for which the model's laws are compiled.
    pub fn until(&self) -> Tick {
        self.until
    }

    /// How many orders the species has.
    pub fn orders(&self) -> usize {
        self.orders.len()
    }

    pub(super) fn has_order(&self, order: u8) -> bool {
        (1..=self.orders.len()).contains(&usize::from(order))
    }

    #[inline]
    pub(super) fn laws(&self, order: u8) -> &OrderLaws {
        &self.orders[usize::from(order) - 1]
    }

    /// Grows one axis of `plant` from `bud` to `age`: the axis's own work alone, not that of the axes that it bears.
    ///
    /// This is the step from which both orders of growth are made; a prefix traversal in the manner of de Reffye 1988 §4
    /// calls it recursively.
    ///
    /// # Errors
    /// [`Overgrown`] where the plant comes to its limit.
    pub fn grow_axis(&self, plant: &mut Plant, bud: ApicalBud, age: Tick) -> Result<Option<ApicalBud>, Overgrown> {
        self.grow_with(plant, bud, age, &mut Words::default())
    }

    /// The bud from which axis `axis` of `plant` starts.
    pub fn first_bud(&self, plant: &Plant, axis: AxisId) -> ApicalBud {
        first_bud(self, plant, axis)
    }

    fn grow_with(
        &self,
        plant: &mut Plant,
        bud: ApicalBud,
        age: Tick,
        words: &mut Words,
    ) -> Result<Option<ApicalBud>, Overgrown> {
        let limit = Overgrown { plant: plant.id, limit: plant.component_limit() };
        Axis::new(self, plant, words, bud).grow(age).map_err(|Full| limit)
    }

    /// Every living bud first, then the axes that arise meanwhile, each through all its ticks: parents come before their
    /// children, and the nodes of an axis grown at once stand together.
    fn grow_plant(&self, plant: &mut Plant, age: Tick) -> Result<(), Overgrown> {
        let mut words = Words::default();
        let mut living = std::mem::take(&mut plant.buds);
        let first_new = plant.axes.len();
        let mut kept = 0;
        for place in 0..living.len() {
            if let Some(bud) = self.grow_with(plant, living[place], age, &mut words)? {
                living[kept] = bud;
                kept += 1;
            }
        }
        living.truncate(kept);
        let mut next = first_new;
        while next < plant.axes.len() {
            let bud = first_bud(self, plant, AxisId(next as u32));
            living.extend(self.grow_with(plant, bud, age, &mut words)?);
            next += 1;
        }
        plant.buds = living;
        plant.age = age;
        Ok(())
    }
}

impl GrowthModel for BudModel {
    fn growth(&self) -> Growth {
        Growth::Extends
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) {
        let laws = self.laws(1);
        let mut words = vec![0; laws.step.head_width.max(1)];
        if laws.step.head_width > 0 {
            let mut stream = plant.random.stream(LineageKey::SEED, Purpose::Bud);
            words.iter_mut().for_each(|word| *word = stream.word());
        }
        let axis = plant.add_axis(NewAxis {
            bearer: None,
            key: LineageKey::SEED,
            order: 1,
            origin: Origin::Seed,
            position: 0,
            state: 0,
            appearance: 0,
            birth: 0,
            azimuth: 0.0,
            insertion: laws.step.insertion.draw(&words, 0, At::default()),
        });
        let bud = first_bud(self, plant, axis);
        plant.buds.push(bud);
    }

    fn grow_to(&self, age: Tick, plants: &mut [Plant], _: &Site) -> Result<(), Overgrown> {
        plants.iter_mut().try_for_each(|plant| self.grow_plant(plant, age))
    }

    fn expectation(&self, until: Tick) -> Option<Expectation> {
        self.expectation_from(1, until)
    }

    /// Diameter at birth plus the thickening of the internode's order at the plant's age and its own; a cone's tip takes
    /// the diameter of the internode that follows it on its axis.
    fn thicken(&self, age: Tick, plant: &mut Plant) {
        let Plant { axes, nodes, habit, .. } = plant;
        for node in 0..nodes.len() {
            let axis = nodes.axis[node];
            let order = axes.order[axis.index()];
            let birth = nodes.birth[node];
            let at = At { age, dimension: age.saturating_sub(birth), ..At::default() };
            let diameter = nodes.primary_diameter[node] + self.laws(order).thickening.value(at) * 0.001;
            nodes.diameter[node] = diameter;
            nodes.diameter_tip[node] = diameter;
            let Some(parent) = nodes.parent[node].some() else {
                continue;
            };
            let follows = nodes.axis[parent.index()] == axis && birth <= age;
            if follows && habit.shape(order) == Shape::Cone {
                nodes.diameter_tip[parent.index()] = diameter.min(nodes.diameter[parent.index()]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::buds::law::{Count, CountForm, Law, Normal, Poisson, Variate, VariateForm};
    use crate::buds::params::{
        ApexEnd, Axillary, Flower, GrowthUnit, Leaf, Phyllotaxis, Reiteration, Relay, Season, ShortUnit, SpeedText,
        Transition, Traumatic,
    };
    use crate::buds::{Buds, Order};
    use crate::contract;
    use crate::fault::Path;

    fn poisson(mean: f64) -> Count {
        Count::from(CountForm { poisson: Some(Poisson { mean: Law::from(mean) }), ..CountForm::default() })
    }

    fn normal(mean: f64, sd: f64) -> Variate {
        let normal = Normal { mean: Law::from(mean), sd: Law::from(sd) };
        Variate::from(VariateForm { normal: Some(normal), min: Some(0.0), ..VariateForm::default() })
    }

    /// Everything that the model can do, in one species.
    fn chimera() -> Buds {
        let short = ShortUnit { probability: Law::from(0.3), nodes: Count::from(1), length_cm: Variate::from(0.2) };
        let trunk = Order {
            death: Law::from(0.05),
            pause: Law::from(0.2),
            growth_unit: GrowthUnit {
                nodes: poisson(1.5),
                neoformed: poisson(0.5),
                per_step: Count::from(2),
                short: Some(short),
            },
            axillary: Axillary {
                buds: Count::from(2),
                ramification: Law::from(0.4),
                delay: poisson(0.7),
                state: Some("branch".to_owned()),
                ..Axillary::default()
            },
            reiteration: Reiteration { buds: Count::from(1), probability: Law::from(0.01), ..Reiteration::default() },
            traumatic: Traumatic { probability: Law::from(0.5), delay: Count::from(1), ..Traumatic::default() },
            relay: Relay { on: vec![ApexEnd::Flower], count: Count::from(2), below: 1, ..Relay::default() },
            flower: Flower {
                terminal: Law::from(0.05),
                fruit_set: Law::from(0.5),
                life: poisson(1.0),
                ..Flower::default()
            },
            transition: vec![Transition {
                from: "juvenile".to_owned(),
                to: "adult".to_owned(),
                probability: Law::from(0.2),
            }],
            insertion_deg: normal(3.0, 1.0),
            shed_after: Some(5),
            ..Order::default()
        };
        let branch = Order {
            speed: SpeedText::Ratio("3/2".to_owned()),
            death: Law::from(0.15),
            insertion_deg: normal(60.0, 8.0),
            phyllotaxis: Phyllotaxis::Named("2/5".to_owned()),
            flower: Flower {
                lateral: Law::from(0.4),
                delay: poisson(1.0),
                fruit_set: Law::from(0.5),
                ..Flower::default()
            },
            leaf: Leaf {
                per_node: poisson(1.0),
                life: Some(poisson(3.0)),
                length_cm: normal(5.0, 1.0),
                ..Leaf::default()
            },
            shed_after: Some(2),
            ..Order::default()
        };
        let states = ["juvenile", "adult", "branch"].map(str::to_owned).to_vec();
        let season = Some(Season { ticks_per_year: 4, leaf_fall: 3 });
        Buds { states, season, order: vec![trunk, branch] }
    }

    #[test]
    fn the_bud_model_keeps_the_contract_of_growth_models() {
        let model = chimera().compile(14, &Path::root()).unwrap();
        contract::check(&model, 14, 4);
        let simple = Buds { order: vec![Order::default()], ..Buds::default() };
        contract::check(&simple.compile(6, &Path::root()).unwrap(), 6, 1);
    }
}
