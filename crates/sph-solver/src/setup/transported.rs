//! The scalars that pair terms transport.

use sph_core::{AnyField, Shape};
use sph_neighbours::{Interaction, TRANSPORTED};

use crate::error::SolverError;

/// The rates that terms write, each once.
pub(crate) fn transported_by<const D: usize>(
    terms: &[Box<dyn Interaction<D>>],
) -> Result<Vec<AnyField>, SolverError> {
    let mut all: Vec<AnyField> = Vec::new();
    for field in terms.iter().flat_map(|t| t.access().writes) {
        if field.shape != Shape::Scalar {
            let name = field.name;
            let why = format!("a pair term writes `{name}`, which is no scalar");
            return Err(SolverError::at("", why));
        }
        if !all.contains(&field) {
            all.push(field);
        }
    }
    match all.len() > TRANSPORTED {
        false => Ok(all),
        true => Err(SolverError::at(
            "",
            format!(
                "the pair terms of this scene transport {} scalars; a sweep sums {TRANSPORTED} at most",
                all.len()
            ),
        )),
    }
}
