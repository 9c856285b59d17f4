//! The laws that are built in.

mod pressure;
mod velocity_inlet;

pub use pressure::{Level, Outflow, Pressure};
pub use velocity_inlet::{FlowRate, VelocityInlet};

use sph_core::Vect;

use crate::{FaceElement, FaceValues, FluidMean, OpenRefusal, OpenSetting, refuse};

/// A velocity that is imposed along the normal.
pub(crate) fn imposed_velocity<const D: usize>(
    place: &FaceElement<D>,
    normal: f64,
) -> FaceValues<D> {
    FaceValues {
        velocity: place.normal * normal,
        ..FaceValues::dry()
    }
}

impl<const D: usize> FaceValues<D> {
    /// The fluid behind the face yields: it has a pressure p₀ and a velocity u₀, and another pressure where the fluid
    /// passes with another velocity,
    ///
    ///   p = p₀ − ζ (u_n − u₀ₙ),   u_n inwards,
    ///
    /// ζ ≥ 0 in kg/(m² s). With the characteristic that leaves the fluid, p = p_i + ρc (u_n − u_i), both follow. ζ = 0
    /// imposes the pressure, ζ → ∞ the velocity, and ρc lets sound out. Fluid that leaves keeps its velocity along the
    /// face; inflow has that of u₀.
    ///
    /// Above a surface there is no pressure, and the element goes with the water below it: one at rest would be a wall to
    /// those that see it, all within a support of the surface.
    pub fn yielding(
        place: &FaceElement<D>,
        inside: &FluidMean<D>,
        pressure: f64,
        velocity: Vect<D>,
        impedance: f64,
    ) -> Self {
        let values = |velocity, pressure| FaceValues {
            velocity,
            pressure,
            imposed: false,
            share: None,
        };
        let n = place.normal;
        let within = inside.velocity.dot(&n);
        if !inside.wet {
            return values(inside.velocity - n * within.max(0.0), 0.0);
        }
        let (z, aim) = (inside.impedance, velocity.dot(&n));
        // Written so that nothing is rounded differently where ζ = 0.
        let more = (pressure - inside.pressure + impedance * (aim - within)) / (z + impedance);
        let normal = within + more;
        let along = match normal < 0.0 {
            true => inside.velocity - n * within,
            false => velocity - n * aim,
        };
        values(along + n * normal, pressure - impedance * (normal - aim))
    }
}

/// A pressure that is imposed; inflow has no velocity along the face.
pub(crate) fn imposed_pressure<const D: usize>(
    place: &FaceElement<D>,
    inside: &FluidMean<D>,
    pressure: f64,
) -> FaceValues<D> {
    FaceValues::yielding(place, inside, pressure, Vect::zeros(), 0.0)
}

impl OpenSetting<'_> {
    /// Refuses phases that there are none of.
    ///
    /// # Errors
    /// The key `phase`, with the nearest name.
    pub fn check_phase(&self, phase: &Option<String>) -> Result<(), OpenRefusal> {
        let names = || self.phases.iter().map(String::as_str);
        match phase {
            Some(name) if !names().any(|n| n == name) => {
                let near = sph_core::suggestion(name, names());
                let why = format!("there is no phase `{name}`{near}");
                refuse("phase", why)
            }
            _ => Ok(()),
        }
    }

    /// Refuses a speed, m/s, that is faster than sound.
    ///
    /// # Errors
    /// The key that was given.
    pub fn check_speed(&self, key: &str, speed: f64) -> Result<(), OpenRefusal> {
        let sound = self.sound_speed;
        if speed.abs() < sound {
            return Ok(());
        }
        let why = format!(
            "the fluid would pass with {speed:.4} m/s, and its speed of sound is {sound:.4} m/s: raise \
             `speed_of_sound` of the phase to ten times the largest speed"
        );
        refuse(key, why)
    }
}
