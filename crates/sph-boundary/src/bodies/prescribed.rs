//! Times of prescribed motion of a body, against all forces.

use nalgebra::{Vector3, Vector6};
use sph_core::{Vect, parameters};

use crate::bodies::spatial_vector::{padded, parts, six};
use crate::{MoverRefusal, RigidState};

/// A time in which the body moves as given: it keeps the velocities that it had, or takes those of a course.
///
/// Forces on it are measured all the same, and nothing stops it.
///
/// ```toml
/// [[wall.float.mover.rigid-body.prescribed]]
/// from = "1 s"
/// to = "2 s"
/// course = [[1.0, 0.0, 0.1, 0.0], [2.0, 0.0, -0.1, 0.0]]
/// ```
#[parameters]
pub struct Prescribed {
    /// When it begins, s.
    #[parameter(unit: "s", min: 0.0)]
    pub from: f64,
    /// When the body is free again, s.
    #[parameter(unit: "s", above: 0.0)]
    pub to: f64,
    /// Times, s, each with the velocity of the centre, m/s, and the angular velocity then, rad/s: `[t, u_x, u_y, ω]` in
    /// two dimensions, `[t, u_x, u_y, u_z, ω_x, ω_y, ω_z]` in three; straight between them. Without it the body keeps
    /// its velocity.
    #[parameter(default, examples: [[[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.1, 0.0]]])]
    pub course: Vec<Vec<f64>>,
}

/// Refuses times that are not one after the other, incomplete courses, and those that move a point of the body,
/// at most `radius` m from its centre, faster than `sound`, m/s.
pub(crate) fn check<const D: usize>(
    all: &[Prescribed],
    start: f64,
    [radius, sound]: [f64; 2],
) -> Result<(), MoverRefusal> {
    let columns = if D == 2 { 4 } else { 7 };
    let mut before = start;
    for (k, one) in all.iter().enumerate() {
        let refused = |key: &str, why: String| {
            Err(MoverRefusal::at_key(format!("prescribed[{k}].{key}"), why))
        };
        let times = [("from", one.from), ("to", one.to)];
        if let Some((key, time)) = times.into_iter().find(|(_, time)| !time.is_finite()) {
            return refused(key, format!("{time} s is no time"));
        }
        if one.from < before {
            let what = match k {
                0 => "the body is free from `start` on",
                _ => "the time before it ends",
            };
            let why = format!("{} s is before {before} s, when {what}", one.from);
            return refused("from", why);
        }
        if one.to <= one.from {
            return refused("to", format!("{} s is not after {} s", one.to, one.from));
        }
        before = one.to;
        let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut last = f64::NEG_INFINITY;
        for (n, row) in one.course.iter().enumerate() {
            let refused_row = |why: String| refused("course", format!("row {n} {why}"));
            let found = row.len();
            if found != columns {
                return refused_row(format!("has {found} numbers, {columns} are expected"));
            }
            if !row.iter().all(|x| x.is_finite()) {
                return refused_row("has a number that is not finite".into());
            }
            let speed = size(&row[1..=D]) + radius * size(&row[D + 1..]);
            if speed >= sound {
                return refused_row(format!(
                    "moves the body with {speed:.3e} m/s, faster than sound, {sound:.3} m/s"
                ));
            }
            if row[0] <= last {
                let why = format!("the time of row {n} is not after that of the row before it");
                return refused("course", why);
            }
            last = row[0];
        }
        let ends = one.course.first().zip(one.course.last());
        if ends.is_some_and(|(first, last)| first[0] > one.from || last[0] < one.to) {
            let why = format!("it does not cover {} to {} s", one.from, one.to);
            return refused("course", why);
        }
    }
    Ok(())
}

/// Velocities and accelerations of a body, along the axes and about them.
pub(crate) type ImposedMotion = [Vector6<f64>; 2];

impl Prescribed {
    pub(crate) fn holds(&self, time: f64) -> bool {
        self.from <= time && time < self.to
    }

    /// Its course at a time; nothing without a course.
    pub(crate) fn at(&self, time: f64) -> Option<ImposedMotion> {
        let place = self.course.partition_point(|row| row[0] <= time);
        // A course has two rows at least: it covers a time.
        let last = self.course.len().checked_sub(1).filter(|last| *last > 0)?;
        let next = place.clamp(1, last);
        let [a, b] = [next - 1, next].map(|k| &self.course[k][..]);
        let of = |row: &[f64]| {
            let (along, about) = row[1..].split_at(row.len() / 2);
            let about = match about {
                [turn] => Vector3::new(0.0, 0.0, *turn),
                _ => padded(about),
            };
            six(padded(along), about)
        };
        let (from, to) = (of(a), of(b));
        let slope = (to - from) / (b[0] - a[0]);
        let gone = (time - a[0]).clamp(0.0, b[0] - a[0]);
        Some([from + slope * gone, slope])
    }
}

/// The state after a step in which the body has velocities that are given, or keeps its own.
pub(crate) fn moved<const D: usize>(
    now: &RigidState<D>,
    given: Option<ImposedMotion>,
    dt: f64,
) -> RigidState<D> {
    let mut state = *now;
    let (mut along, mut about) = (Vector3::zeros(), Vector3::zeros());
    if let Some([velocity, acceleration]) = given {
        let (velocity, turning) = parts(&velocity);
        state.velocity = Vect::from_fn(|k, _| velocity[k]);
        state.angular_velocity = turning.into();
        (along, about) = parts(&acceleration);
    }
    state.acceleration = Vect::from_fn(|k, _| along[k]);
    state.angular_acceleration = about.into();
    let place = Vect::from(now.pose.translation) + state.velocity * dt;
    state.pose.translation = place.into();
    state.turned_by(state.angular_velocity.map(|w| w * dt))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(from: f64, to: f64, course: &[&[f64]]) -> Prescribed {
        let course = course.iter().map(|row| row.to_vec()).collect();
        Prescribed { from, to, course }
    }

    #[test]
    fn a_course_is_straight_between_its_rows() {
        let rows = [
            [1.0, 0.0, 2.0, 1.0],
            [2.0, 0.0, 4.0, 0.0],
            [3.0, 1.0, 4.0, 0.0],
        ];
        let course = one(1.0, 3.0, &[&rows[0], &rows[1], &rows[2]]);
        assert!(course.holds(1.0) && !course.holds(3.0));
        let numbers = |x: f64, y: f64, about: f64| {
            six(Vector3::new(x, y, 0.0), Vector3::new(0.0, 0.0, about))
        };
        let middle = [numbers(0.0, 3.0, 0.5), numbers(0.0, 2.0, -1.0)];
        assert_eq!(course.at(1.5), Some(middle));
        let corner = [numbers(0.0, 4.0, 0.0), numbers(1.0, 0.0, 0.0)];
        assert_eq!(course.at(2.0), Some(corner));
        // The step that goes beyond its end.
        let end = [numbers(1.0, 4.0, 0.0), numbers(1.0, 0.0, 0.0)];
        assert_eq!(course.at(3.1), Some(end));
        assert!(one(1.0, 2.0, &[]).at(1.0).is_none());
    }

    #[test]
    fn invalid_tables_are_refused_with_their_key() {
        let why = |all: &[Prescribed]| match check::<2>(all, 0.5, [1.0, 1500.0]) {
            Ok(()) => String::new(),
            Err(MoverRefusal { key, why }) => format!("{key}: {why}"),
        };
        let row = [0.0; 4];
        assert_eq!(why(&[one(0.5, 1.0, &[]), one(1.0, 2.0, &[])]), "");
        let refused = |all: &[Prescribed], expected: &str| {
            assert!(why(all).starts_with(expected), "{}", why(all));
        };
        let before = "prescribed[0].from: 0.4 s is before 0.5 s";
        refused(&[one(0.4, 1.0, &[])], before);
        let before = "prescribed[1].from: 1.5 s is before 2 s";
        refused(&[one(1.0, 2.0, &[]), one(1.5, 3.0, &[])], before);
        let time = |from: f64, to: f64, expected: &str| refused(&[one(from, to, &[])], expected);
        time(1.0, 1.0, "prescribed[0].to: 1 s is not after 1 s");
        time(f64::NAN, 1.0, "prescribed[0].from: NaN s is no time");
        time(1.0, f64::INFINITY, "prescribed[0].to: inf s is no time");
        let course = |rows: &[&[f64]], expected: &str| {
            let expected = format!("prescribed[0].course: {expected}");
            refused(&[one(1.0, 2.0, rows)], &expected);
        };
        course(&[&row[..3]], "row 0 has 3 numbers, 4");
        let not_finite = [3.0, 0.0, f64::NAN, 0.0];
        course(
            &[&row, &not_finite],
            "row 1 has a number that is not finite",
        );
        course(&[&row, &row], "the time of row 1");
        course(&[&row], "it does not cover 1 to 2 s");
    }
}
