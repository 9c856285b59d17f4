//! The band around a zone, in which its particles follow those around.

use rayon::prelude::*;
use sph_contribution::Newborn;
use sph_core::{Slots, StepError, Vect, fields};
use sph_neighbours::CellGrid;
use sph_solver::Flow;

use super::frame::Frame;
use super::sample::{Sample, Source, States};

/// Distance from the band over the spacing around it, beyond which a finer particle is brought back.
const LOST: f64 = 2.0;

/// Particles around a zone, and the band that follows them.
pub(crate) struct Guard<const D: usize> {
    pub frame: Frame<D>,
    /// Spacing around the zone, m.
    pub spacing: f64,
    before: Sample<D>,
    now: Sample<D>,
    /// Places of the present particles in the earlier sample.
    earlier: Vec<Option<u32>>,
}

impl<const D: usize> Guard<D> {
    /// Around a zone, in particles with a spacing, m.
    pub fn new(frame: Frame<D>, spacing: f64) -> Self {
        Guard {
            frame,
            spacing,
            before: Sample::default(),
            now: Sample::default(),
            earlier: Vec::new(),
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
        let slots = Slots::from_identities(&self.before.identities);
        let identities = self.now.identities.iter();
        self.earlier = identities.map(|id| slots.slot(*id)).collect();
        Ok(())
    }

    /// States around those particles of a zone whose places are `wanted`, at its time.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn states(
        &self,
        zone: &Flow<D>,
        wanted: impl Fn(&Vect<D>) -> bool + Sync,
    ) -> Result<States<D>, StepError> {
        let world = &zone.world;
        let around = self.now.since(&self.before, &self.earlier, world);
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
        let outer = self.frame.band;
        let (mut comes, mut goes) = (Vec::new(), Vec::new());
        for (k, earlier) in self.earlier.iter().enumerate() {
            let Some(earlier) = earlier else {
                continue;
            };
            let then = &self.before.positions[*earlier as usize];
            let was = self.frame.holds(then, outer);
            match (was, self.frame.holds(&self.now.positions[k], outer)) {
                (false, true) => comes.push(k),
                (true, false) => goes.push(k),
                _ => {}
            }
        }
        let changed = self.bring_back(zone)? | self.take_out(zone, &goes)?;
        let births: Vec<_> = comes.iter().flat_map(|k| self.children(zone, *k)).collect();
        zone.insert(&births)?;
        Ok(changed || !births.is_empty())
    }

    /// Puts particles that are behind a wall, or far from the band, beside the nearest particle around. True if there are
    /// some.
    fn bring_back(&self, zone: &mut Flow<D>) -> Result<bool, StepError> {
        let mut position = zone.world.free.take(fields::POSITION)?;
        let domain = &zone.world.domain;
        let lost = self.frame.band + LOST * self.spacing;
        let is_fluid = |x: &Vect<D>| zone.walls.as_ref().is_none_or(|w| w.contains(x));
        let mut some = false;
        for x in &mut position {
            if self.frame.holds(x, 0.0) || (self.frame.holds(x, lost) && is_fluid(x)) {
                continue;
            }
            let way = |y: &Vect<D>| domain.nearest(*x - *y);
            let far = |y: &&Vect<D>| way(y).norm();
            let places = self.now.positions.iter();
            if let Some(place) = places.min_by(|a, b| far(a).total_cmp(&far(b))) {
                let aside = way(place).cap_magnitude(0.25 * self.spacing);
                let beside = domain.wrapped(place + aside);
                *x = if is_fluid(&beside) { beside } else { *place };
                some = true;
            }
        }
        zone.world.free.put(fields::POSITION, position)?;
        Ok(some)
    }

    /// Takes out the finer particles nearest to those that leave, as many as these are divided into; the next nearest keeps
    /// the difference of mass. True if there are some.
    fn take_out(&self, zone: &mut Flow<D>, goes: &[usize]) -> Result<bool, StepError> {
        let mut mass = zone.world.free.take(fields::MASS)?;
        let world = &zone.world;
        let position = world.free.get(fields::POSITION)?;
        let identity = world.free.get(fields::IDENTITY)?;
        let mut leaves = vec![false; position.len()];
        let reach = 4.0 * self.spacing;
        let grid = CellGrid::new(position, reach, &world.domain);
        let mut near: Vec<(f64, u32, usize)> = Vec::new();
        for parent in goes {
            let place = self.now.positions[*parent];
            let far = |k: usize| world.domain.nearest(position[k] - place).norm();
            let with_distance = |k: usize| (!leaves[k]).then(|| (far(k), identity[k], k));
            near.clear();
            grid.ranges(&place, reach, |found| {
                let all = grid.order()[found].iter().map(|k| *k as usize);
                near.extend(all.filter_map(with_distance));
            });
            if near.len() < 1 << D {
                near.clear();
                near.extend((0..position.len()).filter_map(with_distance));
            }
            near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let mut rest = -self.now.masses[*parent];
            let mut order = near.iter().map(|(.., k)| *k);
            for k in order.by_ref().take(1 << D) {
                leaves[k] = true;
                rest += mass[k];
            }
            if let Some(next) = order.next() {
                mass[next] += rest;
            }
        }
        zone.world.free.put(fields::MASS, mass)?;
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
