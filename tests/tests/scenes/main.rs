//! The shipped scenes at test sizes, against their own references.
//!
//! Bounds are the acceptance numbers of the scenes; the measured numbers stand in the messages.

mod cavity;
mod channels;
mod dam_breaks;
mod defaults;
mod drops;
mod impacts;
mod implicit;
mod pores;
mod readme_table;
mod rheology;
mod seepage;
mod shipped;
mod slides_and_scour;
mod soil_water;
mod tanks;
mod towed;
mod turbulence;
mod unneeded_columns;
mod vortices;
mod waves;
