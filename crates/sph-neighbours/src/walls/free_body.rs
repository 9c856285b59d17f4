//! Bodies that the fluid moves: place, mobility and change of velocity.

use std::ops::Range;

use nalgebra::{Matrix6, Vector6};
use sph_core::Vect;

use crate::{Domain, Elements, cross};

/// A wall that gives way to forces.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeBody<const D: usize> {
    /// Its pieces among the walls.
    pub walls: Range<u32>,
    /// Its centre, m; periods that it has gone count.
    pub place: Vect<D>,
    /// The periods of the domain; a body is smaller than half of one.
    pub domain: Domain<D>,
    /// Inverse of mass and inertia, 1/kg and 1/(kg m²): the change of velocity and angular velocity over an impulse and
    /// its moment about the centre, with zeros for locked freedoms.
    pub mobility: Matrix6<f64>,
    /// Change of both velocities over the last step, m/s² and rad/s².
    pub rate: Vector6<f64>,
    /// Both velocities less those that friction was last solved with, m/s and rad/s.
    pub missed: Vector6<f64>,
    /// Change of both velocities over this step that friction is solved with.
    pub expected: Vector6<f64>,
}

impl<const D: usize> FreeBody<D> {
    /// True if a wall is one of its pieces.
    pub fn is(&self, wall: usize) -> bool {
        self.walls.contains(&(wall as u32))
    }

    /// j = (e, (x − c) × e): the velocity at a place x of the body along e is j·(v, ω), a force f along e is f j.
    pub fn along(&self, x: &Vect<D>, e: &Vect<D>) -> Vector6<f64> {
        let turn = cross(&self.domain.nearest(x - self.place), e);
        let at = |k: usize| e.get(k).copied().unwrap_or(0.0);
        Vector6::new(at(0), at(1), at(2), turn[0], turn[1], turn[2])
    }

    /// A root S of the mobility, S Sᵀ: one column for each degree of freedom.
    pub fn roots(&self) -> impl Iterator<Item = Vector6<f64>> {
        let eigen = self.mobility.symmetric_eigen();
        (0..6).filter_map(move |k| {
            let value = eigen.eigenvalues[k];
            (value > 0.0).then(|| eigen.eigenvectors.column(k) * value.sqrt())
        })
    }
}

/// The largest λ of Σ S j jᵀ a = λ M a over the elements of a body of area S, m^(d−1)/kg: a layer of fluid of the thickness
/// l at its surface has ρ l λ times its inertia.
pub fn lightness<const D: usize>(body: &FreeBody<D>, elements: &Elements<D>) -> f64 {
    let mut surface = Matrix6::zeros();
    for (s, wall) in elements.wall.iter().enumerate() {
        if body.walls.contains(wall) {
            let j = body.along(&elements.centre[s], &elements.normal[s]);
            surface += j * j.transpose() * elements.measure[s];
        }
    }
    let mut root = Matrix6::zeros();
    for (k, column) in body.roots().enumerate() {
        root.set_column(k, &column);
    }
    (root.transpose() * surface * root)
        .symmetric_eigenvalues()
        .max()
}
