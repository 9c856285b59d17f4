//! What no body can be, and where it is said.

use sph_tests::bench;

use crate::bodies::FLOAT;

#[test]
fn bodies_and_lines_that_none_can_be_are_refused_at_their_line() {
    for changes in [
        include_str!("bodies.refused"),
        include_str!("lines.refused"),
    ] {
        let run = ["run scene.toml --quiet --out r"];
        bench!().refuses("scene.toml", &run, FLOAT, changes);
    }
}
