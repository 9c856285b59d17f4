//! Predicates of side and conflict: exact signs of determinants, ties broken by numbers.
//!
//! A vertex is a ray of five homogeneous, lifted coordinates (x, y, z, l, h):
//!
//! ```text
//! sphere     (x, |x|² − R², 1)          wall n · x = c     (−n, −2c, 0)
//! ```
//!
//! and the vertex behind the hull, in triangulations without walls, is (0, 0, 0, 1, 0). Cells are the
//! facets of the cone of all rays that are seen from below; O = det(x, y, z, h) of four rays orients a
//! cell, D = det(x, y, z, l, h) of a cell and a fifth ray decides conflict. Moving the origin to a
//! centre x₀ adds −2 x₀·x + |x₀|² h to l, which leaves both unchanged, and makes numbers small.
//!
//! D = 0 is decided as if l of ray i were greater by εⁱ, i its number: the sign is that of the first
//! cofactor of l that is not zero. Sources: Edelsbrunner & Mücke 1990; Devillers & Teillaud 2011.

use std::cmp::Ordering;

use robust::{Coord3D, orient3d};

use crate::triangulation::expansion::Expansion;
use crate::triangulation::{Sphere, Wall};

/// Behind the hull.
pub const GHOST: u32 = u32::MAX;

/// Half a unit in the last place of 1.
const ROUNDING: f64 = f64::EPSILON / 2.0;
/// Bounds on the error of the determinants below, in terms of the sum of the absolute values of their
/// products. A difference costs 1 rounding, a lifted coordinate at most 8, a product of three 2, sums 5:
/// 22 in all for the largest; the rest is margin for terms of second order.
const FLAT: f64 = 16.0 * ROUNDING;
const LIFTED: f64 = 32.0 * ROUNDING;

/// Below this, relative to the largest coordinate, numbers count as zero: products of five such would
/// leave the range of doubles.
const VANISHING: f64 = 1e-42;

/// The rays of all vertices: spheres first, then walls.
pub struct Predicates {
    /// (x, R²) of spheres, in units of a power of two, so that the largest is about 1.
    points: Vec<[f64; 4]>,
    /// (−n, −2c) of walls.
    walls: Vec<[f64; 4]>,
}

impl Predicates {
    pub fn new(spheres: &[Sphere], walls: &[Wall]) -> Self {
        let sizes = spheres.iter().map(|s| s.centre.amax().max(s.radius));
        let size = sizes.chain(walls.iter().map(|w| w.offset.abs()));
        let size = size.fold(f64::MIN_POSITIVE, f64::max);
        let unit = 2.0_f64.powi(-(size.log2().ceil() as i32).clamp(-1000, 1000));
        let cut = |x: f64| if x.abs() < VANISHING { 0.0 } else { x };
        let scaled = |x: f64| cut(x * unit);
        let point = |s: &Sphere| {
            let [x, y, z] = <[f64; 3]>::from(s.centre).map(scaled);
            let radius = s.radius * unit;
            [x, y, z, cut(radius * radius)]
        };
        let wall = |w: &Wall| {
            let [x, y, z] = <[f64; 3]>::from(w.normal).map(cut);
            [-x, -y, -z, -2.0 * scaled(w.offset)]
        };
        Self {
            points: spheres.iter().map(point).collect(),
            walls: walls.iter().map(wall).collect(),
        }
    }

    fn is_point(&self, v: u32) -> bool {
        (v as usize) < self.points.len()
    }

    fn wall(&self, v: u32) -> &[f64; 4] {
        &self.walls[v as usize - self.points.len()]
    }

    /// Sign of O of three rays and the centre `e`, in this order.
    pub fn side(&self, rays: [u32; 3], e: u32) -> Ordering {
        let o = self.points[e as usize];
        if rays.iter().all(|v| self.is_point(*v)) {
            let [a, b, c] = rays.map(|v| coord(self.points[v as usize]));
            return sign(orient3d(a, b, c, coord(o)));
        }
        let (value, size) = determinant3(&rays.map(|v| self.row(v, e)));
        if value.abs() > FLAT * size {
            return value.total_cmp(&0.0);
        }
        let rows = rays.map(|v| self.exact_row(v, e));
        exact_determinant3(rows.each_ref()).sign()
    }

    /// A ray but for l and h, with the centre `e` as the origin.
    fn row(&self, v: u32, e: u32) -> [f64; 3] {
        if !self.is_point(v) {
            let [x, y, z, _] = *self.wall(v);
            return [x, y, z];
        }
        let (p, o) = (&self.points[v as usize], &self.points[e as usize]);
        [p[0] - o[0], p[1] - o[1], p[2] - o[2]]
    }

    /// Sign of O of four rays, of which one at least is a sphere and none is the ghost.
    fn orientation(&self, rays: [u32; 4]) -> Ordering {
        let k = (0..4).rev().find(|k| self.is_point(rays[*k])).unwrap_or(3);
        let sign = self.side(except(&rays, k), rays[k]);
        if k % 2 == 1 { sign } else { sign.reverse() }
    }

    /// True if `e` lies below the facet of these rays, which are oriented so that O > 0. `None` if
    /// one of them is the ghost and `e` lies in the plane of the others.
    pub fn conflict(&self, cell: [u32; 4], e: u32) -> Option<bool> {
        if let Some(k) = cell.iter().position(|v| *v == GHOST) {
            let sign = self.side(except(&cell, k), e);
            let sign = if k % 2 == 1 { sign } else { sign.reverse() };
            return (sign != Ordering::Equal).then_some(sign == Ordering::Greater);
        }
        let (value, size) = self.lifted(cell, e);
        if value.abs() > LIFTED * size {
            return Some(value > 0.0);
        }
        let rows = cell.map(|v| self.exact_row(v, e));
        let lifts = cell.map(|v| self.exact_lift(v, e));
        Some(match exact_determinant4(&rows, &lifts).sign() {
            Ordering::Equal => self.tie(cell, e),
            sign => sign == Ordering::Greater,
        })
    }

    /// D of a cell and `e` with rounding, and the sum of the absolute values of its products.
    fn lifted(&self, cell: [u32; 4], e: u32) -> (f64, f64) {
        let o = self.points[e as usize];
        let (mut rows, mut l, mut size) = ([[0.0; 3]; 4], [0.0; 4], [0.0; 4]);
        for (i, &v) in cell.iter().enumerate() {
            rows[i] = self.row(v, e);
            if self.is_point(v) {
                let (p, d) = (&self.points[v as usize], rows[i]);
                let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                l[i] = square - (p[3] - o[3]);
                size[i] = square + p[3] + o[3];
            } else {
                let w = self.wall(v);
                let dot = w[0] * o[0] + w[1] * o[1] + w[2] * o[2];
                let all = (w[0] * o[0]).abs() + (w[1] * o[1]).abs() + (w[2] * o[2]).abs();
                l[i] = w[3] - 2.0 * dot;
                size[i] = w[3].abs() + 2.0 * all;
            }
        }
        let (mut value, mut total) = (0.0, 0.0);
        for i in 0..4 {
            let (minor, bound) = determinant3(&except(&rows, i));
            value += if i % 2 == 1 { l[i] } else { -l[i] } * minor;
            total += size[i] * bound;
        }
        (value, total)
    }

    fn exact_row(&self, v: u32, e: u32) -> [Expansion; 3] {
        let o = &self.points[e as usize];
        std::array::from_fn(|k| match self.is_point(v) {
            true => Expansion::difference(self.points[v as usize][k], o[k]),
            false => Expansion::new(self.wall(v)[k]),
        })
    }

    fn exact_lift(&self, v: u32, e: u32) -> Expansion {
        let o = &self.points[e as usize];
        if self.is_point(v) {
            let weight = Expansion::difference(o[3], self.points[v as usize][3]);
            let row = self.exact_row(v, e);
            row.iter().fold(weight, |sum, d| sum.plus(&d.times(d)))
        } else {
            let w = self.wall(v);
            (0..3).fold(Expansion::new(w[3]), |sum, k| {
                sum.minus(&Expansion::product(2.0 * w[k], o[k]))
            })
        }
    }

    /// Conflict where D = 0.
    fn tie(&self, cell: [u32; 4], e: u32) -> bool {
        let rays = [cell[0], cell[1], cell[2], cell[3], e];
        let mut order = [0, 1, 2, 3, 4];
        order.sort_by_key(|i| rays[*i]);
        for i in order {
            let sign = self.orientation(except(&rays, i));
            if sign != Ordering::Equal {
                // The cofactor of l of ray i in column 3 has the sign (−1)^(i + 3).
                return (sign == Ordering::Greater) == (i % 2 == 1);
            }
        }
        // The cofactor of e is that of the cell's orientation, which is never zero.
        false
    }

    /// Sign of det(x, y, z) of three walls, counted among walls.
    pub fn walls_orientation(&self, walls: [usize; 3]) -> Ordering {
        exact_determinant3(walls.map(|w| self.exact_wall(w)).each_ref()).sign()
    }

    /// Sign of det(x, y, z, l) of four walls, counted among walls.
    pub fn walls_lifted(&self, walls: [usize; 4]) -> Ordering {
        let lifts = walls.map(|w| Expansion::new(self.walls[w][3]));
        exact_determinant4(&walls.map(|w| self.exact_wall(w)), &lifts).sign()
    }

    fn exact_wall(&self, w: usize) -> [Expansion; 3] {
        std::array::from_fn(|k| Expansion::new(self.walls[w][k]))
    }
}

/// −0.0 is zero too, which `total_cmp` alone would deny.
fn sign(x: f64) -> Ordering {
    (x + 0.0).total_cmp(&0.0)
}

fn coord([x, y, z, _]: [f64; 4]) -> Coord3D<f64> {
    Coord3D { x, y, z }
}

/// Determinant and the sum of the absolute values of its products.
fn determinant3(r: &[[f64; 3]; 3]) -> (f64, f64) {
    let (mut value, mut size) = (0.0, 0.0);
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let (p, q) = (r[j][0] * r[k][1], r[k][0] * r[j][1]);
        value += r[i][2] * (p - q);
        size += r[i][2].abs() * (p.abs() + q.abs());
    }
    (value, size)
}

fn exact_determinant3(r: [&[Expansion; 3]; 3]) -> Expansion {
    let m = |i: usize, j: usize, k: usize| {
        let minor = r[j][0].times(&r[k][1]).minus(&r[k][0].times(&r[j][1]));
        r[i][2].times(&minor)
    };
    m(0, 1, 2).plus(&m(1, 2, 0)).plus(&m(2, 0, 1))
}

/// det of rows (x, y, z, l), expanded along l.
fn exact_determinant4(r: &[[Expansion; 3]; 4], l: &[Expansion; 4]) -> Expansion {
    (0..4).fold(Expansion::default(), |sum, i| {
        let rows: [&[Expansion; 3]; 3] = except(&r.each_ref(), i);
        let term = l[i].times(&exact_determinant3(rows));
        if i % 2 == 1 {
            sum.plus(&term)
        } else {
            sum.minus(&term)
        }
    })
}

/// A list except the value at place `i`.
pub(crate) fn except<T: Copy, const N: usize, const M: usize>(all: &[T; N], i: usize) -> [T; M] {
    std::array::from_fn(|k| all[if k < i { k } else { k + 1 }])
}
