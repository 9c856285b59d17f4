//! Unified semi-analytical walls.

use sph_core::{AnyField, StepError, Vect, fields, plugin};
use sph_neighbours::{WallSet, World};

use crate::scale::walls::element_size;
use crate::treatment::elements::{SetUp, not_built};
use crate::treatment::impact::LEAST_CLEARANCE;
use crate::treatment::shaped::shaped_by_outline;
use crate::{PlanarWalls, Result, SpatialWalls, Wall, WallEntry, WallMesh, WallSetup, WallStates};

/// Walls of segments or triangles with vertex particles; sums are renormalised by γ, the share of
/// the kernel inside the walls, and completed by ∇γ. γ is geometry here (a closed form, no history).
///
/// The pressure on elements and vertices is the Shepard mean of p + ρ (g − a_w)·(r_wall − r) over
/// the fluid (∂p*/∂n = 0). In space it is found at the corners of elements and interpolated to the mean place of what a
/// particle sees of a face, which is one contact; where there are open faces, elements are contacts.
///
/// With `vertices` the first row of particles lies at δr, and vertices carry the half row of fluid
/// between: the share θ_v of a particle's volume. That half row stays at the wall. Under a lid that
/// moves along itself it takes a flux of U δr/2 into a corner where nothing turns it down, an error of
/// first order; and points that stand while rows of particles pass make a rough wall, which stirs
/// the fluid the more the stiffer it is. Without vertices the first row lies at δr/2, all of the
/// fluid is in particles, and the wall is smooth.
///
/// Source: Ghaïtanellis 2017, §2.5, Eq. 2.63–2.91; γ by the divergence theorem; walls without vertices
/// are ours.
///
/// ```toml
/// [walls.usaw]
/// vertices = false
/// [wall.tank]
/// polyline = [[0, 0.6], [0, 0], [1, 0], [1, 0.6]]
/// ```
#[plugin(WallEntry [2 => Usaw<2, PlanarWalls>, 3 => Usaw<3, SpatialWalls>], "usaw",
    "semi-analytical walls with exact renormalisation", source: "Ghaïtanellis 2017, Eq. 2.63–2.91; Ferrand et al. 2013",
    cfg(not(test)))]
#[serde(bound = "")]
#[schemars(rename = "Usaw", bound = "")]
pub struct Usaw<const D: usize, M: WallMesh<D>> {
    /// True if vertices carry the half row of fluid next to the wall, as in the source. A scene that leaves it out has it
    /// where bodies end half a row beyond whole rows from a wall, and nowhere else.
    #[parameter(default: true, source: "Ghaïtanellis 2017, §2.5; without them: ours")]
    vertices: bool,
    #[serde(skip)]
    set_up: Option<SetUp<D, M>>,
}

/// Size of elements over the spacing, where a face is one contact and its corners bear no fluid.
const ELEMENT: f64 = 2.0;
/// Largest size of elements over that of the smallest piece of a wall. Ours: the heave of a box of 12 spacings is 7.8 % off
/// with elements of a spacing, 8.1 % with this share, 8.5 % with two spacings.
const SHARE: f64 = 0.125;

impl<const D: usize, M: WallMesh<D>> Usaw<D, M> {
    fn element_size(&self, setup: &WallSetup<'_, D>) -> f64 {
        let by_element = setup.walls.iter().any(|w| w.open || w.motion.bends());
        match D == 2 || self.vertices || by_element {
            true => setup.spacing,
            false => element_size(setup.walls, setup.spacing, (ELEMENT * setup.spacing, SHARE)),
        }
    }
}

shaped_by_outline!(Usaw);

impl<const D: usize, M: WallMesh<D>> Wall<D> for Usaw<D, M> {
    fn lattice_offset(&self) -> f64 {
        if self.vertices { 0.0 } else { 0.5 }
    }

    fn build(&mut self, setup: &WallSetup<'_, D>) -> Result<WallSet<D>> {
        let size = self.element_size(setup);
        let (set_up, walls) = SetUp::build(setup, self.vertices, size)?;
        self.set_up = Some(set_up);
        Ok(walls)
    }

    fn columns(&self) -> Vec<AnyField> {
        vec![fields::RENORMALISATION.any()]
    }

    fn geometry(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        self.set_up.as_mut().ok_or_else(not_built)?.geometry(world)
    }

    fn constrain(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let set_up = self.set_up.as_mut().ok_or_else(not_built)?;
        set_up.constrain(world, dt, LEAST_CLEARANCE)
    }

    fn state(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        self.set_up.as_mut().ok_or_else(not_built)?.state(world)
    }
}
