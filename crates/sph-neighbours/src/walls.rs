//! Walls in the pair loop: points with a share of fluid, and elements.
//!
//! The wall plugin makes the points and elements and sets their values.

pub(crate) mod contact_block;
pub(crate) mod contacts;
pub(crate) mod free_body;
pub(crate) mod slopes;
pub(crate) mod wall_force;

use sph_core::Vect;
use sph_core::bed::Bed;

use crate::{Contact, Contacts, Domain, FreeBody, Slope, WallForce};

/// Wall points that take part in sums like particles: USAW vertices, dummy particles.
#[derive(Clone, Debug, Default)]
pub struct WallPoints<const D: usize> {
    /// Positions, m.
    pub position: Vec<Vect<D>>,
    /// Velocities of the wall there, m/s.
    pub velocity: Vec<Vect<D>>,
    /// Velocities that viscous sums use, m/s; equal to `velocity` for USAW.
    pub viscous_velocity: Vec<Vect<D>>,
    /// Share θ of a whole particle that is fluid: 1/2 for a vertex on a flat USAW wall that is
    /// cut at the particle spacing.
    pub share: Vec<f64>,
    /// Reference volume of a whole particle, m^d.
    pub volume: Vec<f64>,
    /// Pressure, Pa.
    pub pressure: Vec<f64>,
    /// Accelerations of the wall there, m/s²; empty where no wall ever moves.
    pub acceleration: Vec<Vect<D>>,
    /// 1 where the wall rubs, 0 where it slips freely.
    pub friction_factor: Vec<f64>,
    /// Slip length, m, and unit normal into the fluid; empty where no wall slips partly.
    pub slip: Vec<(f64, Vect<D>)>,
    /// The named wall of the point.
    pub wall: Vec<u32>,
    /// Number of the first points that are corners of elements alone, without any fluid of their own: they are in no
    /// list and in no sum.
    pub corners: usize,
    /// True if the points behind the corners are the ports of open faces: masses that grow until a particle is born,
    /// and that are in no density sum.
    pub ports: bool,
}

impl<const D: usize> WallPoints<D> {
    /// True if there are points that take part in sums.
    pub fn in_sums(&self) -> bool {
        self.position.len() > self.corners
    }

    /// True if these points carry rows of fluid that stand at the wall.
    pub fn in_density(&self) -> bool {
        self.in_sums() && !self.ports
    }
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
    /// Velocities of the corners less those of the centres, m/s; empty in the plane and where no wall ever moves.
    pub turning: Vec<[Vect<D>; D]>,
    /// Length or area, m^(d−1).
    pub measure: Vec<f64>,
    /// Reference volume of a whole particle at the centre, m^d.
    pub volume: Vec<f64>,
    /// Pressure, Pa.
    pub pressure: Vec<f64>,
    /// Accelerations of the wall at the centres, m/s²; empty where no wall ever moves.
    pub acceleration: Vec<Vect<D>>,
    /// 1 where the wall rubs, 0 where it slips freely.
    pub friction_factor: Vec<f64>,
    /// Slip length, m; empty where no wall slips partly.
    pub slip: Vec<f64>,
    /// Marks of elements with the friction of a wall function; empty where no wall has one.
    pub wall_function: Vec<bool>,
    /// Marks of elements that fluid passes; empty where there are no open faces.
    pub open: Vec<bool>,
    /// Friction of soils; empty where no wall has a coefficient.
    pub coulomb: Vec<Coulomb>,
    /// The named wall of the element.
    pub wall: Vec<u32>,
    /// Corner points of every element, for pictures: indices into the wall points.
    pub corners: Vec<[u32; D]>,
}

/// Friction of soils on an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coulomb {
    /// Coefficient of friction μ; 0 where there is none.
    pub coefficient: f64,
    /// True if the friction is that of the source instead of μ times the force on the wall.
    pub literal: bool,
}

impl<const D: usize> Elements<D> {
    /// Velocity of the wall at a contact, m/s.
    #[inline(always)]
    pub fn velocity_at(&self, contact: &Contact<D>) -> Vect<D> {
        let s = contact.element as usize;
        let centre = self.velocity[s];
        match contact.corners.zip(self.turning.get(s)) {
            Some((weights, turning)) => {
                let each = weights.iter().zip(turning);
                each.fold(centre, |sum, (weight, more)| sum + more * *weight)
            }
            None => centre,
        }
    }

    /// Numbers of the places where a contact has its state, and their weights: corners are counted behind all elements.
    pub fn places(&self, contact: &Contact<D>) -> [(usize, f64); D] {
        let s = contact.element as usize;
        let corner = |k: usize| self.centre.len() + self.corners[s][k] as usize;
        std::array::from_fn(|k| match (contact.corners, k) {
            (Some(weights), k) => (corner(k), weights[k]),
            (None, 0) => (s, 1.0),
            (None, _) => (s, 0.0),
        })
    }

    /// The centre of an element for given positions of the wall points, m; the corners may be on two sides of a period.
    pub fn centre_from(&self, element: usize, points: &[Vect<D>], domain: &Domain<D>) -> Vect<D> {
        let corners = self.corners[element].map(|c| points[c as usize]);
        let apart = |c: Vect<D>| domain.nearest_image(c - corners[0]);
        let mean = corners.iter().fold(Vect::zeros(), |sum, c| sum + apart(*c)) / D as f64;
        corners[0] + mean
    }
}

/// The pose of a moving wall: x = R X + b, with X the place at which it was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<const D: usize> {
    /// R, row by row.
    pub rotation: [[f64; D]; D],
    /// b, m.
    pub offset: Vect<D>,
    /// Whole periods by which the wall is farther than its points and elements, which stay in the box, m.
    pub round: Vect<D>,
}

impl<const D: usize> Frame<D> {
    /// The present place of a point of the wall, m.
    pub fn present(&self, drawn: &Vect<D>) -> Vect<D> {
        self.offset + self.turned(drawn)
    }

    /// R times a vector: from where the wall was drawn to now.
    pub fn turned(&self, drawn: &Vect<D>) -> Vect<D> {
        let row = |k: usize| (0..D).map(|i| self.rotation[k][i] * drawn[i]).sum::<f64>();
        Vect::from_fn(|k, _| row(k))
    }

    /// Rᵀ times a vector: from now to where the wall was drawn.
    pub fn turned_back(&self, present: &Vect<D>) -> Vect<D> {
        let column = |k: usize| {
            (0..D)
                .map(|i| self.rotation[i][k] * present[i])
                .sum::<f64>()
        };
        Vect::from_fn(|k, _| column(k))
    }
}

/// Action of a line on the wall that it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePull<const D: usize> {
    /// The wall that it holds.
    pub wall: u32,
    /// Force on the wall, N (N/m in two dimensions); its size is the tension there.
    pub force: Vect<D>,
    /// Tension at the other end, N.
    pub anchor: f64,
}

/// Mass of a phase that has passed an open face since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passed {
    /// The named wall of the face.
    pub wall: u32,
    /// Number of the phase.
    pub phase: u32,
    /// Mass that came in, kg (per metre of depth in two dimensions).
    pub entered: f64,
    /// Mass that went out, kg.
    pub left: f64,
    /// Mass that grows or fades at the face and is in no particle, kg; negative where a particle was born early.
    pub held: f64,
}

/// The walls for the pair loop; empty where a scene has none.
#[derive(Clone, Debug, Default)]
pub struct WallSet<const D: usize> {
    /// Names of the walls; one that is drawn in several pieces is there once per piece.
    pub names: Vec<String>,
    /// Points that take part in sums.
    pub points: WallPoints<D>,
    /// Elements with a share of ∇γ.
    pub elements: Elements<D>,
    /// Contacts of particles with elements.
    pub contacts: Contacts<D>,
    /// True if the state of the fluid is found at the corners of elements and interpolated; else at their centres.
    pub at_corners: bool,
    /// True if the walls scale the kernel.
    pub scales: bool,
    /// ∇ ln s of every particle by wall, in the order of the particles, where walls scale the kernel.
    pub slopes: Vec<Slope<D>>,
    /// The pose of every wall, in the order of the names; empty where no wall ever moves.
    pub frames: Vec<Frame<D>>,
    /// The walls that forces move; empty where there is none.
    pub bodies: Vec<FreeBody<D>>,
    /// Walls made by grains; empty in scenes without such walls.
    pub beds: Vec<Bed>,
    /// Mass that has passed the open faces, face by face; empty where there is none.
    pub passed: Vec<Passed>,
    /// Actions of the lines of movers, wall by wall in the order of their scene; empty where there is none.
    pub pulls: Vec<LinePull<D>>,
    /// Forces of the fluid on every wall, in the order of the names; NaN on walls without a probe, empty if none
    /// asks for any.
    pub forces: Vec<WallForce<D>>,
}

impl<const D: usize> WallSet<D> {
    /// True if there is neither point nor element.
    pub fn is_empty(&self) -> bool {
        self.points.position.is_empty() && self.elements.centre.is_empty()
    }

    /// Gives elements the means of the states at their corners.
    pub fn average_corners(&mut self) {
        let (points, elements) = (&self.points, &mut self.elements);
        let share = 1.0 / D as f64;
        for (s, corners) in elements.corners.iter().enumerate() {
            let mean = |of: &[f64]| corners.iter().map(|c| of[*c as usize]).sum::<f64>() * share;
            elements.pressure[s] = mean(&points.pressure);
            elements.volume[s] = mean(&points.volume);
        }
    }

    /// Gives every contact pressure and volume: those of its element, or the interpolated ones of the element's corners.
    pub fn update_contacts(&mut self) {
        let (points, elements) = (&self.points, &self.elements);
        self.contacts.set_states(|element, weights| {
            let s = element as usize;
            let Some(weights) = weights else {
                return [elements.pressure[s], elements.volume[s]];
            };
            let mut state = [0.0; 2];
            for (weight, corner) in weights.iter().zip(elements.corners[s]) {
                state[0] += weight * points.pressure[corner as usize];
                state[1] += weight * points.volume[corner as usize];
            }
            state
        });
    }

    /// Whole periods by which a wall is farther than its points and elements, m.
    pub fn round(&self, wall: u32) -> Vect<D> {
        let frame = self.frames.get(wall as usize);
        frame.map_or_else(Vect::zeros, |frame| frame.round)
    }

    /// Takes over where the same walls are in another set, and volumes and forces there; not the forces of the fluid.
    pub fn follow(&mut self, other: &Self) {
        if !(other.frames.is_empty() && other.passed.is_empty()) {
            let (points, there) = (&mut self.points, &other.points);
            points.position.clone_from(&there.position);
            points.velocity.clone_from(&there.velocity);
            points.viscous_velocity.clone_from(&there.viscous_velocity);
            points.share.clone_from(&there.share);
            points.acceleration.clone_from(&there.acceleration);
            points.slip.clone_from(&there.slip);
            let (elements, there) = (&mut self.elements, &other.elements);
            elements.centre.clone_from(&there.centre);
            elements.normal.clone_from(&there.normal);
            elements.velocity.clone_from(&there.velocity);
            elements.turning.clone_from(&there.turning);
            elements.measure.clone_from(&there.measure);
            elements.acceleration.clone_from(&there.acceleration);
        }
        self.frames.clone_from(&other.frames);
        self.bodies.clone_from(&other.bodies);
        self.beds.clone_from(&other.beds);
        self.passed.clone_from(&other.passed);
        self.pulls.clone_from(&other.pulls);
    }
}
