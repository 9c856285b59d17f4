//! The work of an evaluation: of the walls, of stages, and the interaction sweep.

use std::sync::Arc;

use rayon::prelude::*;
use sph_boundary::Wall;
use sph_core::{Access, AnyField, Declares, Stage, StepError, Vect, fields};
use sph_multiphase::Diffused;
use sph_neighbours::decomposition::Parts;
use sph_neighbours::{
    Interaction, Sums, SweepHalf, TRANSPORTED, World, all_sums, declared, is_wanted,
};

sph_core::fields! {
    /// Stands for all that walls carry; not a column of the free particles.
    pub WALL_STATE: Scalar = "wall_state", "Pa", "pressure and volume at wall points and elements";
}

/// A piece of work of an evaluation: of the walls, which the flow has, or a stage.
pub enum Work<const D: usize> {
    /// Contacts, and the kernel at walls.
    WallGeometry {
        /// The columns of that.
        columns: Vec<AnyField>,
    },
    /// Pressures and volumes at the walls.
    WallState,
    /// Stages and terms of a piece of physics.
    Stage(Box<dyn Stage<World<D>>>),
}

impl<const D: usize> Work<D> {
    /// Does the work.
    ///
    /// # Errors
    /// Those of the stage, or of the walls.
    pub fn run(
        &mut self,
        world: &mut World<D>,
        walls: Option<&mut dyn Wall<D>>,
    ) -> Result<(), StepError> {
        match (self, walls) {
            (Work::WallGeometry { .. }, Some(walls)) => walls.geometry(world),
            (Work::WallState, Some(walls)) => walls.state(world),
            (Work::WallGeometry { .. } | Work::WallState, None) => Ok(()),
            (Work::Stage(stage), _) => stage.run(world),
        }
    }

    /// Memory of the system that it solved last, bytes.
    pub fn bytes(&self) -> usize {
        self.stage().map_or(0, |stage| stage.bytes())
    }

    /// The stage, if this is one.
    pub fn stage(&self) -> Option<&dyn Stage<World<D>>> {
        match self {
            Work::Stage(stage) => Some(&**stage),
            Work::WallGeometry { .. } | Work::WallState => None,
        }
    }
}

impl<const D: usize> Declares for Work<D> {
    fn name(&self) -> String {
        match self {
            Work::WallGeometry { .. } => "wall geometry".into(),
            Work::WallState => "wall state".into(),
            Work::Stage(stage) => stage.name(),
        }
    }
    fn access(&self) -> Access {
        match self {
            Work::WallGeometry { columns } => {
                let mut access = Access::none().here((fields::POSITION, fields::IDENTITY));
                access.writes.extend(columns);
                access
            }
            Work::WallState => Access::none()
                .neighbours((fields::POSITION, fields::VELOCITY, fields::PRESSURE))
                .neighbours((fields::DENSITY, fields::VOLUME))
                .here(fields::IDENTITY)
                .where_there(fields::PHASE)
                .writes(WALL_STATE),
            Work::Stage(stage) => stage.access(),
        }
    }
}

/// All pair terms in one walk.
pub struct InteractionSweep<const D: usize> {
    terms: Arc<[Box<dyn Interaction<D>>]>,
    /// The column that density diffusion changes, if there is any.
    diffused: Option<Diffused>,
    walls: bool,
    declared: Vec<Access>,
    more: Vec<[f64; TRANSPORTED]>,
}

impl<const D: usize> InteractionSweep<D> {
    /// Of these terms; with the quantity of density diffusion, if there is any, and true if walls exist.
    pub fn new(
        terms: Arc<[Box<dyn Interaction<D>>]>,
        diffused: Option<Diffused>,
        walls: bool,
    ) -> Self {
        InteractionSweep {
            declared: declared(&terms),
            terms,
            diffused,
            walls,
            more: Vec::new(),
        }
    }

    fn sweep(
        &mut self,
        world: &World<D>,
        acceleration: &mut [Vect<D>],
        scalar: Option<&mut [f64]>,
    ) -> Result<(), StepError> {
        let wanted = match world.transported.is_empty() {
            true => 0,
            false => acceleration.len(),
        };
        self.more.resize(wanted, [0.0; TRANSPORTED]);
        let sums = Sums {
            acceleration,
            scalar,
            more: &mut self.more,
        };
        all_sums(world, &self.declared, &self.terms, sums)
    }

    fn spread(&self, world: &mut World<D>) -> Result<(), StepError> {
        for (slot, field) in world.transported.iter().enumerate() {
            let rates = world.free.get_mut(field.scalar())?.par_iter_mut();
            let all = rates.zip(&self.more).with_min_len(2048);
            all.for_each(|(rate, more)| *rate = more[slot]);
        }
        Ok(())
    }
}

impl<const D: usize> Declares for InteractionSweep<D> {
    fn name(&self) -> String {
        let names: Vec<_> = self.terms.iter().map(|t| t.name()).collect();
        format!("interactions ({})", names.join("; "))
    }
    fn access(&self) -> Access {
        let mut access = Access::none()
            .both(fields::POSITION)
            .writes(fields::ACCELERATION);
        if let Some(diffused) = &self.diffused {
            access = access.here((fields::DENSITY, fields::VOLUME));
            access = access.writes(diffused.evolved.rate);
        }
        if self.walls {
            access = access.here(WALL_STATE);
        }
        self.terms
            .iter()
            .fold(access, |access, t| access.and(t.access()))
    }
}

impl<const D: usize> Stage<World<D>> for InteractionSweep<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut acceleration = world.free.take(fields::ACCELERATION)?;
        match self.diffused {
            Some(diffused) => {
                let field = diffused.evolved.rate;
                let mut scalar = world.free.take(field)?;
                self.sweep(world, &mut acceleration, Some(&mut scalar))?;
                let free = &world.free;
                let (density, volume) = free.all((fields::DENSITY, fields::VOLUME))?;
                let gamma = world.sum_renormalisation();
                let half = world.lists.sweep_half.as_ref();
                let rates = scalar.par_iter_mut().zip(density).zip(volume).enumerate();
                rates.with_min_len(2048).for_each(|(i, ((rate, rho), v))| {
                    if is_wanted(half, i) {
                        *rate *= (diffused.per_density)(*rho, *v, gamma.map_or(1.0, |g| g[i]));
                    }
                });
                world.free.put(field, scalar)?;
            }
            None => self.sweep(world, &mut acceleration, None)?,
        }
        self.spread(world)?;
        Ok(world.free.put(fields::ACCELERATION, acceleration)?)
    }
    fn halves(&self) -> bool {
        true
    }
}

/// Runs a piece of work and gives ghosts its results: where it may run in halves, those that are ghosts elsewhere come
/// first, and the others while the messages are on their way.
pub(crate) fn run_and_update_ghosts<const D: usize>(
    work: &mut Work<D>,
    access: &Access,
    parts: Option<&Parts<D>>,
    world: &mut World<D>,
    walls: Option<&mut dyn Wall<D>>,
) -> Result<(), StepError> {
    if let (Work::Stage(stage), Some(parts)) = (&mut *work, parts)
        && stage.halves()
    {
        let sent = parts.sent(world.free.len());
        world.lists.sweep_half = Some(SweepHalf::first(world.lists.nearest(), &sent));
        let done = in_halves(&mut **stage, access, parts, world);
        world.lists.sweep_half = None;
        return done;
    }
    world.free.watch([access]);
    let ran = work.run(world, walls);
    world.free.unwatch(|| work.name()).and(ran)?;
    world.refresh(access)
}

fn in_halves<const D: usize>(
    stage: &mut dyn Stage<World<D>>,
    access: &Access,
    parts: &Parts<D>,
    world: &mut World<D>,
) -> Result<(), StepError> {
    watched(stage, access, world)?;
    let mut rest = Ok(());
    let told = parts.update_ghosts_during(
        world,
        |f| access.writes.contains(f),
        |world| {
            world.lists.sweep_half = world.lists.sweep_half.take().map(SweepHalf::second);
            rest = watched(stage, access, world);
        },
    );
    rest?;
    Ok(told?)
}

/// Runs half of a stage, which is held to its declaration.
fn watched<const D: usize>(
    stage: &mut dyn Stage<World<D>>,
    access: &Access,
    world: &mut World<D>,
) -> Result<(), StepError> {
    world.free.watch([access]);
    let ran = stage.run(world);
    world.free.unwatch(|| stage.name()).and(ran)
}
