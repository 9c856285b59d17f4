//! From a text to tables that conform to the schema, and places of mistakes in it.

pub(crate) mod columns;
pub(crate) mod diagnostic;
pub(crate) mod files;
pub(crate) mod limits;
pub(crate) mod load;
pub(crate) mod locate;
pub(crate) mod overrides;
pub(crate) mod paths;
pub(crate) mod plugins;
pub(crate) mod remarks;
pub(crate) mod schema;
pub(crate) mod source;
