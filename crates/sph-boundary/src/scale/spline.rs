//! Cubic B-splines on a grid of any dimension.

use sph_core::Vect;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid<const D: usize> {
    /// Its first node, m.
    pub low: Vect<D>,
    /// Distance of nodes, m.
    pub step: f64,
    /// Nodes along every axis, four at least.
    pub nodes: [usize; D],
}

impl<const D: usize> Grid<D> {
    pub fn around(low: Vect<D>, high: Vect<D>, step: f64) -> Self {
        let along = |k: usize| ((high[k] - low[k]) / step).ceil().max(3.0) as usize + 1;
        Grid {
            low,
            step,
            nodes: std::array::from_fn(along),
        }
    }

    pub fn len(&self) -> usize {
        self.nodes.iter().product()
    }

    /// Steps from a node to the next along every axis.
    pub fn strides(&self) -> [usize; D] {
        let mut stride = 1;
        std::array::from_fn(|k| {
            let own = stride;
            stride *= self.nodes[k];
            own
        })
    }

    pub fn place(&self, node: usize) -> Vect<D> {
        let strides = self.strides();
        let number = |k: usize| node / strides[k] % self.nodes[k];
        Vect::from_fn(|k, _| self.low[k] + number(k) as f64 * self.step)
    }

    /// The cell that a place is in, by its first node, and where in it; none outside of all cells with four nodes around.
    fn cell(&self, x: &Vect<D>) -> Option<([usize; D], [f64; D])> {
        let along = |k: usize| (x[k] - self.low[k]) / self.step;
        let inside = |k: usize| along(k) >= 1.0 && along(k) < (self.nodes[k] - 2) as f64;
        if !(0..D).all(inside) {
            return None;
        }
        let first = std::array::from_fn(|k| along(k) as usize);
        Some((first, std::array::from_fn(|k| along(k) - first[k] as f64)))
    }

    /// The node before a place along every axis, where [`value`] has one.
    pub fn node_before(&self, x: &Vect<D>) -> Option<usize> {
        let (first, _) = self.cell(x)?;
        let strides = self.strides();
        Some((0..D).map(|k| first[k] * strides[k]).sum())
    }
}

/// Values and slopes of the four B-splines of a cell.
fn basis(t: f64) -> [[f64; 2]; 4] {
    let u = 1.0 - t;
    [
        [u * u * u / 6.0, -u * u / 2.0],
        [
            (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (3.0 * t - 4.0) * t / 2.0,
        ],
        [
            (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
            (4.0 - 3.0 * u) * u / 2.0,
        ],
        [t * t * t / 6.0, t * t / 2.0],
    ]
}

/// Value and gradient at a place; none at the edge of the grid.
pub(crate) fn value<const D: usize>(
    grid: &Grid<D>,
    coefficients: &[f64],
    x: &Vect<D>,
) -> Option<(f64, Vect<D>)> {
    let (first, within) = grid.cell(x)?;
    let strides = grid.strides();
    let start: usize = (0..D).map(|k| (first[k] - 1) * strides[k]).sum();
    let along = within.map(basis);
    let (mut value, mut gradient) = (0.0, Vect::<D>::zeros());
    for n in 0..4_usize.pow(D as u32) {
        let number = |k: usize| n / 4_usize.pow(k as u32) % 4;
        let c = coefficients[start + (0..D).map(|k| number(k) * strides[k]).sum::<usize>()];
        let product = |slope: usize| {
            let one = |k: usize| along[k][number(k)][usize::from(k == slope)];
            (0..D).map(one).product::<f64>()
        };
        value += c * product(D);
        for k in 0..D {
            gradient[k] += c * product(k);
        }
    }
    Some((value, gradient / grid.step))
}

/// Turns values at the nodes into the coefficients of the spline that takes them: along every axis
/// (c_{i−1} + 4 c_i + c_{i+1})/6 = v_i, the ends as they are.
pub(crate) fn interpolate<const D: usize>(grid: &Grid<D>, values: &mut [f64]) {
    let strides = grid.strides();
    for (nodes, stride) in grid.nodes.into_iter().zip(strides) {
        let (mut upper, mut right) = (vec![0.0; nodes], vec![0.0; nodes]);
        for start in (0..values.len()).filter(|n| n / stride % nodes == 0) {
            right[0] = values[start];
            for i in 1..nodes - 1 {
                let pivot = 1.0 / (4.0 - upper[i - 1]);
                upper[i] = pivot;
                right[i] = (6.0 * values[start + i * stride] - right[i - 1]) * pivot;
            }
            for i in (0..nodes - 1).rev() {
                let after = values[start + (i + 1) * stride];
                values[start + i * stride] = right[i] - upper[i] * after;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spline of smooth values meets these with the fourth order, and its gradient with the third.
    #[test]
    fn smooth_values_come_back() {
        let smooth = |x: &Vect<3>| (1.3 * x[0]).sin() * (0.7 * x[1]).cos() + (0.5 * x[2]).exp();
        let error = |step: f64| {
            let (low, high) = (Vect::<3>::repeat(-2.0), Vect::<3>::repeat(3.0));
            let grid = Grid::around(low, high, step);
            let mut c: Vec<f64> = (0..grid.len()).map(|n| smooth(&grid.place(n))).collect();
            interpolate(&grid, &mut c);
            let at = |k: usize| {
                let x = Vect::<3>::new(0.31 + 0.017 * k as f64, 0.57, 0.13);
                let (found, gradient) = value(&grid, &c, &x).expect("inside");
                let along = 1.3 * (1.3 * x[0]).cos() * (0.7 * x[1]).cos();
                [(found - smooth(&x)).abs(), (gradient[0] - along).abs()]
            };
            let worse = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].max(b[1])];
            (0..20).map(at).fold([0.0; 2], worse)
        };
        let ([coarse, coarse_slope], [fine, fine_slope]) = (error(0.2), error(0.1));
        assert!(fine < coarse / 10.0 && fine < 1e-4, "{coarse} {fine}");
        let falls = fine_slope < coarse_slope / 6.0 && fine_slope < 1e-3;
        assert!(falls, "{coarse_slope} {fine_slope}");
    }
}
