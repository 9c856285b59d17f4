//! Walls in the plane, from shapes and from SVG and CSV files.

use super::common::{close, lines, says, with};
use sph_scene::{Line, Polygon};
use tempfile::tempdir;

/// The lines of a file.
fn read(name: &str, text: &str, keys: &str) -> Result<Vec<Line>, String> {
    let wall = format!("file = \"{name}\"\n{keys}");
    lines(with(name, text).path(), &wall).map_err(|p| p.to_string())
}

/// The lines of a drawing of 10 × 10 user units.
fn drawn(inner: &str, keys: &str) -> Result<Vec<Line>, String> {
    let text = format!(
        "<?xml version=\"1.0\"?>\n<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"\">\n\
         <svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 10 10\">{inner}</svg>"
    );
    read("gear.svg", &text, keys)
}

fn area(line: &Line) -> f64 {
    assert!(line.closed, "{line:?}");
    Polygon::new(line.points.clone()).area()
}

#[test]
fn a_drawing_stands_upright_on_its_lower_left_corner() {
    let found = drawn("<polyline points=\"0,10 10,10 10,0\"/>", "").unwrap();
    let points = vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]];
    let closed = false;
    assert_eq!(found, [Line { points, closed }]);
    let line = "<line x1=\"0\" y1=\"0\" x2=\"10\" y2=\"0\"/>";
    let found = drawn(line, "scale = 0.5").unwrap();
    assert_eq!(found[0].points, [[0.0, 5.0], [5.0, 5.0]]);
}

#[test]
fn all_shapes_and_transforms_are_drawn() {
    let pi = std::f64::consts::PI;
    for (inner, expected) in [
        ("<rect x='1' y='1' width='4' height='2'/>", 8.0),
        ("<rect x='1' y='1' width='4' height='2' rx='1'/>", 4.0 + pi),
        (
            "<rect x='1' y='1' width='4' height='4' rx='2' ry='1'/>",
            8.0 + 2.0 * pi,
        ),
        ("<circle cx='5' cy='5' r='3'/>", 9.0 * pi),
        ("<ellipse cx='5' cy='5' rx='3' ry='1'/>", 3.0 * pi),
        ("<polygon points='0 0 4 0 4 3'/>", 6.0),
        ("<path d='M0 0h4v3z'/>", 6.0),
        (
            "<path d='M 2 5 A 3 3 0 1 1 8 5 A 3 3 0 1 1 2 5'/>",
            9.0 * pi,
        ),
        ("<path d='m2 5 a3 3 0 0 1 6 0 a3 3 0 0 1 -6 0z'/>", 9.0 * pi),
        ("<path d='M0 0 Q5 0 5 5 T10 10 L0 10z'/>", 50.0),
        (
            "<path d='M0 5 C0 0 5 0 5 5 S10 10 10 5 L10 10 L0 10 Z'/>",
            50.0,
        ),
        (
            "<g transform='translate(1,1) scale(2)'><g transform='rotate(90)'><rect width='2' height='1'/></g></g>",
            8.0,
        ),
        (
            "<defs><circle r='1'/></defs><title>x</title><g style='fill:red; display: none'><circle r='1'/></g><circle r='2' style='fill:none'/>",
            4.0 * pi,
        ),
    ] {
        let found = drawn(inner, "").unwrap_or_else(|e| panic!("{inner}: {e}"));
        assert_eq!(found.len(), 1, "{inner}");
        close(area(&found[0]).abs(), expected, 0.01 * expected);
    }
}

#[test]
fn curves_stay_within_a_twentieth_of_a_spacing() {
    for inner in [
        "<circle r='5'/>",
        "<path d='M-5 0A5 5 0 0 1 5 0A5 5 0 0 1 -5 0z'/>",
        "<g transform='scale(0.01)'><path d='M-500 0A500 500 0 0 1 500 0A500 500 0 0 1 -500 0z'/></g>",
    ] {
        let line = &drawn(inner, "").unwrap()[0];
        let n = line.points.len();
        assert!((12..100).contains(&n), "{inner}: {n} corners");
        for k in 0..n {
            let (a, b) = (line.points[k], line.points[(k + 1) % n]);
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) - 10.0];
            let off = middle[0].hypot(middle[1]) - 5.0;
            assert!(off.abs() < 0.005, "{inner}: {off}");
        }
    }
}

#[test]
fn closed_lines_turn_to_the_fluid_and_holes_against_it() {
    let ring = "<circle cx='5' cy='5' r='4'/><circle cx='5' cy='5' r='2'/>";
    let inside = drawn(ring, "fluid = \"inside\"").unwrap();
    assert!(area(&inside[0]) > 0.0 && area(&inside[1]) < 0.0);
    let outside = drawn(ring, "fluid = \"outside\"").unwrap();
    assert!(area(&outside[0]) < 0.0 && area(&outside[1]) > 0.0);
    let told = drawn("<path d='M0 0L5 5L5 0'/>", "fluid = \"inside\"").unwrap_err();
    says(&told, "wall.w.fluid: line 0 of the drawing");
}

#[test]
fn broken_drawings_are_refused() {
    for (inner, message) in [
        ("<path d='M0 0 L5 x'/>", "line 3: <path>: d: "),
        (
            "<use href='#a'/>",
            "<use>: it is not read; turn it into paths",
        ),
        ("<text>no</text>", "<text>: it is not read"),
        ("<rect width='50%' height='1'/>", "width: `50%` is relative"),
        ("<circle r='1e300'/>", "is out of range"),
        ("<path d='M0 0L1e308 1e308'/>", "is out of range"),
        ("<path d='M0 0A1e300 1 0 0 0 1 1'/>", "is out of range"),
        (
            "<g transform='scale(1e300)'><circle r='1'/></g>",
            "out of range",
        ),
        (
            "<g transform='turn(3)'><circle r='1'/></g>",
            "<g>: transform: ",
        ),
        ("<g/>", "it holds no lines"),
        ("<path d='M1 1'/>", "it holds no lines"),
        ("<g>", "it is no SVG drawing"),
        ("<circle r='0.05'/>", "less than 2 spacings"),
    ] {
        let told = drawn(inner, "").unwrap_err();
        says(&told, &format!("^wall.w.file: | {message}"));
    }
    let told = read("gear.svg", "<html/>", "").unwrap_err();
    says(&told, "there is no <svg>");
    let [open, shut] = ["<g>", "</g>"].map(|tag| tag.repeat(20_000));
    let deep = format!("{open}<circle r='1'/>{shut}");
    assert_eq!(drawn(&deep, "").unwrap().len(), 1);
}

#[test]
fn columns_are_lines_between_blank_lines() {
    let text = "x,y\n0,0\n1000,0\n1000,1000\n0,0\n\n# gate\n2000,0\n2000,1000\n";
    let found = read("coast.csv", text, "unit = \"mm\"").unwrap();
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].points, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    assert!(found[0].closed && !found[1].closed);
    for (text, message) in [
        ("0,0\n1,1\n\n5,5\n", "begins in line 4 has one corner only"),
        ("0,0\n1e300,0\n", "are the coordinates in millimetres?"),
    ] {
        let told = read("coast.csv", text, "").unwrap_err();
        says(&told, &format!("^wall.w.file: | {message}"));
    }
}

#[test]
fn shapes_of_the_plane_hold_the_fluid() {
    let folder = tempdir().unwrap();
    let of = |wall: &str| lines(folder.path(), wall).unwrap();
    for (wall, expected) in [
        ("box = [[0, 0], [2, 1]]", 2.0),
        ("polygon = [[0, 0], [0, 1], [2, 0]]", 1.0),
        ("wedge = { lo = [0, 0], hi = [2, 1] }", 1.0),
        (
            "wedge = { lo = [0, 0], hi = [2, 1], rise = \"x-\", up = \"y-\" }",
            1.0,
        ),
        ("disc = { centre = [3, 3], radius = 1, sides = 4 }", 2.0),
    ] {
        close(area(&of(wall)[0]), expected, 1e-12);
        let outside = of(&format!("{wall}\nfluid = \"outside\""));
        close(area(&outside[0]), -expected, 1e-12);
    }
    let ramp = of("wedge = { lo = [0, 0], hi = [2, 1] }");
    assert_eq!(ramp[0].points, [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]]);
    let disc = of("disc = { centre = [0, 0], radius = 1 }");
    assert_eq!(disc[0].points.len(), 63);
    let tank = "box = [[0, 0], [2, 1]]\nopen = [\"y+\"]";
    let corners = [[0.0, 1.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]];
    assert_eq!(of(tank)[0].points, corners);
    let block = of(&format!("{tank}\nfluid = \"outside\""));
    assert_eq!(block[0].points[0], [2.0, 1.0]);
    let line =
        of("polyline = [[0, 0], [1, 0]]\nrotate = { angle = \"90 deg\" }\ntranslate = [1, 0]");
    assert_eq!(line[0].points, [[1.0, 0.0], [1.0, 1.0]]);
}
