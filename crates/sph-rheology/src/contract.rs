//! The trait of rheologies.

use sph_core::Symmetric;

/// The gradient of a velocity u, 1/s: its rows, of which the element j of row i is ∂u_i/∂x_j.
pub type Gradient = [[f64; 3]; 3];

/// The inputs a law reads; only those are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Magnitude of the deviatoric strain rate γ̇ = √(2 D:D), 1/s.
    pub strain_rate: bool,
    /// Pressure that makes friction, Pa: the effective pressure of a soil, where the scene
    /// computes one.
    pub pressure: bool,
}

/// The inputs of a batch; slices that the law does not need are empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct Inputs<'a> {
    /// Magnitude of the deviatoric strain rate, 1/s.
    pub strain_rate: &'a [f64],
    /// Pressure that makes friction, Pa; may be negative.
    pub pressure: &'a [f64],
}

impl Inputs<'_> {
    /// Strain rate and pressure of one entry; zero where not needed.
    pub(crate) fn at(&self, k: usize) -> (f64, f64) {
        let of = |column: &[f64]| column.get(k).copied().unwrap_or(0.0);
        (of(self.strain_rate), of(self.pressure))
    }
}

/// Factors of the two forces of a law with an elastic part, by yielding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yielding {
    /// Share of the viscous force in a blend: ζ, 1 for a law that does not blend.
    pub friction: f64,
    /// Share of the elastic force in a blend: 1 − ζ, 1 for a law that does not blend.
    pub solid: f64,
    /// min(1, τ_y/|τ|): what the yield stress leaves of a stress that was not cut.
    pub held: f64,
    /// True if the material is liquid and loses its memory.
    pub forgets: bool,
}

impl Yielding {
    /// A solid that never yields.
    pub const NONE: Yielding = Yielding {
        friction: 1.0,
        solid: 1.0,
        held: 1.0,
        forgets: false,
    };
}

/// A constitutive law: an effective viscosity η in τ = 2 η D, an elastic part, or both.
pub trait Rheology: Send + Sync + std::fmt::Debug {
    /// Inputs of the law.
    fn needs(&self) -> Needs;
    /// The viscosity if it is one number for all times and places, Pa s. Then no viscosity
    /// column is allocated.
    fn uniform_viscosity(&self) -> Option<f64>;
    /// Effective viscosity of a batch, Pa s: finite and not negative for every finite input.
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]);
    /// A bound of the viscosity for the time step, Pa s; infinite where there is none but that of
    /// the present state.
    fn largest_viscosity(&self) -> f64;
    /// The part of the law that remembers, if it has one.
    fn elastic(&self) -> Option<&dyn Elastic> {
        None
    }
    /// Diameter of the grains, m, for a law that depends on it: remarks on the spacing need it.
    fn grain_diameter(&self) -> Option<f64> {
        None
    }
}

/// The elastic part of a law: a deviatoric stress that follows the motion and may yield.
///
/// Stresses are positive in tension.
pub trait Elastic: Send + Sync {
    /// Shear modulus 𝒢, Pa; √(𝒢/ρ) bounds the step.
    fn shear_modulus(&self) -> f64;
    /// Advances the remembered stress of a batch over `dt` with the gradients of the velocity.
    fn advance(
        &self,
        inputs: &Inputs<'_>,
        gradient: &[Gradient],
        dt: f64,
        stress: &mut [Symmetric],
    );
    /// The stress that acts, from the remembered one: (1 − ζ)τ for a law that blends with a
    /// viscous part.
    fn carried(&self, inputs: &Inputs<'_>, stress: &[Symmetric], carried: &mut [Symmetric]);
    /// True if a viscous liquid takes the place of the solid where it yields.
    fn blends(&self) -> bool {
        false
    }
    /// True if its viscosity damps the solid too, which is known where stresses are blended.
    fn damps(&self) -> bool {
        false
    }
    /// Yielding of a batch, from a remembered stress that need not be cut.
    fn yielding(&self, _inputs: &Inputs<'_>, _stress: &[Symmetric], yielding: &mut [Yielding]) {
        yielding.fill(Yielding::NONE);
    }
    /// Viscosity of the liquid alone, Pa s, for a law that [`blends`](Elastic::blends): without the share ζ.
    fn liquid_viscosity(&self, _inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        viscosity.fill(0.0);
    }
}

#[cfg(feature = "plugins")]
sph_core::contract!(
    /// A rheology that a scene may name.
    pub RheologyEntry, "rheology", InPhase, "the constitutive law of a phase", Rheology
);
