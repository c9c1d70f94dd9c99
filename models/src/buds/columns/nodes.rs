//! The columns of nodes: lengths, diameters, azimuths, trends.

use super::block::Block;
use crate::buds::compile::Draws;
use crate::buds::site::turned;
use phytomer_sim::plant::OfUnit;

/// What is drawn and counted for the nodes of a block.
#[derive(Debug, Default)]
pub struct NodeColumns {
    pub units: Vec<OfUnit>,
    pub length: Vec<f32>,
    pub diameter: Vec<f32>,
    divergence: Vec<f32>,
    pub azimuth: Vec<f32>,
    pub trend: Vec<u8>,
    /// For each axis the azimuth of the node after its last.
    pub next_azimuth: Vec<f32>,
}

impl NodeColumns {
    /// Draws the internodes of a block.
    pub fn draw(&mut self, block: &Block<'_>) {
        let laws = &block.laws.node;
        for column in [&mut self.length, &mut self.diameter, &mut self.divergence] {
            column.resize(block.nodes(), 0.0);
        }
        for alike in block.pieces.chunk_by(|one, next| one.short == next.short) {
            let law = if alike[0].short { &laws.short_length } else { &laws.long_length };
            law.draw_many(Draws { pieces: alike, ..block.draws() }, &mut self.length);
        }
        laws.diameter.draw_many(block.draws(), &mut self.diameter);
        laws.divergence.draw_many(block.draws(), &mut self.divergence);
        self.set_trends(block);
        self.set_units(block);
        self.azimuth.clear();
        self.next_azimuth.clear();
        for shoot in block.shoots {
            let mut azimuth = shoot.bud.azimuth;
            self.azimuth.extend(self.divergence[shoot.places()].iter().map(|&divergence| {
                let here = azimuth;
                azimuth = turned(azimuth, divergence);
                here
            }));
            self.next_azimuth.push(azimuth);
        }
    }

    fn set_trends(&mut self, block: &Block<'_>) {
        let trends = &block.laws.head.trends;
        self.trend.clear();
        if let Some(only) = trends.only() {
            return self.trend.resize(block.nodes(), only);
        }
        if trends.are_by_state() {
            for piece in block.pieces {
                self.trend.resize(piece.nodes.1 as usize, trends.at(0, piece.at.state, &[]));
            }
            return;
        }
        for shoot in block.shoots {
            let (first, last) = (shoot.rank(shoot.nodes.0 as usize), shoot.rank(shoot.nodes.1 as usize));
            trends.along(first..last, block.trends_of(shoot), |trend, ranks| {
                self.trend.resize(self.trend.len() + ranks as usize, trend);
            });
        }
    }

    fn set_units(&mut self, block: &Block<'_>) {
        self.units.clear();
        self.units.extend(block.pieces.iter().map(|piece| OfUnit {
            nodes: piece.nodes.1 - piece.nodes.0,
            first: piece.first,
            preformed: piece.preformed,
            short: piece.short,
            birth: piece.at.age,
            growth_unit: piece.at.unit + 1,
            cycle: piece.at.cycle,
        }));
    }
}
