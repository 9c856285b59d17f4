//! Beds of another phase that a fluid takes as rough walls, and surfaces.

mod rough;
mod stage;
mod surface;

pub use rough::RoughBed;
pub(crate) use stage::BedShear;
pub(crate) use surface::SurfaceShare;
