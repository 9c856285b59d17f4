//! A pressure, or a water level, that is imposed.

use sph_core::plugin;

use crate::laws::imposed_pressure;
use crate::profile::{FactorTable, check_course, factor};
use crate::{
    Entering, FaceElement, FaceValues, FluidMean, Moment, OpenBoundary, OpenBoundaryEntry,
    OpenRefusal, OpenSetting, refuse,
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
    fn lets_out(&self) -> bool {
        true
    }
    fn outside(
        &self,
        places: &[FaceElement<D>],
        inside: &[FluidMean<D>],
        moment: &Moment<D>,
    ) -> Vec<FaceValues<D>> {
        let now = self.pressure * factor(&self.over_time, moment.time);
        let each = places.iter().zip(inside);
        each.map(|(place, inside)| imposed_pressure(place, inside, now))
            .collect()
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
    fn lets_out(&self) -> bool {
        true
    }
    fn outside(
        &self,
        places: &[FaceElement<D>],
        inside: &[FluidMean<D>],
        moment: &Moment<D>,
    ) -> Vec<FaceValues<D>> {
        let level = self.level * factor(&self.over_time, moment.time);
        let g = moment.gravity.norm();
        let one = |(place, inside): (&FaceElement<D>, &FluidMean<D>)| {
            let depth = level - moment.height(&place.centre);
            let still = inside.density * g * depth;
            let mut outside = imposed_pressure(place, inside, still.max(0.0));
            if depth <= 0.0 && outside.velocity.dot(&place.normal) > 0.0 {
                let n = place.normal;
                outside.velocity = inside.velocity - n * inside.velocity.dot(&n);
            }
            outside
        };
        places.iter().zip(inside).map(one).collect()
    }
}
