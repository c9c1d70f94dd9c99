//! What a mesh has for those who light and move it: bark in metres, normals of leaves, and columns for the wind.
//!
//! Absent: how they are made (`phytomer_outputs::meshes`).

use super::super::Misuse;
use super::super::afar::{no_levels, within};
use super::super::colouring::{Painted, painted};
use super::super::regrown::Regrown;
use super::formats::Format;
use anyhow::Result as Outcome;
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use phytomer::run::picturing::Pictured;
use phytomer_outputs::colouring::colour_columns;
use phytomer_outputs::meshes::{MeshOptions, Slotting};
use phytomer_sim::plant::Plant;
use std::sync::Arc;

/// Textures, normals and columns of a mesh.
#[derive(Debug, Clone, Default, Args)]
pub struct Dressing {
    /// Let a bark texture cover so many metres on every stem, from the trunk to the twigs. Without it the texture goes
    /// once along each internode and once around it.
    #[arg(long, value_name = "METRES", allow_negative_numbers = true, value_parser = bark)]
    bark: Option<f64>,
    /// Where the normals of leaves point: across the leaf, or out of the crown, which is then shaded as one round body.
    #[arg(long, value_name = "NORMALS", value_enum, default_value_t = LeafNormals::Leaf)]
    leaf_normals: LeafNormals,
    /// Tell for each vertex of a tree of stems how it sways: its level, its place along the stem, and the rate and the
    /// phases of the stem, for a shader that moves it.
    #[arg(long)]
    wind_data: bool,
    /// Tell for each vertex of any plant its order, its radius, the length of the path to it from the ground, and a
    /// phase from 0 to 1 that is that of its branch or of its organ, for shaders.
    #[arg(long)]
    attributes: bool,
    /// How finely leaves, flowers and fruits are drawn: 0, a few polygons, to 3, for close-ups.
    #[arg(long, value_name = "0…3", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=3))]
    detail: u8,
    /// Which materials a GLB, USD or OBJ file has: one for each kind of component (wood, leaves, flowers, fruits), or
    /// one for each kind and order of axes, such as `wood_1`, the trunk.
    #[arg(long, value_name = "BY", value_enum, default_value_t = Materials::Kind)]
    materials: Materials,
    /// Colour the vertices of a PLY file by a column of `records`, by `species`, or of a --plot by the `light` of
    /// leaves and buds; amounts go from violet over green to yellow.
    #[arg(long, value_name = "COLUMN", hide_possible_values = true)]
    #[arg(value_parser = PossibleValuesParser::new(colour_columns()))]
    pub colour_by: Option<String>,
}

/// Where the normals of leaves point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum LeafNormals {
    /// Across the leaf.
    #[default]
    Leaf,
    /// Out of the crown.
    Crown,
}

/// Which materials a file has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Materials {
    /// One for each kind of component.
    #[default]
    Kind,
    /// One for each kind and order of axes.
    Order,
}

impl Dressing {
    /// Refuses what a format, a plot or a species cannot have.
    ///
    /// # Errors
    /// The option.
    pub fn check(&self, format: Format, plot: bool, life: bool, regrown: &Regrown) -> Result<(), Misuse> {
        self.check_format(format, plot, life)?;
        let still = regrown.models().into_iter().zip(regrown.trial.cohorts()).find(|(model, _)| !model.sways());
        match still.filter(|_| self.wind_data) {
            Some((_, cohort)) => Err(no_levels("--wind-data", regrown.species()[cohort.species])),
            None => Ok(()),
        }
    }

    /// Refuses what a format or a plot cannot have.
    ///
    /// # Errors
    /// The option.
    pub fn check_format(&self, format: Format, plot: bool, life: bool) -> Result<(), Misuse> {
        let crown = self.leaf_normals == LeafNormals::Crown;
        let used = [
            ("--bark", self.bark.is_some()),
            ("--leaf-normals crown", crown),
            ("--wind-data", self.wind_data),
            ("--attributes", self.attributes),
        ];
        self.check_materials(format, life)?;
        if self.colour_by.is_some() && (format != Format::Ply || life) {
            return Err(Misuse("--colour-by: this is for a PLY file (.ply) of one age".to_owned()));
        }
        let Some((option, _)) = used.into_iter().find(|(_, used)| *used) else { return Ok(()) };
        if format == Format::Stl {
            return Err(Misuse(format!("{option}: STL holds triangles alone; PLY, GLB and USD hold it")));
        }
        if life {
            return Err(Misuse(format!("{option}: this is for a plant at one age; leave out --ages")));
        }
        let of_one = [("--wind-data", self.wind_data), ("--attributes", self.attributes)];
        match of_one.into_iter().find(|(_, used)| *used && plot) {
            Some((option, _)) => Err(Misuse(format!("{option}: this is for a single plant, by --plant"))),
            None => Ok(()),
        }
    }

    fn check_materials(&self, format: Format, life: bool) -> Result<(), Misuse> {
        if self.materials == Materials::Kind {
            return Ok(());
        }
        if !format.holds_materials() {
            return Err(Misuse(
                "--materials order: PLY and STL hold no materials; GLB, USD and OBJ hold them".to_owned(),
            ));
        }
        if life {
            return Err(Misuse("--materials order: this is for a plant at one age; leave out --ages".to_owned()));
        }
        Ok(())
    }

    /// Whether vertices are to tell how they sway.
    pub fn has_wind_data(&self) -> bool {
        self.wind_data
    }

    /// The colours of each plant that is shown, by the column that is asked for, and what they mean in words; none
    /// where no column is asked for.
    ///
    /// # Errors
    /// A column in which nothing that is shown has a value.
    pub fn paint(&self, pictured: &Pictured, regrown: &Regrown) -> Outcome<(Vec<Painted>, String)> {
        let Some(column) = &self.colour_by else { return Ok((Vec::new(), String::new())) };
        Ok(painted(column, pictured, regrown)?)
    }

    /// How finely organs are drawn.
    pub fn detail(&self) -> u8 {
        self.detail
    }

    /// The option that gives each leaf vertices of its own, which instances of one leaf have not.
    pub fn of_each_leaf(&self) -> Option<&'static str> {
        let asked = [
            (self.leaf_normals == LeafNormals::Crown, "--leaf-normals crown"),
            (self.wind_data, "--wind-data"),
            (self.attributes, "--attributes"),
        ];
        asked.into_iter().find(|(asked, _)| *asked).map(|(_, option)| option)
    }

    /// States them for a plant of a model.
    pub fn dress(&self, options: &mut MeshOptions, regrown: &Regrown, plant: &Plant) {
        self.dress_all(options);
        if self.wind_data {
            let model = regrown.models()[regrown.trial.cohort_of_plant(plant.id)];
            options.swings = Some(Arc::new(model.swings(plant)));
        }
    }

    /// States what plants of any model have.
    pub fn dress_all(&self, options: &mut MeshOptions) {
        options.bark_m = self.bark.map(|metres| metres as f32);
        options.attributes = self.attributes;
        options.crown_normals = self.leaf_normals == LeafNormals::Crown;
        options.detail = self.detail;
        options.slotting = match self.materials {
            Materials::Kind => Slotting::Kind,
            Materials::Order => Slotting::Order,
        };
    }
}

fn bark(text: &str) -> Result<f64, String> {
    within(text, 1e-3, 1e3, "a length from 0.001 to 1000 m is expected, such as 0.5")
}
