//! Mistakes of walls: their places, their motion, their condition for the fluid.

use scene_text::{Problems, given, suggestion, unit_factor};

use crate::scene::names::{BOX, periodic, planes};
use crate::scene::tables::{Scene, Wall};

/// Mistakes of a wall.
pub fn wall(scene: &Scene, name: &str, wall: &Wall, found: &mut Problems) {
    place(scene, name, wall, found);
    of_file(name, wall, found);
    motions(scene, name, wall, found);
    conditions(scene, name, wall, found);
}

fn place(scene: &Scene, name: &str, wall: &Wall, found: &mut Problems) {
    let at = |key: &str| format!("wall.{name}.{key}");
    let boxed = BOX.iter().position(|b| *b == name);
    match boxed {
        Some(number) => {
            for key in given([
                ("point", wall.point.is_some()),
                ("normal", wall.normal.is_some()),
                ("file", wall.file.is_some()),
                ("spin", wall.spin.is_some()),
            ]) {
                found.add(at(key), "a wall of the box has its place from `[box]`");
            }
            let why = match &scene.r#box {
                None => Some("there is no `[box]`"),
                Some(_) if periodic(scene, number / 2) => Some("the box is periodic there"),
                Some(b) if b.open.iter().any(|o| o == name) => Some("the box is open there"),
                Some(_) => None,
            };
            if let Some(why) = why {
                found.add(
                    format!("wall.{name}"),
                    format!("there is no such wall: {why}"),
                );
            }
        }
        None if wall.file.is_some() => {
            if wall.normal.is_some() {
                found.add(at("normal"), "a surface from a file has no normal");
            }
        }
        None => {
            if wall.point.is_none() || wall.normal.is_none() {
                let near = suggestion(name, BOX);
                let message = format!(
                    "a plane needs `point` and `normal`, a surface a `file`; it is no wall of the box{near}"
                );
                found.add(format!("wall.{name}"), message);
            }
            if wall.normal.is_some_and(|n| n.iter().all(|x| *x == 0.0)) {
                found.add(at("normal"), "has no direction");
            }
        }
    }
}

/// Keys of a surface from a file.
fn of_file(name: &str, wall: &Wall, found: &mut Problems) {
    let at = |key: &str| format!("wall.{name}.{key}");
    let of_files = given([
        ("unit", wall.unit.is_some()),
        ("scale", wall.scale.is_some()),
        ("translate", wall.translate.is_some()),
    ]);
    for key in of_files.into_iter().filter(|_| wall.file.is_none()) {
        found.add(at(key), "this belongs to a surface from a `file`");
    }
    if wall.unit.is_some() && wall.scale.is_some() {
        let message = "the coordinates have a `unit` or a `scale`, not both";
        found.add(at("unit"), message);
    }
    if let Some(Err(why)) = wall.unit.as_deref().map(|unit| unit_factor(unit, "m")) {
        found.add(at("unit"), why);
    }
}

fn motions(scene: &Scene, name: &str, wall: &Wall, found: &mut Problems) {
    let given = given([
        ("velocity", wall.velocity.is_some()),
        ("piston", wall.piston.is_some()),
        ("servo", wall.servo.is_some()),
        ("strain_rate", wall.strain_rate.is_some()),
        ("removed", wall.removed),
        ("keeps_volume", wall.keeps_volume),
    ]);
    found.at_most_one(&given, &format!("wall.{name}"));
    if wall.file.is_some() && given.iter().any(|g| *g != "velocity") {
        found.add(
            format!("wall.{name}"),
            "a surface moves by `velocity` and `spin` only",
        );
    }
    let closed = scene.r#box.as_ref().is_some_and(|b| b.open.is_empty());
    let others = || planes(scene).iter().any(|p| !BOX.contains(&p.as_str()));
    if wall.keeps_volume && (!closed || others()) {
        let message = "the volume is that of a closed `[box]` without further planes";
        found.add(format!("wall.{name}.keeps_volume"), message);
    }
    if let Some(piston) = &wall.piston
        && piston.amplitude != 0.0
        && piston.period.is_none()
    {
        found.add(
            format!("wall.{name}.piston"),
            "a stress that swings needs a `period`",
        );
    }
}

fn conditions(scene: &Scene, name: &str, wall: &Wall, found: &mut Problems) {
    let sides = given([
        ("pressure", wall.pressure.is_some()),
        ("inflow", wall.inflow.is_some()),
        ("wave", wall.wave.is_some()),
        ("recorded", wall.recorded.is_some()),
    ]);
    found.at_most_one(&sides, &format!("wall.{name}"));
    if scene.fluid.is_none() && (!sides.is_empty() || wall.sticks) {
        found.add(
            format!("wall.{name}"),
            "conditions of the fluid need a `[fluid]`",
        );
    }
}
