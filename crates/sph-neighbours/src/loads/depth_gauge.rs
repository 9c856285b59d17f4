//! Depth of the fluid before a wall.

use sph_core::{StepError, Vect, fields};

use crate::World;

/// The place at which a wall measures the depth of the fluid before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthGauge<const D: usize> {
    /// A point of its face, m; the lowest one that leans.
    pub place: Vect<D>,
    /// Unit vector into the fluid, horizontal: its last component is 0.
    pub along: Vect<D>,
    /// By how much the face leans forward above `place`, m per metre of height.
    pub lean: f64,
    /// Distance to which it looks, m.
    pub reach: f64,
    /// From where to where it looks to the side, m; without meaning in the plane.
    pub sideways: [f64; 2],
}

impl<const D: usize> DepthGauge<D> {
    /// Share with which a place counts: 1 at the face, falling to 0 as (1 − q)² (1 + 2q) over the reach, so that no
    /// particle that comes or goes there is felt.
    fn share(&self, x: &Vect<D>) -> f64 {
        let apart = x - self.place;
        let height = apart[D - 1].max(0.0);
        let q = (apart.dot(&self.along) - self.lean * height) / self.reach;
        let [from, to] = self.sideways;
        let aside = D == 3 && {
            let side = x[1] * self.along[0] - x[0] * self.along[1];
            side < from || side > to
        };
        match !aside && q < 1.0 {
            // Fluid that has come behind the face belongs to it.
            true => (1.0 - q.max(0.0)).powi(2) * (1.0 + 2.0 * q.max(0.0)),
            false => 0.0,
        }
    }

    /// Area over which the shares are those of whole columns, m² (m in the plane).
    fn area(&self) -> f64 {
        let breadth = match D {
            3 => self.sideways[1] - self.sideways[0],
            _ => 1.0,
        };
        0.5 * self.reach * breadth
    }

    /// Depth of the fluid, m: Σ V f over ∫ f, with the particles of all ranks.
    ///
    /// # Errors
    /// If there are no positions or volumes, or another rank has failed.
    pub fn depth(&self, world: &World<D>) -> Result<f64, StepError> {
        let (position, volume) = world.free.all((fields::POSITION, fields::VOLUME))?;
        let [sum] = world.sums(|i| [volume[i] * self.share(&position[i])])?;
        Ok(sum / self.area())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns at ½, 3/2, … of a spacing: the midpoint rule of a cubic whose slopes vanish at both ends, (δr/R)⁴/30 at most.
    #[test]
    fn shares_of_a_lattice_are_those_of_whole_columns() {
        let gauge = DepthGauge::<3> {
            place: Vect::<3>::new(0.3, 0.4, 0.0),
            along: Vect::<3>::new(0.6, 0.8, 0.0),
            lean: 0.0,
            reach: 4.0,
            sideways: [-1.0, 1.0],
        };
        let at = |d: f64, side: f64| {
            let x = gauge.along * (0.5 + d) + Vect::<3>::new(-0.8, 0.6, 0.0) * side;
            gauge.share(&x)
        };
        let sum: f64 = (0..8).map(|n| at(0.5 + f64::from(n), 0.0)).sum();
        assert!(
            (2.0 * sum / gauge.area() - 1.0).abs() < 1.0 / 256.0,
            "{sum}"
        );
        assert_eq!([at(0.5, 1.1), at(4.1, 0.0)], [0.0, 0.0]);
    }
}
