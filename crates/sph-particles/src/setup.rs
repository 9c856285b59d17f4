//! A scene becomes particles, walls and a flow that can be evaluated.
//!
//! * [`assemble()`]: scene → [`Assembled`]: particles in their places, walls, plugins, plan, first state.
//! * [`examine()`]: the numbers that follow from a scene, without running it; [`size()`]: how large it is, before it is
//!   assembled; [`ranks()`]: how it divides between machines.
//!
//! The plugins and the plan are those of `sph-solver`.

mod assemble;
mod dimensions;
mod domain;
mod estimate;
mod examination;
pub(crate) mod field_error;
mod initial_world;
mod lattices;
mod layers;
mod leaks;
mod movers;
mod open_faces;
mod placement;
mod probe_setup;
mod ranks;
mod reference_table;
mod relax;
mod rims;
mod shapes;
mod share;
mod soil_remarks;
mod sound;
mod start;
mod variable_gravity;
mod wall_speeds;

pub use assemble::Assembled;
pub(crate) use assemble::{assembled, moves};
pub use dimensions::assemble;
pub(crate) use domain::{box_around, corner};
pub(crate) use estimate::short_steps;
pub use estimate::{Estimate, Memory, Size, size};
pub(crate) use examination::examine_in;
pub use examination::{Examination, FieldUse, StageUse, examine};
pub(crate) use leaks::Leak;
pub(crate) use probe_setup::{Probes, measure_walls, rehearse};
pub use ranks::{ExchangeUse, RankUse, Ranks, ranks};
pub(crate) use reference_table::{readable, reference_series};
pub use relax::Relaxation;
pub(crate) use share::{Share, all_ready, refuse_the_indivisible};
