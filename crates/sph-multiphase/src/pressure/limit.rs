//! The step that the motion of the fluid allows.

use rayon::prelude::*;
use sph_contribution::{Limiter, SoundLimit};
use sph_core::{StepError, StepLimit, fields};
use sph_neighbours::World;

/// Largest growth of a step over the one before, for which the pressure was solved.
const GROWTH: f64 = 1.1;

/// Δt ≤ C h/(|u|max + √(|g| h)), at the start that of sound and then a tenth more from step to step; √(|g| h) is the speed of the
/// shortest waves on a free surface.
pub struct FlowLimit {
    /// C.
    pub courant: f64,
    /// The step that always goes.
    pub sound: SoundLimit,
}

impl<const D: usize> Limiter<D> for FlowLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let velocity = world.free.get(fields::VELOCITY)?;
        let squared = velocity.par_iter().with_min_len(1024).map(|u| {
            let squared = u.norm_squared();
            if squared.is_nan() {
                f64::INFINITY
            } else {
                squared
            }
        });
        let fastest = squared.reduce(|| 0.0, f64::max).sqrt();
        let h = world.kernel.smoothing_length();
        let flow = self.courant * h / (fastest + (world.gravity.norm() * h).sqrt());
        let sound = self.sound.limit(world)?.dt;
        let longest = sound.max(GROWTH * world.dt);
        Ok(StepLimit::new("flow", flow.min(longest)))
    }
    fn formula(&self) -> String {
        format!(
            "flow: dt <= {} h / (|u| + sqrt(|g| h)), and {GROWTH} times the last",
            self.courant
        )
    }
    fn remedy(&self) -> Option<String> {
        Some("a larger `pressure.implicit.courant` lengthens the step in proportion".into())
    }
}
