//! Grains in suspension: they settle, eddies mix them, the flow lifts them off its bed.
//!
//! * [`HinderedSettling`]: the speed at which grains settle among others, and its flux.
//! * [`pair_flux`]: grains that pass from a particle to another.
//! * [`PickUp`]: the rate at which a flow lifts grains; [`Settling`], [`PickUpVanRijn`] and [`ZysermanFredsoe`] are plugins of
//!   the kind `suspension`.

mod contribution;
mod exchange;
mod hindered;
mod parameters;
mod pick_up;
mod plugins;
mod transport;

pub use contribution::SuspensionEntry;
pub use hindered::HinderedSettling;
pub use parameters::{BodyConcentration, SettlingLaw, Suspended};
pub use pick_up::PickUp;
pub use plugins::{PickUpVanRijn, Settling, ZysermanFredsoe};
pub use transport::{Carried, pair_flux};
