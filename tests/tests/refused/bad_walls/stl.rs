//! Surfaces in STL files.

use sph_tests::binary_stl;

use crate::bad_walls::bench::{Corner, cube, in_space, refused, refused_with};

const CLIPPED: &str = "box = [[-1.5, -1.5, -1.5], [1.5, 1.5, 1.5]]\nclip = true";

/// An obstacle of these triangles in the middle of a tank with water around.
fn part(triangles: &[[Corner; 3]], keys: &str, words: &str) {
    let wall = format!("[wall.part]\nfile = \"part.stl\"\n{keys}");
    refused_with(
        &in_space(&wall, CLIPPED),
        &[("part.stl", &binary_stl(triangles))],
        words,
    );
}

#[test]
fn a_hole_is_told_with_its_edges_and_its_size() {
    let hole = &cube()[1..];
    part(hole, "", "wall `part` is open | 3 edge(s) | close the wall");
    part(
        hole,
        "fluid = \"outside\"",
        "wall `part` is open | an opening of 1.414 m around (0, 0, -0.5)",
    );
}

#[test]
fn a_flipped_triangle_is_told_with_its_number() {
    let mut flipped = cube();
    flipped[3].swap(0, 1);
    let words = "wall.part.file | 1 of 12 facets | facet 4 at | align = true";
    part(&flipped, "", words);
}

#[test]
fn a_repeated_triangle_is_told_with_both_numbers() {
    let mut repeated = cube();
    repeated.push(repeated[2]);
    part(
        &repeated,
        "",
        "wall `part`: triangles 2 and 12 | same corners",
    );
}

#[test]
fn a_triangle_without_area_is_told_with_its_place() {
    let mut flat = cube();
    flat.push([[0.5, 0.5, 0.5], [0.5, 0.5, 0.0], [0.5, 0.5, -0.5]]);
    part(&flat, "", "wall `part`: triangle 12 at (0.5, 0.5, 0.5)");
}

#[test]
fn a_needle_is_told_with_its_height() {
    let mut needle = cube();
    needle.push([[1.0, 1.0, 1.0], [1.4, 1.0, 1.0], [1.2, 1.0 + 1e-7, 1.0]]);
    part(&needle, "", "wall `part`: triangle 12 | needle");
}

#[test]
fn millimetres_by_mistake_are_suspected() {
    let scaled = |by: f32| -> Vec<[Corner; 3]> {
        let corners = |t: [Corner; 3]| t.map(|c| c.map(|x| x * by));
        cube().into_iter().map(corners).collect()
    };
    // A part of one metre whose numbers are millimetres is a kilometre in metres: too much for
    // the memory; one of ten metres is more elements than any wall may have.
    part(&scaled(1000.0), "", "unit");
    let words = "wall.part.file | millimetres | unit = \"mm\"";
    part(&scaled(10000.0), "", words);
    part(
        &cube(),
        "unit = \"mm\"",
        "wall.part.file | less than 2 spacings | `unit`",
    );
}

#[test]
fn broken_files_are_told_with_the_facet() {
    let scene = in_space("[wall.part]\nfile = \"part.stl\"", CLIPPED);
    let whole = binary_stl(&cube());
    for (bytes, words) in [
        (&whole[..whole.len() - 70], "cut short"),
        (&whole[..40], "40 bytes"),
        (&[][..], "is empty"),
        (&b"solid x\nendsolid x\n"[..], "holds no facets"),
        (&b"<html>not found</html>"[..], "no STL file"),
    ] {
        let words = format!("wall.part.file | {words}");
        refused_with(&scene, &[("part.stl", bytes)], &words);
    }
    refused(&scene, "wall.part.file | part.stl");
}
