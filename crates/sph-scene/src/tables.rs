//! The tables of a scene, as plain data.

pub(crate) mod body;
pub(crate) mod motion;
pub(crate) mod numerics;
pub(crate) mod outlet;
pub(crate) mod output;
pub(crate) mod reference;
pub(crate) mod scene;
pub(crate) mod wall;
pub(crate) mod wave;
