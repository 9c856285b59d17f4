//! Walls that scale the kernel symmetrically.

use sph_core::{AnyField, StepError, Vect, fields, plugin};
use sph_neighbours::{Slope, WallSet, World};

use crate::scale::walls::{ScaleAt, WallScales, element_size};
use crate::treatment::Staged;
use crate::treatment::elements::{SetUp, not_built};
use crate::treatment::outline::Outline;
use crate::treatment::shaped::shaped_by_outline;
use crate::{
    BoundaryError, PlanarWalls, Result, SpatialWalls, Wall, WallEntry, WallMesh, WallSetup,
    WallSpec, WallStates,
};

/// Least distance of particles from walls over the spacing: that of films, which the density sum lets sink.
const LEAST_CLEARANCE: f64 = 0.1;
/// Size of elements over the spacing: γ and ∇γ do not depend on it, and no mean over elements enters a pressure.
const ELEMENT: f64 = 2.0;

/// Walls that scale the kernel: w̃_ab = s_a s_b w_ab in density, divergence, pressure, smoothers and damper, with
/// s(x) ∫ s(y) w(x − y) dy = 1 over the fluid's side of the walls.
///
/// The force m_a a = −Σ_b P_ab s_a s_b ∇w_ab − B_a ∇ln s_a is the gradient of the energy of compression, so that walls at
/// rest give and take none, and the second part is equal and opposite to the force on the wall. No pressure of the wall
/// enters. s of a flat wall is a function of the distance; that of flat faces at right angles around the fluid is their
/// product; all other shapes have a map, made once for each group of walls that moves as one. Walls that move otherwise
/// multiply, which is 1.2 % off at a gap of h and 13 % at h/4.
///
/// Friction, heat and other sums keep γ and ∇γ of `walls.usaw`. The first row of particles lies at δr/2.
///
/// Limits: no open faces, no walls that bend; bodies that touch walls of another motion are pushed too little; a start that
/// is a lattice rings unless it is relaxed. Ours.
///
/// ```toml
/// [walls.symmetric]
/// [wall.tank]
/// polyline = [[0, 0.6], [0, 0], [1, 0], [1, 0.6]]
/// ```
#[plugin(WallEntry [2 => Symmetric<2, PlanarWalls>, 3 => Symmetric<3, SpatialWalls>], "symmetric",
    "walls that scale the kernel and conserve energy", source: "ours", cfg(not(test)))]
#[serde(bound = "")]
#[schemars(rename = "Symmetric", bound = "")]
pub struct Symmetric<const D: usize, M: WallMesh<D>> {
    #[serde(skip)]
    set_up: Option<SetUp<D, M>>,
    #[serde(skip)]
    scales: Option<Scales<D, M>>,
}

#[derive(Debug)]
struct Scales<const D: usize, M> {
    walls: WallScales<D, M>,
    found: Vec<ScaleAt<D>>,
    slopes: Vec<Vec<Slope<D>>>,
}

impl<const D: usize, M: WallMesh<D>> Scales<D, M> {
    /// s, ∇ ln s and ∂ ln s/∂t of all particles, and which wall has which part.
    fn update(&mut self, world: &mut World<D>, outline: Option<&Outline<D, M>>) -> Staged {
        let mut scale = world.free.take(fields::SCALE)?;
        let mut slope = world.free.take(fields::SCALE_SLOPE)?;
        let positions = world.free.get(fields::POSITION)?;
        let frames = &world.walls.frames;
        self.walls
            .at(positions, frames, &mut self.found, &mut self.slopes);
        let all = scale.iter_mut().zip(&mut slope).zip(&self.found);
        for ((scale, slope), found) in all {
            (*scale, *slope) = (found.scale, found.slope);
        }
        let slopes = self.slopes.iter().flatten().copied();
        if let Some(outline) = outline {
            let mut rate = world.free.take(fields::SCALE_RATE)?;
            rate.fill(0.0);
            let positions = world.free.get(fields::POSITION)?;
            for part in slopes.clone() {
                let particle = part.particle as usize;
                let place = nearest_image(world, outline, &positions[particle], part.wall);
                let state = &outline.now.states[part.wall as usize];
                rate[particle] -= part.slope.dot(&state.movement(place.into()).velocity);
            }
            world.free.put(fields::SCALE_RATE, rate)?;
        }
        world.walls.slopes.clear();
        world.walls.slopes.extend(slopes);
        world.free.put(fields::SCALE, scale)?;
        Ok(world.free.put(fields::SCALE_SLOPE, slope)?)
    }
}

/// The image of a place that is beside a wall, m.
fn nearest_image<const D: usize, M: WallMesh<D>>(
    world: &World<D>,
    outline: &Outline<D, M>,
    x: &Vect<D>,
    wall: u32,
) -> Vect<D> {
    if !world.domain.periodic.contains(&true) {
        return *x;
    }
    let centre = outline.now.states[wall as usize].place();
    centre + world.domain.nearest(x - centre)
}

shaped_by_outline!(Symmetric);

impl<const D: usize, M: WallMesh<D>> Wall<D> for Symmetric<D, M> {
    fn lattice_offset(&self) -> f64 {
        0.5
    }

    fn build(&mut self, setup: &WallSetup<'_, D>) -> Result<WallSet<D>> {
        for spec in setup.walls {
            let why = match spec {
                WallSpec { open: true, .. } => {
                    "lets fluid pass, and a scale is for closed walls; take `walls.usaw`"
                }
                WallSpec { motion, .. } if motion.bends() => {
                    "bends, and a scale is for a constant shape; take `walls.usaw`"
                }
                _ => continue,
            };
            return Err(BoundaryError::unfit(spec.drawing.name(), why));
        }
        let size = element_size(setup.walls, setup.spacing, (ELEMENT * setup.spacing, 0.25));
        let (set_up, mut walls) = SetUp::<D, M>::build(setup, false, size)?;
        self.scales = Some(Scales {
            walls: WallScales::new(setup, &set_up.outline.groups)?,
            found: Vec::new(),
            slopes: Vec::new(),
        });
        self.set_up = Some(set_up);
        walls.scales = true;
        Ok(walls)
    }

    fn columns(&self) -> Vec<AnyField> {
        let mut columns = vec![
            fields::RENORMALISATION.any(),
            fields::SCALE.any(),
            fields::SCALE_SLOPE.any(),
        ];
        // s changes at a fixed place.
        if self.outline().is_some_and(Outline::moves) {
            columns.push(fields::SCALE_RATE.any());
        }
        columns
    }

    fn geometry(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let both = self.set_up.as_mut().zip(self.scales.as_mut());
        let (set_up, scales) = both.ok_or_else(not_built)?;
        set_up.geometry(world)?;
        let outline = &set_up.outline;
        scales.update(world, outline.moves().then_some(outline))
    }

    fn constrain(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let set_up = self.set_up.as_mut().ok_or_else(not_built)?;
        set_up.constrain(world, dt, LEAST_CLEARANCE)
    }

    fn state(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        self.set_up.as_mut().ok_or_else(not_built)?.state(world)
    }
}
