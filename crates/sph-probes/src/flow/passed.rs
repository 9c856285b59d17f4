//! Volume that has passed an open face.

use sph_core::{StepError, plugin, suggestion};
use sph_neighbours::World;

use crate::contract::refused;
use crate::{Probe, ProbeColumn, ProbeEntry};

/// Mass of all phases that has come in and gone out by an open face since the start, and the mass that the face holds:
/// mass that has come in and is in no particle yet, or has left one and is not out yet. Without a wall those of all
/// faces together.
///
/// entered − left − held is the mass of the particles that were born there less that of those that died.
///
/// ```toml
/// [probe.inlet]
/// kind = "passed"
/// wall = "inlet"
/// ```
#[plugin(ProbeEntry [2, 3], "passed", "mass that has passed an open face", source: "a balance")]
pub struct PassedProbe {
    /// Name of the wall; all open ones if left out.
    #[parameter(default)]
    pub wall: Option<String>,
}

impl<const D: usize> Probe<D> for PassedProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        let unit = if D == 2 { "kg/m" } else { "kg" };
        let names = [".entered", ".left", ".held"];
        names.map(|name| ProbeColumn::named(name, unit)).into()
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let walls = &world.walls;
        let name = |wall: u32| walls.names[wall as usize].as_str();
        let open = || walls.passed.iter().map(|p| name(p.wall));
        if let Some(wall) = self.wall.as_ref().filter(|w| open().all(|n| n != *w)) {
            let near = suggestion(wall, open());
            let reason = format!("there is no open wall `{wall}`{near}");
            return Err(refused("probe `passed`", reason));
        }
        let wanted = |wall: u32| self.wall.as_ref().is_none_or(|w| w == name(wall));
        let mut sums = vec![0.0; 3];
        for passed in walls.passed.iter().filter(|p| wanted(p.wall)) {
            let parts = [passed.entered, passed.left, passed.held];
            sums.iter_mut().zip(parts).for_each(|(sum, x)| *sum += x);
        }
        Ok(sums)
    }
}
