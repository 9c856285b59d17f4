//! Walls in space, from shapes and from STL files.

use std::io::Cursor;
use std::path::Path;

use super::common::{close, facets, says, with};
use sph_scene::Facets;
use stl_io::{Normal, Triangle, Vertex, write_stl};
use tempfile::tempdir;

/// A box of 1 m with outward normals, as an STL file of millimetres has it.
fn cube(folder: &Path) -> Vec<Triangle> {
    let shape = facets(folder, "box = [[0, 0, 0], [1, 1, 1]]\nfluid = \"outside\"").unwrap();
    let vertex = |k: u32| Vertex::new(shape.points[k as usize].map(|c| 1000.0 * c as f32));
    let triangle = |t: &[u32; 3]| Triangle {
        normal: Normal::new([0.0; 3]),
        vertices: t.map(vertex),
    };
    shape.triangles.iter().map(triangle).collect()
}

fn binary(triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    write_stl(&mut bytes, triangles.iter()).unwrap();
    bytes.into_inner()
}

fn ascii(name: &str, triangles: &[Triangle]) -> String {
    let vertex = |v: &Vertex| format!("   Vertex {} {} {:e}\r\n", v[0], v[1], v[2]);
    let facet = |t: &Triangle| {
        let corners: String = t.vertices.iter().map(vertex).collect();
        let n = t.normal.0;
        format!(
            "  facet normal {} {} {}\n  outer loop\n{corners}  endloop\n  endfacet\n",
            n[0], n[1], n[2]
        )
    };
    let all: String = triangles.iter().map(facet).collect();
    format!("SOLID{name}\n{all}endsolid{name}\n")
}

const PART: &str = "file = \"part.stl\"\nunit = \"mm\"";

#[track_caller]
fn refused(bytes: impl AsRef<[u8]>, wall: &str, words: &str) {
    let problem = facets(with("part.stl", bytes).path(), wall).unwrap_err();
    assert!(problem.path.starts_with("wall.w."), "{problem}");
    says(&problem.to_string(), words);
}

fn is_the_cube(surface: &Facets, volume: f64) {
    assert_eq!((surface.points.len(), surface.triangles.len()), (8, 12));
    close(surface.volume(), volume, 1e-6);
}

#[test]
fn binary_and_ascii_files_are_the_same_surface() {
    let folder = tempdir().unwrap();
    let cube = cube(folder.path());
    let mut solid = binary(&cube);
    solid[..14].copy_from_slice(b"solid of a CAD");
    let halves = ascii(" a b", &cube[..5]) + &ascii("", &cube[5..]);
    for bytes in [binary(&cube), solid, ascii("", &cube).into(), halves.into()] {
        let folder = with("part.stl", &bytes);
        is_the_cube(&facets(folder.path(), PART).unwrap(), 1.0);
    }
}

#[test]
fn the_fluid_is_on_the_side_that_is_asked_for() {
    let folder = tempdir().unwrap();
    let cube = cube(folder.path());
    let mut inside_out = cube.clone();
    inside_out.iter_mut().for_each(|t| t.vertices.swap(1, 2));
    for (given, drawn) in [(&cube, 1.0), (&inside_out, -1.0)] {
        let folder = with("part.stl", binary(given));
        let of = |fluid: &str| facets(folder.path(), &format!("{PART}\n{fluid}")).unwrap();
        is_the_cube(&of(""), drawn);
        is_the_cube(&of("fluid = \"as-drawn\""), drawn);
        is_the_cube(&of("fluid = \"outside\""), 1.0);
        is_the_cube(&of("fluid = \"inside\""), -1.0);
    }
    // What an open surface winds around most is its inside; a flat one has none.
    for given in [&cube, &inside_out] {
        let folder = with("part.stl", binary(&given[1..]));
        for (side, sense) in [("outside", 1.0), ("inside", -1.0)] {
            let sided = facets(folder.path(), &format!("{PART}\nfluid = \"{side}\"")).unwrap();
            let found = sph_scene::sense(&sided);
            assert!(sense * found > 0.3, "{side}: {found}");
        }
    }
    let inside = format!("{PART}\nfluid = \"inside\"");
    let told = "^wall.w.fluid: | 1 openings (4 edges, ";
    refused(binary(&cube[..2]), &inside, told);
    let mut odd = cube.clone();
    odd[4].normal = Normal::new([0.0, 1.0, 0.0]);
    odd[5].normal = Normal::new([0.0, -1.0, 0.0]);
    refused(binary(&odd), PART, "the normal of facet");
}

#[test]
fn broken_files_are_refused_with_the_facet() {
    let folder = tempdir().unwrap();
    let cube = cube(folder.path());
    let mut infinite = cube.clone();
    infinite[3].vertices[1] = Vertex::new([f32::NAN, 0.0, 0.0]);
    let text = ascii("", &cube).into_bytes();
    let odd = ascii("", &cube).replacen("outer loop", "inner loop", 1);
    for (bytes, told) in [
        (
            binary(&infinite),
            "facet 4: expected finite coordinates, found NaN",
        ),
        (ascii("", &infinite).into(), "facet 4: expected finite"),
        (text[..text.len() - 40].to_vec(), "`endsolid` is missing"),
        (odd.into(), "facet 1: expected"),
    ] {
        refused(bytes, PART, told);
    }
    let folder = tempdir().unwrap();
    std::fs::create_dir(folder.path().join("part.stl")).unwrap();
    let told = facets(folder.path(), PART).unwrap_err();
    assert!(told.to_string().contains("is not a file"));
}

#[test]
fn a_sphere_that_does_not_fit_the_spacing_is_refused_before_its_facets_are_made() {
    for (radius, told) in [
        ("1 um", "take a smaller spacing"),
        ("1e9 km", "take a larger spacing"),
    ] {
        let wall = format!("sphere = {{ centre = [0, 0, 0], radius = \"{radius}\" }}");
        refused([], &wall, &format!("^wall.w.sphere: | {told}"));
    }
}

#[test]
fn shapes_are_closed_unless_left_open_and_hold_the_fluid() {
    let folder = tempdir().unwrap();
    let of = |wall: &str| facets(folder.path(), wall).unwrap();
    for (wall, volume, triangles) in [
        ("box = [[0, 0, 0], [1, 2, 3]]", 6.0, 12),
        (
            "cone = { base = [0, 0, 0], apex = [0, 0, 3], radius = 1, sides = 4 }",
            2.0,
            6,
        ),
        (
            "wedge = { lo = [0, 0, 0], hi = [1, 2, 3], rise = \"y-\" }",
            3.0,
            8,
        ),
        (
            "wedge = { lo = [0, 0, 0], hi = [1, 2, 3], rise = \"z+\", up = \"x-\" }",
            3.0,
            8,
        ),
        (
            "extrusion = { polygon = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], axis = \"y\", from = 3, to = 1 }",
            6.0,
            20,
        ),
        (
            "cylinder = { from = [0, 0, 0], to = [2, 0, 0], radius = 1, sides = 6 }",
            3.0 * 3f64.sqrt(),
            20,
        ),
    ] {
        let surface = of(wall);
        close(surface.volume(), -volume, 1e-9);
        assert_eq!(surface.triangles.len(), triangles, "{wall}");
        let outside = of(&format!("{wall}\nfluid = \"outside\""));
        close(outside.volume(), volume, 1e-9);
    }
    let open = of("box = [[0, 0, 0], [1, 1, 1]]\nopen = [\"z+\", \"x-\"]");
    assert_eq!(open.triangles.len(), 8);
    let pipe = of(
        "cylinder = { from = [0, 0, 0], to = [0, 0, 1], radius = 1, sides = 6, open_ends = true }",
    );
    assert_eq!((pipe.points.len(), pipe.triangles.len()), (12, 12));
}

#[test]
fn geometries_are_scaled_then_turned_then_shifted() {
    let folder = tempdir().unwrap();
    let wall = "box = [[0, 0, 0], [1, 2, 3]]\nscale = 2\ntranslate = [10, 0, 0]\n\
                rotate = { axis = [0, 0, 5], angle = \"90 deg\", centre = [1, 0, 0] }";
    let surface = facets(folder.path(), wall).unwrap();
    // (2, 4, 6) turns about (1, 0, ·) to (−3, 1, 6).
    let corner = |x: [f64; 3]| surface.points.contains(&x);
    assert!(
        corner([7.0, 1.0, 6.0]) && corner([11.0, -1.0, 0.0]),
        "{surface:?}"
    );
}
