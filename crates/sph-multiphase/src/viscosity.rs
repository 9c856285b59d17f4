//! Where pair terms read the viscosity: one number, or a column with harmonic means.

use sph_core::{Access, StepError, fields};
use sph_neighbours::World;

/// A source of viscosities for a pair term.
pub trait ViscositySource: Copy + Send + Sync + 'static {
    /// The source with its column.
    type Bound<'a>: BoundViscosity + 'a;
    /// Columns read.
    fn access(self) -> Access;
    /// Looks the column up.
    ///
    /// # Errors
    /// If the column is missing.
    fn bind<const D: usize>(self, world: &World<D>) -> Result<Self::Bound<'_>, StepError>;
}

/// Viscosities of particles and pairs.
pub trait BoundViscosity: Copy + Sync {
    /// η of a particle, Pa s.
    fn at(&self, particle: usize) -> f64;
    /// Harmonic mean 2 η_a η_b / (η_a + η_b), Ghaïtanellis 2017, Eq. 3.30.
    fn mean(&self, here: f64, neighbour: usize) -> f64;
}

/// The same viscosity everywhere, Pa s.
#[derive(Clone, Copy, Debug)]
pub struct Uniform(pub f64);

impl ViscositySource for Uniform {
    type Bound<'a> = Uniform;
    fn access(self) -> Access {
        Access::none()
    }
    fn bind<const D: usize>(self, _world: &World<D>) -> Result<Uniform, StepError> {
        Ok(self)
    }
}

impl BoundViscosity for Uniform {
    #[inline(always)]
    fn at(&self, _particle: usize) -> f64 {
        self.0
    }
    #[inline(always)]
    fn mean(&self, here: f64, _neighbour: usize) -> f64 {
        here
    }
}

/// The viscosity column.
#[derive(Clone, Copy, Debug)]
pub struct PerParticle;

/// The viscosity column, found.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a>(&'a [f64]);

impl ViscositySource for PerParticle {
    type Bound<'a> = Column<'a>;
    fn access(self) -> Access {
        Access::none().both(fields::VISCOSITY)
    }
    fn bind<const D: usize>(self, world: &World<D>) -> Result<Column<'_>, StepError> {
        Ok(Column(world.free.get(fields::VISCOSITY)?))
    }
}

impl BoundViscosity for Column<'_> {
    #[inline(always)]
    fn at(&self, particle: usize) -> f64 {
        self.0[particle]
    }
    #[inline(always)]
    fn mean(&self, here: f64, neighbour: usize) -> f64 {
        let there = self.0[neighbour];
        // Zero viscosity on either side means no friction, not 0/0.
        let sum = here + there;
        if sum > 0.0 {
            2.0 * here * there / sum
        } else {
            0.0
        }
    }
}
