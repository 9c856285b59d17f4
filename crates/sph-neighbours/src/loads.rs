//! Forces of the fluid on walls, and its depth before them.

pub(crate) mod depth_gauge;
pub(crate) mod facing;
pub(crate) mod reaction;
pub(crate) mod wall_parts;
