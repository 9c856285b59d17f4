//! Planar pieces cut into triangles.

use std::cmp::Ordering::{Equal, Less};
use std::collections::HashMap;

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::lattice::Lattice;
use super::patches::Patch;
use super::places::Site;
use crate::geometry::mesh::SAME_PLACE;
use crate::geometry::periodic::PeriodicBox;
use crate::geometry::vector::{Plane, Point, add, norm, perp, sub};

/// Nodes inside a piece keep this part of the spacing from its edges.
const CLEARANCE: f64 = 0.6;
/// Part of a length or an area that may be rounding.
const ROUNDING: f64 = 1e-9;

/// A corner of a triangle while a piece is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Corner {
    /// On the edge of the piece: the node.
    Edge(Site),
    /// Inside the piece: number among its new nodes.
    Inside(u32),
}

#[derive(Debug, Default)]
pub(super) struct Filling {
    pub inside: Vec<Point>,
    pub triangles: Vec<[Corner; 3]>,
}

impl Filling {
    /// The same with its nodes in the order of the triangles, so that those that are near each other mostly follow each
    /// other.
    fn numbered(mut self) -> Self {
        let mut numbers = vec![None; self.inside.len()];
        let mut inside = Vec::with_capacity(self.inside.len());
        for corner in self.triangles.iter_mut().flatten() {
            if let Corner::Inside(k) = corner {
                let old = *k as usize;
                *k = *numbers[old].get_or_insert_with(|| {
                    inside.push(self.inside[old]);
                    inside.len() as u32 - 1
                });
            }
        }
        self.inside = inside;
        self
    }
}

/// Cuts a planar piece into triangles of about the spacing.
///
/// `sides[e]` are the nodes along its edge e, both ends included; the edges of a loop follow each other. Inside are the
/// points of a square lattice along its longest edge, joined by a constrained Delaunay triangulation; a rectangle gets
/// a lattice that meets the nodes of all its sides. The reason if that is impossible.
pub(super) fn fill(
    patch: &Patch,
    sides: &[Vec<Site>],
    position: &impl Fn(u32) -> Point,
    domain: &PeriodicBox<3>,
    spacing: f64,
) -> Result<Filling, String> {
    let at = |site: Site| {
        let here = position(site.id);
        match site.image {
            [0, 0, 0] => here,
            image => add(here, domain.shift(image)),
        }
    };
    if sides.len() == 3 && sides.iter().all(|nodes| nodes.len() == 2) {
        return Ok(Filling {
            inside: Vec::new(),
            triangles: vec![[0, 1, 2].map(|e| Corner::Edge(sides[e][0]))],
        });
    }
    let length = |e: usize| norm(sub(at(sides[e][sides[e].len() - 1]), at(sides[e][0])));
    let most = (0..sides.len()).map(length).fold(0.0, f64::max);
    // Of several equally long ones the first, whatever their rounding.
    let longest = (0..sides.len()).find(|e| length(*e) >= (1.0 - ROUNDING) * most);
    let longest = longest.ok_or("it has no edges")?;
    let origin = at(sides[longest][0]);
    let direction = sub(at(sides[longest][sides[longest].len() - 1]), origin);
    let plane = Plane::along(direction, origin, patch.normal);
    let flat = |site: Site| plane.foot(at(site));
    if let Some(filling) = rectangle(sides, longest, &flat, &plane, spacing) {
        return Ok(filling.numbered());
    }

    let mut number: HashMap<Site, usize> = HashMap::new();
    let mut sites = Vec::new();
    let mut edges = Vec::new();
    for side in sides {
        let mut node = |site: &Site| {
            *number.entry(*site).or_insert_with(|| {
                sites.push(*site);
                sites.len() - 1
            })
        };
        let nodes: Vec<usize> = side.iter().map(&mut node).collect();
        edges.extend(nodes.windows(2).map(|pair| [pair[0], pair[1]]));
    }
    let mut points: Vec<[f64; 2]> = sites.iter().map(|s| flat(*s)).collect();
    let lines: Vec<_> = edges.iter().map(|e| e.map(|v| points[v])).collect();
    let lattice = lattice(&points, length(longest), spacing);
    let inside = lattice.inside(&lines, CLEARANCE * spacing);
    points.extend(inside.iter().map(|index| lattice.point(*index)));

    let mut triangles = triangulate(&points, &edges, spacing)?;
    lattice.align_diagonals(&mut triangles, &points);
    sort_by_tile(&mut triangles, &points, &lattice);
    check_area(&triangles, &points, &lines)?;
    let corner = |v: usize| match sites.get(v) {
        Some(site) => Corner::Edge(*site),
        None => Corner::Inside((v - sites.len()) as u32),
    };
    let new = points[sites.len()..].iter();
    let filling = Filling {
        inside: new.map(|x| plane.place(*x)).collect(),
        triangles: triangles.iter().map(|t| t.map(corner)).collect(),
    };
    Ok(filling.numbered())
}

/// The lattice along the longest edge, which goes from the origin along the first axis.
fn lattice(points: &[[f64; 2]], longest: f64, spacing: f64) -> Lattice {
    let step = |length: f64| length / (length / spacing).round().max(1.0);
    let heights = || points.iter().map(|p| p[1]);
    let (low, high) = heights().fold((0.0, 0.0), |(l, h): (f64, f64), y| (l.min(y), h.max(y)));
    let based = low > -ROUNDING * longest;
    let across = if based { step(high) } else { spacing };
    Lattice {
        steps: [step(longest), if across > 0.0 { across } else { spacing }],
    }
}

/// Constrained Delaunay triangles inside the directed edges, by winding number.
fn triangulate(
    points: &[[f64; 2]],
    edges: &[[usize; 2]],
    spacing: f64,
) -> Result<Vec<[usize; 3]>, String> {
    // Rounding far below the spacing would be too small for the exact predicates.
    let scaled = |x: f64| {
        let x = x / spacing;
        if x.abs() < 1e-30 { 0.0 } else { x }
    };
    let vertex = |p: &[f64; 2]| Point2::new(scaled(p[0]), scaled(p[1]));
    let vertices = points.iter().map(vertex);
    let mut conflicts = 0;
    let mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
        vertices.collect(),
        edges.to_vec(),
        |_| conflicts += 1,
    )
    .map_err(|e| e.to_string())?;
    if conflicts > 0 {
        return Err(format!("{conflicts} of its edges cross others"));
    }
    if mesh.num_vertices() != points.len() {
        return Err("two of its corners are at one place".into());
    }
    // Net number of times an edge is travelled from its lower to its higher end.
    let mut travelled: HashMap<[usize; 2], i32> = HashMap::new();
    for &[a, b] in edges {
        let step = if a < b { 1 } else { -1 };
        *travelled.entry([a.min(b), a.max(b)]).or_default() += step;
    }
    let times = |a: usize, b: usize| {
        let net = travelled.get(&[a.min(b), a.max(b)]).copied().unwrap_or(0);
        if a < b { net } else { -net }
    };
    // From the outside inwards; left of an edge of the boundary it winds once more than right.
    let mut winding: Vec<Option<i32>> = vec![None; mesh.num_all_faces()];
    let outer = mesh.outer_face().fix();
    winding[outer.index()] = Some(0);
    let mut front = Vec::new();
    for edge in mesh.directed_edges().filter(|e| e.face().is_outer()) {
        front.push((edge.rev().fix(), 0));
    }
    while let Some((edge, right)) = front.pop() {
        let edge = mesh.directed_edge(edge);
        let here = edge.face().fix().index();
        if winding[here].is_some() {
            continue;
        }
        let [a, b] = [edge.from(), edge.to()].map(|v| v.fix().index());
        let left = right + times(a, b);
        winding[here] = Some(left);
        if let Some(face) = edge.face().as_inner() {
            front.extend(face.adjacent_edges().map(|e| (e.rev().fix(), left)));
        }
    }
    let inside = mesh.inner_faces().filter(|face| {
        let times = winding[face.fix().index()];
        times.is_some_and(|n| n != 0)
    });
    let corners = inside.map(|face| face.vertices().map(|v| v.fix().index()));
    Ok(corners.collect())
}

/// Cells along each side of a tile. Triangles of a tile follow each other, so that those that are seen together mostly are
/// together, in memory and in vectors.
const TILE: usize = 2;

/// Tile by tile, row by row within each.
fn sort_by_tile(triangles: &mut [[usize; 3]], points: &[[f64; 2]], lattice: &Lattice) {
    triangles.sort_by_cached_key(|corners| {
        let cell = [1, 0].map(|k: usize| {
            let middle = corners.iter().map(|c| points[*c][k]).sum::<f64>() / 3.0;
            (middle / lattice.steps[k]).floor() as i64
        });
        [cell.map(|c| c.div_euclid(TILE as i64)), cell]
    });
}

fn check_area(
    triangles: &[[usize; 3]],
    points: &[[f64; 2]],
    edges: &[[[f64; 2]; 2]],
) -> Result<(), String> {
    let double = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| perp(sub(b, a), sub(c, a));
    let own = |t: &[usize; 3]| double(points[t[0]], points[t[1]], points[t[2]]);
    let filled: f64 = triangles.iter().map(own).sum();
    let origin = points[0];
    let whole: f64 = edges.iter().map(|[a, b]| double(origin, *a, *b)).sum();
    if (filled - whole).abs() <= ROUNDING * whole.abs() {
        return Ok(());
    }
    let [filled, whole] = [0.5 * filled, 0.5 * whole];
    Err(format!("its triangles cover {filled} m² of {whole} m²"))
}

/// A rectangle whose sides are cut into equal parts gets a lattice that meets all their nodes, and is its own mirror image
/// both ways: diagonals point away from the middle, and cells in the middle of three or more, if odd, are cut into four. A
/// strip of one cell is so along its length only.
///
/// `first` is the side along the first axis from the origin.
fn rectangle(
    sides: &[Vec<Site>],
    first: usize,
    flat: &impl Fn(Site) -> [f64; 2],
    plane: &Plane,
    spacing: f64,
) -> Option<Filling> {
    if sides.len() != 4 {
        return None;
    }
    let side = |k: usize| &sides[(first + k) % 4];
    let (m, n) = (side(0).len() - 1, side(1).len() - 1);
    if side(2).len() - 1 != m || side(3).len() - 1 != n {
        return None;
    }
    let [width, height] = flat(side(2)[0]);
    let lattice = Lattice {
        steps: [width / m as f64, height / n as f64],
    };
    let index = |k: usize, i: usize| match k {
        0 => [i, 0],
        1 => [m, i],
        2 => [m - i, n],
        _ => [0, n - i],
    };
    for k in 0..4 {
        for (i, site) in side(k).iter().enumerate() {
            let x = lattice.point(index(k, i).map(|i| i as i64));
            let p = flat(*site);
            if (p[0] - x[0]).hypot(p[1] - x[1]) > 4.0 * SAME_PLACE * spacing {
                return None;
            }
        }
    }
    let corner = |i: usize, j: usize| match (i, j) {
        (i, 0) => Corner::Edge(side(0)[i]),
        (i, j) if i == m => Corner::Edge(side(1)[j]),
        (i, j) if j == n => Corner::Edge(side(2)[m - i]),
        (0, j) => Corner::Edge(side(3)[n - j]),
        (i, j) => Corner::Inside(((j - 1) * (m - 1) + i - 1) as u32),
    };
    let mut filling = Filling::default();
    for j in 1..n {
        for i in 1..m {
            let x = lattice.point([i as i64, j as i64]);
            filling.inside.push(plane.place(x));
        }
    }
    let side_of = |k: usize, all: usize| match all {
        1 => Less,
        _ => (2 * k + 1).cmp(&all),
    };
    let tile = |from: usize, all: usize| from..all.min(from + TILE);
    let rows = (0..n).step_by(TILE);
    for (low, left) in rows.flat_map(|j| (0..m).step_by(TILE).map(move |i| (j, i))) {
        for j in tile(low, n) {
            for i in tile(left, m) {
                let [a, b] = [corner(i, j), corner(i + 1, j)];
                let [c, d] = [corner(i + 1, j + 1), corner(i, j + 1)];
                match (side_of(i, m), side_of(j, n)) {
                    (Equal, _) | (_, Equal) => {
                        let e = Corner::Inside(filling.inside.len() as u32);
                        let [s, t] = lattice.steps;
                        let x = [(i as f64 + 0.5) * s, (j as f64 + 0.5) * t];
                        filling.inside.push(plane.place(x));
                        let parts = [[a, b, e], [b, c, e], [c, d, e], [d, a, e]];
                        filling.triangles.extend(parts);
                    }
                    (across, up) if across == up => {
                        filling.triangles.extend([[a, b, c], [a, c, d]]);
                    }
                    _ => filling.triangles.extend([[a, b, d], [b, c, d]]),
                }
            }
        }
    }
    Some(filling)
}
