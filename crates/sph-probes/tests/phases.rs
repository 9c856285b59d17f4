//! Probes of one phase, on particles whose places are known.

use sph_core::{Registry, Role, Store, Vect, fields};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::{Domain, World};
use sph_probes::{Probe, ProbeEntry};

const SPACING: f64 = 0.05;

/// The interface of the two phases.
fn wave(x: f64) -> f64 {
    0.5 + 0.1 * (std::f64::consts::TAU * x).cos()
}

/// A lattice in the box (0, 1) × (0, 1.2), periodic along x: phase 1 below the wave, phase 0 above.
fn world() -> World<2> {
    let place = |k: usize| Vect::from([(k % 20) as f64 + 0.5, (k / 20) as f64 + 0.5]) * SPACING;
    let positions: Vec<Vect<2>> = (0..480).map(place).collect();
    let mut free = Store::new(positions.len());
    free.add(fields::POSITION, Role::State);
    free.add(fields::VELOCITY, Role::State);
    free.add(fields::MASS, Role::State);
    free.add(fields::VOLUME, Role::Derived);
    free.add(fields::PHASE, Role::State);
    let below = |x: &Vect<2>| u32::from(x[1] < wave(x[0]));
    *free.get_mut(fields::PHASE).unwrap() = positions.iter().map(below).collect();
    let mass = |x: &Vect<2>| if x[1] < wave(x[0]) { 3.0 } else { 1.0 };
    *free.get_mut(fields::MASS).unwrap() = positions.iter().map(mass).collect();
    free.get_mut(fields::VOLUME)
        .unwrap()
        .fill(SPACING * SPACING);
    free.get_mut(fields::VELOCITY)
        .unwrap()
        .fill(Vect::from([2.0, 0.0]));
    *free.get_mut(fields::POSITION).unwrap() = positions;
    let mut domain = Domain::open(Vect::from([0.0, -1.0]), Vect::from([1.0, 3.0]));
    domain.periodic[0] = true;
    World {
        free,
        walls: Default::default(),
        lists: Default::default(),
        domain,
        kernel: wendland_c2().sampler(2, 2.0 * SPACING),
        spacing: SPACING,
        skin: 0.1,
        gravity: Vect::from([0.0, -10.0]),
        driving: Vect::zeros(),
        time: 0.0,
        dt: 1.0,
    }
}

fn names() -> Vec<String> {
    ["air", "water"].map(String::from).into()
}

fn built(kind: &str, keys: &str) -> Box<dyn Probe<2>> {
    let registry = Registry::<ProbeEntry>::discovered().unwrap();
    let table = toml::from_str(keys).unwrap();
    registry.find(kind).unwrap().build::<2>(&table).unwrap()
}

fn measured(kind: &str, keys: &str) -> Vec<f64> {
    let mut probe = built(kind, keys);
    probe.name_phases(&names()).unwrap();
    probe.measure(&world()).unwrap()
}

#[test]
fn the_interface_is_where_the_wave_is_from_either_side() {
    for x in [0.0, 0.13, 0.25, 0.5, 0.98] {
        for phase in ["air", "water"] {
            let found = measured("interface", &format!("at = [{x}]\nphase = \"{phase}\""))[0];
            // The particles are in steps of a spacing.
            assert!((found - wave(x)).abs() < 0.5 * SPACING, "{x}: {found}");
        }
    }
    let flat = |phase: &str| measured("interface", &format!("at = [0.25]\nphase = \"{phase}\""))[0];
    assert!((flat("air") - flat("water")).abs() < 1e-9);
}

#[test]
fn a_level_is_the_top_of_all_or_of_a_phase() {
    let top = measured("level", "at = [0.25]")[0];
    assert!((top - 1.2).abs() < 0.1 * SPACING, "{top}");
    let water = measured("level", "at = [0.25]\nphase = \"water\"")[0];
    assert!((water - 0.5).abs() < 0.5 * SPACING, "{water}");
    let air = measured("level", "at = [0.25]\nphase = \"air\"")[0];
    assert_eq!(air, top);
}

#[test]
fn fronts_and_extents_are_those_of_the_phase() {
    let water = |keys: &str| format!("axis = \"y\"\nphase = \"water\"\n{keys}");
    let front = measured("front", &water(""))[0];
    assert!((front - 0.6).abs() < 1e-12, "{front}");
    let extent = measured("extent", &water(""));
    assert!(extent[0].abs() < 1e-12 && extent[1] == front, "{extent:?}");
    let air = measured("extent", "axis = \"y\"\nphase = \"air\"");
    assert!(
        (air[0] - 0.4).abs() < 1e-12 && (air[1] - 1.2).abs() < 1e-12,
        "{air:?}"
    );
    // A tenth of the water, 20 of 200 particles, is the lowest row.
    let inner = measured("extent", &water("quantile = 0.11"));
    assert!(
        (inner[0] - SPACING).abs() < 1e-12 && inner[1] < 0.6,
        "{inner:?}"
    );
    let all = measured("extent", "quantile = 0.0");
    assert!(all[0].abs() < 1e-12 && (all[1] - 1.0).abs() < 1e-12);
}

#[test]
fn volumes_and_energies_add_up() {
    let volume = |keys: &str| measured("phase-volume", keys)[0];
    let (air, water) = (volume("phase = \"air\""), volume("phase = \"water\""));
    assert!((water - 0.5).abs() < 1e-12 && (air + water - 1.2).abs() < 1e-12);
    assert!((volume("") - 1.2).abs() < 1e-12 && (volume("scale = 1.2") - 1.0).abs() < 1e-12);
    let energy = measured("phase-energy", "phase = \"water\"");
    assert!((energy[0] - 200.0 * 3.0 * 2.0).abs() < 1e-9, "{energy:?}");
    let both = measured("phase-energy", "");
    let air = measured("phase-energy", "phase = \"air\"");
    assert!((air[1] + energy[1] - both[1]).abs() < 1e-9);
    assert!(energy[1] > 0.0);
}

#[test]
fn an_unknown_phase_has_a_near_name() {
    for kind in [
        "interface",
        "level",
        "front",
        "extent",
        "phase-volume",
        "phase-energy",
    ] {
        let at = if ["interface", "level"].contains(&kind) {
            "at = [0]\n"
        } else {
            ""
        };
        let mut probe = built(kind, &format!("{at}phase = \"watr\""));
        let why = probe.name_phases(&names()).unwrap_err();
        assert_eq!(
            why, "there is no phase called `watr`, did you mean `water`?",
            "{kind}"
        );
        // Nobody told it the number of its phase.
        assert!(probe.measure(&world()).is_err(), "{kind}");
    }
}

#[test]
fn the_only_phase_is_everything() {
    let mut world = world();
    let mut bare = Store::new(world.free.len());
    for field in [fields::POSITION, fields::VELOCITY] {
        bare.add(field, Role::State);
        *bare.get_mut(field).unwrap() = world.free.get(field).unwrap().to_vec();
    }
    bare.add(fields::VOLUME, Role::Derived);
    bare.get_mut(fields::VOLUME)
        .unwrap()
        .fill(SPACING * SPACING);
    world.free = bare;
    let mut probe = built("phase-volume", "phase = \"water\"");
    probe.name_phases(&["water".into()]).unwrap();
    assert!((probe.measure(&world).unwrap()[0] - 1.2).abs() < 1e-12);
}
