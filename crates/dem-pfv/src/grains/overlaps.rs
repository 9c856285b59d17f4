//! Limits of the overlaps of grains.

use rayon::prelude::*;

use crate::grains::table::Slot;
use crate::grains::{GrainError, GrainSystem, Partner};

/// Share of the smaller radius that an overlap may have at the start.
const AT_START: f64 = 0.1;

impl GrainSystem {
    /// Share of the smaller radius that an overlap may have in a step. Contact laws hold for overlaps that are small
    /// beside the radius: a floor cuts 4 % of the volume off a sphere that is sunk by a quarter of its radius.
    pub const DEEPEST: f64 = 0.25;

    /// The first contact that is deeper than a share of the smaller radius, with the number of its part of the table.
    fn deeper(&self, share: f64) -> Option<(usize, &Slot)> {
        let radius = &self.grains.radius;
        (0..self.table.ends.len()).find_map(|part| {
            let deep = |slot: &&Slot| {
                let mut smaller = radius[slot.first as usize];
                if part == 0 {
                    smaller = smaller.min(radius[slot.second as usize]);
                }
                slot.active && slot.overlap > share * smaller
            };
            let slots = self.table.slots[self.table.part(part)].par_iter();
            Some((part, slots.with_min_len(4096).find_first(deep)?))
        })
    }

    /// Refuses a step from contacts that are too deep.
    pub(crate) fn check_depths(&self) -> Result<(), GrainError> {
        let Some((part, slot)) = self.deeper(Self::DEEPEST) else {
            return Ok(());
        };
        let grain = slot.first as usize;
        Err(GrainError::TooDeep {
            grain,
            at: self.grains.position[grain].into(),
            body: self.partner(part, slot),
            overlap: slot.overlap,
            share: slot.overlap / self.grains.radius[grain],
            most: Self::DEEPEST,
        })
    }

    pub(crate) fn check_overlaps(&mut self) -> Result<(), GrainError> {
        self.evaluate()?;
        let Some((part, slot)) = self.deeper(AT_START) else {
            return Ok(());
        };
        let (grain, overlap) = (slot.first as usize, slot.overlap);
        Err(match self.partner(part, slot) {
            Partner::Grain(second) => GrainError::Overlap(grain, second, overlap),
            Partner::Wall(wall) => GrainError::InWall {
                grain,
                wall,
                overlap,
                distance: self.walls[wall].distance(&self.grains.position[grain]),
            },
            Partner::Triangle { mesh, triangle } => GrainError::InMesh {
                grain,
                mesh,
                triangle,
                overlap,
            },
        })
    }
}
