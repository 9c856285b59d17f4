//! Parts of a domain for several machines.
//!
//! * [`bisect`] gives every particle an owner: cuts across the longest axis until every rank has its share of the cost.
//!   [`Cuts`] are the same as planes in space, found by ranks that hold a part each.
//! * [`Halo`] counts the ghosts: particles of others that a rank needs because they are within reach of its own.
//! * [`exchanges`] gives the columns that ghosts must get before each stage, from the columns that stages declare.
//! * [`Transport`] is the interface for messages between ranks; [`Thread`] is one that is a thread of this process.
//! * [`Parts`] is a rank's part of a flow: it moves particles between ranks, gives ghosts the results of their owners,
//!   and gathers the whole.
//!
//! Everything is the same on every rank that computes it, and does not depend on threads.

mod agree;
mod bisect;
mod cuts;
mod error;
mod exchange;
mod gather;
mod gather_walls;
mod ghosts;
mod halo;
mod link;
mod lookup;
mod owner;
mod parts;
mod threads;
mod transport;

pub use bisect::{DecompositionError, bisect};
pub use cuts::{CutError, Cuts};
pub use error::{PartError, RankParticles};
pub use exchange::{Exchange, exchanges};
pub use halo::Halo;
pub use owner::OWNER;
pub use parts::{Parts, Traffic};
pub use threads::Thread;
pub use transport::{Transport, TransportError};
