//! The kernel as a table in r².

use sph_kernels::{PiecewisePolynomial, polynomial_sampler};

/// Steps over the squared support, 8 kB.
const STEPS: u16 = 256;

/// Cells, a power of two so that a masked index needs no check; those from `STEPS` on are zero.
const CELLS: usize = 512;

/// A number of steps whose cell is zero.
const BEYOND: f64 = 300.0;

/// Added and subtracted, it rounds a number below 2³¹ to an integer, found in its last bits.
const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5 · 2⁵²

/// w by parabolas in r², one around each node.
///
/// For quadrature that needs five digits: no root and the same cost for every kernel. The error is
/// below 10⁻⁴ w(0) at r = 0, where r³ is not smooth in r², and below 2·10⁻⁶ w(0) from r = h/4 on.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// Steps per m².
    scale: f64,
    /// Coefficients of powers of the distance from the node in steps; the last is for alignment.
    cells: Box<[[f64; 4]; CELLS]>,
}

impl Table {
    pub fn new(shape: &PiecewisePolynomial, smoothing_length: f64) -> Self {
        let sampler = polynomial_sampler(shape, 3, smoothing_length);
        let step = sampler.support_radius().powi(2) / f64::from(STEPS);
        let at = |x: f64| sampler.at((x * step).sqrt()).0;
        let mut cells = Box::new([[0.0; 4]; CELLS]);
        for (node, cell) in (0..STEPS).map(f64::from).zip(cells.iter_mut()) {
            // Near the ends and the middle of a Chebyshev rule on [−1/2, 1/2]; r² ≥ 0.
            let t = if node == 0.0 {
                [0.0, 0.25, 0.5]
            } else {
                [-0.43, 0.0, 0.43]
            };
            let [a, b, c] = parabola(t, t.map(|t| at(node + t)));
            *cell = [a, b, c, 0.0];
        }
        Self {
            scale: 1.0 / step,
            cells,
        }
    }

    /// w in 1/m³ at two squared distances in m², zero beyond the support and for NaN.
    ///
    /// Two at once in one set of registers.
    #[inline(always)]
    pub fn pair(&self, r2: [f64; 2]) -> [f64; 2] {
        // One instruction, which `f64::min` with its care for NaN is not.
        let least = |x: f64| if x < BEYOND { x } else { BEYOND };
        let x = r2.map(|r2| least(r2 * self.scale));
        let rounded = x.map(|x| x + ROUND);
        let t = [0, 1].map(|i| x[i] - (rounded[i] - ROUND));
        let c = rounded.map(|r| &self.cells[r.to_bits() as usize & (CELLS - 1)]);
        [0, 1].map(|i| c[i][0] + t[i] * (c[i][1] + t[i] * c[i][2]))
    }
}

/// Coefficients of the parabola through three points.
fn parabola(x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    let first = (y[1] - y[0]) / (x[1] - x[0]);
    let second = ((y[2] - y[1]) / (x[2] - x[1]) - first) / (x[2] - x[0]);
    [
        y[0] - first * x[0] + second * x[0] * x[1],
        first - second * (x[0] + x[1]),
        second,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_comes_back() {
        let t = [-0.5, 0.25, 0.75];
        let c = parabola(t, t.map(|t| 1.0 + t * (2.0 + 3.0 * t)));
        assert!(
            (0..3).all(|n| (c[n] - [1.0, 2.0, 3.0][n]).abs() < 1e-14),
            "{c:?}"
        );
    }

    #[test]
    fn the_table_is_the_kernel() {
        for kernel in sph_kernels::builtin() {
            let table = Table::new(kernel.shape(), 0.5);
            let sampler = polynomial_sampler(kernel.shape(), 3, 0.5);
            let (mut near, mut far) = (0.0, 0.0);
            for i in 0..4000 {
                let r = 0.0005 * f64::from(i);
                let error =
                    (table.pair([r * r; 2])[1] - sampler.at(r).0).abs() / sampler.value_at_zero();
                let worst: &mut f64 = if r < 0.125 { &mut near } else { &mut far };
                *worst = worst.max(error);
            }
            println!("{near:e} {far:e}");
            assert!(near < 1e-4 && far < 2e-6, "{near:e} {far:e}");
            assert_eq!(table.pair([9.0, f64::INFINITY]), [0.0; 2]);
        }
    }
}
