//! Unified semi-analytical walls in two dimensions.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{StepError, Vect, fields, register};
use sph_neighbours::{Contact, Contacts, WallPoints, WallSet, World};

use crate::near::NearLists;
use crate::outline::Outline;
use crate::shepard::wall_means;
use crate::{BoundaryError, GammaSum, Renormalisation2d, Wall, WallEntry, WallSetup};

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

impl Usaw {
    fn ready(&self) -> Result<&SetUp, StepError> {
        self.set_up.as_ref().ok_or_else(not_built)
    }
}

fn not_built() -> StepError {
    stage_error("the walls were not built")
}

pub(crate) fn stage_error(reason: impl ToString) -> StepError {
    StepError::Stage {
        stage: "walls".into(),
        reason: reason.to_string(),
    }
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

    fn contains(&self, point: &Vect<2>) -> bool {
        let set_up = self.set_up.as_ref();
        set_up.is_none_or(|s| s.outline.contains(point))
    }

    fn clearance(&self, point: &Vect<2>, within: f64) -> Option<(f64, &str)> {
        self.set_up.as_ref()?.outline.clearance(point, within)
    }

    fn check_free_ends(&self, points: &[Vect<2>]) -> Result<(), BoundaryError> {
        match &self.set_up {
            Some(set_up) => set_up.outline.check_free_ends(points),
            None => Ok(()),
        }
    }

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
        let found: Vec<(f64, Vec<Contact<2>>)> = near
            .particles
            .par_iter()
            .enumerate()
            .with_min_len(64)
            .map(|(k, &particle)| {
                let x = positions[particle as usize];
                let mut sum = GammaSum::default();
                let mut contacts = Vec::new();
                for &near in near.row(k) {
                    let segment = &mesh.segments()[near.segment];
                    let [start, end] = mesh.seen_from([x[0], x[1]], near);
                    let integral = gamma.segment(start, end, segment.normal);
                    sum.add(&integral, segment);
                    if integral.kernel != 0.0 {
                        let normal = Vect::from(segment.normal);
                        contacts.push(Contact {
                            element: near.segment as u32,
                            gradient: normal * integral.kernel,
                            distance: -normal.dot(&Vect::from(start)),
                        });
                    }
                }
                (sum.gamma(), contacts)
            })
            .collect();
        let contacts = &mut world.walls.contacts;
        contacts.particles.clear();
        contacts.contacts.clear();
        contacts.starts.clear();
        contacts.starts.push(0);
        contacts.place.clear();
        contacts.place.resize(positions.len(), u32::MAX);
        for (&particle, (gamma, own)) in near.particles.iter().zip(found) {
            renormalisation[particle as usize] = gamma;
            if !own.is_empty() {
                contacts.place[particle as usize] = contacts.particles.len() as u32;
                contacts.particles.push(particle);
                contacts.contacts.extend(own);
                contacts.starts.push(contacts.contacts.len() as u32);
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

    fn warnings(&self) -> Vec<String> {
        let set_up = self.set_up.as_ref();
        set_up.map_or(Vec::new(), |s| {
            s.outline
                .mesh
                .warnings()
                .iter()
                .map(ToString::to_string)
                .collect()
        })
    }
}
