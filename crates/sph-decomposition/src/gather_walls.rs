//! What walls feel, at one rank, for files.

use sph_core::{Store, Vect, fields};
use sph_neighbours::{CellGrid, World};

use crate::owner::OWNER;
use crate::{PartError, Parts};

impl<const D: usize> Parts<D> {
    /// Whether each particle is this rank's own.
    ///
    /// # Errors
    /// If particles have no owners.
    pub fn own(&self, free: &Store<D>) -> Result<Vec<bool>, PartError> {
        let rank = self.link.transport.rank() as u32;
        Ok(free.get(OWNER)?.iter().map(|o| *o == rank).collect())
    }

    /// Gives the points and elements of the walls at rank 0, which has the `whole`, the pressures that the ranks found there: each
    /// that of the rank whose own particles are nearest. It has all particles that a mean is taken over, if there are any.
    ///
    /// # Errors
    /// Messages that fail; a column that is missing.
    pub fn gather_walls(
        &self,
        world: &World<D>,
        whole: Option<&mut World<D>>,
    ) -> Result<(), PartError> {
        let own = self.own(&world.free)?;
        let positions = world.free.get(fields::POSITION)?.iter().zip(&own);
        let own: Vec<Vect<D>> = positions
            .filter(|(_, own)| **own)
            .map(|(x, _)| *x)
            .collect();
        let (points, elements) = (&world.walls.points, &world.walls.elements);
        let places = points.position.iter().chain(&elements.centre);
        let pressures = points.pressure.iter().chain(&elements.pressure);
        // Means at elements are spread over their neighbours.
        let reach = 2.0 * world.reach();
        let grid = CellGrid::new(&own, reach, &world.domain);
        let mut message = Vec::new();
        for (number, (place, pressure)) in places.zip(pressures).enumerate() {
            let mut least = f64::INFINITY;
            grid.ranges(place, reach, |range| {
                for k in &grid.order()[range] {
                    let apart = world.domain.nearest_image(own[*k as usize] - place);
                    least = least.min(apart.norm_squared());
                }
            });
            if least.is_finite() {
                message.extend_from_slice(&(number as u32).to_le_bytes());
                message.extend_from_slice(&least.to_le_bytes());
                message.extend_from_slice(&pressure.to_le_bytes());
            }
        }
        let messages = self.link.transport.gather(message)?;
        let Some(whole) = whole else {
            return Ok(());
        };
        let (points, elements) = (&mut whole.walls.points, &mut whole.walls.elements);
        points.pressure.clone_from(&world.walls.points.pressure);
        points.share.clone_from(&world.walls.points.share);
        points.velocity.clone_from(&world.walls.points.velocity);
        elements.pressure.clone_from(&world.walls.elements.pressure);
        let corners = points.pressure.len();
        let mut nearest = vec![f64::INFINITY; corners + elements.pressure.len()];
        for entry in messages.iter().flat_map(|m| m.as_chunks::<ENTRY>().0) {
            let (number, rest) = entry.split_at(4);
            let number = u32::from_le_bytes(bytes(number)) as usize;
            let (apart, pressure) = rest.split_at(8);
            let apart = f64::from_le_bytes(bytes(apart));
            // Of ranks that are as near the first is taken: they have found the same.
            if nearest.get(number).is_some_and(|least| apart < *least) {
                nearest[number] = apart;
                let pressure = f64::from_le_bytes(bytes(pressure));
                match number.checked_sub(corners) {
                    None => points.pressure[number] = pressure,
                    Some(element) => elements.pressure[element] = pressure,
                }
            }
        }
        Ok(())
    }
}

/// Bytes of a number, a squared distance and a pressure.
const ENTRY: usize = 20;

/// The first bytes of a slice.
fn bytes<const N: usize>(from: &[u8]) -> [u8; N] {
    std::array::from_fn(|k| from.get(k).copied().unwrap_or(0))
}
