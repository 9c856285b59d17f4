//! A bed as a rough wall: its keys.

use sph_contribution::{Refusal, Setting};
use sph_core::parameters;

use crate::closures::KIND;
use crate::wall::WallLaw;

/// The bed of another phase as a rough wall: within a spacing of it η + η_t = ρu*² z/u_t, so that the friction between the two
/// phases, which acts on both, is the shear ρu*² of the law of the wall at the velocity u_t past the bed.
///
/// u_t is along the bed, relative to the mean velocity of the bed's particles around; the distance z is that at which a flat bed
/// would take the share of the kernel that this one does, not less than a quarter of the spacing.
///
/// Sources: Nikuradse 1933 (law); the viscosity of the first row is that of wall functions on grids. The distance is ours.
#[parameters]
pub struct RoughBed {
    /// Name of the phase that the bed is of.
    pub phase: String,
    /// Equivalent sand roughness k_s: about 2.5 d50 of a flat bed. At most the spacing.
    #[parameter(default, unit: "m", min: 0.0, source: "Nikuradse 1933")]
    pub roughness: f64,
}

impl RoughBed {
    pub(crate) fn law(&self) -> WallLaw {
        WallLaw {
            roughness: self.roughness,
            ..WallLaw::default()
        }
    }

    pub(crate) fn check<const D: usize>(
        &self,
        acts_on: &[String],
        setting: &Setting<'_, D>,
    ) -> Result<(), Refusal> {
        let refused = |key: &str, why: String| Err(Refusal::at_key(KIND, key, why));
        let (phase, known) = (&self.phase, setting.phases);
        if !known.contains(phase) {
            return Err(Refusal::unknown(KIND, "bed.phase", "phase", phase, known));
        }
        if acts_on.is_empty() || acts_on.contains(&self.phase) {
            let why = format!(
                "the closure acts on phase `{}`, which cannot be its own bed: name the fluid alone in `phases`",
                self.phase
            );
            return refused("bed.phase", why);
        }
        let (roughness, spacing) = (self.roughness, setting.world.spacing);
        if (0.0..=spacing).contains(&roughness) {
            return Ok(());
        }
        let why = format!(
            "a roughness from 0 to the spacing of {spacing} m was expected, found {roughness} m"
        );
        refused("bed.roughness", why)
    }
}
