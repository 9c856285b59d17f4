//! Zones of finer particles, each a flow of its own that shares time, walls and laws with the flow around it.
//!
//! * [`attach()`]: the zones of a scene, and the scene of each.
//! * `frame`: the shape of a zone, its core, and the band around it.
//! * `sample`: the state of particles near a zone, and its value anywhere; `near`, `fit`: particles near a place, and their
//!   weights.
//! * `guard`: the band, in which finer particles follow those around; they are kept apart.
//! * [`Level`]: a zone that follows the flow around it in time; [`Coupling`]: all zones of a flow; [`Stepper`]: steps of a
//!   flow with its zones.
//! * `checkpoints`, `refusals`: files, and scenes that cannot have zones.
//!
//! All particles of a flow keep one spacing, so that kernels, lists and walls are those of any flow. In the core of a
//! zone the coarser particles are drawn to the finer ones, in the band around it the finer ones follow the coarser. After
//! the adaptive particle refinement of Chiron, Oger, de Leffe & Le Touzé (J. Comput. Phys. 354, 2018, 552–575).

mod attach;
mod checkpoints;
mod coupling;
mod fit;
mod frame;
mod guard;
mod near;
mod refusals;
mod sample;

pub(crate) use attach::attach;
pub(crate) use coupling::{Coupling, Level};
pub use coupling::{Stepper, ZoneSize};
