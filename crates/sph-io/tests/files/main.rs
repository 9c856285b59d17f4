//! Files that are written and read back.

mod checkpoints;
mod full_disk;
mod pictures;
mod time_series;
