//! Resistance of the grains of a soil to the water between them.

/// C q̇ + a q + b |q| q = f: the force f on the water in the pores, N/m³, and its flux q relative to the
/// grains, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreResistance {
    /// a = η/k, Pa s/m², with the viscosity η of the water and the permeability k of the soil.
    pub linear: f64,
    /// b, kg/m⁴: eddies behind grains.
    pub quadratic: f64,
    /// C, kg/m³: what the water in the pores weighs per volume of soil and flux.
    pub inertia: f64,
}

impl PoreResistance {
    /// k = n³d²/(150 (1 − n)²), m², of grains of diameter d in a packing of porosity n.
    ///
    /// Source: Kozeny 1927 and Carman 1937 with the constant of Ergun 1952.
    pub fn permeability(porosity: f64, diameter: f64) -> f64 {
        porosity.powi(3) * (diameter / (1.0 - porosity)).powi(2) / 150.0
    }

    /// b = 1.75 ρ (1 − n)/(n³d), kg/m⁴, for water of density ρ.
    ///
    /// Source: Ergun 1952, Eq. 19.
    pub fn eddies(porosity: f64, diameter: f64, density: f64) -> f64 {
        1.75 * density * (1.0 - porosity) / (porosity.powi(3) * diameter)
    }

    /// C = ρ/n (1 + κ (1 − n)/n), kg/m³: the water in the pores moves with q/n, and grains add κ of
    /// the water that they displace.
    ///
    /// Source: van Gent 1995, κ = 0.34.
    pub fn inertia(porosity: f64, added: f64, density: f64) -> f64 {
        density / porosity * (1.0 + added * (1.0 - porosity) / porosity)
    }

    /// The steady flux of a force f: 2f/(a + √(a² + 4bf)), the positive root of a q + b q² = f.
    pub fn steady_flux(&self, force: f64) -> f64 {
        let root = (self.linear * self.linear + 4.0 * self.quadratic * force).sqrt();
        2.0 * force / (self.linear + root)
    }

    /// Time C/(a + b |q|) in which the flux follows its force, s.
    pub fn response(&self, flux: f64) -> f64 {
        self.inertia / (self.linear + self.quadratic * flux)
    }

    /// Flux at the end of a step per force, m⁴/(N s), if it was `flux` before: 1/(C/Δt + a + b |q|).
    pub(crate) fn mobility(&self, flux: f64, dt: f64) -> f64 {
        1.0 / (self.inertia / dt + self.linear + self.quadratic * flux)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beads of 4 mm in water, a slide in a flume.
    fn beads() -> PoreResistance {
        let (n, d) = (0.366, 4e-3);
        PoreResistance {
            linear: 1e-3 / PoreResistance::permeability(n, d),
            quadratic: PoreResistance::eddies(n, d, 1000.0),
            inertia: PoreResistance::inertia(n, 0.34, 1000.0),
        }
    }

    #[test]
    fn permeability_is_that_of_kozeny_and_carman() {
        // 0.4³ (10⁻³)²/(150 · 0.6²), by hand.
        let k = PoreResistance::permeability(0.4, 1e-3);
        assert!((k / 1.185_185_185_185e-9 - 1.0).abs() < 1e-12, "{k:e}");
        // 1.75 · 1000 · 0.6/(0.064 · 10⁻³), by hand.
        let b = PoreResistance::eddies(0.4, 1e-3, 1000.0);
        assert!((b / 1.640_625e7 - 1.0).abs() < 1e-12, "{b:e}");
        let c = PoreResistance::inertia(0.4, 0.0, 1000.0);
        assert!((c / 2500.0 - 1.0).abs() < 1e-15, "{c}");
    }

    #[test]
    fn the_root_solves_the_law_from_creep_to_eddies() {
        let law = beads();
        for exponent in -6..8 {
            let force = 10f64.powi(exponent);
            let q = law.steady_flux(force);
            let back = law.linear * q + law.quadratic * q * q;
            assert!((back / force - 1.0).abs() < 1e-14, "{force}: {back}");
        }
    }

    #[test]
    fn small_forces_are_darcys_and_large_ones_forchheimers() {
        let law = beads();
        let slow = 1e-9 * law.linear * law.linear / law.quadratic;
        assert!((law.steady_flux(slow) * law.linear / slow - 1.0).abs() < 2e-9);
        let fast = 1e9 * law.linear * law.linear / law.quadratic;
        let eddies = (fast / law.quadratic).sqrt();
        assert!((law.steady_flux(fast) / eddies - 1.0).abs() < 2e-5);
        let darcy = PoreResistance {
            quadratic: 0.0,
            ..law
        };
        assert_eq!(darcy.steady_flux(3.0), 3.0 / darcy.linear);
        assert_eq!(law.steady_flux(0.0), 0.0);
    }

    #[test]
    fn steps_of_the_law_end_at_its_root_and_pass_the_closed_form() {
        let law = PoreResistance {
            quadratic: 0.0,
            ..beads()
        };
        let (force, response) = (5e3, law.response(0.0));
        let dt = 1e-3 * response;
        let mut q = 0.0;
        for _ in 0..1000 {
            q = law.mobility(q, dt) * (force + law.inertia / dt * q);
        }
        let exact = law.steady_flux(force) * (1.0 - (-1f64).exp());
        // Backward Euler: half a step too late.
        assert!((q / exact - 1.0).abs() < 5e-4, "{q} for {exact}");
        let law = beads();
        let mut q = 0.0;
        for _ in 0..200 {
            q = law.mobility(q, 0.1 * response) * (force + law.inertia / (0.1 * response) * q);
        }
        assert!((q / law.steady_flux(force) - 1.0).abs() < 1e-12);
    }
}
