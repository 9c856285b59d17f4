//! A zone as a flow of its own, which follows the flow around it.

use sph_core::{StepError, fields};
use sph_neighbours::WallForce;
use sph_solver::{Flow, Snapshot};

use super::stepper::Stepper;
use crate::zones::frame::Frame;
use crate::zones::sample::{Sample, Source, States};

/// A zone of finer particles.
pub(crate) struct Level<const D: usize> {
    /// Its name in the scene.
    pub name: String,
    frame: Frame<D>,
    pub stepper: Stepper<D>,
    /// The wall that carries it, if all of that is in its core: its forces are those of the finer particles.
    measures: Option<String>,
    /// Levels between the scene's spacing and the one around it.
    depth: usize,
    /// States to go back to, of the steps of each coarser level.
    kept: Vec<Snapshot<D>>,
}

impl<const D: usize> Level<D> {
    /// A zone with a shape, `frame`, in a flow `depth` levels below the coarsest.
    pub fn new(name: &str, frame: Frame<D>, stepper: Stepper<D>, depth: usize) -> Self {
        let walls = &stepper.parts.flow.world.walls;
        let within = |carrier: &&String| {
            let places = walls.points.position.iter().zip(&walls.points.wall);
            let own = places.filter(|(_, wall)| walls.names.get(**wall as usize) == Some(*carrier));
            let inside: Vec<bool> = own.map(|(x, _)| frame.in_core(x)).collect();
            !inside.is_empty() && !inside.contains(&false)
        };
        let measures = frame.carrier().filter(within).cloned();
        Level {
            name: name.into(),
            measures,
            frame,
            stepper,
            depth,
            kept: (0..=depth).map(|_| Snapshot::default()).collect(),
        }
    }

    /// Comes to the time of the flow around it, and gives the states of the particles of that in its core.
    ///
    /// # Errors
    /// A step of the zone that fails.
    pub fn follow(&mut self, around: &Flow<D>) -> Result<States<D>, StepError> {
        let time = around.world.time;
        if time < self.stepper.time() {
            self.put_back(self.depth)?;
        }
        self.stepper.look(around)?;
        if time > self.stepper.time() {
            self.keep(self.depth)?;
            self.stepper.hold()?;
            self.stepper.run_until(time).map_err(|e| self.named(e))?;
        }
        self.stepper.evaluate().map_err(|e| self.named(e))?;
        self.states(around)
    }

    /// Forces on the wall that carries it, if all of that is in its core.
    ///
    /// # Errors
    /// If a term misses a column.
    pub fn loads(&self) -> Result<Vec<(usize, WallForce<D>)>, StepError> {
        let flow = &self.stepper.parts.flow;
        let mut requests = flow.force_requests();
        let walls = flow.world.walls.names.iter();
        let own = requests.iter_mut().zip(walls);
        own.for_each(|(request, wall)| *request &= self.measures.as_ref() == Some(wall));
        if !requests.contains(&true) {
            return Ok(Vec::new());
        }
        let loads = flow.wall_loads(&requests)?.into_iter().enumerate();
        Ok(loads.filter(|(wall, _)| requests[*wall]).collect())
    }

    /// Its shape where it is now.
    pub fn frame(&self) -> Frame<D> {
        self.frame.at(&self.stepper.parts.flow)
    }

    /// States of the particles of the flow around that are in the core.
    fn states(&self, around: &Flow<D>) -> Result<States<D>, StepError> {
        let (own, scalars) = (&self.stepper.parts.flow, &self.stepper.coupling.scalars);
        // A fit in the core does not reach beyond the sides.
        let frame = self.frame();
        let sample = Sample::of_flow(own, scalars, |x| frame.holds(x, 0.0))?;
        let source = Source::new(&sample, &own.world.domain, own.world.spacing);
        let position = around.world.free.get(fields::POSITION)?;
        Ok(source.all(position, |x| frame.in_core(x), |_| false))
    }

    /// Keeps its state, and that of its zones, for a flow `depth` levels below the coarsest.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn keep(&mut self, depth: usize) -> Result<(), StepError> {
        self.kept[depth].take(&self.stepper.parts.flow)?;
        self.stepper.coupling.keep(depth)
    }

    /// Puts it back.
    ///
    /// # Errors
    /// If lists cannot be built.
    pub fn put_back(&mut self, depth: usize) -> Result<(), StepError> {
        self.kept[depth].restore(&mut self.stepper.parts.flow)?;
        self.stepper.changed();
        // The step of the flow around is a shorter one now.
        self.stepper.scale = 1.0;
        self.stepper.coupling.put_back(depth)
    }

    fn named(&self, cause: StepError) -> StepError {
        StepError::stage(format!("zone `{}`", self.name), cause.to_string())
    }
}
