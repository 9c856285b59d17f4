//! Orders of convergence, ln error over ln refinement, and variants that no other beats in both time and error.

use serde::{Deserialize, Serialize};

/// Orders of one series of variants that differ in their refinement only.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Orders {
    /// Between each and the next finer one.
    pub between: Vec<f64>,
    /// Slope of the least-squares line through the three finest.
    pub finest_three: Option<f64>,
}

impl Orders {
    /// Orders of points of refinement and error, both positive, from coarse to fine.
    pub fn from_points(points: &[[f64; 2]]) -> Self {
        let logs: Vec<[f64; 2]> = points.iter().map(|p| p.map(f64::ln)).collect();
        let order = |p: &[[f64; 2]]| (p[1][1] - p[0][1]) / (p[1][0] - p[0][0]);
        Orders {
            between: logs.windows(2).map(order).collect(),
            finest_three: logs.len().checked_sub(3).map(|k| &logs[k..]).map(slope),
        }
    }

    /// The order that is shown first: the fitted one, or that of two points.
    pub fn main(&self) -> Option<f64> {
        self.finest_three.or(self.between.last().copied())
    }
}

/// Slope of the least-squares line.
pub(crate) fn slope(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let (xx, xy) = points.iter().fold((0.0, 0.0), |(xx, xy), p| {
        let d = p[0] - x;
        (xx + d * d, xy + d * (p[1] - y))
    });
    xy / xx
}

/// Names of the points of time and error that no other point beats, fastest first.
pub fn pareto(mut points: Vec<(String, [f64; 2])>) -> Vec<String> {
    points.retain(|(_, p)| p.iter().all(|x| x.is_finite()));
    points.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut best = f64::INFINITY;
    let mut kept = Vec::new();
    for (name, [_, error]) in points {
        if error < best {
            best = error;
            kept.push(name);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_exponent_as_order() {
        let points = [0.4, 0.2, 0.1, 0.05].map(|h: f64| [h, 3.0 * h.powf(1.7)]);
        let orders = Orders::from_points(&points);
        assert_eq!(orders.between.len(), 3);
        let mut all = orders.between.iter().chain(&orders.finest_three);
        assert!(all.all(|o| (o - 1.7).abs() < 1e-12), "{orders:?}");
    }

    #[test]
    fn the_fit_takes_the_three_finest_and_needs_them() {
        let orders = Orders::from_points(&[[8.0, 1.0], [4.0, 16.0], [2.0, 4.0], [1.0, 1.0]]);
        assert!((orders.main().unwrap() - 2.0).abs() < 1e-12);
        let two = Orders::from_points(&[[0.2, 4.0], [0.1, 2.0]]);
        assert_eq!(two.finest_three, None);
        assert!((two.main().unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(Orders::from_points(&[]), Orders::default());
    }

    #[test]
    fn slower_and_less_accurate_variants_are_left_out() {
        let points = [
            ("slow", [3.0, 0.1]),
            ("worse", [2.0, 0.5]),
            ("fast", [1.0, 0.4]),
            ("nothing", [0.5, f64::NAN]),
            ("twin", [1.0, 0.4]),
        ];
        let points = points.map(|(n, p)| (n.to_string(), p)).to_vec();
        assert_eq!(pareto(points), ["fast", "slow"]);
    }
}
