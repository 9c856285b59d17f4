//! Limits of the step.

use rayon::prelude::*;

use crate::grains::GrainSystem;

impl GrainSystem {
    /// Largest step (s) for which the leap-frog is proven stable while nothing slides.
    ///
    /// Δt = 2 / √max_i (A_i + B_i), A and B the largest eigenvalues of K^x / m and K^r / J with
    ///
    /// ```text
    /// K^x = Σ_c w [k_n n nᵀ + k_t (1 − n nᵀ)],     K^r = Σ_c w (k_t l² + k_r) (1 − n nᵀ)
    /// ```
    ///
    /// over the contacts of a grain, l the arm, w = 1 at walls and 2 between bodies that both move:
    /// |a − b|² ≤ 2 |a|² + 2 |b|² bounds the elastic energy by a sum over grains. For a head-on pair and for a
    /// grain at a wall it is the exact 2/ω. Catalano 2012, Eqs. (2.13), (2.14), takes √(m/K) with the same sums;
    /// his Δt_cr is shorter for normal contact, but without the coupling of shift and spin. Dashpots multiply
    /// it by √(1 + ζ²) − ζ. Every grain counts as if it touched another of its size at least.
    pub fn critical_step(&self) -> f64 {
        self.critical().step
    }

    /// Step (s) in which no grain goes further than a share of its radius, under the forces of the last evaluation:
    /// |v| Δt + ½ |F/m + g| Δt² ≤ share · R. Contacts are looked for once per step, so a grain that goes further can
    /// pass through another or through a wall; stability alone does not forbid it where contacts are soft.
    pub fn motion_limit(&self, share: f64) -> f64 {
        let g = &self.grains;
        let forces = (&g.contact_force, &g.external_force);
        let columns = (&g.velocity, &g.mass, &g.radius, &g.held);
        let steps = (columns, forces).into_par_iter().map(|(columns, forces)| {
            let (velocity, &mass, &radius, &held) = columns;
            let force = if held {
                0.0
            } else {
                (forces.0 + forces.1 + self.gravity * mass).norm()
            };
            let (speed, acceleration) = (velocity.norm(), force / mass);
            // The root without a difference of large numbers, which is also that of no acceleration.
            let root = (speed * speed + 2.0 * acceleration * share * radius).sqrt();
            2.0 * share * radius / (speed + root)
        });
        steps.reduce(|| f64::INFINITY, f64::min)
    }
}
