//! Values at a place, from the particles around it: Shepard means.

use sph_core::place_cells::PlaceCells;
use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;
use sph_neighbours::World;

/// Sums at a point.
#[derive(Clone, Copy, Debug)]
pub struct Interpolated<const D: usize> {
    /// Σ V w: 1 deep inside the fluid, 0 where there is none.
    pub filling: f64,
    /// Σ V [p + ρ (g − A)·(x − r)] w / Σ V w, Pa: exact at rest, and in a tank that is accelerated, where the smoother
    /// has the mean accelerations A.
    pub pressure: f64,
    /// Σ V u w / Σ V w, m/s.
    pub velocity: Vect<D>,
}

/// The free particles within the support of a place, by number, with the way from them to it and V w.
///
/// It walks over all particles: probes are few, and no list exists for them.
///
/// # Errors
/// If a column is missing.
pub(crate) fn around<const D: usize>(
    world: &World<D>,
    x: Vect<D>,
) -> Result<impl Iterator<Item = (usize, Vect<D>, f64)>, StepError> {
    let volume = world.free.get(fields::VOLUME)?;
    let radius = world.kernel.support_radius();
    let all = world.free.get(fields::POSITION)?.iter().enumerate();
    Ok(all.filter_map(move |(j, r)| {
        let d = world.domain.nearest_image(x - r);
        let r2 = d.norm_squared();
        (r2 < radius * radius).then(|| (j, d, volume[j] * world.kernel.at(r2.sqrt()).0))
    }))
}

/// Sums over all free particles within the support of `x`.
///
/// # Errors
/// If a column is missing.
pub fn interpolate<const D: usize>(
    world: &World<D>,
    x: &Vect<D>,
) -> Result<Interpolated<D>, StepError> {
    let velocity = world.free.get(fields::VELOCITY)?;
    let pressure = world.free.get(fields::PRESSURE)?;
    let density = world.free.get(fields::DENSITY)?;
    let acceleration = world.free.get(fields::MEAN_ACCELERATION).ok();
    let mut sum = Interpolated {
        filling: 0.0,
        pressure: 0.0,
        velocity: Vect::zeros(),
    };
    for (j, d, vw) in around(world, *x)? {
        sum.filling += vw;
        let inertia = acceleration.map_or(Vect::zeros(), |a| a[j]);
        sum.pressure += vw * (pressure[j] + density[j] * (world.gravity - inertia).dot(&d));
        sum.velocity += velocity[j] * vw;
    }
    if sum.filling > 0.0 {
        sum.pressure /= sum.filling;
        sum.velocity /= sum.filling;
    }
    Ok(sum)
}

/// A particle, or its image beyond a periodic border.
struct Image {
    position: Vect<2>,
    volume: f64,
    number: usize,
}

/// The particles within some supports of a box.
pub(crate) struct NearbyParticles {
    images: Vec<Image>,
    /// Numbers of the images by their places from the corner.
    cells: PlaceCells<2, usize>,
    corner: Vect<2>,
}

impl NearbyParticles {
    /// Those within `supports` radii of the box between two corners.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn new(
        world: &World<2>,
        low: Vect<2>,
        high: Vect<2>,
        supports: usize,
    ) -> Result<Self, StepError> {
        let positions = world.free.get(fields::POSITION)?;
        let volumes = world.free.get(fields::VOLUME)?;
        let radius = world.kernel.support_radius();
        let margin = Vect::repeat(radius * supports as f64);
        let (corner, far) = (low - margin, high + margin);
        let turns = |axis: usize| {
            if world.domain.periodic[axis] {
                -1..=1
            } else {
                0..=0
            }
        };
        let mut images = Vec::new();
        for (number, (x, &volume)) in positions.iter().zip(volumes).enumerate() {
            for i in turns(0) {
                for j in turns(1) {
                    let mut position = *x;
                    for (axis, turns) in [(0, i), (1, j)] {
                        if turns != 0 {
                            position[axis] += f64::from(turns) * world.domain.length(axis);
                        }
                    }
                    let inside = |k: usize| (corner[k]..=far[k]).contains(&position[k]);
                    if inside(0) && inside(1) {
                        images.push(Image {
                            position,
                            volume,
                            number,
                        });
                    }
                }
            }
        }
        let places = images.iter().map(|image| (image.position - corner).into());
        let cells = PlaceCells::new(radius, places.zip(0..));
        Ok(NearbyParticles {
            images,
            cells,
            corner,
        })
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.images.is_empty()
    }

    /// Numbers of the particles, in the order in which the values of a mean are to be given.
    pub fn numbers(&self) -> impl Iterator<Item = usize> {
        self.images.iter().map(|image| image.number)
    }

    /// Σ V q w / Σ V w at a point; `None` where there is no particle.
    pub fn mean(&self, kernel: &dyn Sampler, at: &Vect<2>, q: &[f64]) -> Option<f64> {
        let radius = kernel.support_radius();
        let (mut sum, mut filling) = (0.0, 0.0);
        for &k in self.cells.around((at - self.corner).into()) {
            let image = &self.images[k];
            let r2 = (at - image.position).norm_squared();
            if r2 < radius * radius {
                let vw = image.volume * kernel.at(r2.sqrt()).0;
                filling += vw;
                sum += vw * q[k];
            }
        }
        (filling > 0.0).then(|| sum / filling)
    }

    /// The means at all particles.
    pub fn means(&self, kernel: &dyn Sampler, q: &[f64]) -> Vec<f64> {
        let at_own = self.images.iter().zip(q);
        at_own
            .map(|(image, q0)| self.mean(kernel, &image.position, q).unwrap_or(*q0))
            .collect()
    }
}
