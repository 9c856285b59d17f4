//! The laws that are built in.

mod flow_rate;
mod level;
mod outflow;
mod pressure;
mod velocity_inlet;

pub use flow_rate::FlowRate;
pub use level::Level;
pub use outflow::Outflow;
pub use pressure::Pressure;
pub use velocity_inlet::VelocityInlet;

use sph_core::Vect;

use crate::{Inside, OpenRefusal, OpenSetting, Outside, Place};

/// A velocity that is imposed along the normal.
pub(crate) fn imposed_velocity<const D: usize>(place: &Place<D>, normal: f64) -> Outside<D> {
    Outside {
        velocity: place.normal * normal,
        ..Outside::dry()
    }
}

/// What a pressure that is imposed makes of the velocity: the characteristic that leaves the fluid carries p − ρc u_n to
/// the face (u_n inwards).
///
/// Above a surface there is no pressure, and the element goes with the water below it: one at rest would be a wall to
/// those that see it, all within a support of the surface.
pub(crate) fn imposed_pressure<const D: usize>(
    place: &Place<D>,
    inside: &Inside<D>,
    pressure: f64,
) -> Outside<D> {
    let within = inside.velocity.dot(&place.normal);
    if !inside.wet {
        return Outside {
            velocity: inside.velocity - place.normal * within.max(0.0),
            pressure: 0.0,
            imposed: false,
        };
    }
    let normal = within + (pressure - inside.pressure) / inside.impedance;
    Outside {
        velocity: passing(place, inside, normal),
        pressure,
        imposed: false,
    }
}

/// Fluid that leaves keeps its velocity along the face; what comes in has none.
fn passing<const D: usize>(place: &Place<D>, inside: &Inside<D>, normal: f64) -> Vect<D> {
    let n = place.normal;
    let along = inside.velocity - n * inside.velocity.dot(&n);
    match normal < 0.0 {
        true => along + n * normal,
        false => n * normal,
    }
}

/// Refuses phases that there are none of.
pub(crate) fn check_phase(
    phase: &Option<String>,
    setting: &OpenSetting<'_>,
) -> Result<(), OpenRefusal> {
    let names = || setting.phases.iter().map(String::as_str);
    match phase {
        None => Ok(()),
        Some(name) if names().any(|n| n == name) => Ok(()),
        Some(name) => {
            let near = sph_core::suggestion(name, names());
            Err(OpenRefusal::of(
                "phase",
                format!("there is no phase `{name}`{near}"),
            ))
        }
    }
}

/// Refuses what is faster than sound.
pub(crate) fn check_speed(
    key: &str,
    speed: f64,
    setting: &OpenSetting<'_>,
) -> Result<(), OpenRefusal> {
    let sound = setting.sound_speed;
    match speed.abs() < sound {
        true => Ok(()),
        false => Err(OpenRefusal::of(
            key,
            format!(
                "the fluid would pass with {speed:.4} m/s, and its speed of sound is {sound:.4} m/s: raise \
                 `speed_of_sound` of the phase to ten times the largest speed"
            ),
        )),
    }
}
