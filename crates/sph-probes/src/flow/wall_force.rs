//! Force and moment of the fluid on a wall.

use sph_core::{StepError, plugin};
use sph_neighbours::{WallForce, World, cross};

use crate::flow::point::{point, wall_number};
use crate::{Needs, Probe, ProbeColumn, ProbeEntry};

/// Force and moment of the fluid on a named wall, pressure and friction together, and the
/// pressure integral by itself.
///
/// The force is the reaction to the force of the wall on the particles, F = −Σ m_a a_a,wall: with the
/// weight it is the whole change of the fluid's momentum. The columns `.pressure` are
/// −Σ p_s S_s n_s over the wall's elements (none with dummy particles). In two dimensions forces
/// are per metre of depth.
///
/// The reaction balances the particles, which begin half a spacing off the wall: under gravity it
/// is that of a body larger by this half spacing: 1.30 times the buoyancy of the block of the
/// tests, where the pressure integral gives 1.03. Take `.pressure` for buoyancy, but for `walls.symmetric`, whose reaction
/// is the displaced weight.
///
/// ```toml
/// [probe.drag]
/// kind = "wall-force"
/// wall = "square"
/// ```
#[plugin(ProbeEntry [2, 3], "wall-force", "force and moment of the fluid on a wall",
    source: "reaction to the wall terms; Ghaïtanellis 2017, Eq. 2.75 and 2.83")]
pub struct WallForceProbe {
    /// Name of the wall.
    pub wall: String,
    /// Point about which moments are taken; the origin if left out.
    #[parameter(default, unit: "m")]
    pub about: Vec<f64>,
}

impl<const D: usize> Probe<D> for WallForceProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        let (force, moment) = match D {
            2 => ("N/m", "N"),
            _ => ("N", "N m"),
        };
        let forces = ProbeColumn::components(D, force);
        let under = |name: &str, mut columns: Vec<ProbeColumn>| {
            columns
                .iter_mut()
                .for_each(|column| column.suffix.insert_str(0, name));
            columns
        };
        let moments = under(".moment", ProbeColumn::turns(D, moment));
        [forces.clone(), moments, under(".pressure", forces)].concat()
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            force_on: Some(&self.wall),
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        wall_number(world, &self.wall, ("probe `wall-force`", ""))?;
        let mut total = WallForce::<D>::zero();
        // A wall drawn in several pieces has several forces.
        let pieces = world.walls.names.iter().zip(&world.walls.forces);
        for (_, force) in pieces.filter(|(name, _)| **name == self.wall) {
            total.force += force.force;
            total.pressure_force += force.pressure_force;
            (0..3).for_each(|k| total.moment[k] += force.moment[k]);
        }
        let shift = cross(&point::<D>(&self.about), &total.force);
        let moment = (0..3).map(|k| total.moment[k] - shift[k]);
        let mut values: Vec<f64> = total.force.iter().copied().collect();
        values.extend(moment.skip(if D == 2 { 2 } else { 0 }));
        values.extend(total.pressure_force.iter());
        Ok(values)
    }
}
