//! The trait of viscous operators, their friction as a matrix, the step that it allows, and viscosities of eddies.

use nalgebra::SMatrix;
use rayon::prelude::*;
use sph_contribution::{Contribution, Limiter, Stages, bound, contribution_kind};
use sph_core::{Access, StepError, Vect, Work, contract, fields};
use sph_neighbours::{Cluster, Interaction, Kinds, Neighbourhood, World};

/// Source of the viscosity for a viscous operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viscosity {
    /// One number for all particles, Pa s; no column exists.
    Uniform(f64),
    /// The viscosity column; one phase.
    PerParticle,
    /// The viscosity column; several phases.
    PerPhase,
}

/// A second-order operator for the viscous force.
pub trait ViscousOperator<const D: usize>: Send {
    /// The viscous term of the interaction sweep.
    fn term(&self, viscosity: Viscosity) -> Box<dyn Interaction<D>>;
    /// Columns of all particles that the term needs before the sweep.
    fn stages(&self, _viscosity: Viscosity) -> Stages<D> {
        Vec::new()
    }
    /// The same friction as rows of a matrix, for implicit schemes.
    fn coupling(&self, viscosity: Viscosity) -> Box<dyn Coupling<D>>;
    /// Stiffness over that of Morris's operator: divides the viscous step limit.
    fn stiffness(&self) -> f64;
    /// True if it is zero in rigid rotation, at free surfaces too.
    fn leaves_rotations(&self) -> bool {
        false
    }
}

contract!(
    /// A viscous operator that a scene may name.
    pub ViscousOperatorEntry, "viscous-operator", One, "the discrete div(η grad u) and its kin", ViscousOperator<D>,
    .by_default("morris").ordered(40).works(Work::Friction)
);

contribution_kind!(
    /// A turbulence model that acts as a viscosity η_t beside that of the laws: τ = 2 (η + η_t) D. Those of this project are in
    /// `sph-turbulence`.
    ///
    /// It offers a stage that writes [`EDDY_VISCOSITY`](sph_core::fields::EDDY_VISCOSITY), Pa s. The stage may read the
    /// velocity gradient and the strain rate, whether or not a law needs them, and writes zero where there is no turbulence, as
    /// within a soil. An implicit step takes η_t of its beginning.
    pub EddyViscosityEntry, "eddy-viscosity", One, "viscosity of eddies that particles do not resolve",
    .ordered(50).works(Work::Friction)
);

/// A friction that is linear in the velocities: m_a γ_a a_a = −Σ_b C_ab (u_a − u_b) − W_a u_a + s_a with C_ab = C_baᵀ.
pub trait Coupling<const D: usize>: Send + Sync {
    /// Columns read.
    fn access(&self) -> Access;
    /// True if C and W mix the components of the velocity.
    fn mixes_components(&self) -> bool;
    /// Lends the coupling with its columns to `with`, once.
    ///
    /// # Errors
    /// If a column is missing, and those of `with`.
    fn with_columns(
        &self,
        world: &World<D>,
        with: &mut WithCoupling<'_, D>,
    ) -> Result<(), StepError>;
}

/// Work with a coupling that has its columns.
pub type WithCoupling<'w, const D: usize> =
    dyn FnMut(&dyn BoundCoupling<D>) -> Result<(), StepError> + 'w;

/// Wall terms of a particle.
#[derive(Clone, Copy, Debug)]
pub struct CouplingRow<W, const D: usize> {
    /// W_a, N s/m.
    pub wall: W,
    /// s_a, N: from the velocities of walls.
    pub source: Vect<D>,
}

/// A [`Coupling`] with its columns. Since the separation is the only direction, C_ab = α 1 + β r rᵀ.
pub trait BoundCoupling<const D: usize>: Sync {
    /// Parts of α and β that are not zero everywhere.
    fn kinds(&self) -> Kinds;

    /// α (N s/m), β (N s/m³) and their norm |α| + |β| r² for every candidate of a cluster, one number per lane each;
    /// exactly zero beyond the support.
    fn strengths(&self, cluster: &Cluster<'_, D>, out: &mut Vec<f64>);

    /// True if [`walls`](Self::scalar_walls) reads the free neighbours of a particle.
    fn walls_need_neighbours(&self, particle: usize) -> bool;

    /// W and s of walls, for couplings that do not mix components.
    ///
    /// At a wall the normal part of the velocity is that of the present state.
    fn scalar_walls(&self, rows: &Neighbourhood<'_, D>) -> CouplingRow<f64, D>;

    /// W and s of walls.
    fn block_walls(&self, rows: &Neighbourhood<'_, D>) -> CouplingRow<SMatrix<f64, D, D>, D>;
}

/// Δt ≤ C ρ h² / η, Ghaïtanellis 2017, Eq. 2.106; where viscosities depend on the flow, with the
/// largest η/ρ of the present state.
///
/// C is already divided by the operator's stiffness. `largest` is the largest η/ρ₀ that the laws allow, m²/s; it may be infinite.
/// If all viscosities are `constant` it is the one of every state.
pub fn viscous_limit<const D: usize>(
    coefficient: f64,
    largest: f64,
    constant: bool,
) -> impl Limiter<D> {
    let formula = format!("viscosity: dt <= {coefficient} h² / ν");
    let remedy = "treating the viscosity implicitly (`[implicit-viscosity.backward-euler]`) takes this bound away";
    let dt = move |world: &World<D>| {
        let h = world.kernel.smoothing_length();
        let mut kinematic_viscosity = largest;
        if !constant {
            let (viscosity, density) = world.free.all((fields::VISCOSITY, fields::DENSITY))?;
            let both = viscosity.par_iter().zip(density).with_min_len(1024);
            let present = both.map(|(eta, rho)| eta / rho).reduce(|| 0.0, f64::max);
            // Before the first evaluation the bounds of the laws alone are known.
            if present > 0.0 || largest.is_infinite() {
                kinematic_viscosity = present;
            }
        }
        Ok(coefficient * h * h / kinematic_viscosity)
    };
    bound("viscosity", formula, Some(remedy), dt)
}
