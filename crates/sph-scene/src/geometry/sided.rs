//! Orientation of the facets of a file.

use scene_text::surface::{Facets, Opening};
use sph_core::{SceneProblem, Winding, number};

use crate::geometry::vector::point;
use crate::{FluidSide, Wall};

/// Open surfaces of a smaller [`sense`] than this have no inside: a flat plate has 0, a cube without a lid 0.4.
const NO_INSIDE: f64 = 0.02;
/// Number of openings in a message.
const TOLD: usize = 3;

impl Wall {
    /// The facets of a file with the fluid on the side of the wall's key; `odd` is the first facet whose normal
    /// in the file is not that of its corners.
    pub(crate) fn sided(
        &self,
        facets: Facets,
        odd: Option<usize>,
        place: &str,
    ) -> Result<Facets, SceneProblem> {
        let at = |key: &str, why: String| Err(SceneProblem::new(format!("{place}.{key}"), why));
        let topology = facets.topology();
        if let Some(first) = topology.flipped.first().filter(|_| !self.align) {
            let [corner, ..] = facets.corners(&facets.triangles[*first]);
            let (flipped, all) = (topology.flipped.len(), facets.triangles.len());
            let why = format!(
                "{flipped} of {all} facets face the other way than those beside them, the first is facet {} at {}: \
                 `align = true` turns them round",
                first + 1,
                point(&corner)
            );
            return at("file", why);
        }
        let facets = facets.turned(&topology.flipped);
        let side = match self.side().unwrap_or(FluidSide::AsDrawn) {
            FluidSide::AsDrawn => match odd.filter(|_| !self.align) {
                None => self.flip.then_some(true),
                Some(k) => {
                    let why = format!(
                        "the normal of facet {k} contradicts the order of its corners: give `fluid = \
                         \"inside\"` or \"outside\", which go by the corners, or write the file anew"
                    );
                    return at("fluid", why);
                }
            },
            side if topology.openings.is_empty() => {
                Some((facets.volume() > 0.0) != (side == FluidSide::Outside))
            }
            side => {
                let sense = sense(&facets);
                if sense.abs() < NO_INSIDE {
                    let why = format!(
                        "the surface has {}, and no inside: leave out `fluid` where the normals point into the \
                         fluid, `flip = true` turns them round",
                        openings(&topology.openings)
                    );
                    return at("fluid", why);
                }
                Some((sense > 0.0) != (side == FluidSide::Outside))
            }
        };
        let flipped = side == Some(true);
        Ok(if flipped { facets.flipped() } else { facets })
    }
}

/// Side that a surface faces: [`Winding::sense`].
pub fn sense(facets: &Facets) -> f64 {
    let corners = facets.triangles.iter().map(|t| facets.corners(t));
    Winding::sense(&corners.collect::<Vec<_>>())
}

/// The largest openings in words, in the unit of the file.
pub(crate) fn openings(all: &[Opening]) -> String {
    let opening = |o: &Opening| {
        let (edges, size, centre) = (o.edges, number::plain(o.size), point(&o.centre));
        format!("{edges} edges, {size} across, around {centre}")
    };
    let told: Vec<String> = all.iter().take(TOLD).map(opening).collect();
    let more = if all.len() > TOLD { "; …" } else { "" };
    format!("{} openings ({}{more})", all.len(), told.join("; "))
}
