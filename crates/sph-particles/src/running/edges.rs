//! The lines that show walls in a picture.

use std::collections::BTreeMap;

use sph_neighbours::World;

/// Cosine of the angle, 20°, beyond which two elements make an edge.
const SMOOTH: f64 = 0.94;

/// Corner points of the lines: all segments in the plane; in space the edges of which only one
/// element is there, or two whose normals differ by more than 20°.
pub fn wall_lines<const D: usize>(world: &World<D>) -> Vec<[u32; 2]> {
    let elements = &world.walls.elements;
    if D == 2 {
        return elements.corners.iter().map(|c| [c[0], c[1]]).collect();
    }
    let mut sides: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (s, corners) in elements.corners.iter().enumerate() {
        for k in 0..D {
            let (a, b) = (corners[k], corners[(k + 1) % D]);
            sides.entry([a.min(b), a.max(b)]).or_default().push(s);
        }
    }
    let shows = |sides: &[usize]| match sides {
        [a, b] => elements.normal[*a].dot(&elements.normal[*b]) < SMOOTH,
        _ => true,
    };
    let lines = sides.iter().filter(|(_, sides)| shows(sides));
    lines.map(|(edge, _)| *edge).collect()
}
