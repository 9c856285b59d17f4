//! A wall treatment with open faces in it.

use sph_boundary::{BoundaryError, ThinWall, Wall, WallMotion, WallSetup, WallShape, WallStates};
use sph_core::{AnyField, StepError, Vect};
use sph_neighbours::{DepthGauge, WallSet, World};

use crate::faces::{SharedFaces, lock};

/// The walls of a scene; the values of their treatment at open faces is overwritten by the laws of these.
pub(crate) struct OpenWalls<const D: usize> {
    pub walls: Box<dyn Wall<D>>,
    pub faces: SharedFaces<D>,
}

impl<const D: usize> Wall<D> for OpenWalls<D> {
    fn lattice_offset(&self) -> f64 {
        self.walls.lattice_offset()
    }

    fn build(&mut self, setup: &WallSetup<'_, D>) -> Result<WallSet<D>, BoundaryError> {
        let mut walls = self.walls.build(setup)?;
        let kernel = setup.kernel.sampler(D, setup.smoothing_length);
        lock(&self.faces).find(&mut walls, &*kernel);
        Ok(walls)
    }

    fn columns(&self) -> Vec<AnyField> {
        self.walls.columns()
    }

    fn geometry(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        self.walls.geometry(world)
    }

    fn state(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        self.walls.state(world)?;
        let mut faces = lock(&self.faces);
        faces.look(world)?;
        faces.set_walls(&mut world.walls);
        Ok(())
    }

    fn constrain(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        self.walls.constrain(world, dt)
    }
}

impl<const D: usize> WallShape<D> for OpenWalls<D> {
    fn contains(&self, point: &Vect<D>) -> bool {
        self.walls.contains(point) || lock(&self.faces).waits(point)
    }

    fn enclosed(&self, point: &Vect<D>) -> Option<f64> {
        self.walls.enclosed(point)
    }

    fn clearance(&self, point: &Vect<D>, within: f64) -> Option<(f64, &str)> {
        self.walls.clearance(point, within)
    }

    fn ends_freely(&self) -> bool {
        self.walls.ends_freely()
    }

    fn check_free_ends(&self, points: &[Vect<D>]) -> Result<(), BoundaryError> {
        self.walls.check_free_ends(points)
    }

    fn thin_walls(&self, points: &[Vect<D>]) -> Vec<ThinWall<D>> {
        self.walls.thin_walls(points)
    }

    fn warnings(&self) -> Vec<String> {
        self.walls.warnings()
    }
}

impl<const D: usize> WallMotion<D> for OpenWalls<D> {
    fn advance(
        &mut self,
        walls: &mut WallSet<D>,
        gravity: Vect<D>,
        time: f64,
        dt: f64,
    ) -> Result<(), BoundaryError> {
        self.walls.advance(walls, gravity, time, dt)
    }

    fn needs_forces(&self, wall: usize) -> bool {
        self.walls.needs_forces(wall)
    }

    fn depth_gauges(&self) -> Vec<(usize, DepthGauge<D>)> {
        self.walls.depth_gauges()
    }

    /// The numbers of the faces stand behind those of the movers.
    fn states(&self) -> WallStates {
        let mut states = self.walls.states();
        lock(&self.faces).memory.numbers(&mut states.now);
        states
    }

    fn put_back(
        &mut self,
        walls: &mut WallSet<D>,
        states: &WallStates,
        time: f64,
    ) -> Result<(), BoundaryError> {
        let mut faces = lock(&self.faces);
        let own = states.now.len().checked_sub(faces.memory.count());
        let back = own.is_some_and(|own| faces.memory.put_back(&states.now[own..]));
        if !back {
            let wall = faces.faces.first().map(|f| f.name.clone());
            let wall = wall.unwrap_or_default();
            return Err(BoundaryError::motion(wall));
        }
        walls.passed = faces.passed(walls);
        drop(faces);
        let of_movers = WallStates {
            now: states.now[..own.unwrap_or(0)].to_vec(),
            listed: states.listed.clone(),
        };
        self.walls.put_back(walls, &of_movers, time)
    }
}
