//! Exact solutions, as references and as initial states.

use sph_core::Vect;

mod bingham_poiseuille;
mod channels;
mod free_bodies;
mod periodic;
mod soils;

pub use bingham_poiseuille::BinghamPoiseuille;
pub use channels::{BifluidPoiseuille, Couette, DuctPoiseuille, HagenPoiseuille, Poiseuille};
pub use free_bodies::{EllipticalDrop, Hydrostatic, RigidRotation, RotatingSquare};
pub use periodic::{Cantilever, ElasticShearWave, TaylorGreen, TaylorGreen3d};
pub use soils::{Bagnold, Terzaghi};

/// A sum of amplitudes times decays from `start` on, until a decay is far below rounding.
fn decaying(start: f64, terms: impl Iterator<Item = (f64, f64)>) -> f64 {
    let felt = terms.take_while(|(_, decay)| *decay >= 1e-18);
    felt.fold(start, |sum, (amplitude, decay)| sum + amplitude * decay)
}

/// A velocity along an axis, m/s.
fn along<const D: usize>(axis: usize, speed: f64) -> Option<Vect<D>> {
    let mut velocity = Vect::zeros();
    velocity[axis] = speed;
    Some(velocity)
}
