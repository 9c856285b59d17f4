//! Eddies that come in with the fluid, `values` of an open face.

use super::*;

/// Turbulence behind a grid: a uniform flow between an inlet with k and ε and an outlet, without friction on its walls.
const GRID: &str = include_str!("grid.toml");

/// U dk/dx = −ε and U dε/dx = −C₂ε²/k have k = k₀ s^(−n) and ε = ε₀ s^(−n−1), s = 1 + ε₀x/(n k₀ U), n = 1/(C₂ − 1).
///
/// The scheme has a particle for every spacing, which is born with k₀ and ε₀ within one spacing of the face: its k and ε are
/// those of a place at most so far away. Diffusion along the flow is ν_t/(UL) < 10⁻³ of it, which these bounds hold.
#[test]
fn turbulence_behind_a_grid_begins_as_given_and_decays_as_the_model_says() {
    let (k_0, e_0, u, spacing, last): (f64, f64, f64, f64, f64) = (0.01, 0.01, 1.0, 0.05, 2.0);
    let n = 1.0 / (1.92 - 1.0);
    let exact = |x: f64| {
        let s = (1.0 + e_0 * x.max(0.0) / (n * k_0 * u)).powf(-n);
        [k_0 * s, e_0 * s.powf((n + 1.0) / n)]
    };
    let state = finished(GRID, 1).state();
    let column = |name: &str| state.reals(name).into_iter();
    let place: Vec<f64> = column("position").step_by(2).collect();
    let found = column(TURBULENT_ENERGY.name).zip(column(DISSIPATION.name));
    let (mut first, mut worst) = (0, [0.0_f64; 2]);
    for (x, (k, e)) in place.iter().zip(found) {
        let (early, late) = (exact(x - spacing), exact(x + spacing));
        for (at, found) in [k, e].into_iter().enumerate() {
            let off = (found / exact(*x)[at] - 1.0).abs();
            worst[at] = worst[at].max(off);
            let between = late[at] <= found && found <= early[at];
            assert!(between, "at {x} m: {found}, not {}", exact(*x)[at]);
        }
        first += usize::from(*x < spacing);
    }
    println!("{} particles, k and ε off by {worst:?}", place.len());
    assert!(first >= 5, "{first} particles at the inlet");
    let far = place.iter().fold(0.0, |far: f64, x| far.max(*x));
    assert!(far > last - spacing, "the last particle is at {far} m");
}
