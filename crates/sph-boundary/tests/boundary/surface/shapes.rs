//! Bodies to draw.

use std::collections::HashMap;

use sph_boundary::{Mesh, PeriodicBox, Surface};

pub use crate::bench::Random;
pub use crate::vector::{Vector as Point, cross, dot, minus, norm, plus};

pub fn surface(name: &str, points: Vec<Point>, triangles: Vec<[u32; 3]>) -> Surface {
    Surface {
        name: name.into(),
        points,
        triangles,
    }
}

/// A block, the fluid around it.
pub fn block(name: &str, low: Point, high: Point) -> Surface {
    let corner = |c: usize| [0, 1, 2].map(|k| if c >> k & 1 == 1 { high[k] } else { low[k] });
    let quads: [[u32; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    surface(name, (0..8).map(corner).collect(), triangles.collect())
}

/// A tank, the fluid in it.
pub fn tank(low: Point, high: Point) -> Surface {
    block("tank", low, high).reversed()
}

/// A flat rectangle of the plane z = 0, the fluid above it.
pub fn floor(low: [f64; 2], high: [f64; 2]) -> Surface {
    let corners = [
        [low[0], low[1]],
        [high[0], low[1]],
        [high[0], high[1]],
        [low[0], high[1]],
    ];
    let points = corners.map(|[x, y]| [x, y, 0.0]).to_vec();
    surface("floor", points, vec![[0, 1, 2], [0, 2, 3]])
}

/// The upright prism over a polygon (counter-clockwise, star-shaped from its first corner), the
/// fluid around it; the walls alone without caps.
pub fn prism(name: &str, polygon: &[[f64; 2]], z: [f64; 2], caps: bool) -> Surface {
    let n = polygon.len() as u32;
    let level = |z: f64| polygon.iter().map(move |p| [p[0], p[1], z]);
    let points = level(z[0]).chain(level(z[1])).collect();
    let mut triangles = Vec::new();
    for i in 0..n {
        let j = (i + 1) % n;
        triangles.extend([[i, j, n + j], [i, n + j, n + i]]);
    }
    if caps {
        for i in 1..n - 1 {
            triangles.extend([[0, i + 1, i], [n, n + i, n + i + 1]]);
        }
    }
    surface(name, points, triangles)
}

/// A square pyramid, the fluid around it.
pub fn pyramid(centre: [f64; 2], half: f64, base: f64, height: f64) -> Surface {
    let corner = |x: f64, y: f64| [centre[0] + x * half, centre[1] + y * half, base];
    let points = vec![
        corner(-1.0, -1.0),
        corner(1.0, -1.0),
        corner(1.0, 1.0),
        corner(-1.0, 1.0),
        [centre[0], centre[1], base + height],
    ];
    let triangles = vec![
        [0, 2, 1],
        [0, 3, 2],
        [0, 1, 4],
        [1, 2, 4],
        [2, 3, 4],
        [3, 0, 4],
    ];
    surface("pyramid", points, triangles)
}

/// An icosahedron whose triangles are cut into four `levels` times, on a sphere about the origin;
/// the fluid around it. 20·4ⁿ triangles.
pub fn icosphere(levels: usize, radius: f64) -> Surface {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let mut points: Vec<Point> = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        points.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let near = |a: usize, b: usize| (norm(minus(points[a], points[b])) - 2.0).abs() < 1e-9;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let out = dot(points[a], cross(points[b], points[c])) > 0.0;
                    let t = if out { [a, b, c] } else { [a, c, b] };
                    triangles.push(t.map(|v| v as u32));
                }
            }
        }
    }
    for _ in 0..levels {
        let mut middle: HashMap<[u32; 2], u32> = HashMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let mut between = |a: u32, b: u32| {
                *middle.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    let (p, q) = (points[a as usize], points[b as usize]);
                    points.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
                    points.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (between(a, b), between(b, c), between(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    let on_sphere = |p: &Point| p.map(|x| x * radius / norm(*p));
    surface("ball", points.iter().map(on_sphere).collect(), triangles)
}

/// A regular polygon about the origin of the plane.
pub fn polygon(n: usize, radius: f64) -> Vec<[f64; 2]> {
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
    let corner = |i: usize| [radius * angle(i).cos(), radius * angle(i).sin()];
    (0..n).map(corner).collect()
}

/// A box that is periodic along some axes.
pub fn periodic(lower: Point, upper: Point, periodic: [bool; 3]) -> PeriodicBox<3> {
    PeriodicBox {
        lower,
        upper,
        periodic,
    }
}

/// All walls in one group, no periodic axis.
pub fn mesh(walls: &[Surface], spacing: f64) -> Mesh<3> {
    mesh_in(walls, spacing, &PeriodicBox::none())
}

pub fn mesh_in(walls: &[Surface], spacing: f64, domain: &PeriodicBox<3>) -> Mesh<3> {
    Mesh::<3>::build(walls, &vec![0; walls.len()], spacing, domain).unwrap()
}

pub fn area(mesh: &Mesh<3>) -> f64 {
    mesh.elements.iter().map(|t| t.measure).sum()
}

/// |Σ area · normal|, zero for a closed wall.
pub fn leak(mesh: &Mesh<3>) -> f64 {
    let mut sum = [0.0; 3];
    for t in &mesh.elements {
        for (total, n) in sum.iter_mut().zip(t.normal) {
            *total += t.measure * n;
        }
    }
    norm(sum)
}

/// θ of the nodes at a place.
pub fn theta_at(mesh: &Mesh<3>, place: Point) -> Vec<f64> {
    let here = |p: Point| norm(minus(p, place)) < 1e-9;
    let nodes = mesh.nodes.iter().filter(|n| here(n.position));
    nodes.map(|n| n.theta).collect()
}
