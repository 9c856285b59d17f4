//! Angular momentum of the fluid.

use sph_core::{StepError, fields, plugin};
use sph_neighbours::{World, cross};

use crate::flow::point::point;
use crate::{Probe, ProbeColumn, ProbeEntry};

/// Σ m (r − c) × u over all particles; one column in two dimensions, three in three.
///
/// ```toml
/// [probe.spin]
/// kind = "angular-momentum"
/// about = [0.5, 0.5]
/// ```
#[plugin(ProbeEntry [2, 3], "angular-momentum", "angular momentum of the fluid about a point", source: "Σ m r × u")]
pub struct AngularMomentum {
    /// Point c; the origin if left out.
    #[parameter(default, unit: "m")]
    pub about: Vec<f64>,
    /// All columns are divided by this.
    #[parameter(default: 1.0, unit: "kg m²/s", above: 0.0)]
    pub scale: f64,
}

impl<const D: usize> Probe<D> for AngularMomentum {
    fn columns(&self) -> Vec<ProbeColumn> {
        let unit = match (D, self.scale == 1.0) {
            (_, false) => "1",
            (2, _) => "kg m/s",
            _ => "kg m²/s",
        };
        ProbeColumn::turns(D, unit)
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let about = point::<D>(&self.about);
        let position = world.free.get(fields::POSITION)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let mass = world.free.get(fields::MASS)?;
        let mut sum = [0.0; 3];
        for ((x, u), m) in position.iter().zip(velocity).zip(mass) {
            let spin = cross(&(x - about), u);
            (0..3).for_each(|k| sum[k] += m * spin[k] / self.scale);
        }
        Ok(sum[if D == 2 { 2 } else { 0 }..].to_vec())
    }
}
