//! One sweep over some terms.

use sph_contribution::{Contribution, Offer, Setting};
use sph_core::Vect;
use sph_multiphase::diffusion::BrezziPitkaranta;
use sph_multiphase::viscosity::{Choice, Morris, OnLattice, Viscosity, ViscousOperator, WallTerm};
use sph_multiphase::{Formulation, HuAdams};
use sph_neighbours::{Interaction, Terms, World, interactions};
use sph_rheology::state::{EquationOfState, Laws, Linear, Reference};

/// Accelerations and the rate of the density constant.
pub fn rates<const D: usize>(world: &World<D>, terms: &Terms<D>) -> (Vec<Vect<D>>, Vec<f64>) {
    let n = world.free.len();
    let (mut acceleration, mut scalar) = (vec![Vect::zeros(); n], vec![0.0; n]);
    let swept = interactions(world, terms, &mut acceleration, Some(&mut scalar));
    swept.expect("all columns");
    (acceleration, scalar)
}

/// Accelerations by one term.
pub fn acceleration<const D: usize>(
    world: &World<D>,
    term: Box<dyn Interaction<D>>,
) -> Vec<Vect<D>> {
    rates(world, &vec![term]).0
}

pub fn pressure<const D: usize>() -> Box<dyn Interaction<D>> {
    HuAdams::default().pressure_term()
}

/// Morris's operator, not scaled on the lattice: the numbers of the theory are of this one.
pub fn viscosity<const D: usize>(eta: f64) -> Box<dyn Interaction<D>> {
    morris(WallTerm::Corrected, eta)
}

/// The same with a wall term.
pub fn morris<const D: usize>(wall_term: WallTerm, eta: f64) -> Box<dyn Interaction<D>> {
    let operator = Morris(Choice {
        wall_term,
        on_lattice: OnLattice::Literal,
        ..Choice::default()
    });
    operator.term(Viscosity::Uniform(eta))
}

pub fn viscosity_column<const D: usize>() -> Box<dyn Interaction<D>> {
    Morris::default().term(Viscosity::PerParticle)
}

pub fn smoother<const D: usize>(strength: f64) -> Box<dyn Interaction<D>> {
    Box::new(BrezziPitkaranta::with(strength).term(&laws(&[(1000.0, 20.0)])))
}

/// The offer of a plugin to a scene of two phases with these laws, whose densities are sums or not.
pub fn offered<const D: usize>(
    plugin: &mut dyn Contribution<D>,
    (laws, summed): (&Laws, bool),
    world: &World<D>,
) -> Offer<D> {
    let phases = ["heavy", "light"].map(String::from);
    let setting = Setting {
        laws,
        phases: &phases,
        bodies: &[],
        viscosities: &[None, None],
        soils: &[false, false],
        density: Formulation::<D>::diffused(&HuAdams::default()).evolved,
        summed,
        pressure_ahead: false,
        courant: 0.4,
        viscous: 0.125,
        delayed_yield: false,
        kicks_once: true,
        carried: false,
        moving_wall: None,
        world,
    };
    let mut offer = Offer::new("`plugin`".into());
    plugin.offer(&setting, &mut offer).expect("it fits");
    offer
}

/// Linear laws with these reference densities and speeds of sound.
pub fn laws(references: &[(f64, f64)]) -> Laws {
    let bind = |(density, sound_speed): &(f64, f64)| {
        Linear::default().bind(Reference {
            density: *density,
            sound_speed: *sound_speed,
        })
    };
    references.iter().map(bind).collect::<Vec<_>>().into()
}
