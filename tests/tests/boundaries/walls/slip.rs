//! Partial slip: plane channels against Navier's condition.

use crate::walls::bench::{Flowing, flowing};

const NU: f64 = 1.0;
const DRIVING: f64 = 8.0;

/// A channel of unit height and `rows` spacings, from rest, with conditions of both walls.
fn channel(treatment: &str, rows: u32, driving: f64, bottom: &str, lid: &str) -> Flowing<2> {
    let spacing = 1.0 / f64::from(rows);
    let length = 12.0 * spacing;
    let vertices = match treatment {
        "usaw" => "vertices = true",
        _ => "",
    };
    let text = format!(
        r#"
title = "channel"
dimension = 2
run.end = 10.0
[numerics]
spacing = {spacing}
driving = [{driving}, 0.0]
periodic = {{ x = [0.0, {length}] }}
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.{treatment}]
{vertices}
[wall.bottom]
polyline = [[0.0, 0.0], [{length}, 0.0]]
{bottom}
[wall.lid]
polyline = [[{length}, 1.0], [0.0, 1.0]]
{lid}
[phase.fluid]
density = 1.0
speed_of_sound = 15.0
[phase.fluid.rheology.newtonian]
viscosity = {NU}
[body.fluid]
phase = "fluid"
box = [[0.0, 0.0], [{length}, 1.0]]
"#
    );
    flowing(&text, &[])
}

fn slip(length: f64) -> String {
    format!("condition = \"partial-slip\"\nslip_length = {length}\n")
}

/// Largest error of the velocity along x over the largest expected one.
fn error(flow: &Flowing<2>, expected: impl Fn(f64) -> f64) -> f64 {
    let all = || flow.positions().iter().zip(flow.velocities());
    let most = all().map(|(x, _)| expected(x[1]).abs()).fold(0.0, f64::max);
    let errors = all().map(|(x, u)| (u[0] - expected(x[1])).abs());
    errors.fold(0.0, f64::max) / most
}

/// u = a/(2ν) [y(H − y) + λH].
fn poiseuille(lambda: f64) -> impl Fn(f64) -> f64 {
    move |y| 0.5 * DRIVING / NU * (y * (1.0 - y) + lambda)
}

/// The error when the flow is steady.
fn steady(treatment: &str, rows: u32, lambda: f64) -> f64 {
    let walls = slip(lambda);
    let mut flow = channel(treatment, rows, DRIVING, &walls, &walls);
    // The slowest mode decays as exp(−k²νt) with k tan(k/2) = 1/λ.
    flow.until(1.0 + 3.0 * lambda);
    let error = error(&flow, poiseuille(lambda));
    println!("{treatment}, {rows} rows, λ = {lambda}: {error:.4}");
    error
}

#[test]
fn with_semi_analytical_walls_the_error_of_slip_halves_with_the_spacing() {
    // The wall points stand for half a row that nothing drives, so that the wall rubs with
    // 15/16 of a H: a sixteenth of the slip, λ/2, is missing from ½ [y(1 − y) + λ], beside an error of second order.
    // Measured 0.0075 and 0.026 with 16 rows.
    for lambda in [0.02_f64, 0.1] {
        let size = (1.0 / 30.0 + lambda / 3.0 + lambda * lambda).sqrt();
        let bound = lambda / size / 16.0 + 1.0 / (16.0 * 16.0);
        let fine = steady("usaw", 16, lambda);
        assert!(fine < bound, "λ = {lambda}: {fine}");
        let coarse = steady("usaw", 8, lambda);
        assert!(coarse > 1.9 * fine, "λ = {lambda}: {coarse} {fine}");
    }
}

#[test]
fn with_dummy_particles_poiseuille_flow_with_slip_is_4_per_cent_off_with_16_rows() {
    // Without slip it is 1.7 % off; measured 0.030 and 0.041. Held there, not derived.
    for (lambda, bound) in [(0.02, 0.032), (0.1, 0.042)] {
        let error = steady("dummy-particles", 16, lambda);
        assert!(error < bound, "λ = {lambda}: {error}");
    }
}

/// The lid moves at 1 m/s and slips, the bottom holds: u = y/(H + λ).
#[test]
fn couette_flow_with_slip_is_met_to_3e_4_and_with_dummies_to_11e_3() {
    for (treatment, bound) in [("usaw", 3e-4), ("dummy-particles", 0.011)] {
        let lid = format!("velocity = [1.0, 0.0]\n{}", slip(0.25));
        let mut flow = channel(treatment, 16, 0.0, "", &lid);
        flow.until(1.2);
        let error = error(&flow, |y| y / 1.25);
        println!("{treatment}: {error:.5}");
        assert!(error < bound, "{treatment}: {error}");
    }
}

/// Largest difference of velocities over the largest one.
fn apart(a: &Flowing<2>, b: &Flowing<2>) -> f64 {
    let most = b.velocities().iter().map(|u| u.norm()).fold(0.0, f64::max);
    let pairs = a.velocities().iter().zip(b.velocities());
    pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max) / most
}

#[test]
fn a_slip_length_of_nothing_is_no_slip_and_a_huge_one_is_free_slip() {
    for (treatment, bound) in [("usaw", 1e-8), ("dummy-particles", 1e-5)] {
        let run = |walls: &str| {
            let mut flow = channel(treatment, 10, DRIVING, walls, walls);
            flow.steps(60);
            flow
        };
        let (stuck, tiny) = (run(""), run(&slip(1e-13)));
        let (free, huge) = (run("condition = \"free-slip\""), run(&slip(1e9)));
        let [small, large] = [apart(&tiny, &stuck), apart(&huge, &free)];
        println!("{treatment}: {small:.1e} from no slip, {large:.1e} from free slip");
        assert!(small < 1e-11, "{treatment}: {small:e}");
        assert!(large < bound, "{treatment}: {large:e}");
        assert!(apart(&stuck, &free) > 0.5, "{treatment}");
    }
}
