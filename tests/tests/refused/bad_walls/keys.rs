//! Keys that do not go together, and names that nobody has.

use crate::bad_walls::bench::{in_space, in_the_plane, refused};

const BODY: &str = "box = [[0.0, 0.0], [1.0, 1.0]]";
const TANK: &str = "[wall.tank]\nbox = [[0.0, 0.0], [1.0, 1.0]]\n";

fn flat(more: &str, words: &str) {
    refused(&in_the_plane(&format!("{TANK}{more}"), BODY), words);
}

#[test]
fn an_unknown_wall_of_a_force_probe_is_told_with_the_nearest_name() {
    let probe = "[probe.drag]\nkind = \"wall-force\"\nwall = \"tnak\"";
    flat(probe, "probe.drag | no wall `tnak` | did you mean `tank`");
}

#[test]
fn an_unknown_wall_that_a_probe_follows_is_told_with_the_nearest_name() {
    let probe = "[probe.p]\nkind = \"pressure\"\nat = [0.5, 0.5]\nfollows = \"tnak\"";
    flat(probe, "probe.p | `tnak` | did you mean `tank`");
    let gauge = "[gauge.level]\nkind = \"level\"\nat = [0.5]\nfollows = \"tnak\"";
    flat(gauge, "gauge.level | `tnak` | did you mean `tank`");
}

#[test]
fn a_table_whose_times_do_not_rise_is_told_with_the_row() {
    let table = "motion.translate = { along = [1.0, 0.0], table = [[0, 0], [1, 0.1], [1, 0.2]] }";
    flat(
        table,
        "wall.tank.motion.translate.table[2] | 1 s follows 1 s",
    );
}

#[test]
fn a_rotation_in_space_without_an_axis_is_refused() {
    let body = "box = [[-2.0, -2.0, -2.0], [2.0, 2.0, 2.0]]";
    for motion in [
        "[wall.tank.motion]\nangular_velocity = 1.0\ncentre = [0.0, 0.0, 0.0]",
        "[wall.tank.motion]\nrotate = { centre = [0.0, 0.0, 0.0], speed = 1.0 }",
    ] {
        refused(&in_space(motion, body), "wall.tank.motion | `axis`");
    }
    let zero = "[wall.tank.motion]\nrotate = { centre = [0, 0, 0], axis = [0, 0, 0], speed = 1 }";
    refused(&in_space(zero, body), "wall.tank.motion.rotate.axis");
}

#[test]
fn slip_lengths_go_with_partial_slip_only() {
    flat("slip_length = 0.1", "wall.tank.slip_length | partial-slip");
    flat(
        "condition = \"partial-slip\"",
        "wall.tank.condition | `slip_length`",
    );
    let negative = "condition = \"partial-slip\"\nslip_length = -0.1";
    flat(negative, "wall.tank.slip_length | more than 0");
    flat(
        "condition = \"free-slip\"\nslip_length = 0.1",
        "wall.tank.slip_length",
    );
}

#[test]
fn filling_walls_needs_walls() {
    let scene = in_the_plane("", "fill = \"walls\"").replace("[walls.usaw]\n", "");
    refused(&scene, "body.water.fill | wall");
}

#[test]
fn a_seed_outside_of_the_walls_leaves_nothing() {
    for seed in ["[3.0, 3.0]", "[-0.5, 0.5]"] {
        let body = format!("fill = \"walls\"\nseed = {seed}");
        refused(&in_the_plane(TANK, &body), "body.water | `seed`");
    }
    let body = "box = [[0.0, 0.0], [1.0, 1.0]]\nseed = [0.5, 0.5]";
    refused(&in_the_plane(TANK, body), "body.water.seed");
}

#[test]
fn a_polyline_is_no_wall_in_space() {
    let body = "box = [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]]";
    let line = "[wall.line]\npolyline = [[0.0, 0.0], [1.0, 0.0]]";
    refused(&in_space(line, body), "wall.line.polyline | two dimensions");
}
