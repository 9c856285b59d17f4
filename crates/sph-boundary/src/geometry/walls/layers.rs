//! Places of dummy particles behind a polyline.

use sph_core::Vect;
use sph_core::place_cells::PlaceCells;

use crate::Mesh;
use crate::geometry::walls::wall_mesh::WallMesh;

/// Two particles nearer than this share of the spacing are one.
const TOO_CLOSE: f64 = 0.7;

/// Rows at ½, 1½, … spacings behind every straight stretch, prolonged round corners.
///
/// A place is kept if it is outside the fluid, not nearer to any wall than its own row, and not
/// on top of a place already kept; so right angles are tiled exactly and others nearly so.
///
/// `mesh` is that of the walls.
pub(crate) fn layers(
    walls: &impl WallMesh<2>,
    mesh: &Mesh<2>,
    [spacing, support]: [f64; 2],
) -> Vec<(usize, Vect<2>)> {
    let rows = (support / spacing - 1e-9).ceil() as usize;
    let mut kept = Vec::new();
    let mut places = PlaceCells::new(spacing, []);
    let domain = &mesh.domain;
    let inside_period = |p: [f64; 2]| {
        (0..2).all(|k| {
            !domain.periodic[k]
                || (p[k] >= domain.lower[k] - 1e-9 * spacing
                    && p[k] < domain.upper[k] - 1e-9 * spacing)
        })
    };
    for row in 0..rows {
        let depth = (row as f64 + 0.5) * spacing;
        for (s, segment) in mesh.elements.iter().enumerate() {
            let [start, _] = mesh.corners(s);
            let tangent = segment.tangent();
            // A segment is about one spacing long: its own place is in its middle, and both
            // ends reach on so that outer corners are filled.
            let reach = rows as i64;
            for k in -reach..=reach {
                let along = segment.measure * 0.5 + k as f64 * spacing;
                let p = [0, 1].map(|a| start[a] + tangent[a] * along - segment.normal[a] * depth);
                let beyond = k != 0;
                if walls.contains(&p.into()) {
                    continue;
                }
                let clearance = walls.nearest(&p.into(), depth);
                if clearance.is_some_and(|(d, _)| d < depth * (1.0 - 1e-6)) {
                    continue;
                }
                // A prolonged row serves only places that no segment's own row reaches.
                if beyond && walls.nearest(&p.into(), depth * (1.0 + 1e-6)).is_some() {
                    continue;
                }
                // A wall may lie across a periodic border; a line that closes through it has a place there already.
                let seen = match inside_period(p) {
                    true => p,
                    false => domain.wrapped(p),
                };
                let taken = places.around(seen).any(|q: &[f64; 2]| {
                    (seen[0] - q[0]).hypot(seen[1] - q[1]) < TOO_CLOSE * spacing
                });
                if !taken {
                    places.add(seen, seen);
                    kept.push((segment.wall, p.into()));
                }
            }
        }
    }
    kept
}
