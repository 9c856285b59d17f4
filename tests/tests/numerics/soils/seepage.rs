//! Water through the pores of a soil: closed forms, what is conserved, and what is refused.

use sph_core::{System, Vect, fields};
use sph_particles::setup::Assembled;
use sph_soil::seepage::{PoreResistance, SEEPAGE_VELOCITY};
use sph_tests::{CHECK_AND_RUN, Says, bench, evaluated, momentum, move_as, scene, shipped};

/// The scene without its references, which are files beside it.
fn permeameter() -> String {
    let mut text = include_str!("../../../../scenes/permeameter.toml").to_string();
    let references = text.find("# Levels by").unwrap()..text.find("[output]").unwrap();
    text.replace_range(references, "");
    text
}

/// Beads of 1 mm in water, as in the scene.
fn beads(quadratic: f64) -> PoreResistance {
    PoreResistance {
        linear: 1e-3 / PoreResistance::permeability(0.366, 1e-3),
        quadratic,
        inertia: PoreResistance::inertia(0.366, 0.34, 1000.0),
    }
}

/// A kick in which everybody is accelerated alike.
fn kick(parts: &mut Assembled<2>, acceleration: Vect<2>, dt: f64) {
    let free = &mut parts.flow.world.free;
    let rates = free.get_mut(fields::ACCELERATION).unwrap();
    rates.fill(acceleration);
    parts.flow.kick(dt).unwrap();
}

/// Largest flux, m/s.
fn fastest(parts: &Assembled<2>) -> f64 {
    let flux = parts.flow.world.free.get(SEEPAGE_VELOCITY).unwrap();
    flux.iter().map(|q| q.norm()).fold(0.0, f64::max)
}

/// No viscosity is solved for, so that a kick is what its acceleration says.
const PLAIN: [&str; 1] =
    ["phase.beads.rheology.newtonian.viscosity=0 phase.water.rheology.newtonian.viscosity=0"];

/// The scene without implicit viscosity, of which nothing is left without viscosities.
fn plain() -> Assembled<2> {
    let text = permeameter().replace("[implicit-viscosity.backward-euler]\n", "");
    evaluated(&scene(&text, &PLAIN))
}

#[test]
fn a_periodic_bed_has_the_flux_of_the_law_from_rest_on() {
    for forchheimer in [0.0, 2e9] {
        let mut text = permeameter().replace("[implicit-viscosity.backward-euler]\n", "");
        for (from, to) in [
            ("[walls.usaw]", "[phase.beads]"),
            ("[gauge.left]", "[output]"),
        ] {
            let cut = text.find(from).unwrap()..text.find(to).unwrap();
            text.replace_range(cut, "");
        }
        let text = text
            .replace("gravity = [0.0, -9.81]", "driving = [5.0, 0.0]")
            .replace("[kernel", "[numerics.periodic]\nx = [0.0, 0.1]\n\n[kernel")
            .replace("[[0.1, 0.0], [0.2, 0.1]]", "[[0.0, 0.0], [0.1, 0.1]]")
            .replace("[[0.0, 0.0], [0.1, 0.2]]", "[[0.0, 0.2], [0.1, 0.25]]")
            .replace("[[0.2, 0.0], [0.3, 0.15]]", "[[0.0, 0.3], [0.1, 0.35]]")
            .replace("pressure = \"hydrostatic\"\n", "")
            .replace("forchheimer = 0.0", &format!("forchheimer = {forchheimer}"));
        let mut parts = evaluated::<2>(&scene(&text, &PLAIN));
        let (law, force) = (beads(forchheimer), 1000.0 * 5.0);
        // A hundredth of the time in which the flux follows, 3.5 ms.
        let dt = 0.01 * law.response(0.0);
        let mut exact = 0.0;
        for step in 1..=500 {
            kick(&mut parts, Vect::<2>::zeros(), dt);
            let inertia = law.inertia / dt;
            exact = (force + inertia * exact) / (inertia + law.linear + law.quadratic * exact);
            let flux = parts.flow.world.free.get(SEEPAGE_VELOCITY).unwrap();
            let phase = parts.flow.world.free.get(fields::PHASE).unwrap();
            let soil = flux.iter().zip(phase).filter(|(_, p)| **p == 0);
            let error = soil.map(|(q, _)| (q - Vect::from([exact, 0.0])).norm());
            let error = error.fold(0.0, f64::max) / exact;
            assert!(error < 1e-6, "step {step}: {error:e} of {exact} m/s");
        }
        let end = law.steady_flux(force);
        let passed = 1.0 - (-5f64).exp();
        let error = match forchheimer > 0.0 {
            true => exact / end - 1.0,
            false => exact / (end * passed) - 1.0,
        };
        println!("b = {forchheimer}: {exact} m/s after 5 times, {error:e} from the closed form");
        assert!(error.abs() < 1e-3, "{error:e}");
    }
}

#[test]
fn nothing_flows_at_rest_nor_in_a_tank_that_is_accelerated_nor_in_free_fall() {
    let down = Vect::from([0.0, -9.81]);
    for acceleration in [[0.0, 0.0], [3.0, 0.0], [1.0, -2.0], [0.0, -9.81]] {
        let acceleration = Vect::from(acceleration);
        let mut parts = plain();
        let free = &mut parts.flow.world.free;
        let position = free.get(fields::POSITION).unwrap().to_vec();
        let before = free.get(fields::MASS).unwrap().to_vec();
        let pressure = free.get_mut(fields::PRESSURE).unwrap();
        for (p, x) in pressure.iter_mut().zip(&position) {
            *p = 1000.0 * (down - acceleration).dot(x);
        }
        let dt = 9e-5;
        for _ in 0..20 {
            kick(&mut parts, acceleration, dt);
        }
        let found = fastest(&parts);
        println!("{acceleration:?}: {found:e} m/s");
        // What i = 1 would drive is 8 mm/s; the residual of the pressures is 1e-8.
        assert!(found < 1e-9, "{acceleration:?}: {found:e} m/s");
        if acceleration == down {
            // No pressure and nothing to push: what is left is the rounding of the change of velocity, 1e-18.
            assert!(found < 1e-16, "{found:e} m/s");
            let after = parts.flow.world.free.get(fields::MASS).unwrap();
            let moved = before.iter().zip(after).map(|(b, a)| (a / b - 1.0).abs());
            assert!(moved.fold(0.0, f64::max) < 1e-14);
        }
    }
}

#[test]
fn momentum_of_the_water_is_conserved() {
    let mut parts = plain();
    move_as(&mut parts, |x| {
        Vect::from([(90.0 * x[1]).sin(), (70.0 * x[0]).cos()])
    });
    let sums = |parts: &Assembled<2>| {
        let mass = parts.flow.world.free.get(fields::MASS).unwrap().to_vec();
        let whole = mass.iter().sum::<f64>();
        (mass, whole, momentum(parts).0)
    };
    let (before, mass, start) = sums(&parts);
    for _ in 0..300 {
        kick(&mut parts, Vect::<2>::zeros(), 9e-5);
    }
    let (after, whole, carried) = sums(&parts);
    let moved: f64 = before.iter().zip(&after).map(|(b, a)| (a - b).abs()).sum();
    let lost = (whole - mass).abs() / moved;
    let phase = parts.flow.world.free.get(fields::PHASE).unwrap();
    let both = before.iter().zip(&after).zip(phase);
    let soil = both.filter(|(_, p)| **p == 0);
    let soil: f64 = soil.map(|((b, a), _)| (a - b).abs()).sum();
    let pushed = (carried - start).norm() / start.norm();
    println!(
        "of {moved} kg that moved {lost:e} are lost, {:e} stayed in the soil; momentum {pushed:e}",
        soil / moved
    );
    assert!(moved > 0.005, "{moved} kg");
    assert!(lost < 1e-11, "{lost:e}");
    assert!(soil / moved < 1e-4, "{soil} kg of {moved}");
    assert!(pushed < 1e-12, "{pushed:e}");
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    bench!(&permeameter()).same_on_threads("--set run.end=0.01");
}

#[test]
fn particles_that_give_too_much_end_the_run() {
    let law =
        ["evening=0", "size_limit=0.006"].map(|key| format!("seepage.darcy-forchheimer.{key}"));
    let mut parts = evaluated::<2>(&shipped("permeameter", &law.each_ref().map(String::as_str)));
    let mut ended = None;
    for _ in 0..300 {
        if let Err(error) = parts.flow.kick(9e-5) {
            ended = Some(error.to_string());
            break;
        }
    }
    let told = ended.expect("the run ends");
    told.says("size of particle | seepage | size_limit");
}

#[test]
fn bad_tables_are_refused_at_their_line() {
    let changes = include_str!("seepage.refused");
    bench!().refuses("scene.toml", &CHECK_AND_RUN, &permeameter(), changes);
}
