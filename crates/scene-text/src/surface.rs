//! Surfaces of triangles: read from STL files, welded, and their properties: openings, orientation, inside.
//!
//! ```
//! let text = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
//!     endloop\nendfacet\nendsolid a\n";
//! let surface = scene_text::surface::parse(text.to_vec(), "a.stl").expect("a triangle");
//! assert_eq!(surface.triangles[0][1], [1.0, 0.0, 0.0]);
//! assert!(scene_text::surface::parse(b"solid a".to_vec(), "a.stl").unwrap_err().contains("endsolid"));
//! ```

mod facets;
mod stl;
mod topology;
mod vector;

pub use facets::{Facets, Welder};
pub use stl::{StlFile, parse, read};
pub use topology::{Opening, Topology};
pub use vector::{cross, dot, minus};
