//! Conditions beyond the schema.

mod beds;
pub(crate) mod bounds;
pub(crate) mod collected;
pub(crate) mod corners;
pub(crate) mod dimension;
pub(crate) mod geometry;
mod gravity;
pub(crate) mod motion;
pub(crate) mod names;
pub(crate) mod outlets;
pub(crate) mod overlap;
pub(crate) mod shapes;
pub(crate) mod time;
pub(crate) mod walls;
pub(crate) mod wave;
pub(crate) mod zones;
