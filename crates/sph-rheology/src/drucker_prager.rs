//! The elastic–viscoplastic soil, and the cones of its yield stress.

use std::f64::consts::PI;

use sph_core::Symmetric;

use crate::{Elastic, Gradient, Inputs, Needs, Rheology, Yielding, jaumann, parameters, plugin};

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

/// τ = ζ τ_y/γ̇ · 2D + (1 − ζ)τˢ: an elastic solid at rest, a liquid of constant friction when it
/// shears.
///
/// The yield stress τ_y = M max(p, 0) + K is that of a [`Cone`]. The solid stress τˢ is Hooke's
/// with the Jaumann rate, and cut to |τˢ| ≤ τ_y. With x = γ̇/γ̇_y and γ̇_y = τ_y/η_y the blend is
/// ζ = (q + 1)x^q − q x^(q+1) up to x = 1, where η_y = πd√(𝒢ρ_g)/(0.163ν + 0.877) is the time of a
/// Rayleigh wave around a grain times 𝒢 = E/(2(1 + ν)).
///
/// The viscosity ζτ_y/γ̇ = η_y((q + 1)x^(q−1) − q x^q) is finite, zero at rest for q > 1, and 1.125 η_y
/// at most for q = 2. In steady shear |τ| is τ_y at every strain rate (less (τ_y/𝒢)²/8 where solid
/// and liquid meet at an angle).
///
/// Liquid at x ≥ 1 loses its stress; to chatter less, a stress that is zero stays zero down to
/// x = 0.9 (ours).
///
/// Nothing of this damps the vibrations of a soil at rest, each of which cuts a little of its stress, so that it
/// creeps. `damping` β adds a viscosity βη_y to the solid: τ = ζτ_y/γ̇ · 2D + (1 − ζ)(τˢ + βη_y · 2D). That is Rayleigh
/// damping in proportion to the stiffness, with the time βη_y/𝒢; it delays what yields by no more than
/// 0.26 β τ_y for q = 2 (ours; the source has none).
///
/// The pressure is the effective one where the scene computes it. Limits: constant friction and
/// porosity; grains of a third of the spacing to the spacing.
///
/// Source: Ghaïtanellis 2017, Eq. 4.53–4.55 and 4.69–4.84 (4.72 with the sign of 4.69; 4.80 prints
/// other constants than 4.82).
///
/// ```toml
/// [phase.sand.rheology.drucker-prager]
/// young_modulus = "0.8 MPa"
/// poisson_ratio = 0.3
/// friction_angle = "30 deg"
/// grain_diameter = "3.9 mm"
/// grain_density = 2700
/// ```
#[plugin(crate::RheologyEntry, "drucker-prager", "elastic soil that yields to a liquid of constant friction",
    source: "Ghaïtanellis 2017, Eq. 4.69–4.84")]
#[derive(Copy)]
pub struct DruckerPrager {
    /// Young's modulus E.
    #[parameter(unit: "Pa", above: 0.0, quantity: "modulus", source: "Ghaïtanellis 2017, Eq. 1.21")]
    pub young_modulus: f64,
    /// Poisson's ratio ν.
    #[parameter(unit: "1", above: -1.0, max: 0.5, source: "Ghaïtanellis 2017, Eq. 1.21")]
    pub poisson_ratio: f64,
    /// Friction angle ψ, as in "30 deg".
    #[parameter(unit: "rad", min: 0.0, max: 1.5, source: "Ghaïtanellis 2017, Eq. 4.39–4.42")]
    pub friction_angle: f64,
    /// Cohesion c.
    #[parameter(default, unit: "Pa", min: 0.0, source: "Ghaïtanellis 2017, Eq. 4.39–4.42")]
    pub cohesion: f64,
    /// Grain diameter d.
    #[parameter(unit: "m", above: 0.0, source: "Ghaïtanellis 2017, Eq. 4.82")]
    pub grain_diameter: f64,
    /// Density ρ_g of the grains themselves.
    #[parameter(unit: "kg/m³", above: 0.0, source: "Ghaïtanellis 2017, Eq. 4.82")]
    pub grain_density: f64,
    /// Order q of the blend.
    #[parameter(default: 2.0, unit: "1", min: 1.0, max: 100.0, source: "Ghaïtanellis 2017, Eq. 4.83")]
    pub blending_order: f64,
    /// The cone of the yield stress: `circumscribed`, `inscribed`, `plane-strain`, `tan` or `sin`.
    #[parameter(default, source: "Ghaïtanellis 2017, Eq. 4.39–4.42; the other cones are ours to choose")]
    pub cone: Cone,
    /// Bound of the viscosity from below, for example that of the water between the grains.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "ours")]
    pub smallest_viscosity: f64,
    /// Viscosity β of the solid over the yield viscosity η_y: lets its vibrations ring out; only with stresses
    /// that are blended, as they are by default.
    #[parameter(default, unit: "1", min: 0.0, max: 1.0, source: "ours")]
    pub damping: f64,
}

/// Below this share of the yield strain rate a liquid is solid again.
const SOLID_AGAIN: f64 = 0.9;

impl DruckerPrager {
    /// τ_y at a pressure, Pa.
    pub fn yield_stress(&self, pressure: f64) -> f64 {
        self.cone
            .yield_stress(self.friction_angle, self.cohesion, pressure)
    }

    /// η_y, Pa s.
    pub fn yield_viscosity(&self) -> f64 {
        let modulus = jaumann::shear_modulus(self.young_modulus, self.poisson_ratio);
        let root = (modulus * self.grain_density).sqrt();
        PI * self.grain_diameter * root / (0.163 * self.poisson_ratio + 0.877)
    }

    /// ζ(x), the share of the liquid.
    pub fn liquid_share(&self, x: f64) -> f64 {
        let q = self.blending_order;
        match x < 1.0 {
            true => x.powf(q) * (q + 1.0 - q * x),
            false => 1.0,
        }
    }

    /// ζ/x: the viscosity over η_y.
    fn relative_viscosity(&self, x: f64) -> f64 {
        let q = self.blending_order;
        match x < 1.0 {
            true => x.powf(q - 1.0) * (q + 1.0 - q * x),
            false => 1.0 / x,
        }
    }

    fn bound(&self) -> YieldConstants {
        let (slope, constant) = self.cone.coefficients(self.friction_angle, self.cohesion);
        YieldConstants {
            slope,
            constant,
            yield_viscosity: self.yield_viscosity(),
        }
    }
}

/// Constants of the law, the same for every particle: M, K, η_y.
struct YieldConstants {
    slope: f64,
    constant: f64,
    yield_viscosity: f64,
}

impl YieldConstants {
    /// τ_y and x = γ̇/γ̇_y of one entry; without strength x is infinite, at rest too.
    fn state(&self, inputs: &Inputs<'_>, k: usize) -> (f64, f64) {
        let (rate, pressure) = inputs.at(k);
        let yield_stress = self.slope * pressure.max(0.0) + self.constant;
        match yield_stress > 0.0 {
            true => (yield_stress, rate * self.yield_viscosity / yield_stress),
            false => (0.0, f64::INFINITY),
        }
    }
}

/// True if an entry is liquid: from x = 1 on, and a stress that is zero down to [`SOLID_AGAIN`].
fn liquid(x: f64, stress: &Symmetric) -> bool {
    match *stress == Symmetric::ZERO {
        true => x >= SOLID_AGAIN,
        false => x >= 1.0,
    }
}

/// min(1, τ_y/|τ|). Source: Ghaïtanellis 2017, Eq. 4.74.
fn held(stress: &Symmetric, yield_stress: f64) -> f64 {
    let magnitude = jaumann::magnitude(stress);
    match magnitude > yield_stress {
        true => yield_stress / magnitude,
        false => 1.0,
    }
}

/// The stress scaled back to |τ| ≤ τ_y.
fn cut(stress: Symmetric, yield_stress: f64) -> Symmetric {
    stress * held(&stress, yield_stress)
}

impl Rheology for DruckerPrager {
    fn slow_friction(&self) -> Option<f64> {
        Some(self.bound().slope).filter(|slope| *slope > 0.0)
    }
    fn grain_diameter(&self) -> Option<f64> {
        Some(self.grain_diameter)
    }
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: true,
            pressure: self.friction_angle > 0.0,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        None
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        let bound = self.bound();
        for (k, eta) in viscosity.iter_mut().enumerate() {
            let (_, x) = bound.state(inputs, k);
            let solid = self.damping * (1.0 - self.liquid_share(x));
            let blended = bound.yield_viscosity * (self.relative_viscosity(x) + solid);
            *eta = blended.max(self.smallest_viscosity);
        }
    }
    /// η_y times the maximum of (q + 1)x^(q−1) − q x^q, which is at x = 1 − 1/q², and β at most.
    fn largest_viscosity(&self) -> f64 {
        let q = self.blending_order;
        let most = self.relative_viscosity(1.0 - 1.0 / (q * q)) + self.damping;
        (self.yield_viscosity() * most).max(self.smallest_viscosity)
    }
    fn elastic(&self) -> Option<&dyn Elastic> {
        Some(self)
    }
}

impl Elastic for DruckerPrager {
    fn shear_modulus(&self) -> f64 {
        jaumann::shear_modulus(self.young_modulus, self.poisson_ratio)
    }
    fn advance(
        &self,
        inputs: &Inputs<'_>,
        gradient: &[Gradient],
        dt: f64,
        stress: &mut [Symmetric],
    ) {
        let (bound, modulus) = (self.bound(), self.shear_modulus());
        for (k, (stress, gradient)) in stress.iter_mut().zip(gradient).enumerate() {
            let (yield_stress, x) = bound.state(inputs, k);
            *stress = match liquid(x, stress) {
                true => Symmetric::ZERO,
                false => {
                    let next = jaumann::advanced(stress, gradient, modulus, dt);
                    cut(next, yield_stress)
                }
            };
        }
    }
    fn carried(&self, inputs: &Inputs<'_>, stress: &[Symmetric], carried: &mut [Symmetric]) {
        let bound = self.bound();
        for (k, (carried, stress)) in carried.iter_mut().zip(stress).enumerate() {
            let (yield_stress, x) = bound.state(inputs, k);
            *carried = cut(*stress, yield_stress) * (1.0 - self.liquid_share(x));
        }
    }
    fn blends(&self) -> bool {
        true
    }
    fn damps(&self) -> bool {
        self.damping > 0.0
    }
    fn yielding(&self, inputs: &Inputs<'_>, stress: &[Symmetric], yielding: &mut [Yielding]) {
        let bound = self.bound();
        for (k, (yielding, stress)) in yielding.iter_mut().zip(stress).enumerate() {
            let (yield_stress, x) = bound.state(inputs, k);
            let share = self.liquid_share(x);
            *yielding = Yielding {
                friction: share,
                solid: 1.0 - share,
                held: held(stress, yield_stress),
                forgets: liquid(x, stress),
            };
        }
    }
    /// min(τ_y/γ̇, η_y). Source: Ghaïtanellis 2017, Eq. 4.76, bounded by η_y as ζτ_y/γ̇ is.
    fn liquid_viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        let bound = self.bound();
        for (k, eta) in viscosity.iter_mut().enumerate() {
            let (_, x) = bound.state(inputs, k);
            let liquid = bound.yield_viscosity / x.max(1.0);
            *eta = liquid.max(self.smallest_viscosity);
        }
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
            let error = (slope(Cone::Circumscribed) - outer).abs();
            assert!(error < 5.1e-5, "{angle}");
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
