//! Throats, the space around facets between the power centres of two cells, and their conductances.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};
use sph_core::plugin;

use crate::Vector;
use crate::flow::facet::{Facet, angle, edge, inscribed_radius};
use crate::flow::solid_angle;
use crate::triangulation::{self as mesh, Triangulation, Vertex};

/// Condition of the fluid at a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlipCondition {
    /// It sticks: the wall's area counts as wetted and takes its share of the viscous force.
    NoSlip,
    /// It slides, as on a plane of symmetry.
    Slip,
}

/// Sums of the solid angles of throats.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
pub enum SolidAngles {
    /// With their signs: void volume and wetted surface add up to those of the packing exactly.
    #[default]
    Signed,
    /// By their absolute values, as YADE 2023.02a does: up to 1 % less permeable. For comparison.
    Absolute,
}

/// Shorter than this times the root of its area, a throat has no length, and its cells are one pore.
const NO_LENGTH: f64 = 1e-9;

/// Geometry of a throat. Lists of three are in the order of its vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Throat {
    /// The cells i and j on both sides.
    pub cells: [usize; 2],
    /// The vertices of its facet.
    pub vertices: [Vertex; 3],
    /// Unit normal n of the facet, from i to j.
    pub normal: Vector,
    /// Area of the facet, m².
    pub area: f64,
    /// Part of it outside the spheres, m²; negative only if spheres overlap all over it.
    pub fluid_area: f64,
    /// Area of each sphere in the facet, m²; 0 for walls. With the fluid's part, it adds up to the area.
    pub sectors: [f64; 3],
    /// Wetted area γ of each vertex, m²; 0 for walls without grip.
    pub wetted: [f64; 3],
    /// Distance L of the power centres, m.
    pub length: f64,
    /// Volume of fluid φ, m³.
    pub fluid_volume: f64,
    /// Radius of the circle in the facet between its discs and walls, m; 0 if there is none.
    pub inscribed_radius: f64,
    /// Number of walls without grip among its vertices.
    pub slip_walls: usize,
    /// True if its length is zero but for rounding, as in lattices: both cells are one pore.
    pub open: bool,
}

impl Throat {
    /// Hydraulic radius R = φ/γ, m. Source: Catalano 2012, Eq. (3.5).
    pub fn hydraulic_radius(&self) -> f64 {
        self.fluid_volume / self.wetted.iter().sum::<f64>()
    }

    /// Share γ_k/γ of each vertex in the viscous force; none of an open throat.
    pub(crate) fn shares(&self) -> [f64; 3] {
        let wetted = self.wetted.iter().sum::<f64>();
        let share = |w: f64| if self.open { 0.0 } else { w / wetted };
        self.wetted.map(share)
    }
}

/// Input of throats.
pub struct Pores<'a> {
    pub mesh: &'a Triangulation,
    pub centres: &'a [Vector],
    pub grips: &'a [SlipCondition],
    pub angles: SolidAngles,
}

impl Pores<'_> {
    pub fn throat(&self, facet: &mesh::Facet) -> Throat {
        let [i, j] = facet.cells;
        let (pi, pj) = (self.centres[i], self.centres[j]);
        let shape = Facet::new(self.mesh, &facet.vertices);
        let area = self.outward(facet, shape.area());
        let (size, length) = (area.norm(), (pj - pi).norm());
        let open = length <= NO_LENGTH * size.sqrt();
        let normal = area.try_normalize(0.0).unwrap_or_default();
        let (sectors, solid, mut wetted) = self.spheres(facet, &shape, area);
        self.walls(facet, &mut wetted);
        let slips =
            |v: &&Vertex| matches!(v, Vertex::Wall(w) if self.grips[*w] == SlipCondition::Slip);
        Throat {
            cells: facet.cells,
            vertices: facet.vertices,
            normal,
            area: size,
            fluid_area: size - sectors.iter().sum::<f64>(),
            sectors,
            wetted,
            length,
            fluid_volume: size * length / 3.0 - solid,
            inscribed_radius: inscribed_radius(&shape, normal).unwrap_or(0.0),
            slip_walls: facet.vertices.iter().filter(slips).count(),
            open,
        }
    }

    /// Centres of a facet's spheres.
    fn centres_of(&self, facet: &mesh::Facet) -> impl Iterator<Item = Vector> {
        let spheres = facet.vertices.into_iter().filter_map(Vertex::sphere);
        spheres.map(|k| self.mesh.spheres[k].centre)
    }

    /// The area with its sign from cell i to j: as the power centres lie, or, where they are one point, away
    /// from the vertex opposite.
    fn outward(&self, facet: &mesh::Facet, area: Vector) -> Vector {
        let [i, j] = facet.cells;
        let along = self.centres[j] - self.centres[i];
        let far = along.norm() > NO_LENGTH * area.norm().sqrt();
        let base = self.centres_of(facet).next();
        let direction = match self.mesh.cells[i].vertices()[facet.opposite] {
            _ if far => along,
            Vertex::Sphere(k) => base.unwrap_or_default() - self.mesh.spheres[k].centre,
            Vertex::Wall(w) => self.mesh.walls[w].normal,
        };
        let inwards = area.dot(&direction) < 0.0;
        if inwards { -area } else { area }
    }

    /// Sectors, volume and wetted areas of the spheres.
    fn spheres(
        &self,
        facet: &mesh::Facet,
        shape: &Facet,
        area: Vector,
    ) -> ([f64; 3], f64, [f64; 3]) {
        let (mut sectors, mut solid, mut wetted) = ([0.0; 3], 0.0, [0.0; 3]);
        let mut among_spheres = 0;
        for (c, v) in facet.vertices.iter().enumerate() {
            let Vertex::Sphere(k) = *v else { continue };
            let radius = self.mesh.spheres[k].radius;
            let [l, m] = [1, 2].map(|t| edge(self.mesh, k, facet.vertices[(c + t) % 3]));
            let omega = self.solid_angle(k, l, m, facet.cells, area);
            sectors[c] = 0.5 * radius * radius * angle(l, m) - shape.across(among_spheres);
            solid += radius.powi(3) / 3.0 * omega;
            wetted[c] = radius * radius * omega;
            among_spheres += 1;
        }
        (sectors, solid, wetted)
    }

    /// Solid angle at sphere k of the two pyramids over the facet, two triangles that share the line between the
    /// power centres; each with the sign of its turn around the facet's normal.
    fn solid_angle(&self, k: usize, l: Vector, m: Vector, cells: [usize; 2], area: Vector) -> f64 {
        let x = self.mesh.spheres[k].centre;
        let [pi, pj] = cells.map(|c| self.centres[c] - x);
        let (first, second) = (solid_angle(l, pi, pj), solid_angle(m, pi, pj));
        match self.angles {
            SolidAngles::Absolute => first.abs() + second.abs(),
            SolidAngles::Signed if l.cross(&m).dot(&area) < 0.0 => second - first,
            SolidAngles::Signed => first - second,
        }
    }

    /// Areas of walls with grip under the throat: of a triangle or a trapezoid in the wall.
    fn walls(&self, facet: &mesh::Facet, wetted: &mut [f64; 3]) {
        let [pi, pj] = facet.cells.map(|c| self.centres[c]);
        let mut spheres = self.centres_of(facet);
        let across = match [(); 3].map(|()| spheres.next()) {
            [Some(k), m, None] => k - m.unwrap_or(pj),
            _ => return,
        };
        for (c, v) in facet.vertices.iter().enumerate() {
            if let Vertex::Wall(w) = *v
                && self.grips[w] == SlipCondition::NoSlip
            {
                let normal = self.mesh.walls[w].normal;
                wetted[c] = 0.5 * (pi - pj).cross(&across).dot(&normal).abs();
            }
        }
    }
}

/// A law for the conductance of throats.
pub trait Conductance: Send + Sync {
    /// g µ (m⁴) with the flux q = g (p_i − p_j) / L. Zero closes a throat.
    fn conductance(&self, throat: &Throat) -> f64;
}

sph_core::contract!(
    /// A law for the conductance of throats by its name.
    pub ConductanceEntry,
    "conductance",
    Elsewhere,
    "the conductance of a throat between two pores, in [fluid.conductance.LAW]",
    Conductance,
    .in_space()
);

/// g = α A R² / µ with the fluid area A of the facet and the hydraulic radius R = φ/γ; α = ½ is that of
/// a round tube of radius 2R. Source: Catalano 2012, Eqs. (3.4), (3.5).
#[plugin(
    ConductanceEntry,
    "hydraulic-radius",
    "a tube with the throat's ratio of fluid volume to wetted surface",
    source: "Catalano 2012, Eqs. (3.4), (3.5)"
)]
#[derive(PartialEq)]
pub struct HydraulicRadius {
    /// Shape factor α.
    #[parameter(default: 0.5, unit: "1", above: 0.0)]
    pub shape_factor: f64,
    /// Divides R by 2^¼ for each slip wall of a throat, as YADE 2023.02a does; not in the thesis, and it halves
    /// the conductance beside walls of symmetry. For comparison with YADE.
    #[parameter(default)]
    pub reduced_at_slip_walls: bool,
}

impl Conductance for HydraulicRadius {
    fn conductance(&self, throat: &Throat) -> f64 {
        let mut radius = throat.hydraulic_radius();
        if self.reduced_at_slip_walls {
            radius *= 2.0_f64.powf(-0.25 * throat.slip_walls as f64);
        }
        self.shape_factor * throat.fluid_area.max(0.0) * radius * radius
    }
}

/// g = 2π R⁴ / µ with R = ¼ (√(A/π) + r), A the fluid area and r the radius of the inscribed circle.
/// Source: Bryant & Blunt 1992; Catalano 2012, Eq. (3.6).
#[plugin(
    ConductanceEntry,
    "effective-radius",
    "a tube between the throat's inscribed circle and the circle of its area; about half as permeable",
    source: "Bryant & Blunt 1992; Catalano 2012, Eq. (3.6)"
)]
#[derive(PartialEq)]
pub struct EffectiveRadius {}

impl EffectiveRadius {
    /// R, m.
    pub fn radius(throat: &Throat) -> f64 {
        0.25 * ((throat.fluid_area.max(0.0) / PI).sqrt() + throat.inscribed_radius)
    }
}

impl Conductance for EffectiveRadius {
    fn conductance(&self, throat: &Throat) -> f64 {
        2.0 * PI * Self::radius(throat).powi(4)
    }
}
