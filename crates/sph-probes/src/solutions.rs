//! Exact solutions, as references and as initial states.

use sph_core::Vect;

pub(crate) mod bagnold;
pub(crate) mod bifluid_poiseuille;
pub(crate) mod bingham_poiseuille;
pub(crate) mod cantilever;
pub(crate) mod elastic_shear_wave;
pub(crate) mod elliptical_drop;
pub(crate) mod hydrostatic;
pub(crate) mod pipe;
pub(crate) mod plane_channel;
pub(crate) mod rigid_rotation;
pub(crate) mod rotating_square;
pub(crate) mod taylor_green;
pub(crate) mod terzaghi;

/// A velocity along an axis, m/s.
fn along<const D: usize>(axis: usize, speed: f64) -> Option<Vect<D>> {
    let mut velocity = Vect::zeros();
    velocity[axis] = speed;
    Some(velocity)
}
