//! Water through the pores of a soil, between two basins.

use crate::shipped::finished;
use sph_tests::near;

/// The permeameter with particles of 10 mm, at which it takes seconds.
#[test]
fn levels_close_at_the_rate_of_darcys_law() {
    let run = finished("permeameter", &["numerics.spacing=0.01"]);
    let [time, left, right] = ["time", "left", "right"].map(|name| run.column(name));
    // The slope of the logarithm of the difference, from where the water has come to rest on.
    let levels = left.iter().zip(&right);
    let points = time.iter().zip(levels.map(|(l, r)| (l - r).ln()));
    let points: Vec<(f64, f64)> = points.map(|(t, d)| (*t, d)).filter(|p| p.0 > 0.1).collect();
    let mean =
        |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (t, d) = (mean(&|p| p.0), mean(&|p| p.1));
    let rate = -mean(&|p| (p.0 - t) * (p.1 - d)) / mean(&|p| (p.0 - t).powi(2));
    // K (1/A₁ + 1/A₂) with K = ρgk/η, k = n³d²/(150 (1 − n)²).
    let permeability = 0.366_f64.powi(3) * (1e-3 / 0.634_f64).powi(2) / 150.0;
    let exact = 1000.0 * 9.81 * permeability / 1e-3 * 20.0;
    println!("{rate} 1/s for {exact} 1/s: {:+.3}", rate / exact - 1.0);
    // The bed is ten spacings long.
    near(rate, exact, 1.0 / 10.0, "1/s, measured 0.149");
}
