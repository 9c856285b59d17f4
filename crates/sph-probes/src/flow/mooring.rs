//! Force of a line on its body.

use sph_core::{StepError, plugin};
use sph_neighbours::World;

use crate::contract::refused;
use crate::flow::point::wall_number;
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
        let stage = "probe `mooring`";
        let wall = wall_number(world, &self.wall, (stage, ""))?;
        let pulls = world.walls.pulls.iter();
        let lines: Vec<_> = pulls.filter(|p| p.wall as usize == wall).collect();
        let pull = lines.get(self.line as usize).ok_or_else(|| {
            let (wall, count, line) = (&self.wall, lines.len(), self.line);
            let reason = format!("`{wall}` has {count} lines: there is no number {line}");
            refused(stage, reason)
        })?;
        let mut values: Vec<f64> = pull.force.iter().copied().collect();
        values.extend([pull.force.norm(), pull.anchor]);
        Ok(values)
    }
}
