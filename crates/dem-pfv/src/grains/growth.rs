//! Samples that are grown or left to settle.

use crate::grains::{GrainError, GrainSystem, Unrest};
use crate::require;

/// End of the growth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// At an isotropic stress, Pa, positive in compression.
    Stress(f64),
    /// At a porosity of the box.
    Porosity(f64),
}

/// Internal compaction: radii grow between fixed walls until a stress or a porosity is reached.
///
/// Every ten steps all radii are multiplied by 1 + (1 − σ_m/σ₀) (m − 1), σ_m the mean stress of the walls, where m is
/// `fast` until σ₀ was first exceeded and `slow` from then on; to a porosity they grow by `fast` alone and
/// stop there. Walls without friction and some damping are the custom. Source: the triaxial controller of YADE;
/// the method is named by Catalano 2012, ch. 2, without equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// End of the growth.
    pub target: Target,
    /// Largest factor before the target was reached for the first time.
    pub fast: f64,
    /// Largest factor afterwards.
    pub slow: f64,
    /// Share of the critical step.
    pub safety: f64,
    /// Unbalanced force ratio, and relative distance from the stress, at which it ends.
    pub tolerance: f64,
    /// Largest number of steps.
    pub most_steps: u64,
}

/// Steps between two changes of the radii.
const EVERY: u64 = 10;

impl Growth {
    /// The custom: m_fast = 1 + 2·10⁴ Pa/E, m_slow = 1 + 2·10³ Pa/E with the micro modulus E in Pa.
    pub fn new(target: Target, modulus: f64) -> Self {
        Self {
            target,
            fast: 1.0 + 2e4 / modulus,
            slow: 1.0 + 2e3 / modulus,
            safety: 0.5,
            tolerance: 1e-3,
            most_steps: 1_000_000,
        }
    }

    /// Grows the grains of a system in its box; returns the number of steps.
    ///
    /// # Errors
    /// A box that is not closed; a target out of range; [`GrainError::NotReached`]; the refusals of a step.
    pub fn run(&self, system: &mut GrainSystem) -> Result<u64, GrainError> {
        let (what, value, fine) = match self.target {
            Target::Stress(stress) => ("the stress is", stress, stress > 0.0),
            Target::Porosity(n) => ("the porosity is", n, n > 0.0 && n < 1.0),
        };
        require(what, value, "positive, a porosity below 1", fine)?;
        let mut reached = false;
        let (mut unbalanced, mut stress) = (f64::INFINITY, 0.0);
        for made in 0..self.most_steps {
            system.evaluate()?;
            if made % EVERY == 0 {
                unbalanced = system.unbalanced_force();
                stress = system.mean_stress()?;
                let still = unbalanced < self.tolerance;
                let factor = match self.target {
                    Target::Stress(goal) => {
                        reached |= stress >= goal;
                        if still && (stress / goal - 1.0).abs() < self.tolerance {
                            return Ok(made);
                        }
                        let most = if reached { self.slow } else { self.fast };
                        1.0 + (1.0 - stress / goal) * (most - 1.0)
                    }
                    Target::Porosity(goal) => {
                        let (volume, solid) = (system.box_volume(), system.grains.volume());
                        let volume = volume.ok_or(GrainError::NoArea(0))?;
                        let left = ((1.0 - goal) * volume / solid).cbrt();
                        if left <= 1.0 && still {
                            return Ok(made);
                        }
                        left.min(self.fast).max(1.0)
                    }
                };
                // A factor near zero or below would come from a stress far above the target.
                if factor != 1.0 {
                    system.scale_radii(factor.max(0.99))?;
                }
            }
            let step = self.safety * system.current_limit();
            system.integrate(step)?;
        }
        Err(GrainError::NotReached(self.most_steps, unbalanced, stress))
    }
}

/// Steps at a share `safety` of the critical step until the grains are at rest to a `tolerance`
/// ([`GrainSystem::unrest`]); returns the number of steps. Motion that is left while all forces are in balance, as that
/// of grains that roll over a floor, is taken away.
///
/// # Errors
/// [`GrainError::NotSettled`] after `most_steps`; the refusals of a step.
pub fn step_to_rest(
    system: &mut GrainSystem,
    safety: f64,
    tolerance: f64,
    most_steps: u64,
) -> Result<u64, GrainError> {
    let mut last = Unrest::Unbalanced(f64::INFINITY);
    for made in 0..most_steps {
        system.evaluate()?;
        if made % EVERY == 0 {
            match system.unrest(tolerance)? {
                None => return Ok(made),
                Some(unrest) => last = unrest,
            }
            if let Unrest::Moving(_) = last {
                system.stop();
            }
        }
        let step = safety * system.current_limit();
        system.integrate(step)?;
    }
    Err(GrainError::NotSettled(most_steps, last))
}
