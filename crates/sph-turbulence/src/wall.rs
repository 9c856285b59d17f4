//! Walls whose boundary layer is finer than the particles.

mod function;
mod law;
mod nearest;
mod probe;
mod solution;
mod stage;

pub use function::{LogLaw, WallFunctionEntry};
pub use law::{WallLaw, WallLawError};
pub(crate) use nearest::{LEAST_DISTANCE, nearest};
pub use probe::FrictionVelocityProbe;
pub use solution::LogLawFlow;
