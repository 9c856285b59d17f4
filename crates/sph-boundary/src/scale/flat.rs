//! s next to a flat wall, and flat faces of walls whose scales multiply.

use sph_core::Vect;
use sph_kernels::{Kernel, gauss_points};
use sph_neighbours::Domain;

use crate::{Element, WallMesh};

/// Distance at which ln s is cut, over h: it is 4·10⁻⁵ there.
pub(crate) const REACH: f64 = 3.0;
/// From where on it is faded out, over h.
const FADES: f64 = 2.5;
const CELLS: usize = 768;
/// Panels of the half line per h.
const PANELS: usize = 10;
/// Panels of an integral along or across the wall.
const ACROSS: usize = 10;
/// Distance from which s is 1, over the support.
const END: f64 = 5.0;
/// Sweeps of the iteration, in each of which the error is halved at least.
const SWEEPS: usize = 60;

/// ln s of a flat wall over the distance, in units of h.
///
/// s(x) ∫_0^∞ s(y) w₁(x − y) dy = 1, w₁ the kernel integrated along the wall. Solved by s ← √(s/∫ s w₁) on Gauss points;
/// kept as a cubic Hermite table, whose slope is the derivative of the table itself. s(0) = √e for any kernel and dimension.
/// Ours.
#[derive(Debug)]
pub(crate) struct PlaneScale {
    /// ln s and its slope at the ends of the cells.
    table: Vec<[f64; 2]>,
}

impl PlaneScale {
    pub fn new(kernel: &dyn Kernel, dimension: usize) -> Self {
        let line = AlongWall {
            sampler: kernel.sampler(dimension, 1.0),
            support: kernel.support(),
        };
        let panels = (END * line.support * PANELS as f64).ceil() as usize;
        let nodes: Vec<[f64; 2]> = gauss_points(0.0, END * line.support, panels).collect();
        let end = END * line.support;
        let row = |[x, _]: &[f64; 2]| -> Vec<(usize, f64)> {
            let near = nodes.iter().enumerate();
            let near = near.filter(|(_, [y, _])| (x - y).abs() < line.support);
            near.map(|(k, [y, w])| (k, w * line.at(x - y)[0])).collect()
        };
        let rows: Vec<Vec<(usize, f64)>> = nodes.iter().map(row).collect();
        let beyond: Vec<f64> = nodes.iter().map(|[x, _]| line.beyond(end - x)).collect();
        let mut s = vec![1.0; nodes.len()];
        for _ in 0..SWEEPS {
            let sum = |row: &Vec<(usize, f64)>| row.iter().map(|(k, w)| w * s[*k]).sum::<f64>();
            let next = rows.iter().zip(&beyond).zip(&s);
            let next = next.map(|((row, rest), s)| (s / (sum(row) + rest)).sqrt());
            s = next.collect();
        }
        let at = |k: usize| {
            let x = k as f64 * REACH / CELLS as f64;
            let sums = nodes.iter().zip(&s).fold([0.0; 2], |sum, ([y, w], s)| {
                let [value, slope] = line.at(x - y);
                [sum[0] + w * s * value, sum[1] + w * s * slope]
            });
            let rest = line.beyond(end - x);
            faded(x, [-(sums[0] + rest).ln(), -sums[1] / (sums[0] + rest)])
        };
        PlaneScale {
            table: (0..=CELLS).map(at).collect(),
        }
    }

    /// ln s and its slope at a distance, both in units of h; straight on behind the wall.
    pub fn at(&self, distance: f64) -> [f64; 2] {
        if distance <= 0.0 {
            let [value, slope] = self.table[0];
            return [value + slope * distance, slope];
        }
        let width = REACH / CELLS as f64;
        let place = distance / width;
        let cell = place as usize;
        if cell >= CELLS {
            return [0.0; 2];
        }
        let t = place - cell as f64;
        let ([a, da], [b, db]) = (self.table[cell], self.table[cell + 1]);
        let (da, db) = (da * width, db * width);
        let (c2, c3) = (3.0 * (b - a) - 2.0 * da - db, 2.0 * (a - b) + da + db);
        let slope = (da + t * (2.0 * c2 + 3.0 * t * c3)) / width;
        [a + t * (da + t * (c2 + t * c3)), slope]
    }
}

/// A value and its slope, faded out before [`REACH`].
fn faded(x: f64, [value, slope]: [f64; 2]) -> [f64; 2] {
    let [share, change] = fade((x - FADES) / (REACH - FADES));
    let change = change / (REACH - FADES);
    [value * share, slope * share + value * change]
}

/// 1 up to 0 and 0 from 1 on, twice differentiable between, and its slope.
pub(crate) fn fade(t: f64) -> [f64; 2] {
    let t = t.clamp(0.0, 1.0);
    let share = 1.0 - t * t * t * (10.0 + t * (6.0 * t - 15.0));
    [share, -30.0 * t * t * (1.0 - t) * (1.0 - t)]
}

/// A kernel of h = 1 integrated along a flat wall.
struct AlongWall {
    sampler: Box<dyn sph_kernels::Sampler>,
    support: f64,
}

impl AlongWall {
    /// w₁ and its slope at a distance from the plane of integration.
    fn at(&self, u: f64) -> [f64; 2] {
        let square = self.support * self.support - u * u;
        if square <= 0.0 {
            return [0.0; 2];
        }
        let one = |[t, weight]: [f64; 2]| {
            let around = match self.sampler.dimension() {
                2 => 2.0,
                _ => std::f64::consts::TAU * t,
            };
            let (w, factor) = self.sampler.at((u * u + t * t).sqrt());
            let share = weight * around;
            [share * w, share * factor * u]
        };
        let parts = gauss_points(0.0, square.sqrt(), ACROSS).map(one);
        parts.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
    }

    /// ∫ w₁ from a distance on.
    fn beyond(&self, from: f64) -> f64 {
        if from >= self.support {
            return 0.0;
        }
        let points = gauss_points(from, self.support, ACROSS);
        points.map(|[u, w]| w * self.at(u)[0]).sum()
    }
}

/// Cosine of the angle between normals up to which faces are square to each other.
const SQUARE: f64 = 1e-6;
/// Length over which the scale of a face goes on beyond its end, over h.
const BEYOND: f64 = 1.0;

/// A flat face, in the place where it was drawn.
#[derive(Clone, Debug)]
pub(crate) struct FlatFace<const D: usize> {
    /// Unit normal into the fluid.
    pub normal: Vect<D>,
    /// A place on it, m.
    pub place: Vect<D>,
    /// Area, m^(D−1).
    pub measure: f64,
    /// Its walls, ascending.
    pub walls: Vec<u32>,
    /// Directions along it, with half its length there, m; infinite where it goes on through a period.
    spans: Vec<(Vect<D>, f64)>,
}

impl<const D: usize> FlatFace<D> {
    fn has(&self, element: &Element<D>, size: f64) -> bool {
        let same = (Vect::from(element.normal) - self.normal).norm() < SQUARE;
        let apart = Vect::from(element.centre) - self.place;
        same && apart.dot(&self.normal).abs() < SQUARE * size
    }

    /// ln s of it alone, and its gradient, 1/m, at a place relative to its own; beyond its ends it fades out.
    pub fn at(&self, apart: &Vect<D>, plane: &PlaneScale, h: f64) -> Option<(f64, Vect<D>)> {
        let height = apart.dot(&self.normal);
        if height >= REACH * h {
            return None;
        }
        let [mut value, slope] = plane.at(height / h);
        let mut gradient = self.normal * (slope / h);
        for (along, half) in &self.spans {
            let way = apart.dot(along);
            let beyond = (way.abs() - half) / (BEYOND * h);
            if beyond >= 1.0 {
                return None;
            }
            if beyond > 0.0 {
                let [share, change] = fade(beyond);
                let change = change / (BEYOND * h) * way.signum();
                gradient = gradient * share + along * (value * change);
                value *= share;
            }
        }
        Some((value, gradient))
    }
}

/// The faces of a mesh whose scales multiply: all of the mesh is on the fluid's side of each, and any two are square to each
/// other or face each other. Largest first; and which elements are on none of them.
pub(crate) fn flat_faces<const D: usize, M: WallMesh<D>>(
    mesh: &M,
    domain: &Domain<D>,
    size: f64,
) -> (Vec<FlatFace<D>>, Vec<bool>) {
    let nodes = mesh.places();
    let elements = mesh.elements();
    let mut faces: Vec<FlatFace<D>> = Vec::new();
    let mut face_of: Vec<usize> = Vec::with_capacity(elements.len());
    for element in elements {
        // Neighbours in a mesh are on the same face more often than not.
        let known = faces.iter().rposition(|face| face.has(element, size));
        let face = known.unwrap_or_else(|| {
            faces.push(FlatFace {
                normal: element.normal.into(),
                place: element.centre.into(),
                measure: 0.0,
                walls: Vec::new(),
                spans: Vec::new(),
            });
            faces.len() - 1
        });
        faces[face].measure += element.measure;
        if let Err(place) = faces[face].walls.binary_search(&(element.wall as u32)) {
            faces[face].walls.insert(place, element.wall as u32);
        }
        face_of.push(face);
        if faces.len() > MOST {
            break;
        }
    }
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by(|a, b| faces[*b].measure.total_cmp(&faces[*a].measure));
    let mut chosen: Vec<usize> = Vec::new();
    for face in order.into_iter().filter(|_| faces.len() <= MOST) {
        let own = &faces[face];
        let square = |other: &usize| {
            let cosine = own.normal.dot(&faces[*other].normal);
            let apart = own.normal.dot(&(faces[*other].place - own.place));
            cosine.abs() < SQUARE || (cosine < SQUARE - 1.0 && apart > SQUARE * size)
        };
        let before = |x: &Vect<D>| own.normal.dot(&(x - own.place)) >= -SQUARE * size;
        if chosen.iter().all(square) && nodes.iter().all(before) {
            chosen.push(face);
        }
    }
    let on_none = match faces.len() <= MOST {
        true => face_of.iter().map(|f| !chosen.contains(f)).collect(),
        false => vec![true; elements.len()],
    };
    let found = chosen.iter().map(|face| {
        let own = elements.iter().zip(&face_of).filter(|(_, f)| *f == face);
        let corners = own.flat_map(|(e, _)| unrolled(e, &nodes, domain));
        spanned(faces[*face].clone(), &corners.collect::<Vec<_>>(), domain)
    });
    (found.collect(), on_none)
}

/// Faces beyond which a mesh is curved.
const MOST: usize = 400;

/// Corners of an element, m. It may go on beyond a periodic border, where its node is that of the other side.
pub(crate) fn unrolled<const D: usize>(
    element: &Element<D>,
    nodes: &[Vect<D>],
    domain: &Domain<D>,
) -> [Vect<D>; D] {
    let centre = Vect::from(element.centre);
    let place = |n: usize| centre + domain.nearest(nodes[n] - centre);
    element.nodes.map(place)
}

/// A face with its place in the middle of its corners, and its spans.
fn spanned<const D: usize>(
    mut face: FlatFace<D>,
    corners: &[Vect<D>],
    domain: &Domain<D>,
) -> FlatFace<D> {
    let mut spans: Vec<Vect<D>> = Vec::new();
    // The axes that are flattest on it first.
    let mut axes: Vec<usize> = (0..D).collect();
    axes.sort_by(|a, b| face.normal[*a].abs().total_cmp(&face.normal[*b].abs()));
    for axis in axes {
        let mut along = Vect::<D>::from_fn(|k, _| f64::from(u8::from(k == axis)));
        along -= face.normal * face.normal[axis];
        for other in &spans {
            along -= other * other.dot(&along);
        }
        if spans.len() + 1 < D && along.norm() > SQUARE {
            spans.push(along.normalize());
        }
    }
    let from = face.place;
    for along in spans {
        let ways = || corners.iter().map(|c| (c - from).dot(&along));
        let low = ways().fold(f64::INFINITY, f64::min);
        let high = ways().fold(f64::NEG_INFINITY, f64::max);
        let mut period = (0..D).filter(|k| domain.periodic[*k] && along[*k].abs() > 1.0 - SQUARE);
        let half = match period.any(|k| high - low > domain.length(k) * (1.0 - SQUARE)) {
            true => f64::INFINITY,
            false => 0.5 * (high - low),
        };
        face.place += along * (0.5 * (low + high));
        face.spans.push((along, half));
    }
    face
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernel's shape does not matter: moving the wall leaves ½ of the work that the fluid does on itself.
    #[test]
    fn the_scale_at_a_flat_wall_is_the_root_of_e() {
        for kernel in sph_kernels::builtin() {
            for dimension in [2, 3] {
                let plane = PlaneScale::new(&kernel, dimension);
                let [value, _] = plane.at(0.0);
                let name = kernel.name();
                assert!((value - 0.5).abs() < 2e-6, "{name} in {dimension}: {value}");
            }
        }
    }

    /// Figures of another solver (Newton's method on other points) for Wendland's C2 kernel.
    #[test]
    fn a_table_of_another_solver_is_met() {
        let known = [
            (0.25, 1.264_272_8, 1.261_563_4),
            (0.5, 1.087_067_5, 1.082_983_7),
            (1.0, 0.989_731_8, 0.988_489_8),
            (2.0, 1.000_850_0, 1.000_826_4),
        ];
        let kernel = sph_kernels::by_name("wendland-c2").expect("a kernel");
        let [plane, space] = [2, 3].map(|d| PlaneScale::new(&kernel, d));
        for (distance, in_plane, in_space) in known {
            for (scale, expected) in [(&plane, in_plane), (&space, in_space)] {
                let off = scale.at(distance)[0].exp() - expected;
                assert!(off.abs() < 1e-6, "{distance}: {off:e}");
            }
        }
    }

    #[test]
    fn the_slope_is_that_of_the_table() {
        let kernel = sph_kernels::by_name("wendland-c2").expect("a kernel");
        let plane = PlaneScale::new(&kernel, 2);
        for k in 1..60 {
            let (x, e) = (0.0501 * f64::from(k), 1e-6);
            let slope = (plane.at(x + e)[0] - plane.at(x - e)[0]) / (2.0 * e);
            assert!((slope - plane.at(x)[1]).abs() < 1e-8, "{x}");
        }
    }
}
