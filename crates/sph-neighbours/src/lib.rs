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
//! * [`decomposition`] divides particles between ranks; [`prelude`] has the imports of a pair term.
//!
//! Each particle sums its own neighbourhood in the order of its list: no atomics, and the same
//! bits for any number of threads.

mod blocks;
mod collective;
pub mod decomposition;
mod domain;
mod kernel;
mod lanes;
mod lists;
mod loads;
mod pairs;
pub mod prelude;
mod terms;
mod walls;
mod world;

pub use blocks::{by_phase, each_block, joined};
pub use collective::exchange::Words;
pub use collective::owned::{Owned, OwnedElements};
pub use collective::space::{Space, inner};
pub use domain::Domain;
pub use kernel::inverse::trusted_inverse;
pub use kernel::kernel_sums::{kernel_sums, shepard};
pub use kernel::kernels::KernelEntry;
pub use kernel::lattice::{lattice_sum, rows_sum};
pub use kernel::scaling::{Scaling, WallScale};
pub use lanes::particles::Particles;
pub use lanes::{LanePair, Pair, beyond_linear, minus, splat, unlike, vector};
pub use lists::clusters::{CHUNK, Clusters};
pub use lists::grid::{CellGrid, Extent};
pub use lists::half::{SweepHalf, is_wanted};
pub use lists::hidden::{Hidden, HiddenPairs};
pub use lists::nearby::Nearby;
pub use loads::depth_gauge::DepthGauge;
pub use loads::reaction::{loads, reactions, wall_forces};
pub use loads::wall_parts::{WallPart, wall_parts};
pub use pairs::cluster::Cluster;
pub use pairs::cluster_walk::{ClusterWalk, PairNumbers, walk_in_lanes};
pub use pairs::couplings::{Couplings, CouplingsAt, Kinds, Visitor};
pub use pairs::keep_couplings::{CouplingWriter, Rows as CouplingRows, Tally, Weak};
pub use pairs::pair_sum::PairSum;
pub use pairs::row::{NOBODY, Neighbourhood, Row, Rows, Scratch};
pub use pairs::walk::{Around, Surroundings, Values, walk, walk_into, walk_some};
pub use sph_derive::{pair_sum, pair_term};
pub use sph_kernels::lanes::{Body, InLanes, Lane, MOST, add_scaled, dot, scaled};
pub use terms::rates::{Rates, TRANSPORTED};
pub use terms::shares::{ClassRate, TermShare, class_rates, shares_at};
pub use terms::sweep::{
    Sums, accelerations_of, all_sums, declared, interactions, interactions_with,
};
pub use terms::term::{
    BoundTerm, ByPairs, Interaction, PairTerm, RowTerm, TermEntry, Terms, WithTerm,
};
pub use walls::contact_block::{Contact, ContactBlock, ContactIter, ContactRow};
pub use walls::contacts::Contacts;
pub use walls::free_body::{FreeBody, lightness};
pub use walls::slopes::Slope;
pub use walls::wall_force::{WallForce, cross};
pub use walls::{Coulomb, Elements, Frame, LinePull, Passed, WallPoints, WallSet};
pub use world::{Lists, World, column_stage};
