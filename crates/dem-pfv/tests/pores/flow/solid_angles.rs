//! §5.1 of the page, `solid-angle-identities`.

use std::f64::consts::PI;

use dem_pfv::flow::solid_angle;
use nalgebra::Vector3;

use crate::close;

#[test]
fn an_octant_is_half_pi() {
    let omega = solid_angle(Vector3::x(), 2.0 * Vector3::y(), 0.1 * Vector3::z());
    close(omega, PI / 2.0, 1e-12);
    let turned = solid_angle(Vector3::y(), Vector3::x(), Vector3::z());
    assert_eq!(turned, -omega);
}

/// Value of the page, by Monte Carlo 0.8080.
#[test]
fn a_triangle_of_the_page_is_seen_under_0_808123() {
    let [a, b, c] = [[1.0, 0.2, 0.1], [0.1, 1.0, 0.3], [0.2, 0.1, 1.0]].map(Vector3::from);
    close(solid_angle(a, b, c), 0.808_123, 5e-7);
}

/// Girard: ω is the sum of the angles of the spherical triangle less π. Of 20,000 random triangles one in six has
/// a negative denominator.
#[test]
fn random_triangles_have_the_excess_of_girard() {
    let mut state = 1_u64;
    let mut draw = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mut worst = 0.0_f64;
    let mut large = 0;
    for _ in 0..20_000 {
        let [a, b, c] = [(); 3].map(|()| Vector3::new(draw(), draw(), draw()).normalize());
        let corner = |a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>| {
            let (u, v) = (a.cross(&b), a.cross(&c));
            u.cross(&v).norm().atan2(u.dot(&v))
        };
        let excess = corner(a, b, c) + corner(b, c, a) + corner(c, a, b) - PI;
        let omega = solid_angle(a, b, c);
        large += i32::from(omega.abs() > PI);
        worst = worst.max((omega.abs() - excess).abs());
    }
    println!("largest difference {worst:e} sr, {large} triangles above π");
    assert!(large > 2000, "{large} triangles tell the quadrants apart");
    assert!(worst < 1e-9, "largest difference {worst:e} sr");
}
