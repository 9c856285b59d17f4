//! Regions: a shape less other shapes.

use crate::tables::body::{Body, BodyShape};
use crate::{LevelSurface, Shape};

/// A shape less other shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct Region<const D: usize> {
    /// The filled region.
    pub base: Shape<D>,
    /// Regions cut out of it.
    pub cuts: Vec<Shape<D>>,
}

impl<const D: usize> Region<D> {
    /// A shape from which nothing is cut out.
    pub fn whole(base: Shape<D>) -> Self {
        let cuts = Vec::new();
        Region { base, cuts }
    }

    /// The region of a body, if the body gives a shape or bounds its filling by a box.
    pub fn from_body(body: &Body) -> Option<Self> {
        let (base, cuts) = (body.shape.shape()?, cuts(body));
        Some(Region { base, cuts })
    }

    /// The region of a body that fills the walls within these bounds, m; or the key that is wrong and why.
    pub(crate) fn enclosed(
        body: &Body,
        bounds: Option<([f64; D], [f64; D])>,
    ) -> Result<Self, (&'static str, &'static str)> {
        let (mut lo, mut hi) = bounds.ok_or(("fill", "there are no walls to fill"))?;
        if let Some([least, most]) = &body.shape.bounds {
            for k in 0..D {
                lo[k] = lo[k].max(least[k]);
                hi[k] = hi[k].min(most[k]);
            }
        }
        if (0..D).any(|k| lo[k] >= hi[k]) {
            return Err(("box", "the box has nothing in common with the walls"));
        }
        let (base, cuts) = (Shape::Cuboid { lo, hi }, cuts(body));
        Ok(Region { base, cuts })
    }

    /// Lower and upper corner of a box around it, m: that of the base, less the part beyond a level surface or a wave.
    pub fn bounds(&self) -> ([f64; D], [f64; D]) {
        let (mut lo, mut hi) = self.base.bounds();
        for cut in &self.cuts {
            if let Shape::OverWave(wave) = cut {
                hi[D - 1] = hi[D - 1].min(wave.still() + wave.height);
            }
            if let Shape::Side { surface, above } = cut {
                let reach = surface.amplitude.abs();
                match above {
                    true => hi[D - 1] = hi[D - 1].min(surface.level + reach),
                    false => lo[D - 1] = lo[D - 1].max(surface.level - reach),
                }
            }
        }
        (lo, hi)
    }

    /// Distance of a point from the surface, m, positive inside and negative outside.
    ///
    /// Exact inside; outside it may be less than the true distance in size, never in sign.
    pub fn depth(&self, x: &[f64; D]) -> f64 {
        let cuts = self.cuts.iter().map(|c| -c.depth(x));
        cuts.fold(self.base.depth(x), f64::min)
    }
}

/// The parts that a body subtracts, and those beyond the surfaces that bound it.
fn cuts<const D: usize>(body: &Body) -> Vec<Shape<D>> {
    let cut = |surface: &Option<LevelSurface>, above: bool| {
        surface.map(|surface| Shape::Side { surface, above })
    };
    let wave = body.wave.map(Shape::OverWave);
    let ends = [cut(&body.above, false), cut(&body.below, true), wave];
    let given = body.subtract.iter().filter_map(BodyShape::shape);
    given.chain(ends.into_iter().flatten()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_takes_away_and_bounds_what_is_left() {
        let (lo, hi, centre, radius) = ([0.0; 2], [4.0; 2], [2.0; 2], 1.0);
        let (base, cuts) = (
            Shape::Cuboid { lo, hi },
            vec![Shape::Ball { centre, radius }],
        );
        let region = Region { base, cuts };
        assert_eq!(region.depth(&[2.0, 2.0]), -1.0);
        assert_eq!(region.depth(&[2.0, 3.25]), 0.25);
        assert_eq!(region.depth(&[2.0, 3.75]), 0.25);
    }

    #[test]
    fn level_surfaces_keep_what_is_between_them() {
        let surface = |level: f64, amplitude: f64| LevelSurface {
            level,
            amplitude,
            wavelength: Some(1.0),
            phase: 0.0,
        };
        let side = |surface: LevelSurface, above: bool| Shape::Side { surface, above };
        let (lo, hi) = ([0.0; 2], [1.0, 4.0]);
        let base = Shape::Cuboid { lo, hi };
        let cuts = [(1.0, 0.0, false), (3.0, 0.1, true)];
        let cuts = cuts.map(|(level, amplitude, above)| side(surface(level, amplitude), above));
        let cuts = cuts.to_vec();
        let region = Region::<2> { base, cuts };
        assert_eq!(region.bounds(), ([0.0, 1.0], [1.0, 3.1]));
        assert_eq!(region.depth(&[0.5, 1.25]), 0.25);
        assert_eq!(region.depth(&[0.5, 0.5]), -0.5);
        assert!((region.depth(&[0.5, 2.8]) - 0.1).abs() < 1e-9);
        assert!(region.depth(&[0.5, 3.05]) < 0.0 && region.depth(&[0.01, 3.05]) > 0.0);
    }
}
