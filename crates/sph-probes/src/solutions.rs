//! Exact solutions, as references and as initial states.

use sph_core::Vect;

mod bagnold;
mod bifluid_poiseuille;
mod bingham_poiseuille;
mod cantilever;
mod elastic_shear_wave;
mod elliptical_drop;
mod hydrostatic;
mod pipe;
mod plane_channel;
mod rigid_rotation;
mod rotating_square;
mod taylor_green;
mod terzaghi;

pub use bagnold::Bagnold;
pub use bifluid_poiseuille::BifluidPoiseuille;
pub use bingham_poiseuille::BinghamPoiseuille;
pub use cantilever::Cantilever;
pub use elastic_shear_wave::ElasticShearWave;
pub use elliptical_drop::EllipticalDrop;
pub use hydrostatic::Hydrostatic;
pub use pipe::{DuctPoiseuille, HagenPoiseuille};
pub use plane_channel::{Couette, Poiseuille};
pub use rigid_rotation::RigidRotation;
pub use rotating_square::RotatingSquare;
pub use taylor_green::{TaylorGreen, TaylorGreen3d};
pub use terzaghi::Terzaghi;

/// A velocity along an axis, m/s.
fn along<const D: usize>(axis: usize, speed: f64) -> Option<Vect<D>> {
    let mut velocity = Vect::zeros();
    velocity[axis] = speed;
    Some(velocity)
}
