//! The best candidates for the spots of a plan, and what their shadows together really are.
//!
//! The program of `phytomer_shade::arrange` sums what each candidate adds at its spot by itself. Shadows that overlap
//! add less than their sum, never more. So a most that the sum keeps holds for the shadows together; a least may not.
//! An arrangement whose shadows together miss a least is refused with all its parts, which shade less still, and the
//! next best is asked for, until one holds. Absent: the choice itself, and what an arrangement looks like.

use super::{Ground, Planted, ShadeError, month_in_words};
use phytomer_config::plan::{Aim as Sought, Arrange, Plan as Asked};
use phytomer_models::fault::{Fault, Path};
use phytomer_shade::arrange::{Aim, Arrangement, Candidate, Demand, Plan, Rule, conflict};
use phytomer_shade::{Shade, Watch};

/// The most arrangements that are refused.
const MOST_REFUSED: usize = 100;
/// By how much hours may miss a bound by rounding.
const ROUNDING_H: f64 = 1e-9;
/// The place of the year after its months.
const YEAR: usize = 12;

/// An arrangement that holds.
#[derive(Debug, Clone)]
pub struct Arranged {
    /// The candidate of each spot.
    pub chosen: Arrangement,
    /// What it costs.
    pub cost: f64,
    /// Hours of shade a day that it adds to the zones over the year, each by its weight: by the sum of what the
    /// candidates add one by one, and by their shadows together.
    pub added_h: [f64; 2],
    /// What is allowed, and what there is.
    pub checks: Vec<Check>,
    /// How many arrangements were refused, because their shadows together missed a least.
    pub refused: usize,
    /// The hours with it.
    pub shade: Shade,
}

/// Hours that are allowed, and what there is.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// The zone, by its number.
    pub zone: usize,
    /// The month from 0; 12 is the year.
    pub month: usize,
    /// The fewest hours of shade a day.
    pub least_h: Option<f64>,
    /// The most.
    pub most_h: Option<f64>,
    /// As the plan stands.
    pub planned_h: f64,
    /// By the sum of what the candidates add one by one.
    pub summed_h: f64,
    /// By the shadows together.
    pub together_h: f64,
    /// Where in the file it stands: the zone and the entry of its `allow`.
    entry: usize,
}

impl Check {
    /// What is allowed of a plan, where there is nothing yet but what stands.
    pub fn all(plan: &Asked, planned: &Shade) -> Vec<Self> {
        let mut checks = Vec::new();
        for (zone, asked) in plan.zone.iter().enumerate() {
            for (entry, allowed) in asked.allow.iter().enumerate() {
                let year = [YEAR];
                let months: Vec<usize> = allowed.months.iter().map(|month| *month as usize - 1).collect();
                for &month in if months.is_empty() { &year[..] } else { &months[..] } {
                    let hours = planned.zones[zone][month].shade_h();
                    let (least_h, most_h) = (allowed.least_h, allowed.most_h);
                    let [planned_h, summed_h, together_h] = [hours; 3];
                    checks.push(Self { zone, month, least_h, most_h, planned_h, summed_h, together_h, entry });
                }
            }
        }
        checks
    }

    /// Whether some hours are fewer than the least.
    fn misses(&self, hours: f64) -> bool {
        self.least_h.is_some_and(|least| hours < least - ROUNDING_H)
    }

    /// Whether the shadows together keep both bounds.
    pub fn holds(&self) -> bool {
        !self.misses(self.together_h) && self.most_h.is_none_or(|most| self.together_h <= most + ROUNDING_H)
    }

    fn path(&self, key: &str) -> Path {
        Path::root().key("zone").index(self.zone).key("allow").index(self.entry).key(key)
    }
}

/// The best arrangement of a plan whose hours are `planned` without one. `say` hears of each arrangement that is
/// checked.
///
/// # Errors
/// [`ShadeError::Wrong`] with the rules that cannot hold together where there is none.
pub fn arrange(
    ground: &Ground<'_>,
    asked: &Arrange,
    say: &mut dyn FnMut(&str),
    watch: &Watch,
) -> Result<(Shade, Arranged), ShadeError> {
    let (spots, candidates) = (asked.spot.len(), asked.candidate.len());
    let trials = (0..spots * candidates).map(|k| Planted { spot: k / candidates, candidate: k % candidates });
    say("each candidate at each spot");
    let planned = ground.hours(&[], &trials.collect::<Vec<Planted>>(), watch)?;
    let mut checks = Check::all(ground.plan, &planned);
    let mut plan = program(ground, asked, &planned, &checks);
    loop {
        let chosen = plan.solve()?.filter(|_| plan.refused.len() <= MOST_REFUSED);
        let Some(chosen) = chosen else { return Err(ShadeError::Wrong(why_not(ground.plan, &plan, &checks)?)) };
        say(&format!("arrangement {}: the shadows together", plan.refused.len() + 1));
        let planted = chosen.iter().enumerate();
        let planted = planted.filter_map(|(spot, chosen)| chosen.map(|candidate| Planted { spot, candidate }));
        let shade = ground.hours(&planted.collect::<Vec<Planted>>(), &[], watch)?;
        for (number, check) in checks.iter_mut().enumerate() {
            check.summed_h = plan.demanded(number, &chosen);
            check.together_h = shade.zones[check.zone][check.month].shade_h();
        }
        if checks.iter().any(|check| check.misses(check.together_h)) {
            plan.refused.push(chosen);
            continue;
        }
        let weighed = |shade: &Shade| -> f64 {
            let zones = ground.plan.zone.iter().zip(&shade.zones);
            zones.map(|(zone, months)| zone.weight * months[YEAR].shade_h()).sum()
        };
        let added_h = [plan.sum(&plan.gains, &chosen), weighed(&shade) - weighed(&planned)];
        let (cost, refused) = (plan.cost(&chosen), plan.refused.len());
        return Ok((planned, Arranged { chosen, cost, added_h, checks, refused, shade }));
    }
}

/// The question as an integer program.
fn program(ground: &Ground<'_>, asked: &Arrange, planned: &Shade, checks: &[Check]) -> Plan {
    let candidate = |(number, candidate): (usize, &phytomer_config::plan::Candidate)| Candidate {
        cost: candidate.cost,
        height_m: ground.height_m(number),
        at_most: candidate.at_most,
    };
    let weighed = |zones: &Vec<[f64; 13]>| -> f64 {
        zones.iter().zip(&ground.plan.zone).map(|(months, zone)| zone.weight * months[YEAR]).sum()
    };
    let demand = |check: &Check| Demand {
        base: check.planned_h,
        added: planned.added.iter().map(|zones| zones[check.zone][check.month]).collect(),
        least: check.least_h,
        most: check.most_h,
    };
    Plan {
        candidates: asked.candidate.iter().enumerate().map(candidate).collect(),
        rows: asked.spot.iter().map(|spot| spot.row).collect(),
        budget: asked.budget,
        every_spot: asked.every_spot,
        aim: match asked.aim {
            Sought::MostShade => Aim::Most,
            Sought::LeastShade => Aim::Least,
            Sought::Cheapest => Aim::Cheapest,
        },
        gains: planned.added.iter().map(weighed).collect(),
        demands: checks.iter().map(demand).collect(),
        refused: Vec::new(),
    }
}

/// The rules that cannot hold together, each at its place in the file.
fn why_not(asked: &Asked, plan: &Plan, checks: &[Check]) -> Result<Vec<Fault>, ShadeError> {
    let arrange = Path::root().key("arrange");
    if plan.refused.len() > MOST_REFUSED {
        let problem = format!(
            "the {MOST_REFUSED} best arrangements by the sum of hours miss a least by their shadows together, which overlap"
        );
        return Ok(vec![Fault::new(&arrange, problem, "hours that leave more room")]);
    }
    let rules = conflict(plan)?;
    let alone = rules.len() == 1;
    let told = if alone { "no arrangement keeps" } else { "no arrangement keeps all rules told here:" };
    let fault = |rule: &Rule| match rule {
        Rule::Budget => {
            let budget = plan.budget.unwrap_or_default();
            Fault::new(&arrange.key("budget"), format!("{told} the budget of {budget}"), "a larger budget")
        }
        Rule::Rows => Fault::new(
            &arrange.key("spot"),
            format!("{told} the order of rows, tall behind low"),
            "spots without `row`, or other heights",
        ),
        Rule::EverySpot => {
            Fault::new(&arrange.key("every_spot"), format!("{told} that every spot is planted"), "`every_spot = false`")
        }
        Rule::AtMost(number) => Fault::new(
            &arrange.key("candidate").index(*number).key("at_most"),
            format!(
                "{told} the most of `{}`",
                asked.arrange.as_ref().map_or("", |a| a.candidate[*number].name.as_str())
            ),
            "more of it",
        ),
        Rule::Least(number) | Rule::Most(number) => bound(asked, &checks[*number], *rule, told),
        Rule::Refused => Fault::new(
            &arrange,
            format!(
                "{told} what shadows that overlap leave: {} arrangements reach every least by the sum of hours, and their \
                 shadows together do not",
                plan.refused.len()
            ),
            "a smaller least",
        ),
    };
    Ok(rules.iter().map(fault).collect())
}

fn bound(asked: &Asked, check: &Check, rule: Rule, told: &str) -> Fault {
    let (zone, month) = (&asked.zone[check.zone].name, month_in_words(check.month));
    let without = format!("{:.2} h without candidates", check.planned_h);
    match rule {
        Rule::Least(_) => {
            let least = check.least_h.unwrap_or_default();
            let problem =
                format!("{told} at least {least} h of shade a day on `{zone}` in {month}, which has {without}");
            Fault::new(&check.path("least_h"), problem, "fewer hours, or candidates that shade it more")
        }
        _ => {
            let most = check.most_h.unwrap_or_default();
            let problem = format!("{told} at most {most} h of shade a day on `{zone}` in {month}, which has {without}");
            Fault::new(&check.path("most_h"), problem, "more hours, or candidates that shade it less")
        }
    }
}
