//! Which form an organ has where detail is asked for: that of its species' settings, or of the library's.
//!
//! In a picture detail goes by size on the film: the distance within which organs are drawn is half a pixel there, and
//! an organ has the detail whose triangles are still some pixels large. So a full tree costs hardly more than at detail
//! 0. Instances have the form of the detail that is asked for, by its [`NearForm`]. Absent: the forms themselves
//! (`forms::near`).

use super::MeshOptions;
use super::forms::{FormMesh, near};
use phytomer_looks::{Blade, Capitulum, Near, Paints, place_of_own};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{Form, OrganId, PaintNumber, Plant};
use std::sync::{Arc, OnceLock};

/// The length that an organ has at least for each detail from 1, in distances within which organs are drawn.
const LENGTHS: [f32; 3] = [50.0, 120.0, 400.0];

/// The stages of a head that opens as it ages, and of a blade that tears.
const STAGES: u8 = 8;

/// Which form from near an organ has: the form of the library or the setting of its species with its stage, and the
/// detail and the class of its proportions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct NearForm {
    source: Source,
    place: u8,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Source {
    Library(u8),
    Stated { setting: u16, stage: u8 },
}

impl NearForm {
    /// A number that no other form of its plant has.
    pub fn number(self) -> u32 {
        let source = match self.source {
            Source::Library(form) => u32::from(form) << 8,
            Source::Stated { setting, stage } => 1 << 31 | u32::from(setting) << 12 | u32::from(stage) << 8,
        };
        source | u32::from(self.place)
    }
}

/// Room for the forms from near of a species, which all scenes with the same options share.
#[derive(Debug, Clone, Default)]
pub struct SharedNears(Arc<OnceLock<Arc<Nears>>>);

impl SharedNears {
    /// The forms of a species with such looks.
    pub fn of(&self, paints: &Paints) -> Arc<Nears> {
        let shared = self.0.get_or_init(|| Arc::new(Nears::of(paints)));
        // Options may be used for plants of several species; the others have forms of their own.
        if shared.is_of(paints) { Arc::clone(shared) } else { Arc::new(Nears::of(paints)) }
    }
}

/// The settings of a species, and the forms that are made of them.
#[derive(Debug, Default)]
pub struct Nears {
    stated: Vec<Near>,
    /// For each setting its stages; one of what does not change with its age.
    made: Vec<Vec<(Near, near::Made)>>,
}

impl Nears {
    /// The settings of a species.
    pub fn of(paints: &Paints) -> Self {
        let made = |near: Near| (near, near::Made::new());
        let stated = paints.nears().to_vec();
        Self { made: stated.iter().map(|near| stages(near).into_iter().map(made).collect()).collect(), stated }
    }

    fn is_of(&self, paints: &Paints) -> bool {
        self.stated == paints.nears()
    }

    /// A form that an organ was found to have.
    pub fn mesh(&self, form: NearForm) -> Option<&FormMesh> {
        match form.source {
            Source::Library(number) => near::of_library_at(Form(number), form.place),
            Source::Stated { setting, stage } => {
                self.made.get(usize::from(setting))?.get(usize::from(stage))?.1.at_place(form.place)
            }
        }
    }

    /// The form of an organ from near, and which it is; `None` at detail 0 and for a mesh of the user's.
    #[inline]
    pub fn form(
        &self,
        (plant, age): (&Plant, Tick),
        organ: OrganId,
        options: &MeshOptions,
    ) -> Option<(NearForm, &FormMesh)> {
        let detail = detail_of(plant, organ, options);
        if detail == 0 {
            return None;
        }
        let (organs, place) = (&plant.organs, organ.index());
        let size = [organs.length[place], organs.width[place]];
        let paint = plant.look_of_organ(organ).map_or(PaintNumber::NONE, |look| look.paint);
        let setting = Paints::of(&plant.habit).organ(paint).near;
        let stated = setting.and_then(|setting| Some((setting, self.made.get(usize::from(setting))?)));
        let stage = |stages: &[(Near, near::Made)]| stage(plant, organ, age, stages.len());
        let stated = stated.and_then(|(setting, stages)| {
            let stage = stage(stages);
            Some((Source::Stated { setting, stage: stage as u8 }, stages.get(stage)?))
        });
        let (source, (mesh, place)) = match stated {
            Some((source, (near, made))) => (source, made.of(near, detail, size, organs.area[place])),
            None if place_of_own(organs.form[place]).is_some() => return None,
            None => {
                let form = organs.form[place];
                (Source::Library(form.0), near::of_library(form, detail, size, organs.area[place]))
            }
        };
        Some((NearForm { source, place }, mesh))
    }
}

/// The detail of an organ: what is asked for, or less where it is drawn within a distance.
#[inline]
pub fn detail_of(plant: &Plant, organ: OrganId, options: &MeshOptions) -> u8 {
    let within = options.tolerance.filter(|tolerance| tolerance.organs && options.detail > 0);
    within.map_or(options.detail, |within| {
        let length = plant.organs.length[organ.index()].max(plant.organs.width[organ.index()]);
        let reached = LENGTHS.iter().take_while(|least| length >= **least * within.distance).count();
        options.detail.min(reached as u8)
    })
}

/// A setting in each of its stages.
fn stages(near: &Near) -> Vec<Near> {
    match near {
        Near::Capitulum(head) if head.opened.is_none() => (0..STAGES)
            .map(|stage| {
                let share = f32::from(stage) / f32::from(STAGES - 1);
                // Rays unfold first; then the florets open from the rim inwards.
                let unfolded = head.unfolded * (3.0 * share).min(1.0);
                Near::Capitulum(Capitulum { opened: Some(share), unfolded, ..*head })
            })
            .collect(),
        Near::Blade(blade) if blade.tears > 0.0 => {
            let torn = |stage: u8| blade.tears * f32::from(stage) / f32::from(STAGES - 1);
            (0..STAGES).map(|stage| Near::Blade(Blade { tears: torn(stage), ..*blade })).collect()
        }
        _ => vec![*near],
    }
}

/// The stage of an organ at an age of its plant, by the share of its life that it has lived.
fn stage(plant: &Plant, organ: OrganId, age: Tick, stages: usize) -> usize {
    let (birth, death) = (plant.organs.birth[organ.index()], plant.organs.death[organ.index()]);
    if stages < 2 || death == NEVER || death <= birth {
        return 0;
    }
    let lived = f64::from(age.saturating_sub(birth)) / f64::from((death - birth).max(2) - 1);
    ((lived.min(1.0) * (stages - 1) as f64).round() as usize).min(stages - 1)
}
