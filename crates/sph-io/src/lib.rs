#![doc = include_str!("../README.md")]
//! ## Contents
//!
//! | subject | write | read |
//! |---|---|---|
//! | fields for ParaView | [`PvdSeries`], [`write_vtu`] from a [`Frame`] of [`Piece`]s | [`read_piece`], [`list_pvd`]; ParaView, VTK |
//! | tables | [`write_table`] | [`read_table`], [`read_columns`] |
//! | time series | [`SeriesWriter`] | [`read_table`], [`read_columns`] |
//! | restart | [`Checkpoint::save`] | [`Checkpoint::load`] |
//! | pictures of particles | [`Picture`] | your eyes |
//! | films | [`write_film`], [`write_gif`] from pictures | your eyes |
//! | plots | [`Plot`], or [`Panels`] of them, as PNG or SVG | your eyes |
//! | streamlines, profiles, tracks | [`curves`], from the frames of a run | your eyes |
//! | summaries | [`write_json`] | anything |
//!
//! All quantities are in SI units. Vectors of planar scenes are padded with a
//! zero, because ParaView takes three components.

mod checkpoint;
pub mod curves;
mod drawing;
mod error;
mod files;
mod paraview;

pub use checkpoint::{Checkpoint, CheckpointFault, Column, ColumnData};
pub use drawing::animation::{write_film, write_gif};
pub use drawing::axes::View;
pub use drawing::colour::{Colour, ColourMap, ColourRanges, quantiles};
pub use drawing::mark::{Series, Style};
pub use drawing::picture::Picture;
pub use drawing::plot::{Panels, Plot};
pub use error::{IoError, Result};
pub use files::clean::{clean, escape, escaped};
pub use files::disk::{
    Checksum, checksum, readable, sweep_temporaries, writable, write_json, write_whole,
};
pub use files::lock::{FolderLock, Holder};
pub use files::scratch::Scratch;
pub use files::series::{SeriesWriter, write_table};
pub use files::table::{Table, TableColumn, read_columns, read_table};
pub use paraview::frame::{Cells, FieldData, FieldValues, Frame, Location, Piece};
pub use paraview::pvd::{PvdSeries, SeriesEntry, list_pvd};
pub use paraview::pvtu::{read_piece, write_share};
pub use paraview::vtu::write_vtu;
pub use paraview::vtu_read::read_vtu;
