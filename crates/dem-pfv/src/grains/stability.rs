//! Limits of steps and overlaps, and the rest of grains.

use nalgebra::Matrix3;
use rayon::prelude::*;

use crate::error::DEEPEST;
use crate::grains::{Control, GrainError, GrainSystem, Limit, Partner, Slot, Unrest, Vector, Wall};

/// Overlap over radius from which the stiffness of the first touch is guessed.
const FIRST_TOUCH: f64 = 1e-3;

impl GrainSystem {
    /// The value of [`GrainSystem::critical_step`], and the grain that sets it.
    pub(crate) fn critical(&self) -> Limit {
        let (g, table) = (&self.grains, &self.table);
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
            let law = self.law_of(part);
            let wall = part.checked_sub(1).and_then(|k| self.walls.get(k));
            let piston = wall.map(Wall::mass).filter(|mass| mass.is_finite());
            let both_move = part == 0 || piston.is_some();
            let weight = if both_move { 2.0 } else { 1.0 };
            let mut stiffness_of_wall = 0.0;
            for slot in slots.iter().filter(|s| s.active) {
                let first = slot.first as usize;
                let second = (part == 0).then(|| g.radius[slot.second as usize]);
                let second = second.unwrap_or(f64::INFINITY);
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
            let force = match held {
                true => 0.0,
                false => (forces.0 + forces.1 + self.gravity * mass).norm(),
            };
            let (speed, acceleration) = (velocity.norm(), force / mass);
            // The root without a difference of large numbers, which is also that of no acceleration.
            let root = (speed * speed + 2.0 * acceleration * share * radius).sqrt();
            2.0 * share * radius / (speed + root)
        });
        steps.reduce(|| f64::INFINITY, f64::min)
    }

    /// The first contact that is deeper than a share of the smaller radius, with the number of its part of the table.
    fn deeper(&self, share: f64) -> Option<(usize, &Slot)> {
        let radius = &self.grains.radius;
        (0..self.table.ends.len()).find_map(|part| {
            let deep = |slot: &&Slot| {
                let mut smaller = radius[slot.first as usize];
                if part == 0 {
                    smaller = smaller.min(radius[slot.second as usize]);
                }
                slot.active && slot.overlap > share * smaller
            };
            let slots = self.table.slots[self.table.part(part)].par_iter();
            Some((part, slots.with_min_len(4096).find_first(deep)?))
        })
    }

    /// Refuses a step from contacts that are too deep.
    pub(crate) fn check_depths(&self) -> Result<(), GrainError> {
        let Some((part, slot)) = self.deeper(DEEPEST) else {
            return Ok(());
        };
        let grain = slot.first as usize;
        let (at, body) = (self.grains.position[grain].into(), self.partner(part, slot));
        let share = slot.overlap / self.grains.radius[grain];
        Err(GrainError::TooDeep(grain, at, body, slot.overlap, share))
    }

    pub(crate) fn check_overlaps(&mut self) -> Result<(), GrainError> {
        self.evaluate()?;
        let Some((part, slot)) = self.deeper(AT_START) else {
            return Ok(());
        };
        let (grain, overlap) = (slot.first as usize, slot.overlap);
        Err(match self.partner(part, slot) {
            Partner::Grain(second) => GrainError::Overlap(grain, second, overlap),
            Partner::Wall(wall) => {
                let distance = self.walls[wall].distance(&self.grains.position[grain]);
                GrainError::InWall(grain, wall, overlap, distance)
            }
            triangle => GrainError::InMesh(grain, triangle, overlap),
        })
    }

    /// The condition of rest that does not hold at the last evaluation; none for grains at rest to a `tolerance` below 1:
    ///
    /// ```text
    /// mean |F| ≤ tolerance · F_c,     |F_i| ≤ max(tolerance, 0.1) (m_i g + Σ_c |F_ic|) for every grain with a weight,
    /// |σ A − F| ≤ tolerance · |σ| A for every piston,     mean |v| + R |ω| ≤ tolerance · √(F_c R / m)
    /// ```
    ///
    /// with the resultant force F, the mean contact force F_c, the mean radius R and the mean mass m. Held grains do not
    /// count. A tolerance of 1 and more has no effect: the resultant force in free fall is the weight.
    ///
    /// # Errors
    /// A piston of unknown area.
    pub fn unrest(&self, tolerance: f64) -> Result<Option<Unrest>, GrainError> {
        if tolerance >= 1.0 {
            return Ok(None);
        }
        let (resultant, contact) = self.mean_forces();
        if resultant > tolerance * contact {
            return Ok(Some(Unrest::Unbalanced(self.unbalanced_force())));
        }
        let g = &self.grains;
        let free = || (0..g.len()).filter(|&i| !g.held[i]);
        let share = tolerance.max(CARRIED);
        let falls = |i: &usize| self.resultant(*i).norm() > share * self.acting(*i);
        let mut heavy = free().filter(|_| self.gravity != Vector::zeros());
        if let Some(grain) = heavy.find(falls) {
            return Ok(Some(Unrest::NotCarried(grain)));
        }
        for (number, wall) in self.walls.iter().enumerate() {
            if let Control::Piston { stress, .. } = wall.control {
                let load = stress * self.wall_area(number)?;
                if (load - wall.push()).abs() > tolerance * load.abs() {
                    return Ok(Some(Unrest::Piston(number)));
                }
            }
        }
        let speed = mean(free().map(|i| g.velocity[i].norm() + g.radius[i] * g.spin[i].norm()));
        let (radius, mass): (f64, f64) = (g.radius.iter().sum(), g.mass.iter().sum());
        let slow = speed <= tolerance * (contact * radius / mass).sqrt();
        Ok((!slow).then_some(Unrest::Moving(speed)))
    }

    /// Contact, external force and weight of a grain, N.
    fn resultant(&self, grain: usize) -> Vector {
        let g = &self.grains;
        g.contact_force[grain] + g.external_force[grain] + self.gravity * g.mass[grain]
    }

    /// Weight of a grain and sum of the sizes of its contact forces, N.
    fn acting(&self, grain: usize) -> f64 {
        let touching = self.table.slots_of(grain).filter(|(slot, _)| slot.active);
        let contacts: f64 = touching.map(|(slot, _)| slot.force.norm()).sum();
        contacts + self.gravity.norm() * self.grains.mass[grain]
    }

    /// Mean resultant force on a grain that is not held, and mean contact force, N; zero without contacts.
    pub(crate) fn mean_forces(&self) -> (f64, f64) {
        let g = &self.grains;
        let free = (0..g.len()).filter(|&i| !g.held[i]);
        let active = self.table.slots.iter().filter(|s| s.active);
        (
            mean(free.map(|i| self.resultant(i).norm())),
            mean(active.map(|slot| slot.force.norm())),
        )
    }

    /// Takes all motion away.
    pub(crate) fn stop(&mut self) {
        self.grains.velocity.fill(Vector::zeros());
        self.grains.spin.fill(Vector::zeros());
    }
}

/// Largest eigenvalue of a symmetric matrix.
fn largest(matrix: &Matrix3<f64>) -> f64 {
    if matrix.iter().all(|x| *x == 0.0) {
        return 0.0;
    }
    matrix.symmetric_eigenvalues().max()
}

/// Share of the smaller radius that an overlap may have at the start.
const AT_START: f64 = 0.1;

/// Resultant force of a carried grain at the most, over its weight and the contact forces on it.
const CARRIED: f64 = 0.1;

/// Mean of some numbers; zero without any.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_u32), |(s, n), x| (s + x, n + 1));
    sum / f64::from(count.max(1))
}
