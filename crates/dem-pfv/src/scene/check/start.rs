//! Mistakes of the start: its way, numbers and sizes of grains, the box.

use scene_text::{Problems, given, suggestion};

use crate::scene::names::{BOX, planes};
use crate::scene::tables::{Scene, Weight};

/// Mistakes of the start.
pub fn start(scene: &Scene, found: &mut Problems) {
    ways(scene, found);
    numbers_and_sizes(scene, found);
    room(scene, found);
    weight(scene, found);
}

/// Checks that the grains get their places in one way alone.
fn ways(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let given = given([
        ("cloud", s.cloud.is_some()),
        ("grown", s.grown.is_some()),
        ("rained", s.rained.is_some()),
        ("lattice", s.lattice.is_some()),
        ("file", s.file.is_some()),
    ]);
    if given.is_empty() {
        found.add(
            "start",
            "one of `cloud`, `grown`, `rained`, `lattice`, `file` is missing",
        );
    }
    found.at_most_one(&given, "start");
}

/// Number and sizes of the grains, unless the start has them.
fn numbers_and_sizes(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let by_height = s.rained.as_ref().is_some_and(|r| r.height.is_some());
    let counted = (s.cloud.is_some() || s.grown.is_some() || s.rained.is_some()) && !by_height;
    match (counted, scene.grains.count) {
        (true, None) => found.add("grains", "`count` is missing"),
        (false, Some(_)) => found.add(
            "grains.count",
            "the start gives the number of grains: leave it out",
        ),
        _ => {}
    }
    if s.unit.is_some() && s.file.is_none() {
        found.add("start.unit", "this is the unit of the numbers in a `file`");
    }
    match (s.file.is_some(), scene.grains.radius) {
        (false, None) => found.add(
            "grains",
            "`radius` is missing: the smallest and the largest",
        ),
        (true, Some(_)) => found.add("grains.radius", "the file has the radii: leave it out"),
        (_, Some([low, _])) if low <= 0.0 => {
            found.add(
                "grains.radius",
                format!("must be more than 0 m, found {low}"),
            );
        }
        (_, Some([low, high])) if low > high => {
            found.add(
                "grains.radius",
                format!("{low} m to {high} m: the smallest comes first"),
            );
        }
        _ => {}
    }
    if let Some(grown) = &s.grown
        && grown.stress.is_some() == grown.porosity.is_some()
    {
        found.add("start.grown", "either `stress` or `porosity` is needed");
    }
}

/// The room that the grains start in.
fn room(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let needs_box = s.grown.is_some() || s.rained.is_some() || s.lattice.is_some();
    let corners = s
        .cloud
        .as_ref()
        .is_some_and(|c| c.low.is_some() && c.high.is_some());
    if scene.r#box.is_none() && (needs_box || (s.cloud.is_some() && !corners)) {
        found.add("start", "these grains fill a box: `[box]` is missing");
    }
    if s.headroom.is_some() && !planes(scene).iter().any(|p| p == "top") {
        found.add("start.headroom", "there is no wall `top` to be moved");
    }
    if s.headroom.is_some() && s.settle.is_none() && s.rained.is_none() {
        found.add(
            "start.headroom",
            "the grains must come to rest first: give `settle`",
        );
    }
}

/// Conditions of a bed that is flooded.
fn weight(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let settles = s
        .settle
        .map_or(s.rained.is_some(), |tolerance| tolerance < 1.0);
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
    for axis in 0..3 {
        let (low, high) = (given.low[axis], given.high[axis]);
        if low >= high {
            let message = format!("must be above the lower corner: {high} m is not above {low} m");
            found.add(format!("box.high[{axis}]"), message);
        }
    }
    for (k, name) in given.open.iter().enumerate() {
        if !BOX.contains(&name.as_str()) {
            let near = suggestion(name, BOX);
            let message = format!(
                "there is no wall `{name}` of a box{near} (there are: {})",
                BOX.join(", ")
            );
            found.add(format!("box.open[{k}]"), message);
        }
    }
}
