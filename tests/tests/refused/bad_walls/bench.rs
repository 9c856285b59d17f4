//! Scenes with one mistake.

use sph_tests::{Says, bench, one_line};

/// A corner of a triangle.
pub type Corner = [f32; 3];

/// The cube from −½ to ½ as an obstacle: normals point out of it.
pub fn cube() -> Vec<[Corner; 3]> {
    let corner = |c: usize| [0, 1, 2].map(|k| if c >> k & 1 == 1 { 0.5 } else { -0.5 });
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = |q: [usize; 4]| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]];
    let triangles = quads.into_iter().flat_map(halves);
    triangles.map(|t| t.map(corner)).collect()
}

const PHASE: &str = "[phase.water]\ndensity = 1000.0\nspeed_of_sound = 30.0\n\
                     [phase.water.rheology.newtonian]\nviscosity = 1e-3\n";

/// A body in a tank of three dimensions with further tables.
pub fn in_space(more: &str, body: &str) -> String {
    format!(
        "title = \"bad\"\ndimension = 3\nrun.end = 0.01\n[numerics]\nspacing = 0.125\n[walls.usaw]\n\
         [wall.tank]\nbox = [[-2.0, -2.0, -2.0], [2.0, 2.0, 2.0]]\n{PHASE}\
         [body.water]\nphase = \"water\"\n{body}\n{more}\n"
    )
}

/// A body in the plane with further tables.
pub fn in_the_plane(more: &str, body: &str) -> String {
    format!(
        "title = \"bad\"\ndimension = 2\nrun.end = 0.01\n[numerics]\nspacing = 0.1\n[walls.usaw]\n\
         {PHASE}[body.water]\nphase = \"water\"\n{body}\n{more}\n"
    )
}

/// The scene is refused by `run` and `check`, and what is said has all the words; ` | ` stands between two.
pub fn refused(scene: &str, words: &str) {
    refused_with(scene, &[], words);
}

/// The same of a scene with files.
pub fn refused_with(scene: &str, files: &[(&str, &[u8])], words: &str) {
    let bench = bench!(scene);
    for (name, bytes) in files {
        bench.write(name, bytes);
    }
    for command in ["check", "run"] {
        let refused = bench.refused(&format!("{command} scene.toml"));
        println!("{}", refused.err);
        assert!(!refused.err.contains("panicked"), "{}", refused.err);
        refused.says(&format!("scene.toml | {words}"));
        assert_eq!(
            bench.names().len(),
            files.len() + 1,
            "something was written"
        );
    }
}

/// What `check` says of a good scene, in one line.
fn checked(scene: &str) -> String {
    let outcome = bench!(scene).done("check scene.toml");
    one_line(&outcome.out)
}

/// The scene is good, and `check` warns of a wall with all the words.
pub fn warned(scene: &str, words: &str) {
    checked(scene).says(words);
}

/// The scene is good, and `check` warns of no wall.
pub fn silent(scene: &str) {
    let told = checked(scene);
    assert!(!told.contains(": wall."), "{told}");
}
