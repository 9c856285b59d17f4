//! The step that waves between phases allow.

use std::sync::OnceLock;

use sph_contribution::{Limiter, bound};
use sph_neighbours::{World, lattice_sum};
use sph_rheology::state::{BoundState, Reference};

/// Δt ≤ 1/ω, ω² = S² max_φ (Σ_k φ_k ρ_k c_k²)(Σ_k φ_k/ρ_k), over the mixtures φ of two phases, with
/// S = max_k Σ_b V |∂w/∂x sin(kx)| on a lattice.
///
/// In a mixture every particle sees the displacements of all, with the stiffness of the mean and the
/// inertia of the light ones: half air and half water of the same speed of sound c swing with
/// ½ S c √(ρ_j/ρ_i), a lone particle of air in water with 0.6 of that. Half of ωΔt ≤ 2 is taken: drops
/// are denser than lattices, and friction takes a share of the 2. Where the largest is in one phase
/// alone, the limit of the speed of sound has it; where ρc² is the same in all phases this never binds. Ours; with a
/// step twice as long, air around drops of water in a dam break swings with 100 m/s and more.
///
/// None if no mixture of two phases is faster than both.
pub fn interface_limit<const D: usize>(
    laws: &[Box<dyn BoundState>],
) -> Option<impl Limiter<D> + use<D>> {
    let each = || laws.iter().map(|law| law.reference());
    let pairs = each().flat_map(|a| each().map(move |b| mixed_sound(a, b)));
    let squared = pairs.fold(0.0, f64::max);
    let formula = "interface: dt <= 1 / (S c), c the fastest sound in a mixture of two phases";
    let remedy = "`numerics.reference_pressure = \"equal\"` makes all phases equally compressible and takes this bound \
                  away";
    // Lattice and kernel stay.
    let wave = OnceLock::new();
    let dt = move |world: &World<D>| {
        let wave = wave.get_or_init(|| shortest_wave(world));
        Ok(1.0 / (wave * squared.sqrt()))
    };
    (squared > 0.0).then(|| bound("interface", formula, Some(remedy), dt))
}

/// The largest (Σφρc²)(Σφ/ρ) between the ends of φ, m²/s²; nothing if it is at an end.
fn mixed_sound(one: Reference, other: Reference) -> f64 {
    let stiffness = |r: Reference| r.density * r.sound_speed.powi(2);
    let (stiff, light) = (stiffness(one), 1.0 / one.density);
    let stiffer = stiffness(other) - stiff;
    let lighter = 1.0 / other.density - light;
    let share = -0.5 * (stiff / stiffer + light / lighter);
    match stiffer * lighter < 0.0 && share > 0.0 && share < 1.0 {
        true => (stiff + share * stiffer) * (light + share * lighter),
        false => 0.0,
    }
}

/// Wave numbers that are tried, up to one wave over two spacings.
const WAVES: usize = 64;

/// S = max_k Σ_b V |∂w/∂x sin(kx)| for waves along a row of the lattice, 1/m.
pub(crate) fn shortest_wave<const D: usize>(world: &World<D>) -> f64 {
    let volume = world.spacing.powi(D as i32);
    let response = |n: usize| {
        let wave = std::f64::consts::PI * n as f64 / (WAVES as f64 * world.spacing);
        let sum = lattice_sum(world, |pair| {
            let x = pair.separation[0];
            -x * pair.factor * (wave * x).sin()
        });
        volume * sum
    };
    (1..=WAVES).map(response).fold(0.0, f64::max)
}
