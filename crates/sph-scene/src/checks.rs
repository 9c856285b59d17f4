//! Conditions beyond the schema.

pub(crate) mod bodies;
pub(crate) mod collected;
pub(crate) mod geometry;
pub(crate) mod motion;
pub(crate) mod names;
pub(crate) mod shapes;
pub(crate) mod table_check;
pub(crate) mod time;
pub(crate) mod walls;
pub(crate) mod wave;
pub(crate) mod zones;
