//! A profile of the velocity: exact for linear flows, whatever the arrangement.

use sph_core::{Role, Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::{Curves, Probe, Profile};

/// Particles of the unit square, off their lattice by 0.2 δr, in a linear flow.
fn sheared() -> World<2> {
    let n = 20;
    let spacing = 1.0 / n as f64;
    let place = |k: usize| {
        let site = [k % n, k / n].map(|i| (i as f64 + 0.5) * spacing);
        let off = |phase: f64| 0.2 * spacing * (phase * k as f64).sin();
        Vect::<2>::new(site[0] + off(12.9898), site[1] + off(78.233))
    };
    let places: Vec<_> = (0..n * n).map(place).collect();
    let mut free = Store::new(places.len());
    free.add(fields::POSITION, Role::State);
    free.add(fields::VELOCITY, Role::State);
    free.add(fields::VOLUME, Role::State);
    *free.get_mut(fields::VELOCITY).unwrap() = places.iter().map(flow).collect();
    *free.get_mut(fields::POSITION).unwrap() = places;
    free.get_mut(fields::VOLUME)
        .unwrap()
        .fill(spacing * spacing);
    super::common::world(free, spacing)
}

fn flow(x: &Vect<2>) -> Vect<2> {
    Vect::<2>::new(0.3 + 2.0 * x[1] - x[0], 1.0 - x[1])
}

const TABLE: &str = r#"
component = "x"
from = [0.5, 0.0]
to = [0.5, 1.0]
file = "u.csv"
"#;

fn profile(off: f64) -> Profile {
    let mut profile: Profile = toml::from_str(TABLE).unwrap();
    let row = |k: u32| {
        let y = 0.1 * f64::from(k);
        [y, flow(&Vect::<2>::new(0.5, y))[0] + off]
    };
    Probe::<2>::load_reference(&mut profile, (0..=10).map(row).collect()).unwrap();
    profile
}

#[test]
fn a_linear_flow_is_met_to_1e_12_up_to_the_edges() {
    let measured = profile(0.0).measure(&sheared()).unwrap();
    assert!(measured.iter().all(|e| e.abs() < 1e-12), "{measured:?}");
}

#[test]
fn a_reference_that_is_off_is_told_by_as_much() {
    let measured = profile(0.07).measure(&sheared()).unwrap();
    assert!(
        measured.iter().all(|e| (e - 0.07).abs() < 1e-12),
        "{measured:?}"
    );
}

#[test]
fn where_no_particle_is_there_is_no_velocity() {
    let mut profile = profile(0.0);
    profile.from = vec![1.9, 0.0];
    profile.to = vec![1.9, 1.0];
    let world = sheared();
    assert!(profile.measure(&world).unwrap().iter().all(|e| e.is_nan()));
    assert!(
        profile
            .curves(&world)
            .unwrap()
            .iter()
            .all(|row| row[1].is_nan())
    );
}

#[test]
fn a_reference_without_rows_is_refused() {
    let mut profile: Profile = toml::from_str(TABLE).unwrap();
    assert!(Probe::<2>::load_reference(&mut profile, Vec::new()).is_err());
    assert!(Probe::<2>::load_reference(&mut profile, vec![[0.0, f64::NAN]]).is_err());
}
