//! Conductances of throats.

use std::f64::consts::PI;

use crate::Throat;

/// A law for the conductance of throats.
pub trait Conductance {
    /// g µ (m⁴) with the flux q = g (p_i − p_j) / L. Zero closes a throat.
    fn conductance(&self, throat: &Throat) -> f64;
}

/// g = α A R² / µ with the fluid area A of the facet and the hydraulic radius R = φ/γ; α = ½ is that of
/// a round tube of radius 2R. Source: Catalano 2012, Eqs. (3.4), (3.5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HydraulicRadius {
    /// Shape factor α.
    pub shape_factor: f64,
    /// Divides R by 2^¼ for each slip wall of a throat, as YADE 2023.02a does; not in the thesis, and it halves
    /// the conductance beside walls of symmetry. For comparison with YADE.
    pub reduced_at_slip_walls: bool,
}

impl Default for HydraulicRadius {
    fn default() -> Self {
        Self {
            shape_factor: 0.5,
            reduced_at_slip_walls: false,
        }
    }
}

impl Conductance for HydraulicRadius {
    fn conductance(&self, throat: &Throat) -> f64 {
        let mut radius = throat.hydraulic_radius();
        if self.reduced_at_slip_walls {
            radius *= 2.0_f64.powf(-0.25 * throat.slip_walls as f64);
        }
        self.shape_factor * throat.fluid_area.max(0.0) * radius * radius
    }
}

/// g = 2π R⁴ / µ with R = ¼ (√(A/π) + r), A the fluid area and r the radius of the inscribed circle.
/// Source: Bryant & Blunt 1992; Catalano 2012, Eq. (3.6).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EffectiveRadius;

impl EffectiveRadius {
    /// R, m.
    #[must_use]
    pub fn radius(throat: &Throat) -> f64 {
        0.25 * ((throat.fluid_area.max(0.0) / PI).sqrt() + throat.inscribed_radius)
    }
}

impl Conductance for EffectiveRadius {
    fn conductance(&self, throat: &Throat) -> f64 {
        2.0 * PI * Self::radius(throat).powi(4)
    }
}
