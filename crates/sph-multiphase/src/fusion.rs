//! The combinations of built-in terms that are compiled into one loop.

use sph_core::reexport::inventory;
use sph_neighbours::{FusionEntry, fuse_three_lanes, fuse_two_lanes};

use crate::HuAdamsPressure as Pressure;

use sph_diffusion::PressureDiffusion as Smooth;

use sph_viscosity::MorrisTerm;

macro_rules! fuse {
    ($terms:literal, $fuse:ident: $($t:ty),+) => {
        inventory::submit! {
            FusionEntry {
                terms: $terms,
                fuse_2d: $fuse::<2, $($t),+>,
                fuse_3d: $fuse::<3, $($t),+>,
            }
        }
    };
}

fuse!(3, fuse_three_lanes: Pressure, MorrisTerm, Smooth);
fuse!(2, fuse_two_lanes: Pressure, MorrisTerm);
fuse!(2, fuse_two_lanes: Pressure, Smooth);
