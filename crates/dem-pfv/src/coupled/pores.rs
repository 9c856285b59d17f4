//! The pores of one mesh: geometry, linear system, forces of unit pressures, pressures from the mesh before; forces
//! between neighbours that slide past each other, or part, along the edges of the mesh.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::coupled::{CoupledError, FlowSetup, Fluid, Lubrication, Vector, condition};
use crate::flow::{
    Boundary, Conductance, Edge, FlowSystem, PoreGeometry, SlipCondition, Storage, UnitForces,
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
    /// Makes the mesh of grains at their places, and its system, at their time and for a step (s). Overlaps may be as
    /// deep as `deepest` in terms of the smaller radius.
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

/// Share of the smaller radius in R_h = h + 0.45 R. The source does not define the hydraulic radius of an edge; this is
/// that of YADE 2023.02a.
const HYDRAULIC: f64 = 0.45;

/// Shear and lubrication between neighbours k and l with the gap h and the unit vector n from k to l:
///
/// ```text
/// shear          F_k =  µ S/R_h Δv_t,     R_h = h + 0.45 min(R_k, R_l),     S the face between both
/// lubrication    F_k =  6 π µ a² (1/max(h, ε a) − 1/(c a)) (Δv · n) n
/// ```
///
/// and the opposite force on l. Δv = v_l − v_k − (ω_k × r_k − ω_l × r_l) is the difference of velocities in the
/// middle of the gap, r_k = (R_k + h/2) n and r_l = −(R_l + h/2) n, where the forces act: momentum and its moment are
/// conserved, a rigid rotation gives no force, and all take energy. The source takes both at the spheres' surfaces,
/// which is the same only where they touch. Source: Catalano 2012, Eqs. (6.29), (6.30).
pub(crate) struct EdgeForces {
    edges: Vec<Edge>,
}

/// The gap between two neighbours.
struct Gap {
    /// From the sphere to its neighbour.
    normal: Vector,
    /// From the sphere's centre to the middle of the gap, m, and from that of the neighbour.
    levers: [f64; 2],
    /// Resistance to sliding and to parting, N s/m.
    resistances: [f64; 2],
}

impl EdgeForces {
    /// Edges of a mesh that can bear a force; walls bear one where fluid sticks to them. None if the fluid neither
    /// shears nor lubricates.
    pub fn new(geometry: &PoreGeometry, setup: &FlowSetup) -> Option<Self> {
        if !setup.fluid.shear && setup.fluid.lubrication.is_none() {
            return None;
        }
        let mut edges = geometry.edges();
        edges.retain(|e| match e.other {
            Vertex::Sphere(_) => true,
            Vertex::Wall(w) => setup.sides[w].sticks,
        });
        Some(Self { edges })
    }

    /// The edges with a gap.
    fn gaps(&self, grains: &GrainSystem, fluid: &Fluid) -> impl Iterator<Item = (&Edge, Gap)> {
        let edges = self.edges.iter();
        edges.filter_map(move |edge| Some((edge, gap(edge, grains, fluid)?)))
    }

    /// Force (N) and moment (N m) of the velocities of now on every grain, and force on every wall; every body sums its
    /// edges in their order.
    pub fn apply(&self, grains: &GrainSystem, fluid: &Fluid) -> [Vec<Vector>; 3] {
        let g = &grains.grains;
        let counts = [g.len(), g.len(), grains.walls.len()];
        let [mut forces, mut torques, mut walls] = counts.map(|n| vec![Vector::zeros(); n]);
        for (edge, gap) in self.gaps(grains, fluid) {
            let k = edge.sphere;
            let there = |sphere: usize, lever: f64| {
                g.velocity[sphere] + g.spin[sphere].cross(&(lever * gap.normal))
            };
            let [lever, beyond] = gap.levers;
            let other = match edge.other {
                Vertex::Sphere(l) => there(l, -beyond),
                Vertex::Wall(w) => grains.walls[w].velocity,
            };
            let difference = other - there(k, lever);
            let along = difference.dot(&gap.normal) * gap.normal;
            let [sliding, parting] = gap.resistances;
            let force = sliding * (difference - along) + parting * along;
            forces[k] += force;
            torques[k] += lever * gap.normal.cross(&force);
            match edge.other {
                Vertex::Sphere(l) => {
                    forces[l] -= force;
                    torques[l] += beyond * gap.normal.cross(&force);
                }
                Vertex::Wall(w) => walls[w] -= force,
            }
        }
        [forces, torques, walls]
    }

    /// A bound (1/s) of the largest eigenvalue of M⁻¹ times the resistances, and the grain that has it:
    ///
    /// ```text
    /// λ ≤ max_k Σ_l (c_t (s_k + s_l) + c_n (1/m_k + 1/m_l)),     s = 1/m + r²/J
    /// ```
    ///
    /// since c |a_k − a_l|² ≤ c (s_k + s_l) (|a_k|²/s_k + |a_l|²/s_l), and |v + ω × r|² ≤ s (m v² + J ω²).
    pub fn rate(&self, grains: &GrainSystem, fluid: &Fluid) -> (f64, usize) {
        let g = &grains.grains;
        let mut sums = vec![0.0; g.len()];
        let mobility = |sphere: usize, lever: f64| {
            if g.held[sphere] {
                return [0.0; 2];
            }
            let mass = 1.0 / g.mass[sphere];
            [mass + lever * lever / g.inertia(sphere), mass]
        };
        for (edge, gap) in self.gaps(grains, fluid) {
            let here = mobility(edge.sphere, gap.levers[0]);
            let there = match edge.other {
                Vertex::Sphere(l) => mobility(l, gap.levers[1]),
                // A piston moves along its normal only.
                Vertex::Wall(w) => [0.0, 1.0 / grains.walls[w].mass()],
            };
            let part = |d: usize| gap.resistances[d] * (here[d] + there[d]);
            let both = part(0) + part(1);
            sums[edge.sphere] += both;
            if let Vertex::Sphere(l) = edge.other {
                sums[l] += both;
            }
        }
        let larger = |most: (f64, usize), (k, sum)| if sum > most.0 { (sum, k) } else { most };
        sums.into_iter().enumerate().fold((0.0, 0), larger)
    }
}

/// The present gap between two neighbours; nothing where their centres coincide.
fn gap(edge: &Edge, grains: &GrainSystem, fluid: &Fluid) -> Option<Gap> {
    let g = &grains.grains;
    let (x, radius) = (g.position[edge.sphere], g.radius[edge.sphere]);
    let (between, smaller, reduced, far) = match edge.other {
        Vertex::Sphere(l) => {
            let other = g.radius[l];
            let reduced = radius * other / (radius + other);
            (g.position[l] - x, radius.min(other), reduced, other)
        }
        Vertex::Wall(w) => {
            let wall = &grains.walls[w];
            let foot = -wall.normal * wall.normal.dot(&(x - wall.point));
            (foot, radius, radius, 0.0)
        }
    };
    let distance = between.norm();
    let normal = between.try_normalize(0.0)?;
    let open = distance - radius - far;
    let shear = match fluid.shear {
        true => fluid.viscosity * edge.area.max(0.0) / (open.max(0.0) + HYDRAULIC * smaller),
        false => 0.0,
    };
    let lubricated = |l| fluid.viscosity * resistance(l, reduced, open);
    let lubrication = fluid.lubrication.map_or(0.0, lubricated);
    Some(Gap {
        normal,
        levers: [radius + 0.5 * open, far + 0.5 * open],
        resistances: [shear, lubrication],
    })
}

/// Resistance to parting over the viscosity, m.
fn resistance(lubrication: Lubrication, reduced: f64, gap: f64) -> f64 {
    let Lubrication { roughness, range } = lubrication;
    let width = gap.max(roughness * reduced);
    let excess = 1.0 / width - 1.0 / (range * reduced);
    6.0 * PI * reduced * reduced * excess.max(0.0)
}
