//! Openings between walls with fluid near them.

use crate::bad_walls::bench::{in_space, in_the_plane, refused};

#[test]
fn a_gap_between_two_lines_is_told_with_the_end_and_its_place() {
    let gap = "[wall.left]\npolyline = [[0.0, 2.0], [0.0, 0.0], [0.9, 0.0]]\n\
               [wall.right]\npolyline = [[1.2, 0.0], [2.0, 0.0], [2.0, 2.0]]\n";
    let words = [
        "end of wall `",
        "is free",
        "close the wall or extend it",
        "0)",
    ];
    refused(
        &in_the_plane(gap, "box = [[0.0, 0.0], [2.0, 1.0]]"),
        &[],
        &words,
    );
}

#[test]
fn a_gap_between_two_sheets_is_told_with_its_size_and_place() {
    let sheets = "[wall.left]\nbox = [[0.0, 0.0, 0.0], [0.8, 1.0, 1.0]]\nopen = [\"x+\", \"z+\"]\n\
                  [wall.right]\nbox = [[1.2, 0.0, 0.0], [2.0, 1.0, 1.0]]\nopen = [\"x-\", \"z+\"]\n";
    let scene = in_space(sheets, "box = [[0.0, 0.0, 0.0], [2.0, 1.0, 0.5]]");
    let tank = "[wall.tank]\nbox = [[-2.0, -2.0, -2.0], [2.0, 2.0, 2.0]]\n";
    let words = ["is open", "an opening of", "close the wall or extend it"];
    refused(&scene.replace(tank, ""), &[], &words);
}

#[test]
fn an_open_tank_filled_to_its_rim_is_refused_at_the_rim() {
    let scene = in_space("", "box = [[-2.0, -2.0, -2.0], [2.0, 2.0, 1.9]]");
    let scene = scene.replace("[2.0, 2.0, 2.0]]\n", "[2.0, 2.0, 2.0]]\nopen = [\"z+\"]\n");
    refused(&scene, &[], &["wall `tank` is open", "4 edge(s)"]);
}
