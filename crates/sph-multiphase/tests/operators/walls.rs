//! The operators next to a flat semi-analytical wall, rows 1 to 4 of a lattice with h/δr = 2.

use sph_core::{Vect, fields};
use sph_multiphase::viscosity::{KrimiViscosity, Strength, Viscosity, ViscousOperator, WallTerm};
use sph_neighbours::Interaction;

use crate::channel::Channel;
use crate::evaluate::{acceleration, morris, pressure, viscosity};
use crate::friction::all;
use crate::world::{at, set, set_velocity};

/// The printed digits, half a unit of the last one.
fn rows_are(values: [f64; 4], printed: [f64; 4], what: &str) {
    for (k, (value, printed)) in values.into_iter().zip(printed).enumerate() {
        let row = k + 1;
        assert!(
            (value - printed).abs() <= 0.5000001e-4,
            "{what}, row {row}: {value:.6} is not {printed}"
        );
    }
}

/// Component `axis` of the acceleration at rows 1 to 4.
fn at_rows(channel: &Channel, acceleration: &[Vect<2>], axis: usize) -> [f64; 4] {
    [1, 2, 3, 4].map(|k| {
        let place = Vect::<2>::new(4.0, 0.5 * f64::from(k));
        acceleration[at(&channel.world, place)][axis]
    })
}

fn viscous_response(term: Box<dyn Interaction<2>>, profile: fn(f64) -> f64) -> [f64; 4] {
    let mut channel = Channel::open(10);
    set_velocity(&mut channel.world, |x| Vect::<2>::new(profile(x[1]), 0.0));
    at_rows(&channel, &acceleration(&channel.world, term), 0)
}

#[test]
fn literal_morris_of_y_and_of_y_squared_is_as_printed() {
    let response =
        |profile: fn(f64) -> f64| viscous_response(morris(WallTerm::Literal, 1.0), profile);
    rows_are(response(|y| y), [-0.0070, 0.0465, 0.0194, 0.0], "u = y");
    let square = response(|y| y * y);
    rows_are(square, [2.0373, 2.0649, 2.0292, 1.9984], "u = y²");
}

#[test]
fn corrected_morris_of_y_is_nothing_and_of_y_squared_within_2_percent() {
    let linear = viscous_response(viscosity(1.0), |y| y);
    assert!(linear.iter().all(|a| a.abs() < 1e-13), "{linear:?}");
    let square = viscous_response(viscosity(1.0), |y| y * y);
    rows_are(square, [2.0408, 2.0184, 2.0001, 1.9984], "u = y²");
}

/// Whatever the pair formula, its strength and the volumes of the wall: κ makes up for it.
#[test]
fn every_corrected_operator_gives_nothing_for_y() {
    let literal = KrimiViscosity {
        strength: Strength::Literal,
        ..KrimiViscosity::default()
    };
    let literal: Box<dyn ViscousOperator<2>> = Box::new(literal);
    let all = all().into_iter();
    for (name, operator) in all.chain([("krimi, literal strength", literal)]) {
        for swelling in [1.0, 1.3] {
            let mut channel = Channel::open(10);
            let walls = &mut channel.world.walls;
            let volumes = [&mut walls.points.volume, &mut walls.elements.volume];
            let volumes = volumes.into_iter().flatten();
            volumes.for_each(|v| *v *= swelling);
            set_velocity(&mut channel.world, |x| Vect::<2>::new(x[1], 0.0));
            let term = operator.term(Viscosity::Uniform(1.0));
            let linear = at_rows(&channel, &acceleration(&channel.world, term), 0);
            // ν u'/δr is 2; what is left is rounding.
            assert!(
                linear.iter().all(|a| a.abs() < 1e-12),
                "{name}, wall volumes times {swelling}: {linear:?}"
            );
        }
    }
}

#[test]
fn the_gradient_of_1_plus_03_y_is_02986_03562_03238_02998() {
    let mut channel = Channel::open(10);
    set(&mut channel.world, fields::PRESSURE, |x| 1.0 + 0.3 * x[1]);
    let walls = &mut channel.world.walls;
    walls.points.pressure.fill(1.0);
    walls.elements.pressure.fill(1.0);
    walls.update_contacts();
    let force = acceleration(&channel.world, pressure());
    // Density 1: the acceleration is −∇p.
    let gradient = at_rows(&channel, &force, 1).map(|a| -a);
    rows_are(gradient, [0.2986, 0.3562, 0.3238, 0.2998], "p = 1 + 0.3 y");
}

/// The element term of viscosity is half of the wall's friction: without it row 1 is far off.
#[test]
fn without_the_element_term_the_first_row_would_be_half_a_unit_off() {
    let mut channel = Channel::open(10);
    channel.world.walls.contacts = Default::default();
    set_velocity(&mut channel.world, |x| Vect::<2>::new(x[1], 0.0));
    let force = acceleration(&channel.world, viscosity(1.0));
    let first = at_rows(&channel, &force, 0)[0];
    assert!(first.abs() > 0.5, "{first}");
}

#[test]
fn a_wall_that_slips_freely_gives_no_friction_at_all() {
    let mut channel = Channel::open(10);
    channel.world.walls.points.friction_factor.fill(0.0);
    channel.world.walls.elements.friction_factor.fill(0.0);
    set_velocity(&mut channel.world, |_| Vect::<2>::new(3.0, 0.0));
    let force = acceleration(&channel.world, viscosity(1.0));
    assert!(force.iter().all(|a| *a == Vect::<2>::zeros()));
    // The same wall with grip brakes the first row and leaves the fifth alone.
    let mut rough = Channel::open(10);
    set_velocity(&mut rough.world, |_| Vect::<2>::new(3.0, 0.0));
    let force = acceleration(&rough.world, viscosity(1.0));
    assert!(at_rows(&rough, &force, 0)[0] < -5.0);
    let fifth = at(&rough.world, Vect::<2>::new(4.0, 2.5));
    assert_eq!(force[fifth], Vect::<2>::zeros());
}

#[test]
fn the_friction_at_a_moving_wall_depends_on_relative_velocity_alone() {
    let friction = |fluid: f64, wall: f64| {
        let mut channel = Channel::open(10);
        let (walls, moving) = (&mut channel.world.walls, Vect::<2>::new(wall, 0.0));
        walls.points.viscous_velocity.fill(moving);
        walls.elements.velocity.fill(moving);
        set_velocity(&mut channel.world, |x| {
            Vect::<2>::new(fluid + x[1] * x[1], 0.0)
        });
        at_rows(&channel, &acceleration(&channel.world, viscosity(1.0)), 0)
    };
    let (still, moving) = (friction(0.0, 0.0), friction(2.0, 2.0));
    for k in 0..4 {
        assert!((still[k] - moving[k]).abs() < 1e-13, "{still:?} {moving:?}");
    }
}
