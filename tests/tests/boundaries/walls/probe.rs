//! The wall-force probe of a wall that is drawn in several pieces.

use crate::walls::bench::{Flowing, flowing};
use sph_tests::close;

/// A box in one piece.
const WHOLE: &str = include_str!("pieces.toml");
/// Two other walls are two of its sides, which is left in two pieces.
const PIECES: &str = "wall.box.open=['x-','x+'] wall.left.polyline=[[0.0,0.8],[0.0,0.0]] \
    wall.right.polyline=[[1.0,0.0],[1.0,0.8]] probe.left={kind='wall-force',wall='left'} \
    probe.right={kind='wall-force',wall='right'}";

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
    let mut pieces = flowing(WHOLE, &[PIECES]);
    let mut whole = flowing(WHOLE, &[]);
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
