//! Beds of another phase that a fluid takes as rough walls, and surfaces.

mod rough;
mod stage;
mod surface;

pub use rough::RoughBed;
pub(crate) use stage::bed_shear;
pub(crate) use surface::surface_share;
