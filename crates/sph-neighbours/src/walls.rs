//! The walls as the pair loop sees them: points with a share of fluid, and elements.
//!
//! Which points and elements there are, and what they carry, is the wall plugin's business.

use sph_core::Vect;

use crate::Domain;

/// Wall points that take part in sums like particles: USAW vertices, dummy particles.
#[derive(Clone, Debug, Default)]
pub struct WallPoints<const D: usize> {
    /// Positions, m.
    pub position: Vec<Vect<D>>,
    /// Velocities of the wall there, m/s.
    pub velocity: Vec<Vect<D>>,
    /// Velocities that viscous sums use, m/s; equal to `velocity` for USAW.
    pub viscous_velocity: Vec<Vect<D>>,
    /// Share θ of a whole particle that is fluid: 1/2 for a vertex on a flat USAW wall.
    pub share: Vec<f64>,
    /// Reference volume of a whole particle, m^d.
    pub volume: Vec<f64>,
    /// Pressure, Pa.
    pub pressure: Vec<f64>,
    /// 1 where the wall rubs, 0 where it slips freely.
    pub grip: Vec<f64>,
    /// Which named wall the point belongs to.
    pub wall: Vec<u32>,
}

/// Wall elements: segments in 2D, triangles in 3D.
#[derive(Clone, Debug, Default)]
pub struct Elements<const D: usize> {
    /// Centres, m.
    pub centre: Vec<Vect<D>>,
    /// Unit normals into the fluid.
    pub normal: Vec<Vect<D>>,
    /// Velocities of the wall at the centres, m/s.
    pub velocity: Vec<Vect<D>>,
    /// Length or area, m^(d−1).
    pub measure: Vec<f64>,
    /// Reference volume of a whole particle at the centre, m^d.
    pub volume: Vec<f64>,
    /// Pressure, Pa.
    pub pressure: Vec<f64>,
    /// 1 where the wall rubs, 0 where it slips freely.
    pub grip: Vec<f64>,
    /// Which named wall the element belongs to.
    pub wall: Vec<u32>,
    /// Corner points of every element, for pictures: indices into the wall points.
    pub corners: Vec<[u32; D]>,
}

impl<const D: usize> Elements<D> {
    /// The centre of an element for given positions of the wall points, m; the corners may be
    /// on two sides of a period.
    pub fn centre_from(&self, element: usize, points: &[Vect<D>], domain: &Domain<D>) -> Vect<D> {
        let corners = self.corners[element].map(|c| points[c as usize]);
        let apart = |c: Vect<D>| domain.nearest_image(c - corners[0]);
        let mean = corners.iter().fold(Vect::zeros(), |sum, c| sum + apart(*c)) / D as f64;
        corners[0] + mean
    }
}

/// A wall element within the support of a particle.
#[derive(Clone, Copy, Debug)]
pub struct Contact<const D: usize> {
    /// Which element.
    pub element: u32,
    /// Its share of ∇γ at the particle, along the inward normal, 1/m.
    pub gradient: Vect<D>,
    /// Distance of the particle from the element's plane, m; negative behind it.
    pub distance: f64,
}

/// The contacts of every free particle, near walls only.
#[derive(Clone, Debug, Default)]
pub struct Contacts<const D: usize> {
    /// Particles that have contacts, ascending.
    pub particles: Vec<u32>,
    /// First contact of every such particle, one more than there are particles.
    pub starts: Vec<u32>,
    /// The contacts.
    pub contacts: Vec<Contact<D>>,
    /// For every free particle its place in `particles`, or `u32::MAX`.
    pub place: Vec<u32>,
}

impl<const D: usize> Contacts<D> {
    /// The contacts of a particle.
    #[inline(always)]
    pub fn of(&self, particle: usize) -> &[Contact<D>] {
        match self.place.get(particle) {
            Some(&p) if p != u32::MAX => {
                let p = p as usize;
                &self.contacts[self.starts[p] as usize..self.starts[p + 1] as usize]
            }
            _ => &[],
        }
    }
}

/// All that the pair loop knows of walls; empty where a scene has none.
#[derive(Clone, Debug, Default)]
pub struct WallSet<const D: usize> {
    /// Names of the walls, as in the scene.
    pub names: Vec<String>,
    /// Points that take part in sums.
    pub points: WallPoints<D>,
    /// Elements with a share of ∇γ.
    pub elements: Elements<D>,
    /// Who touches which element.
    pub contacts: Contacts<D>,
}

impl<const D: usize> WallSet<D> {
    /// Whether there is neither point nor element.
    pub fn is_empty(&self) -> bool {
        self.points.position.is_empty() && self.elements.centre.is_empty()
    }
}
