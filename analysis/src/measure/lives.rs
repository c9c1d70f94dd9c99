//! The lives of buds, axes and leaves, read from `components` for the measures of survival and of causes.
//!
//! A life begins at `birth_age` and ends at `death_age`. It is censored by the last recorded age of its plant, which a
//! limit of components makes an earlier one, and by a cut or a harvest. What is cut at a tick is cut before that tick's
//! growth, so it was exposed to death until the tick before. Absent: the statistics.

use super::columns::Columns;
use super::fault::Fault;
use super::source::Source;
use super::stream::{RowOf, Unit};
use phytomer_measures::survival::{Fate, Lives};
use phytomer_outputs::Table;
use phytomer_outputs::tables::columns::CAUSES;
use phytomer_sim::plant::Cause;

/// What lives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Living {
    /// An apical bud: until its mortality test, its flower or its last growth unit ends it.
    Buds,
    /// An axis with all that it bears, as its first internode: until every apex on it has ended.
    Axes,
    /// A leaf.
    Leaves,
}

/// The lives of one plant in one group: durations in ticks and how they ended.
pub(super) type OfPlant = Vec<(u32, Fate)>;

impl Living {
    /// The columns by which lives are grouped.
    pub const GROUPS: [&'static str; 4] = ["order", "kind", "state", "origin"];
}

impl Unit for Living {
    type Row = (u32, Fate);
    type OfPlant = OfPlant;

    fn table(&self) -> Table {
        Table::Components
    }

    fn columns(&self) -> Vec<&'static str> {
        let mut columns = vec!["kind", "birth_age", "death_age", "cause_of_death"];
        columns.extend((*self == Self::Axes).then_some("rank"));
        columns
    }

    fn rows<'a>(&'a self, source: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Self::Row>, Fault> {
        let kinds = columns.words("kind")?;
        let wanted: Vec<bool> = kinds.words.iter().map(|kind| self.is(kind)).collect();
        let ranks = if *self == Self::Axes { Some(columns.ints("rank")?) } else { None };
        let (birth, death, plant) = (columns.ints("birth_age")?, columns.ints("death_age")?, columns.ints("plant_id")?);
        let causes = columns.words("cause_of_death")?;
        let fates: Vec<Option<usize>> = causes.words.iter().map(|cause| number_of(cause)).collect();
        Ok(Box::new(move |row| {
            let is_wanted = kinds.at(row).is_some_and(|kind| wanted[kind]);
            if !is_wanted || ranks.as_ref().is_some_and(|ranks| ranks[row] != 1) {
                return None;
            }
            let born = u32::try_from(birth[row]).ok()?;
            let Ok(died) = u32::try_from(death[row]) else {
                let last = source.plants.get(plant[row].unsigned_abs() as usize)?.last?;
                return Some((last.saturating_sub(born), Fate::Censored));
            };
            let ticks = died.saturating_sub(born);
            Some(match causes.at(row).and_then(|cause| fates[cause]) {
                Some(cause) => (ticks, Fate::Ended(cause)),
                None => (ticks.saturating_sub(1), Fate::Censored),
            })
        }))
    }

    fn add(&self, own: &mut OfPlant, row: Self::Row) {
        own.push(row);
    }
}

impl Living {
    fn is(self, kind: &str) -> bool {
        match self {
            Self::Buds => kind == "apical_bud",
            Self::Axes => kind.ends_with("internode"),
            Self::Leaves => kind == "leaf",
        }
    }
}

/// The number of a cause that ends a life; `None` for one that censors it.
fn number_of(cause: &str) -> Option<usize> {
    let censors = [Cause::Pruned, Cause::Harvested].iter().any(|of| of.tag() == Some(cause));
    let at = CAUSES.iter().position(|known| *known == cause);
    at.filter(|_| !censors)
}

/// Adds the lives of a plant to those of its group.
pub(super) fn keep(lives: &mut Lives, plant: u32, own: &OfPlant) {
    own.iter().for_each(|(ticks, fate)| lives.add(plant, *ticks, *fate));
}
