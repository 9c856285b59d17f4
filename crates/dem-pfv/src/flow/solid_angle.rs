//! Solid angles.

use nalgebra::Vector3;

/// Signed solid angle ω (sr, −2π to 2π) under which a triangle a, b, c is seen from the origin:
///
/// ```text
/// tan(ω/2) = a · (b × c) / (|a| |b| |c| + (a·b) |c| + (a·c) |b| + (b·c) |a|)
/// ```
///
/// positive if a, b, c turn right-handed around a + b + c. The quadrant matters: where the denominator is
/// negative, the plain arc tangent is wrong by up to 2π. Lengths of a, b, c do not matter. Source: Van Oosterom
/// & Strackee 1983.
pub fn solid_angle(a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>) -> f64 {
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let volume = a.dot(&b.cross(&c));
    let sum = la * lb * lc + a.dot(&b) * lc + a.dot(&c) * lb + b.dot(&c) * la;
    2.0 * volume.atan2(sum)
}
