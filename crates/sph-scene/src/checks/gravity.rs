//! Gravity over time, and the frame of the scene.

use scene_text::Problems;

use crate::checks::dimension::Dimension;
use crate::checks::motion;
use crate::{GravityOverTime, Motion};

/// Checks the change of gravity.
pub(crate) fn over_time(given: &GravityOverTime, of: Dimension, found: &mut Problems) {
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
        if row.len() != of.0 + 1 {
            let message = format!(
                "expected a time and {} entries, found {} numbers",
                of.0,
                row.len()
            );
            return found.add(place, message);
        }
        if let Some(before) = k
            .checked_sub(1)
            .map(|k| rows[k][0])
            .filter(|t| *t >= row[0])
        {
            found.add(
                place,
                format!("times must rise, {} s follows {before} s", row[0]),
            );
        }
    }
}

/// Checks the motion of the frame: translations alone.
pub(crate) fn frame(frame: &Motion, of: Dimension, found: &mut Problems) {
    let path = "numerics.frame";
    motion::check(frame, of, path, found);
    if frame.rotate.is_some() || frame.angular_velocity != 0.0 || frame.levels.is_some() {
        found.add(
            path,
            "a frame only translates: `velocity`, `translate`, `start`, `stop`",
        );
    }
}
