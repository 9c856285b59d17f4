//! Measurements of a run, and solutions that they are compared with.
//!
//! * [`Probe`]: columns of the time series, from the state of the flow ([`Front`],
//!   [`PressureProbe`], [`VelocityProbe`], [`DisplacementProbe`], [`Level`], [`FieldRange`], [`WallForceProbe`], [`PassedProbe`],
//!   [`WallMotionProbe`], [`MooringProbe`], [`StreamFunction`], [`Profile`], [`MeanProfile`], [`EnergySpectrum`],
//!   [`EnergyBudget`]), and of
//!   one phase of it ([`Interface`], [`PhaseVolume`], [`PhaseEnergy`], [`Extent`], [`Yielded`],
//!   [`SurfaceSlope`], [`Line`]), and of a bed under water ([`BedLines`], [`ErodedMass`],
//!   [`PorePressureProbe`]).
//! * [`Statistic`] composes a quantity, the particles that count and reductions; probes as [`Front`] are such measurements
//!   with names of their own.
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
mod surface;

pub use beds::bed_levels::BedLevels;
pub use beds::bed_lines::BedLines;
pub use beds::concentration_level::ConcentrationLevel;
pub use beds::eroded_mass::ErodedMass;
pub use beds::pore_pressure::PorePressureProbe;
pub use beds::scour_map::ScourMap;
pub use contract::{
    Curves, Gathers, Needs, Probe, ProbeColumn, ProbeEntry, ProbeScene, Solution, SolutionEntry,
};
pub use derived::{
    Q_CRITERION, SHEAR_STRESS, SPEED, VORTICITY, VORTICITY_IN_SPACE, derived_fields,
    derived_stages, needs_gradient,
};
pub use flow::angular_momentum::AngularMomentum;
pub use flow::displacement::DisplacementProbe;
pub use flow::energy_budget::{
    BOOKED_COMPRESSION, ENERGY_AT_START, ENERGY_WORKS, EnergyBudget, EnergyWork, work_of_stranger,
};
pub use flow::level::Level;
pub use flow::mean_profile::MeanProfile;
pub use flow::mooring::MooringProbe;
pub use flow::passed::PassedProbe;
pub use flow::point::{PressureProbe, VelocityProbe};
pub use flow::profile::{Component, Profile};
pub use flow::spectrum::EnergySpectrum;
pub use flow::stream_function::StreamFunction;
pub use flow::wall_force::WallForceProbe;
pub use flow::wall_motion::WallMotionProbe;
pub use measure::presets::{
    Direction, Extent, FieldRange, Front, KineticEnergy, PhaseEnergy, PhaseVolume, Yielded,
};
pub use measure::{Reduce, Reduction, Statistic, Weight, WeightedValues};
pub use phases::interface::Interface;
pub use phases::line::{Line, LineOf};
pub use phases::slope::SurfaceSlope;
pub use sampling::{Interpolated, interpolate};
pub use solutions::bagnold::Bagnold;
pub use solutions::bifluid_poiseuille::BifluidPoiseuille;
pub use solutions::bingham_poiseuille::BinghamPoiseuille;
pub use solutions::cantilever::Cantilever;
pub use solutions::elastic_shear_wave::ElasticShearWave;
pub use solutions::elliptical_drop::EllipticalDrop;
pub use solutions::hydrostatic::Hydrostatic;
pub use solutions::pipe::{DuctPoiseuille, HagenPoiseuille};
pub use solutions::plane_channel::{Couette, Poiseuille};
pub use solutions::rigid_rotation::RigidRotation;
pub use solutions::rotating_square::RotatingSquare;
pub use solutions::taylor_green::{TaylorGreen, TaylorGreen3d};
pub use solutions::terzaghi::Terzaghi;
pub use surface::{SURFACE_DISTANCE, surface_distance};
