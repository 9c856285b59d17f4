//! Pressure from the end of the step.

mod stage;
mod system;

use sph_contribution::{Limiter, Setting, bound, largest, sound_limit};
use sph_core::{Stage, fields, plugin};
use sph_neighbours::World;

use crate::linear::Automatic;
use crate::{Acting, PressureEntry, PressureScheme};
use stage::SolvePressure;

/// The pressure of the end of the step: p = p(ρ) − ρc²Δt D{uⁿ⁺¹} with uⁿ⁺¹ = uⁿ + Δt (g − ∇p/ρ), that is
///
/// γ_aV_a/(ρ_ac_a²) p_a + Δt² Σ_b V_aV_b|F_ab| {[1/(γ_aρ_a) + 1/(γ_bρ_b)] (p_a − p_b) − (1/γ_a + 1/γ_b) g·r_ab} =
/// γ_aV_a [p(ρ_a)/(ρ_ac_a²) − Δt D_a{uⁿ}].
///
/// Symbols: p(ρ) equation of state (Pa), c speed of sound (m/s), D{u} the rate at which the formulation's density falls
/// (1/s), F = w'/r (1/m^(d+2)), Δt the last step (s). The system is symmetric and compressible: with cΔt ≪ h it is
/// p(ρ), with cΔt ≫ h a projection. The deviation from the hydrostatic gradient has no flux into walls. Sound does not bound
/// the step: Δt ≤ `courant` h/(|u| + √(|g|h)); sound faster than h/Δt is damped as by backward Euler.
///
/// Where a scene has a free surface, `[surface.cone-test]` finds the particles at it: the missing part of their
/// supports is at the pressure of their equation of state, between 0 and that of a row of water, ρ|g|δr. A scene with
/// `hu-adams` and a surface that it does not name is refused at the first step. Other forces than gravity and pressure
/// (friction, stresses, surface tension) are not in the prediction; pressure answers them through the density, one step
/// later. First order in time.
///
/// Source: after Kwatra et al. 2009 (semi-implicit compressible flow) and Cummins & Rudman 1999 (the one-ring sum); the form of
/// gravity at walls, the surfaces and the step ours.
///
/// ```toml
/// [pressure.implicit]
/// courant = 0.05
/// ```
#[plugin(PressureEntry [2, 3], "implicit", "pressure of the end of the step: steps longer than those of sound",
    source: "after Kwatra et al. 2009; Cummins & Rudman 1999")]
pub struct ImplicitPressure {
    /// C of Δt ≤ C h/(|u| + √(|g|h)).
    #[parameter(default: 0.05, unit: "1", above: 0.0, max: 1.0, source: "ours")]
    pub courant: f64,
    /// Relative residual at which the solve ends.
    #[parameter(default: 1e-5, unit: "1", above: 0.0, max: 0.1, source: "ours")]
    pub tolerance: f64,
}

impl<const D: usize> PressureScheme<D> for ImplicitPressure {
    fn stage(&self, acting: Acting<D>) -> Box<dyn Stage<World<D>>> {
        Box::new(SolvePressure::new(acting, Automatic::to(self.tolerance)))
    }
    fn limiters(&self, setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>> {
        let sound = sound_limit(setting.courant, setting.laws.clone());
        vec![Box::new(flow_limit(self.courant, sound))]
    }
}

/// Largest growth of a step over the one before, for which the pressure was solved.
const GROWTH: f64 = 1.1;

/// Δt ≤ C h/(|u|max + √(|g| h)), at the start that of sound and then a tenth more from step to step; √(|g| h) is the speed of the
/// shortest waves on a free surface.
fn flow_limit<const D: usize>(courant: f64, sound: impl Limiter<D>) -> impl Limiter<D> {
    let formula =
        format!("flow: dt <= {courant} h / (|u| + sqrt(|g| h)), and {GROWTH} times the last");
    let remedy = "a larger `pressure.implicit.courant` lengthens the step in proportion";
    bound("flow", formula, Some(remedy), move |world: &World<D>| {
        let velocity = world.free.get(fields::VELOCITY)?;
        let fastest = largest(velocity, |u| u.norm_squared()).sqrt();
        let h = world.kernel.smoothing_length();
        let flow = courant * h / (fastest + (world.gravity.norm() * h).sqrt());
        let longest = sound.limit(world)?.dt.max(GROWTH * world.dt);
        Ok(flow.min(longest))
    })
}
