//! Files and folders: written whole or not at all, held by one program, tables and series.

pub mod clean;
pub mod disk;
pub mod lock;
pub mod scratch;
pub mod series;
pub mod table;
