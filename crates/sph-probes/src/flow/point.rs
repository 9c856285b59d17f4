//! Pressures and velocity at a point, displacement of its material, and angular momentum about it.

use sph_core::{StepError, Vect, fields, plugin, suggestion};
use sph_neighbours::{World, cross};

use crate::sampling::mean_around;
use crate::{Needs, Probe, ProbeColumn, ProbeEntry};

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
/// An unknown wall.
pub(crate) fn wall_number<const D: usize>(
    world: &World<D>,
    wall: &str,
    (stage, purpose): (&str, &str),
) -> Result<usize, StepError> {
    let names = &world.walls.names;
    names.iter().position(|n| n == wall).ok_or_else(|| {
        let near = suggestion(wall, names.iter().map(String::as_str));
        StepError::stage(stage, format!("there is no wall `{wall}`{purpose}{near}"))
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

/// Pore-water pressure q = p − p' at a point: that of the water in the pores of a soil, and of the water beside it.
///
/// q = Σ V [q_b + ρ_w g·(x − r_b)] w / Σ V w, as `pressure` with the weight of the pores' fluid; 0 where there is
/// nothing. p is the pressure of the equation of state and p' the effective pressure, 0 outside of soils. Only scenes
/// with `[effective-pressure.PLUGIN]` have it; for such probes the field `pore_pressure` is computed.
///
/// Source: Ghaïtanellis 2017, Eqs. 2.91 and 5.26.
///
/// ```toml
/// [gauge.PG1]
/// kind = "pore-pressure"
/// at = [1.2, 0.05]
/// ```
#[plugin(ProbeEntry [2, 3], "pore-pressure", "pressure of the water in a soil's pores at a point",
    source: "p − p'; Ghaïtanellis 2017, Eqs. 2.91, 5.26")]
pub struct PorePressureProbe {
    /// Position, m.
    #[parameter(unit: "m")]
    pub at: Vec<f64>,
    /// Density ρ_w of the fluid in the pores.
    #[parameter(default: 1000.0, unit: "kg/m³", above: 0.0)]
    pub density: f64,
    /// Name of the moving wall that carries the sensor; it stands still if left out.
    pub follows: Option<String>,
}

impl<const D: usize> Probe<D> for PorePressureProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("Pa")
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            fields: vec![fields::PORE_PRESSURE.name.into()],
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let pore = world.free.get(fields::PORE_PRESSURE).map_err(|_| {
            let reason =
                "there is no pore pressure without an effective one: [effective-pressure.PLUGIN]";
            StepError::stage("probes", reason)
        })?;
        let x = carried(world, point::<D>(&self.at), self.follows.as_deref())?;
        let own = |j: usize, d: &Vect<D>| [pore[j] + self.density * world.gravity.dot(d)].into();
        Ok(vec![mean_around::<D, 1>(world, x, own)?[0]])
    }
}

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
        let (position, displacement) = world.free.all((fields::POSITION, fields::DISPLACEMENT))?;
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
        let (position, velocity) = world.free.all((fields::POSITION, fields::VELOCITY))?;
        let mass = world.free.get(fields::MASS)?;
        let mut sum = [0.0; 3];
        for ((x, u), m) in position.iter().zip(velocity).zip(mass) {
            let spin = cross(&(x - about), u);
            (0..3).for_each(|k| sum[k] += m * spin[k] / self.scale);
        }
        Ok(sum[if D == 2 { 2 } else { 0 }..].to_vec())
    }
}
