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

use std::path::PathBuf;

use crate::IoError;

mod cloud;
mod frames;
mod profile;
mod snapshot;
mod streamline;
mod track;

pub use cloud::{Cloud, Weights};
pub use frames::{Entry, Frames};
pub use profile::{Line, draw_profile};
pub use snapshot::{Column, Snapshot};
pub use streamline::{draw_streamlines, streamlines};
pub use track::{Track, draw_tracks, evenly, nearest, tracks};

/// Errors of drawings.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// A file cannot be read or written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A folder without frames.
    #[error("{} holds no frames of particles", .0.display())]
    NoFrames(PathBuf),
    /// A field that the frames do not have.
    #[error(
        "no field `{name}` was written (there are: {known}); name it in output.fields and run again"
    )]
    NoField {
        /// The request.
        name: String,
        /// The known names.
        known: String,
    },
    /// A component that the field does not have.
    #[error("`{name}` has {components} components, and no `{component}`")]
    NoComponent {
        /// The field.
        name: String,
        /// Its number of components.
        components: usize,
        /// The request.
        component: String,
    },
    /// A particle that no frame has.
    #[error("no frame has a particle of identity {0}")]
    NoParticle(u32),
    /// Something that cannot be drawn.
    #[error("{0}")]
    Unfit(String),
}
