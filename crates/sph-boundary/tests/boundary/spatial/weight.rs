//! The quadrature of ∫ w dS.

use sph_kernels::Kernel;

use super::vector::{Random, dot, normal, plus, turned};
use super::{assert_within, kernels};

#[test]
fn legs_of_half_h_are_integrated_to_four_digits() {
    let leg = 0.5;
    let area = 0.5 * leg * leg;
    for (kernel, of) in kernels() {
        let w = kernel.sampler(3, 1.0);
        let mut random = Random(1);
        let (mut worst, mut own): (f64, f64) = (0.0, 0.0);
        for _ in 0..40_000 {
            let centre = random.vector(kernel.support());
            let angle = random.between(0.0, 6.0);
            let t = [[-1.0, -1.0, 0.0], [2.0, -1.0, 0.0], [-1.0, 2.0, 0.0]]
                .map(|c| plus(centre, leg / 3.0, turned(c, angle)));
            let error = (of.weight(t, normal(t), area) - of.triangle(t, normal(t)).kernel).abs();
            worst = worst.max(error / (w.value_at_zero() * area));
            let q = t.map(|c| dot(c, c).sqrt());
            if q.iter().all(|q| *q < kernel.support() - leg) {
                let nearest = q.iter().fold(f64::MAX, |a, b| a.min(*b));
                own = own.max(error / (w.at(nearest).0 * area));
            }
        }
        assert_within(&kernel, worst, 8e-5);
        println!("                of its own {own:.1e}");
        assert!(own < 4e-4);
    }
}

#[test]
fn near_and_large_triangles_are_exact() {
    for (_, of) in kernels() {
        for (size, area) in [(1e-3, 5e-7), (0.2, 0.02), (1.5, 1.125)] {
            let t = [[-0.3, -0.3, 0.1], [0.7, -0.3, 0.1], [-0.3, 0.7, 0.1]]
                .map(|c| c.map(|x| size * x));
            let up = [0.0, 0.0, 1.0];
            assert_eq!(of.weight(t, up, area), of.triangle(t, up).kernel);
        }
    }
}
