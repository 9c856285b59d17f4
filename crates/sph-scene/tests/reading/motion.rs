//! How walls move.

use super::common::{scene, with};
use sph_core::SlipCondition;
use sph_core::course::{Course, Rotation, Translation};
use sph_scene::Motion;
use tempfile::tempdir;

type Courses = (Vec<Translation<2>>, Option<Rotation<2>>);

fn motion(folder: &std::path::Path, motion: &str) -> Motion {
    let wall = format!("box = [[0, 0], [1, 1]]\n[wall.w.motion]\n{motion}");
    let mut scene = scene(folder, 2, &wall);
    scene.wall.remove("w").and_then(|w| w.motion).unwrap()
}

fn courses(folder: &std::path::Path, text: &str) -> Result<Courses, String> {
    let found = motion(folder, text).courses("wall.w.motion");
    found.map_err(|p| p.to_string())
}

fn along(along: [f64; 2], course: Course) -> Translation<2> {
    Translation { along, course }
}

#[test]
fn constant_motions_are_courses_too() {
    let folder = tempdir().unwrap();
    let text = "velocity = [3, 4]\nangular_velocity = \"30 rpm\"\ncentre = [1, 2]\nstart = 0.5\nstop = \"2 s\"";
    let (translations, rotation) = courses(folder.path(), text).unwrap();
    let course = Course::Steady { speed: 5.0 };
    assert_eq!(translations, [along([0.6, 0.8], course)]);
    let rotation = rotation.unwrap();
    let about = ([1.0, 2.0], [0.0, 0.0, 1.0]);
    assert_eq!((rotation.centre, rotation.axis), about);
    let speed = std::f64::consts::PI;
    assert_eq!(rotation.course, Course::Steady { speed });
    let found = motion(folder.path(), text);
    assert_eq!((found.start, found.stop), (0.5, Some(2.0)));
    let still = courses(folder.path(), "velocity = [0, 0]").unwrap();
    assert_eq!(still, (Vec::new(), None));
}

#[test]
fn units_of_courses_and_of_columns_reach_si() {
    let folder = tempdir().unwrap();
    let text = "translate = [\n\
        { along = [2, 0], ramp = { speed = \"10 cm/s\", over = \"500 ms\" } },\n\
        { along = [0, -1], sine = { amplitude = \"5 cm\", period = 2, phase = \"180 deg\", ramp = 1 } },\n\
        { along = [1, 0], table = [[\"0 s\", \"1 cm\"], [1, 0.5]] },\n]\n\
        rotate = { centre = [0, 0], table = [[0, \"0 deg\"], [\"1 min\", \"180 deg\"]] }";
    let (translations, rotation) = courses(folder.path(), text).unwrap();
    let pi = std::f64::consts::PI;
    let sine = Course::sine(0.05, 2.0, pi, 1.0);
    let ramp = Course::Ramp {
        speed: 0.1,
        over: 0.5,
    };
    let table = |rows: Vec<[f64; 2]>| Course::Table { rows: rows.into() };
    let expected = [
        along([1.0, 0.0], ramp),
        along([0.0, -1.0], sine),
        along([1.0, 0.0], table(vec![[0.0, 0.01], [1.0, 0.5]])),
    ];
    assert_eq!(translations, expected);
    let turn = table(vec![[0.0, 0.0], [60.0, pi]]);
    assert_eq!(rotation.unwrap().course, turn);
}

#[test]
fn courses_come_from_files() {
    let folder = with("gate.csv", "t,s\n0,0\n# faster\n0.1,0.02\n0.2,0.5\n");
    let text = "translate = { along = [0, 1], file = \"gate.csv\" }";
    let (translations, _) = courses(folder.path(), text).unwrap();
    let rows = [[0.0, 0.0], [0.1, 0.02], [0.2, 0.5]].into();
    assert_eq!(translations[0].course, Course::Table { rows });
}

#[test]
fn partial_slip_has_a_length() {
    let folder = tempdir().unwrap();
    let text = "box = [[0, 0], [1, 1]]\ncondition = \"partial-slip\"\nslip_length = \"2 cm\"";
    let found = scene(folder.path(), 2, text).wall["w"].condition;
    let slip = (SlipCondition::PartialSlip, Some(0.02));
    assert_eq!((found.slip, found.slip_length), slip);
}
