//! Probes of one phase, on particles whose places are known.

use sph_core::{Store, Vect, fields};
use sph_neighbours::{Domain, World};
use sph_probes::Probe;

use super::common::{self, close, fill, near, put, scene};

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
    let below = |x: &Vect<2>| u32::from(x[1] < wave(x[0]));
    let mass = |x: &Vect<2>| if x[1] < wave(x[0]) { 3.0 } else { 1.0 };
    put(&mut free, fields::PHASE, positions.iter().map(below));
    put(&mut free, fields::MASS, positions.iter().map(mass));
    fill(&mut free, fields::VOLUME, SPACING * SPACING);
    fill(&mut free, fields::VELOCITY, Vect::from([2.0, 0.0]));
    put(&mut free, fields::POSITION, positions);
    let mut domain = Domain::open(Vect::from([0.0, -1.0]), Vect::from([1.0, 3.0]));
    domain.periodic[0] = true;
    World {
        gravity: Vect::from([0.0, -10.0]),
        steady_gravity: Vect::from([0.0, -10.0]),
        domain,
        ..common::world(free, SPACING)
    }
}

/// The same between open ends.
fn open_world() -> World<2> {
    World {
        domain: Domain::open(Vect::from([0.0, -1.0]), Vect::from([1.0, 3.0])),
        ..world()
    }
}

const NAMES: [&str; 2] = ["air", "water"];

fn built(kind: &str, keys: &str) -> Box<dyn Probe<2>> {
    common::prepared(kind, keys, NAMES)
}

fn measured(kind: &str, keys: &str) -> Vec<f64> {
    built(kind, keys).measure(&world()).unwrap()
}

#[test]
fn the_interface_is_where_the_wave_is_from_either_side() {
    for x in [0.0, 0.13, 0.25, 0.5, 0.98] {
        for phase in ["air", "water"] {
            let found = measured("interface", &format!("at = [{x}]\nphase = \"{phase}\""))[0];
            // The particles are in steps of a spacing.
            close(found, wave(x), 0.5 * SPACING);
        }
    }
    let flat = |phase: &str| measured("interface", &format!("at = [0.25]\nphase = \"{phase}\""))[0];
    close(flat("air"), flat("water"), 1e-9);
}

#[test]
fn a_level_is_the_top_of_all_or_of_a_phase() {
    let top = measured("level", "at = [0.25]")[0];
    close(top, 1.2, 0.1 * SPACING);
    let water = measured("level", "at = [0.25]\nphase = \"water\"")[0];
    close(water, 0.5, 0.5 * SPACING);
    let air = measured("level", "at = [0.25]\nphase = \"air\"")[0];
    assert_eq!(air, top);
}

/// A lattice is symmetric about the surface, so that half of the whole sum is exact but for its sum's own error.
#[test]
fn a_level_beside_a_wall_is_that_of_the_water_off_it() {
    let mut world = open_world();
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
    put(&mut world.free, fields::RENORMALISATION, gamma);
    for (x, blind) in places.into_iter().zip(blind) {
        let found = at(&world, x);
        close(found, 1.2, 0.1 * SPACING);
        // Off the wall nothing changes.
        assert!(x < reach || found == blind, "{x}: {found}, {blind}");
        let low = blind.is_nan() || blind < 1.2 - 0.25 * SPACING;
        assert!(low || x > SPACING, "{x}: {blind}");
    }
}

/// What is thrown up from the top keeps its height on a wire, and lifts the level to where it is.
#[test]
fn a_wire_tells_how_much_of_it_is_wet() {
    let mut world = open_world();
    for x in world.free.get_mut(fields::POSITION).unwrap() {
        if x[1] > 0.9 {
            x[1] += 0.8;
        }
    }
    let level = |keys: &str| built("level", keys).measure(&world).unwrap()[0];
    let [top, wet] = ["at = [0.25]", "at = [0.25]\nwetted = true"].map(level);
    close(top, 2.0, 0.1 * SPACING);
    // Each of the three surfaces is found to a quarter of a spacing.
    close(wet, 1.2, 0.75 * SPACING);
}

#[test]
fn fronts_and_extents_are_those_of_the_phase() {
    let water = |keys: &str| format!("axis = \"y\"\nphase = \"water\"\n{keys}");
    let front = measured("front", &water(""))[0];
    near(front, 0.6);
    let extent = |keys: &str| <[f64; 2]>::try_from(measured("extent", keys)).unwrap();
    let [lowest, highest] = extent(&water(""));
    near(lowest, 0.0);
    assert_eq!(highest, front);
    let [lowest, highest] = extent("axis = \"y\"\nphase = \"air\"");
    near(lowest, 0.4);
    near(highest, 1.2);
    // A tenth of the water, 20 of 200 particles, is the lowest row.
    let [lowest, highest] = extent(&water("quantile = 0.11"));
    near(lowest, SPACING);
    assert!(highest < 0.6, "{highest}");
    let [lowest, highest] = extent("quantile = 0.0");
    near(lowest, 0.0);
    near(highest, 1.0);
}

#[test]
fn fronts_go_either_way_and_leave_strays_behind() {
    let water = |keys: &str| measured("front", &format!("phase = \"water\"\n{keys}"))[0];
    // The wave's crests are at the ends: 24 of its 200 particles stand in the last two columns.
    for (keys, place) in [
        ("", 1.0),
        ("direction = \"backward\"", 0.0),
        ("quantile = 0.87", 1.0 - 2.0 * SPACING),
        ("quantile = 0.87\ndirection = \"backward\"", 2.0 * SPACING),
        ("quantile = 1e-9", SPACING),
    ] {
        near(water(keys), place);
    }
    assert_eq!(water("quantile = 1.0"), water(""));
    assert!(water("below = -1.0\nquantile = 0.9").is_nan());
}

#[test]
fn strain_rates_above_the_threshold_count_as_yielded() {
    let mut world = world();
    let rate = |x: &Vect<2>| if x[1] < 0.2 { 4.0 } else { x[1] * 0.5 };
    let positions = world.free.get(fields::POSITION).unwrap();
    let rates: Vec<f64> = positions.iter().map(rate).collect();
    put(&mut world.free, fields::STRAIN_RATE, rates);
    let measured = |keys: &str| built("yielded", keys).measure(&world).unwrap();
    // Four of 24 rows; all of them are water, 80 of 200 particles.
    let all = measured("strain_rate = 1.0");
    near(all[0], 4.0 / 24.0);
    near(all[1], 4.0);
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
        built("slope", "between = [0.2, 0.8]")
            .measure(&world)
            .unwrap()
    };
    for dip in [0.0, -0.4, 0.7] {
        let found = heap(dip);
        near(found[0], dip.atan());
        near(found[1], 0.0);
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
    near(water, 0.5);
    near(air + water, 1.2);
    near(volume(""), 1.2);
    near(volume("scale = 1.2"), 1.0);
    let energy = measured("phase-energy", "phase = \"water\"");
    close(energy[0], 200.0 * 3.0 * 2.0, 1e-9);
    let both = measured("phase-energy", "");
    let air = measured("phase-energy", "phase = \"air\"");
    close(air[1] + energy[1], both[1], 1e-9);
    assert!(energy[1] > 0.0);
}

#[test]
fn an_unknown_phase_has_a_near_name() {
    for (kind, keys) in [
        ("interface", "at = [0]"),
        ("level", "at = [0]"),
        ("front", ""),
        ("extent", ""),
        ("phase-volume", ""),
        ("phase-energy", ""),
        ("yielded", "strain_rate = 1"),
        ("slope", "between = [0, 1]"),
    ] {
        let mut probe = common::built::<2>(kind, &format!("{keys}\nphase = \"watr\""));
        let why = probe.prepare(&scene(&NAMES.map(String::from))).unwrap_err();
        let expected = "there is no phase called `watr`, did you mean `water`?";
        assert_eq!(why, expected, "{kind}");
        // Nobody told it the number of its phase.
        assert!(probe.measure(&world()).is_err(), "{kind}");
    }
}

#[test]
fn the_only_phase_is_everything() {
    let mut world = world();
    let mut bare = Store::new(world.free.len());
    for field in [fields::POSITION, fields::VELOCITY] {
        put(&mut bare, field, world.free.get(field).unwrap().to_vec());
    }
    fill(&mut bare, fields::VOLUME, SPACING * SPACING);
    world.free = bare;
    let mut probe = common::built("phase-volume", "phase = \"water\"");
    probe.prepare(&scene(&["water".into()])).unwrap();
    near(probe.measure(&world).unwrap()[0], 1.2);
}
