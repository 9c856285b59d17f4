//! Unified semi-analytical walls in two dimensions.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{StepError, Vect, fields, register};
use sph_neighbours::{Contact, Contacts, WallPoints, WallSet, World};

use crate::error::stage_error;
use crate::near::NearLists;
use crate::outline::{Outline, checks_by_outline};
use crate::shepard::wall_means;
use crate::{
    BoundaryError, GammaSum, NearSegment, Renormalisation2d, SegmentMesh, Wall, WallEntry,
    WallSetup,
};

/// Walls of segments with vertex particles; sums are renormalised by γ, the share of the kernel
/// inside the walls, and completed by ∇γ. γ is geometry here (a closed form, no history).
///
/// Vertices carry the share θ_v of a particle's volume that is fluid; the pressure on vertices
/// and segments is the Shepard mean of p + ρ g·(r_wall − r) over the fluid (∂p*/∂n = 0).
///
/// Source: Ghaïtanellis 2017, §2.5, Eq. 2.63–2.91; γ by the divergence theorem.
///
/// ```toml
/// [walls.usaw]
/// [wall.tank]
/// polyline = [[0, 0.6], [0, 0], [1, 0], [1, 0.6]]
/// ```
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Usaw {
    #[serde(skip)]
    set_up: Option<SetUp>,
}

#[derive(Debug)]
struct SetUp {
    outline: Outline,
    gamma: Renormalisation2d,
    spacing: f64,
    near: NearLists,
}

register!(
    WallEntry[2],
    Usaw,
    "usaw",
    "semi-analytical walls with exact renormalisation",
    "Ghaïtanellis 2017, Eq. 2.63–2.91; Ferrand et al. 2013"
);

/// Particles that one task works through.
const BATCH: usize = 64;

/// γ and contacts of a batch of particles.
#[derive(Debug, Default)]
struct Found {
    gamma: Vec<f64>,
    contacts: Vec<Contact<2>>,
    /// Contacts up to and including each particle's.
    ends: Vec<u32>,
}

impl Found {
    fn particle(
        &mut self,
        point: [f64; 2],
        row: &[NearSegment],
        mesh: &SegmentMesh,
        gamma: &Renormalisation2d,
    ) {
        let mut sum = GammaSum::default();
        for &near in row {
            let segment = &mesh.segments()[near.segment];
            let [start, end] = mesh.seen_from(point, near);
            let integral = gamma.segment(start, end, segment.normal);
            sum.add(&integral, segment);
            if integral.kernel != 0.0 {
                let normal = Vect::from(segment.normal);
                self.contacts.push(Contact {
                    element: near.segment as u32,
                    gradient: normal * integral.kernel,
                    distance: -normal.dot(&Vect::from(start)),
                });
            }
        }
        self.gamma.push(sum.gamma());
        self.ends.push(self.contacts.len() as u32);
    }
}

impl Usaw {
    fn ready(&self) -> Result<&SetUp, StepError> {
        self.set_up.as_ref().ok_or_else(not_built)
    }
}

fn not_built() -> StepError {
    stage_error("the walls were not built")
}

impl Wall<2> for Usaw {
    fn lattice_offset(&self) -> f64 {
        0.0
    }

    fn renormalises(&self) -> bool {
        true
    }

    fn build(&mut self, setup: &WallSetup<'_, 2>) -> Result<WallSet<2>, BoundaryError> {
        let shape = setup
            .kernel
            .polynomial()
            .ok_or_else(|| BoundaryError::Kernel {
                reason: format!(
                    "`{}` gives no radial moments, and semi-analytical walls integrate them",
                    setup.kernel.name()
                ),
            })?;
        let gamma = Renormalisation2d::new(shape, setup.smoothing_length)?;
        let outline = Outline::new(setup, gamma.kernel_radius())?;
        let mut points = WallPoints::default();
        for vertex in outline.mesh.vertices() {
            let velocity = outline.velocity(vertex.wall, vertex.position, 0.0);
            points.position.push(vertex.position.into());
            points.velocity.push(velocity);
            points.viscous_velocity.push(velocity);
            points.share.push(vertex.theta);
            points.volume.push(setup.spacing.powi(2));
            points.pressure.push(0.0);
            points.grip.push(outline.grip(vertex.wall));
            points.wall.push(vertex.wall as u32);
        }
        let walls = WallSet {
            names: outline.mesh.walls().to_vec(),
            points,
            elements: outline.elements(0.0, setup.spacing),
            contacts: Contacts::default(),
        };
        self.set_up = Some(SetUp {
            outline,
            gamma,
            spacing: setup.spacing,
            near: NearLists::default(),
        });
        Ok(walls)
    }

    checks_by_outline!();

    fn move_to(&mut self, walls: &mut WallSet<2>, time: f64) -> Result<(), BoundaryError> {
        let Some(set_up) = &mut self.set_up else {
            return Ok(());
        };
        if !set_up.outline.moves() {
            return Ok(());
        }
        set_up.outline.move_to(time)?;
        // A moved wall changes which segments are near whom.
        set_up.near.expire();
        let outline = &set_up.outline;
        let points = &mut walls.points;
        for (v, vertex) in outline.mesh.vertices().iter().enumerate() {
            let velocity = outline.velocity(vertex.wall, vertex.position, time);
            points.position[v] = vertex.position.into();
            points.velocity[v] = velocity;
            points.viscous_velocity[v] = velocity;
        }
        let elements = &mut walls.elements;
        for (s, segment) in outline.mesh.segments().iter().enumerate() {
            elements.centre[s] = segment.centre.into();
            elements.normal[s] = segment.normal.into();
            elements.velocity[s] = outline.velocity(segment.wall, segment.centre, time);
        }
        Ok(())
    }

    fn geometry(&mut self, world: &mut World<2>) -> Result<(), StepError> {
        let set_up = self.set_up.as_mut().ok_or_else(not_built)?;
        set_up.near.refresh(&set_up.outline, world)?;
        let mut renormalisation = world.free.take(fields::RENORMALISATION)?;
        renormalisation.fill(1.0);
        let positions = world.free.get(fields::POSITION)?;
        let near = &set_up.near;
        let (mesh, gamma) = (&set_up.outline.mesh, &set_up.gamma);
        let found: Vec<Found> = near
            .particles
            .par_chunks(BATCH)
            .enumerate()
            .map(|(b, batch)| {
                let mut found = Found::default();
                for (k, &particle) in batch.iter().enumerate() {
                    let x = positions[particle as usize];
                    let row = near.row(b * BATCH + k);
                    found.particle([x[0], x[1]], row, mesh, gamma);
                }
                found
            })
            .collect();
        let contacts = &mut world.walls.contacts;
        contacts.particles.clear();
        contacts.contacts.clear();
        contacts.starts.clear();
        contacts.starts.push(0);
        contacts.place.clear();
        contacts.place.resize(positions.len(), u32::MAX);
        for (batch, found) in near.particles.chunks(BATCH).zip(&found) {
            let offset = contacts.contacts.len() as u32;
            contacts.contacts.extend_from_slice(&found.contacts);
            let results = found.gamma.iter().zip(&found.ends);
            for (&particle, (&gamma, &end)) in batch.iter().zip(results) {
                renormalisation[particle as usize] = gamma;
                if offset + end > *contacts.starts.last().unwrap_or(&0) {
                    contacts.place[particle as usize] = contacts.particles.len() as u32;
                    contacts.particles.push(particle);
                    contacts.starts.push(offset + end);
                }
            }
        }
        Ok(world.free.put(fields::RENORMALISATION, renormalisation)?)
    }

    fn constrain(&mut self, world: &mut World<2>, dt: f64) -> Result<(), StepError> {
        let set_up = self.ready()?;
        set_up.near.constrain(&set_up.outline, world, dt)
    }

    fn state(&mut self, world: &mut World<2>) -> Result<(), StepError> {
        let spacing = self.ready()?.spacing;
        let whole = spacing * spacing;
        let points = wall_means(
            world,
            &world.walls.points.position,
            &world.lists.of_points,
            whole,
        )?;
        let elements = wall_means(
            world,
            &world.walls.elements.centre,
            &world.lists.of_elements,
            whole,
        )?;
        let walls = &mut world.walls;
        for (v, mean) in points.iter().enumerate() {
            walls.points.pressure[v] = mean.pressure;
            walls.points.volume[v] = mean.volume;
        }
        for (s, mean) in elements.iter().enumerate() {
            walls.elements.pressure[s] = mean.pressure;
            walls.elements.volume[s] = mean.volume;
        }
        Ok(())
    }
}
