//! Force of the fluid on a wall, its place, lines that hold it, and what has passed an open one.

use sph_core::{StepError, Vect, plugin, suggestion};
use sph_neighbours::{WallForce, World, cross};

use crate::flow::point::{point, wall_number};
use crate::{Needs, Probe, ProbeColumn, ProbeEntry};

/// Force and moment of the fluid on a named wall, pressure and friction together, and the pressure integral by itself.
///
/// The force is the reaction to the force of the wall on the particles, F = −Σ m_a a_a,wall: with the weight it is the
/// whole change of the fluid's momentum. The columns `.pressure` are −Σ p_s S_s n_s over the wall's elements (none with
/// dummy particles). In two dimensions forces are per metre of depth.
///
/// The reaction balances the particles, which begin half a spacing off the wall: under gravity it is that of a body
/// larger by this half spacing: 1.30 times the buoyancy of the block of the tests, where the pressure integral gives
/// 1.03. Take `.pressure` for buoyancy, but for `walls.symmetric`, whose reaction is the displaced weight.
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

/// Displacement of a place of a named wall from where it is drawn, and the angle by which the wall is turned.
///
/// The columns are `.x`, `.y` (m) and `.angle` (rad, anticlockwise, between −π and π); in three dimensions `.x`, `.y`, `.z`
/// and the rotation vector `.rx`, `.ry`, `.rz` (rad; its direction is the axis, its length the angle).
///
/// ```toml
/// [probe.float]
/// kind = "wall-motion"
/// wall = "float"
/// at = [0.5, 0.4]
/// ```
#[plugin(ProbeEntry [2, 3], "wall-motion", "displacement and angle of a wall that moves", source: "rigid motion")]
pub struct WallMotionProbe {
    /// Name of the wall.
    pub wall: String,
    /// The place, where it is drawn; the origin if left out.
    #[parameter(default, unit: "m")]
    pub at: Vec<f64>,
}

impl<const D: usize> Probe<D> for WallMotionProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        let angles = match D {
            2 => &[(".angle", "rad")][..],
            _ => &[(".rx", "rad"), (".ry", "rad"), (".rz", "rad")],
        };
        let shift = ProbeColumn::components(D, "m");
        [shift, ProbeColumn::several(angles)].concat()
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let wall = wall_number(world, &self.wall, ("probe `wall-motion`", ""))?;
        let Some(frame) = world.walls.frames.get(wall) else {
            return Ok(vec![0.0; if D == 2 { 3 } else { 6 }]);
        };
        let drawn: Vect<D> = point::<D>(&self.at);
        let shift = frame.present(&drawn) - drawn;
        let turn = turned(&frame.rotation);
        let mut values: Vec<f64> = shift.iter().copied().collect();
        match D {
            2 => values.push(turn[2]),
            _ => values.extend(turn),
        }
        Ok(values)
    }
}

/// The rotation vector of a rotation, rad.
fn turned<const D: usize>(rotation: &[[f64; D]; D]) -> [f64; 3] {
    let at = |i: usize, k: usize| match (rotation.get(i), i == k) {
        (Some(row), _) if k < D => row[k],
        (_, same) => f64::from(u8::from(same)),
    };
    let whole = nalgebra::Matrix3::from_fn(at);
    // By way of a quaternion: the arc cosine of the trace is no number where rounding makes it too large.
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(whole);
    nalgebra::UnitQuaternion::from_rotation_matrix(&rotation)
        .scaled_axis()
        .into()
}

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
        let ends = ProbeColumn::several(&[(".tension", unit), (".anchor", unit)]);
        [ProbeColumn::components(D, unit), ends].concat()
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let stage = "probe `mooring`";
        let wall = wall_number(world, &self.wall, (stage, ""))?;
        let pulls = world.walls.pulls.iter();
        let lines: Vec<_> = pulls.filter(|p| p.wall as usize == wall).collect();
        let pull = lines.get(self.line as usize).ok_or_else(|| {
            let (wall, count, line) = (&self.wall, lines.len(), self.line);
            let reason = format!("`{wall}` has {count} lines: there is no number {line}");
            StepError::stage(stage, reason)
        })?;
        let mut values: Vec<f64> = pull.force.iter().copied().collect();
        values.extend([pull.force.norm(), pull.anchor]);
        Ok(values)
    }
}

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
            return Err(StepError::stage("probe `passed`", reason));
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_rotation() {
        let (sine, cosine) = 2.5_f64.sin_cos();
        let [x, y, z] = turned(&[[cosine, -sine], [sine, cosine]]);
        assert!(x.abs() + y.abs() < 1e-15 && (z - 2.5).abs() < 1e-14);
        let [x, y, z] = turned(&[[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let third = std::f64::consts::TAU / 3.0 / 3.0_f64.sqrt();
        assert!((x - third).abs() + (y - third).abs() + (z - third).abs() < 1e-14);
        let [.., z] = turned(&[[1.0 + 4e-16, -1e-10], [1e-10, 1.0 + 4e-16]]);
        assert!((z - 1e-10).abs() < 1e-24);
    }
}
