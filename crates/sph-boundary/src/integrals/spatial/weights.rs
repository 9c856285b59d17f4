//! ∫ w dS over many triangles of one plane, side by side.

use sph_lanes::{Body, Lane, dispatch};

use super::Renormalisation3d;
use super::plane::{Circle, Foot, Patch};
use super::weight::{AHEAD, Rule, Seen, mean_of_six};

/// The triangles of a plane that a point sees, and what each weighs; buffers that are used again and again.
#[derive(Debug, Default)]
pub struct Weights {
    near: Vec<u32>,
    weights: Vec<f64>,
    squares: Vec<f64>,
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
        let mut n = 0;
        for triangle in triangles {
            self.near[n] = triangle;
            n += usize::from(circles[triangle as usize].meets(foot));
        }
        self.near.truncate(n);
        n > 0
    }

    /// Weighs the triangles that were found, 1/m: each as [`Renormalisation3d::weight`] does.
    pub(crate) fn weigh(&mut self, of: &Renormalisation3d, patches: &[Patch], foot: &Foot) {
        let n = self.near.len();
        let room = 6 * n + AHEAD;
        if self.squares.len() < room {
            self.squares.resize(room.next_power_of_two(), 0.0);
            self.values.resize(room.next_power_of_two(), 0.0);
        }
        dispatch(Squares {
            near: &self.near,
            patches,
            foot,
            squares: &mut self.squares[..room],
        });
        let values = &mut self.values[..6 * n];
        of.kernel.value(&self.squares[..6 * n], values);
        self.weights.clear();
        for (&triangle, w) in self.near.iter().zip(values.chunks_exact(6)) {
            let patch = &patches[triangle as usize];
            let weight = match of.rule(patch.distance2(foot), patch.area) {
                Rule::Six => patch.area * mean_of_six(w),
                Rule::Twelve => patch.area * of.mean_of_twelve(&patch.seen(foot)),
                Rule::Exact => of.triangle(patch.corners(foot), [0.0, 0.0, 1.0]).kernel,
            };
            self.weights.push(weight);
        }
    }

    /// The triangles that were found with their weights, 1/m.
    pub(crate) fn all(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.near.iter().copied().zip(self.weights.iter().copied())
    }
}

/// Squared distances of the six points of every triangle, m².
struct Squares<'a> {
    near: &'a [u32],
    patches: &'a [Patch],
    foot: &'a Foot,
    squares: &'a mut [f64],
}

impl Body for Squares<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        for (k, &triangle) in self.near.iter().enumerate() {
            let seen = self.patches[triangle as usize].seen(self.foot);
            let mut squares = [0.0; AHEAD];
            seen.six(&mut squares);
            self.squares[6 * k..6 * k + AHEAD].copy_from_slice(&squares);
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
    fn seen(&self, foot: &Foot) -> Seen {
        let ([x, y], [a, b]) = (self.from(foot), self.arms);
        let first = 2.0 * (x * a[0] + y * a[1]);
        let second = 2.0 * (x * b[0] + y * b[1]);
        Seen {
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
    use super::super::vector::{cross, dot, plus};
    use super::*;

    #[test]
    fn a_triangle_of_a_plane_weighs_the_same_however_it_is_seen() {
        let kernel = sph_kernels::wendland_c2();
        let of =
            Renormalisation3d::new(sph_kernels::Kernel::polynomial(&kernel).expect("one"), 1.0);
        let of = of.expect("a kernel");
        let corners = [[0.1, 0.2, 0.3], [0.7, 0.1, 0.4], [0.2, 0.7, 0.0]];
        let twice = cross(
            plus(corners[1], -1.0, corners[0]),
            plus(corners[2], -1.0, corners[0]),
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
            let height = dot(plus(point, -1.0, corners[2]), normal);
            let reach = (4.0 - height * height).max(0.0).sqrt();
            let foot = Foot {
                place,
                height,
                reach,
            };
            let relative = corners.map(|c| plus(c, -1.0, point));
            let alone = of.weight(relative, normal, area);
            let found = weights.find(std::iter::repeat_n(0, 3), &[circle], &foot);
            weights.weigh(&of, &[patch], &foot);
            assert!(found || alone == 0.0, "{alone}");
            for (_, weight) in weights.all() {
                assert!((alone - weight).abs() < 1e-12, "{alone} {weight}");
                seen += 1;
            }
        }
        assert!(seen > 100, "{seen}");
    }
}
