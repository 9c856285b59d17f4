//! Walls and motions that are refused: the wall, the place and what to do about it, exit code 2,
//! and nothing written.

mod bench;
mod files;
mod keys;
mod openings;
mod plane;
mod stl;
mod touching;
