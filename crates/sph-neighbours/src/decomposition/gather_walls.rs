//! Loads of walls gathered at one rank, for files.

use sph_core::{Vect, fields};

use crate::decomposition::{PartError, Parts};
use crate::{Clusters, World};

impl<const D: usize> Parts<D> {
    /// Gives the points and elements of the walls at rank 0, which has the `whole`, the pressures that the ranks found there. A rank
    /// that has a particle of its own within reach has all that the mean is taken over, so that all such have found the same.
    /// It has the corners of such elements as well, and every rank has open faces.
    ///
    /// # Errors
    /// Messages that fail; a column that is missing.
    pub fn gather_walls(
        &self,
        world: &World<D>,
        whole: Option<&mut World<D>>,
    ) -> Result<(), PartError> {
        let owned = world.owned();
        let positions = world.free.get(fields::POSITION)?;
        let support = world.kernel.support_radius();
        let knows = |lists: &Clusters, place: usize, at: &Vect<D>| {
            let near = |k: &u32| {
                let apart = world.domain.nearest_image(positions[*k as usize] - at);
                owned.has(*k as usize) && apart.norm() < support
            };
            place < lists.len() && lists.candidates(place).iter().any(near)
        };
        let (points, elements) = (&world.walls.points, &world.walls.elements);
        let (first, lists) = (points.corners, &world.lists);
        let mut known = vec![false; points.pressure.len() + elements.pressure.len()];
        let (of_points, of_elements) = known.split_at_mut(points.pressure.len());
        for (k, at) in points.position.iter().enumerate().skip(first) {
            of_points[k] = points.in_density() && knows(&lists.of_points, k - first, at);
        }
        let at_corners = world.walls.at_corners;
        for (k, at) in points.position[..first].iter().enumerate() {
            of_points[k] = at_corners && knows(&lists.of_elements, k, at);
        }
        for (k, at) in elements.centre.iter().enumerate() {
            if at_corners {
                continue;
            }
            of_elements[k] = knows(&lists.of_elements, k, at);
            if of_elements[k] && first > 0 {
                // All around such a corner are within the reach of this rank.
                let corners = elements.corners[k].iter();
                corners.for_each(|corner| of_points[*corner as usize] = true);
            }
        }
        let pressures = points.pressure.iter().chain(&elements.pressure);
        let mut message = Vec::new();
        for (number, (pressure, _)) in pressures.zip(&known).enumerate().filter(|(_, (_, k))| **k) {
            message.extend_from_slice(&(number as u32).to_le_bytes());
            message.extend_from_slice(&pressure.to_le_bytes());
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
        let behind = points.pressure.len();
        for entry in messages.iter().flat_map(|m| m.as_chunks::<ENTRY>().0) {
            let number = entry.first_chunk().copied().unwrap_or_default();
            let number = u32::from_le_bytes(number) as usize;
            let pressure = entry.last_chunk().copied().unwrap_or_default();
            let pressure = f64::from_le_bytes(pressure);
            match number.checked_sub(behind) {
                None => points.pressure[number] = pressure,
                Some(element) => elements.pressure[element] = pressure,
            }
        }
        if at_corners {
            whole.walls.average_corners();
        }
        Ok(())
    }
}

const ENTRY: usize = 12;
