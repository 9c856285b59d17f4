//! Particles within a radius of a place.

use sph_core::Vect;
use sph_neighbours::{CellGrid, Domain};

/// Places among which those within a radius of any place are found.
pub(crate) struct NearbyPlaces<'a, const D: usize> {
    domain: &'a Domain<D>,
    grid: CellGrid<D>,
    /// The places in the order of the cells.
    places: Vec<Vect<D>>,
    /// m.
    radius: f64,
}

impl<'a, const D: usize> NearbyPlaces<'a, D> {
    /// Of places in a box, and a radius, m.
    pub fn new(places: &[Vect<D>], radius: f64, domain: &'a Domain<D>) -> Self {
        let grid = CellGrid::new(places, radius, domain);
        let order = grid.order().iter();
        NearbyPlaces {
            places: order.map(|k| places[*k as usize]).collect(),
            domain,
            grid,
            radius,
        }
    }

    /// Visits the places within the radius of `x`: the number of each, its way from `x` and its distance, over the radius.
    #[inline(always)]
    pub fn visit(&self, x: &Vect<D>, mut each: impl FnMut(usize, &Vect<D>, f64)) {
        let per_radius = 1.0 / self.radius;
        let order = self.grid.order();
        self.grid.ranges(x, self.radius, |found| {
            for (k, place) in order[found.clone()].iter().zip(&self.places[found]) {
                let way = self.domain.nearest_image(place - x);
                // Summed in registers: the sum of the vector goes through memory.
                let square = (0..D).fold(0.0, |sum, axis| sum + way[axis] * way[axis]);
                if square < self.radius * self.radius {
                    each(*k as usize, &(way * per_radius), square.sqrt() * per_radius);
                }
            }
        });
    }
}
