//! The open faces of a scene: their elements, the fluid in front of them, their values.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sph_core::Vect;
use sph_kernels::Sampler;
use sph_neighbours::{Passed, WallSet};
use sph_rheology::state::Laws;

use crate::cells::cells;
use crate::memory::{Memory, Totals};
use crate::row::{AdjacentFluid, near};
use crate::{FaceElement, FaceValues, FluidMean, OpenBoundary};

/// Largest delay of insertion and removal, as a share of a row: lists are built anew where particles come or go, and
/// the rows that pass meanwhile wait for each other.
pub(crate) const LATE: f64 = 0.2;

/// Distance of a row from which it is the last one: from here on a port does not stand in for the next. Ours: with ½
/// the level before an outlet is higher by up to 3 %.
const LAST: f64 = 0.75;

/// The share θ of a particle with which a port takes part in sums, from the deficit of the row before it.
///
/// With rows at φ δr, (φ + 1) δr, … from the face the trapezoidal rule lacks θ = φ − ½ there (Euler & Maclaurin), −½ to ½
/// as one row after the other comes nearer and passes, and a little more while one waits for its birth. A row farther away
/// is the last one: the share falls to nothing by θ = 1.
///
/// The mass that a port *holds* is the same but for its errors. These would stay as long as a row takes to pass, for
/// ever where the flow is slow, as beside a wall, and a background pressure makes a barrier of them.
pub(crate) fn as_share(lacks: f64) -> f64 {
    match lacks > LAST {
        true => (LAST * (1.0 - lacks) / (1.0 - LAST)).max(0.0),
        false => lacks.max(-0.5 - 1.5 * LATE),
    }
}

/// Least density of passing fluid, over the reference density of its phase.
const THINNEST: f64 = 0.5;

/// An element that is not open.
pub(crate) const CLOSED: u32 = u32::MAX;

pub(crate) struct Face<const D: usize> {
    pub name: String,
    pub law: Arc<dyn OpenBoundary<D>>,
    /// The fluid that comes in.
    pub phase: Option<u32>,
    pub values: Arc<[(String, f64)]>,
    pub body: Arc<str>,
    /// Its elements among those of all faces.
    pub elements: std::ops::Range<usize>,
}

/// The row of particles before an element where its face is full.
#[derive(Clone, Copy, Default)]
pub(crate) struct FullRow {
    /// Weight Σ V w of the [row](crate::row::Row).
    pub weight: f64,
    /// Volume that [stands](crate::row::row_weight) before the element, m^d.
    pub volume: f64,
    /// Weight of one row of particles that stands on the face.
    pub at_port: f64,
}

/// All of them. Every element has a port at its centre: a wall point with the mass that is not in particles.
#[derive(Default)]
pub(crate) struct Faces<const D: usize> {
    pub faces: Vec<Face<D>>,
    /// Equations of state by phase.
    pub laws: Laws,
    /// Pressure of every phase at its reference density, Pa; used for every particle before a face.
    pub backgrounds: Vec<f64>,
    /// Mass of a whole particle by phase, kg.
    pub whole: Vec<f64>,
    pub spacing: f64,
    /// Radius of the kernel's support, m.
    pub support: f64,
    /// Elements of the walls of every [cell](crate::cells::Cell), face by face.
    pub elements: Vec<Vec<u32>>,
    /// The number in `elements` of an element of the walls, or [`CLOSED`].
    pub open: Vec<u32>,
    pub places: Vec<FaceElement<D>>,
    pub face_of: Vec<usize>,
    /// For every element those of its face near it, with their share in a mean over the support of a quantity that is
    /// constant along the normal.
    pub smooth: Vec<Vec<(u32, f64)>>,
    /// Means before the elements, as late as they arrive at the face.
    pub inside: Vec<FluidMean<D>>,
    /// The fluid before them at this moment.
    pub looked: Vec<AdjacentFluid<D>>,
    pub outside: Vec<FaceValues<D>>,
    /// Volume per time that the law of every face [requests](OpenBoundary::asked), m³/s.
    pub asked: Vec<Option<f64>>,
    pub full: Vec<FullRow>,
    /// The [share](as_share) of a particle with which every port takes part in sums.
    pub lacking: Vec<f64>,
    pub memory: Memory<D>,
    /// Change of velocities by [`balance`](Self::balance), m/s; zero in between.
    pub kicks: Vec<Vect<D>>,
    /// Pressure that it takes out before every particle, Pa; zero in between.
    pub before: Vec<f64>,
    /// True if particles come and go at the end of this step.
    pub due: bool,
}

/// The faces, known to the walls and to the work within a step.
pub(crate) type SharedFaces<const D: usize> = Arc<Mutex<Faces<D>>>;

/// The faces; a panic elsewhere does not make them unusable.
pub(crate) fn lock<const D: usize>(faces: &SharedFaces<D>) -> MutexGuard<'_, Faces<D>> {
    faces.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<const D: usize> Faces<D> {
    /// Finds its elements among those of the walls, and gives every one a port.
    pub fn find(&mut self, walls: &mut WallSet<D>, kernel: &dyn Sampler) {
        self.support = kernel.support_radius();
        self.open = vec![CLOSED; walls.elements.centre.len()];
        self.elements.clear();
        self.places.clear();
        self.face_of.clear();
        for (f, face) in self.faces.iter_mut().enumerate() {
            let first = self.elements.len();
            for cell in cells(walls, &face.name) {
                for s in &cell.elements {
                    self.open[*s as usize] = self.elements.len() as u32;
                }
                self.elements.push(cell.elements);
                self.places.push(cell.place);
                self.face_of.push(f);
            }
            face.elements = first..self.elements.len();
        }
        walls.elements.open = self.open.iter().map(|k| *k != CLOSED).collect();
        let all = 0..self.places.len();
        self.smooth = all.clone().map(|k| self.mean_weights(k, kernel)).collect();
        self.full = all.map(|k| self.when_full(k, kernel)).collect();
        self.add_ports(walls);
        let (ports, phases) = (self.elements.len(), self.whole.len());
        self.inside = vec![FluidMean::nothing(); ports];
        self.outside = vec![FaceValues::dry(); ports];
        self.asked = vec![None; self.faces.len()];
        self.lacking = vec![0.0; ports];
        self.memory = Memory::new(ports, phases, self.faces.len());
        self.looked = (0..ports).map(|k| self.nothing(k)).collect();
        walls.passed = self.passed(walls);
    }

    /// Weights of the mean of a velocity that is given on the face, as the fluid's own is taken: over rows of particles in front
    /// of it.
    fn mean_weights(&self, k: usize, kernel: &dyn Sampler) -> Vec<(u32, f64)> {
        let own = self.faces[self.face_of[k]].elements.clone();
        let all = own.map(|j| (j as u32, self.rows_before(k, j, kernel)));
        all.filter(|(_, w)| *w > 0.0).collect()
    }

    /// Σ S w over the rows of particles before an element, as seen from another.
    fn rows_before(&self, k: usize, j: usize, kernel: &dyn Sampler) -> f64 {
        let rows = (kernel.support_radius() / self.spacing).ceil() as usize;
        let apart = (self.places[k].centre - self.places[j].centre).norm_squared();
        if apart >= kernel.support_radius().powi(2) {
            return 0.0;
        }
        let row = |row: usize| {
            let height = (row as f64 + 0.5) * self.spacing;
            kernel.at((apart + height * height).sqrt()).0
        };
        self.places[j].measure * (0..rows).map(row).sum::<f64>()
    }

    /// The row before an element where its face is full.
    fn when_full(&self, k: usize, kernel: &dyn Sampler) -> FullRow {
        let mut full = FullRow::default();
        for j in self.faces[self.face_of[k]].elements.clone() {
            let apart = (self.places[k].centre - self.places[j].centre).norm_squared();
            if apart < kernel.support_radius().powi(2) {
                let (beside, measure) = (near(apart, self.spacing), self.places[j].measure);
                full.weight += beside * self.rows_before(k, j, kernel);
                full.volume += beside * measure;
                full.at_port += beside * measure * kernel.at(apart.sqrt()).0;
            }
        }
        FullRow {
            weight: full.weight * self.spacing,
            volume: full.volume * self.spacing,
            at_port: full.at_port * self.spacing,
        }
    }

    fn add_ports(&self, walls: &mut WallSet<D>) {
        let points = &mut walls.points;
        points.ports = true;
        let cell = self.spacing.powi(D as i32);
        for (place, own) in self.places.iter().zip(&self.elements) {
            points.position.push(place.centre);
            points.velocity.push(Vect::zeros());
            points.viscous_velocity.push(Vect::zeros());
            points.share.push(0.0);
            points.volume.push(cell);
            points.pressure.push(0.0);
            points.friction_factor.push(0.0);
            points.wall.push(walls.elements.wall[own[0] as usize]);
            // Where no wall moves or slips these are empty.
            if !points.acceleration.is_empty() {
                points.acceleration.push(Vect::zeros());
            }
            if !points.slip.is_empty() {
                points.slip.push((0.0, place.normal));
            }
        }
    }

    /// The phase that comes in at an element: the face's, or the largest one in front of it.
    pub fn phase(&self, element: usize) -> usize {
        let own = self.faces[self.face_of[element]].phase;
        own.map_or_else(|| most(&self.looked[element].mix), |phase| phase as usize)
    }

    /// The phase whose sound arrives at an element before which the phases have these shares: that which comes in, or
    /// the largest one there.
    pub fn before_all(&self, element: usize, mix: &[f64]) -> usize {
        let own = self.faces[self.face_of[element]].phase.map(|q| q as usize);
        own.filter(|q| mix[*q] > 0.0).unwrap_or_else(|| most(mix))
    }

    /// Density of the fluid that passes at an element, kg/m³.
    pub fn density(&self, element: usize, phase: usize) -> f64 {
        self.density_at(self.outside[element].pressure, phase)
    }

    /// Density of a phase at a pressure over that of its reference density, Pa, in kg/m³, but no less than a share of
    /// this: characteristics are linear, and may lead to a tension at which the law has no density.
    pub fn density_at(&self, pressure: f64, phase: usize) -> f64 {
        let law = &self.laws[phase];
        let density = law.density(pressure + self.backgrounds[phase]);
        density.max(THINNEST * law.reference().density)
    }

    /// The velocity with which fluid passes an element, m/s: the imposed one, or that of the row in front of it plus
    /// the law's addend.
    pub fn through(&self, element: usize) -> Vect<D> {
        let (outside, before) = (&self.outside[element], &self.looked[element]);
        match outside.imposed {
            true => outside.velocity,
            false => before.row + (outside.velocity - before.inside.velocity),
        }
    }

    /// True if a place behind a face is that of a particle that waits to leave.
    pub fn waits(&self, place: &Vect<D>) -> bool {
        self.places.iter().any(|face| {
            let apart = place - face.centre;
            let height = apart.dot(&face.normal);
            let beside = (apart - face.normal * height).norm();
            height <= 0.0 && height > -2.0 * LATE * self.spacing && beside <= self.spacing
        })
    }

    /// Writes the values of the laws to the walls.
    pub fn set_walls(&self, walls: &mut WallSet<D>) {
        let first = walls.points.corners;
        for (k, own) in self.elements.iter().enumerate() {
            let v = first + k;
            let outside = &self.outside[k];
            let pressure = outside.pressure + self.backgrounds[self.phase(k)];
            let through = self.through(k);
            for s in own.iter().map(|s| *s as usize) {
                walls.elements.pressure[s] = pressure;
                walls.elements.velocity[s] = through;
            }
            walls.points.pressure[v] = pressure;
            walls.points.velocity[v] = through;
            walls.points.viscous_velocity[v] = through;
            walls.points.volume[v] = walls.elements.volume[own[0] as usize];
            walls.points.share[v] = self.lacking[k];
        }
        walls.update_contacts();
        walls.passed = self.passed(walls);
    }

    /// Passed mass, face by face and phase by phase.
    pub fn passed(&self, walls: &WallSet<D>) -> Vec<Passed> {
        let phases = self.whole.len();
        let of_phase = |(t, totals): (usize, &Totals)| {
            let (face, phase) = (&self.faces[t / phases], t % phases);
            let wall = walls.names.iter().position(|n| *n == face.name);
            Passed {
                wall: wall.unwrap_or(0) as u32,
                phase: phase as u32,
                entered: totals.entered.value(),
                left: totals.left.value(),
                held: self.held(face, phase),
            }
        };
        let all = self.memory.totals.iter().enumerate();
        all.map(of_phase).collect()
    }

    /// Mass of a phase at the ports of a face, kg.
    pub fn held(&self, face: &Face<D>, phase: usize) -> f64 {
        let at = |k: usize| self.memory.mass[k * self.whole.len() + phase];
        face.elements.clone().map(at).sum()
    }
}

/// The first of the largest.
fn most(mix: &[f64]) -> usize {
    let larger = |a: usize, b: usize| if mix[b] > mix[a] { b } else { a };
    (0..mix.len()).reduce(larger).unwrap_or(0)
}
