//! The critical time step.

use nalgebra::Matrix3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{Control, GrainSystem};

/// Steps between two computations of the critical one.
pub(crate) const CHECKED_EVERY: u64 = 100;

/// A step and the grain that sets it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Limit {
    pub step: f64,
    pub grain: usize,
}

/// Overlap over radius from which the stiffness of the first touch is guessed.
const FIRST_TOUCH: f64 = 1e-3;

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
    #[must_use]
    pub fn critical_step(&self) -> f64 {
        self.find_limit().step
    }

    /// Step (s) in which no grain goes further than a share of its radius, under the forces of the last evaluation:
    /// |v| Δt + ½ |F/m + g| Δt² ≤ share · R. Contacts are looked for once per step, so a grain that goes further can
    /// pass through another or through a wall; stability alone does not forbid it where contacts are soft.
    #[must_use]
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

    pub(crate) fn find_limit(&self) -> Limit {
        let g = &self.grains;
        let zero = Matrix3::zeros();
        let mut sums = vec![[zero; 2]; g.len()];
        let mut damping = 0.0_f64;
        let mut highest = (0.0, 0);
        let mut raise = |rate: f64, grain: usize| {
            if rate > highest.0 {
                highest = (rate, grain);
            }
        };
        for part in 0..self.table.ends.len() {
            let slots = &self.table.slots[self.table.part(part)];
            let (mut law, mut weight, mut piston) = (0, 2.0, None);
            if part > self.walls.len() {
                (law, weight) = (self.meshes[part - 1 - self.walls.len()].law, 1.0);
            } else if part > 0 {
                let wall = &self.walls[part - 1];
                (law, weight) = (wall.law, 1.0);
                if let Control::Piston { mass, .. } = wall.control {
                    (weight, piston) = (2.0, Some(mass));
                }
            }
            let law = &self.laws[law];
            let mut stiffness_of_wall = 0.0;
            for slot in slots.iter().filter(|s| s.active) {
                let first = slot.first as usize;
                let second = if part == 0 {
                    g.radius[slot.second as usize]
                } else {
                    f64::INFINITY
                };
                let k = law.stiffness([g.radius[first], second], slot.overlap);
                damping = damping.max(k.damping);
                stiffness_of_wall += weight * k.normal;
                let along = slot.normal * slot.normal.transpose();
                let across = Matrix3::identity() - along;
                let push = (along * k.normal + across * k.tangential) * weight;
                let mut add = |grain: usize| {
                    let arm = g.radius[grain] - 0.5 * slot.overlap;
                    sums[grain][0] += push;
                    sums[grain][1] += across * (weight * (k.tangential * arm * arm + k.rolling));
                };
                add(first);
                if part == 0 {
                    add(slot.second as usize);
                }
            }
            if let (Some(mass), Some(slot)) = (piston, slots.iter().find(|s| s.active)) {
                raise(stiffness_of_wall / mass, slot.first as usize);
            }
        }
        for (grain, [push, turn]) in sums.iter().enumerate() {
            let (radius, mass) = (g.radius[grain], g.mass[grain]);
            let inertia = g.inertia(grain);
            let alone = self.laws[0].stiffness([radius; 2], FIRST_TOUCH * radius);
            damping = damping.max(alone.damping);
            let arm = alone.tangential * radius * radius + alone.rolling;
            raise(largest(push) / mass + largest(turn) / inertia, grain);
            // One touch: its normal and its shearing mode do not add.
            let normal = 2.0 * alone.normal / mass;
            let shear = 2.0 * alone.tangential / mass + 2.0 * arm / inertia;
            raise(normal.max(shear), grain);
        }
        let dashpots = (1.0 + damping * damping).sqrt() - damping;
        Limit {
            step: 2.0 / highest.0.sqrt() * dashpots,
            grain: highest.1,
        }
    }
}

/// Largest eigenvalue of a symmetric matrix.
fn largest(matrix: &Matrix3<f64>) -> f64 {
    if matrix.iter().all(|x| *x == 0.0) {
        return 0.0;
    }
    matrix.symmetric_eigenvalues().max()
}
