//! What most terms read of a neighbour, packed so that one load serves all of them.

use rayon::prelude::*;
use sph_core::{Access, StepError, Vect, fields};

use crate::{Interaction, There, World};

/// Which columns of neighbours are packed: those that some term declares.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Packed {
    velocity: bool,
    volume: bool,
    pressure: bool,
    density: bool,
}

impl Packed {
    /// What these terms read of neighbours.
    pub fn of<'t, const D: usize>(terms: impl IntoIterator<Item = &'t dyn Interaction<D>>) -> Self {
        let all = terms.into_iter().map(|term| term.access());
        all.fold(Packed::default(), |packed, access| packed.and(&access))
    }

    fn and(self, access: &Access) -> Self {
        let reads = |name: &str| access.neighbours.iter().any(|f| f.name == name);
        Packed {
            velocity: self.velocity || reads(fields::VELOCITY.name),
            volume: self.volume || reads(fields::VOLUME.name),
            pressure: self.pressure || reads(fields::PRESSURE.name),
            density: self.density || reads(fields::DENSITY.name),
        }
    }
}

/// What the terms of a sweep declare, asked once and not in every step.
#[derive(Clone, Debug, Default)]
pub struct Declared {
    /// The columns of every term, in their order.
    pub accesses: Vec<Access>,
    /// What they read of neighbours.
    pub packed: Packed,
}

impl Declared {
    /// What these terms declare.
    pub fn of<'t, const D: usize>(terms: impl IntoIterator<Item = &'t dyn Interaction<D>>) -> Self {
        let accesses: Vec<_> = terms.into_iter().map(|term| term.access()).collect();
        Declared {
            packed: accesses.iter().fold(Packed::default(), Packed::and),
            accesses,
        }
    }
}

/// Packs what most terms read of a neighbour. What no term declares is not a number.
///
/// # Errors
/// If a declared column is missing.
pub fn pack<const D: usize>(
    world: &World<D>,
    states: &mut Vec<There<D>>,
    packed: Packed,
) -> Result<(), StepError> {
    let free = &world.free;
    let column = |field, wanted: bool| match wanted {
        true => free.get(field),
        false => Ok(&[][..]),
    };
    let velocity = match packed.velocity {
        true => free.get(fields::VELOCITY)?,
        false => &[],
    };
    let volume = column(fields::VOLUME, packed.volume)?;
    let pressure = column(fields::PRESSURE, packed.pressure)?;
    let density = column(fields::DENSITY, packed.density)?;
    let scalar = |column: &[f64], i: usize| column.get(i).copied().unwrap_or(f64::NAN);
    let nowhere = || Vect::from_element(f64::NAN);
    let one = |i: usize| There {
        velocity: velocity.get(i).copied().unwrap_or_else(nowhere),
        volume: scalar(volume, i),
        pressure: scalar(pressure, i),
        density: scalar(density, i),
    };
    let all = (0..free.len()).into_par_iter().with_min_len(2048);
    all.map(one).collect_into_vec(states);
    Ok(())
}
