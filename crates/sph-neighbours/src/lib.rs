//! Neighbour lists, and the one walk over the pairs that serves every term.
//!
//! * [`CellGrid`] sorts points by cell; [`Clusters`] keep, for a few particles or for each, the candidates
//!   within the support plus a skin, and stay valid until a particle moved half the skin.
//! * [`World`] is the input of a stage: the columns of the free particles, the wall points and
//!   elements, the lists, the kernel.
//! * A [`PairTerm`] sums over pairs ([`PairSum`]), its formula written once for lanes; [`Interaction`] is the object-safe
//!   form, called once per cluster of particles and never per pair.
//! * [`interactions`] is the sweep that sums all terms, [`kernel_sums`] the density sum, [`lattice_sum`] what a sum
//!   would be on a lattice.
//! * [`decomposition`] divides particles between ranks.
//!
//! Each particle sums its own neighbourhood in the order of its list: no atomics, and the same
//! bits for any number of threads.

mod blocks;
mod buffer;
mod cluster;
mod cluster_walk;
mod clusters;
mod contact_block;
mod contacts;
mod couplings;
pub mod decomposition;
mod depth_gauge;
mod domain;
mod exchange;
mod facing;
mod free_body;
mod grid;
mod half;
mod hidden;
mod inverse;
mod keep_couplings;
mod kernel_sums;
mod kernel_values;
mod kernels;
mod lane_pair;
mod lane_vector;
mod lattice;
mod lightness;
mod members;
mod nearby;
mod owned;
mod pair_sum;
mod particles;
mod pools;
mod rates;
mod reaction;
mod row;
mod scaling;
mod separation;
mod shares;
mod slopes;
mod space;
mod sums;
mod sweep;
mod term;
mod walk;
mod wall_force;
mod wall_parts;
mod walls;
mod world;

pub use blocks::{by_phase, each_block, joined};
pub use cluster::Cluster;
pub use cluster_walk::{ClusterWalk, PairNumbers, walk_in_lanes};
pub use clusters::{CHUNK, Clusters};
pub use contact_block::{Contact, ContactBlock, ContactIter, ContactRow};
pub use contacts::Contacts;
pub use couplings::{Couplings, CouplingsAt, Kinds, Visitor};
pub use depth_gauge::DepthGauge;
pub use domain::Domain;
pub use exchange::Words;
pub use free_body::FreeBody;
pub use grid::{CellGrid, Extent};
pub use half::{SweepHalf, is_wanted};
pub use hidden::{Hidden, HiddenPairs};
pub use inverse::trusted_inverse;
pub use keep_couplings::{CouplingWriter, Rows as CouplingRows, Tally, Weak};
pub use kernel_sums::{kernel_sums, shepard};
pub use kernels::KernelEntry;
pub use lane_pair::{LanePair, Pair};
pub use lane_vector::{minus, splat, unlike, vector};
pub use lattice::{lattice_sum, rows_sum};
pub use lightness::lightness;
pub use nearby::Nearby;
pub use owned::{Owned, OwnedElements};
pub use pair_sum::PairSum;
pub use particles::Particles;
pub use rates::{Rates, TRANSPORTED};
pub use reaction::{loads, reactions, wall_forces};
pub use row::{NOBODY, Neighbourhood, Row, Rows, Scratch};
pub use scaling::{Scaling, WallScale};
pub use shares::{ClassRate, TermShare, class_rates, shares_at};
pub use slopes::{Slope, Slopes};
pub use space::{Space, inner};
pub use sph_derive::pair_term;
pub use sph_kernels::lanes::{Body, InLanes, Lane, MOST, add_scaled, dot, scaled};
pub use sweep::{Sums, accelerations_of, all_sums, declared, interactions, interactions_with};
pub use term::{BoundTerm, ByPairs, Interaction, PairTerm, RowTerm, TermEntry, Terms, WithTerm};
pub use walk::{Around, Surroundings, Values, walk, walk_into, walk_some};
pub use wall_force::{WallForce, cross};
pub use wall_parts::{WallPart, wall_parts};
pub use walls::{Coulomb, Elements, Frame, LinePull, Passed, WallPoints, WallSet};
pub use world::{Lists, World};
