//! Keys of all operators that are sums over pairs.

use sph_core::{Vect, parameters};
use sph_neighbours::{Interaction, Pair, World};

use sph_contribution::Stages;
use sph_neighbours::{lattice_sum, rows_sum};

use super::{PairFriction, ViscousTerm};
use crate::viscosity::interface_distance::interface_distance;
use crate::viscosity::{Coupling, Viscosity, ViscositySource, ViscousOperator, Within};

/// Friction at semi-analytical walls.
#[parameters]
pub enum WallTerm {
    /// Exact for linear velocities.
    #[default]
    Corrected,
    /// As printed: first order.
    Literal,
}

/// Viscosity of pairs of two phases.
#[parameters]
pub enum Across {
    /// Two layers in series, by the distances from the interface.
    #[default]
    Series,
    /// The harmonic mean, as printed: first order.
    Harmonic,
}

/// The response of an operator to a sheared layer along the axes of a lattice.
#[parameters]
pub enum OnLattice {
    /// Scaled to be exact, so that errors fall with the spacing.
    #[default]
    Exact,
    /// Scaled to be exact in the mean over all places of rows that slide past each other: for sheared layers in which rows stay rows.
    Rows,
    /// As the sum is: less by a number of h/δr, 0.08 % (Morris) to 4 % (central forces) at 2.
    Literal,
}

impl OnLattice {
    /// Factor of an operator.
    pub fn scale<const D: usize, F: PairFriction<D>>(self, friction: F, world: &World<D>) -> f64 {
        let response = match self {
            OnLattice::Exact => lattice_sum(world, |pair| shear(friction, world, pair)),
            OnLattice::Rows => rows_sum(world, |pair| shear(friction, world, pair)),
            OnLattice::Literal => return 1.0,
        };
        match response > 0.0 {
            true => 1.0 / response,
            // A support smaller than the spacing: there is nothing to scale.
            false => 1.0,
        }
    }
}

/// The sum of a lattice with the scene's spacing and kernel gives for u = (y², 0, …), over the exact sum 2.
fn shear<const D: usize, F: PairFriction<D>>(friction: F, world: &World<D>, pair: &Pair<D>) -> f64 {
    let cell = world.spacing.powi(D as i32);
    let mut relative = Vect::zeros();
    relative[0] = -pair.separation[1] * pair.separation[1];
    0.5 * friction.force(cell, cell, &relative, pair)[0]
}

/// Keys of all operators that are sums over pairs.
#[parameters]
#[derive(Copy)]
pub struct Choice {
    /// Friction at walls.
    #[parameter(default, source: "Ghaïtanellis 2017, Eq. 2.83–2.89")]
    pub wall_term: WallTerm,
    /// Scale of the operator on a lattice.
    #[parameter(default, source: "ours; literal: as printed")]
    pub on_lattice: OnLattice,
    /// Viscosity of pairs of two phases.
    #[parameter(default, source: "ours; harmonic: Ghaïtanellis 2017, Eq. 3.30")]
    pub across: Across,
    /// Viscosity of pairs of one phase.
    #[parameter(default, source: "ours; harmonic: Ghaïtanellis 2017, Eq. 3.30")]
    pub within: Within,
}

impl<const D: usize, F: PairFriction<D>> ViscousOperator<D> for F {
    fn term(&self, viscosity: Viscosity) -> Box<dyn Interaction<D>> {
        Box::new(ViscousTerm(*self, self.choice().source(viscosity)))
    }
    fn coupling(&self, viscosity: Viscosity) -> Box<dyn Coupling<D>> {
        Box::new(ViscousTerm(*self, self.choice().source(viscosity)))
    }
    fn stages(&self, viscosity: Viscosity) -> Stages<D> {
        match self.choice().source(viscosity) {
            ViscositySource::InSeries(_) => vec![Box::new(interface_distance())],
            _ => Vec::new(),
        }
    }
    fn stiffness(&self) -> f64 {
        F::STIFFNESS
    }
    fn leaves_rotations(&self) -> bool {
        F::LEAVES_ROTATIONS
    }
}

impl Choice {
    fn source(self, viscosity: Viscosity) -> ViscositySource {
        match (viscosity, self.across) {
            (Viscosity::Uniform(eta), _) => ViscositySource::Uniform(eta),
            (Viscosity::PerPhase, Across::Series) => ViscositySource::InSeries(self.within),
            _ => ViscositySource::PerParticle(self.within),
        }
    }
}
