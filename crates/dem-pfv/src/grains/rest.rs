//! Rest of grains: in balance, carried, slow.

use crate::grains::wall::Control;
use crate::grains::{GrainError, GrainSystem, Unrest, Vector};

/// Resultant force of a carried grain at the most, over its weight and the contact forces on it.
const CARRIED: f64 = 0.1;

impl GrainSystem {
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

/// Mean of some numbers; zero without any.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_u32), |(s, n), x| (s + x, n + 1));
    sum / f64::from(count.max(1))
}
