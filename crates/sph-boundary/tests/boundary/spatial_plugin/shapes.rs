//! Walls to draw.

use sph_boundary::{Drawing, Surface};

pub fn drawing(name: &str, points: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Surface {
    Surface {
        name: name.into(),
        points,
        triangles,
    }
}

/// A block, the fluid around it.
pub fn block(name: &str, low: [f64; 3], high: [f64; 3]) -> Surface {
    let corner = |c: usize| [0, 1, 2].map(|k| if c >> k & 1 == 1 { high[k] } else { low[k] });
    let quads: [[u32; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = |q: [u32; 4]| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]];
    drawing(
        name,
        (0..8).map(corner).collect(),
        quads.into_iter().flat_map(halves).collect(),
    )
}

/// A tank, the fluid in it.
pub fn tank(low: [f64; 3], high: [f64; 3]) -> Surface {
    block("tank", low, high).reversed()
}

/// A flat square of the plane z = 0, the fluid above it.
pub fn floor(low: f64, high: f64) -> Surface {
    let points = vec![
        [low, low, 0.0],
        [high, low, 0.0],
        [high, high, 0.0],
        [low, high, 0.0],
    ];
    drawing("floor", points, vec![[0, 1, 2], [0, 2, 3]])
}

/// A square pyramid that stands on the plane z = 0, the fluid around it.
pub fn pyramid(half: f64, height: f64) -> Surface {
    let points = vec![
        [-half, -half, 0.0],
        [half, -half, 0.0],
        [half, half, 0.0],
        [-half, half, 0.0],
        [0.0, 0.0, height],
    ];
    let triangles = vec![
        [0, 2, 1],
        [0, 3, 2],
        [0, 1, 4],
        [1, 2, 4],
        [2, 3, 4],
        [3, 0, 4],
    ];
    drawing("pyramid", points, triangles)
}

/// The upright prism over a polygon in the plane of x and z, drawn out along y, the fluid around it.
///
/// The polygon is star-shaped from its first corner and clockwise.
pub fn prism(name: &str, polygon: &[[f64; 2]], y: [f64; 2]) -> Surface {
    let n = polygon.len() as u32;
    let layer = |y: f64| polygon.iter().map(move |p| [p[0], y, p[1]]);
    let points = layer(y[0]).chain(layer(y[1])).collect();
    let side = |i: u32| {
        let j = (i + 1) % n;
        [[i, j, n + j], [i, n + j, n + i]]
    };
    let cap = |i: u32| [[0, i + 1, i], [n, n + i, n + i + 1]];
    let triangles = (0..n).flat_map(side).chain((1..n - 1).flat_map(cap));
    drawing(name, points, triangles.collect())
}

pub fn wall(surface: Surface) -> Drawing {
    Drawing::Surface(surface)
}
