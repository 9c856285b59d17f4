//! Numbers that follow the time, and profiles along a face.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::{OpenRefusal, OpenSetting};

/// Straight lines between points of a table; what is beyond its ends is that of the end.
pub(crate) fn between(table: &[[f64; 2]], x: f64) -> f64 {
    let after = table.partition_point(|[at, _]| *at <= x);
    match (after.checked_sub(1).map(|k| table[k]), table.get(after)) {
        (Some([a, f]), Some([b, g])) => f + (g - f) * (x - a) / (b - a),
        (Some([_, f]), None) => f,
        (None, Some([_, g])) => *g,
        (None, None) => 1.0,
    }
}

/// Refuses tables that are no function.
fn check(key: &str, table: &[[f64; 2]]) -> Result<(), OpenRefusal> {
    let rises = table.windows(2).all(|w| w[0][0] < w[1][0]);
    let finite = table.iter().flatten().all(|x| x.is_finite());
    if table.is_empty() || !rises || !finite {
        let why = "a table has pairs of finite numbers, the first of them rising";
        return Err(OpenRefusal::of(key, why));
    }
    Ok(())
}

/// Times, s, and factors of a value between which it goes straight: `[[0, 0], [0.5, 1], [10, 1]]`.
pub(crate) type Course = Option<Vec<[f64; 2]>>;

/// The factor at a time.
pub(crate) fn factor(course: &Course, time: f64) -> f64 {
    course.as_ref().map_or(1.0, |table| between(table, time))
}

/// Refuses a course that does not last as long as the run.
pub(crate) fn check_course(course: &Course, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
    let Some(table) = course else {
        return Ok(());
    };
    check("over_time", table)?;
    let (first, last) = (table[0][0], table[table.len() - 1][0]);
    if first > 0.0 || last < setting.end {
        return Err(OpenRefusal::of(
            "over_time",
            format!(
                "the table lasts from {first} s to {last} s, and the run from 0 to {} s: add what is missing",
                setting.end
            ),
        ));
    }
    Ok(())
}

/// How a velocity is shared out along a face, as factors of it; s goes from 0 to 1 from the first corner of the drawing.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Profile {
    /// The same everywhere.
    #[default]
    Uniform,
    /// 4 s (1 − s): the velocity is that of the middle.
    Parabola,
    /// Coefficients of 1, s, s², …
    Polynomial(Vec<f64>),
    /// Pairs of s and factor, straight between them.
    Table(Vec<[f64; 2]>),
}

impl Profile {
    /// The factor at a place.
    pub fn at(&self, s: f64) -> f64 {
        match self {
            Profile::Uniform => 1.0,
            Profile::Parabola => 4.0 * s * (1.0 - s),
            Profile::Polynomial(c) => c.iter().rev().fold(0.0, |sum, c| sum * s + c),
            Profile::Table(table) => between(table, s),
        }
    }

    /// The largest factor.
    pub(crate) fn largest(&self) -> f64 {
        (0..=1000)
            .map(|k| self.at(k as f64 * 1e-3).abs())
            .fold(0.0, f64::max)
    }

    /// Refuses what is no profile along a line.
    pub(crate) fn check(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        match self {
            Profile::Uniform => return Ok(()),
            Profile::Parabola => {}
            Profile::Polynomial(c) if c.iter().all(|c| c.is_finite()) => {}
            Profile::Polynomial(_) => {
                return Err(OpenRefusal::of("profile", "a coefficient is not finite"));
            }
            Profile::Table(table) => check("profile.table", table)?,
        }
        match setting.dimension {
            2 => Ok(()),
            _ => Err(OpenRefusal::of(
                "profile",
                "a profile goes along a line: in three dimensions it is `uniform`",
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_straight_between_their_points_and_stay_beyond() {
        let table = [[0.0, 1.0], [2.0, 3.0]];
        assert_eq!(
            [-1.0, 0.0, 0.5, 2.0, 9.0].map(|x| between(&table, x)),
            [1.0, 1.0, 1.5, 3.0, 3.0]
        );
    }

    #[test]
    fn a_polynomial_is_the_parabola() {
        let by_hand = Profile::Polynomial(vec![0.0, 4.0, -4.0]);
        for s in [0.0, 0.3, 0.5, 1.0] {
            assert!((by_hand.at(s) - Profile::Parabola.at(s)).abs() < 1e-15);
        }
        assert!((by_hand.largest() - 1.0).abs() < 1e-12);
    }
}
