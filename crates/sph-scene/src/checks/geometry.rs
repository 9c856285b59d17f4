//! Vectors, shapes, walls and periodic boxes.

use crate::checks::bodies::{apart, within_bounds};
use crate::checks::motion;
use crate::checks::shapes::body_geometry;
use crate::checks::table_check::TableCheck;
use crate::checks::walls::{bed, wall_geometry};
use crate::checks::zones::{check_zones, outlet};
use crate::{GravityOverTime, Motion, Scene};

/// Checks everything that has a place in space.
pub(crate) fn check(scene: &Scene, whole: &mut TableCheck<'_>) {
    let before = whole.found.0.len();
    space(scene, whole.below("numerics"));
    for (name, wall) in &scene.wall {
        wall_geometry(wall, whole.below(&format!("wall.{name}")));
    }
    for (name, body) in &scene.body {
        body_geometry(scene, body, whole.below(&format!("body.{name}")));
    }
    for (name, wall) in &scene.wall {
        bed(wall, &scene.wall, whole.below(&format!("wall.{name}")));
    }
    for (name, given) in &scene.outlet {
        outlet(given, whole.below(&format!("outlet.{name}")));
    }
    check_zones(scene, whole.below("zone"));
    if whole.found.0.len() == before {
        match scene.dimension {
            2 => places::<2>(scene, whole),
            _ => places::<3>(scene, whole),
        }
    }
}

fn places<const D: usize>(scene: &Scene, whole: &mut TableCheck<'_>) {
    within_bounds::<D>(scene, whole);
    if whole.found.0.is_empty() {
        apart::<D>(scene, whole.found);
    }
}

fn space(scene: &Scene, mut check: TableCheck<'_>) {
    let numerics = &scene.numerics;
    check.vector("gravity", &numerics.gravity);
    if let Some(course) = &numerics.gravity_over_time {
        over_time(course, check.below("gravity_over_time"));
    }
    if let Some(motion) = &numerics.frame {
        check_frame(motion, check.below("frame"));
    }
    check.vector("driving", &numerics.driving);
    if let Some(domain) = &numerics.domain {
        check.corners("domain", domain);
    }
    let dimension = check.dimension;
    for (k, (axis, bounds)) in numerics.periodic.axes().into_iter().enumerate() {
        let Some([lo, hi]) = bounds else { continue };
        let key = format!("periodic.{axis}");
        let gravity = numerics.gravity.as_ref().and_then(|g| g.get(k));
        if k >= dimension {
            check.add(&key, format!("there is no {axis} in {dimension}D"));
        } else if lo >= hi {
            let message = format!("the lower bound must be below the upper, found {lo} and {hi}");
            check.add(&key, message);
        } else if gravity.is_some_and(|g| *g != 0.0) {
            let message = format!(
                "gravity along the periodic direction {axis} has no hydrostatic balance: use `driving`"
            );
            check.add("gravity", message);
        }
    }
}

fn over_time(given: &GravityOverTime, mut check: TableCheck<'_>) {
    let courses = scene_text::given([
        ("sine", given.sine.is_some()),
        ("table", given.table.is_some()),
        ("file", given.file.is_some()),
    ]);
    let all = ["`sine`, `table` or `file`", ""];
    (check.found).one_of(&courses, &check.path, "course", all);
    if let Some(sine) = &given.sine {
        check.vector("sine.amplitude", &sine.amplitude);
    }
    let entries = check.dimension;
    if let Some(columns) = given.columns.as_ref().filter(|c| c.len() != entries + 1) {
        let message = format!("expected {} names, found {}", entries + 1, columns.len());
        check.add("columns", message);
    }
    let rows = given.table.as_deref().unwrap_or_default();
    for (k, row) in rows.iter().enumerate() {
        let (key, numbers) = (format!("table[{k}]"), row.len());
        let message = format!("expected a time and {entries} entries, found {numbers} numbers");
        if check.refuse(numbers != entries + 1, &key, message) {
            return;
        }
        let before = k.checked_sub(1).map(|k| rows[k][0]);
        if let Some(before) = before.filter(|t| *t >= row[0]) {
            let message = format!("times must rise, {} s follows {before} s", row[0]);
            check.add(&key, message);
        }
    }
}

/// Checks the motion of the frame: translations alone.
fn check_frame(frame: &Motion, mut check: TableCheck<'_>) {
    motion::check(frame, check.below(""));
    let turns = frame.rotate.is_some() || frame.angular_velocity != 0.0;
    let message = "a frame only translates: `velocity`, `translate`, `start`, `stop`";
    check.refuse(turns || frame.levels.is_some(), "", message);
}
