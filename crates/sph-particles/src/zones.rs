//! Zones of finer particles, each a flow of its own that shares time, walls and laws with the flow around it.
//!
//! * [`attach()`]: the zones of a scene, as [`FinerLevels`](crate::setup::FinerLevels) of its flow.
//! * [`Frame`]: the box of a zone, and the band around it.
//! * [`Sample`] and [`Source`]: the state of particles near a box, and its value anywhere .
//! * [`Guard`]: the band, in which finer particles follow those around.
//! * [`Level`]: a zone that follows the flow around it in time, and gives back its state.
//!
//! All particles of a flow keep one spacing, so that kernels, lists and walls are those of any flow. Within a zone the
//! coarser particles are led by the finer ones, in the band around it the finer ones by the coarser. After the adaptive
//! particle refinement of Chiron, Oger, de Leffe & Le Touzé (J. Comput. Phys. 354, 2018, 552–575).

mod attach;
mod checkpoints;
mod coupling;
mod fit;
mod frame;
mod guard;
mod next_step;
mod refusals;
mod sample;
mod scene_of_zone;
mod spread;

pub(crate) use attach::{attach, stepping};
pub(crate) use coupling::{Coupling, Level, Stepping};
pub(crate) use next_step::{RECOVERY, next_step};
