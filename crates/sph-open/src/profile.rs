//! Profiles along a face.

use sph_core::{parameters, rectangular_duct};

use crate::course::{check_table, interpolated};
use crate::{FaceElement, OpenRefusal, OpenSetting};

/// Distribution of a velocity along a face, as factors of it.
///
/// In two dimensions s goes from 0 to 1 from the first corner of the drawing. In three the face is a plane rectangle with its
/// sides along axes of space: s goes from 0 to 1 along the first of them, x before y before z, and t along the second.
#[parameters]
#[derive(PartialEq)]
pub enum Profile {
    /// The same everywhere.
    #[default]
    Uniform,
    /// 4 s (1 − s), in three dimensions 16 s (1 − s) t (1 − t): the velocity is that of the middle.
    Parabola,
    /// In three dimensions that of the developed laminar flow in a duct; the velocity is that of the middle.
    Duct,
    /// In two dimensions coefficients of 1, s, s², …
    Polynomial(Vec<f64>),
    /// In three dimensions coefficients c of Σ c_ij s^i t^j: those of 1, t, t², …, then those of s, s t, s t², …
    Surface(Vec<Vec<f64>>),
    /// In two dimensions pairs of s and factor, straight between them.
    Table(Vec<[f64; 2]>),
}

/// Σ c_k x^k.
fn polynomial(c: &[f64], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

impl Profile {
    /// The factor at a place.
    pub fn at<const D: usize>(&self, place: &FaceElement<D>) -> f64 {
        let (s, t) = (place.along, place.across);
        match self {
            Profile::Uniform => 1.0,
            Profile::Parabola if D == 2 => 4.0 * s * (1.0 - s),
            Profile::Parabola => 16.0 * s * (1.0 - s) * t * (1.0 - t),
            Profile::Duct => {
                let sides = place.rectangle.unwrap_or([1.0; 2]);
                let half = sides.map(|side| 0.5 * side);
                let from = [(s - 0.5) * sides[0], (t - 0.5) * sides[1]];
                rectangular_duct(from, half) / rectangular_duct([0.0; 2], half)
            }
            Profile::Polynomial(c) => polynomial(c, s),
            Profile::Surface(c) => {
                let rows: Vec<f64> = c.iter().map(|c| polynomial(c, t)).collect();
                polynomial(&rows, s)
            }
            Profile::Table(table) => interpolated(table, s),
        }
    }

    /// The largest factor.
    pub(crate) fn largest(&self) -> f64 {
        let at = |s: f64, t: f64| match self {
            Profile::Uniform | Profile::Parabola | Profile::Duct => 1.0,
            Profile::Polynomial(c) => polynomial(c, s),
            Profile::Surface(c) => {
                let rows: Vec<f64> = c.iter().map(|c| polynomial(c, t)).collect();
                polynomial(&rows, s)
            }
            Profile::Table(table) => interpolated(table, s),
        };
        let (along, across) = match self {
            Profile::Surface(_) => (100, 100),
            _ => (1000, 0),
        };
        let part = |k: usize, of: usize| k as f64 / of.max(1) as f64;
        let all = (0..=along).flat_map(|i| (0..=across).map(move |j| (i, j)));
        all.map(|(i, j)| at(part(i, along), part(j, across)).abs())
            .fold(0.0, f64::max)
    }

    /// Refuses a profile of another dimension than the scene's.
    pub(crate) fn check(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        let refused = |why: &str| Err(OpenRefusal::at_key("profile", why));
        match self {
            Profile::Polynomial(c) if c.iter().any(|c| !c.is_finite()) => {
                return refused("a coefficient is not finite");
            }
            Profile::Surface(c) if c.iter().flatten().any(|c| !c.is_finite()) => {
                return refused("a coefficient is not finite");
            }
            Profile::Table(table) => check_table("profile.table", table)?,
            _ => {}
        }
        match (self, setting.dimension) {
            (Profile::Duct, 2) => refused("a channel in the plane has the profile `parabola`"),
            (Profile::Surface(_), 2) => refused(
                "a face in the plane is a line: take `polynomial` with the coefficients of 1, s, s², …",
            ),
            (Profile::Polynomial(_) | Profile::Table(_), 3) => refused(
                "it goes along a line, and a face in space is a surface: take `uniform`, `parabola`, `duct`, or `surface` \
                 with the coefficients of s^i t^j",
            ),
            _ => Ok(()),
        }
    }

    /// Refuses faces along which it has no coordinates.
    pub(crate) fn fit<const D: usize>(&self, places: &[FaceElement<D>]) -> Result<(), OpenRefusal> {
        let flat = D == 2 || places.iter().all(|place| place.rectangle.is_some());
        match self {
            Profile::Uniform => Ok(()),
            _ if flat => Ok(()),
            _ => Err(OpenRefusal::at_key(
                "profile",
                "a profile goes over a plane rectangle with its sides along axes of space, and this face is none: take \
                 `uniform`, or draw the face as a `box` with its other five sides in `open`",
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::Vect;

    fn place<const D: usize>(along: f64, across: f64, sides: [f64; 2]) -> FaceElement<D> {
        FaceElement {
            centre: Vect::zeros(),
            normal: Vect::zeros(),
            measure: 1.0,
            along,
            across,
            rectangle: (D == 3).then_some(sides),
        }
    }

    #[test]
    fn a_polynomial_is_the_parabola() {
        let by_hand = Profile::Polynomial(vec![0.0, 4.0, -4.0]);
        for s in [0.0, 0.3, 0.5, 1.0] {
            let at = place::<2>(s, 0.5, [1.0; 2]);
            assert!((by_hand.at(&at) - Profile::Parabola.at(&at)).abs() < 1e-15);
        }
        assert!((by_hand.largest() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_surface_is_the_parabola_in_space() {
        let by_hand = Profile::Surface(vec![
            vec![0.0],
            vec![0.0, 16.0, -16.0],
            vec![0.0, -16.0, 16.0],
        ]);
        for (s, t) in [(0.0, 0.2), (0.3, 0.9), (0.5, 0.5)] {
            let at = place::<3>(s, t, [1.0; 2]);
            assert!((by_hand.at(&at) - Profile::Parabola.at(&at)).abs() < 1e-14);
        }
        assert!((by_hand.largest() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_flat_duct_is_a_parabola_across_and_the_same_along() {
        let at = |s: f64, t: f64| Profile::Duct.at(&place::<3>(s, t, [40.0, 1.0]));
        assert!((at(0.5, 0.5) - 1.0).abs() < 1e-12);
        assert!((at(0.4, 0.25) - 0.75).abs() < 1e-6, "{}", at(0.4, 0.25));
    }
}
