//! Thin plates and free ends of walls.
