//! A pressure, or a water level, that is imposed; a characteristic that comes from far away.

use sph_core::plugin;

use crate::laws::imposed_pressure;
use crate::profile::{FactorTable, check_course, factor};
use crate::{
    Entering, FaceValues, Moment, OpenBoundary, OpenBoundaryEntry, OpenRefusal, OpenSetting, refuse,
};

/// A given pressure over the whole face; the velocity follows, u = u_i + (p − p_i)/ρc.
///
/// Sound that arrives is thrown back as from a free surface.
///
/// ```toml
/// [wall.outlet.open-boundary.pressure]
/// pressure = "0 Pa"
/// ```
#[plugin(OpenBoundaryEntry [2, 3], "pressure", "a given pressure; the velocity follows",
    source: "Ferrand et al. 2017; Leroy 2014", cfg(not(test)))]
pub struct Pressure {
    /// Pressure over that of the reference density, Pa.
    #[parameter(unit: "Pa")]
    pub pressure: f64,
    /// Times, s, and factors of the pressure, straight between them; it must cover the run.
    #[parameter(default)]
    pub over_time: FactorTable,
    /// Name of the phase that comes in; that of the fluid in front of the face if left out.
    #[parameter(default)]
    pub phase: Option<String>,
}

impl<const D: usize> OpenBoundary<D> for Pressure {
    fn prepare(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        setting.check_phase(&self.phase)?;
        check_course(&self.over_time, setting)
    }
    fn entering(&self) -> Entering {
        Entering::in_phase(&self.phase)
    }
    fn outside(&self, moment: &Moment<'_, D>) -> Vec<FaceValues<D>> {
        let now = self.pressure * factor(&self.over_time, moment.time);
        moment.each(|place, inside| imposed_pressure(place, inside, now))
    }
}

/// A still water level behind the face: the pressure is hydrostatic below it, and nothing passes above.
///
/// For flows slower than their waves, which depend on the level.
///
/// ```toml
/// [wall.tail.open-boundary.level]
/// level = "0.2 m"
/// ```
#[plugin(OpenBoundaryEntry [2, 3], "level", "a still water level behind the face", source: "Ferrand et al. 2017", cfg(not(test)))]
pub struct Level {
    /// Height of the level against gravity, m, from the origin.
    #[parameter(unit: "m")]
    pub level: f64,
    /// Times, s, and factors of the level, straight between them; it must cover the run.
    #[parameter(default)]
    pub over_time: FactorTable,
    /// Name of the phase that comes in; that of the fluid in front of the face if left out.
    #[parameter(default)]
    pub phase: Option<String>,
}

impl<const D: usize> OpenBoundary<D> for Level {
    fn prepare(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        if setting.gravity == 0.0 {
            let why =
                "a level needs gravity: set `numerics.gravity`, or take `open-boundary.pressure`";
            return refuse("level", why);
        }
        setting.check_phase(&self.phase)?;
        check_course(&self.over_time, setting)
    }
    fn entering(&self) -> Entering {
        Entering::in_phase(&self.phase)
    }
    fn outside(&self, moment: &Moment<'_, D>) -> Vec<FaceValues<D>> {
        let level = self.level * factor(&self.over_time, moment.time);
        let g = moment.gravity.norm();
        moment.each(|place, inside| {
            let depth = level - moment.height(&place.centre);
            let still = inside.density * g * depth;
            let mut outside = imposed_pressure(place, inside, still.max(0.0));
            if depth <= 0.0 && outside.velocity.dot(&place.normal) > 0.0 {
                let n = place.normal;
                outside.velocity = inside.velocity - n * inside.velocity.dot(&n);
            }
            outside
        })
    }
}

/// Fluid leaves, and sound with it.
///
/// With u inwards, p_i − ρc u_i arrives from the fluid, u_i that of the face as a whole. With a `velocity` −u₀ far away,
/// p₀ + ρc u₀ comes from outside, so that p = ½ [p_i + p₀ + ρc (u₀ − u_i)]. With a `memory` only faster changes leave, and the means of p_i and u_i over this
/// time, p̄ and ū, have the pressure p₀: p = p₀ + ½ [(p_i − p̄) − ρc (u_i − ū)]. In both cases fluid passes with
/// u = u_i + (p − p_i)/ρc, with the u_i of each element.
///
/// Source: Ferrand et al. 2017 (Riemann invariants), linearised; the running means are ours.
///
/// ```toml
/// [wall.outlet.open-boundary.outflow]
/// pressure = "0 Pa"
/// memory = "0.1 s"
/// ```
#[plugin(OpenBoundaryEntry [2, 3], "outflow", "fluid and sound leave", source: "Ferrand et al. 2017", cfg(not(test)))]
pub struct Outflow {
    /// Pressure p₀ far away, over that of the reference density, Pa.
    #[parameter(default, unit: "Pa")]
    pub pressure: f64,
    /// Velocity −u₀ out of the fluid far away, m/s.
    #[parameter(default, unit: "m/s")]
    pub velocity: Option<f64>,
    /// Time of the running means, s.
    #[parameter(default, unit: "s", above: 0.0)]
    pub memory: Option<f64>,
    /// Height of a level up to which p₀ grows with the depth below it, m; p₀ everywhere if left out.
    #[parameter(default, unit: "m")]
    pub level: Option<f64>,
}

impl<const D: usize> OpenBoundary<D> for Outflow {
    fn prepare(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        match (self.velocity, self.memory) {
            (None, None) => refuse(
                "",
                "it needs the `velocity` far away, or the `memory` over which the fluid's own is averaged",
            ),
            (Some(_), Some(_)) => refuse(
                "memory",
                "the velocity far away is given, and nothing is averaged: take one of the two out",
            ),
            (velocity, _) => setting.check_speed("velocity", velocity.unwrap_or(0.0)),
        }
    }
    fn memory(&self) -> Option<f64> {
        self.memory
    }
    fn outside(&self, moment: &Moment<'_, D>) -> Vec<FaceValues<D>> {
        let g = moment.gravity.norm();
        let [present, mean] = of_the_face(moment);
        moment.each(|place, inside| {
            let z = inside.impedance;
            let depth = |level: f64| (level - moment.height(&place.centre)).max(0.0);
            let far = self.pressure + self.level.map_or(0.0, |l| inside.density * g * depth(l));
            let pressure = match self.velocity {
                Some(out) => 0.5 * (inside.pressure + far - z * (out + present)),
                None => {
                    let changed = inside.pressure - inside.mean_pressure;
                    far + 0.5 * (changed - z * (present - mean))
                }
            };
            imposed_pressure(place, inside, pressure)
        })
    }
}

/// u_i and ū of the face as a whole, m/s.
///
/// Sound in front of a face is a plane wave there. What differs from element to element is the profile of the flow, and which
/// particles have just been taken into the mean: times ρc that would be pressure.
fn of_the_face<const D: usize>(moment: &Moment<'_, D>) -> [f64; 2] {
    let (mut sums, mut whole) = ([0.0; 2], 0.0);
    let all = moment.places.iter().zip(moment.inside);
    for (place, inside) in all.filter(|(_, inside)| inside.wet) {
        let velocities = [inside.velocity, inside.mean];
        for (sum, velocity) in sums.iter_mut().zip(velocities) {
            *sum += place.measure * velocity.dot(&place.normal);
        }
        whole += place.measure;
    }
    match whole > 0.0 {
        true => sums.map(|sum| sum / whole),
        false => sums,
    }
}
