//! What moves and what leaves: walls in motion, displacements, outlets, the times of outputs.

mod damping;
mod displacement;
mod levels;
mod movers;
mod moving_walls_3d;
mod outlets;
mod output_times;
mod slipping_walls;
