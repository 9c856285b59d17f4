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
pub mod field_error;
mod initial;
mod initial_world;
mod lattices;
mod layers;
mod leaks;
mod memory;
mod movers;
mod open_faces;
mod output_fields;
mod placement;
mod probe_setup;
mod ranks;
mod reference_table;
mod rehearsal;
mod relax;
mod relaxation;
mod rims;
mod shapes;
mod share;
mod soil_remarks;
mod sound;
mod start;
mod tension;
mod variable_gravity;
mod wall_speeds;
mod walls;

pub use assemble::{Assembled, moves};
pub use dimensions::{assemble, assemble_share};
pub use estimate::{Estimate, Size, short_steps, size};
pub use examination::{Examination, FieldUse, StageUse, examine, examine_in};
pub use leaks::Leak;
pub use memory::Memory;
pub use ranks::{ExchangeUse, RankUse, Ranks, ranks};
pub use reference_table::{readable, reference_table};
pub use rehearsal::{Probes, measure_walls, rehearse};
pub use relaxation::Relaxation;
pub use share::{ExistingWalls, Share, all_ready, refuse_the_indivisible};
