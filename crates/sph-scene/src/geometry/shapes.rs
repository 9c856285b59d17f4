//! Shapes: boxes, balls, polygons, cylinders and so on.

use crate::geometry::polygon::Polygon;
use crate::geometry::surround::Surround;
use crate::geometry::vector::distance;
use crate::{LevelSurface, Wave};

/// A closed piece of space.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape<const D: usize> {
    /// A box with faces along the axes.
    Cuboid {
        /// Lower corner, m.
        lo: [f64; D],
        /// Upper corner, m.
        hi: [f64; D],
    },
    /// A disc in two dimensions, a sphere in three.
    Ball {
        /// Centre, m.
        centre: [f64; D],
        /// Radius, m.
        radius: f64,
    },
    /// An ellipse, in two dimensions.
    Ellipse {
        /// Centre, m.
        centre: [f64; D],
        /// Semi-axes along x and y, m.
        semi_axes: [f64; 2],
    },
    /// All that is on one side of a level surface.
    Side {
        /// The surface.
        surface: LevelSurface,
        /// True if it describes the half space above.
        above: bool,
    },
    /// All that is above a wave.
    OverWave(Wave),
    /// A polygon, in two dimensions.
    Polygon(Polygon),
    /// A cylinder, in three dimensions.
    Cylinder {
        /// Centre of one end, m.
        from: [f64; D],
        /// Centre of the other end, m.
        to: [f64; D],
        /// Radius, m.
        radius: f64,
    },
    /// A cone, in three dimensions.
    Cone {
        /// Centre of the base, m.
        base: [f64; D],
        /// Tip, m.
        apex: [f64; D],
        /// Radius of the base, m.
        radius: f64,
    },
    /// A polygon drawn out along an axis, in three dimensions.
    Extrusion {
        /// The polygon, by the two coordinates across the axis in their order.
        polygon: Polygon,
        /// Number of the axis.
        axis: usize,
        /// Lower and upper end along the axis, m.
        ends: [f64; 2],
    },
    /// All that is near a wall.
    Surround(Surround<D>),
}

impl<const D: usize> Shape<D> {
    /// Distance of a point from the surface, m, positive inside and negative outside.
    ///
    /// Exact inside; outside a cone or an extrusion it may be less than the true distance in size, never in sign.
    pub fn depth(&self, x: &[f64; D]) -> f64 {
        match self {
            Shape::Cuboid { lo, hi } => {
                let side = |k: usize| (x[k] - lo[k]).min(hi[k] - x[k]);
                let inside = (0..D).map(side).fold(f64::INFINITY, f64::min);
                if inside >= 0.0 {
                    return inside;
                }
                let outside: f64 = (0..D).map(|k| side(k).min(0.0).powi(2)).sum();
                -outside.sqrt()
            }
            Shape::Ball { centre, radius } => radius - distance(x, centre),
            Shape::Ellipse { centre, semi_axes } => {
                ellipse_depth(*semi_axes, [x[0] - centre[0], x[1] - centre[1]])
            }
            Shape::Side {
                surface,
                above: true,
            } => surface.above(x),
            Shape::Side { surface, .. } => -surface.above(x),
            Shape::OverWave(wave) => wave.above(x),
            Shape::Polygon(polygon) => polygon.depth([x[0], x[1]]),
            Shape::Cylinder { from, to, radius } => {
                let (along, off, length) = axial_coordinates(from, to, x);
                let (side, end) = (radius - off, along.min(length - along));
                match side.min(end) {
                    inside if inside >= 0.0 => inside,
                    _ => -side.min(0.0).hypot(end.min(0.0)),
                }
            }
            Shape::Cone { base, apex, radius } => {
                let (along, off, height) = axial_coordinates(base, apex, x);
                let slant = (radius * (height - along) - height * off) / radius.hypot(height);
                slant.min(along)
            }
            Shape::Extrusion {
                polygon,
                axis,
                ends,
            } => {
                let side = polygon.depth(axes_across(*axis).map(|k| x[k]));
                side.min(x[*axis] - ends[0]).min(ends[1] - x[*axis])
            }
            Shape::Surround(surround) => surround.depth(x),
        }
    }

    /// True if it encloses another shape widened by a margin, m; of shapes other than a ball the box around it.
    pub fn encloses(&self, inner: &Shape<D>, margin: f64) -> bool {
        if let (Shape::Surround(outer), Shape::Surround(inner)) = (self, inner)
            && let Some(beyond) = outer.beyond(inner)
        {
            return beyond >= margin;
        }
        if let Shape::Ball { centre, radius } = inner {
            return self.depth(centre) >= radius + margin;
        }
        let (low, high) = inner.bounds();
        (0..1 << D).all(|corner: usize| {
            let x = std::array::from_fn(|k| match corner >> k & 1 {
                0 => low[k] - margin,
                _ => high[k] + margin,
            });
            self.depth(&x) >= 0.0
        })
    }

    /// True if another shape is nearer than a distance, m; of shapes other than a ball the box around it.
    pub fn is_near(&self, other: &Shape<D>, distance: f64) -> bool {
        match (self, other) {
            (Shape::Ball { centre, radius }, other) | (other, Shape::Ball { centre, radius }) => {
                other.depth(centre) > -(radius + distance)
            }
            _ => {
                let (a, b) = (self.bounds(), other.bounds());
                (0..D).all(|k| a.0[k] - distance < b.1[k] && b.0[k] - distance < a.1[k])
            }
        }
    }

    /// Lower and upper corner of the smallest box around it, m; infinite where it has no end.
    pub fn bounds(&self) -> ([f64; D], [f64; D]) {
        match self {
            Shape::Cuboid { lo, hi } => (*lo, *hi),
            Shape::Ball { centre, radius } => {
                (centre.map(|c| c - radius), centre.map(|c| c + radius))
            }
            Shape::Ellipse { centre, semi_axes } => {
                let reach = |k: usize| semi_axes.get(k).copied().unwrap_or(0.0);
                let corner = |sign: f64| std::array::from_fn(|k| centre[k] + sign * reach(k));
                (corner(-1.0), corner(1.0))
            }
            Shape::Side { surface, above } => {
                let (mut lo, mut hi) = ([f64::NEG_INFINITY; D], [f64::INFINITY; D]);
                match above {
                    true => lo[D - 1] = surface.level - surface.amplitude.abs(),
                    false => hi[D - 1] = surface.level + surface.amplitude.abs(),
                }
                (lo, hi)
            }
            Shape::OverWave(wave) => {
                let mut lo = [f64::NEG_INFINITY; D];
                lo[D - 1] = wave.still();
                (lo, [f64::INFINITY; D])
            }
            Shape::Polygon(polygon) => {
                let corners = polygon.bounds();
                let [lo, hi] = corners.map(|x| std::array::from_fn(|k| x[k.min(1)]));
                (lo, hi)
            }
            Shape::Cylinder { from, to, radius } => {
                let reach = rim(from, to, *radius);
                let lo = |k: usize| from[k].min(to[k]) - reach[k];
                let hi = |k: usize| from[k].max(to[k]) + reach[k];
                (std::array::from_fn(lo), std::array::from_fn(hi))
            }
            Shape::Cone { base, apex, radius } => {
                let reach = rim(base, apex, *radius);
                let lo = |k: usize| apex[k].min(base[k] - reach[k]);
                let hi = |k: usize| apex[k].max(base[k] + reach[k]);
                (std::array::from_fn(lo), std::array::from_fn(hi))
            }
            Shape::Extrusion {
                polygon,
                axis,
                ends,
            } => {
                let [low, high] = polygon.bounds();
                let of = |flat: [f64; 2], end: f64| {
                    let side = |k: usize| flat[k - usize::from(k > *axis)];
                    std::array::from_fn(|k| if k == *axis { end } else { side(k) })
                };
                (of(low, ends[0]), of(high, ends[1]))
            }
            Shape::Surround(surround) => surround.bounds(),
        }
    }
}

/// Distance of a point along an axis and off it, and the length of the axis.
fn axial_coordinates<const D: usize>(
    from: &[f64; D],
    to: &[f64; D],
    x: &[f64; D],
) -> (f64, f64, f64) {
    let length = distance(from, to);
    let along = |k: usize| (x[k] - from[k]) * (to[k] - from[k]) / length;
    let along = (0..D).map(along).sum();
    let foot = std::array::from_fn(|k| from[k] + along * (to[k] - from[k]) / length);
    (along, distance(x, &foot), length)
}

/// Extent of a circle about an axis along every coordinate.
fn rim<const D: usize>(from: &[f64; D], to: &[f64; D], radius: f64) -> [f64; D] {
    let length = distance(from, to);
    std::array::from_fn(|k| radius * (1.0 - ((to[k] - from[k]) / length).powi(2)).max(0.0).sqrt())
}

/// The two axes of space across an axis, in their order.
pub(crate) fn axes_across(axis: usize) -> [usize; 2] {
    [[1, 2], [0, 2], [0, 1]][axis]
}

/// Distance of a point from an ellipse about the origin, m, positive inside.
///
/// The nearest point (a²x/(t + a²), b²y/(t + b²)) has the root t of
/// (ax/(t + a²))² + (by/(t + b²))² = 1 that is larger than −b²; a is the larger semi-axis.
///
/// Source: Eberly 2013, Distance from a point to an ellipse, §2.
fn ellipse_depth(semi_axes: [f64; 2], x: [f64; 2]) -> f64 {
    let turned = semi_axes[0] < semi_axes[1];
    let order = |v: [f64; 2]| if turned { [v[1], v[0]] } else { v };
    let [a, b] = order(semi_axes);
    let [x, y] = order(x.map(f64::abs));
    let inside = (x / a).powi(2) + (y / b).powi(2) <= 1.0;
    let away = if y > 0.0 {
        // In units of b: g falls from above 0 at low to below 0 at high.
        let (u, v, r) = (x / b, y / b, (a / b).powi(2));
        let ratio = a / b;
        let g = |t: f64| (ratio * u / (t + r)).powi(2) + (v / (t + 1.0)).powi(2) - 1.0;
        let (mut low, mut high) = (v - 1.0, (ratio * u).hypot(v) - 1.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            let end = if g(middle) > 0.0 { &mut low } else { &mut high };
            *end = middle;
        }
        let t = 0.5 * (low + high);
        b * (u * r / (t + r) - u).hypot(v / (t + 1.0) - v)
    } else if a > b && x < (a * a - b * b) / a {
        // On the long axis between the centres of curvature the nearest points are off it.
        let foot = a * a * x / (a * a - b * b);
        (foot - x).hypot(b * (1.0 - (foot / a).powi(2)).max(0.0).sqrt())
    } else {
        (x - a).abs()
    };
    if inside { away } else { -away }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_are_distances_with_a_sign() {
        let (lo, hi) = ([0.0; 3], [2.0, 4.0, 6.0]);
        let cuboid = Shape::Cuboid { lo, hi };
        assert_eq!(cuboid.depth(&[0.5, 2.0, 3.0]), 0.5);
        assert_eq!(cuboid.depth(&[5.0, 8.0, 3.0]), -5.0);
        let (centre, radius) = ([1.0, 1.0], 2.0);
        let ball = Shape::Ball { centre, radius };
        assert_eq!(ball.depth(&[1.0, 2.0]), 1.0);
        assert_eq!(ball.bounds(), ([-1.0; 2], [3.0; 2]));
        let square = |lo: f64, hi: f64| Shape::Cuboid {
            lo: [lo; 2],
            hi: [hi; 2],
        };
        // The corner of the square is √2 from the centre.
        assert!(ball.encloses(&square(0.0, 2.0), 0.4) && !ball.encloses(&square(0.0, 2.0), 0.42));
        assert!(square(-2.0, 4.0).encloses(&ball, 1.0) && !square(-2.0, 4.0).encloses(&ball, 1.1));
        let beside = square(4.0, 5.0);
        assert!(beside.is_near(&square(1.0, 3.0), 1.1) && !beside.is_near(&square(1.0, 3.0), 0.9));
        let gap = 18f64.sqrt() - 2.0;
        assert!(ball.is_near(&beside, gap + 0.01) && !beside.is_near(&ball, gap - 0.01));
    }

    #[test]
    fn solids_have_exact_depths_inside_and_bounds() {
        let (from, to, radius) = ([0.0; 3], [0.0, 4.0, 0.0], 1.0);
        let rod = Shape::Cylinder { from, to, radius };
        assert_eq!(rod.depth(&[0.5, 2.0, 0.0]), 0.5);
        assert_eq!(rod.depth(&[4.0, 8.0, 0.0]), -5.0);
        assert_eq!(rod.bounds(), ([-1.0, 0.0, -1.0], [1.0, 4.0, 1.0]));
        let (base, apex, radius) = ([0.0; 3], [0.0, 0.0, 4.0], 3.0);
        let tip = Shape::Cone { base, apex, radius };
        assert!((tip.depth(&[0.0, 0.0, 1.5]) - 1.5).abs() < 1e-12);
        assert!((tip.depth(&[3.0, 0.0, 4.0]) + 2.4).abs() < 1e-12);
        assert_eq!(tip.bounds(), ([-3.0, -3.0, 0.0], [3.0, 3.0, 4.0]));
        let prism = Shape::Extrusion {
            polygon: Polygon::new(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]),
            axis: 1,
            ends: [5.0, 9.0],
        };
        assert_eq!(prism.depth(&[1.0, 7.0, 0.25]), 0.25);
        assert_eq!(prism.depth(&[1.0, 5.125, 0.5]), 0.125);
        assert!(prism.depth(&[0.5, 7.0, 1.5]) < 0.0);
        assert_eq!(prism.bounds(), ([0.0, 5.0, 0.0], [2.0, 9.0, 1.0]));
    }

    #[test]
    fn distances_are_those_of_the_densely_sampled_line() {
        for axes in [[2.0, 1.0], [1.0, 2.0], [1.0, 1.0], [0.105, 0.095]] {
            let near = [[0.0, 0.0], [0.3, 0.4], [1.0, 0.0], [0.0, 1.0]];
            let far = [[1.9, 0.1], [-3.0, 2.0], [0.0, -5.0]];
            for at in near.into_iter().chain(far) {
                let x = [0, 1].map(|k: usize| at[k] * axes[k]);
                let sampled = (0..200_000)
                    .map(|k| f64::from(k) * std::f64::consts::TAU / 200_000.0)
                    .map(|s| (axes[0] * s.cos() - x[0]).hypot(axes[1] * s.sin() - x[1]))
                    .fold(f64::INFINITY, f64::min);
                let found = ellipse_depth(axes, x);
                let error = (found.abs() - sampled).abs();
                assert!(error < 1e-7, "{axes:?} {x:?}: {found} {sampled}");
                assert_eq!(found >= 0.0, at[0].hypot(at[1]) <= 1.0);
            }
        }
    }
}
