//! The pores of one mesh: geometry, linear system, forces of unit pressures, pressures from the mesh before.

use serde::{Deserialize, Serialize};

use crate::coupled::edge_forces::EdgeForces;
use crate::coupled::{CoupledError, FlowSetup, Vector, condition};
use crate::flow::{
    Boundary, Conductance, FlowSystem, PoreGeometry, SlipCondition, Storage, UnitForces,
    cell_volumes,
};
use crate::grains::GrainSystem;
use crate::triangulation::{Sphere, Triangulation, Vertex, Wall};

/// Places of grains and walls; with the radii it is all that a mesh follows from.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Places {
    pub centres: Vec<Vector>,
    /// Inward unit normals and offsets n · x, m.
    pub walls: Vec<(Vector, f64)>,
}

impl Places {
    pub fn from_grains(grains: &GrainSystem) -> Self {
        let walls = grains.walls.iter();
        Self {
            centres: grains.grains.position.to_vec(),
            walls: walls.map(|w| (w.normal, w.normal.dot(&w.point))).collect(),
        }
    }

    pub fn planes(&self) -> Vec<Wall> {
        let plane = |&(normal, offset): &(Vector, f64)| Wall { normal, offset };
        self.walls.iter().map(plane).collect()
    }
}

/// Deepest overlap, in terms of the smaller radius, of grains at the start, and of those that a load has pressed
/// together since.
pub(crate) const GIVEN: f64 = 0.1;
pub(crate) const PRESSED: f64 = 0.5;

/// Everything that lasts as long as a mesh.
pub(crate) struct Pores {
    pub geometry: PoreGeometry,
    pub boundary: Boundary,
    pub system: FlowSystem,
    pub forces: UnitForces,
    /// Shear and lubrication, if there are any.
    pub edges: Option<EdgeForces>,
    pub places: Places,
}

impl Pores {
    /// Makes the mesh of grains at their places, and its system, at their time and for a step (s). Overlaps may be as deep
    /// as `deepest` in terms of the smaller radius.
    pub fn new(
        places: Places,
        grains: &GrainSystem,
        setup: &FlowSetup,
        law: &dyn Conductance,
        step: f64,
        deepest: f64,
    ) -> Result<Self, CoupledError> {
        let spheres = places.centres.iter().zip(&grains.grains.radius);
        let spheres: Vec<_> = spheres.map(|(x, r)| Sphere::new((*x).into(), *r)).collect();
        let mesh = Triangulation::within(&spheres, &places.planes())?;
        let grips = [SlipCondition::Slip, SlipCondition::NoSlip];
        let grips = setup.sides.iter().map(|s| grips[usize::from(s.sticks)]);
        let grips: Vec<_> = grips.collect();
        let geometry = PoreGeometry::pressed(mesh, &grips, setup.angles, deepest)?;
        let boundary = condition::boundary(&setup.sides, &geometry, grains.time);
        let system = Self::assemble(&geometry, &boundary, setup, law, step)?;
        let forces = UnitForces::new(&geometry);
        let edges = EdgeForces::new(&geometry, setup);
        Ok(Self {
            geometry,
            boundary,
            system,
            forces,
            edges,
            places,
        })
    }

    fn assemble(
        geometry: &PoreGeometry,
        boundary: &Boundary,
        setup: &FlowSetup,
        law: &dyn Conductance,
        step: f64,
    ) -> Result<FlowSystem, CoupledError> {
        let (fluid, solver) = (&setup.fluid, setup.solver);
        let modulus = fluid.bulk_modulus;
        let storage = modulus.map(|bulk_modulus| Storage { bulk_modulus, step });
        let system = FlowSystem::new(geometry, boundary, law, fluid.viscosity, storage, solver);
        Ok(system?)
    }

    /// Values of the conditions at a time (s).
    pub fn refresh(&mut self, setup: &FlowSetup, time: f64) {
        self.boundary = condition::boundary(&setup.sides, &self.geometry, time);
    }

    /// Conditions of other kinds on the same mesh.
    pub fn reassemble(
        &mut self,
        setup: &FlowSetup,
        law: &dyn Conductance,
        [time, step]: [f64; 2],
    ) -> Result<(), CoupledError> {
        let boundary = condition::boundary(&setup.sides, &self.geometry, time);
        self.system = Self::assemble(&self.geometry, &boundary, setup, law, step)?;
        self.boundary = boundary;
        Ok(())
    }

    /// Volumes of the cells of this mesh with grains and walls elsewhere, m³.
    pub fn volumes(&self, places: &Places) -> Vec<f64> {
        cell_volumes(&self.geometry.mesh, &places.centres, &places.planes())
    }
}

/// Pressure (Pa) of every new cell: that of the old cell of the same vertices, else that of the old cell
/// around one of its spheres whose middle is nearest.
///
/// A fluid that gives way needs it, and conjugate gradients start from it; a factorisation of stiff fluid does not.
pub(crate) fn transferred(old: &Pores, pressures: &[f64], new: &Pores) -> Vec<f64> {
    let (before, after) = (&old.geometry.mesh, &new.geometry.mesh);
    let (places, middles) = (old.geometry.middles(), new.geometry.middles());
    let value = |cell: usize| {
        let vertices = sorted(after, cell);
        let mut nearest = (f64::INFINITY, 0.0);
        for vertex in vertices.into_iter().filter(|v| v.sphere().is_some()) {
            for &candidate in before.cells_around(vertex) {
                let pressure = pressures[candidate as usize];
                if sorted(before, candidate as usize) == vertices {
                    return pressure;
                }
                let distance = (places[candidate as usize] - middles[cell]).norm_squared();
                if distance < nearest.0 {
                    nearest = (distance, pressure);
                }
            }
        }
        nearest.1
    };
    (0..after.cells.len()).map(value).collect()
}

fn sorted(mesh: &Triangulation, cell: usize) -> [Vertex; 4] {
    let mut vertices = mesh.cells[cell].vertices();
    vertices.sort_unstable();
    vertices
}
