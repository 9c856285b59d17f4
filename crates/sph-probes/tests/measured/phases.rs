//! Probes of one phase, on particles whose places are known.

use sph_core::{Registry, Role, Store, Vect, fields};
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
        gravity: Vect::from([0.0, -10.0]),
        steady_gravity: Vect::from([0.0, -10.0]),
        domain,
        ..super::common::world(free, SPACING)
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
    probe.prepare(&super::common::scene(&names())).unwrap();
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

/// A lattice is symmetric about the surface, so that half of the whole sum is exact but for its sum's own error.
#[test]
fn a_level_beside_a_wall_is_that_of_the_water_off_it() {
    let mut world = World {
        domain: Domain::open(Vect::from([0.0, -1.0]), Vect::from([1.0, 3.0])),
        ..world()
    };
    let reach = world.kernel.support_radius();
    let at = |world: &World<2>, x: f64| {
        let probe = built("level", &format!("at = [{x}]"));
        probe.measure(world).unwrap()[0]
    };
    let places = [0.0, 0.5, 1.0, 1.25, 3.0, 10.0].map(|x| x * SPACING);
    let blind = places.map(|x| at(&world, x));
    let beside = |x: &Vect<2>| if x[0] < reach { 0.7 } else { 1.0 };
    let positions = world.free.get(fields::POSITION).unwrap();
    let gamma: Vec<f64> = positions.iter().map(beside).collect();
    world.free.add(fields::RENORMALISATION, Role::Derived);
    *world.free.get_mut(fields::RENORMALISATION).unwrap() = gamma;
    for (x, blind) in places.into_iter().zip(blind) {
        let found = at(&world, x);
        assert!((found - 1.2).abs() < 0.1 * SPACING, "{x}: {found}");
        // Off the wall nothing changes.
        assert!(x < reach || found == blind, "{x}: {found}, {blind}");
        let low = blind.is_nan() || blind < 1.2 - 0.25 * SPACING;
        assert!(low || x > SPACING, "{x}: {blind}");
    }
}

/// What is thrown up from the top keeps its height on a wire, and lifts the level to where it is.
#[test]
fn a_wire_tells_how_much_of_it_is_wet() {
    let mut world = World {
        domain: Domain::open(Vect::from([0.0, -1.0]), Vect::from([1.0, 3.0])),
        ..world()
    };
    for x in world.free.get_mut(fields::POSITION).unwrap() {
        if x[1] > 0.9 {
            x[1] += 0.8;
        }
    }
    let level = |keys: &str| built("level", keys).measure(&world).unwrap()[0];
    let [top, wet] = ["at = [0.25]", "at = [0.25]\nwetted = true"].map(level);
    assert!((top - 2.0).abs() < 0.1 * SPACING, "{top}");
    // Each of the three surfaces is found to a quarter of a spacing.
    assert!((wet - 1.2).abs() < 0.75 * SPACING, "{wet}");
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
fn fronts_go_either_way_and_leave_strays_behind() {
    let water = |keys: &str| measured("front", &format!("phase = \"water\"\n{keys}"))[0];
    let [right, left] = [water(""), water("direction = \"backward\"")];
    assert!((right - 1.0).abs() < 1e-12 && left.abs() < 1e-12);
    // The wave's crests are at the ends: 24 of its 200 particles stand in the last two columns.
    let inner = water("quantile = 0.87");
    assert!((inner - 1.0 + 2.0 * SPACING).abs() < 1e-12, "{inner}");
    let inner = water("quantile = 0.87\ndirection = \"backward\"");
    assert!((inner - 2.0 * SPACING).abs() < 1e-12, "{inner}");
    assert_eq!(water("quantile = 1.0"), right);
    assert!((water("quantile = 1e-9") - SPACING).abs() < 1e-12);
    assert!(water("below = -1.0\nquantile = 0.9").is_nan());
}

#[test]
fn strain_rates_above_the_threshold_count_as_yielded() {
    let mut world = world();
    world.free.add(fields::STRAIN_RATE, Role::Derived);
    let heights: Vec<f64> = world.free.get(fields::POSITION).unwrap()[..]
        .iter()
        .map(|x| x[1])
        .collect();
    let rates = world.free.get_mut(fields::STRAIN_RATE).unwrap();
    rates
        .iter_mut()
        .zip(&heights)
        .for_each(|(rate, y)| *rate = if *y < 0.2 { 4.0 } else { y * 0.5 });
    let measured = |keys: &str| {
        let mut probe = built("yielded", keys);
        probe.prepare(&super::common::scene(&names())).unwrap();
        probe.measure(&world).unwrap()
    };
    // Four of 24 rows; all of them are water, 80 of 200 particles.
    let all = measured("strain_rate = 1.0");
    assert!((all[0] - 4.0 / 24.0).abs() < 1e-12 && (all[1] - 4.0).abs() < 1e-12);
    assert_eq!(measured("strain_rate = 1.0\nphase = \"water\""), [0.4, 4.0]);
    let none = measured("strain_rate = 1.0\nphase = \"air\"");
    assert!(none[0] == 0.0 && none[1].is_nan());
}

#[test]
fn the_slope_is_that_of_the_heap() {
    let heap = |dip: f64| {
        let mut world = world();
        for x in world.free.get_mut(fields::POSITION).unwrap() {
            x[1] += dip * x[0];
        }
        let mut probe = built("slope", "between = [0.2, 0.8]");
        probe.prepare(&super::common::scene(&names())).unwrap();
        probe.measure(&world).unwrap()
    };
    for dip in [0.0, -0.4, 0.7] {
        let found = heap(dip);
        assert!(
            (found[0] - dip.atan()).abs() < 1e-12 && found[1] < 1e-12,
            "{found:?}"
        );
    }
    // The surface of the water is a cosine: it falls on the left, rises on the right.
    let water = |at: &str| measured("slope", &format!("phase = \"water\"\nbetween = {at}"));
    assert!(water("[0.05, 0.45]")[0] < -0.3 && water("[0.55, 0.95]")[0] > 0.3);
    assert!(water("[0.05, 0.45]")[1] > 0.0);
    assert!(water("[1.5, 1.8]")[0].is_nan() && water("[0.8, 0.2]")[0].is_nan());
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
        "yielded",
        "slope",
    ] {
        let at = match kind {
            "interface" | "level" => "at = [0]\n",
            "yielded" => "strain_rate = 1\n",
            "slope" => "between = [0, 1]\n",
            _ => "",
        };
        let mut probe = built(kind, &format!("{at}phase = \"watr\""));
        let why = probe.prepare(&super::common::scene(&names())).unwrap_err();
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
    probe
        .prepare(&super::common::scene(&["water".into()]))
        .unwrap();
    assert!((probe.measure(&world).unwrap()[0] - 1.2).abs() < 1e-12);
}
