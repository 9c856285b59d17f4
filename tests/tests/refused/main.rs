//! Bad input is refused with its line, or survived.

mod bad_files;
mod bad_input;
mod bad_walls;
