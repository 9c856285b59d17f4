//! Shepard means at many points: the particles around a box, sorted into cells.

use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;
use sph_neighbours::World;

/// A particle, or its image beyond a periodic border.
struct Image {
    position: Vect<2>,
    volume: f64,
    number: usize,
}

/// The particles within some supports of a box.
pub(crate) struct NearbyParticles {
    images: Vec<Image>,
    /// First image of every cell, row after row, and the end.
    first: Vec<usize>,
    corner: Vect<2>,
    side: f64,
    cells: [usize; 2],
}

/// Most cells along a side; beyond that they grow.
const MOST: f64 = 2048.0;

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
        let longest = (far - corner).max();
        let side = radius.max(longest / MOST);
        let cells = [0, 1].map(|k| ((far[k] - corner[k]) / side) as usize + 1);
        let mut near = NearbyParticles {
            images,
            first: vec![0; cells[0] * cells[1] + 1],
            corner,
            side,
            cells,
        };
        near.sort();
        Ok(near)
    }

    /// Brings the images into the order of their cells; those of a cell keep theirs.
    fn sort(&mut self) {
        let mut images = std::mem::take(&mut self.images);
        images.sort_by_key(|image| self.cell(&image.position));
        for image in &images {
            let cell = self.cell(&image.position);
            self.first[cell + 1] += 1;
        }
        for k in 1..self.first.len() {
            self.first[k] += self.first[k - 1];
        }
        self.images = images;
    }

    fn place(&self, x: &Vect<2>) -> [usize; 2] {
        [0, 1].map(|k| {
            let along = (x[k] - self.corner[k]) / self.side;
            (along.max(0.0) as usize).min(self.cells[k] - 1)
        })
    }

    fn cell(&self, x: &Vect<2>) -> usize {
        let [i, j] = self.place(x);
        j * self.cells[0] + i
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
        let [i, j] = self.place(at);
        let (mut sum, mut filling) = (0.0, 0.0);
        for row in j.saturating_sub(1)..(j + 2).min(self.cells[1]) {
            let from = row * self.cells[0] + i.saturating_sub(1);
            let to = row * self.cells[0] + (i + 2).min(self.cells[0]);
            let row = self.first[from]..self.first[to];
            for (image, q) in self.images[row.clone()].iter().zip(&q[row]) {
                let r2 = (at - image.position).norm_squared();
                if r2 < radius * radius {
                    let vw = image.volume * kernel.at(r2.sqrt()).0;
                    filling += vw;
                    sum += vw * q;
                }
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
