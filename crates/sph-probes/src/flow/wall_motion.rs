//! Place of a wall.

use sph_core::{StepError, Vect, plugin};
use sph_neighbours::World;

use crate::flow::point::{point, wall_number};
use crate::{Probe, ProbeColumn, ProbeEntry};

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
        [
            ProbeColumn::components(D, "m"),
            ProbeColumn::several(angles),
        ]
        .concat()
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
