//! Numbers that follow the time.

use crate::{OpenRefusal, OpenSetting};

/// Straight lines between points of a table; beyond its ends the value is that of the end.
pub(crate) fn interpolated(table: &[[f64; 2]], x: f64) -> f64 {
    let after = table.partition_point(|[at, _]| *at <= x);
    match (after.checked_sub(1).map(|k| table[k]), table.get(after)) {
        (Some([a, f]), Some([b, g])) => f + (g - f) * (x - a) / (b - a),
        (Some([_, f]), None) => f,
        (None, Some([_, g])) => *g,
        (None, None) => 1.0,
    }
}

/// Refuses tables that are no function.
pub(crate) fn check_table(key: &str, table: &[[f64; 2]]) -> Result<(), OpenRefusal> {
    let rises = table.windows(2).all(|w| w[0][0] < w[1][0]);
    let finite = table.iter().flatten().all(|x| x.is_finite());
    if table.is_empty() || !rises || !finite {
        let why = "a table has pairs of finite numbers, the first of them rising";
        return Err(OpenRefusal::at_key(key, why));
    }
    Ok(())
}

/// Times, s, and factors of a value between which it goes straight: `[[0, 0], [0.5, 1], [10, 1]]`.
pub(crate) type FactorTable = Option<Vec<[f64; 2]>>;

/// The factor at a time.
pub(crate) fn factor(course: &FactorTable, time: f64) -> f64 {
    course
        .as_ref()
        .map_or(1.0, |table| interpolated(table, time))
}

/// The least and the largest of a value over its course.
pub(crate) fn range(course: &FactorTable, value: f64) -> [f64; 2] {
    let table = course.as_deref().unwrap_or(&[[0.0, 1.0]]);
    let all = || table.iter().map(|[_, factor]| value * factor);
    [
        all().fold(f64::INFINITY, f64::min),
        all().fold(f64::NEG_INFINITY, f64::max),
    ]
}

/// Refuses a course that does not last as long as the run.
pub(crate) fn check_course(
    course: &FactorTable,
    setting: &OpenSetting<'_>,
) -> Result<(), OpenRefusal> {
    let Some(table) = course else {
        return Ok(());
    };
    check_table("over_time", table)?;
    let (first, last) = (table[0][0], table[table.len() - 1][0]);
    if first > 0.0 || last < setting.end {
        return Err(OpenRefusal::at_key(
            "over_time",
            format!(
                "the table lasts from {first} s to {last} s, and the run from 0 to {} s: add what is missing",
                setting.end
            ),
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_straight_between_their_points_and_stay_beyond() {
        let table = [[0.0, 1.0], [2.0, 3.0]];
        assert_eq!(
            [-1.0, 0.0, 0.5, 2.0, 9.0].map(|x| interpolated(&table, x)),
            [1.0, 1.0, 1.5, 3.0, 3.0]
        );
    }
}
