//! Which segments may be near which particle, kept while the neighbour lists stand.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;

use crate::NearSegment;
use crate::error::stage_error;
use crate::outline::Outline;

/// A particle is not let nearer to a wall than this share of the spacing.
///
/// The pressure keeps particles of a filled fluid at about half a spacing or more, so that the
/// constraint acts on lone particles only.
const LEAST_CLEARANCE: f64 = 0.25;

/// Rounds over the segments near a particle before a corner simply stops it.
const TURNS: usize = 4;

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
    /// With c the nearest point of a segment, e = (r − c)/|r − c| and d = |r − c|: if
    /// d + Δt (u − u_w)·e falls below a quarter of a spacing, the velocity along e is raised to
    /// what ends there, at most to that of the wall. A plastic impact: the pressure of a lone
    /// particle, whose density sum is far below ρ₀, would not stop it. What several segments
    /// ask is met in turns; a particle that a sharp corner still holds then goes with the wall.
    pub fn constrain(
        &self,
        outline: &Outline,
        world: &mut World<2>,
        dt: f64,
    ) -> Result<(), StepError> {
        let mut velocity = world.free.take(fields::VELOCITY)?;
        let position = world.free.get(fields::POSITION)?;
        let impact = Impact {
            outline,
            spacing: world.spacing,
            time: world.time,
            dt,
        };
        let changed: Vec<(usize, Vect<2>)> = self
            .particles
            .par_iter()
            .enumerate()
            .with_min_len(256)
            .filter_map(|(place, &p)| {
                let p = p as usize;
                let u = impact.corrected(&position[p], velocity[p], self.row(place));
                u.map(|u| (p, u))
            })
            .collect();
        for (p, u) in changed {
            velocity[p] = u;
        }
        Ok(world.free.put(fields::VELOCITY, velocity)?)
    }
}

/// What a step would do to a particle next to a wall.
struct Impact<'a> {
    outline: &'a Outline,
    spacing: f64,
    time: f64,
    dt: f64,
}

impl Impact<'_> {
    /// The velocity that no segment objects to; none if that is the present one.
    fn corrected(&self, x: &Vect<2>, u: Vect<2>, row: &[NearSegment]) -> Option<Vect<2>> {
        let mut new = u;
        for turn in 0..=TURNS {
            let mut held = None;
            for &near in row {
                if let Some((push, wall)) = self.push(x, &new, near) {
                    new += push;
                    held = Some(wall);
                }
            }
            match held {
                None => return (turn > 0).then_some(new),
                Some(wall) if turn == TURNS => return Some(wall),
                Some(_) => {}
            }
        }
        None
    }

    /// The change of velocity that a segment asks for, and the velocity of the wall.
    fn push(&self, x: &Vect<2>, u: &Vect<2>, near: NearSegment) -> Option<(Vect<2>, Vect<2>)> {
        let mesh = &self.outline.mesh;
        let segment = &mesh.segments()[near.segment];
        let [start, end] = mesh.seen_from([x[0], x[1]], near).map(Vect::from);
        let normal = Vect::from(segment.normal);
        // Only from the fluid's side: the far face of a plate is none of its business.
        let height = -start.dot(&normal);
        if height <= 0.0 || height > 4.0 * self.spacing {
            return None;
        }
        let along = end - start;
        let share = -start.dot(&along) / along.norm_squared();
        let nearest = start + along * share.clamp(0.0, 1.0);
        let wall = self
            .outline
            .velocity(segment.wall, (x + nearest).into(), self.time);
        let least = LEAST_CLEARANCE * self.spacing;
        // What is missing of the velocity along e to end at the least clearance.
        let missing = |e: &Vect<2>, distance: f64| {
            let allowed = ((least - distance) / self.dt).min(0.0);
            let missing = allowed - (u - wall).dot(e);
            // Rounding of what was corrected already is no impact.
            (missing > 1e-12 * (u - wall).norm()).then_some(missing)
        };
        if (0.0..=1.0).contains(&share) {
            return missing(&normal, height).map(|m| (normal * m, wall));
        }
        let distance = nearest.norm();
        let round = -nearest / distance;
        let to_round = missing(&round, distance)?;
        // Where the next segment at the vertex is nearer, it holds the particle back; the
        // vertex is no bump on a straight wall. In a corner this one's plane counts as well.
        let vertex = &mesh.vertices()[segment.vertices[usize::from(share > 1.0)]];
        let next = match share > 1.0 {
            true => vertex.next,
            false => vertex.previous,
        };
        let over_next = next.is_some_and(|s| {
            let ahead = -nearest.dot(&Vect::from(mesh.segments()[s].tangent()));
            if share > 1.0 {
                ahead > 0.0
            } else {
                ahead < 0.0
            }
        });
        match over_next {
            false => Some((round * to_round, wall)),
            true if vertex.theta > 0.5 + 1e-9 => None,
            true => missing(&normal, height).map(|m| (normal * m, wall)),
        }
    }
}
