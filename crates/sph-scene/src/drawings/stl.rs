//! Surfaces from STL files, their equal corners welded.

use std::path::Path;

use surface_file::Surface;

use crate::geometry::facets::{Facets, Welder};

/// The surface in a file, and the first facet whose normal is not that of its corners' order.
pub(crate) fn read(path: &Path) -> Result<(Facets, Option<usize>), String> {
    welded(surface_file::read(path)?, &path.display().to_string())
}

/// The same from the bytes of a file called `name`.
pub(crate) fn parse(bytes: Vec<u8>, name: &str) -> Result<(Facets, Option<usize>), String> {
    welded(surface_file::parse(bytes, name)?, name)
}

fn welded(surface: Surface, name: &str) -> Result<(Facets, Option<usize>), String> {
    let mut welder = Welder::default();
    for corners in surface.triangles {
        welder.triangle(corners);
    }
    let facets = welder.finish();
    match facets.triangles.is_empty() {
        true => Err(format!("`{name}` holds no facets")),
        false => Ok((facets, surface.odd)),
    }
}
