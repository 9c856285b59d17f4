//! The stage of the velocity gradient.

use std::sync::Arc;

use nalgebra::SMatrix;
use sph_core::{Access, Declares, Stage, StepError, Vect, fields};
use sph_neighbours::{Lane, LanePair, PairSum, Particles, World, walk_in_lanes};

use crate::stress::VelocityGradient;
use crate::stress::gathered::{Gathered, LaneSums, add_free};

/// [`VELOCITY_GRADIENT`](fields::VELOCITY_GRADIENT) by a formula.
///
/// All phases count. Walls that do not rub take part in the gradient of the component normal to them alone.
#[derive(Clone)]
pub struct GradientStage<const D: usize> {
    /// The formula.
    pub formula: Arc<dyn VelocityGradient<D>>,
    /// By phase number, whose gradients are read; those of the others are zero. All, if left out.
    pub phases: Option<Arc<[bool]>>,
}

impl<const D: usize> GradientStage<D> {
    /// For the particles of all phases.
    pub fn everywhere(formula: Arc<dyn VelocityGradient<D>>) -> Self {
        let phases = None;
        GradientStage { formula, phases }
    }
}

impl<const D: usize> Declares for GradientStage<D> {
    fn name(&self) -> String {
        "velocity gradient".into()
    }
    fn access(&self) -> Access {
        let access = Access::none()
            .both(fields::POSITION)
            .both(fields::VELOCITY)
            .neighbours(fields::VOLUME)
            .writes(fields::VELOCITY_GRADIENT);
        match self.phases {
            Some(_) => access.here(fields::PHASE),
            None => access,
        }
    }
}

impl<const D: usize> Stage<World<D>> for GradientStage<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut gradients = world.free.take(fields::VELOCITY_GRADIENT)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let volume = world.free.get(fields::VOLUME)?;
        let read = match &self.phases {
            Some(phases) => Some((phases, world.free.get(fields::PHASE)?)),
            None => None,
        };
        if read.is_some() {
            gradients.fill(SMatrix::zeros());
        }
        let wanted = |i: usize| read.is_none_or(|(phases, of)| phases[of[i] as usize]);
        let free = FreeSums { velocity, volume };
        let walls = &world.walls;
        walk_in_lanes(world, &free, wanted, &mut gradients, |sums, rows| {
            let own = &velocity[rows.particle];
            let gathered = Gathered::default().with(sums).with_walls(own, walls, rows);
            gathered.gradient(&*self.formula, rows.inverse_renormalisation)
        })?;
        Ok(world.free.put(fields::VELOCITY_GRADIENT, gradients)?)
    }
}

/// Contributions of free neighbours to [`NeighbourSums`]: velocity, then position.
struct FreeSums<'a, const D: usize> {
    velocity: &'a [Vect<D>],
    volume: &'a [f64],
}

impl<const D: usize> PairSum<D> for FreeSums<'_, D> {
    type Own<L: Lane> = [L; D];
    type Sum<L: Lane> = LaneSums<L, D>;

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> [L; D] {
        all.vectors(self.velocity)
    }
    #[inline(always)]
    fn pair<L: Lane>(
        &self,
        own: &[L; D],
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut LaneSums<L, D>,
    ) {
        add_free(own, &self.velocity[j], self.volume[j], pair, sum);
    }
}
