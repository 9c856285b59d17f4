//! Walls, bodies, motion and open faces in whole scenes.

mod bodies;
mod motion;
mod open_boundaries;
mod walls;
