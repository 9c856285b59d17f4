//! Slices against single distances and against the plain formula.

use proptest::prelude::*;
use sph_kernels::{Kernel, PiecewisePolynomial, PolynomialKernel, Sampler, ScalarSampler, builtin};

/// Squared distances from 0 to a little beyond the support, in no order.
fn distances(sampler: &dyn Sampler, count: usize) -> Vec<f64> {
    let place = |i: usize| (i * 7919 % count) as f64 / count as f64;
    (0..count)
        .map(|i| (1.05 * sampler.support_radius() * place(i)).powi(2))
        .collect()
}

fn both(sampler: &dyn Sampler, r2: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut w, mut factor) = (vec![f64::NAN; r2.len()], vec![f64::NAN; r2.len()]);
    sampler.both(r2, &mut w, &mut factor);
    (w, factor)
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn slices_equal_the_plain_formula() {
    let (d, h) = (2, 0.37);
    for kernel in builtin() {
        let sampler = kernel.sampler(d, h);
        let r2 = distances(&*sampler, 997);
        let (w, factor) = both(&*sampler, &r2);
        let (plain_w, plain_factor) = both(&ScalarSampler::new(kernel.clone(), d, h), &r2);
        let (w0, f0) = (sampler.value_at_zero(), sampler.at(0.0).1.abs());
        let largest = |a: &[f64], b: &[f64]| {
            a.iter()
                .zip(b)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
        };
        let (value, gradient) = (
            largest(&w, &plain_w) / w0,
            largest(&factor, &plain_factor) / f0,
        );
        // Not the slices but the plain formula loses digits: monomials in q cancel near the
        // support. F there stands at q = 10⁻⁸ for r = 0.
        assert!(value < 2e-13, "{}: w off by {value:e} w(0)", kernel.name());
        assert!(
            gradient < 1e-7,
            "{}: F off by {gradient:e} F(0)",
            kernel.name()
        );
    }
}

#[test]
fn slices_equal_factored_forms_to_the_last_digits() {
    type Form = fn(f64) -> f64;
    let forms: [(&str, Form); 6] = [
        ("wendland-c2", |q| (1.0 - q / 2.0).powi(4) * (1.0 + 2.0 * q)),
        ("wendland-c4", |q| {
            (1.0 - q / 2.0).powi(6) * (1.0 + 3.0 * q + 35.0 / 12.0 * q * q)
        }),
        ("wendland-c6", |q| {
            (1.0 - q / 2.0).powi(8) * (1.0 + 4.0 * q + 6.25 * q * q + 4.0 * q * q * q)
        }),
        ("cubic-spline", |q| {
            0.25 * (2.0 - q).powi(3) - (1.0 - q).max(0.0).powi(3)
        }),
        ("quartic-spline", |q| {
            (2.5 - q).powi(4) - 5.0 * (1.5 - q).max(0.0).powi(4) + 10.0 * (0.5 - q).max(0.0).powi(4)
        }),
        ("quintic-spline", |q| {
            (3.0 - q).powi(5) - 6.0 * (2.0 - q).max(0.0).powi(5) + 15.0 * (1.0 - q).max(0.0).powi(5)
        }),
    ];
    for (kernel, (name, form)) in builtin().iter().zip(forms) {
        assert_eq!(kernel.name(), name);
        for d in 1..=3 {
            let sampler = kernel.sampler(d, 1.0);
            let r2 = distances(&*sampler, 4999);
            let (w, _) = both(&*sampler, &r2);
            let mut largest = 0.0_f64;
            for (w, r2) in w.iter().zip(&r2) {
                let q = r2.sqrt().min(kernel.support());
                let error = (w - kernel.normalisation(d) * form(q)) / sampler.value_at_zero();
                largest = largest.max(error.abs());
            }
            // Rounding on both sides: the quintic sums 243, −192 and 15 to 66.
            assert!(
                largest < 3e-15,
                "{name} {d}D: slices off by {largest:e} w(0)"
            );
        }
    }
}

#[test]
fn bits_do_not_depend_on_the_place() {
    for kernel in builtin() {
        for (d, h) in [(1, 0.7), (2, 0.02), (3, 3.1)] {
            let sampler = kernel.sampler(d, h);
            let r2 = distances(&*sampler, 211);
            let (w, factor) = both(&*sampler, &r2);
            for length in [1, 2, 3, 5, 7, 8, 9, 15, 16, 17, 31, 33, 64, 100] {
                for start in (0..r2.len() - length).step_by(13) {
                    let part = start..start + length;
                    let (w_part, factor_part) = both(&*sampler, &r2[part.clone()]);
                    assert_eq!(bits(&w[part.clone()]), bits(&w_part), "{}", kernel.name());
                    assert_eq!(bits(&factor[part]), bits(&factor_part), "{}", kernel.name());
                }
            }
            let (mut alone_w, mut alone_factor) = (vec![0.0; 211], vec![0.0; 211]);
            sampler.value(&r2, &mut alone_w);
            sampler.gradient_factor(&r2, &mut alone_factor);
            assert_eq!(bits(&w), bits(&alone_w), "{}", kernel.name());
            assert_eq!(bits(&factor), bits(&alone_factor), "{}", kernel.name());
            for r in [0.0, 0.3 * h, 1.0 * h, 1.9 * h, 5.0 * h] {
                let (w, factor) = both(&*sampler, &[r * r]);
                assert_eq!((w[0], factor[0]), sampler.at(r), "{}", kernel.name());
            }
        }
    }
}

#[test]
fn a_broken_distance_is_seen() {
    for kernel in builtin() {
        let (w, factor) = both(&*kernel.sampler(2, 1.0), &[f64::NAN, 0.25]);
        assert!(
            w[0].is_nan() && factor[0].is_nan() && w[1] > 0.0,
            "{}",
            kernel.name()
        );
    }
}

#[test]
#[should_panic(expected = "must be positive")]
fn no_smoothing_length_no_sampler() {
    builtin()[0].sampler(2, 0.0);
}

proptest! {
    /// Shapes of strangers, with cusps and jumps and of any degree.
    #[test]
    fn any_shape_is_sampled(
        steps in prop::collection::vec(0.2..1.0_f64, 1..5),
        coefficients in prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 1..11), 4),
        places in prop::collection::vec(0.0..1.2_f64, 1..40),
    ) {
        let mut breaks = vec![0.0];
        for step in &steps {
            breaks.push(breaks[breaks.len() - 1] + step);
        }
        let mut pieces = coefficients[..steps.len()].to_vec();
        pieces[0][0] += 10.0; // so that the volume is not 0
        let shape = PiecewisePolynomial { breaks, pieces };
        prop_assume!(shape.moment(1).abs() > 0.1);
        let kernel = PolynomialKernel::new("any", shape);
        let sampler = kernel.sampler(2, 0.5);
        let slow = ScalarSampler::new(kernel.clone(), 2, 0.5);
        let r2: Vec<f64> = places.iter().map(|x| (x * sampler.support_radius()).powi(2)).collect();
        let (w, factor) = both(&*sampler, &r2);
        let (slow_w, slow_factor) = both(&slow, &r2);
        // Up to ten terms of at most 4¹⁰ each, and division by q.
        let scale = kernel.normalisation(2).abs() / 0.25;
        for i in 0..r2.len() {
            let q = r2[i].sqrt() / 0.5;
            let near_break =
                kernel.shape().breaks.iter().any(|b| (q - b).abs() < 1e-9 || q < 1e-5);
            prop_assume!(!near_break);
            prop_assert!((w[i] - slow_w[i]).abs() < 1e-7 * scale, "{} {}", w[i], slow_w[i]);
            let error = (factor[i] - slow_factor[i]).abs() * q;
            prop_assert!(error < 1e-6 * scale * 4.0, "{} {}", factor[i], slow_factor[i]);
        }
    }
}
