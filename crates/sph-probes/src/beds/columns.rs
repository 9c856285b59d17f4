//! Lines through the outermost particle of every column.

use sph_core::{Vect, bounds};

/// Width of a column in spacings: particles that have moved apart by more than one leave narrower
/// columns empty down to the rows below.
const WIDTH: f64 = 2.0;

/// Most columns; a reference may have a wrong unit.
const MOST: f64 = 1e6;

/// Particle of a column at which the line passes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// The highest, half a spacing above it.
    Highest,
    /// The lowest, half a spacing below it.
    Lowest,
}

/// The outermost place of every column of two spacings' width.
#[derive(Clone)]
pub(crate) struct Columns {
    end: End,
    spacing: f64,
    first: f64,
    places: Vec<Option<[f64; 2]>>,
}

impl Columns {
    /// Columns over some places, m, and one more on either side; nothing stands in them yet.
    pub fn over(xs: impl Iterator<Item = f64>, spacing: f64, end: End) -> Self {
        let [[low], [high]] = bounds(xs.map(|x| [x]));
        let width = WIDTH * spacing;
        let first = (low / width).floor() - 1.0;
        let count = (high / width).floor() + 2.0 - first;
        Columns {
            end,
            spacing,
            first,
            places: vec![None; count.clamp(0.0, MOST) as usize],
        }
    }

    fn column(&self, x: f64) -> f64 {
        (x / (WIDTH * self.spacing)).floor() - self.first
    }

    /// Puts a particle into its column; those beyond the columns are left out.
    pub fn put(&mut self, x: &Vect<2>) {
        let column = self.column(x[0]);
        if column < 0.0 || column >= self.places.len() as f64 {
            return;
        }
        let sign = match self.end {
            End::Highest => 1.0,
            End::Lowest => -1.0,
        };
        let place = &mut self.places[column as usize];
        let here = [x[0], x[1] + sign * 0.5 * self.spacing];
        // Of equals the first in space, whatever the order of the particles.
        if place.is_none_or(|p| (sign * here[1], -here[0]) > (sign * p[1], -p[0])) {
            *place = Some(here);
        }
    }

    /// These places, and where there is none those of others of the same columns.
    pub fn or(mut self, others: &Columns) -> Self {
        for (place, other) in self.places.iter_mut().zip(&others.places) {
            *place = place.or(*other);
        }
        self
    }

    /// Height of the line at x, m: straight between two places, level beyond the last ones; none in
    /// a column without a place.
    pub fn height(&self, x: f64) -> Option<f64> {
        let column = self.column(x).max(0.0) as usize;
        let own = self.places.get(column).copied().flatten()?;
        let other = match x < own[0] {
            true => column.checked_sub(1),
            false => Some(column + 1),
        };
        // At the ends, and beside a gap, the line is level.
        let Some(other) = other.and_then(|k| self.places.get(k).copied().flatten()) else {
            return Some(own[1]);
        };
        Some(own[1] + (x - own[0]) / (other[0] - own[0]) * (other[1] - own[1]))
    }

    /// Distance of a point from the line between neighbouring places, m; none without a place.
    pub fn distance(&self, point: [f64; 2]) -> Option<f64> {
        let pairs = self.places.windows(2).filter_map(|w| Some([w[0]?, w[1]?]));
        let alone = self.places.iter().flatten().map(|place| [*place; 2]);
        pairs
            .chain(alone)
            .map(|[from, to]| from_stretch(point, from, to))
            .reduce(f64::min)
    }

    /// Middles of the columns, m, without the additional ones at the ends.
    pub fn middles(&self) -> impl Iterator<Item = f64> {
        let inner = 1..self.places.len().saturating_sub(1);
        inner.map(|k| (self.first + k as f64 + 0.5) * WIDTH * self.spacing)
    }

    /// The places that there are.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        self.places.iter().copied().flatten()
    }
}

/// Distance of a point from the straight line between two places, m.
fn from_stretch(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let off = [point[0] - from[0], point[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let part = match square > 0.0 {
        true => ((off[0] * along[0] + off[1] * along[1]) / square).clamp(0.0, 1.0),
        false => 0.0,
    };
    (off[0] - part * along[0]).hypot(off[1] - part * along[1])
}
