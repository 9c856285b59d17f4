//! The magnitude of the strain rate.

use nalgebra::SMatrix;
use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, Symmetric, fields};
use sph_neighbours::World;
use sph_rheology::Gradient;

/// γ̇ = √(2 D:D) with the deviatoric D = ½(G + Gᵀ) − ⅓ tr(G) I, out of the plane included.
///
/// Source: Ghaïtanellis 2017, Eq. 4.6 and 4.88.
pub struct StrainRate;

/// A gradient in the plane, or in space, as one in space.
pub fn in_space<const D: usize>(gradient: &SMatrix<f64, D, D>) -> Gradient {
    let at = |i, j| {
        if i < D && j < D {
            gradient[(i, j)]
        } else {
            0.0
        }
    };
    std::array::from_fn(|i| std::array::from_fn(|j| at(i, j)))
}

/// γ̇ of a gradient, 1/s.
#[inline]
pub(crate) fn magnitude<const D: usize>(gradient: &SMatrix<f64, D, D>) -> f64 {
    let strain = Symmetric::part_of(in_space(gradient)).deviator();
    (2.0 * strain.contract(&strain)).sqrt()
}

impl Declares for StrainRate {
    fn name(&self) -> String {
        "strain rate".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here(fields::VELOCITY_GRADIENT)
            .writes(fields::STRAIN_RATE)
    }
}

impl<const D: usize> Stage<World<D>> for StrainRate {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut rate = world.free.take(fields::STRAIN_RATE)?;
        let gradient = world.free.get(fields::VELOCITY_GRADIENT)?;
        let all = rate.par_iter_mut().zip(gradient).with_min_len(2048);
        all.for_each(|(rate, g)| *rate = magnitude(g));
        Ok(world.free.put(fields::STRAIN_RATE, rate)?)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Matrix3};

    use super::*;

    /// γ̇ of simple shear is its rate; a rigid rotation has none. What is compressed in the plane is drawn out of it.
    #[test]
    fn it_is_that_of_known_flows() {
        let rate = 3.0;
        let shear = Matrix2::new(0.0, rate, 0.0, 0.0);
        assert!((magnitude(&shear) - rate).abs() < 1e-15);
        assert_eq!(magnitude(&Matrix2::new(0.0, rate, -rate, 0.0)), 0.0);
        let pure = Matrix2::new(rate, 0.0, 0.0, -rate);
        assert!((magnitude(&pure) - 2.0 * rate).abs() < 1e-15);
        // D′ = a diag(1, 1, −2)/3: 2 D′:D′ = 4a²/3.
        let even = Matrix2::identity() * rate;
        assert!((magnitude(&even) - rate * (4.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert!(magnitude(&(Matrix3::identity() * rate)) < 1e-15, "in space");
    }

    #[test]
    fn it_is_the_same_in_every_frame() {
        let gradient = Matrix3::new(0.3, 1.0, -2.0, 0.5, -0.7, 4.0, -1.0, 2.0, 0.25);
        let turn = nalgebra::Rotation3::from_euler_angles(0.4, -1.1, 2.0).into_inner();
        let turned = turn * gradient * turn.transpose();
        assert!((magnitude(&turned) / magnitude(&gradient) - 1.0).abs() < 1e-14);
        assert_eq!(in_space(&gradient)[0], [0.3, 1.0, -2.0], "rows");
    }
}
