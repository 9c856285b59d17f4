//! Means of the fluid's state at the wall.

use sph_core::{StepError, Vect, fields};
use sph_neighbours::{NeighbourList, World, shepard};

/// What the fluid looks like from a place on the wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallMean {
    /// Σ V [p + ρ (g − a_w)·(x − r)] w / Σ V w, Pa; 0 without fluid. Ghaïtanellis 2017, Eq. 2.91,
    /// with the acceleration of the wall (∂p/∂n = ρ (g − a_w)·n).
    pub pressure: f64,
    /// Σ V w / Σ w, m^d; a whole cell without fluid. Ghaïtanellis 2017, Eq. 3.21.
    pub volume: f64,
}

/// Means over the free particles at every target; walls that never move have no accelerations.
pub(crate) fn wall_means<const D: usize>(
    world: &World<D>,
    targets: &[Vect<D>],
    accelerations: &[Vect<D>],
    list: &NeighbourList,
    whole: f64,
    out: &mut Vec<WallMean>,
) -> Result<(), StepError> {
    let position = world.free.get(fields::POSITION)?;
    let pressure = world.free.get(fields::PRESSURE)?;
    let density = world.free.get(fields::DENSITY)?;
    let volume = world.free.get(fields::VOLUME)?;
    shepard(world, targets, list, out, |t, row, w| {
        let (mut sum_w, mut sum_vw, mut sum_p) = (0.0, 0.0, 0.0);
        let felt = match accelerations.get(t) {
            Some(acceleration) => world.gravity - acceleration,
            None => world.gravity,
        };
        for (&j, w) in row.iter().zip(w) {
            let j = j as usize;
            let vw = volume[j] * w;
            let apart = world.domain.nearest_image(targets[t] - position[j]);
            sum_w += w;
            sum_vw += vw;
            sum_p += vw * (pressure[j] + density[j] * felt.dot(&apart));
        }
        if sum_vw > 0.0 {
            WallMean {
                pressure: sum_p / sum_vw,
                volume: sum_vw / sum_w,
            }
        } else {
            WallMean {
                pressure: 0.0,
                volume: whole,
            }
        }
    })
}
