//! Shapes: boxes, balls and polygons, and regions that are a shape less others.

use crate::body::Body;
use crate::polygon::Polygon;
use crate::vector::distance;

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
    /// A polygon, in two dimensions.
    Polygon(Polygon),
}

impl<const D: usize> Shape<D> {
    /// Distance of a point from the surface, m, positive inside and negative outside.
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
            Shape::Polygon(polygon) => {
                let flat = [x[0], x[1]];
                let away = polygon.distance(flat, |_, _| true);
                if polygon.contains(flat) { away } else { -away }
            }
        }
    }

    /// Lower and upper corner of the smallest box around it, m.
    pub fn bounds(&self) -> ([f64; D], [f64; D]) {
        match self {
            Shape::Cuboid { lo, hi } => (*lo, *hi),
            Shape::Ball { centre, radius } => {
                (centre.map(|c| c - radius), centre.map(|c| c + radius))
            }
            Shape::Polygon(polygon) => {
                let axis = |k: usize| polygon.points().iter().map(move |p| p[k.min(1)]);
                let lo = |k: usize| axis(k).fold(f64::INFINITY, f64::min);
                let hi = |k: usize| axis(k).fold(f64::NEG_INFINITY, f64::max);
                (std::array::from_fn(lo), std::array::from_fn(hi))
            }
        }
    }
}

/// A shape less other shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct Region<const D: usize> {
    /// What is filled.
    pub base: Shape<D>,
    /// What is cut out of it.
    pub cuts: Vec<Shape<D>>,
}

impl<const D: usize> Region<D> {
    /// A shape from which nothing is cut out.
    pub fn whole(base: Shape<D>) -> Self {
        Region {
            base,
            cuts: Vec::new(),
        }
    }

    /// The region of a body, if the body gives a shape.
    pub fn of(body: &Body) -> Option<Self> {
        Some(Region {
            base: body.keys().shape()?,
            cuts: body
                .subtract
                .iter()
                .filter_map(|c| c.keys().shape())
                .collect(),
        })
    }

    /// Distance of a point from the surface, m, positive inside and negative outside.
    ///
    /// Exact inside; outside it may be less than the true distance in size, never in sign.
    pub fn depth(&self, x: &[f64; D]) -> f64 {
        let cuts = self.cuts.iter().map(|c| -c.depth(x));
        cuts.fold(self.base.depth(x), f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_are_distances_with_a_sign() {
        let cuboid = Shape::Cuboid {
            lo: [0.0; 3],
            hi: [2.0, 4.0, 6.0],
        };
        assert_eq!(cuboid.depth(&[0.5, 2.0, 3.0]), 0.5);
        assert_eq!(cuboid.depth(&[5.0, 8.0, 3.0]), -5.0);
        let ball = Shape::Ball {
            centre: [1.0, 1.0],
            radius: 2.0,
        };
        assert_eq!(ball.depth(&[1.0, 2.0]), 1.0);
        assert_eq!(ball.bounds(), ([-1.0; 2], [3.0; 2]));
    }

    #[test]
    fn a_cut_takes_away_and_bounds_what_is_left() {
        let region = Region {
            base: Shape::Cuboid {
                lo: [0.0; 2],
                hi: [4.0; 2],
            },
            cuts: vec![Shape::Ball {
                centre: [2.0; 2],
                radius: 1.0,
            }],
        };
        assert_eq!(region.depth(&[2.0, 2.0]), -1.0);
        assert_eq!(region.depth(&[2.0, 3.25]), 0.25);
        assert_eq!(region.depth(&[2.0, 3.75]), 0.25);
    }
}
