//! Parts of a domain for several machines.
//!
//! * [`bisect`] gives every particle an owner: cuts across the longest axis until every rank has its share of the cost.
//! * [`Halo`] counts the guests: particles of others that a rank needs because they are within reach of its own.
//! * [`exchanges`] tells which columns guests must be sent before which stage, from what stages say that they touch.
//!
//! Everything is the same on every rank that computes it, and does not depend on threads.

mod bisect;
mod exchange;
mod halo;

pub use bisect::{DecompositionError, bisect};
pub use exchange::{Exchange, exchanges};
pub use halo::Halo;
