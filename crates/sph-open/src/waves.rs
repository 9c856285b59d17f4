//! Wave flumes: makers of waves, and gauges of reflected waves.
//!
//! * [`WaveMaker`] is the mover of a piston or a flap ([`Paddle`]), for [`Waves`] of every kind.
//! * [`ReflectionProbe`] separates the two directions ([`separated`]).
//! * [`WaveFace`] is the law of an open face through which waves come and go, on a current.
//! * [`StandingWave`] is a wave between two walls, as a start and as a reference.
//! * [`wavenumber`] is the dispersion of linear waves, [`Jonswap`] a spectrum.

mod absorption;
mod dispersion;
mod face;
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
pub use spectrum::Jonswap;
pub use standing_wave::StandingWave;
pub use superposition::{Component, Waves};
pub use wave_face::WaveFace;
