//! Numbers side by side: one formula, written once, for a number and for vectors of 2, 4 or 8 numbers.
//!
//! * [`Lane`] is what a formula sees: `f64` is one, [`Lanes`] are several. No operation mixes lanes and none is fused,
//!   so that every lane has the bits that `f64` has, whatever the width.
//! * [`InLanes`]: numbers, vectors and tuples of them, of several particles.
//! * [`dispatch`] runs a [`Body`] with the widest lanes that the processor has: 8 with AVX-512, 4 with AVX2, 2 elsewhere.
//! * [`atan2`] and [`ln`] have the same bits on every processor, which those of the C library have not.
//!
//! Whatever a body calls has to be `#[inline(always)]`, and has to be a loop rather than a closure that is handed down:
//! a function of its own is compiled for the least processor.

mod dispatch;
mod elementary;
mod in_lanes;
mod lane;
mod vector;

pub use dispatch::{Body, Width, dispatch, dispatch_at, force_width, width};
pub use elementary::{atan2, ln};
pub use in_lanes::InLanes;
pub use lane::{Lane, add_scaled, dot, scaled};
pub use vector::{Lanes, MOST};
