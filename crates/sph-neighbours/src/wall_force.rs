//! Force and moment of the fluid on a wall.

use sph_core::Vect;

/// Force and moment of the fluid on one wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallForce<const D: usize> {
    /// F = −Σ m a_w over the particles, a_w being the part of the acceleration that the wall
    /// contributes, N (N/m in two dimensions). The momentum of the fluid changes by the weight
    /// and −ΣF, to rounding.
    pub force: Vect<D>,
    /// −Σ r × m a_w about the origin, N m; only the last component in two dimensions.
    pub moment: [f64; 3],
    /// −Σ p_s S_s n_s over the wall's elements, N: the pressure integral; 0 without elements.
    pub pressure_force: Vect<D>,
    /// −Σ r_s × p_s S_s n_s over the wall's elements, N m.
    pub pressure_moment: [f64; 3],
}

impl<const D: usize> WallForce<D> {
    /// No force.
    pub fn zero() -> Self {
        WallForce {
            force: Vect::zeros(),
            moment: [0.0; 3],
            pressure_force: Vect::zeros(),
            pressure_moment: [0.0; 3],
        }
    }

    /// A force that nobody measured.
    pub(crate) fn unknown() -> Self {
        WallForce {
            force: Vect::repeat(f64::NAN),
            moment: [f64::NAN; 3],
            pressure_force: Vect::repeat(f64::NAN),
            pressure_moment: [f64::NAN; 3],
        }
    }

    /// Adds the force and the moment of something else on the same wall.
    pub fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.pressure_force += other.pressure_force;
        add_moment(&mut self.moment, other.moment);
        add_moment(&mut self.pressure_moment, other.pressure_moment);
    }
}

/// Adds a moment, component by component.
pub(crate) fn add_moment(sum: &mut [f64; 3], more: [f64; 3]) {
    sum.iter_mut().zip(more).for_each(|(s, m)| *s += m);
}
