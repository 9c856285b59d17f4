//! Parts of a domain for several machines.
//!
//! * [`bisect`] gives every particle an owner: cuts across the longest axis until every rank has its share of the cost.
//!   [`Cuts`] are the same as planes in space, found by ranks that hold a part each.
//! * [`ghosts_by_owner`] counts the ghosts: particles of others that a rank needs because they are within reach of its own.
//! * [`Transport`] is the interface for messages between ranks; [`Thread`] is one that is a thread of this process.
//! * [`Link`] is a rank's connection: decisions and sums of all ranks, and ghosts with the results of their owners.
//! * [`Parts`] is a rank's part of a flow: it moves particles between ranks, and gathers the whole.
//!
//! Everything is the same on every rank that computes it, and does not depend on threads.

mod bisect;
mod cuts;
mod error;
mod gather;
mod gather_walls;
mod ghosts;
mod link;
mod lookup;
mod parts;
mod threads;
mod transport;

pub use bisect::bisect;
pub use cuts::Cuts;
pub use error::{DecompositionError, PartError};
pub use ghosts::ghosts_by_owner;
pub use link::{Link, OWNER};
pub use parts::{Parts, Traffic};
pub use threads::Thread;
pub use transport::{Transport, TransportError};
