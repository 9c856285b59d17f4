//! Displacement of a piece of material.

use sph_core::{StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::flow::point::point;
use crate::{Needs, Probe, ProbeColumn, ProbeEntry};

/// Mean displacement of the particles that started within one spacing of a point.
///
/// ```toml
/// [probe.tip]
/// kind = "displacement"
/// at = [0.2, 0.0]
/// ```
#[plugin(ProbeEntry [2, 3], "displacement", "how far the material of a place has moved",
    source: "mean over the particles that started there")]
pub struct DisplacementProbe {
    /// Position of the material at the start.
    #[parameter(unit: "m")]
    pub at: Vec<f64>,
}

impl<const D: usize> Probe<D> for DisplacementProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::components(D, "m")
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            displacement: true,
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let at = point::<D>(&self.at);
        let position = world.free.get(fields::POSITION)?;
        let displacement = world.free.get(fields::DISPLACEMENT)?;
        let near = position.iter().zip(displacement).filter(|(x, moved)| {
            let start = world.domain.wrapped(*x - *moved);
            // A little more than one spacing: a place on the lattice must not depend on rounding.
            world.domain.nearest_image(start - at).norm() < 1.001 * world.spacing
        });
        let (mut count, mut sum) = (0.0, Vect::<D>::zeros());
        for (_, moved) in near {
            count += 1.0;
            sum += moved;
        }
        // Without particles NaN: there is nothing to measure.
        Ok((sum / count).iter().copied().collect())
    }
}
