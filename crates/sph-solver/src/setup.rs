//! From a scene to a flow that can be evaluated.

pub(crate) mod assemble;
pub(crate) mod builder;
pub(crate) mod choices;
pub(crate) mod domain;
pub(crate) mod estimate;
pub(crate) mod examination;
pub(crate) mod field_error;
pub(crate) mod initial;
pub(crate) mod joining;
pub(crate) mod lattices;
pub(crate) mod layers;
pub(crate) mod memory;
pub(crate) mod parts;
pub(crate) mod placement;
pub(crate) mod planning;
pub(crate) mod probe_setup;
pub(crate) mod relax;
pub(crate) mod relaxation;
pub(crate) mod room;
pub(crate) mod shapes;
pub(crate) mod soil_remarks;
pub(crate) mod sound;
pub(crate) mod start;
pub(crate) mod transported;
pub(crate) mod wall_speeds;
pub(crate) mod walls;
