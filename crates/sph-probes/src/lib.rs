//! Measurements of a run, and solutions that they are compared with.
//!
//! * [`Probe`]: columns of the time series, from the state of the flow, of one phase of it, or of a bed under water.
//! * The probe `statistic` composes a quantity, the particles that count and reductions; probes as `front` are such
//!   measurements with names of their own. [`MeasuringProbe`] takes them of any [`MeasuredParticles`], as of a frame.
//! * [`derived_stages`]: vorticity and other fields that outputs and probes name.
//! * [`surface_distance`]: the distance to the free surface, computed when it is written.
//! * [`Solution`]: analytical flows, as references and as initial states.
//! * [`norm`]: the norms in which errors are reported.

mod beds;
mod contract;
mod derived;
mod flow;
mod measure;
pub mod norm;
mod phases;
mod sampling;
mod solutions;

pub use contract::{
    Curves, Gathers, Needs, Probe, ProbeColumn, ProbeEntry, ProbeScene, Solution, SolutionEntry,
};
pub use derived::{
    SURFACE_DISTANCE, derived_fields, derived_stages, needs_gradient, surface_distance,
};
pub use flow::energy_budget::{
    BOOKED_COMPRESSION, ENERGY_AT_START, ENERGY_WORKS, EnergyWork, work_of_stranger,
};
pub use flow::profile::Profile;
pub use measure::{
    MeasuredParticles, MeasuringProbe, Quantity, Reduce, Reduction, Statistic, Values, Weight,
    WeightedValues,
};
pub use phases::level::Level;
pub use solutions::*;
