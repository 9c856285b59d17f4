//! The outline of a thin plate.

use crate::geometry::checks::check_points;
use crate::{BoundaryError, Polyline, Result};

/// Sharpest fold that can be mitred: 1 + cos(turn) must exceed this (a turn of about 162°).
const MITRE_LIMIT: f64 = 0.05;

/// The closed outline of a plate with fluid on both sides: two opposite faces and two caps.
///
/// `points` is the middle line and `thickness` ≥ 0 is in metres. Corners are mitred: the faces pass at ± thickness/2 ·
/// (n₁ + n₂)/(1 + n₁·n₂) from a corner between edges of normals n₁ and n₂. The outline runs clockwise around the plate.
/// At zero thickness it goes forth and back over the same points: there is one vertex per side along the plate (θ = 1/2
/// on a straight stretch), and one at each end with fluid all around (θ = 1).
///
/// # Errors
/// Fewer than two points, coincident or non-finite points, a negative thickness, or a fold too sharp to be mitred.
pub fn thin_plate(
    name: impl Into<String>,
    points: &[[f64; 2]],
    thickness: f64,
) -> Result<Polyline> {
    let middle = Polyline::open(name, points.to_vec());
    check_points(&middle)?;
    if !(thickness >= 0.0 && thickness.is_finite()) {
        return Err(BoundaryError::not_positive("plate thickness", thickness));
    }
    let last = points.len() - 1;
    if thickness == 0.0 {
        let back = (1..last).rev().map(|i| points[i]);
        let around = points.iter().copied().chain(back);
        return Ok(Polyline::closed(middle.name, around.collect()));
    }
    let left = |[a, b]: [[f64; 2]; 2]| {
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = x.hypot(y);
        [-y / length, x / length]
    };
    let normals: Vec<[f64; 2]> = middle.edges().map(left).collect();
    let mut outline = Vec::with_capacity(2 * points.len());
    let mut other_side = Vec::with_capacity(points.len());
    for (i, &[x, y]) in points.iter().enumerate() {
        let before = normals[i.saturating_sub(1)];
        let after = normals[i.min(last - 1)];
        let bend = 1.0 + before[0] * after[0] + before[1] * after[1];
        if bend < MITRE_LIMIT {
            return Err(BoundaryError(format!(
                "plate `{}` turns too sharply at point {i} to be given a thickness",
                middle.name
            )));
        }
        let offset = [0, 1].map(|k| 0.5 * thickness * (before[k] + after[k]) / bend);
        outline.push([x + offset[0], y + offset[1]]);
        other_side.push([x - offset[0], y - offset[1]]);
    }
    outline.extend(other_side.into_iter().rev());
    Ok(Polyline::closed(middle.name, outline))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plate_is_clockwise_and_as_thick_as_asked() {
        let plate = thin_plate("plate", &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]], 0.1).unwrap();
        assert_eq!(plate.points.len(), 6);
        // Middle line times thickness.
        assert!((plate.signed_area() + 0.3).abs() < 1e-15);
    }

    #[test]
    fn plate_of_zero_thickness_goes_forth_and_back() {
        let plate = thin_plate("plate", &[[0.0, 0.0], [1.0, 0.0], [2.0, 1.0]], 0.0).unwrap();
        let expected = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [1.0, 0.0]];
        assert_eq!(plate, Polyline::closed("plate", expected));
    }

    #[test]
    fn folds_and_negative_thickness_are_refused() {
        let fold = thin_plate("p", &[[0.0, 0.0], [1.0, 0.0], [0.0, 0.01]], 0.1);
        assert_eq!(
            fold.unwrap_err().to_string(),
            "plate `p` turns too sharply at point 1 to be given a thickness"
        );
        assert!(thin_plate("p", &[[0.0, 0.0], [1.0, 0.0]], -1.0).is_err());
    }
}
