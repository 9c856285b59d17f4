//! The generalised winding number.

use std::f64::consts::PI;

/// Clusters farther away than this many of their radii count as one facet.
const FAR: f64 = 4.0;
/// Triangles of a cluster that is not divided.
const FEW: usize = 8;
/// Largest number of triangles at which the side of a surface is sampled.
const ASKED: usize = 256;

/// Winding number of a surface around a point: w(x) = Σ Ω/4π over its triangles, Ω the solid angle in which x sees one
/// from behind its normal. 1 within a closed surface that faces outwards, −1 if it faces inwards, 0 outside; of an open
/// or torn one it is less, and varies. Jacobson, Kavan & Sorkine-Hornung (2013); distant clusters as dipoles, Barill et
/// al. (2018).
#[derive(Clone, Debug)]
pub struct Winding {
    triangles: Vec<[[f64; 3]; 3]>,
    clusters: Vec<Cluster>,
}

#[derive(Clone, Debug)]
struct Cluster {
    first: usize,
    end: usize,
    /// Numbers of the two parts; none where it is not divided.
    parts: Option<[usize; 2]>,
    centre: [f64; 3],
    radius: f64,
    /// Sum of the areas along the normals.
    area: [f64; 3],
}

impl Winding {
    /// Of some triangles.
    pub fn new(triangles: Vec<[[f64; 3]; 3]>) -> Self {
        let mut all = Winding {
            triangles,
            clusters: Vec::new(),
        };
        if !all.triangles.is_empty() {
            all.cluster(0, all.triangles.len());
        }
        all
    }

    fn cluster(&mut self, first: usize, end: usize) -> usize {
        let own = &self.triangles[first..end];
        let (mut area, mut centre, mut total) = ([0.0; 3], [0.0; 3], 0.0);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for [a, b, c] in own {
            let double = cross(&minus(b, a), &minus(c, a));
            let size = 0.5 * dot(&double, &double).sqrt();
            total += size;
            for k in 0..3 {
                let middle = (a[k] + b[k] + c[k]) / 3.0;
                area[k] += 0.5 * double[k];
                centre[k] += size * middle;
                (low[k], high[k]) = (low[k].min(middle), high[k].max(middle));
            }
        }
        let centre = centre.map(|c| c / f64::max(total, f64::MIN_POSITIVE));
        let away = |x: &[f64; 3]| dot(&minus(x, &centre), &minus(x, &centre));
        let radius = own.iter().flatten().map(away).fold(0.0, f64::max).sqrt();
        let number = self.clusters.len();
        self.clusters.push(Cluster {
            first,
            end,
            parts: None,
            centre,
            radius,
            area,
        });
        if end - first > FEW {
            let extent = minus(&high, &low);
            let along = (0..3).fold(0, |most, k| if extent[k] > extent[most] { k } else { most });
            let at = |t: &[[f64; 3]; 3]| t[0][along] + t[1][along] + t[2][along];
            let half = (end - first) / 2;
            self.triangles[first..end].select_nth_unstable_by(half, |a, b| at(a).total_cmp(&at(b)));
            let parts = [
                self.cluster(first, first + half),
                self.cluster(first + half, end),
            ];
            self.clusters[number].parts = Some(parts);
        }
        number
    }

    /// The number at a point; between the sides, on a triangle.
    pub fn at(&self, x: &[f64; 3]) -> f64 {
        let mut sum = 0.0;
        let mut open: Vec<usize> = (0..self.clusters.len().min(1)).collect();
        while let Some(number) = open.pop() {
            let cluster = &self.clusters[number];
            let to = minus(&cluster.centre, x);
            let distance = dot(&to, &to).sqrt();
            if distance > FAR * cluster.radius {
                sum += dot(&cluster.area, &to) / distance.powi(3);
            } else if let Some(parts) = cluster.parts {
                open.extend(parts);
            } else {
                let own = &self.triangles[cluster.first..cluster.end];
                sum += own.iter().map(|t| solid_angle(t, x)).sum::<f64>();
            }
        }
        sum / (4.0 * PI)
    }

    /// Side that a surface faces, from ½, outwards, to −½, inwards; near 0 there is no inside.
    ///
    /// The area's mean of the winding number between the two sides of the surface, which is ±½ of a closed one and
    /// less of an open one, since its opening is seen from everywhere.
    pub fn sense(triangles: &[[[f64; 3]; 3]]) -> f64 {
        let winding = Winding::new(triangles.to_vec());
        let area = |[a, b, c]: &[[f64; 3]; 3]| {
            let normal = cross(&minus(b, a), &minus(c, a));
            0.5 * dot(&normal, &normal).sqrt()
        };
        let all: f64 = triangles.iter().map(area).sum();
        let step = all / ASKED.min(triangles.len()) as f64;
        let (mut passed, mut asked, mut sum) = (0.0, 0.0, 0.0);
        for triangle in triangles {
            passed += area(triangle);
            if passed >= (asked + 0.5) * step {
                let [a, b, c] = triangle;
                let times = (passed / step + 0.5).floor() - asked;
                sum += times * winding.at(&std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0));
                asked += times;
            }
        }
        sum / f64::max(asked, 1.0)
    }
}

/// Solid angle of a triangle, positive seen against its normal; 0 in its plane. Van Oosterom & Strackee (1983).
fn solid_angle(triangle: &[[f64; 3]; 3], x: &[f64; 3]) -> f64 {
    let [a, b, c] = triangle.map(|p| minus(&p, x));
    let [la, lb, lc] = [&a, &b, &c].map(|v| dot(v, v).sqrt());
    let volume = dot(&a, &cross(&b, &c));
    if volume.abs() <= 1e-12 * la * lb * lc {
        return 0.0;
    }
    let below = la * lb * lc + dot(&a, &b) * lc + dot(&b, &c) * la + dot(&c, &a) * lb;
    2.0 * volume.atan2(below)
}

fn minus(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of 2·n² triangles that faces outwards, without those of the first rows.
    fn ball(n: usize, without: usize) -> Vec<[[f64; 3]; 3]> {
        let at = |i: usize, j: usize| {
            let (t, p) = (PI * i as f64 / n as f64, 2.0 * PI * j as f64 / n as f64);
            [t.sin() * p.cos(), t.sin() * p.sin(), t.cos()]
        };
        let cells = (without..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let halves = cells.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        halves.collect()
    }

    #[test]
    fn it_is_one_inside_and_the_share_of_the_sphere_that_is_left_in_an_open_one() {
        // The error of a dipole is of second order in the radius of a cluster over its distance.
        let dipole = FAR.powi(-2);
        let whole = Winding::new(ball(40, 0));
        for (x, w) in [
            ([0.0; 3], 1.0),
            ([0.5, 0.3, -0.2], 1.0),
            ([0.0, 1.5, 0.0], 0.0),
        ] {
            assert!((whole.at(&x) - w).abs() < dipole, "{}", whole.at(&x));
        }
        // Without the cap over the angle π/4 the middle sees (1 + cos π/4)/2 of it.
        let open = Winding::new(ball(40, 10)).at(&[0.0; 3]);
        assert!(
            (open - 0.5 * (1.0 + 0.5_f64.sqrt())).abs() < dipole,
            "{open}"
        );
    }
}
