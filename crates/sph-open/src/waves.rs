//! Wave flumes: makers of waves, and gauges of reflected waves.

mod absorption;
mod dispersion;
mod maker;
mod orbits;
mod paddle;
mod reflection;
mod separation;
mod spectrum;
mod standing_wave;
mod superposition;
mod wave_face;

pub use dispersion::{wavenumber, wavenumber_on};
pub use maker::WaveMaker;
pub use paddle::Paddle;
pub use reflection::ReflectionProbe;
pub use separation::{Amplitude, Separated, separated};
pub use standing_wave::StandingWave;
pub use superposition::{Component, Waves};
pub use wave_face::WaveFace;
