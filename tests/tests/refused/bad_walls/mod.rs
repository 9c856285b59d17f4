//! Walls and motions that are refused: the wall, the place and what to do about it, exit code 2,
//! and nothing written.

mod files;
mod openings;
mod stl;

use sph_tests::{CHECK_AND_RUN, Says, bench};

/// A body of water in the plane.
const PLANE: &str = include_str!("plane.toml");
/// A tank of three dimensions with water up to its middle.
const SPACE: &str = include_str!("space.toml");

/// Walls and keys in the plane and in space that do not go together.
#[test]
fn walls_bodies_and_keys_that_do_not_fit_are_told_with_their_names_and_places() {
    let tank = format!("{PLANE}[wall.tank]\nbox = [[0.0, 0.0], [1.0, 1.0]]\n");
    for (scene, changes) in [
        (PLANE, include_str!("plane.refused")),
        (&tank, include_str!("tank.refused")),
        (SPACE, include_str!("space.refused")),
    ] {
        bench!().refuses("scene.toml", &CHECK_AND_RUN, scene, changes);
    }
}

/// A scene with files beside it is refused by `run` and `check`, and what is said has all the words; ` | ` stands between two.
fn refused_with(scene: &str, files: &[(&str, &[u8])], words: &str) {
    let bench = bench!(scene);
    for (name, bytes) in files {
        bench.write(name, bytes);
    }
    let names = bench.names();
    for command in CHECK_AND_RUN {
        let refused = bench.refused(command);
        refused.err.lacks("panicked");
        refused.says(&format!("scene.toml | {words}"));
        assert_eq!(bench.names(), names, "something was written");
    }
}
