//! A profile of the velocity: exact for linear flows, whatever the arrangement.

use sph_core::{Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::{Curves, Probe, Profile};

use super::common::{self, fill, near, put};

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
    put(&mut free, fields::VELOCITY, places.iter().map(flow));
    fill(&mut free, fields::VOLUME, spacing * spacing);
    put(&mut free, fields::POSITION, places);
    common::world(free, spacing)
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
fn a_linear_flow_is_met_to_1e_12_up_to_the_edges_and_a_reference_is_off_by_as_much() {
    for off in [0.0, 0.07] {
        let measured = profile(off).measure(&sheared()).unwrap();
        measured.into_iter().for_each(|error| near(error, off));
    }
}

#[test]
fn where_no_particle_is_there_is_no_velocity() {
    let mut profile = profile(0.0);
    profile.from = vec![1.9, 0.0];
    profile.to = vec![1.9, 1.0];
    let world = sheared();
    assert!(profile.measure(&world).unwrap().iter().all(|e| e.is_nan()));
    let rows = profile.curves(&world).unwrap();
    assert!(rows.iter().all(|row| row[1].is_nan()));
}

#[test]
fn a_reference_without_rows_is_refused() {
    let mut profile: Profile = toml::from_str(TABLE).unwrap();
    assert!(Probe::<2>::load_reference(&mut profile, Vec::new()).is_err());
    assert!(Probe::<2>::load_reference(&mut profile, vec![[0.0, f64::NAN]]).is_err());
}
