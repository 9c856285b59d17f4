//! Grains in suspension: they settle, eddies mix them, the flow lifts them off its bed.

mod contribution;
mod exchange;
mod plugins;
mod settling;
mod transport;

pub use plugins::{PickUp, PickUpVanRijn, Settling, SuspensionEntry, ZysermanFredsoe};
pub use settling::{BodyConcentration, HinderedSettling, SettlingLaw, Suspended};
pub use transport::{Carried, pair_flux};
