//! Grains that a flow carries along its bed, and the bed that they leave.

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
