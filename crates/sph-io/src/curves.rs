//! # Pictures of a run, made afterwards
//!
//! Read and drawn from the frames that a run has written: streamlines of one
//! moment, profiles along a line, tracks of single particles. It has points with columns, and no particle method.
//!
//! | subject | computed by | drawn and written by |
//! |---|---|---|
//! | streamlines | [`streamlines`] | [`draw_streamlines`] |
//! | profiles along a line | [`Snapshot::profile`] | [`draw_profile`] |
//! | tracks by identity | [`tracks`] | [`draw_tracks`] |
//!
//! Values between particles are those of a linear fit, exact for linear fields: [`Cloud`].

mod cloud;
mod error;
mod frames;
mod profile;
mod snapshot;
mod streamline;
mod track;

pub use cloud::{Cloud, Weights};
pub use error::DrawError;
pub use frames::{Entry, Frames};
pub use profile::{Line, draw_profile};
pub use snapshot::{Column, Snapshot};
pub use streamline::{draw_streamlines, streamlines};
pub use track::{Track, draw_tracks, evenly, nearest, tracks};
