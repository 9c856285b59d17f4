//! The motion of walls.

use scene_text::Problems;
use sph_core::unit_factor;

use crate::checks::dimension::Dimension;
use crate::drawings::format::Format;
use crate::geometry::course::ImposedCourse;
use crate::{Levels, Motion};

/// Checks the vectors, the times and the courses of a motion.
pub(crate) fn check(motion: &Motion, of: Dimension, path: &str, found: &mut Problems) {
    of.optional(&motion.velocity, &format!("{path}.velocity"), found);
    of.optional(&motion.centre, &format!("{path}.centre"), found);
    let turns = motion.angular_velocity != 0.0;
    of.axis(&motion.axis, turns, path, found);
    if turns && motion.centre.is_none() {
        let message = "the key `centre` is missing: centre of the rotation at the start";
        found.add(path, message);
    }
    if let Some(levels) = &motion.levels {
        check_levels(levels, motion, of, &format!("{path}.levels"), found);
    }
    if motion.stop.is_some_and(|stop| stop <= motion.start) {
        let message = format!("it must be later than the start at {} s", motion.start);
        found.add(format!("{path}.stop"), message);
    }
    for (k, translate) in motion.translate.iter().enumerate() {
        let path = motion.translate_path(path, k);
        of.direction(&translate.along, &format!("{path}.along"), found);
        course(&translate.given(), &path, found);
    }
    if let Some(rotate) = &motion.rotate {
        let path = format!("{path}.rotate");
        of.vector(&rotate.centre, &format!("{path}.centre"), found);
        of.axis(&rotate.axis, true, &path, found);
        course(&rotate.given(), &path, found);
        if turns {
            let message = "the rotation is given here and by `angular_velocity`: choose one";
            found.add(path, message);
        }
    }
}

/// Levels stand alone, in the plane, one column for each of the places, which ascend.
fn check_levels(levels: &Levels, rest: &Motion, of: Dimension, path: &str, found: &mut Problems) {
    csv(&Some(levels.file.clone()), path, found);
    if let Some(Err(why)) = levels.unit.as_deref().map(|unit| unit_factor(unit, "m")) {
        found.add(format!("{path}.unit"), why);
    }
    if of.0 != 2 {
        found.add(path, "walls follow levels in two dimensions only");
    }
    let turns = rest.rotate.is_some() || rest.angular_velocity != 0.0;
    let shifts = rest.velocity.is_some() || !rest.translate.is_empty();
    if turns || shifts || rest.start != 0.0 || rest.stop.is_some() {
        let message = "a wall that follows levels has no other motion, start or stop";
        found.add(path, message);
    }
    let (places, columns) = (levels.places.len(), levels.columns.len());
    if places != columns {
        let message = format!("{columns} columns for {places} places");
        found.add(format!("{path}.columns"), message);
    }
    if let Some(k) = levels.places.windows(2).position(|p| p[0] >= p[1]) {
        let (before, after) = (levels.places[k], levels.places[k + 1]);
        let message = format!("places must ascend, {after} m follows {before} m");
        found.add(format!("{path}.places"), message);
    }
}

/// There is exactly one course, the times of a table rise, and the keys of the form of a file need one; a unit and a
/// factor are the same thing.
fn course(given: &ImposedCourse<'_>, path: &str, found: &mut Problems) {
    let all = "`speed`, `ramp`, `sine`, `table` or `file`";
    found.one_of(&given.keys(), path, "course", [all, ""]);
    if let Some(table) = &given.rows.table {
        rising(table, &format!("{path}.table"), found);
    }
    let rows = given.rows;
    csv(&rows.file, path, found);
    let of_file = scene_text::given([
        ("unit", rows.unit.is_some()),
        ("scale", rows.scale.is_some()),
        ("time_unit", rows.time_unit.is_some()),
        ("columns", rows.columns.is_some()),
    ]);
    if let Some(key) = of_file.first().filter(|_| rows.file.is_none()) {
        let message = "this says how a `file` is read, and there is none";
        found.add(format!("{path}.{key}"), message);
    }
    if rows.unit.is_some() && rows.scale.is_some() {
        let message = "the numbers have a `unit` or a `scale`, not both";
        found.add(format!("{path}.unit"), message);
    }
    if let Err((key, why)) = given.form() {
        found.add(format!("{path}.{key}"), why);
    }
}

fn rising(rows: &[[f64; 2]], place: &str, found: &mut Problems) {
    if rows.len() < 2 {
        let message = format!("a course needs at least 2 rows, found {}", rows.len());
        return found.add(place, message);
    }
    if let Some(k) = rows.windows(2).position(|p| p[0][0] >= p[1][0]) {
        let (before, after) = (rows[k][0], rows[k + 1][0]);
        let message = format!("times must rise, {after} s follows {before} s");
        found.add(format!("{place}[{}]", k + 1), message);
    }
}

fn csv(file: &Option<String>, path: &str, found: &mut Problems) {
    let Some(file) = file else { return };
    if Format::from_name(file) != Some(Format::Table) {
        let message = format!("expected a file that ends in .csv, .dat or .txt, found `{file}`");
        found.add(format!("{path}.file"), message);
    }
}
