//! The band around a zone, in which its particles follow those around.

use rayon::prelude::*;
use sph_contribution::Newborn;
use sph_core::{Slots, StepError, Vect, fields};
use sph_solver::Flow;

use super::frame::Frame;
use super::sample::{Sample, Source, State};

/// Distance from the band over the spacing around it, beyond which a finer particle has nothing to follow.
const LOST: f64 = 2.0;

/// Particles around a zone, and the band that follows them.
pub(crate) struct Guard<const D: usize> {
    pub frame: Frame<D>,
    /// Spacing around the zone, m.
    pub spacing: f64,
    before: Sample<D>,
    now: Sample<D>,
}

impl<const D: usize> Guard<D> {
    /// Around a zone, in particles with a spacing, m.
    pub fn new(frame: Frame<D>, spacing: f64) -> Self {
        Guard {
            frame,
            spacing,
            before: Sample::default(),
            now: Sample::default(),
        }
    }

    /// Takes the particles around the zone at a time that is the end of what it knows.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn look(&mut self, around: &Flow<D>) -> Result<(), StepError> {
        let margin = self.frame.band + 4.0 * self.spacing;
        let now = Sample::of_flow(around, |x| self.frame.holds(x, margin))?;
        self.before = std::mem::replace(&mut self.now, now);
        if self.before.time >= self.now.time {
            self.before = Sample::default();
        }
        Ok(())
    }

    /// States around the particles of a zone that are beyond its sides, at its time.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn in_band(&self, zone: &Flow<D>) -> Result<Vec<(usize, State<D>)>, StepError> {
        self.states(zone, |x| !self.frame.holds(x, 0.0))
    }

    /// The same of those between the core and the sides of the zone, where both flows are computed.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn in_overlap(&self, zone: &Flow<D>) -> Result<Vec<(usize, State<D>)>, StepError> {
        self.states(zone, |x| self.frame.in_overlap(x))
    }

    fn states(
        &self,
        zone: &Flow<D>,
        wanted: impl Fn(&Vect<D>) -> bool + Sync,
    ) -> Result<Vec<(usize, State<D>)>, StepError> {
        let world = &zone.world;
        let around = self.now.since(&self.before, &world.domain, world.time);
        let source = Source::new(&around, &world.domain, self.spacing);
        let position = world.free.get(fields::POSITION)?;
        let at = |(k, x): (usize, &Vect<D>)| {
            let state = wanted(x).then(|| source.at(x));
            Some((k, state.flatten()?))
        };
        let all = position.par_iter().enumerate().with_min_len(256);
        Ok(all.filter_map(at).collect())
    }

    /// Lets finer particles in where those around come into the band, and takes them out where those leave it, mass for
    /// mass. True if any did.
    ///
    /// # Errors
    /// A particle that cannot come in.
    pub fn exchange(&self, zone: &mut Flow<D>) -> Result<bool, StepError> {
        let slots = Slots::from_identities(&self.before.identities);
        let outer = self.frame.band;
        let (mut comes, mut goes) = (Vec::new(), Vec::new());
        for (k, id) in self.now.identities.iter().enumerate() {
            let Some(slot) = slots.slot(*id) else {
                continue;
            };
            let was = self
                .frame
                .holds(&self.before.positions[slot as usize], outer);
            match (was, self.frame.holds(&self.now.positions[k], outer)) {
                (false, true) => comes.push(k),
                (true, false) => goes.push(k),
                _ => {}
            }
        }
        let gone = self.take_out(zone, &goes)? | self.bring_back(zone)?;
        let births: Vec<_> = comes.iter().flat_map(|k| self.children(zone, *k)).collect();
        zone.insert(&births)?;
        Ok(gone || !births.is_empty())
    }

    /// Puts particles of the band that are behind a wall where the nearest particle around is. True if there are some.
    fn bring_back(&self, zone: &mut Flow<D>) -> Result<bool, StepError> {
        let Some(walls) = zone.walls.as_deref() else {
            return Ok(false);
        };
        let mut position = zone.world.free.take(fields::POSITION)?;
        let domain = &zone.world.domain;
        let mut some = false;
        for x in &mut position {
            if self.frame.holds(x, 0.0) || walls.contains(x) {
                continue;
            }
            let far = |y: &&Vect<D>| domain.nearest(*y - *x).norm();
            let places = self.now.positions.iter();
            if let Some(place) = places.min_by(|a, b| far(a).total_cmp(&far(b))) {
                *x = *place;
                some = true;
            }
        }
        zone.world.free.put(fields::POSITION, position)?;
        Ok(some)
    }

    /// Takes out the finer particles nearest to those that leave, as many as these are divided into, and any that are far
    /// from the band. True if there are some.
    fn take_out(&self, zone: &mut Flow<D>, goes: &[usize]) -> Result<bool, StepError> {
        let world = &zone.world;
        let position = world.free.get(fields::POSITION)?;
        let identity = world.free.get(fields::IDENTITY)?;
        let lost = self.frame.band + LOST * self.spacing;
        let mut leaves: Vec<bool> = position
            .iter()
            .map(|x| !self.frame.holds(x, lost))
            .collect();
        let reach = 4.0 * self.spacing;
        let mut near: Vec<usize> = Vec::new();
        for parent in goes {
            let place = self.now.positions[*parent];
            let far = |k: &usize| world.domain.nearest(position[*k] - place).norm();
            near.clear();
            near.extend((0..position.len()).filter(|k| !leaves[*k] && far(k) < reach));
            near.sort_by(|a, b| {
                far(a)
                    .total_cmp(&far(b))
                    .then(identity[*a].cmp(&identity[*b]))
            });
            near.iter().take(1 << D).for_each(|k| leaves[*k] = true);
        }
        let some = leaves.contains(&true);
        if some {
            zone.world.free.take_out(&leaves);
        }
        Ok(some)
    }

    /// The finer particles of one that has come into the band: at the corners of a cube, nearer to it where a wall is.
    fn children(&self, zone: &Flow<D>, parent: usize) -> Vec<Newborn<D>> {
        let world = &zone.world;
        let (centre, state) = (self.now.positions[parent], self.now.states[parent]);
        let place = |corner: usize| {
            let aside = Vect::<D>::from_fn(|k, _| f64::from((corner as u32 >> k) & 1) - 0.5);
            let at = |part: f64| {
                world
                    .domain
                    .wrapped(centre + aside * (0.5 * self.spacing * part))
            };
            let is_fluid = |x: &Vect<D>| zone.walls.as_ref().is_none_or(|w| w.contains(x));
            let mut places = [1.0, 0.5, 0.25].into_iter().map(at);
            places.find(is_fluid).unwrap_or(centre)
        };
        let child = |corner| Newborn {
            position: place(corner),
            velocity: state.velocity,
            density: state.density,
            mass: self.now.masses[parent] / f64::from(1 << D),
            phase: 0,
            body: "zone".into(),
            values: [].into(),
        };
        (0..1 << D).map(child).collect()
    }
}
