//! A parametric tree compiled: its numbers, and how its stems and leaves are drawn.
//!
//! Absent: the checks of the numbers (`checks`).

use super::model::TreeModel;
use super::params::Tree;
use super::sections::Sections;
use crate::buds::params::LeafChoice;
use crate::buds::params::colour::turning_of;
use crate::fault::{Fault, Path};
use phytomer_looks::{InternodePaint, Paints};
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{Habit, InternodeLook, Looks, OrganLook, OrganLooks, Shape, Trend};

/// The most leaves that an internode may bear in all years together.
const MOST_LEAVES: f64 = 65_535.0;

impl Tree {
    /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn compile(&self, until: Tick, path: &Path) -> Result<TreeModel, Vec<Fault>> {
        let numbers = self.numbers(until, path);
        let (mut faults, mut paints) = (Vec::new(), Paints::default());
        let looks = self.looks(path, &mut paints, &mut faults);
        match numbers {
            Err(found) => Err([found, faults].concat()),
            Ok(_) if !faults.is_empty() => Err(faults),
            Ok(numbers) => {
                let years = numbers.ages.generations(until).len() as f64;
                if (numbers.leaves.abs() * numbers.quality).ceil() * years > MOST_LEAVES {
                    let problem =
                        format!("a stem bears up to {} leaves in each of {years} years", numbers.leaves.abs());
                    let expected = format!("at most {MOST_LEAVES} leaves of a stem in all years of the run");
                    return Err(vec![Fault::new(&path.key("Leaves"), problem, expected)]);
                }
                let sections = Sections::of(&numbers, &mut paints);
                let trends = vec![Trend::STRAIGHT];
                let habit = Habit { trends, looks, for_drawing: paints.into_habit(), ..Habit::default() };
                Ok(TreeModel::new(numbers, sections, habit))
            }
        }
    }

    /// The looks of stems and leaves.
    fn looks(&self, path: &Path, paints: &mut Paints, faults: &mut Vec<Fault>) -> Looks {
        let bark = self.whole.bark.as_ref().map(|bark| bark.bark(&path.key("bark"), faults)).unwrap_or_default();
        let stem = paints.add_internode(InternodePaint { bark, ..InternodePaint::default() });
        let year = self.whole.season.as_ref().map_or(0, |season| season.ticks_per_year.value());
        let colour = self.whole.leaf_colour.as_ref();
        let leaf = paints.add_organ(LeafChoice::paint(colour, turning_of(year), &path.key("leaf_colour"), faults));
        let leaf = OrganLook { paint: leaf, ..OrganLook::default() };
        Looks {
            states: 1,
            internodes: vec![InternodeLook { paint: stem, ..InternodeLook::of_shape(Shape::Cone) }],
            organs: vec![OrganLooks { leaf, ..OrganLooks::default() }],
            ..Looks::default()
        }
    }
}
