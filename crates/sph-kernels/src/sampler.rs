//! The role of a kernel in loops: bound to a dimension and h, evaluated on slices.

use std::fmt::Debug;

/// A kernel bound to a dimension d and a smoothing length h.
///
/// w(r) = σ_d / h^d f(r/h) in 1/m^d and F(r) = w'(r)/r in 1/m^(d+2), so that ∇w_ab = F(r_ab) r_ab without division by
/// r. Both are exactly 0 for r² ≥ `support_radius()²`, and F is finite at r = 0.
///
/// Every result depends on its own r² alone, bit for bit: slices may be cut anywhere. A NaN
/// distance gives NaN, so that a broken run is seen.
pub trait Sampler: Send + Sync + Debug {
    /// Dimension d: 1, 2 or 3.
    fn dimension(&self) -> usize;

    /// Smoothing length h in m.
    fn smoothing_length(&self) -> f64;

    /// Support radius in m: the support of the shape times h.
    fn support_radius(&self) -> f64;

    /// w(0) in 1/m^d.
    fn value_at_zero(&self) -> f64;

    /// (w, F) at one distance r ≥ 0 in m; the same bits as the slice methods at r².
    fn at(&self, r: f64) -> (f64, f64);

    /// `w[i]` = w(√`r2[i]`) in 1/m^d, `r2` in m².
    ///
    /// # Panics
    /// If the slices differ in length.
    fn value(&self, r2: &[f64], w: &mut [f64]);

    /// `factor[i]` = F(√`r2[i]`) in 1/m^(d+2), `r2` in m².
    ///
    /// # Panics
    /// If the slices differ in length.
    fn gradient_factor(&self, r2: &[f64], factor: &mut [f64]);

    /// [`Sampler::value`] and [`Sampler::gradient_factor`] together.
    ///
    /// # Panics
    /// If the slices differ in length.
    fn both(&self, r2: &[f64], w: &mut [f64], factor: &mut [f64]) {
        self.value(r2, w);
        self.gradient_factor(r2, factor);
    }
}

/// Panics unless h can be a smoothing length.
pub(crate) fn assert_smoothing_length(h: f64) {
    let valid = h > 0.0 && h.is_finite();
    assert!(valid, "the smoothing length must be positive, not {h}");
}
