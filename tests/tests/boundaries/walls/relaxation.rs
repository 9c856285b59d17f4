//! Relaxing the first particles evens out the density next to slanted and curved walls.

use sph_particles::setup::Relaxation;
use sph_tests::{assembled, scene};

/// Largest error of the density that the scenes ask for.
const TOLERANCE: f64 = 0.01;

fn relaxed<const D: usize>(spacing: f64, walls: &str, periodic: &str) -> Relaxation {
    let text = format!(
        r#"
title = "relaxed"
dimension = {D}
run.end = 1.0
[numerics]
spacing = {spacing}
relax = {{ steps = 300, tolerance = {TOLERANCE} }}
{periodic}
[shifting]
[walls.usaw]
vertices = true
{walls}
[phase.fluid]
density = 1.0
speed_of_sound = 10.0
[phase.fluid.rheology.newtonian]
viscosity = 1.0
[body.fluid]
phase = "fluid"
fill = "walls"
"#
    );
    let parts = assembled::<D>(&scene(&text, &[]));
    parts.relaxation.expect("it was asked for")
}

fn is_evened_out(what: &str, before: f64, r: &Relaxation) {
    println!(
        "{what}: {:.3} to {:.4} in {} steps, rms {:.4} to {:.4}, {} particles",
        r.largest_before, r.largest, r.steps, r.rms_before, r.rms, r.counted
    );
    assert!(r.largest_before > before, "{what}: {}", r.largest_before);
    // Relaxing is a diffusion: what is left is the longest wave, and a wave of the amplitude A,
    // which the scene's tolerance bounds, has a root mean square of A/√2.
    assert!(r.largest < TOLERANCE, "{what}: {}", r.largest);
    assert!(r.rms < TOLERANCE / 2_f64.sqrt(), "{what}: {}", r.rms);
    assert!(r.counted > 300);
}

#[test]
fn in_a_disc_the_largest_density_error_falls_from_17_to_1_per_cent() {
    let disc = "[wall.disc]\ndisc = { centre = [0.0, 0.0], radius = 0.5 }\n";
    is_evened_out("disc", 0.1, &relaxed::<2>(0.04, disc, ""));
}

#[test]
fn between_slanted_walls_it_falls_from_19_to_1_per_cent() {
    let slanted = "[wall.room]\npolygon = [[0.0, 0.0], [1.0, 0.27], [0.8, 1.1], [-0.1, 0.9]]\n";
    is_evened_out("slanted", 0.1, &relaxed::<2>(0.04, slanted, ""));
}

#[test]
fn in_a_pipe_it_falls_to_1_per_cent() {
    let pipe = r#"
[wall.pipe]
cylinder = { from = [0.0, 0.0, 0.0], to = [0.6, 0.0, 0.0], radius = 0.35, open_ends = true }
"#;
    let relaxed = relaxed::<3>(0.06, pipe, "periodic = { x = [0.0, 0.6] }");
    is_evened_out("pipe", 0.05, &relaxed);
}
