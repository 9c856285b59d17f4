//! Continuity, sign and support of the shapes.

use sph_kernels::{Kernel, PolynomialKernel, algebra, builtin, by_name};

/// Jump of the n-th derivative at the break `k`, over f(0).
fn jump(kernel: &PolynomialKernel, k: usize, n: usize) -> f64 {
    let shape = kernel.shape();
    let side = |piece: Option<&Vec<f64>>| {
        let piece = piece.cloned().unwrap_or_default();
        let derivative = (0..n).fold(piece, |piece, _| algebra::derivative(&piece));
        algebra::value(&derivative, shape.breaks[k])
    };
    (side(shape.pieces.get(k)) - side(shape.pieces.get(k - 1))) / kernel.value(0.0)
}

#[test]
fn shapes_are_as_smooth_as_their_names() {
    // The edge of a Wendland function is smoother than the function at 0: (1 − q/2)⁴ for C2.
    let smoothness = [
        ("wendland-c2", 3),
        ("wendland-c4", 5),
        ("wendland-c6", 7),
        ("cubic-spline", 2),
        ("quartic-spline", 3),
        ("quintic-spline", 4),
    ];
    for (name, order) in smoothness {
        let kernel = by_name(name).expect("built in");
        for k in 1..kernel.shape().breaks.len() {
            for n in 0..=order {
                let jump = jump(&kernel, k, n);
                // Rounding of the monomials, worst for the seventh derivative at q = 2.
                assert!(
                    jump.abs() < 1e-10,
                    "{name} break {k}: f^({n}) jumps by {jump:e} f(0)"
                );
            }
        }
        let outer = jump(&kernel, kernel.shape().breaks.len() - 1, order + 1);
        assert!(
            outer.abs() > 1e-3,
            "{name}: f^({}) jumps by {outer:e} f(0)",
            order + 1
        );
    }
}

#[test]
fn odd_derivatives_vanish_at_zero_up_to_the_order() {
    for (name, order) in [("wendland-c2", 1), ("wendland-c4", 3), ("wendland-c6", 5)] {
        let kernel = by_name(name).expect("built in");
        let piece = &kernel.shape().pieces[0];
        for n in (1..=order).step_by(2) {
            assert!(
                piece[n].abs() < 1e-15,
                "{name}: coefficient {n} is {:e}",
                piece[n]
            );
        }
        assert!(piece[order + 2].abs() > 0.1, "{name}: {piece:?}");
    }
}

#[test]
fn shapes_are_positive_and_fall() {
    for kernel in builtin() {
        let sampler = kernel.sampler(3, 1.0);
        for k in 0..1000 {
            let r = 1e-3 * f64::from(k) * kernel.support();
            let (w, factor) = sampler.at(r);
            assert!(
                w > 0.0 && factor < 0.0,
                "{} at r = {r}: {w:e}, {factor:e}",
                kernel.name()
            );
        }
    }
}

#[test]
fn nothing_is_left_on_the_support() {
    for kernel in builtin() {
        let support = kernel.support();
        for q in [
            support,
            support * (1.0 + f64::EPSILON),
            2.0 * support,
            1e300,
        ] {
            assert_eq!(
                (kernel.value(q), kernel.derivative(q)),
                (0.0, 0.0),
                "{}",
                kernel.name()
            );
        }
        for h in [0.013, 0.1, 1.0, 1.0 / 3.0, 7.7e5] {
            let sampler = kernel.sampler(2, h);
            let edge = sampler.support_radius() * sampler.support_radius();
            let r2 = [
                edge,
                edge * (1.0 + f64::EPSILON),
                2.0 * edge,
                1e300,
                f64::INFINITY,
            ];
            let (mut w, mut factor) = ([1.0; 5], [1.0; 5]);
            sampler.both(&r2, &mut w, &mut factor);
            assert_eq!(
                (w, factor),
                ([0.0; 5], [0.0; 5]),
                "{} h = {h}",
                kernel.name()
            );
        }
    }
}
