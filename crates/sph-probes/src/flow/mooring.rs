//! Force of a line on its body.

use sph_core::{StepError, plugin, suggestion};
use sph_neighbours::World;

use crate::{Probe, ProbeColumn, ProbeEntry};

/// Force of a line on the body that it holds, and its tension at both ends.
///
/// The columns are `.x`, `.y` (and `.z`), `.tension` at the body and `.anchor` at the fixed end; per metre of depth in two
/// dimensions.
///
/// ```toml
/// [probe.bow]
/// kind = "mooring"
/// wall = "float"
/// line = 0
/// ```
#[plugin(ProbeEntry [2, 3], "mooring", "force and tensions of a line of a body", source: "Hooke's law; Irvine 1981")]
pub struct MooringProbe {
    /// Name of the body.
    pub wall: String,
    /// Index of the line, in the order of the scene; 0 is the first.
    #[parameter(default)]
    pub line: u32,
}

impl<const D: usize> Probe<D> for MooringProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        let unit = if D == 2 { "N/m" } else { "N" };
        let axes = [".x", ".y", ".z"].into_iter().take(D);
        let names = axes.chain([".tension", ".anchor"]);
        names.map(|name| ProbeColumn::named(name, unit)).collect()
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let walls = &world.walls;
        let refuse = |reason| {
            let stage = "probe `mooring`".into();
            Err(StepError::Stage { stage, reason })
        };
        let Some(wall) = walls.names.iter().position(|n| *n == self.wall) else {
            let near = suggestion(&self.wall, walls.names.iter().map(String::as_str));
            return refuse(format!("there is no wall `{}`{near}", self.wall));
        };
        let mut lines = walls.pulls.iter().filter(|p| p.wall as usize == wall);
        let Some(pull) = lines.clone().nth(self.line as usize) else {
            let (wall, count) = (&self.wall, lines.by_ref().count());
            return refuse(format!(
                "`{wall}` has {count} lines: there is no number {}",
                self.line
            ));
        };
        let mut values: Vec<f64> = pull.force.iter().copied().collect();
        values.extend([pull.force.norm(), pull.anchor]);
        Ok(values)
    }
}
