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

use std::path::Path;

use crate::IoError;

mod cloud;
mod frames;
mod streamline;
mod track;

pub use cloud::{Cloud, Weights};
pub use frames::{Column, Entry, Frames, Snapshot};
pub use streamline::{draw_streamlines, streamlines};
pub use track::{Line, Track, draw_profile, draw_tracks, evenly, nearest, tracks};

type Result<T> = std::result::Result<T, DrawError>;

/// Errors of drawings.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// A file cannot be read or written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// Something that cannot be drawn: the reason.
    #[error("{0}")]
    Unfit(String),
}

const PLACE: [(&str, &str); 3] = [("x", "m"), ("y", "m"), ("z", "m")];

/// Writes a table beside a picture.
fn write_beside<'c>(
    picture: &Path,
    columns: impl IntoIterator<Item = (&'c str, &'c str)>,
    rows: impl Iterator<Item = Vec<f64>>,
) -> Result<()> {
    let (table, rows) = (picture.with_extension("csv"), rows.collect::<Vec<_>>());
    Ok(crate::write_table(table, columns, &rows)?)
}
