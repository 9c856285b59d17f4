//! Grains that a flow carries along its bed, and the bed that they leave.
//!
//! * [`Grains`]: Shields number, its critical value, settling velocity; [`critical_ratio`]: on a slope.
//! * [`BedLoadLaw`]: a rate of transport; [`MeyerPeterMuller`], [`WongParker`], [`EngelundFredsoe`] and [`VanRijn`] are
//!   plugins of the kind `bed-load`, and move the walls that are [beds](sph_core::bed::Bed).
//! * [`PickUp`]: a rate at which a flow lifts grains; [`Settling`], [`PickUpVanRijn`] and [`ZysermanFredsoe`] are plugins of the
//!   kind `suspension`.
//! * [`balance`]: Exner's equation and slides, which keep the volume of the grains.

mod balance;
mod bed_shear;
mod grains;
mod moving_bed;
mod plugins;
mod suspension;

pub use balance::{Balance, Packing, balance};
pub use grains::{Grains, critical_ratio};
pub use moving_bed::{BedLoadEntry, BedLoadLaw, MovingBed};
pub use plugins::{EngelundFredsoe, MeyerPeterMuller, VanRijn, WongParker};
pub use suspension::{
    BodyConcentration, Carried, HinderedSettling, PickUp, PickUpVanRijn, Settling, SettlingLaw,
    Suspended, SuspensionEntry, ZysermanFredsoe, pair_flux,
};
