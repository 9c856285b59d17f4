//! Right-angled edges and corners, convex and re-entrant.

use sph_kernels::PiecewisePolynomial;

use super::planes::excess;
use super::solid::Solid;
use super::{assert_within, kernels, quadrature};
use crate::close;

/// ∫ w dz over a line at the distance t.
pub fn on_line(shape: &PiecewisePolynomial, t: f64) -> f64 {
    let reach = |knot: &f64| (knot * knot - t * t).max(0.0).sqrt();
    let cuts: Vec<f64> = shape.breaks.iter().map(reach).collect();
    let f = |z: f64| shape.value((t * t + z * z).sqrt());
    let integral = |cut: &[f64]| quadrature::adaptive(&mut |z| [f(z)], [cut[0], cut[1]], 1e-13)[0];
    2.0 * shape.normalisation(3) * cuts.windows(2).map(integral).sum::<f64>()
}

/// γ in the quadrant x, y > 0 near its edge: planes, and ∫∫ of [`on_line`] over [0, x] × [0, y].
fn quadrant(shape: &PiecewisePolynomial, [x, y]: [f64; 2]) -> f64 {
    let mut row = |x: f64| {
        let mut at = |y: f64| [on_line(shape, (x * x + y * y).sqrt())];
        quadrature::adaptive(&mut at, [0.0, y], 1e-9)
    };
    let both = quadrature::adaptive(&mut row, [0.0, x], 1e-9)[0];
    0.25 + 0.5 * (excess(shape, x) + excess(shape, y)) + both
}

#[test]
fn edges_are_as_by_quadrature() {
    let room = Solid::new(Solid::box_of([[0.0, 40.0]; 3]));
    let bend = Solid::new(Solid::l_block(40.0));
    for (kernel, of) in kernels() {
        let mut worst: f64 = 0.0;
        for [x, y] in [[0.4, 0.7], [0.05, 1.2]] {
            let exact = quadrant(kernel.shape(), [x, y]);
            let convex = room.at(&of, [x, y, 20.0]).gamma();
            // The solid's side of the re-entrant edge has the mirrored point.
            let concave = bend.at(&of, [-x, -y, 3.0]).gamma();
            let outside = quadrant(kernel.shape(), [-x, -y]);
            worst = worst.max((convex - exact).abs());
            worst = worst.max((concave - (1.0 - outside)).abs());
        }
        assert_within(&kernel, worst, 1e-8);
    }
}

#[test]
fn the_published_corner_comes_out() {
    let room = Solid::new(Solid::box_of([[0.0, 9.0]; 3]));
    let sum = room.at(&kernels()[0].1, [0.5, 0.6, 0.7]);
    close(sum.gamma(), 0.652747792, 1e-9, "γ");
    let gradient = [0.385686285, 0.304593585, 0.235120980];
    (0..3).for_each(|k| close(sum.gradient[k], gradient[k], 1e-9, k));
}
