//! Drawings and tables in files.

use crate::bad_walls::{PLANE, SPACE, refused_with};

#[test]
fn drawings_are_told_with_the_line_or_what_is_missing() {
    let svg = |inner: &str| {
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\">{inner}</svg>")
    };
    for (name, text, words) in [
        ("hull.csv", "x,y\n0,0\n1,oops\n", ".file | line 3 | oops"),
        ("hull.csv", "x,y\n0,0\n1\n", ".file | line 3"),
        ("hull.csv", "x,y\n", ".file"),
        ("hull.csv", "0,0\n1,inf\n2,2\n", ".file | line 2 | finite"),
        ("hull.csv", "0,0\n2,2\n2,0\n0,2\n0,0\n", " | cross"),
        ("hull.svg", "<svg", ".file"),
        ("hull.svg", &svg(""), ".file"),
        ("hull.svg", &svg("<path d=\"M 0 0 L 3 q\"/>"), ".file"),
        ("hull.svg", "just text", ".file"),
        ("hull.svg", &svg("<text x=\"1\">hull</text>"), ".file"),
        ("hull.dxf", "0", ".file | .svg or .csv | hull.dxf"),
        ("hull.stl", "0", ".file | three dimensions"),
    ] {
        let scene = format!("{PLANE}clip = true\n[wall.hull]\nfile = \"{name}\"\n");
        let words = format!("hull{words}");
        refused_with(&scene, &[(name, text.as_bytes())], &words);
    }
    let scene = format!("{SPACE}[wall.hull]\nfile = \"hull.svg\"\n");
    refused_with(&scene, &[("hull.svg", b"")], "wall.hull.file | .stl");
}

#[test]
fn a_table_of_motion_is_told_with_the_line() {
    let wall = "[wall.tank]\nbox = [[0.0, 0.0], [1.0, 1.0]]\n\
                motion.translate = { along = [1.0, 0.0], file = \"course.csv\" }\n";
    let scene = format!("{PLANE}clip = true\n{wall}");
    let at = "wall.tank.motion.translate.file";
    for (course, words) in [
        ("0,0\n1,0.1\n1,0.2\n", "line 3 | times must rise"),
        ("0,0\n", "1 rows | at least 2"),
        ("0,0\n1,x\n", "line 2"),
    ] {
        let files = [("course.csv", course.as_bytes())];
        refused_with(&scene, &files, &format!("{at} | {words}"));
    }
    refused_with(&scene, &[], &format!("{at} | course.csv"));
}
