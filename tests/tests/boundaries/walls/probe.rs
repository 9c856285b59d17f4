//! The wall-force probe of a wall that is drawn in several pieces.

use crate::walls::bench::{Flowing, flowing};
use sph_tests::close;

/// A box in one piece or, where other walls are two of its sides, in two.
fn channel(open: &str, others: &str, probes: &str) -> Flowing<2> {
    flowing(&format!(
        r#"
title = "pieces"
dimension = 2
run.end = 1.0
[numerics]
spacing = 0.05
gravity = [1.0, -9.81]
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.usaw]
[wall.box]
box = [[0.0, 0.0], [1.0, 0.8]]
open = [{open}]
{others}
[phase.water]
density = 1000.0
velocity_scale = 3.0
[phase.water.rheology.newtonian]
viscosity = "1 Pa s"
[body.water]
phase = "water"
box = [[0.0, 0.0], [1.0, 0.8]]
[probe.box]
kind = "wall-force"
wall = "box"
{probes}
"#
    ))
}

/// What the probe of a wall tells.
fn measured(flow: &mut Flowing<2>, wall: &str) -> Vec<f64> {
    flow.0
        .flow
        .measure_wall_forces(|name| name == wall)
        .unwrap();
    let mut probes = flow.0.probes.iter();
    let probe = probes.find(|(name, _)| name == wall).expect("the probe");
    probe.1.measure(&flow.0.flow.world).expect("a measurement")
}

#[test]
fn a_wall_in_two_pieces_has_the_force_of_both_to_1e_12() {
    let sides = "[wall.left]\npolyline = [[0.0, 0.8], [0.0, 0.0]]\n[wall.right]\npolyline = [[1.0, 0.0], [1.0, 0.8]]\n";
    let probes = "[probe.left]\nkind = \"wall-force\"\nwall = \"left\"\n[probe.right]\nkind = \"wall-force\"\nwall = \"right\"\n";
    let mut pieces = channel("\"x-\", \"x+\"", sides, probes);
    let mut whole = channel("", "", "");
    pieces.steps(10);
    whole.steps(10);
    let names = pieces.0.flow.world.walls.names.clone();
    assert_eq!(names.iter().filter(|n| *n == "box").count(), 2);
    let parts = ["box", "left", "right"].map(|wall| measured(&mut pieces, wall));
    let all = measured(&mut whole, "box");
    for k in 0..all.len() {
        let sum: f64 = parts.iter().map(|p| p[k]).sum();
        let scale = all.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        close(sum, all[k], 1e-12 * scale, "N on the pieces");
    }
}
