//! # Files of a simulation
//!
//! Plain data in, files out: this crate knows no particle method, only columns
//! of numbers. It serves a solver, but also any script that has positions and
//! fields and wants to see them.
//!
//! | subject | write | read |
//! |---|---|---|
//! | fields for ParaView | [`PvdSeries`], [`write_vtu`] from a [`Frame`] of [`Piece`]s | [`read_vtu`], [`list_pvd`]; ParaView, VTK |
//! | tables | [`write_table`] | [`read_table`], [`read_columns`] |
//! | time series | [`SeriesWriter`] | [`read_table`], [`read_columns`] |
//! | restart | [`Checkpoint::save`] | [`Checkpoint::load`] |
//! | pictures of particles | [`Picture`] | your eyes |
//! | animations | [`write_gif`] from pictures | your eyes |
//! | plots | [`Plot`], or [`Panels`] of them, as PNG or SVG | your eyes |
//! | summaries | [`write_json`] | anything |
//!
//! Three promises hold for all of them.
//!
//! **No half file.** What is rewritten (lists, checkpoints, pictures,
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
//! damaged checkpoints say which check failed ([`CheckpointFault`]), bad tables
//! which line and column. [`writable`] asks for trouble before the run rather
//! than after it.
//!
//! All quantities are in SI units. Vectors of planar scenes are padded with a
//! zero, because ParaView wants three components.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod animation;
mod atomic;
mod axes;
mod canvas;
mod checkpoint;
mod clean;
mod colour;
mod colour_bar;
mod drawn_series;
mod error;
mod extent;
mod folder;
mod frame;
mod legend;
mod lock;
mod mark;
mod panels;
mod picture;
mod plot;
mod pvd;
mod rows;
mod scratch;
mod series;
mod summary;
mod surface;
mod svg;
mod table;
mod text;
mod ticks;
mod vtu;
mod vtu_read;
mod xml;

pub use animation::write_gif;
pub use atomic::{AtomicFile, Durability, sweep_temporaries, write_atomic};
pub use checkpoint::{Checkpoint, CheckpointFault, Column, ColumnData};
pub use clean::{clean, escaped};
pub use colour::{Colour, ColourMap};
pub use drawn_series::{Series, Style};
pub use error::{IoError, Result};
pub use folder::{Checksum, checksum, readable, writable};
pub use frame::{Cells, FieldData, FieldValues, Frame, Location, Piece};
pub use lock::{FolderLock, Holder};
pub use panels::Panels;
pub use picture::{Picture, View};
pub use plot::Plot;
pub use pvd::{Listed, PvdSeries, list_pvd};
pub use rows::write_table;
pub use scratch::Scratch;
pub use series::SeriesWriter;
pub use summary::write_json;
pub use table::{Table, TableColumn, read_columns, read_table};
pub use vtu::write_vtu;
pub use vtu_read::read_vtu;
pub use xml::escape;
