//! Wall integrals, wall geometry and wall treatments, in the plane and in space.

mod bench;
mod gamma;
mod plugin;
mod random;
mod spatial;
mod spatial_plugin;
mod surface;
mod walls;
