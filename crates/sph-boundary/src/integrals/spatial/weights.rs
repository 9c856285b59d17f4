//! ∫ w dS over many triangles of one plane, side by side.

use sph_kernels::lanes::{Body, Lane, MOST, dispatch};

use super::Renormalisation3d;
use super::plane::{Circle, Foot, Patch};
use super::weight::{POINTS, Rule, SquaredDistances, is_far, mean_of_six, six};

/// The triangles of a plane that a point sees, and their weights; buffers for reuse.
#[derive(Debug, Default)]
pub struct Weights {
    near: Vec<u32>,
    /// Areas, then weights.
    weights: Vec<f64>,
    /// Squared distances of the points, m²: those of as many triangles as there are lanes point by point, then the next.
    squares: Vec<f64>,
    /// w there, 1/m³.
    values: Vec<f64>,
}

impl Weights {
    /// Keeps the triangles whose circle meets the disc of the plane within the support; whether there are any.
    #[inline]
    pub(crate) fn find(
        &mut self,
        triangles: impl ExactSizeIterator<Item = u32>,
        circles: &[Circle],
        foot: &Foot,
    ) -> bool {
        self.near.clear();
        self.near.resize(triangles.len(), 0);
        let near = &mut self.near[..];
        let mut n = 0;
        for triangle in triangles {
            near[n] = triangle;
            n += usize::from(circles[triangle as usize].meets(foot));
        }
        self.near.truncate(n);
        n > 0
    }

    /// The triangle that was found whose middle is nearest to the foot.
    pub(crate) fn nearest(&self, circles: &[Circle], foot: &Foot) -> u32 {
        let square = |t: &u32| circles[*t as usize].square(foot);
        let nearest = self
            .near
            .iter()
            .min_by(|a, b| square(a).total_cmp(&square(b)));
        nearest.copied().unwrap_or_default()
    }

    /// Weighs the triangles that were found, 1/m: each as [`Renormalisation3d::weight`] does.
    pub(crate) fn weigh(&mut self, of: &Renormalisation3d, patches: &[Patch], foot: &Foot) {
        let n = self.near.len();
        let room = n.next_multiple_of(MOST);
        if self.weights.len() < room {
            let room = room.next_power_of_two();
            self.weights.resize(room, 0.0);
            self.squares.resize(POINTS * room, 0.0);
            self.values.resize(POINTS * room, 0.0);
        }
        let near = &self.near[..];
        let (weights, squares) = (&mut self.weights[..], &mut self.squares[..]);
        let (used, all_far) = dispatch(Squares {
            near,
            patches,
            foot,
            per_h2: of.per_h * of.per_h,
            areas: weights,
            squares,
        });
        let values = &mut self.values[..POINTS * used];
        of.kernel.value(&self.squares[..POINTS * used], values);
        dispatch(Means { values, weights });
        if all_far {
            return;
        }
        for (&triangle, weight) in near.iter().zip(weights) {
            let patch = &patches[triangle as usize];
            match of.rule(patch.distance2(foot), patch.area) {
                Rule::Six => {}
                Rule::Twelve => {
                    *weight = patch.area * of.mean_of_twelve(&patch.squared_distances(foot))
                }
                Rule::Exact => {
                    *weight = of.triangle(patch.corners(foot), [0.0, 0.0, 1.0]).kernel;
                }
            }
        }
    }

    /// The triangles that were found with their weights, 1/m.
    pub(crate) fn all(&self) -> (&[u32], &[f64]) {
        (&self.near, &self.weights[..self.near.len()])
    }
}

/// Areas, and squared distances of the six points of every triangle, m².
struct Squares<'a> {
    near: &'a [u32],
    patches: &'a [Patch],
    foot: &'a Foot,
    per_h2: f64,
    areas: &'a mut [f64],
    squares: &'a mut [f64],
}

impl Body for Squares<'_> {
    /// Number of lanes filled, the last ones repeatedly with the last triangle; true if six points are enough for all.
    type Output = (usize, bool);

    #[inline(always)]
    fn call<L: Lane>(self) -> (usize, bool) {
        let [x, y] = self.foot.place;
        let (x, y) = (L::splat(x), L::splat(y));
        let height2 = L::splat(self.foot.height * self.foot.height);
        let (mut used, mut all_far) = (0, true);
        let out = self.areas.chunks_exact_mut(L::N);
        let out = out.zip(self.squares.chunks_exact_mut(POINTS * L::N));
        for (near, (areas, squares)) in self.near.chunks(L::N).zip(out) {
            let zero = L::splat(0.0);
            let (mut centre, mut arms) = ([zero; 2], [[zero; 2]; 2]);
            let (mut sizes, mut area) = ([zero; 3], zero);
            for lane in 0..L::N {
                let patch = &self.patches[near[lane.min(near.len() - 1)] as usize];
                for k in 0..2 {
                    centre[k].set(lane, patch.centre[k]);
                    arms[0][k].set(lane, patch.arms[0][k]);
                    arms[1][k].set(lane, patch.arms[1][k]);
                }
                for (size, square) in sizes.iter_mut().zip(patch.squares) {
                    size.set(lane, square);
                }
                area.set(lane, patch.area);
            }
            let (x, y) = (centre[0] - x, centre[1] - y);
            let distance2 = x * x + y * y + height2;
            let two = L::splat(2.0);
            let first = two * (x * arms[0][0] + y * arms[0][1]);
            let second = two * (x * arms[1][0] + y * arms[1][1]);
            let slopes = [first, second, -(first + second)];
            let six = six(distance2, slopes, sizes);
            for k in 0..POINTS {
                six[k].store(&mut squares[k * L::N..]);
            }
            area.store(areas);
            all_far &= is_far(distance2, area, self.per_h2);
            used += L::N;
        }
        (used, all_far)
    }
}

/// Areas times means of w at the six points.
struct Means<'a> {
    values: &'a [f64],
    weights: &'a mut [f64],
}

impl Body for Means<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let values = self.values.chunks_exact(POINTS * L::N);
        for (w, weights) in values.zip(self.weights.chunks_exact_mut(L::N)) {
            let mut at = [L::splat(0.0); POINTS];
            for k in 0..POINTS {
                at[k] = L::load(&w[k * L::N..]);
            }
            (L::load(weights) * mean_of_six(at)).store(weights);
        }
    }
}

impl Patch {
    /// Squared distance of the centre from the point over the foot, m².
    #[inline(always)]
    fn distance2(&self, foot: &Foot) -> f64 {
        let [x, y] = self.from(foot);
        x * x + y * y + foot.height * foot.height
    }

    #[inline(always)]
    fn squared_distances(&self, foot: &Foot) -> SquaredDistances {
        let ([x, y], [a, b]) = (self.from(foot), self.arms);
        let first = 2.0 * (x * a[0] + y * a[1]);
        let second = 2.0 * (x * b[0] + y * b[1]);
        SquaredDistances {
            centre: self.distance2(foot),
            slopes: [first, second, -(first + second)],
            arms: self.squares,
        }
    }

    /// Corners relative to the point over the foot, m, with the plane's normal along the third axis.
    fn corners(&self, foot: &Foot) -> [[f64; 3]; 3] {
        let ([x, y], [a, b]) = (self.from(foot), self.arms);
        let at = |arm: [f64; 2]| [x + arm[0], y + arm[1], -foot.height];
        [at(a), at(b), at([-(a[0] + b[0]), -(a[1] + b[1])])]
    }
}

#[cfg(test)]
mod tests {
    use super::super::plane::Plane;
    use super::*;
    use crate::geometry::vector::{along, cross, dot};

    #[test]
    fn a_triangle_of_a_plane_weighs_the_same_however_it_is_seen() {
        let kernel = sph_kernels::wendland_c2();
        let of =
            Renormalisation3d::new(sph_kernels::Kernel::polynomial(&kernel).expect("one"), 1.0);
        let of = of.expect("a kernel");
        let corners = [[0.1, 0.2, 0.3], [0.7, 0.1, 0.4], [0.2, 0.7, 0.0]];
        let twice = cross(
            along(corners[1], -1.0, corners[0]),
            along(corners[2], -1.0, corners[0]),
        );
        let area = 0.5 * dot(twice, twice).sqrt();
        let normal = twice.map(|x| 0.5 * x / area);
        let plane = Plane::new(corners[2], normal);
        let (patch, circle) = Patch::new(&plane, corners, area);
        let mut weights = Weights::default();
        let mut seen = 0;
        for i in 0..400 {
            let at = |n: i32| 2.5 * (f64::from(i * n % 101) / 50.0 - 1.0);
            let point = [at(1), at(37), at(59)];
            let place = plane.foot(point);
            let height = dot(along(point, -1.0, corners[2]), normal);
            let reach = (4.0 - height * height).max(0.0).sqrt();
            let foot = Foot {
                place,
                height,
                reach,
            };
            let relative = corners.map(|c| along(c, -1.0, point));
            let alone = of.weight(relative, normal, area);
            let found = weights.find(std::iter::repeat_n(0, 3), &[circle], &foot);
            weights.weigh(&of, &[patch], &foot);
            assert!(found || alone == 0.0, "{alone}");
            for weight in weights.all().1 {
                assert!((alone - weight).abs() < 1e-12, "{alone} {weight}");
                seen += 1;
            }
        }
        assert!(seen > 100, "{seen}");
    }
}
