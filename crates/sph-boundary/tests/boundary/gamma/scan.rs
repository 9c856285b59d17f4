//! A straight wall at all distances, cut in many ways: where rounding is worst.

use sph_boundary::Renormalisation2d;

use crate::gamma::quadrature::{Gauss, breaks};
use crate::random::Random;

#[test]
fn straight_wall_at_all_distances() {
    let gauss = Gauss::new(24);
    for kernel in crate::gamma::kernels::all() {
        let renormalisation = Renormalisation2d::new(&kernel.shape, 1.0).unwrap();
        let radius = kernel.shape.support();
        let mut random = Random(7);
        let (mut single, mut whole): (f64, f64) = (0.0, 0.0);
        for i in 0..3000 {
            let a = radius * f64::from(i) / 3000.0 + 1e-5;
            let mut inner = vec![0.0];
            for knot in kernel.shape.breaks.iter().filter(|knot| **knot > a) {
                let half = (knot * knot - a * a).sqrt();
                inner.extend([-half, half]);
            }
            inner.extend((0..20).flat_map(|k| [-1.0, 1.0].map(|s| s * a * 2f64.powi(k))));
            let exact = |low: f64, high: f64| {
                let mut sum = 0.0;
                for bounds in breaks(inner.clone(), low, high).windows(2) {
                    gauss.plain(bounds[0], bounds[1], |y, weight| {
                        sum += weight * kernel.sigma * (kernel.value)(a.hypot(y));
                    });
                }
                sum
            };
            let length = random.between(0.1, 0.8);
            let mut start = -radius - random.between(0.0, length);
            let (mut sum, mut total) = (0.0, 0.0);
            while start < radius {
                let end = start + length;
                let seen = renormalisation.segment([start, -a], [end, -a], [0.0, 1.0]);
                let value = exact(start, end);
                single = single.max((seen.kernel - value).abs());
                sum += seen.kernel;
                total += value;
                start = end;
            }
            whole = whole.max((sum - total).abs());
        }
        println!("{}: h∇Γ_as {single:.1e}, h∇γ {whole:.1e}", kernel.name);
        assert!(
            single.max(whole) <= crate::gamma::TOLERANCE,
            "{}",
            kernel.name
        );
    }
}
