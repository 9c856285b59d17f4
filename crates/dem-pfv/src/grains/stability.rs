//! The critical time step.

use nalgebra::Matrix3;

use crate::grains::state::Limit;
use crate::grains::{Control, GrainSystem};

/// Overlap over radius from which the stiffness of the first touch is guessed.
const FIRST_TOUCH: f64 = 1e-3;

impl GrainSystem {
    /// The value of [`GrainSystem::critical_step`], and the grain that sets it.
    pub(crate) fn critical(&self) -> Limit {
        let Self { state, laws } = self;
        let (g, table, walls) = (&state.grains, &state.table, &state.walls);
        let zero = Matrix3::zeros();
        let mut sums = vec![[zero; 2]; g.len()];
        let mut damping = 0.0_f64;
        let mut highest = (0.0, 0);
        let mut raise = |rate: f64, grain: usize| {
            if rate > highest.0 {
                highest = (rate, grain);
            }
        };
        for part in 0..table.ends.len() {
            let slots = &table.slots[table.part(part)];
            let (mut law, mut weight, mut piston) = (0, 2.0, None);
            if part > walls.len() {
                (law, weight) = (state.meshes[part - 1 - walls.len()].law, 1.0);
            } else if part > 0 {
                let wall = &walls[part - 1];
                (law, weight) = (wall.law, 1.0);
                if let Control::Piston { mass, .. } = wall.control {
                    (weight, piston) = (2.0, Some(mass));
                }
            }
            let law = &laws[law];
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
            let alone = laws[0].stiffness([radius; 2], FIRST_TOUCH * radius);
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
