//! A straight wall at all distances, cut in many ways: where rounding is worst.

use sph_boundary::Renormalisation2d;

use crate::gamma::quadrature::Gauss;
use crate::gamma::reference::on_line;
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
            let length = random.between(0.1, 0.8);
            let mut start = -radius - random.between(0.0, length);
            let (mut sum, mut total) = (0.0, 0.0);
            while start < radius {
                let end = start + length;
                let seen = renormalisation.segment([start, -a], [end, -a], [0.0, 1.0]);
                let value = on_line(&gauss, &kernel, a, [start, end]);
                single = single.max((seen.kernel - value).abs());
                sum += seen.kernel;
                total += value;
                start = end;
            }
            whole = whole.max((sum - total).abs());
        }
        println!("{}: h∇Γ_as {single:.1e}, h∇γ {whole:.1e}", kernel.name);
        let worst = single.max(whole);
        assert!(
            worst <= crate::gamma::TOLERANCE,
            "{}: {worst:e}",
            kernel.name
        );
    }
}
