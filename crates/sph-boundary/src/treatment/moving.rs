//! Outlines that move: by prescribed courses and by movers.

use sph_core::Vect;
use sph_core::bed::Bed;
use sph_neighbours::{DepthGauge, FreeBody, WallForce};

use crate::treatment::contract::{is_piece, pieces};
use crate::treatment::outline::{Outline, Placement, poses};
use crate::{BoundaryError, Load, Mover, Pose, Result, RigidState, WallMesh, WallSpec, WallStates};

/// The longest way of any point of a wall within a step, over the spacing: farther, it would leap over particles.
const MOST_WAY: f64 = 0.5;
/// The most that a bed may rise, over the height within which walls in it stretch.
const HIGHEST: f64 = 0.9;

impl<const D: usize, M: WallMesh<D>> Outline<D, M> {
    /// The states at a time; those of walls with movers are taken from `others`.
    fn states_at(&self, time: f64, others: &[RigidState<D>]) -> Vec<RigidState<D>> {
        let specs = self.specs.iter().enumerate();
        let state = |(k, spec): (usize, &WallSpec<D>)| match spec.mover {
            Some(_) => others[k],
            None => spec.motion.state(time),
        };
        specs.map(state).collect()
    }

    /// Moves the mesh on by `dt`; returns whether anything moved.
    pub fn advance(
        &mut self,
        forces: &[WallForce<D>],
        bodies: &[FreeBody<D>],
        gravity: Vect<D>,
        [time, dt]: [f64; 2],
    ) -> Result<bool> {
        let load = |k: usize| self.load(k, forces, gravity);
        let mut loads: Vec<_> = (0..self.specs.len()).map(load).collect();
        self.check_dry(&loads)?;
        let mut states = self.free_states(&mut loads, gravity, [time, dt])?;
        self.compare(&mut states, bodies, dt);
        let before = self.mesh.places();
        let moved = self.put(states, time + dt)?;
        let most = MOST_WAY * self.spacing;
        for (node, before) in self.mesh.nodes().iter().zip(before) {
            let way = (Vect::from(node.position) - before).norm();
            if way > most {
                let why = format!(
                    "moves by {way:.3e} m in one step, and {most:.3e} m, half a spacing, is the most"
                );
                return Err(BoundaryError::unfit(self.name(node.wall), why));
            }
        }
        Ok(moved)
    }

    /// Takes beds with new rates, and lets their levels go on for `dt`.
    ///
    /// # Errors
    /// A bed that rises to the top of the walls that stand in it.
    pub fn grow(&mut self, beds: Vec<Bed>, dt: f64) -> Result<()> {
        for (bed, mut grown) in self.now.beds.iter_mut().zip(beds) {
            let both = grown.lift.iter_mut().zip(&grown.rate);
            both.for_each(|(lift, rate)| *lift += dt * rate);
            let highest = grown.lift.iter().fold(0.0, |a: f64, b| a.max(*b));
            if highest.is_nan() || highest >= HIGHEST * grown.fade {
                let (wall, height) = (self.name(grown.walls[0] as usize), grown.fade);
                return Err(BoundaryError(format!(
                    "the bed `{wall}` has risen by {highest:.3} m, and walls that stand in it stretch over {height} m: \
                     give `[wall.{wall}.erodible]` a larger `stretch`"
                )));
            }
            *bed = grown;
        }
        Ok(())
    }

    /// Refuses fluid at bodies that are too light for any.
    fn check_dry(&self, loads: &[Load<D>]) -> Result<()> {
        for (k, touch) in self.touches().into_iter().enumerate() {
            if touch.is_some_and(|t| t.dry) && loads[k].force != Vect::<D>::zeros() {
                return Err(BoundaryError(format!(
                    "fluid acts on the body `{}`, which has less than a fiftieth of its density: one particle of it \
                     would throw the body; give it more `density`",
                    self.name(k)
                )));
            }
        }
        Ok(())
    }

    /// Notes how fast velocities changed over a step, and by how much otherwise than the solves have expected.
    fn compare(&self, states: &mut [RigidState<D>], bodies: &[FreeBody<D>], dt: f64) {
        for (k, _) in self.movers() {
            let mut state = states[k];
            state.rate = state.rate_from(&self.now.states[k], dt);
            if let Some(body) = bodies.iter().find(|body| body.is(k)) {
                let missed = |i: usize| state.rate[i] * dt - body.expected[i];
                state.missed = std::array::from_fn(missed);
            }
            states[pieces(&self.specs, k)].fill(state);
        }
    }

    /// The states after a step from given ones.
    ///
    /// # Errors
    /// A wall whose state is no number.
    pub(crate) fn after(
        &self,
        from: &[RigidState<D>],
        loads: &[Load<D>],
        [time, dt]: [f64; 2],
    ) -> Result<Vec<RigidState<D>>> {
        let mut states = self.states_at(time + dt, from);
        for (k, mover) in self.movers() {
            let state = mover.next(&from[k], &loads[k], time, dt);
            if RigidState::<D>::from_numbers(&state.numbers()).is_none() {
                return Err(BoundaryError::motion(self.name(k)));
            }
            states[pieces(&self.specs, k)].fill(state);
        }
        Ok(states)
    }

    fn load(&self, wall: usize, forces: &[WallForce<D>], gravity: Vect<D>) -> Load<D> {
        if self.specs[wall].mover.is_none() || is_piece(&self.specs, wall) {
            return Load::of_gravity(gravity);
        }
        let mut whole = WallForce::zero();
        for k in pieces(&self.specs, wall) {
            let parts = [forces.get(k), self.struck.get(k)];
            parts.into_iter().flatten().for_each(|f| whole.add(f));
        }
        Load {
            force: whole.force,
            moment: whole.moment,
            depth: Some(whole.depth).filter(|depth| *depth > 0.0),
            ..Load::of_gravity(gravity)
        }
    }

    pub fn needs_forces(&self, wall: usize) -> bool {
        let mover = self.specs.get(wall).and_then(|spec| spec.mover.as_ref());
        mover.is_some_and(|mover| mover.needs_forces())
    }

    pub fn depth_gauges(&self) -> Vec<(usize, DepthGauge<D>)> {
        let all = self.movers();
        all.filter_map(|(k, mover)| Some((k, mover.looks(&self.now.states[k])?)))
            .collect()
    }

    /// The walls with movers, each by its first piece.
    fn movers(&self) -> impl Iterator<Item = (usize, &dyn Mover<D>)> {
        let all = (0..self.specs.len()).filter(|k| !is_piece(&self.specs, *k));
        all.filter_map(|k| Some((k, self.specs[k].mover.as_deref()?)))
    }

    pub fn numbers(&self) -> WallStates {
        let all = |at: &Placement<D>| -> Vec<f64> {
            let own = self.movers().flat_map(|(k, _)| at.states[k].numbers());
            own.chain(at.beds.iter().flat_map(Bed::numbers)).collect()
        };
        WallStates {
            now: all(&self.now),
            listed: Some(all(&self.listed)),
        }
    }

    /// Puts walls back where they were at a time; returns whether anything moved.
    pub fn put_back(&mut self, numbers: &WallStates, time: f64) -> Result<bool> {
        let given = |numbers: &[f64]| {
            let mut states = self.states_at(time, &self.now.states);
            let own = self.movers().count() * RigidState::<D>::NUMBERS;
            let (own, levels) = numbers.split_at(own.min(numbers.len()));
            let mut parts = own.chunks(RigidState::<D>::NUMBERS);
            let unsound = |wall: usize| BoundaryError::motion(self.name(wall));
            for (k, _) in self.movers() {
                let part = parts.next().and_then(RigidState::from_numbers);
                let state = part.ok_or_else(|| unsound(k))?;
                states[pieces(&self.specs, k)].fill(state);
            }
            let mut beds = self.now.beds.clone();
            let mut rest = levels;
            for bed in &mut beds {
                let wall = bed.walls[0] as usize;
                rest = bed.put(rest).ok_or_else(|| unsound(wall))?;
            }
            Ok::<_, BoundaryError>(Placement { states, beds })
        };
        let now = given(&numbers.now)?;
        let listed = numbers.listed.as_ref().map(|n| given(n)).transpose()?;
        if let Some(listed) = listed {
            self.listed = listed;
            self.put_back = true;
        }
        self.now.beds = now.beds;
        self.put(now.states, time)
    }

    fn put(&mut self, states: Vec<RigidState<D>>, time: f64) -> Result<bool> {
        let next = poses(&states);
        let moved = !self.now.beds.is_empty() || poses(&self.now.states) != next;
        if moved {
            place(&mut self.mesh, &next, &self.now.beds)?;
        }
        self.now.states = states;
        self.bodies = self.bodies_at(time);
        Ok(moved)
    }

    /// The walls that forces move, as they are at a time.
    pub fn bodies_at(&self, time: f64) -> Vec<FreeBody<D>> {
        let body = |(k, mover): (usize, &dyn Mover<D>)| {
            let (state, walls) = (&self.now.states[k], pieces(&self.specs, k));
            let mobility = mover.mobility(state, time)?;
            Some(FreeBody {
                walls: walls.start as u32..walls.end as u32,
                place: state.place(),
                domain: self.domain.clone(),
                mobility,
                rate: state.rate.into(),
                missed: state.missed.into(),
                expected: Default::default(),
            })
        };
        self.movers().filter_map(body).collect()
    }

    /// Asks the mesh something as if the walls were where they were at the last build of the lists, at a time.
    pub fn at_lists<R>(&mut self, time: f64, ask: impl FnOnce(&M) -> R) -> Result<R> {
        if !std::mem::take(&mut self.put_back) {
            self.listed.clone_from(&self.now);
        }
        if !self.moves() {
            return Ok(ask(&self.mesh));
        }
        let states = self.states_at(time, &self.listed.states);
        let (there, here) = (poses(&states), poses(&self.now.states));
        if there == here {
            return Ok(ask(&self.mesh));
        }
        place(&mut self.mesh, &there, &self.listed.beds)?;
        let answer = ask(&self.mesh);
        place(&mut self.mesh, &here, &self.now.beds)?;
        Ok(answer)
    }
}

fn place<const D: usize, M: WallMesh<D>>(
    mesh: &mut M,
    poses: &[Pose<D>],
    beds: &[Bed],
) -> Result<()> {
    beds.clone_into(&mut mesh.walls_mut().mesh.beds);
    mesh.move_walls(poses)
}
