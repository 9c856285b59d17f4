//! Surfaces in STL files.

use sph_tests::{binary_stl, exchanged};

use crate::bad_walls::{SPACE, refused_with};

type Triangle = [[f32; 3]; 3];

/// The cube from −½ to ½ as an obstacle: normals point out of it.
fn cube() -> Vec<Triangle> {
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

/// A tank with water around a part from a file, with further keys of the part.
fn scene(keys: &str) -> String {
    let body = "box = [[-2.0, -2.0, -2.0], [2.0, 2.0, 0.0]]\n";
    let clipped = "box = [[-1.5, -1.5, -1.5], [1.5, 1.5, 1.5]]\nclip = true\n";
    let tank = exchanged(SPACE, body, clipped);
    format!("{tank}[wall.part]\nfile = \"part.stl\"\n{keys}\n")
}

#[test]
fn holes_flipped_repeated_flat_and_thin_triangles_and_wrong_units_are_told() {
    let mut flipped = cube();
    flipped[3].swap(0, 1);
    let and = |triangle: Triangle| [cube(), vec![triangle]].concat();
    let flat = and([[0.5, 0.5, 0.5], [0.5, 0.5, 0.0], [0.5, 0.5, -0.5]]);
    let needle = and([[1.0, 1.0, 1.0], [1.4, 1.0, 1.0], [1.2, 1.0 + 1e-7, 1.0]]);
    let scaled = |by: f32| -> Vec<Triangle> {
        let corners = |t: Triangle| t.map(|c| c.map(|x| x * by));
        cube().into_iter().map(corners).collect()
    };
    let hole = cube()[1..].to_vec();
    let (outside, mm) = ("fluid = \"outside\"", "unit = \"mm\"");
    // A part of one metre whose numbers are millimetres is a kilometre in metres: too much for the memory; one of ten
    // metres is more elements than any wall may have.
    for (triangles, keys, words) in [
        (&hole, "", "` is open | 3 edge(s) | close the wall"),
        (&hole, outside, "` is open | 1.414 m around (0, 0, -0.5)"),
        (&flipped, "", ".file | 1 of 12 | facet 4 at | align = true"),
        (&and(cube()[2]), "", "triangles 2 and 12 | same corners"),
        (&flat, "", "`: triangle 12 at (0.5, 0.5, 0.5)"),
        (&needle, "", "`: triangle 12 | needle"),
        (&scaled(1000.0), "", "unit"),
        (&scaled(1e4), "", ".file | millimetres | unit = \"mm\""),
        (&cube(), mm, ".file | less than 2 spacings | `unit`"),
    ] {
        let files = [("part.stl", &binary_stl(triangles)[..])];
        refused_with(&scene(keys), &files, &format!("part | {words}"));
    }
}

#[test]
fn broken_files_are_told_with_the_facet() {
    let whole = binary_stl(&cube());
    for (bytes, words) in [
        (&whole[..whole.len() - 70], "cut short"),
        (&whole[..40], "40 bytes"),
        (&[][..], "is empty"),
        (&b"solid x\nendsolid x\n"[..], "holds no facets"),
        (&b"<html>not found</html>"[..], "no STL file"),
    ] {
        let words = format!("wall.part.file | {words}");
        refused_with(&scene(""), &[("part.stl", bytes)], &words);
    }
    refused_with(&scene(""), &[], "wall.part.file | part.stl");
}
