//! Lists of numbers as arrays of D components.

/// The first D entries; absent ones are zero (a validated list has exactly D).
pub(crate) fn array<const D: usize>(list: &[f64]) -> [f64; D] {
    std::array::from_fn(|k| list.get(k).copied().unwrap_or(0.0))
}

/// Distance of two points.
pub(crate) fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let square: f64 = a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum();
    square.sqrt()
}

/// `(0.1, 0.2)` for messages.
pub(crate) fn point(x: &[f64]) -> String {
    let rounded = x.iter().map(|c| (c * 1e9).round() / 1e9);
    let text: Vec<String> = rounded.map(|c| c.to_string()).collect();
    format!("({})", text.join(", "))
}

/// The unit vector of an axis; that of z where none is given.
pub(crate) fn unit_axis(axis: &Option<Vec<f64>>) -> [f64; 3] {
    let axis = axis.as_deref().and_then(unit);
    axis.map_or([0.0, 0.0, 1.0], |a| array(&a))
}

/// The unit vector of a direction, if it has one.
pub(crate) fn unit(v: &[f64]) -> Option<Vec<f64>> {
    let largest = v.iter().fold(0.0f64, |a, c| a.max(c.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    let square: f64 = v.iter().map(|c| (c / largest).powi(2)).sum();
    Some(v.iter().map(|c| c / largest / square.sqrt()).collect())
}
