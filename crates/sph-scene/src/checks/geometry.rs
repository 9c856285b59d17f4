//! Vectors, shapes, walls and periodic boxes.

use scene_text::Problems;

use crate::checks::bounds::within_bounds;
use crate::checks::dimension::Dimension;
use crate::checks::shapes::body_geometry;
use crate::checks::walls::{check_beds, wall_geometry};
use crate::checks::zones::{check_zones, outlets};
use crate::checks::{motion, overlap};
use crate::{GravityOverTime, Motion, Scene};

/// Checks everything that has a place in space.
pub(crate) fn check(scene: &Scene, found: &mut Problems) {
    let before = found.0.len();
    let of = Dimension(scene.dimension);
    space(scene, of, found);
    for (name, wall) in &scene.wall {
        wall_geometry(wall, of, &format!("wall.{name}"), found);
    }
    for (name, body) in &scene.body {
        body_geometry(scene, body, of, &format!("body.{name}"), found);
    }
    check_beds(&scene.wall, of, found);
    outlets(scene, of, found);
    check_zones(scene, of, found);
    if found.0.len() == before {
        match scene.dimension {
            2 => places::<2>(scene, found),
            _ => places::<3>(scene, found),
        }
    }
}

fn places<const D: usize>(scene: &Scene, found: &mut Problems) {
    within_bounds::<D>(scene, found);
    if found.0.is_empty() {
        overlap::check::<D>(scene, found);
    }
}

fn space(scene: &Scene, of: Dimension, found: &mut Problems) {
    let numerics = &scene.numerics;
    of.optional(&numerics.gravity, "numerics.gravity", found);
    if let Some(course) = &numerics.gravity_over_time {
        over_time(course, of, found);
    }
    if let Some(motion) = &numerics.frame {
        check_frame(motion, of, found);
    }
    of.optional(&numerics.driving, "numerics.driving", found);
    if let Some(domain) = &numerics.domain {
        of.corners(domain, "numerics.domain", found);
    }
    for (k, (axis, bounds)) in numerics.periodic.axes().into_iter().enumerate() {
        let Some([lo, hi]) = bounds else { continue };
        let path = format!("numerics.periodic.{axis}");
        let gravity = numerics.gravity.as_ref().and_then(|g| g.get(k));
        if k >= of.0 {
            found.add(path, format!("there is no {axis} in {}D", of.0));
        } else if lo >= hi {
            let message = format!("the lower bound must be below the upper, found {lo} and {hi}");
            found.add(path, message);
        } else if gravity.is_some_and(|g| *g != 0.0) {
            let message = format!(
                "gravity along the periodic direction {axis} has no hydrostatic balance: use `driving`"
            );
            found.add("numerics.gravity", message);
        }
    }
}

/// Checks the change of gravity.
fn over_time(given: &GravityOverTime, of: Dimension, found: &mut Problems) {
    let path = "numerics.gravity_over_time";
    let courses = scene_text::given([
        ("sine", given.sine.is_some()),
        ("table", given.table.is_some()),
        ("file", given.file.is_some()),
    ]);
    found.one_of(&courses, path, "course", ["`sine`, `table` or `file`", ""]);
    if let Some(sine) = &given.sine {
        of.vector(&sine.amplitude, &format!("{path}.sine.amplitude"), found);
    }
    if let Some(columns) = given.columns.as_ref().filter(|c| c.len() != of.0 + 1) {
        let message = format!("expected {} names, found {}", of.0 + 1, columns.len());
        found.add(format!("{path}.columns"), message);
    }
    let rows = given.table.as_deref().unwrap_or_default();
    for (k, row) in rows.iter().enumerate() {
        let place = format!("{path}.table[{k}]");
        let (wanted, given) = (of.0, row.len());
        if given != wanted + 1 {
            let message = format!("expected a time and {wanted} entries, found {given} numbers");
            return found.add(place, message);
        }
        let before = k.checked_sub(1).map(|k| rows[k][0]);
        if let Some(before) = before.filter(|t| *t >= row[0]) {
            let message = format!("times must rise, {} s follows {before} s", row[0]);
            found.add(place, message);
        }
    }
}

/// Checks the motion of the frame: translations alone.
fn check_frame(frame: &Motion, of: Dimension, found: &mut Problems) {
    let path = "numerics.frame";
    motion::check(frame, of, path, found);
    if frame.rotate.is_some() || frame.angular_velocity != 0.0 || frame.levels.is_some() {
        let message = "a frame only translates: `velocity`, `translate`, `start`, `stop`";
        found.add(path, message);
    }
}
