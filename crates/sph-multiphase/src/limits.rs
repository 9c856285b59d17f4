//! The step limits of sound, viscosity and force.

use std::sync::{Arc, OnceLock};

use rayon::prelude::*;
use sph_core::{StepError, StepLimit, fields};
use sph_neighbours::World;

use crate::lattice::lattice_sum;
use crate::{BoundState, Reference};

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

/// Δt ≤ 1/ω, ω² = S² max_φ (Σ_k φ_k ρ_k c_k²)(Σ_k φ_k/ρ_k), over the mixtures φ of two phases, with
/// S = max_k Σ_b V |∂w/∂x sin(kx)| on a lattice.
///
/// In a mixture every particle sees the displacements of all, with the stiffness of the mean and the
/// inertia of the light ones: half air and half water of the same speed of sound c swing with
/// ½ S c √(ρ_j/ρ_i), a lone particle of air in water with 0.6 of that. Half of ωΔt ≤ 2 is taken: drops
/// are denser than lattices, and friction takes a share of the 2. Where the largest is in one phase
/// alone, [`SoundLimit`] knows it; where ρc² is the same in all phases this never binds. Ours; with a
/// step twice as long, air around drops of water in a dam break swings with 100 m/s and more.
#[derive(Debug)]
pub struct InterfaceLimit {
    /// c, m/s.
    sound: f64,
    /// S, 1/m: lattice and kernel stay.
    wave: OnceLock<f64>,
}

impl InterfaceLimit {
    /// With the equations of state of the phases; none if no mixture of two of them is faster than both.
    pub fn of(laws: &[Box<dyn BoundState>]) -> Option<Self> {
        let each = || laws.iter().map(|law| law.reference());
        let pairs = each().flat_map(|a| each().map(move |b| mixed_sound(a, b)));
        let squared = pairs.fold(0.0, f64::max);
        (squared > 0.0).then(|| InterfaceLimit {
            sound: squared.sqrt(),
            wave: OnceLock::new(),
        })
    }
}

impl<const D: usize> Limiter<D> for InterfaceLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let wave = self.wave.get_or_init(|| shortest_wave(world));
        Ok(StepLimit::new("interface", 1.0 / (wave * self.sound)))
    }
    fn formula(&self) -> String {
        "interface: dt <= 1 / (S c), c the fastest sound in a mixture of two phases".into()
    }
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
fn shortest_wave<const D: usize>(world: &World<D>) -> f64 {
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
