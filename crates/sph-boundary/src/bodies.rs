//! Rigid bodies that the fluid moves: `[wall.NAME.mover.rigid-body]`.
//!
//! * [`RigidBody`] is the mover: mass, centre and inertia, degrees of freedom, springs and dampers on them ([`Holds`]),
//!   elastic and hanging [`Line`]s, contact.
//! * [`Solid`] has volume, centre and inertia of what lines and surfaces enclose.

mod body;
mod catenary;
mod dynamics;
mod freedom;
mod mooring;
mod prescribed;
mod shape;
mod spatial_vector;

pub use body::RigidBody;
pub use freedom::{Freedom, Hold, HoldTurn, Holds};
pub use mooring::Line;
pub use prescribed::Prescribed;
pub use shape::Solid;
