//! Openings between walls with fluid near them.

use sph_tests::{Says, bench, exchanged, one_line};

use crate::bad_walls::{PLANE, SPACE};

/// A column of water in a wide tank.
fn beside() -> String {
    let body = "box = [[0.0, 0.0], [1.0, 1.0]]\n";
    let column = "box = [[0.0, 0.0], [1.0, 2.0]]\n[wall.tank]\nbox = [[0.0, 0.0], [4.0, 4.0]]\n";
    let numerics = "[numerics]\ngravity = [0.0, -9.81]\n";
    exchanged(PLANE, body, column).replace("[numerics]\n", numerics)
}

/// The output of `check` for a good scene, in one line.
fn checked(scene: &str) -> String {
    one_line(&bench!(scene).done("check scene.toml").out)
}

#[test]
fn openings_that_fluid_can_get_through_are_told_with_their_places() {
    bench!().remarks(&beside(), include_str!("beside.remarked"));
}

/// Walls that are whole, as plates or closed; open tops; and fluid that may go over the brink of a table on purpose.
#[test]
fn whole_walls_open_tops_and_brinks_are_not_told() {
    let obstacle = |wall: &str| format!("{}[wall.obstacle]\npolyline = {wall}\n", beside());
    for wall in [
        "[[2.0, 0.0], [2.0, 0.8], [2.6, 0.8], [2.6, 0.0]]\nclosed = true",
        "[[2.0, 1.0], [2.0, 1.8], [2.6, 1.8], [2.6, 1.0]]\nclosed = true",
        "[[2.0, 0.0], [2.0, 0.8]]\nthickness = 0.5",
        "[[2.0, 1.0], [2.6, 1.0], [2.6, 1.8], [2.0, 1.8]]\nclosed = true\nflip = true",
    ] {
        checked(&obstacle(wall)).lacks(": wall.");
    }
    let tank = "[wall.tank]\nbox = [[0.0, 0.0], [4.0, 4.0]]\n";
    let left = |to: f64| format!("[wall.left]\npolyline = [[0.0, 4.0], [0.0, 0.0], [{to}, 0.0]]\n");
    let right =
        |from: f64| format!("[wall.right]\npolyline = [[{from}, 0.0], [4.0, 0.0], [4.0, 4.0]]\n");
    let drain = "[outlet.drain]\naxis = \"y\"\nbeyond = -0.5\ndirection = \"backward\"\n";
    for walls in [
        left(2.0) + &right(2.0),
        left(2.0) + &right(3.0) + drain,
        left(3.0),
    ] {
        checked(&exchanged(&beside(), tank, &walls)).lacks(": wall.");
    }
}

#[test]
fn a_hole_in_a_mesh_is_told_with_its_size_and_place() {
    // The floor of a block that stands on the floor of the tank is missing, or it hangs above.
    let scene = |low: f64| {
        let high = low + 1.0;
        let body = "box = [[-2.0, -2.0, -2.0], [2.0, 2.0, 0.0]]\n";
        let beside = "box = [[-2.0, -2.0, -2.0], [-1.0, 2.0, 1.5]]\n";
        let numerics = "[numerics]\ngravity = [0.0, 0.0, -9.81]\n";
        let tank = exchanged(SPACE, body, beside).replace("[numerics]\n", numerics);
        format!(
            "{tank}[wall.block]\nbox = [[0.5, -0.5, {low}], [1.5, 0.5, {high}]]\nfluid = \"outside\"\nopen = [\"z-\"]\n"
        )
    };
    let stands = checked(&scene(-1.9));
    stands.says("wall.block | its edge at ( | is free 0.1 m from wall `tank`");
    let hangs = checked(&scene(0.0));
    hangs.says("wall.block | an opening 1.414 m wide around (1, 0, 0), within wall `tank`");
    checked(&scene(-1.9).replace("open = [\"z-\"]\n", "")).lacks(": wall.");
}
