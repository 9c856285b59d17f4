//! From a text to tables that conform to the schema, and places of mistakes in it.

pub(crate) mod hints;
pub(crate) mod limits;
pub(crate) mod load;
pub(crate) mod plugins;
pub(crate) mod renamed;
pub(crate) mod schema;
pub(crate) mod suited;
pub(crate) mod units;
