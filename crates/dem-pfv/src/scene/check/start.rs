//! Mistakes of the start, the box and the walls: ways, numbers and sizes, places, motions, conditions for the fluid.

use scene_text::{Problems, given, suggestion, unit_factor};

use super::refuse;
use crate::scene::{BOX, Cloud, Grown, Piston, Scene, Wall, Weight, periodic, planes};

/// Mistakes of the start: more than one way, or none.
pub fn start(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let given = given([
        ("cloud", s.cloud.is_some()),
        ("grown", s.grown.is_some()),
        ("rained", s.rained.is_some()),
        ("lattice", s.lattice.is_some()),
        ("file", s.file.is_some()),
    ]);
    let none = "one of `cloud`, `grown`, `rained`, `lattice`, `file` is missing";
    refuse(found, "start", [(given.is_empty(), "", none)]);
    found.at_most_one(&given, "start");
    numbers_and_sizes(scene, found);
    room(scene, found);
    weight(scene, found);
}

/// Number and sizes of the grains, unless the start has them.
fn numbers_and_sizes(scene: &Scene, found: &mut Problems) {
    let (s, grains) = (&scene.start, &scene.grains);
    let by_height = s.rained.as_ref().is_some_and(|r| r.height.is_some());
    let counted = (s.cloud.is_some() || s.grown.is_some() || s.rained.is_some()) && !by_height;
    let (count, radius, file) = (grains.count, grains.radius, s.file.is_some());
    let unit = s.unit.is_some() && !file;
    let given = "the start gives the number of grains: leave it out";
    let of_file = "this is the unit of the numbers in a `file`";
    let missing = "`radius` is missing: the smallest and the largest";
    let twice = "the file has the radii: leave it out";
    let targets = |g: &Grown| g.stress.is_some() == g.porosity.is_some();
    let targets = s.grown.as_ref().is_some_and(targets);
    let target = "either `stress` or `porosity` is needed";
    let [low, high] = radius.filter(|_| !file).unwrap_or([1.0; 2]);
    let least = format!("must be more than 0 m, found {low}");
    let order = format!("{low} m to {high} m: the smallest comes first");
    let rules = [
        (counted && count.is_none(), "grains", "`count` is missing"),
        (!counted && count.is_some(), "grains.count", given),
        (unit, "start.unit", of_file),
        (!file && radius.is_none(), "grains", missing),
        (file && radius.is_some(), "grains.radius", twice),
        (low <= 0.0, "grains.radius", &least),
        (low > 0.0 && low > high, "grains.radius", &order),
        (targets, "start.grown", target),
    ];
    refuse(found, "", rules);
}

/// The room that the grains start in.
fn room(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let needs_box = s.grown.is_some() || s.rained.is_some() || s.lattice.is_some();
    let inside = |c: &Cloud| c.low.is_none() || c.high.is_none();
    let within = s.cloud.as_ref().is_some_and(inside);
    let no_box = scene.r#box.is_none() && (needs_box || within);
    let lowered = s.headroom.is_some();
    let no_top = lowered && !planes(scene).iter().any(|p| p == "top");
    let loose = lowered && s.settle.is_none() && s.rained.is_none();
    let rest = "the grains must come to rest first: give `settle`";
    let rules = [
        (no_box, "", "these grains fill a box: `[box]` is missing"),
        (no_top, "headroom", "there is no wall `top` to be moved"),
        (loose, "headroom", rest),
    ];
    refuse(found, "start", rules);
}

/// Conditions of a bed that is flooded.
fn weight(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let rained = s.rained.is_some();
    let settles = s.settle.map_or(rained, |tolerance| tolerance < 1.0);
    let missing = given([
        ("a `[fluid]`", scene.fluid.is_none()),
        ("`grains.gravity`", scene.grains.gravity.is_none()),
        ("`settle` below 1", !settles),
    ]);
    if let (Weight::Dry, [what, ..]) = (s.weight, missing.as_slice()) {
        let message = format!("a dry bed is flooded once it rests: {what} is missing");
        found.add("start.weight", message);
    }
}

/// Mistakes of the box.
pub fn boxed(scene: &Scene, found: &mut Problems) {
    let Some(given) = &scene.r#box else { return };
    for (axis, (low, high)) in given.low.iter().zip(&given.high).enumerate() {
        if low >= high {
            let message = format!("must be above the lower corner: {high} m is not above {low} m");
            found.add(format!("box.high[{axis}]"), message);
        }
    }
    for (k, name) in given.open.iter().enumerate() {
        if !BOX.contains(&name.as_str()) {
            let (near, all) = (suggestion(name, BOX), BOX.join(", "));
            let message = format!("there is no wall `{name}` of a box{near} (there are: {all})");
            found.add(format!("box.open[{k}]"), message);
        }
    }
}

/// Mistakes of a wall.
pub fn wall(scene: &Scene, name: &str, wall: &Wall, found: &mut Problems) {
    let path = format!("wall.{name}");
    place(scene, name, wall, &path, found);
    of_file(wall, &path, found);
    motions(scene, wall, &path, found);
    conditions(scene, wall, &path, found);
}

fn place(scene: &Scene, name: &str, wall: &Wall, path: &str, found: &mut Problems) {
    let (file, normal) = (wall.file.is_some(), wall.normal.is_some());
    let Some(number) = BOX.iter().position(|b| *b == name) else {
        let near = suggestion(name, BOX);
        let placed =
            "a plane needs `point` and `normal`, a surface a `file`; it is no wall of the box";
        let nowhere = !file && (wall.point.is_none() || !normal);
        let flat = !file && wall.normal.is_some_and(|n| n.iter().all(|x| *x == 0.0));
        let curved = "a surface from a file has no normal";
        let rules = [
            (file && normal, "normal", curved),
            (nowhere, "", &format!("{placed}{near}")),
            (flat, "normal", "has no direction"),
        ];
        return refuse(found, path, rules);
    };
    let fixed = "a wall of the box has its place from `[box]`";
    let no_box = scene.r#box.is_none();
    let periodic = periodic(scene, number / 2);
    let mut open = scene.r#box.iter().flat_map(|b| &b.open);
    let open = !periodic && open.any(|o| o == name);
    let repeats = "there is no such wall: the box is periodic there";
    let rules = [
        (wall.point.is_some(), "point", fixed),
        (normal, "normal", fixed),
        (file, "file", fixed),
        (wall.spin.is_some(), "spin", fixed),
        (no_box, "", "there is no such wall: there is no `[box]`"),
        (periodic, "", repeats),
        (open, "", "there is no such wall: the box is open there"),
    ];
    refuse(found, path, rules);
}

/// Keys of a surface from a file.
fn of_file(wall: &Wall, path: &str, found: &mut Problems) {
    let (unit, scale) = (wall.unit.is_some(), wall.scale.is_some());
    let no_file = wall.file.is_none();
    let message = "this belongs to a surface from a `file`";
    let both = "the coordinates have a `unit` or a `scale`, not both";
    let why = wall.unit.as_deref().map(|unit| unit_factor(unit, "m"));
    let why = why.and_then(Result::err);
    let rules = [
        (no_file && unit, "unit", message),
        (no_file && scale, "scale", message),
        (no_file && wall.translate.is_some(), "translate", message),
        (unit && scale, "unit", both),
        (why.is_some(), "unit", why.as_deref().unwrap_or_default()),
    ];
    refuse(found, path, rules);
}

fn motions(scene: &Scene, wall: &Wall, path: &str, found: &mut Problems) {
    let given = given([
        ("velocity", wall.velocity.is_some()),
        ("piston", wall.piston.is_some()),
        ("servo", wall.servo.is_some()),
        ("strain_rate", wall.strain_rate.is_some()),
        ("removed", wall.removed),
        ("keeps_volume", wall.keeps_volume),
    ]);
    found.at_most_one(&given, path);
    let steered = wall.file.is_some() && given.iter().any(|g| *g != "velocity");
    let closed = scene.r#box.as_ref().is_some_and(|b| b.open.is_empty());
    let others = || planes(scene).iter().any(|p| !BOX.contains(&p.as_str()));
    let no_volume = wall.keeps_volume && (!closed || others());
    let volume = "the volume is that of a closed `[box]` without further planes";
    let swings = |p: &Piston| p.amplitude != 0.0 && p.period.is_none();
    let swings = wall.piston.as_ref().is_some_and(swings);
    let rules = [
        (steered, "", "a surface moves by `velocity` and `spin` only"),
        (no_volume, "keeps_volume", volume),
        (swings, "piston", "a stress that swings needs a `period`"),
    ];
    refuse(found, path, rules);
}

fn conditions(scene: &Scene, wall: &Wall, path: &str, found: &mut Problems) {
    let sides = given([
        ("pressure", wall.pressure.is_some()),
        ("inflow", wall.inflow.is_some()),
        ("wave", wall.wave.is_some()),
        ("recorded", wall.recorded.is_some()),
    ]);
    found.at_most_one(&sides, path);
    let dry = scene.fluid.is_none() && (!sides.is_empty() || wall.sticks);
    let message = "conditions of the fluid need a `[fluid]`";
    refuse(found, path, [(dry, "", message)]);
}
