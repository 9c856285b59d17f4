//! The wall-adapting closure of large-eddy simulations.

use nalgebra::{Matrix3, SMatrix};
use rayon::prelude::*;
use sph_contribution::{Contribution, Offer, Refusal, Setting};
use sph_core::{Access, StepError, fields, plugin};
use sph_multiphase::viscosity::EddyViscosityEntry;
use sph_neighbours::World;

use super::common::ClosureCommon;
use crate::{FilterLength, RoughBed};

/// η_t = ρ (C_w Δ)² (S^d:S^d)^{3/2} / ((S:S)^{5/2} + (S^d:S^d)^{5/4}), with S the strain rate,
/// S^d = ½(g² + g²ᵀ) − ⅓ tr(g²) 1 and the velocity gradient g.
///
/// It is zero in pure shear, in whose layer it falls with the third power of the distance from the wall, without a damping.
/// In solid rotation at ω it is not: (C_w Δ)² ω √(2/3)^{1/2}, since S is zero there and S^d is not. For flows in
/// space: in the plane it is allowed and warned of.
///
/// Source: Nicoud and Ducros 1999, Eq. 10 and 13 (C_w = 0.5 with Δ of a cell).
///
/// ```toml
/// [eddy-viscosity.wale]
/// ```
#[plugin(EddyViscosityEntry [2, 3], "wale",
    "large eddies without those of pure shear: falls with the third power of the distance from a wall",
    source: "Nicoud and Ducros 1999, Eq. 13", cfg(not(test)))]
pub struct Wale {
    /// C_w.
    #[parameter(default: 0.5, unit: "1", min: 0.0, source: "Nicoud and Ducros 1999, §3")]
    pub coefficient: f64,
    /// Δ over the length that `filter_length` names.
    #[parameter(default: 1.0, unit: "1", above: 0.0, source: "Nicoud and Ducros 1999, §3")]
    pub filter: f64,
    /// Length of which Δ is a multiple.
    #[parameter(default: FilterLength::Spacing)]
    pub filter_length: FilterLength,
    /// Names of the phases that it acts on: fluids with one viscosity. To be left out where there is one.
    #[parameter(default)]
    pub phases: Vec<String>,
    /// The bed of another phase as a rough wall.
    #[parameter(default)]
    pub bed: Option<RoughBed>,
}

impl Wale {
    /// ν_t, m²/s, for a velocity gradient, 1/s, with a filter of a width, m.
    pub fn kinematic<const D: usize>(&self, width: f64, gradient: &SMatrix<f64, D, D>) -> f64 {
        let g = in_space(gradient);
        let squared = g * g;
        let third = squared.trace() / 3.0;
        let shear = (squared + squared.transpose()) * 0.5 - Matrix3::identity() * third;
        let strain = (g + g.transpose()) * 0.5;
        let [s, d] = [strain.norm_squared(), shear.norm_squared()];
        let below = s.powf(2.5) + d.powf(1.25);
        match below > 0.0 {
            true => (self.coefficient * width).powi(2) * d.powf(1.5) / below,
            false => 0.0,
        }
    }

    fn set<const D: usize>(&self, world: &World<D>, eddies: &mut [f64]) -> Result<(), StepError> {
        let width = self.filter * self.filter_length.metres(world);
        let density = world.free.get(fields::DENSITY)?;
        let gradients = world.free.get(fields::VELOCITY_GRADIENT)?;
        let all = eddies.par_iter_mut().zip(density).zip(gradients);
        all.with_min_len(512)
            .for_each(|((eddy, rho), g)| *eddy = rho * self.kinematic(width, g));
        Ok(())
    }
}

impl<const D: usize> Contribution<D> for Wale {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let common = ClosureCommon {
            name: "wale",
            phases: &self.phases,
            bed: self.bed.as_ref(),
            eddies_in_space: true,
            ..ClosureCommon::default()
        };
        let access = Access::none().here((fields::DENSITY, fields::VELOCITY_GRADIENT));
        let own = self.clone();
        let set = move |world: &World<D>, eddies: &mut [f64]| own.set(world, eddies);
        common.offer_to(setting, ("wale", access), set, offer)
    }
}

/// A gradient with zeros in the direction that a plane has not.
pub(crate) fn in_space<const D: usize>(gradient: &SMatrix<f64, D, D>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| gradient.get((i, j)).copied().unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tensor_norm(rows: [[f64; 3]; 3]) -> f64 {
        let g = Matrix3::from_fn(|i, j| rows[i][j]);
        Wale::default().kinematic(0.02, &g)
    }

    #[test]
    fn there_is_none_in_pure_shear_and_at_rest() {
        assert_eq!(tensor_norm([[0.0, 7.0, 0.0], [0.0; 3], [0.0; 3]]), 0.0);
        assert_eq!(tensor_norm([[0.0; 3]; 3]), 0.0);
        let flat = SMatrix::<f64, 2, 2>::new(0.0, 7.0, 0.0, 0.0);
        assert_eq!(Wale::default().kinematic(0.02, &flat), 0.0);
    }

    /// g² = −ω²(1, 1, 0), S^d = −ω²(⅓, ⅓, −⅔), S^d:S^d = ⅔ω⁴: its power ¼ is left.
    #[test]
    fn solid_rotation_has_what_its_formula_gives() {
        let omega = 3.0;
        let found = tensor_norm([[0.0, -omega, 0.0], [omega, 0.0, 0.0], [0.0; 3]]);
        let exact = (0.5f64 * 0.02).powi(2) * omega * (2.0f64 / 3.0).powf(0.25);
        assert!((found / exact - 1.0).abs() < 1e-14, "{found}, {exact}");
    }

    /// Irrotational strain in the plane of space: g² = s²(1, 1, 0), S:S = 2s², S^d:S^d = ⅔s⁴.
    #[test]
    fn irrotational_strain_has_what_its_formula_gives() {
        let s = 2.0f64;
        let found = tensor_norm([[s, 0.0, 0.0], [0.0, -s, 0.0], [0.0; 3]]);
        let d = 2.0 / 3.0 * s.powi(4);
        let exact = 1e-4 * d.powf(1.5) / ((2.0 * s * s).powf(2.5) + d.powf(1.25));
        assert!((found / exact - 1.0).abs() < 1e-14);
    }

    /// u = Ay + …, v of order y²: near a wall S^d:S^d is of order y², so that ν_t is of order y³.
    #[test]
    fn near_a_wall_it_falls_with_the_third_power_of_the_distance() {
        let at = |y: f64| {
            let along = [0.3 * y, 5.0, 0.7 * y];
            let away = [0.2 * y * y, -0.4 * y, 0.1 * y * y];
            tensor_norm([along, away, [-0.2 * y, 2.0, 0.1 * y]])
        };
        let order = (at(1e-3) / at(5e-4)).log2();
        // Its next term is of the next order: y is 1e-3.
        assert!((order - 3.0).abs() < 0.01, "{order}");
    }
}
