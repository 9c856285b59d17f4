//! Pressure and velocity at a point.

use sph_core::{StepError, Vect, fields, plugin, suggestion};
use sph_neighbours::World;

use crate::contract::refused;
use crate::sampling::mean_around;
use crate::{Probe, ProbeColumn, ProbeEntry};

/// Pressure at a point, in the fluid or on a wall, averaged over the face of a sensor.
///
/// p = Σ V [p_b + ρ_b g·(x − r_b)] w / Σ V w (Ghaïtanellis 2017, Eq. 2.91), averaged over
/// points along the sensor's diameter; 0 where there is no fluid.
///
/// ```toml
/// [probe.P2]
/// kind = "pressure"
/// at = ["1610 mm", "15 mm"]
/// diameter = "4.2 mm"
/// along = [0, 1]
/// ```
#[plugin(ProbeEntry [2, 3], "pressure", "pressure at a point or over a sensor's face",
    source: "Ghaïtanellis 2017, Eq. 2.91")]
pub struct PressureProbe {
    /// Position, m.
    #[parameter(unit: "m")]
    pub at: Vec<f64>,
    /// Diameter of the sensor's face; 0 for a point.
    #[parameter(default, unit: "m", min: 0.0)]
    pub diameter: f64,
    /// Direction of the diameter (need not be a unit vector).
    #[parameter(default, unit: "1")]
    pub along: Vec<f64>,
    /// Name of the moving wall that carries the sensor; it stands still if left out.
    pub follows: Option<String>,
}

/// Present position of a point carried by a wall.
///
/// # Errors
/// If there is no wall of that name.
pub(crate) fn carried<const D: usize>(
    world: &World<D>,
    drawn: Vect<D>,
    wall: Option<&str>,
) -> Result<Vect<D>, StepError> {
    let Some(wall) = wall else {
        return Ok(drawn);
    };
    let number = wall_number(world, wall, ("probes", " to follow"))?;
    let frame = world.walls.frames.get(number);
    Ok(frame.map_or(drawn, |frame| frame.present(&drawn)))
}

/// The number of the first wall of a name, which a stage needs for a purpose.
///
/// # Errors
/// If there is none.
pub(crate) fn wall_number<const D: usize>(
    world: &World<D>,
    wall: &str,
    (stage, purpose): (&str, &str),
) -> Result<usize, StepError> {
    let names = &world.walls.names;
    names.iter().position(|n| n == wall).ok_or_else(|| {
        let near = suggestion(wall, names.iter().map(String::as_str));
        refused(stage, format!("there is no wall `{wall}`{purpose}{near}"))
    })
}

/// A point of D coordinates; missing ones are zero.
pub(crate) fn point<const D: usize>(coordinates: &[f64]) -> Vect<D> {
    Vect::from_fn(|k, _| coordinates.get(k).copied().unwrap_or(0.0))
}

impl<const D: usize> Probe<D> for PressureProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("Pa")
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let free = &world.free;
        let (pressure, density) = (free.get(fields::PRESSURE)?, free.get(fields::DENSITY)?);
        let acceleration = free.get(fields::MEAN_ACCELERATION).ok();
        // Exact at rest, and in a tank that is accelerated, where the smoother has the mean accelerations.
        let own = |j: usize, d: &Vect<D>| {
            let inertia = acceleration.map_or(Vect::zeros(), |a| a[j]);
            Vect::from([pressure[j] + density[j] * (world.gravity - inertia).dot(d)])
        };
        let at = |x: Vect<D>| mean_around(world, x, own).map(|p| p[0]);
        let place = |drawn: Vect<D>| carried(world, drawn, self.follows.as_deref());
        let centre = place(point::<D>(&self.at))?;
        let along = place(point::<D>(&self.at) + point::<D>(&self.along))? - centre;
        if self.diameter == 0.0 || along.norm() == 0.0 {
            return Ok(vec![at(centre)?]);
        }
        // Five points share the face evenly.
        let step = along.normalize() * (self.diameter / 5.0);
        let mut mean = 0.0;
        for k in -2..=2 {
            mean += at(centre + step * f64::from(k))? / 5.0;
        }
        Ok(vec![mean])
    }
}

/// Velocity at a point; 0 where there is no fluid.
///
/// ```toml
/// [probe.middle]
/// kind = "velocity"
/// at = [0.5, 0.5]
/// ```
#[plugin(ProbeEntry [2, 3], "velocity", "velocity at a point", source: "Shepard mean")]
pub struct VelocityProbe {
    /// Position, m.
    #[parameter(unit: "m")]
    pub at: Vec<f64>,
}

impl<const D: usize> Probe<D> for VelocityProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::components(D, "m/s")
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let velocity = world.free.get(fields::VELOCITY)?;
        let mean = mean_around(world, point(&self.at), |j, _| velocity[j])?;
        Ok(mean.iter().copied().collect())
    }
}
