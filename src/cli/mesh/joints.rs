//! How the internodes of a mesh hang together: `--joints open|collar|welded`.
//!
//! Absent: how they are joined (`phytomer_outputs::meshes`).

use super::super::Misuse;
use clap::{Args, ValueEnum};
use phytomer_outputs::meshes::{Joints, MeshOptions, Scene};

/// How internodes hang together.
#[derive(Debug, Clone, Default, Args)]
pub struct Joining {
    /// How branches meet what bears them: `open`, as tubes that go through one another; `collar`, where the foot of a
    /// branch widens into its bearer; `welded`, where all wood is one closed surface, for printers and sculpting.
    #[arg(long, value_name = "JOINTS", value_enum, default_value_t = Kind::Open)]
    joints: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Kind {
    /// Each tube by itself.
    #[default]
    Open,
    /// The foot of a branch widens into its bearer.
    Collar,
    /// One closed surface.
    Welded,
}

impl Joining {
    /// Refuses joints of what moves or grows, whose wood is made of lines.
    ///
    /// # Errors
    /// The option.
    pub fn check(&self, moves: bool) -> Result<(), Misuse> {
        match self.joints {
            Kind::Collar | Kind::Welded if moves => Err(Misuse(format!(
                "--joints {}: this is for a plant that stands still at one age; leave out --ages and --rig",
                self.word()
            ))),
            _ => Ok(()),
        }
    }

    /// States them.
    pub fn dress(&self, options: &mut MeshOptions) {
        options.joints = match self.joints {
            Kind::Open => Joints::Open,
            Kind::Collar => Joints::Collar,
            Kind::Welded => Joints::Welded,
        };
    }

    /// Refuses to weld where nothing that is drawn is wood.
    ///
    /// # Errors
    /// What has none.
    pub fn has_wood<'s, 'p: 's>(
        &self,
        what: &str,
        scenes: impl IntoIterator<Item = &'s Scene<'p>>,
    ) -> Result<(), Misuse> {
        let none = self.joints == Kind::Welded && scenes.into_iter().all(Scene::welds_nothing);
        if none { Err(Misuse(format!("--joints welded: {what} has no wood that could be welded"))) } else { Ok(()) }
    }

    /// What is told of them.
    pub fn in_words(&self) -> &'static str {
        match self.joints {
            Kind::Open => "",
            Kind::Collar => ", with collars",
            Kind::Welded => ", wood welded",
        }
    }

    fn word(&self) -> &'static str {
        match self.joints {
            Kind::Open => "open",
            Kind::Collar => "collar",
            Kind::Welded => "welded",
        }
    }
}
