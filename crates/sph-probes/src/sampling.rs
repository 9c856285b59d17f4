//! Values at a place, from the particles around it: Shepard means.

use sph_core::place_cells::PlaceCells;
use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;
use sph_neighbours::World;

use crate::derived::images_of;

/// The free particles within the support of a place, by number, with the way from them to it and V w.
///
/// It walks over all particles: probes are few, and no list exists for them.
fn around<const D: usize>(
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

/// Σ V q w / Σ V w at a place, of a quantity q by the number of a particle and the way from it; zero where there is no
/// particle.
pub(crate) fn mean_around<const D: usize, const N: usize>(
    world: &World<D>,
    x: Vect<D>,
    quantity: impl Fn(usize, &Vect<D>) -> Vect<N>,
) -> Result<Vect<N>, StepError> {
    let (mut filling, mut sum) = (0.0, Vect::zeros());
    for (j, d, vw) in around(world, x)? {
        filling += vw;
        sum += quantity(j, &d) * vw;
    }
    Ok(if filling > 0.0 { sum / filling } else { sum })
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
    pub fn new(
        world: &World<2>,
        low: Vect<2>,
        high: Vect<2>,
        supports: usize,
    ) -> Result<Self, StepError> {
        let (positions, volumes) = world.free.all((fields::POSITION, fields::VOLUME))?;
        let radius = world.kernel.support_radius();
        let margin = Vect::repeat(radius * supports as f64);
        let (corner, far) = (low - margin, high + margin);
        let inside = |x: &Vect<2>| (0..2).all(|k| (corner[k]..=far[k]).contains(&x[k]));
        let mut images = Vec::new();
        for (number, (x, &volume)) in positions.iter().zip(volumes).enumerate() {
            let near = images_of(world, *x).into_iter().filter(inside);
            images.extend(near.map(|position| Image {
                position,
                volume,
                number,
            }));
        }
        let places = images.iter().map(|image| (image.position - corner).into());
        let cells = PlaceCells::new(radius, places.zip(0..));
        Ok(NearbyParticles {
            images,
            cells,
            corner,
        })
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

    pub fn means(&self, kernel: &dyn Sampler, q: &[f64]) -> Vec<f64> {
        let at_own = self.images.iter().zip(q);
        at_own
            .map(|(image, q0)| self.mean(kernel, &image.position, q).unwrap_or(*q0))
            .collect()
    }
}
