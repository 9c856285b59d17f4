//! From surfaces to a mesh of triangles.
//!
//! * `places`, `drawn`, `crossing`: the input is welded and checked;
//! * `patches`, `removal`, `seen`: planar pieces, without the places where walls touch face to face and without those
//!   that bound no fluid;
//! * `edges`, `lattice`, `fill`: the pieces cut into triangles of about the spacing, alike on
//!   both sides of every edge;
//! * `solid_angle`, `openings`: what a node stands for, and where the walls end;
//! * `bed_faces`: faces that a bed lifts;
//! * `outside`: which side is the fluid's.

mod bed_faces;
mod build;
mod crossing;
mod drawn;
mod edges;
mod fill;
mod lattice;
mod openings;
mod outside;
mod patches;
mod places;
mod removal;
mod solid_angle;
mod wetted;

pub use drawn::Surface;
