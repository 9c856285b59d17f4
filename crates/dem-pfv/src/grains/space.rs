//! Axes along which space repeats itself.

use crate::grains::setup::Period;
use crate::grains::{GrainError, Vector};

/// Vector from `b` to the nearest image of `a`, m.
#[inline]
pub(crate) fn separation(a: &Vector, b: &Vector, period: &Period) -> Vector {
    let mut d = a - b;
    for (axis, ends) in period.iter().enumerate() {
        if let Some([from, to]) = ends {
            let length = to - from;
            if d[axis] > 0.5 * length {
                d[axis] -= length;
            } else if d[axis] < -0.5 * length {
                d[axis] += length;
            }
        }
    }
    d
}

/// Brings a point back into the period. It is done at every step, so that positions do not depend on when
/// lists are renewed.
#[inline]
pub(crate) fn wrap(point: &mut Vector, period: &Period) {
    for (axis, ends) in period.iter().enumerate() {
        if let Some([from, to]) = ends {
            let x = point[axis];
            if x < *from || x >= *to {
                point[axis] = from + (x - from).rem_euclid(to - from);
            }
        }
    }
}

/// Ends of a period are finite, in order, and far enough apart that a pair touches only once.
pub(crate) fn check(period: &Period, reach: f64) -> Result<(), GrainError> {
    for (axis, ends) in period.iter().enumerate() {
        if let Some([from, to]) = ends {
            let length = to - from;
            let least = 2.0 * reach;
            if !(length.is_finite() && length > least) {
                return Err(GrainError::ShortPeriod(axis, length, least));
            }
        }
    }
    Ok(())
}
