//! How far a segment is.

/// Squared distance from the origin to the segment between two points.
#[inline]
pub(crate) fn distance_squared(start: [f64; 2], end: [f64; 2]) -> f64 {
    let along = [end[0] - start[0], end[1] - start[1]];
    let length2 = along[0] * along[0] + along[1] * along[1];
    let foot = -(start[0] * along[0] + start[1] * along[1]);
    let part = (foot / length2).clamp(0.0, 1.0);
    let nearest = [start[0] + part * along[0], start[1] + part * along[1]];
    nearest[0] * nearest[0] + nearest[1] * nearest[1]
}
