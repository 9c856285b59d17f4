//! Parameters of the fluid and of its computation.

use serde::{Deserialize, Serialize};
use sph_core::parameters;

use crate::coupled::{CoupledError, WallBoundary};
use crate::flow::{SolidAngles, Solver};
use crate::grains::GrainSystem;
use crate::{AT_LEAST_0, POSITIVE, require};

/// The fluid in the pores.
#[parameters]
#[derive(Copy, PartialEq, Serialize)]
pub struct Fluid {
    /// Dynamic viscosity µ, Pa s.
    #[parameter(unit: "Pa s", above: 0.0)]
    pub viscosity: f64,
    /// Density ρ_f, kg/m³, for buoyancy; zero for none.
    #[parameter(default, unit: "kg/m³", min: 0.0)]
    pub density: f64,
    /// Bulk modulus K_f, Pa; a fluid that does not give way if left out.
    #[parameter(unit: "Pa", above: 0.0)]
    pub bulk_modulus: Option<f64>,
    /// True if it shears between neighbours that slide past each other. Catalano 2012, Eqs. (6.29), (6.30).
    #[parameter(default)]
    pub shear: bool,
    /// Lubrication of the gaps between neighbours; none if left out.
    pub lubrication: Option<Lubrication>,
}

/// Lubrication of the gap h between two spheres with the reduced radius a = R₁ R₂/(R₁ + R₂), or a sphere and a wall with
/// a = R, that part or approach with v_n:
///
/// ```text
/// F = 6 π µ a² (1/max(h, ε a) − 1/(c a)) v_n,     h < c a
/// ```
///
/// The leading term of Jeffrey and Onishi (J. Fluid Mech. 139, 1984), less its value at the range c a, beyond which the
/// pores' pressures have to do (as Nguyen and Ladd, Phys. Rev. E 66, 046708, 2002, subtract what their fluid resolves).
/// No gap counts as narrower than the roughness ε a, so that spheres touch.
#[parameters]
#[derive(PartialEq, Serialize)]
pub struct Lubrication {
    /// Roughness ε in terms of a: no gap counts as narrower.
    #[parameter(default: 0.01, unit: "1", above: 0.0)]
    pub roughness: f64,
    /// Range c in terms of a, beyond which the pores' pressures have to do.
    #[parameter(default: 1.0, unit: "1", above: 0.0)]
    pub range: f64,
}

impl Fluid {
    /// A viscosity (Pa s) and a density (kg/m³).
    pub fn new(viscosity: f64, density: f64) -> Self {
        Self {
            viscosity,
            density,
            bulk_modulus: None,
            shear: false,
            lubrication: None,
        }
    }

    fn check(&self) -> Result<(), CoupledError> {
        let (mu, rho) = (self.viscosity, self.density);
        require("the viscosity is", mu, POSITIVE, mu > 0.0)?;
        let valid = "at least 0 and finite";
        require("the fluid's density is", rho, valid, rho >= 0.0)?;
        if let Some(Lubrication { roughness, range }) = self.lubrication {
            let what = "the roughness of lubrication is";
            require(what, roughness, POSITIVE, roughness > 0.0)?;
            let valid = "above the roughness and finite";
            let what = "the range of lubrication is";
            require(what, range, valid, range > roughness)?;
        }
        let k = self.bulk_modulus.unwrap_or(1.0);
        Ok(require("the bulk modulus is", k, POSITIVE, k > 0.0)?)
    }
}

/// When pores are found anew.
///
/// The largest volumetric strain of a pore is summed step by step; at `strain` the mesh is made anew. Source: Catalano
/// 2012, Eqs. (5.13), (5.14).
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Remeshing {
    /// ε_RTRG; zero remeshes at every step, `None` by the number of steps only.
    pub strain: Option<f64>,
    /// Steps after which it is done at any strain.
    pub most_steps: Option<u64>,
}

impl Default for Remeshing {
    /// 1 %, and no limit of steps.
    fn default() -> Self {
        Self {
            strain: Some(0.01),
            most_steps: None,
        }
    }
}

/// Everything about the fluid that a [`crate::coupled::CoupledSystem`] starts from.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct FlowSetup {
    /// The fluid.
    pub fluid: Fluid,
    /// One side per wall, in the order of the grains' walls.
    pub sides: Vec<WallBoundary>,
    /// When pores are found anew.
    pub remeshing: Remeshing,
    /// Sums of solid angles.
    pub angles: SolidAngles,
    /// Solver of the pressures.
    pub solver: Solver,
}

impl FlowSetup {
    /// A fluid in a box whose six walls are closed and smooth.
    pub fn new(fluid: Fluid) -> Self {
        Self {
            fluid,
            sides: vec![WallBoundary::closed(); 6],
            remeshing: Remeshing::default(),
            angles: SolidAngles::Signed,
            solver: Solver::Automatic,
        }
    }

    /// The same with another side at a wall; nothing happens if there is no such wall.
    #[must_use]
    pub fn side(mut self, wall: usize, side: WallBoundary) -> Self {
        if let Some(slot) = self.sides.get_mut(wall) {
            *slot = side;
        }
        self
    }

    pub(crate) fn check(&self, grains: &GrainSystem) -> Result<(), CoupledError> {
        if !grains.meshes.is_empty() {
            return Err(CoupledError::Meshes(grains.meshes.len()));
        }
        if let Some(axis) = grains.period.iter().position(Option::is_some) {
            return Err(CoupledError::Periodic(axis));
        }
        let walls = grains.walls.len();
        self.fluid.check()?;
        if self.sides.len() != walls {
            return Err(CoupledError::Sides(self.sides.len(), walls));
        }
        for (wall, side) in self.sides.iter().enumerate() {
            side.check(wall)?;
        }
        let finite = |strain: &f64| *strain != f64::INFINITY;
        let strain = self.remeshing.strain.filter(finite).unwrap_or_default();
        let what = "the strain for remeshing is";
        Ok(require(what, strain, AT_LEAST_0, strain >= 0.0)?)
    }
}
