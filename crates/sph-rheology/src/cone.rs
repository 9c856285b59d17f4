//! Yield cones of frictional material.

use crate::parameters;

/// The cone τ_y = M max(p, 0) + K that stands for a friction angle ψ and a cohesion c.
///
/// | cone | M | K |
/// |---|---|---|
/// | `circumscribed` | 2√3 sin ψ/(3 − sin ψ) | 2√3 c cos ψ/(3 − sin ψ) |
/// | `inscribed` | 2√3 sin ψ/(3 + sin ψ) | 2√3 c cos ψ/(3 + sin ψ) |
/// | `plane-strain` | 3 tan ψ/√(9 + 12 tan² ψ) | 3c/√(9 + 12 tan² ψ) |
/// | `tan` | tan ψ | c |
/// | `sin` | sin ψ | c cos ψ |
///
/// Mohr–Coulomb is a pyramid; the first three cones touch its outer edges, its inner edges and its
/// faces. In simple shear
/// the circumscribed one is stronger than the angle: ψ = 30° stands like 34.7°. `sin` is
/// Mohr–Coulomb in isochoric plane strain; `tan` stands on a slope of ψ.
///
/// Source: Ghaïtanellis 2017, Eq. 4.39–4.42 and 4.53–4.55, for the first; Drucker & Prager 1952 for
/// `plane-strain`; the others follow from the pyramid.
#[parameters]
pub enum Cone {
    /// Outside of the Mohr–Coulomb pyramid, as strong as it in triaxial compression.
    #[default]
    Circumscribed,
    /// Touches the inner edges, as strong as it in triaxial extension.
    Inscribed,
    /// Touches the faces, as strong as it in plane strain with an associated flow.
    PlaneStrain,
    /// τ_y = p tan ψ + c.
    Tan,
    /// τ_y = p sin ψ + c cos ψ.
    Sin,
}

impl Cone {
    /// M and K, Pa, for a friction angle (rad) and a cohesion (Pa).
    pub fn coefficients(self, friction_angle: f64, cohesion: f64) -> (f64, f64) {
        let (sine, cosine) = friction_angle.sin_cos();
        let tangent = friction_angle.tan();
        let by_sine = |below: f64| {
            let share = 12.0_f64.sqrt() / below;
            (share * sine, share * cohesion * cosine)
        };
        match self {
            Cone::Circumscribed => by_sine(3.0 - sine),
            Cone::Inscribed => by_sine(3.0 + sine),
            Cone::PlaneStrain => {
                let share = 3.0 / (9.0 + 12.0 * tangent * tangent).sqrt();
                (share * tangent, share * cohesion)
            }
            Cone::Tan => (tangent, cohesion),
            Cone::Sin => (sine, cohesion * cosine),
        }
    }

    /// τ_y at a pressure, Pa.
    pub fn yield_stress(self, friction_angle: f64, cohesion: f64, pressure: f64) -> f64 {
        let (slope, constant) = self.coefficients(friction_angle, cohesion);
        slope * pressure.max(0.0) + constant
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Apparent friction of the circumscribed cone in simple shear, and tan ψ.
    #[test]
    fn the_table_of_apparent_friction_is_met() {
        let table = [
            (19.6_f64, 0.4361, 0.3561),
            (24.0, 0.5433, 0.4452),
            (30.0, 0.6928, 0.5774),
            (38.0, 0.8945, 0.7813),
        ];
        for (angle, outer, tangent) in table {
            let slope = |cone: Cone| cone.coefficients(angle.to_radians(), 0.0).0;
            assert!(
                (slope(Cone::Circumscribed) - outer).abs() < 5.1e-5,
                "{angle}"
            );
            assert!((slope(Cone::Tan) - tangent).abs() < 5.1e-5, "{angle}");
        }
    }

    /// Mohr–Coulomb in triaxial compression and extension: |σ₁ − σ₃| = (σ₁ + σ₃) sin ψ + 2c cos ψ.
    #[test]
    fn the_outer_and_inner_cone_touch_the_pyramid() {
        let (angle, cohesion, p) = (30_f64.to_radians(), 7.0, 100.0);
        let (sine, cosine) = angle.sin_cos();
        // q/√3 = √J2 with p = mean stress; σ = p ± parts of q.
        for (cone, lode) in [(Cone::Circumscribed, 1.0), (Cone::Inscribed, -1.0)] {
            let root = cone.yield_stress(angle, cohesion, p);
            let q = 3.0_f64.sqrt() * root;
            // Compressive principal stresses: the axial one differs by q from the two others.
            let axial = p + lode * 2.0 / 3.0 * q;
            let lateral = p - lode / 3.0 * q;
            let excess = q - ((axial + lateral) * sine + 2.0 * cohesion * cosine);
            assert!(excess.abs() < 1e-12 * q, "{cone:?}: {excess}");
        }
    }

    #[test]
    fn tension_leaves_the_cohesion_and_the_cones_are_ordered() {
        let of = |cone: Cone, p: f64| cone.yield_stress(0.5, 3.0, p);
        assert_eq!(of(Cone::Tan, -40.0), 3.0);
        let slope = |cone: Cone| cone.coefficients(0.5, 0.0).0;
        assert!(slope(Cone::PlaneStrain) < slope(Cone::Inscribed));
        assert!(slope(Cone::Inscribed) < slope(Cone::Sin));
        assert!(slope(Cone::Sin) < slope(Cone::Tan));
        assert!(slope(Cone::Tan) < slope(Cone::Circumscribed));
    }
}
