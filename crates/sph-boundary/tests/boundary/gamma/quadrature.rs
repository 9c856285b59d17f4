//! Gauss–Legendre rules.

/// Nodes and weights on [0, 1].
pub struct Gauss(Vec<(f64, f64)>);

impl Gauss {
    pub fn new(count: usize) -> Self {
        let n = count as f64;
        let legendre = |x: f64| {
            let (mut before, mut now) = (1.0, x);
            for k in 2..=count {
                let k = k as f64;
                (before, now) = (now, ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k);
            }
            (now, n * (x * now - before) / (x * x - 1.0))
        };
        let rule = (0..count).map(|i| {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            for _ in 0..50 {
                let (value, slope) = legendre(x);
                x -= value / slope;
            }
            let slope = legendre(x).1;
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
        });
        Self(rule.collect())
    }

    /// ∫ over [a, b] after r = a + (b − a) t², which removes a square root at a.
    pub fn rooted(&self, a: f64, b: f64, mut visit: impl FnMut(f64, f64)) {
        for (t, weight) in &self.0 {
            visit(a + (b - a) * t * t, weight * 2.0 * t * (b - a));
        }
    }

    /// ∫ over [a, b].
    pub fn plain(&self, a: f64, b: f64, mut visit: impl FnMut(f64, f64)) {
        for (t, weight) in &self.0 {
            visit(a + (b - a) * t, weight * (b - a));
        }
    }
}

/// Ascending, without repetition, cut to [low, high], both included.
pub fn breaks(mut inner: Vec<f64>, low: f64, high: f64) -> Vec<f64> {
    inner.retain(|x| *x > low && *x < high);
    inner.extend([low, high]);
    inner.sort_by(f64::total_cmp);
    inner.dedup();
    inner
}
