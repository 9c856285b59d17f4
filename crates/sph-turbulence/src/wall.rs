//! Walls whose boundary layer is finer than the particles.

mod function;
mod law;
mod probe;
mod solution;

use sph_core::Vect;
use sph_neighbours::{Contact, WallSet};

pub use function::{LogLaw, WallFunctionEntry};
pub use law::WallLaw;
pub use probe::FrictionVelocityProbe;
pub use solution::LogLawFlow;

/// Least distance from a wall over the spacing: no particle is let nearer.
pub(crate) const LEAST_DISTANCE: f64 = 0.25;

#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestWall {
    /// Distance from its element's plane, m, not less than a quarter of the spacing.
    pub distance: f64,
    /// Speed along the wall relative to it, m/s.
    pub speed: f64,
}

/// Of the element with the largest mean kernel among those that count, the nearest one.
pub(crate) fn nearest<const D: usize>(
    walls: &WallSet<D>,
    particle: usize,
    velocity: &Vect<D>,
    spacing: f64,
    counts: impl Fn(usize) -> bool,
) -> Option<NearestWall> {
    let elements = &walls.elements;
    let mean = |c: &Contact<D>| c.gradient.norm() / elements.measure[c.element as usize];
    let mut found: Option<(f64, Contact<D>)> = None;
    for contact in walls.contacts.of_particle(particle) {
        let mean = mean(&contact);
        if counts(contact.element as usize) && mean > found.map_or(0.0, |f| f.0) {
            found = Some((mean, contact));
        }
    }
    let contact = found?.1;
    let s = contact.element as usize;
    let slip = velocity - elements.velocity_at(&contact);
    let normal = &elements.normal[s];
    Some(NearestWall {
        distance: contact.distance.max(LEAST_DISTANCE * spacing),
        speed: (slip - normal * slip.dot(normal)).norm(),
    })
}
