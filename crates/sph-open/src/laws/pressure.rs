//! A pressure that is imposed.

use sph_core::plugin;

use crate::course::{FactorTable, check_course, factor};
use crate::laws::imposed_pressure;
use crate::{
    Entering, FaceElement, FaceValues, FluidMean, Moment, OpenBoundary, OpenBoundaryEntry,
    OpenRefusal, OpenSetting,
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
        Entering::of(&self.phase)
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
