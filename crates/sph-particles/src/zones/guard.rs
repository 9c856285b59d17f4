//! The band around a zone, in which its particles follow those around and are pushed apart until no two lie together.

use std::sync::Arc;

use rayon::prelude::*;
use sph_boundary::{Wall, WallStates};
use sph_contribution::Newborn;
use sph_core::{Field, Scalar, Slots, StepError, Vect, fields};
use sph_neighbours::CellGrid;
use sph_solver::Flow;

use super::frame::Frame;
use super::near::NearbyPlaces;
use super::sample::{Sample, Source, States};

/// Distance from the band over the spacing around it, beyond which a finer particle is brought back.
const LOST: f64 = 2.0;

/// Particles around a zone, and the band that follows them.
pub(crate) struct Guard<const D: usize> {
    pub frame: Frame<D>,
    /// The shape at the times of both samples.
    frames: [Frame<D>; 2],
    /// States of walls with movers at these times.
    walls: [WallStates; 2],
    /// Spacing around the zone, m.
    pub spacing: f64,
    /// Scalars of state that it carries.
    scalars: Vec<Field<Scalar>>,
    before: Sample<D>,
    now: Sample<D>,
    /// Places of the present particles in the earlier sample.
    earlier: Vec<Option<u32>>,
}

impl<const D: usize> Guard<D> {
    /// Around a zone, in particles with a spacing, m, and some scalars of state.
    pub fn new(frame: Frame<D>, spacing: f64, scalars: Vec<Field<Scalar>>) -> Self {
        Guard {
            frames: [frame.clone(), frame.clone()],
            walls: Default::default(),
            frame,
            spacing,
            scalars,
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
        self.frames.swap(0, 1);
        self.walls.swap(0, 1);
        self.frames[1] = self.frame.at(around);
        self.walls[1] = around
            .walls
            .as_ref()
            .map(|w| w.states())
            .unwrap_or_default();
        let now = Sample::of_flow(around, &self.scalars, |x| self.frames[1].holds(x, margin))?;
        self.before = std::mem::replace(&mut self.now, now);
        if self.before.time >= self.now.time {
            self.before = Sample::default();
        }
        let slots = Slots::from_identities(&self.before.identities);
        let identities = self.now.identities.iter();
        self.earlier = identities.map(|id| slots.slot(*id)).collect();
        Ok(())
    }

    /// Puts walls with movers where those around are at the time of a zone.
    ///
    /// # Errors
    /// A wall that cannot follow.
    pub fn lead_walls(&self, zone: &mut Flow<D>) -> Result<(), StepError> {
        let (Some(from), Some(to), Some(walls)) =
            (self.before.time, self.now.time, zone.walls.as_deref_mut())
        else {
            return Ok(());
        };
        let [before, now] = self.walls.each_ref().map(|states| &states.now);
        if now.is_empty() {
            return Ok(());
        }
        let time = zone.world.time;
        let share = ((time - from) / (to - from)).clamp(0.0, 1.0);
        let part = |(a, b): (&f64, &f64)| {
            if share == 1.0 {
                *b
            } else {
                a + share * (b - a)
            }
        };
        let states = WallStates {
            now: before.iter().zip(now).map(part).collect(),
            listed: None,
        };
        let led = walls.put_back(&mut zone.world.walls, &states, time);
        led.map_err(|e| StepError::stage("walls of a zone", e.to_string()))
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
        let frame = self.frame.at(zone);
        Ok(source.all(position, wanted, |x| !frame.holds(x, 0.0)))
    }

    /// At the end of the time that it knows: lets finer particles in where those around come into the band, and takes them
    /// out where those leave it, mass for mass.
    ///
    /// # Errors
    /// A particle that cannot come in.
    pub fn exchange(&self, zone: &mut Flow<D>) -> Result<(), StepError> {
        if self.now.time != Some(zone.world.time) {
            return Ok(());
        }
        let outer = self.frame.band;
        let [before, here] = &self.frames;
        let (mut comes, mut goes) = (Vec::new(), Vec::new());
        for (k, earlier) in self.earlier.iter().enumerate() {
            let Some(earlier) = earlier else {
                continue;
            };
            let then = &self.before.positions[*earlier as usize];
            let was = before.holds(then, outer);
            match (was, here.holds(&self.now.positions[k], outer)) {
                (false, true) => comes.push(k),
                (true, false) => goes.push(k),
                _ => {}
            }
        }
        self.bring_back(zone)?;
        self.take_out(zone, &goes)?;
        let births: Vec<_> = comes.iter().flat_map(|k| self.children(zone, *k)).collect();
        zone.insert(&births)?;
        let free = &mut zone.world.free;
        if free.has(fields::MEAN_ACCELERATION.name) {
            let mean = free.get_mut(fields::MEAN_ACCELERATION)?;
            let first = mean.len() - births.len();
            let parents = comes.iter().flat_map(|k| std::iter::repeat_n(*k, 1 << D));
            let born = mean[first..].iter_mut().zip(parents);
            born.for_each(|(own, parent)| *own = self.now.mean_accelerations[parent]);
        }
        Ok(())
    }

    /// Puts particles that are behind a wall, or far from the band, beside the nearest particle around.
    fn bring_back(&self, zone: &mut Flow<D>) -> Result<(), StepError> {
        let mut position = zone.world.free.take(fields::POSITION)?;
        let domain = &zone.world.domain;
        let lost = self.frame.band + LOST * self.spacing;
        let is_fluid = |x: &Vect<D>| zone.walls.as_ref().is_none_or(|w| w.contains(x));
        let here = &self.frames[1];
        for x in &mut position {
            if here.holds(x, 0.0) || (here.holds(x, lost) && is_fluid(x)) {
                continue;
            }
            let way = |y: &Vect<D>| domain.nearest(*x - *y);
            let far = |y: &&Vect<D>| way(y).norm();
            let places = self.now.positions.iter();
            if let Some(place) = places.min_by(|a, b| far(a).total_cmp(&far(b))) {
                let aside = way(place).cap_magnitude(0.25 * self.spacing);
                let beside = domain.wrapped(place + aside);
                *x = if is_fluid(&beside) { beside } else { *place };
            }
        }
        Ok(zone.world.free.put(fields::POSITION, position)?)
    }

    /// Takes out the finer particles nearest to those that leave, as many as these are divided into; the next nearest keeps
    /// the difference of mass.
    fn take_out(&self, zone: &mut Flow<D>, goes: &[usize]) -> Result<(), StepError> {
        if goes.is_empty() {
            return Ok(());
        }
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
        zone.world.free.take_out(&leaves);
        Ok(())
    }

    /// The finer particles of one that has come into the band: at the corners of a cube, nearer to it where a wall is.
    fn children(&self, zone: &Flow<D>, parent: usize) -> Vec<Newborn<D>> {
        let world = &zone.world;
        let (centre, state) = (self.now.positions[parent], self.now.states[parent]);
        let place = |corner: usize| {
            let aside = Vect::<D>::from_fn(|k, _| f64::from((corner as u32 >> k) & 1) - 0.5);
            let way = |part: f64| aside * (0.5 * self.spacing * part);
            let at = |part: f64| world.domain.wrapped(centre + way(part));
            let is_fluid = |x: &Vect<D>| zone.walls.as_ref().is_none_or(|w| w.contains(x));
            let mut places = [1.0, 0.5, 0.25].into_iter().map(at);
            places.find(is_fluid).unwrap_or(centre)
        };
        let named = self.scalars.iter().map(|field| field.name.to_string());
        let values: Arc<[_]> = named.zip(state.scalars).collect();
        let child = |corner| Newborn {
            position: place(corner),
            velocity: state.velocity,
            density: state.density,
            mass: self.now.masses[parent] / f64::from(1 << D),
            phase: 0,
            body: "zone".into(),
            values: values.clone(),
        };
        (0..1 << D).map(child).collect()
    }
}

/// Share of the overlap of two particles by which they part in a step: a band is passed in some hundred steps.
const PART: f64 = 0.02;
/// Distance over the spacing below which particles part. Particles that are evenly disordered are seldom nearer.
const NEAREST: f64 = 0.8;

/// No particle is moved nearer to a wall than this share of the spacing.
const NEAR_WALL: f64 = 0.3;

/// Moves the particles of a flow beyond the sides of `frame` away from others that are near.
///
/// Those that come in lie in pairs and gaps, as their parents; in the zone that order would form at the expense of the
/// flow's pressure and energy.
///
/// # Errors
/// If a column is missing.
pub(crate) fn spread<const D: usize>(
    flow: &mut Flow<D>,
    frame: &Frame<D>,
) -> Result<(), StepError> {
    let spacing = flow.world.spacing;
    let reach = NEAREST * spacing;
    let mut position = flow.world.free.take(fields::POSITION)?;
    let domain = &flow.world.domain;
    let near = |k: &usize| !frame.holds(&position[*k], -spacing);
    let band: Vec<usize> = (0..position.len()).filter(near).collect();
    let places: Vec<Vect<D>> = band.iter().map(|k| position[*k]).collect();
    let near = NearbyPlaces::new(&places, reach, domain);
    let moved = |x: &Vect<D>| {
        let mut way = Vect::<D>::zeros();
        near.visit(x, |_, there, q| {
            if q > 0.0 {
                way -= there * (PART * reach * (1.0 / q - 1.0).min(1.0));
            }
        });
        x + way
    };
    let all = places.par_iter().with_min_len(256);
    let aside: Vec<Vect<D>> = all.map(moved).collect();
    let walls = flow.walls.as_deref();
    let near_wall = NEAR_WALL * spacing;
    for (k, place) in band.iter().zip(aside) {
        let led = !frame.holds(&position[*k], 0.0);
        let free = |w: &dyn Wall<D>| w.contains(&place) && w.clearance(&place, near_wall).is_none();
        if led && place != position[*k] && walls.is_none_or(free) {
            position[*k] = domain.wrapped(place);
        }
    }
    flow.world.free.put(fields::POSITION, position)?;
    Ok(())
}
