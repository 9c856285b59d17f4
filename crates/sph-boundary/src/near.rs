//! Which segments may be near which particle, kept while the neighbour lists stand.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;

use crate::NearSegment;
use crate::outline::Outline;
use crate::usaw::stage_error;

/// A particle is not let nearer to a wall than this share of the spacing.
///
/// The pressure keeps particles of a filled fluid at about half a spacing or more, so that the
/// constraint acts on lone particles only.
const LEAST_CLEARANCE: f64 = 0.25;

/// Segments that may be within the support of a particle until the lists are rebuilt.
#[derive(Debug, Default)]
pub(crate) struct NearLists {
    built_for: u64,
    /// Particles with a segment near, ascending.
    pub particles: Vec<u32>,
    starts: Vec<u32>,
    segments: Vec<NearSegment>,
}

impl NearLists {
    /// Forgets the lists: a wall moved.
    pub fn expire(&mut self) {
        self.built_for = 0;
    }

    /// Builds the lists anew if the neighbour lists were.
    pub fn refresh(&mut self, outline: &Outline, world: &World<2>) -> Result<(), StepError> {
        if self.built_for == world.lists.builds {
            return Ok(());
        }
        let positions = &world.lists.reference;
        let reach = world.reach();
        let rows: Vec<Vec<NearSegment>> = positions
            .par_iter()
            .with_min_len(256)
            .map(|x| {
                outline
                    .grid
                    .near(&outline.mesh, [x[0], x[1]], reach)
                    .collect()
            })
            .collect();
        self.built_for = world.lists.builds;
        self.particles.clear();
        self.segments.clear();
        self.starts.clear();
        self.starts.push(0);
        for (particle, row) in rows.iter().enumerate().filter(|(_, row)| !row.is_empty()) {
            self.particles.push(particle as u32);
            self.segments.extend(row);
            self.starts.push(self.segments.len() as u32);
        }
        let close: Vec<_> = self
            .particles
            .iter()
            .map(|&p| positions[p as usize])
            .collect();
        outline.check_free_ends(&close).map_err(stage_error)
    }

    /// The segments near the particle at a place of `particles`.
    pub fn row(&self, place: usize) -> &[NearSegment] {
        &self.segments[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// Takes from the velocities what would carry a particle into a wall within `dt`.
    ///
    /// With c the nearest point of the wall, e = (r − c)/|r − c| and d = |r − c|: if
    /// d + Δt (u − u_w)·e falls below a quarter of a spacing, the velocity along e is raised to
    /// what ends there, at most to that of the wall. A plastic impact: the pressure of a lone
    /// particle, whose density sum is far below ρ₀, would not stop it.
    pub fn constrain(
        &self,
        outline: &Outline,
        world: &mut World<2>,
        dt: f64,
    ) -> Result<(), StepError> {
        let least = LEAST_CLEARANCE * world.spacing;
        let mut velocity = world.free.take(fields::VELOCITY)?;
        let position = world.free.get(fields::POSITION)?;
        let time = world.time;
        let changed: Vec<(usize, Vect<2>)> = self
            .particles
            .par_iter()
            .enumerate()
            .with_min_len(256)
            .filter_map(|(place, &p)| {
                let p = p as usize;
                let (x, mut u) = (position[p], velocity[p]);
                let mut touched = false;
                for &near in self.row(place) {
                    let segment = &outline.mesh.segments()[near.segment];
                    let [start, end] = outline.mesh.seen_from([x[0], x[1]], near);
                    let (start, end) = (Vect::from(start), Vect::from(end));
                    // Only from the fluid's side: the far face of a plate is none of its business.
                    let height = -start.dot(&Vect::from(segment.normal));
                    if height <= 0.0 || height > 4.0 * world.spacing {
                        continue;
                    }
                    let along = end - start;
                    let share = (-start.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                    let away = -(start + along * share);
                    let distance = away.norm();
                    let wall = outline.velocity(segment.wall, (x - away).into(), time);
                    let e = away / distance;
                    let approach = (u - wall).dot(&e);
                    let allowed = ((least - distance) / dt).min(0.0);
                    if approach < allowed {
                        u += e * (allowed - approach);
                        touched = true;
                    }
                }
                touched.then_some((p, u))
            })
            .collect();
        for (p, u) in changed {
            velocity[p] = u;
        }
        Ok(world.free.put(fields::VELOCITY, velocity)?)
    }
}
