//! The system: made, evaluated, integrated, steered, resumed.

use std::ops::{Deref, DerefMut};

use crate::grains::{
    ContactLaw, Control, GrainError, Grains, Limit, MEMORY, Setup, State, Vector, check_period,
    finite, positive,
};
use crate::{BELOW_1, require};

/// Steps between two computations of the critical one.
const CHECKED_EVERY: u64 = 100;

/// Grains with their walls, meshes and contacts: a [`State`] that moves by contact laws.
///
/// A step is [`GrainSystem::evaluate`] (contacts and their forces where the grains are) and
/// [`GrainSystem::integrate`] (velocities, then positions). Results are the same bit for bit on any number of
/// threads: a contact is computed once, and each grain sums its own contacts in the order of their numbers.
#[derive(Debug)]
pub struct GrainSystem {
    pub(crate) state: State,
    pub(crate) laws: Vec<Box<dyn ContactLaw>>,
}

impl Deref for GrainSystem {
    type Target = State;

    fn deref(&self) -> &State {
        &self.state
    }
}

impl DerefMut for GrainSystem {
    fn deref_mut(&mut self) -> &mut State {
        &mut self.state
    }
}

impl GrainSystem {
    /// Checks everything and finds the first contacts.
    ///
    /// # Errors
    /// No grains; radii and densities that are not positive, places that are not finite; laws out of range;
    /// grains that overlap by more than a tenth of the smaller radius, or that reach so far into a wall or a
    /// triangle, or are beyond a wall; periods that are too short; walls and meshes that are none. All name
    /// the grain and the value.
    pub fn new(setup: Setup) -> Result<Self, GrainError> {
        for (number, grain) in setup.grains.iter().enumerate() {
            grain.check(number)?;
        }
        let grains = Grains::new(&setup.grains);
        let state = State {
            skin: setup.skin.unwrap_or(0.2 * grains.mean_radius()),
            grains,
            walls: setup.walls,
            meshes: setup.meshes,
            period: setup.period,
            gravity: setup.gravity,
            damping: setup.damping,
            ..State::default()
        };
        let laws = setup.laws;
        let mut system = Self { state, laws };
        system.check()?;
        system.renew();
        system.check_overlaps()?;
        Ok(system)
    }

    /// Conditions at the start and after a resumption.
    pub(crate) fn check(&self) -> Result<(), GrainError> {
        let most = 1 << 26;
        let grains = self.grains.len();
        if grains == 0 {
            return Err(GrainError::NoGrains);
        }
        if grains > most {
            return Err(GrainError::TooMany(grains, most));
        }
        require("the skin is", self.skin, "positive", self.skin > 0.0)?;
        check_damping(self.damping)?;
        require("the gravity is", self.gravity.norm(), "finite", true)?;
        self.check_laws()?;
        check_period(&self.period, 2.0 * self.grains.largest_radius() + self.skin)?;
        for (w, wall) in self.walls.iter().enumerate() {
            wall.check(w)?;
            for (axis, ends) in self.period.iter().enumerate() {
                if ends.is_some() && wall.normal[axis] != 0.0 {
                    let problem = format!("is turned towards axis {axis}, which is periodic");
                    return Err(GrainError::BadWall(w, problem));
                }
            }
        }
        for (m, mesh) in self.meshes.iter().enumerate() {
            mesh.check(m)?;
        }
        for (grain, position) in self.grains.position.iter().enumerate() {
            for (axis, ends) in self.period.iter().enumerate() {
                let x = position[axis];
                if let Some([from, to]) = *ends
                    && !(from..=to).contains(&x)
                {
                    return Err(GrainError::OutsidePeriod(grain, axis, x, [from, to]));
                }
            }
        }
        Ok(())
    }

    fn check_laws(&self) -> Result<(), GrainError> {
        let laws = self.laws.len();
        for (number, law) in self.laws.iter().enumerate() {
            law.check()?;
            let wanted = law.memory().len();
            if wanted > MEMORY {
                return Err(GrainError::Memory(number, wanted, MEMORY));
            }
        }
        let walls = self.walls.iter().map(|w| w.law).enumerate();
        let meshes = self.meshes.iter().map(|m| m.law).enumerate();
        let named = std::iter::once(("grain", (0, 0)));
        let named = named.chain(walls.map(|w| ("wall", w)));
        for (what, (number, law)) in named.chain(meshes.map(|m| ("mesh", m))) {
            if law >= laws {
                return Err(GrainError::NoLaw(what, number, law, laws));
            }
        }
        Ok(())
    }

    /// Finds the contacts where the grains are now and computes their forces.
    ///
    /// A second call without a motion between changes nothing.
    ///
    /// # Errors
    /// [`GrainError::NotFinite`] with the grain that flew away.
    pub fn evaluate(&mut self) -> Result<(), GrainError> {
        for (grain, position) in self.grains.position.iter().enumerate() {
            finite(grain, "position", position)?;
        }
        if self.expired() {
            self.renew();
        }
        let (state, laws) = (&mut self.state, &self.laws);
        let mut table = std::mem::take(&mut state.table);
        let mut parts = table.parts();
        if let Some(pairs) = parts.next() {
            state.at_grains(pairs, &*laws[0]);
        }
        for (number, slots) in (0..state.walls.len()).zip(parts.by_ref()) {
            let law = &*laws[state.walls[number].law];
            state.at_wall(slots, &state.walls[number], law);
            let (grains, wall) = (&state.grains, &mut state.walls[number]);
            let active = slots.iter().filter(|s| s.active);
            let zero = (Vector::zeros(), 0.0);
            (wall.force, wall.stiffness) = active.fold(zero, |(force, stiffness), s| {
                let radius = [grains.radius[s.first as usize], f64::INFINITY];
                let more = match wall.control {
                    Control::Stress { .. } => law.stiffness(radius, s.overlap).normal,
                    _ => 0.0,
                };
                (force - s.force, stiffness + more)
            });
        }
        for (number, slots) in (0..state.meshes.len()).zip(parts) {
            let law = &*laws[state.meshes[number].law];
            state.at_mesh(slots, &state.meshes[number], law);
            let (grains, mesh) = (&state.grains, &mut state.meshes[number]);
            (mesh.force, mesh.torque) = (Vector::zeros(), Vector::zeros());
            for slot in slots.iter().filter(|s| s.active) {
                let grain = slot.first as usize;
                let lever = grains.radius[grain] - 0.5 * slot.overlap;
                let arm = grains.position[grain] - slot.normal * lever - mesh.centre;
                mesh.force -= slot.force;
                mesh.torque += slot.torque[1] - arm.cross(&slot.force);
            }
        }
        state.table = table;
        self.last_step = 0.0;
        self.gather();
        Ok(())
    }

    /// One step (s): evaluation, then integration.
    ///
    /// # Errors
    /// As [`GrainSystem::evaluate`] and [`GrainSystem::integrate`].
    pub fn step(&mut self, step: f64) -> Result<(), GrainError> {
        self.evaluate()?;
        self.integrate(step)
    }

    /// Velocities and positions after a step (s) under the forces of the last evaluation, gravity and the
    /// external forces: the leap-frog of Catalano 2012, Eqs. (2.1) to (2.3).
    ///
    /// # Errors
    /// [`GrainError::StepTooLarge`] above [`GrainSystem::critical_step`], which is computed anew every hundred
    /// steps; nothing is moved then. A step that is not positive and finite. A pressed wall of unknown area.
    pub fn integrate(&mut self, step: f64) -> Result<(), GrainError> {
        require("the step is", step, "positive", step > 0.0)?;
        let limit = self.fresh_limit();
        if step > limit.step {
            return Err(GrainError::StepTooLarge(step, limit.step, limit.grain));
        }
        self.integrate_unchecked(step)
    }

    /// The same without asking for the critical step: for callers with a better limit.
    ///
    /// # Errors
    /// A pressed wall of unknown area, a step too short to move the clock, [`GrainError::TooDeep`]; nothing is moved
    /// then.
    pub fn integrate_unchecked(&mut self, step: f64) -> Result<(), GrainError> {
        let moves = self.time + step > self.time;
        require("the step is", step, "long enough to move the clock", moves)?;
        self.check_depths()?;
        self.steer_walls(step)?;
        self.advance_grains(step);
        for wall in &mut self.walls {
            wall.point += wall.velocity * step;
        }
        for mesh in &mut self.meshes {
            mesh.advance(step);
        }
        self.last_step = step;
        self.time += step;
        self.steps += 1;
        Ok(())
    }

    /// The critical step as it was found at most a hundred steps ago, s.
    pub fn current_limit(&mut self) -> f64 {
        self.fresh_limit().step
    }

    fn fresh_limit(&mut self) -> Limit {
        let kept = self.limit.filter(|_| self.steps < self.limit_due);
        *match kept {
            Some(limit) => self.limit.insert(limit),
            None => {
                self.limit_due = self.steps + CHECKED_EVERY;
                let limit = self.critical();
                self.limit.insert(limit)
            }
        }
    }

    /// Sets the clock to zero, as when a preparation is over. Nothing else changes.
    pub fn restart_clock(&mut self) {
        (self.time, self.steps, self.limit_due) = (0.0, 0, 0);
    }

    /// Sets the coefficient of non-viscous damping; zero where a fluid damps.
    ///
    /// # Errors
    /// Unless it is at least 0 and below 1.
    pub fn set_damping(&mut self, damping: f64) -> Result<(), GrainError> {
        check_damping(damping)?;
        self.damping = damping;
        Ok(())
    }

    /// Replaces a contact law, as when the friction of the preparation gives way to that of the test. The memory of
    /// contacts stays.
    ///
    /// # Errors
    /// Parameters out of range; no law of that number.
    pub fn set_law(&mut self, number: usize, law: Box<dyn ContactLaw>) -> Result<(), GrainError> {
        law.check()?;
        let laws = self.laws.len();
        let slot = self.laws.get_mut(number);
        *slot.ok_or(GrainError::NoLaw("grain", 0, number, laws))? = law;
        self.limit = None;
        self.check()
    }

    /// Multiplies all radii; masses and moments of inertia follow with their third and fifth power.
    ///
    /// # Errors
    /// A factor that is not positive and finite; a period that becomes too short.
    pub fn scale_radii(&mut self, factor: f64) -> Result<(), GrainError> {
        let what = "the factor of the radii is";
        require(what, factor, "positive", factor > 0.0)?;
        for radius in &mut self.grains.radius {
            *radius *= factor;
        }
        self.grains.weigh();
        check_period(&self.period, 2.0 * self.grains.largest_radius() + self.skin)
    }

    /// State to resume.
    pub fn save(&self) -> State {
        self.state.clone()
    }

    /// Goes on from a saved state with the same laws. The lists of neighbours are made anew, which changes no
    /// bit of what follows: contacts are summed in the order of the grains' numbers, whatever else is in the lists.
    ///
    /// # Errors
    /// A state whose parts do not fit together, and laws out of range.
    pub fn resume(state: State, laws: Vec<Box<dyn ContactLaw>>) -> Result<Self, GrainError> {
        let bad = |problem| Err(GrainError::BadState(problem));
        let (table, n) = (&state.table, state.grains.len());
        if !state.grains.fits() {
            return bad("columns of the grains differ in length");
        }
        let parts = 1 + state.walls.len() + state.meshes.len();
        let ordered = table.ends.is_sorted() && table.ends.last() == Some(&table.slots.len());
        if table.ends.len() != parts || !ordered {
            return bad("contacts do not fit the walls and meshes");
        }
        for part in 0..parts {
            let most = match part.checked_sub(1 + state.walls.len()) {
                Some(mesh) => state.meshes[mesh].triangles.len(),
                None => n,
            };
            let known = |k: usize| {
                let slot = &table.slots[k];
                (slot.first as usize) < n && (slot.second as usize) < most
            };
            if !table.part(part).all(known) {
                return bad("a contact names a body that is not there");
            }
        }
        for i in 0..n {
            positive(i, "radius", state.grains.radius[i])?;
            positive(i, "mass", state.grains.mass[i])?;
        }
        let mut system = Self { state, laws };
        system.check()?;
        system.renew();
        Ok(system)
    }
}

pub(crate) fn check_damping(damping: f64) -> Result<(), GrainError> {
    let fine = (0.0..1.0).contains(&damping);
    Ok(require("the damping is", damping, BELOW_1, fine)?)
}
