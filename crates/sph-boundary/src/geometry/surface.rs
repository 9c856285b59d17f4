//! From surfaces to a mesh of triangles.
//!
//! * `places`, `drawn`, `crossing`: the input is welded and checked;
//! * `patches`, `wetted`: planar pieces, without the places where walls touch face to face and without those
//!   that bound no fluid;
//! * `edges`, `lattice`, `fill`: the pieces cut into triangles of about the spacing, alike on both sides of every edge;
//! * `openings`: what a node stands for, and where the walls end;
//! * `bed_faces`: faces that a bed lifts.

mod bed_faces;
mod build;
mod crossing;
mod drawn;
mod edges;
mod fill;
mod lattice;
mod openings;
mod patches;
mod places;
mod wetted;

pub use drawn::{Drawing, Surface};

/// A box with the fluid outside.
#[cfg(test)]
pub(crate) fn boxed(name: &str, low: [f64; 3], high: [f64; 3]) -> Surface {
    let corner = |k: usize| std::array::from_fn(|i| if k >> i & 1 == 0 { low[i] } else { high[i] });
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = |f: [u32; 4]| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]];
    Surface {
        name: name.into(),
        points: (0..8).map(corner).collect(),
        triangles: faces.into_iter().flat_map(halves).collect(),
    }
}
