//! # Files of a simulation
//!
//! Plain data in, files out: this crate has no particle method, but columns
//! of numbers. It serves a solver, but also any script that has positions and
//! fields.
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
//! Three promises hold for all of them.
//!
//! **No half file.** A file that is rewritten (lists, checkpoints, pictures,
//! summaries, grids) is written under a temporary name and renamed
//! ([`write_atomic`]); what grows (tables) grows by whole rows. A full disk or
//! a killed process costs the last output, never the ones before.
//!
//! **No lost bit.** Reals are written with all 64 bits, or in the shortest
//! decimal form that reads back to the same bits. A run that is resumed from a
//! checkpoint, with its table cut by [`SeriesWriter::open_truncated`] and its
//! list by [`PvdSeries::open_at`], leaves the files that the uninterrupted run
//! leaves.
//!
//! **No anonymous error.** Every failure is an [`IoError`] that names the file;
//! damaged checkpoints name the check that failed ([`CheckpointFault`]), bad tables
//! which line and column. [`writable`] reports trouble before the run rather
//! than after it.
//!
//! All quantities are in SI units. Vectors of planar scenes are padded with a
//! zero, because ParaView takes three components.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod checkpoint;
pub mod curves;
mod drawing;
mod error;
mod files;
mod paraview;

pub use checkpoint::{Checkpoint, CheckpointFault, Column, ColumnData};
pub use drawing::animation::{write_film, write_gif};
pub use drawing::colour::{Colour, ColourMap};
pub use drawing::colour_ranges::{ColourRanges, quantiles};
pub use drawing::mark::{Series, Style};
pub use drawing::picture::Picture;
pub use drawing::plot::{Panels, Plot};
pub use drawing::view::View;
pub use error::{IoError, Result};
pub use files::atomic::{Durability, sweep_temporaries, write_atomic, write_json, write_whole};
pub use files::clean::{clean, escaped};
pub use files::folder::{Checksum, checksum, readable, writable};
pub use files::lock::{FolderLock, Holder};
pub use files::scratch::Scratch;
pub use files::series::{SeriesWriter, write_table};
pub use files::table::{Table, TableColumn, read_columns, read_table};
pub use paraview::frame::{Cells, FieldData, FieldValues, Frame, Location, Piece};
pub use paraview::pvd::{PvdSeries, SeriesEntry, list_pvd};
pub use paraview::pvtu::{read_piece, write_share};
pub use paraview::vtu::write_vtu;
pub use paraview::vtu_read::read_vtu;
pub use paraview::xml::escape;
