//! γ and ∇γ in closed form.

pub(crate) mod gamma;
pub(crate) mod spatial;
