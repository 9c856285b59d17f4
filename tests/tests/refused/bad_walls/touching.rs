//! Bodies and walls that are in each other's way in space.

use crate::bad_walls::bench::{in_space, refused};

const BODY: &str = "box = [[-2.0, -2.0, -2.0], [2.0, 2.0, 0.0]]";

#[test]
fn an_obstacle_inside_a_body_asks_for_clip() {
    let ball =
        "[wall.ball]\nsphere = { centre = [0.0, 0.0, -1.0], radius = 0.5 }\nfluid = \"outside\"";
    let words = "body.water | through wall `ball` | `clip = true`";
    refused(&in_space(ball, BODY), words);
}

#[test]
fn two_walls_that_cross_are_told_with_both_names_and_the_place() {
    let block = "[wall.block]\nbox = [[1.0, -0.5, -1.0], [3.0, 0.5, 0.0]]\nfluid = \"outside\"";
    let words = "`block` | `tank` | crosses | near (2, ";
    refused(&in_space(block, &format!("{BODY}\nclip = true")), words);
}

#[test]
fn a_tank_drawn_inside_out_leaves_no_fluid() {
    let scene = in_space(
        "",
        "fill = \"walls\"\nbox = [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]]",
    );
    let scene = scene.replace(
        "[2.0, 2.0, 2.0]]\n",
        "[2.0, 2.0, 2.0]]\nfluid = \"outside\"\n",
    );
    refused(&scene, "body.water | right side");
}
