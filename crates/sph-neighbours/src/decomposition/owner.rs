//! The owner of a particle.

use sph_core::{Field, Index};

/// The rank that owns a particle.
pub const OWNER: Field<Index> = Field::new("owner", "1", "rank that owns the particle");
