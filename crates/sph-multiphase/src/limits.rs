//! The step limits of sound, viscosity and force.

use std::sync::Arc;

use rayon::prelude::*;
use sph_core::{StepError, StepLimit, fields};
use sph_neighbours::World;

use crate::BoundState;
use crate::lattice::lattice_sum;

/// A plugin's bound on the step at the present state.
pub trait Limiter<const D: usize>: Send + Sync {
    /// The bound with its name.
    ///
    /// # Errors
    /// If a column is missing.
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError>;
    /// The formula, for listings.
    fn formula(&self) -> String;
}

/// Δt ≤ C h / c with the largest local speed of sound, Ghaïtanellis 2017, Eq. 2.104.
pub struct SoundLimit {
    /// C.
    pub courant: f64,
    /// The equations of state, in the order of the phase numbers.
    pub laws: Arc<[Box<dyn BoundState>]>,
}

impl<const D: usize> Limiter<D> for SoundLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let density = world.free.get(fields::DENSITY)?;
        // Sound is fastest where density is highest, so one law call per phase is enough.
        let fastest = match &self.laws[..] {
            [law] => law.sound_speed(largest(density, |rho| *rho)),
            laws => {
                let phase = world.free.get(fields::PHASE)?;
                let fastest = |k: usize, law: &dyn BoundState| {
                    let pairs = density.iter().zip(phase);
                    let own = pairs.filter(|(_, p)| **p as usize == k);
                    law.sound_speed(own.map(|(rho, _)| *rho).fold(0.0, f64::max))
                };
                let each = laws.iter().enumerate();
                each.map(|(k, law)| fastest(k, &**law)).fold(0.0, f64::max)
            }
        };
        let h = world.kernel.smoothing_length();
        Ok(StepLimit::new("sound", self.courant * h / fastest))
    }
    fn formula(&self) -> String {
        format!("sound: dt <= {} h / c", self.courant)
    }
}

/// Δt ≤ h / (c_j √(λ ρ_j/ρ_i)) for a particle of phase i among those of a heavier phase j, with
/// λ = h² Σ_b V² (∂w/∂x)² on a lattice.
///
/// A displaced light particle changes the densities around it, and the pressures answer with the
/// stiffness ρ_j c_j² of the heavy phase: it swings with ω = c_j √(λ ρ_j/ρ_i)/h (to 1 %, test
/// `limits`). Half of ωΔt ≤ 2 is taken. Where ρc² is the same in all phases this never binds. Ours;
/// without it the air of a dam break with air is at 500 m/s after 2 ms.
pub struct InterfaceLimit {
    /// The equations of state, in the order of the phase numbers.
    pub laws: Arc<[Box<dyn BoundState>]>,
}

impl<const D: usize> Limiter<D> for InterfaceLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let references = || self.laws.iter().map(|law| law.reference());
        let lightest = references()
            .map(|r| r.density)
            .fold(f64::INFINITY, f64::min);
        let stiffest = references()
            .map(|r| r.density * r.sound_speed.powi(2))
            .fold(0.0, f64::max);
        let h = world.kernel.smoothing_length();
        let rate = (stiffest / lightest * lone_stiffness(world)).sqrt() / h;
        Ok(StepLimit::new("interface", 1.0 / rate))
    }
    fn formula(&self) -> String {
        "interface: dt <= h / sqrt(λ max(ρc²) / min(ρ))".into()
    }
}

/// λ = h² Σ_b V² (∂w/∂x)² on a lattice.
fn lone_stiffness<const D: usize>(world: &World<D>) -> f64 {
    let sum = lattice_sum(world, |pair| (pair.separation[0] * pair.factor).powi(2));
    sum * world.spacing.powi(2 * D as i32) * world.kernel.smoothing_length().powi(2)
}

/// Δt ≤ C ρ h² / η, Ghaïtanellis 2017, Eq. 2.106; where viscosities depend on the flow, with the
/// largest η/ρ of the present state.
pub struct ViscousLimit {
    /// C, already divided by the operator's stiffness.
    pub coefficient: f64,
    /// Largest η/ρ₀ that the laws allow, m²/s; may be infinite.
    pub largest: f64,
    /// Whether all viscosities are constant, so that it is the one of every state.
    pub constant: bool,
}

impl<const D: usize> Limiter<D> for ViscousLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let h = world.kernel.smoothing_length();
        let kinematic_viscosity = match self.constant {
            true => self.largest,
            false => {
                let viscosity = world.free.get(fields::VISCOSITY)?;
                let density = world.free.get(fields::DENSITY)?;
                let both = viscosity.par_iter().zip(density).with_min_len(1024);
                let present = both.map(|(eta, rho)| eta / rho).reduce(|| 0.0, f64::max);
                // Before the first evaluation nothing is known but what the laws allow.
                match present > 0.0 || self.largest.is_infinite() {
                    true => present,
                    false => self.largest,
                }
            }
        };
        let dt = self.coefficient * h * h / kinematic_viscosity;
        Ok(StepLimit::new("viscosity", dt))
    }
    fn formula(&self) -> String {
        format!("viscosity: dt <= {} h² / ν", self.coefficient)
    }
}

/// Δt ≤ C √(h / |a|) with the largest acceleration.
pub struct ForceLimit {
    /// C.
    pub coefficient: f64,
}

impl<const D: usize> Limiter<D> for ForceLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let acceleration = world.free.get(fields::ACCELERATION)?;
        let squared = largest(acceleration, |a| a.norm_squared());
        let h = world.kernel.smoothing_length();
        Ok(StepLimit::new(
            "force",
            self.coefficient * (h / squared.sqrt()).sqrt(),
        ))
    }
    fn formula(&self) -> String {
        format!("force: dt <= {} sqrt(h / |a|)", self.coefficient)
    }
}

/// The largest value of a column; a value that is not a number counts as infinite.
fn largest<T: Sync>(column: &[T], value: impl Fn(&T) -> f64 + Sync) -> f64 {
    let all = column.par_iter().with_min_len(1024).map(|x| {
        let v = value(x);
        if v.is_nan() { f64::INFINITY } else { v }
    });
    all.reduce(|| 0.0, f64::max)
}
