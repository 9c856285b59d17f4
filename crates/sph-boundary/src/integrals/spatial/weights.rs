//! ∫ w dS over many triangles of one plane, side by side.

use sph_kernels::lanes::{Body, Lane, MOST, dispatch};

use super::Renormalisation3d;
use super::weight::{POINTS, Rule, SquaredDistances, is_far, mean_of_six};
use crate::geometry::vector::Plane;

/// A triangle in the coordinates of its plane, ready to be seen from many points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    /// Mean of the corners, m.
    pub centre: [f64; 2],
    /// The first two corners from there, m; the third makes their sum vanish.
    pub arms: [[f64; 2]; 2],
    /// Squared distances of the corners from there, m².
    pub squares: [f64; 3],
    /// m².
    pub area: f64,
}

/// The circle around a triangle in the coordinates of its plane, about the mean of the corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    /// m.
    centre: [f64; 2],
    /// m.
    radius: f64,
}

impl Patch {
    /// A triangle with corners in or close to a plane, m, and its area, m²; and the circle around it.
    pub fn new(plane: &Plane, corners: [[f64; 3]; 3], area: f64) -> (Self, Circle) {
        let [a, b, c] = corners.map(|corner| plane.foot(corner));
        let centre = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        let arms = [a, b, c].map(|corner| [corner[0] - centre[0], corner[1] - centre[1]]);
        let squares = arms.map(|arm| arm[0] * arm[0] + arm[1] * arm[1]);
        let patch = Self {
            centre,
            arms: [arms[0], arms[1]],
            squares,
            area,
        };
        // Rounding loses nothing.
        let radius = squares.into_iter().fold(0.0, f64::max).sqrt() * (1.0 + 1e-9);
        (patch, Circle { centre, radius })
    }

    /// Corners relative to the point over the foot, m, with the plane's normal along the third axis.
    fn corners(&self, foot: &Foot) -> [[f64; 3]; 3] {
        let ([x, y], [a, b]) = (foot.to(self.centre), self.arms);
        let at = |arm: [f64; 2]| [x + arm[0], y + arm[1], -foot.height];
        [at(a), at(b), at([-(a[0] + b[0]), -(a[1] + b[1])])]
    }
}

impl Circle {
    /// True if it meets the disc of the plane within the support.
    #[inline(always)]
    pub fn meets(&self, foot: &Foot) -> bool {
        let [x, y] = foot.to(self.centre);
        let reach = foot.reach + self.radius;
        x * x + y * y < reach * reach
    }
}

/// Foot of a point on a plane, and the part of the plane in its sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// Coordinates of the foot of the perpendicular, m.
    pub place: [f64; 2],
    /// Signed distance from the plane, m.
    pub height: f64,
    /// Radius of the disc of the plane within the support, m.
    pub reach: f64,
}

impl Foot {
    /// A place as seen from the foot, m.
    #[inline(always)]
    pub fn to(&self, place: [f64; 2]) -> [f64; 2] {
        [place[0] - self.place[0], place[1] - self.place[1]]
    }
}

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

    /// ∫ w dS over the triangles that were found, 1/m: by quadrature where that is accurate, else exactly.
    ///
    /// For many triangles with legs of h/2 to 3h/4 of which only shares are needed, the sum being known from
    /// [`polygon`](Renormalisation3d::polygon). Six points where the centre is a leg or more away, twelve for half a
    /// leg, and the closed form below that and for triangles larger than h. Measured for right isosceles triangles with
    /// legs h/2: within 7·10⁻⁵ w(0) · area; of the triangle's own largest w · area, 10⁻⁴ (3·10⁻⁴ for Wendland C6)
    /// unless a corner is within a leg of the support's end. With legs 2h/3: within 10⁻⁴ w(0) · area for the Wendland
    /// kernels and the quintic spline, 2·10⁻⁴ for the cubic one.
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
            let (centre, height2) = (foot.to(patch.centre), foot.height * foot.height);
            let seen = SquaredDistances::new(centre, height2, patch.arms, patch.squares);
            match of.rule(seen.centre, patch.area) {
                Rule::Six => {}
                Rule::Twelve => *weight = patch.area * of.mean_of_twelve(&seen),
                Rule::Exact => {
                    *weight = of.triangle(patch.corners(foot), [0.0, 0.0, 1.0]).kernel;
                }
            }
        }
    }

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
            let seen = SquaredDistances::new([centre[0] - x, centre[1] - y], height2, arms, sizes);
            let six = seen.six();
            for k in 0..POINTS {
                six[k].store(&mut squares[k * L::N..]);
            }
            area.store(areas);
            all_far &= is_far(seen.centre, area, self.per_h2);
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

#[cfg(test)]
mod tests {
    use sph_kernels::{Kernel, builtin};

    use super::*;
    use crate::geometry::vector::{Plane, along, cross, dot, norm};

    /// Calls `found` with the distances of the corners, the weight and the integral of a right isosceles triangle in a
    /// tilted plane, from many points whose height and distance are at most `reach`.
    fn each_view(
        (of, leg, reach): (&Renormalisation3d, f64, f64),
        mut found: impl FnMut([f64; 3], f64, f64),
    ) {
        let [u, v] = [[0.48, 0.64, 0.6], [-0.8, 0.6, 0.0]].map(|x| x.map(|x| leg * x));
        let corners = [
            [0.1, 0.2, 0.3],
            along([0.1, 0.2, 0.3], 1.0, u),
            along([0.1, 0.2, 0.3], 1.0, v),
        ];
        let normal = cross(u, v).map(|x| x / (leg * leg));
        let plane = Plane::new(corners[0], normal);
        let (patch, circle) = Patch::new(&plane, corners, 0.5 * leg * leg);
        let mut weights = Weights::default();
        let centre = along(corners[0], 1.0 / 3.0, along(u, 1.0, v));
        for i in 0..20_000 {
            let at = |n: u32| reach * (f64::from(i * n % 20_011) / 10_005.5 - 1.0);
            let point = along(centre, 1.0, [at(1), at(1_237), at(17_359)]);
            let height = dot(along(point, -1.0, corners[0]), normal);
            let foot = Foot {
                place: plane.foot(point),
                height,
                reach: (of.support * of.support - height * height).max(0.0).sqrt(),
            };
            let seen = corners.map(|c| along(c, -1.0, point));
            let exact = of.triangle(seen, normal).kernel;
            if !weights.find(std::iter::repeat_n(0, 3), &[circle], &foot) {
                assert!(exact.abs() < 1e-12, "{exact}");
            }
            weights.weigh(of, &[patch], &foot);
            for weight in weights.all().1 {
                found(seen.map(norm), *weight, exact);
            }
        }
    }

    #[test]
    fn legs_of_half_h_are_weighed_to_four_digits() {
        let (leg, area) = (0.5, 0.125);
        for kernel in builtin() {
            let of = Renormalisation3d::new(kernel.shape(), 1.0).expect("a kernel");
            let w = kernel.sampler(3, 1.0);
            let (mut worst, mut own) = (0.0_f64, 0.0_f64);
            each_view((&of, leg, kernel.support()), |distances, weight, exact| {
                let error = (weight - exact).abs();
                worst = worst.max(error / (w.value_at_zero() * area));
                if distances.iter().all(|q| *q < kernel.support() - leg) {
                    let nearest = distances.into_iter().fold(f64::MAX, f64::min);
                    own = own.max(error / (w.at(nearest).0 * area));
                }
            });
            let name = kernel.name();
            println!("{name:15} {worst:.1e}, of its own {own:.1e}");
            assert!(worst < 8e-5 && own < 4e-4, "{name}: {worst:e} {own:e}");
        }
    }

    /// But for the displacement of the point in the closed form, which is along another direction in space: 10⁻¹⁰ h
    /// each, times w(0) and the perimeter.
    #[test]
    fn near_and_large_triangles_are_exact() {
        for kernel in builtin() {
            let of = Renormalisation3d::new(kernel.shape(), 1.0).expect("a kernel");
            let largest = kernel.sampler(3, 1.0).value_at_zero();
            for (leg, reach) in [(1e-3, 2e-4), (0.2, 0.04), (1.5, 1.0)] {
                let most = 2e-10 * largest * (2.0 + 2.0_f64.sqrt()) * leg;
                each_view((&of, leg, reach), |_, weight, exact| {
                    let error = (weight - exact).abs();
                    assert!(error < most, "{leg}: {weight} {exact}");
                });
            }
        }
    }
}
