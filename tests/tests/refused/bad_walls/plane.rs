//! Lines that cross.

use crate::bad_walls::bench::{in_the_plane, refused};

const BODY: &str = "box = [[0.0, 0.0], [1.0, 0.5]]\nclip = true";
const TANK: &str = "[wall.tank]\nbox = [[0.0, 0.0], [2.0, 2.0]]\n";

#[test]
fn two_lines_that_cross_are_told_with_both_names_and_the_place() {
    let pipe = "[wall.pipe]\npolyline = [[1.0, 1.0], [3.0, 1.0]]";
    let words = "`pipe` | `tank` | crosses | (2, 1)";
    refused(&in_the_plane(&format!("{TANK}{pipe}"), BODY), words);
}

#[test]
fn a_line_that_crosses_itself_is_told_with_the_place() {
    let bow = "[wall.bow]\npolygon = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]";
    let words = "wall.bow.polygon | (0.5, 0.5)";
    refused(&in_the_plane(bow, BODY), words);
}

#[test]
fn a_wall_that_moves_through_another_at_the_start_is_told_as_well() {
    let gate = "[wall.gate]\nbox = [[0.9, -0.2], [1.1, 1.0]]\nfluid = \"outside\"\n\
                motion.velocity = [0.0, 1.0]";
    let words = "`gate` | `tank` | crosses";
    refused(&in_the_plane(&format!("{TANK}{gate}"), BODY), words);
}
