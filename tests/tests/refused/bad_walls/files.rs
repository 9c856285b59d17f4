//! Drawings and tables in files.

use crate::bad_walls::bench::{in_space, in_the_plane, refused, refused_with};

const BODY: &str = "box = [[0.0, 0.0], [1.0, 1.0]]\nclip = true";

fn drawing(name: &str, text: &str, words: &str) {
    let wall = format!("[wall.hull]\nfile = \"{name}\"");
    refused_with(
        &in_the_plane(&wall, BODY),
        &[(name, text.as_bytes())],
        words,
    );
}

#[test]
fn csv_lines_are_told_with_the_line() {
    let at = "wall.hull.file";
    drawing(
        "hull.csv",
        "x,y\n0,0\n1,oops\n",
        &format!("{at} | line 3 | oops"),
    );
    drawing("hull.csv", "x,y\n0,0\n1\n", &format!("{at} | line 3"));
    drawing("hull.csv", "x,y\n", at);
    drawing(
        "hull.csv",
        "0,0\n1,inf\n2,2\n",
        &format!("{at} | line 2 | finite"),
    );
    drawing("hull.csv", "0,0\n2,2\n2,0\n0,2\n0,0\n", "hull | cross");
}

#[test]
fn svg_drawings_are_told_with_what_is_missing() {
    let at = "wall.hull.file";
    let svg = |inner: &str| {
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\">{inner}</svg>")
    };
    drawing("hull.svg", "<svg", at);
    drawing("hull.svg", &svg(""), at);
    drawing("hull.svg", &svg("<path d=\"M 0 0 L 3 q\"/>"), at);
    drawing("hull.svg", "just text", at);
    let text = svg("<text x=\"1\" y=\"2\">hull</text>");
    drawing("hull.svg", &text, at);
}

#[test]
fn a_drawing_of_the_wrong_dimension_or_ending_is_refused() {
    drawing("hull.dxf", "0", "wall.hull.file | .svg or .csv | hull.dxf");
    drawing("hull.stl", "0", "wall.hull.file | three dimensions");
    let wall = "[wall.hull]\nfile = \"hull.svg\"";
    let body = "box = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]";
    refused_with(
        &in_space(wall, body),
        &[("hull.svg", b"")],
        "wall.hull.file | .stl",
    );
}

#[test]
fn a_table_of_motion_is_told_with_the_line() {
    let wall = "[wall.tank]\nbox = [[0.0, 0.0], [1.0, 1.0]]\n\
                motion.translate = { along = [1.0, 0.0], file = \"course.csv\" }";
    let scene = in_the_plane(wall, BODY);
    let course = |text: &str, words: &str| {
        refused_with(&scene, &[("course.csv", text.as_bytes())], words);
    };
    let at = "wall.tank.motion.translate.file";
    course(
        "0,0\n1,0.1\n1,0.2\n",
        &format!("{at} | line 3 | times must rise"),
    );
    course("0,0\n", &format!("{at} | 1 rows | at least 2"));
    course("0,0\n1,x\n", &format!("{at} | line 2"));
    refused(&scene, &format!("{at} | course.csv"));
}
