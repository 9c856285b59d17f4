//! Openings between walls with fluid near them.

use crate::bad_walls::bench::{in_space, in_the_plane, refused, silent, warned};

#[test]
fn a_gap_between_two_lines_is_told_with_the_end_and_its_place() {
    let gap = "[wall.left]\npolyline = [[0.0, 2.0], [0.0, 0.0], [0.9, 0.0]]\n\
               [wall.right]\npolyline = [[1.2, 0.0], [2.0, 0.0], [2.0, 2.0]]\n";
    let words = "end of wall ` | is free | close the wall or extend it | 0)";
    refused(&in_the_plane(gap, "box = [[0.0, 0.0], [2.0, 1.0]]"), words);
}

#[test]
fn a_gap_between_two_sheets_is_told_with_its_size_and_place() {
    let sheets = "[wall.left]\nbox = [[0.0, 0.0, 0.0], [0.8, 1.0, 1.0]]\nopen = [\"x+\", \"z+\"]\n\
                  [wall.right]\nbox = [[1.2, 0.0, 0.0], [2.0, 1.0, 1.0]]\nopen = [\"x-\", \"z+\"]\n";
    let scene = in_space(sheets, "box = [[0.0, 0.0, 0.0], [2.0, 1.0, 0.5]]");
    let tank = "[wall.tank]\nbox = [[-2.0, -2.0, -2.0], [2.0, 2.0, 2.0]]\n";
    let words = "is open | an opening of | close the wall or extend it";
    refused(&scene.replace(tank, ""), words);
}

#[test]
fn an_open_tank_filled_to_its_rim_is_refused_at_the_rim() {
    let scene = in_space("", "box = [[-2.0, -2.0, -2.0], [2.0, 2.0, 1.9]]");
    let scene = scene.replace("[2.0, 2.0, 2.0]]\n", "[2.0, 2.0, 2.0]]\nopen = [\"z+\"]\n");
    refused(&scene, "wall `tank` is open | 4 edge(s)");
}

const TANK: &str = "[wall.tank]\nbox = [[0.0, 0.0], [4.0, 4.0]]\n";
const COLUMN: &str = "box = [[0.0, 0.0], [1.0, 2.0]]";

/// A column of water beside further walls in a tank.
fn beside(wall: &str) -> String {
    let gravity = "[numerics]\ngravity = [0.0, -9.81]\n";
    in_the_plane(wall, COLUMN).replace("[numerics]\n", gravity) + TANK
}

/// An obstacle of a line within the tank.
fn obstacle(points: &str, more: &str) -> String {
    beside(&format!("[wall.obstacle]\npolyline = [{points}]\n{more}\n"))
}

#[test]
fn free_ends_that_fluid_can_get_behind_are_told_with_line_and_place() {
    let feet = "[2.0, 0.0], [2.0, 0.8], [2.6, 0.8], [2.6, 0.0]";
    warned(
        &obstacle(feet, ""),
        "scene.toml: | wall.obstacle | first end at (2, 0) is free on wall `tank` | (2.6, 0) | closed = true",
    );
    let short = "[2.0, 0.05], [2.0, 0.8], [2.6, 0.8], [2.6, 0.05]";
    warned(
        &obstacle(short, ""),
        "first end at (2, 0.05) is free 0.05 m from wall `tank`",
    );
    let bell = "[2.0, 1.0], [2.0, 1.8], [2.6, 1.8], [2.6, 1.0]";
    warned(
        &obstacle(bell, ""),
        "it ends at (2.6, 1) and (2, 1), within wall `tank`",
    );
    let rows = obstacle(feet, "").replace("[walls.usaw]", "[walls.dummy-particles]");
    warned(&rows, "first end at (2, 0) is free on wall `tank`");
    // Closed, or as a plate, they are whole.
    silent(&obstacle(feet, "closed = true"));
    silent(&obstacle(bell, "closed = true"));
    silent(&obstacle("[2.0, 0.0], [2.0, 0.8]", "thickness = 0.5"));
}

#[test]
fn gaps_and_holes_below_the_level_are_told_and_open_tops_and_brinks_are_not() {
    let halves = |from: f64, to: f64| {
        let walls = format!(
            "[wall.left]\npolyline = [[0.0, 4.0], [0.0, 0.0], [{from}, 0.0]]\n\
             [wall.right]\npolyline = [[{to}, 0.0], [4.0, 0.0], [4.0, 4.0]]\n"
        );
        let scene = beside(&walls);
        let tank = scene.find("[wall.tank]").expect("the tank");
        scene[..tank].to_string()
    };
    warned(
        &halves(2.0, 2.1),
        "wall.left | a gap between it and wall `right` at (2, 0) and (2.1, 0)",
    );
    warned(
        &halves(2.0, 3.0),
        "it is open at (2, 0) and (3, 0), below the level | [outlet.NAME]",
    );
    silent(&halves(2.0, 2.0));
    silent(
        &(halves(2.0, 3.0)
            + "[outlet.drain]\naxis = \"y\"\nbeyond = -0.5\ndirection = \"backward\"\n"),
    );
    // Fluid may go over the brink of a table on purpose.
    let table = "[wall.table]\npolyline = [[0.0, 4.0], [0.0, 0.0], [3.0, 0.0]]\n";
    let scene = beside(table);
    silent(&scene[..scene.find("[wall.tank]").expect("the tank")]);
}

#[test]
fn solids_inside_out_are_told() {
    let turned = "[2.0, 1.0], [2.6, 1.0], [2.6, 1.8], [2.0, 1.8]";
    warned(
        &obstacle(turned, "closed = true"),
        "wall.obstacle | none is there | flip = true",
    );
    silent(&obstacle(turned, "closed = true\nflip = true"));
}

#[test]
fn a_hole_in_a_mesh_is_told_with_its_size_and_place() {
    // The floor of a block that stands on the floor of the tank is missing, or it hangs above.
    let block = |z: f64| {
        format!(
            "[wall.block]\nbox = [[0.5, -0.5, {z}], [1.5, 0.5, {}]]\nfluid = \"outside\"\nopen = [\"z-\"]\n",
            z + 1.0
        )
    };
    let body = "box = [[-2.0, -2.0, -2.0], [-1.0, 2.0, 1.5]]";
    let gravity = "[numerics]\ngravity = [0.0, 0.0, -9.81]\n";
    let scene = |z: f64| in_space(&block(z), body).replace("[numerics]\n", gravity);
    warned(
        &scene(-1.9),
        "wall.block | its edge at ( | is free 0.1 m from wall `tank`",
    );
    warned(
        &scene(0.0),
        "wall.block | an opening 1.414 m wide around (1, 0, 0), within wall `tank`",
    );
    silent(&scene(-1.9).replace("open = [\"z-\"]\n", ""));
}

#[test]
fn plugins_without_the_scale_of_symmetric_walls_are_refused_at_their_line() {
    let tank = || {
        let usaw = in_the_plane("", "box = [[0.0, 0.0], [1.0, 0.5]]");
        usaw.replace("[walls.usaw]", "[walls.symmetric]") + "[wall.tank]\nbox = [[0, 0], [1, 1]]\n"
    };
    let sums = "`walls.symmetric` does not scale | take `[walls.usaw]` | scene.toml:";
    refused(&(tank() + "[pressure.implicit]\n"), sums);
    refused(&(tank() + "[formulation.grenier]\n"), sums);
    let open = "open-boundary.outflow = {}\n";
    refused(&(tank() + open), "open faces | [walls.usaw]");
}
