//! γ and ∇γ in closed form.

pub(crate) mod gamma;
mod normalisation;
pub(crate) mod spatial;
pub(crate) mod sum;
