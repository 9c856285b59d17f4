//! The step limit of pressure smoothers.

use sph_contribution::{Limiter, bound};
use sph_neighbours::{World, lattice_sum};
use sph_rheology::state::Laws;

/// Of λΔt: 1.45 for a chequerboard on a lattice, where it may be 2, and particles are not on one.
const STABLE: f64 = 1.25;

/// The speed of sound of the fastest phase at rest, m/s.
pub(crate) fn fastest(laws: &Laws) -> f64 {
    let speeds = laws.iter().map(|l| l.reference().sound_speed);
    speeds.fold(0.0, f64::max)
}

/// λΔt ≤ 1.25 with λ = 2 D Σ_b V |F_ab| on a lattice, 7/8 of the rate at which a chequerboard dies away under the diffusivity D = δ h c:
/// Δt ≤ 1.25/(2 δ h c ΣV|F|) with the fastest phase at rest.
///
/// ΣV|F| is 3.5/h² for Wendland C2. With Δt = 0.4 h/c it binds from δ = 0.45 on; without it δ = 1 blows a tank at
/// rest up. Ours.
pub(crate) fn diffusion_limit<const D: usize>(
    strength: f64,
    laws: &Laws,
) -> impl Limiter<D> + use<D> {
    let fastest = fastest(laws);
    let formula = format!("smoother: dt <= {STABLE} / (2 {strength} h c ΣV|F|)");
    let remedy = "a smaller `strength` of the smoother lengthens the step";
    bound(
        "smoother",
        formula,
        Some(remedy),
        move |world: &World<D>| {
            let sum = 2.0 * world.spacing.powi(D as i32) * lattice_sum(world, |pair| -pair.factor);
            Ok(STABLE / (strength * world.kernel.smoothing_length() * fastest * sum))
        },
    )
}
