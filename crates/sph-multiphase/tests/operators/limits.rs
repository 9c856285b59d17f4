//! The step limit of a light particle among heavy ones.

use sph_core::{Vect, fields};
use sph_multiphase::{
    EquationOfState, Formulation, HuAdams, InterfaceLimit, Limiter, Linear, Reference,
};

use crate::evaluate::{acceleration, pressure};
use crate::world::{at, lattice, periodic, set, world};

const LIGHT: f64 = 1.0 / 842.0;
const SOUND: f64 = 10.0;

/// A light particle is displaced by 1e-4 δr: its acceleration gives ω² = −a/x, and the limit is 1/ω.
#[test]
fn a_light_particle_swings_with_one_over_the_limit_to_1_per_cent() {
    let n = 20;
    let mut water = world(lattice::<2>(n), periodic(), 1.0 / n as f64, 2.0);
    let cell = (n as f64).powi(-2);
    let middle = at(&water, Vect::repeat(0.5));
    let place = water.free.get(fields::POSITION).unwrap()[middle];
    let density = |x: &Vect<2>| if *x == place { LIGHT } else { 1.0 };
    set(&mut water, fields::DENSITY, density);
    set(&mut water, fields::MASS, |x| density(x) * cell);
    HuAdams::default().rebase(&mut water).unwrap();
    let moved = 1e-4 / n as f64;
    water.free.get_mut(fields::POSITION).unwrap()[middle][0] += moved;
    Formulation::<2>::stages(&HuAdams::default())[0]
        .run(&mut water)
        .unwrap();
    // p = c²(ρ − ρ₀), in both phases with the sound of the water.
    let rho = water.free.get(fields::DENSITY).unwrap().to_vec();
    let rest = |i: usize| if i == middle { LIGHT } else { 1.0 };
    let p = rho.iter().enumerate();
    let p = p.map(|(i, rho)| SOUND * SOUND * (rho - rest(i))).collect();
    *water.free.get_mut(fields::PRESSURE).unwrap() = p;
    let pull = acceleration(&water, pressure())[middle][0];
    let swing = (-pull / moved).sqrt();

    let law = |density: f64| {
        Linear::default().bind(Reference {
            density,
            sound_speed: SOUND,
        })
    };
    let limit = InterfaceLimit {
        laws: vec![law(1.0), law(LIGHT)].into(),
    };
    let limit = Limiter::<2>::limit(&limit, &water).unwrap().dt;
    assert!(
        (swing * limit - 1.0).abs() < 0.01,
        "ω = {swing:.1}/s, limit {limit:.3e} s: ωΔt = {:.4}",
        swing * limit
    );
}
