//! The motion of walls.

use sph_core::unit_factor;

use crate::checks::table_check::TableCheck;
use crate::drawings::format::Format;
use crate::geometry::course::ImposedCourse;
use crate::{Levels, Motion};

pub(crate) fn check(motion: &Motion, mut check: TableCheck<'_>) {
    check.vector("velocity", &motion.velocity);
    check.vector("centre", &motion.centre);
    let turns = motion.angular_velocity != 0.0;
    check.axis(&motion.axis, turns);
    let message = "the key `centre` is missing: centre of the rotation at the start";
    check.refuse(turns && motion.centre.is_none(), "", message);
    if let Some(levels) = &motion.levels {
        check_levels(levels, motion, check.below("levels"));
    }
    let early = motion.stop.is_some_and(|stop| stop <= motion.start);
    let message = format!("it must be later than the start at {} s", motion.start);
    check.refuse(early, "stop", message);
    for (k, translate) in motion.translate.iter().enumerate() {
        let mut check = check.below(&motion.translate_key(k));
        check.direction("along", &translate.along);
        course(&translate.given(), &mut check);
    }
    if let Some(rotate) = &motion.rotate {
        let mut check = check.below("rotate");
        check.vector("centre", &rotate.centre);
        check.axis(&rotate.axis, true);
        course(&rotate.given(), &mut check);
        let message = "the rotation is given here and by `angular_velocity`: choose one";
        check.refuse(turns, "", message);
    }
}

/// Levels stand alone, in the plane, one column for each of the places, which ascend.
fn check_levels(levels: &Levels, rest: &Motion, mut check: TableCheck<'_>) {
    csv(&levels.file, &mut check);
    if let Some(Err(why)) = levels.unit.as_deref().map(|unit| unit_factor(unit, "m")) {
        check.add("unit", why);
    }
    let message = "walls follow levels in two dimensions only";
    check.refuse(check.dimension != 2, "", message);
    let turns = rest.rotate.is_some() || rest.angular_velocity != 0.0;
    let shifts = rest.velocity.is_some() || !rest.translate.is_empty();
    let moves = turns || shifts || rest.start != 0.0 || rest.stop.is_some();
    let message = "a wall that follows levels has no other motion, start or stop";
    check.refuse(moves, "", message);
    let (places, columns) = (levels.places.len(), levels.columns.len());
    let message = format!("{columns} columns for {places} places");
    check.refuse(places != columns, "columns", message);
    if let Some([before, after]) = levels.places.array_windows().find(|[a, b]| a >= b) {
        let message = format!("places must ascend, {after} m follows {before} m");
        check.add("places", message);
    }
}

/// There is exactly one course, the times of a table rise, and the keys of the form of a file need one; a unit and a
/// factor are the same thing.
fn course(given: &ImposedCourse<'_>, check: &mut TableCheck<'_>) {
    let all = "`speed`, `ramp`, `sine`, `table` or `file`";
    (check.found).one_of(&given.keys, &check.path, "course", [all, ""]);
    let rows = given.rows;
    if let Some(table) = &rows.table {
        rising(table, check.below("table"));
    }
    if let Some(file) = &rows.file {
        csv(file, check);
    }
    let of_file = scene_text::given([
        ("unit", rows.unit.is_some()),
        ("scale", rows.scale.is_some()),
        ("time_unit", rows.time_unit.is_some()),
        ("columns", rows.columns.is_some()),
    ]);
    if let Some(key) = of_file.first().filter(|_| rows.file.is_none()) {
        check.add(key, "this says how a `file` is read, and there is none");
    }
    let message = "the numbers have a `unit` or a `scale`, not both";
    check.refuse(rows.unit.is_some() && rows.scale.is_some(), "unit", message);
    if let Err((key, why)) = given.form() {
        check.add(key, why);
    }
}

fn rising(rows: &[[f64; 2]], mut check: TableCheck<'_>) {
    let message = format!("a course needs at least 2 rows, found {}", rows.len());
    check.refuse(rows.len() < 2, "", message);
    if let Some(k) = rows.windows(2).position(|p| p[0][0] >= p[1][0]) {
        let (before, after) = (rows[k][0], rows[k + 1][0]);
        let message = format!("times must rise, {after} s follows {before} s");
        check.add(&format!("[{}]", k + 1), message);
    }
}

fn csv(file: &str, check: &mut TableCheck<'_>) {
    let message = format!("expected a file that ends in .csv, .dat or .txt, found `{file}`");
    let other = Format::from_name(file) != Some(Format::Table);
    check.refuse(other, "file", message);
}
