//! Profiles along a face, and numbers that follow the time.

use sph_core::{parameters, rectangular_duct};

use crate::{FaceElement, OpenRefusal, OpenSetting, refuse};

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
            _ => self.by_numbers(s, t),
        }
    }

    /// The factor of a profile that is named by numbers; 1 of others.
    fn by_numbers(&self, s: f64, t: f64) -> f64 {
        match self {
            Profile::Polynomial(c) => polynomial(c, s),
            Profile::Surface(c) => {
                let rows: Vec<f64> = c.iter().map(|c| polynomial(c, t)).collect();
                polynomial(&rows, s)
            }
            Profile::Table(table) => interpolated(table, s),
            Profile::Uniform | Profile::Parabola | Profile::Duct => 1.0,
        }
    }

    pub(crate) fn largest(&self) -> f64 {
        let (along, across) = match self {
            Profile::Surface(_) => (100, 100),
            _ => (1000, 0),
        };
        let part = |k: usize, of: usize| k as f64 / of.max(1) as f64;
        let all = (0..=along).flat_map(|i| (0..=across).map(move |j| (i, j)));
        all.map(|(i, j)| self.by_numbers(part(i, along), part(j, across)).abs())
            .fold(0.0, f64::max)
    }

    /// Refuses a profile of another dimension than the scene's.
    pub(crate) fn check(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        let refused = |why: &str| refuse("profile", why);
        let finite = match self {
            Profile::Polynomial(c) => c.iter().all(|c| c.is_finite()),
            Profile::Surface(c) => c.iter().flatten().all(|c| c.is_finite()),
            _ => true,
        };
        if !finite {
            return refused("a coefficient is not finite");
        }
        if let Profile::Table(table) = self {
            check_table("profile.table", table)?;
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
        if flat || *self == Profile::Uniform {
            return Ok(());
        }
        let why = "a profile goes over a plane rectangle with its sides along axes of space; this face has another shape: take \
                   `uniform`, or draw the face as a `box` with its other five sides in `open`";
        refuse("profile", why)
    }
}

/// Straight lines between points of a table; beyond its ends the value is that of the end.
pub(crate) fn interpolated(table: &[[f64; 2]], x: f64) -> f64 {
    let after = table.partition_point(|[at, _]| *at <= x);
    match (after.checked_sub(1).map(|k| table[k]), table.get(after)) {
        (Some([a, f]), Some([b, g])) => f + (g - f) * (x - a) / (b - a),
        (Some([_, f]), None) => f,
        (None, Some([_, g])) => *g,
        (None, None) => 1.0,
    }
}

/// Refuses tables that are no function.
pub(crate) fn check_table(key: &str, table: &[[f64; 2]]) -> Result<(), OpenRefusal> {
    let rises = table.windows(2).all(|w| w[0][0] < w[1][0]);
    let finite = table.iter().flatten().all(|x| x.is_finite());
    if table.is_empty() || !rises || !finite {
        let why = "a table has pairs of finite numbers, the first of them rising";
        return refuse(key, why);
    }
    Ok(())
}

/// Times, s, and factors of a value between which it goes straight: `[[0, 0], [0.5, 1], [10, 1]]`.
pub(crate) type FactorTable = Option<Vec<[f64; 2]>>;

pub(crate) fn factor(course: &FactorTable, time: f64) -> f64 {
    course.as_deref().map_or(1.0, |t| interpolated(t, time))
}

/// True if a value is below 0 somewhere on its course.
pub(crate) fn turns_negative(course: &FactorTable, value: f64) -> bool {
    let table = course.as_deref().unwrap_or(&[[0.0, 1.0]]);
    table.iter().any(|[_, factor]| value * factor < 0.0)
}

/// Refuses a course that does not last as long as the run.
pub(crate) fn check_course(
    course: &FactorTable,
    setting: &OpenSetting<'_>,
) -> Result<(), OpenRefusal> {
    let Some(table) = course else {
        return Ok(());
    };
    check_table("over_time", table)?;
    let (first, last) = (table[0][0], table[table.len() - 1][0]);
    if first <= 0.0 && last >= setting.end {
        return Ok(());
    }
    let why = format!(
        "the table lasts from {first} s to {last} s, and the run from 0 to {} s: add what is missing",
        setting.end
    );
    refuse("over_time", why)
}

#[cfg(test)]
mod tests {
    use sph_core::Vect;

    use super::*;

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

    #[test]
    fn tables_are_straight_between_their_points_and_stay_beyond() {
        let table = [[0.0, 1.0], [2.0, 3.0]];
        assert_eq!(
            [-1.0, 0.0, 0.5, 2.0, 9.0].map(|x| interpolated(&table, x)),
            [1.0, 1.0, 1.5, 3.0, 3.0]
        );
    }
}
