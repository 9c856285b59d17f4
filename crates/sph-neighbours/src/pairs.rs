//! Neighbourhoods of particles and of clusters, walks over them, and what walks keep of pairs.

pub(crate) mod cluster;
pub(crate) mod cluster_walk;
pub(crate) mod couplings;
pub(crate) mod keep_couplings;
pub(crate) mod pair_sum;
pub(crate) mod pools;
pub(crate) mod row;
pub(crate) mod walk;
