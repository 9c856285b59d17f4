//! The threshold of motion on a slope.

/// Critical Shields number on a slope over that of a flat bed:
///
/// (cos ψ sin β + √(cos²β tan²φ − sin²ψ sin²β))/tan φ
///
/// with the angle β of the slope, φ of repose, and ψ between the flow and the way up. 0 where grains slide without a flow.
///
/// `gradient` is ∇z, `direction` the unit vector of the flow in the plane, `repose` tan φ.
///
/// Source: Soulsby 1997, Eq. 80a.
#[must_use]
pub fn critical_ratio(gradient: [f64; 2], direction: [f64; 2], repose: f64) -> f64 {
    let along = gradient[0] * direction[0] + gradient[1] * direction[1];
    let across = gradient[0] * direction[1] - gradient[1] * direction[0];
    let cosine = 1.0 / (1.0 + along * along + across * across).sqrt();
    // cos ψ sin β = ∇z·e cos β, sin ψ sin β = |∇z × e| cos β.
    let held = repose * repose - across * across;
    match held > 0.0 {
        true => (cosine * (along + held.sqrt()) / repose).max(0.0),
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Up and down the slope sin(φ ± β)/sin φ, across it cos β √(1 − tan²β/tan²φ); 0 at the angle of repose.
    #[test]
    fn it_has_the_forms_along_and_across_a_slope() {
        let phi = 32_f64.to_radians();
        for degrees in [0.0, 5.0, 15.0, 31.0_f64] {
            let beta = degrees.to_radians();
            let slope = beta.tan();
            let ratio = |direction| critical_ratio([slope, 0.0], direction, phi.tan());
            assert!((ratio([1.0, 0.0]) - (phi + beta).sin() / phi.sin()).abs() < 1e-14);
            assert!((ratio([-1.0, 0.0]) - (phi - beta).sin() / phi.sin()).abs() < 1e-14);
            let across = beta.cos() * (1.0 - (slope / phi.tan()).powi(2)).sqrt();
            assert!((ratio([0.0, 1.0]) - across).abs() < 1e-14);
        }
        assert_eq!(critical_ratio([0.7, 0.0], [-1.0, 0.0], 0.6), 0.0);
        assert_eq!(critical_ratio([0.7, 0.0], [0.0, 1.0], 0.6), 0.0);
    }
}
