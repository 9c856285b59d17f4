//! Pictures of the state in which a run failed.

use std::path::{Path, PathBuf};

use sph_core::{Vect, fields};
use sph_io::{Picture, View};
use sph_run::{BAD_STATE_NEAR, BAD_STATE_PICTURE};
use sph_solver::Flow;

use crate::running::pieces::{column_of, drawn_walls, padded};

/// Half the width of the enlarged view, in spacings.
const REACH: f64 = 10.0;
/// Share of the particles beyond either end of the colours, so that one value does not make all others alike.
const BEYOND: f64 = 0.01;
/// Half the thickness of the slice through a body of three dimensions, in spacings.
const SLICE: f64 = 1.0;

/// Draws the column that shows a bad quantity, of the whole flow and around a place; the files that could be written.
pub fn draw<const D: usize>(
    flow: &Flow<D>,
    quantity: &str,
    place: Option<Vect<D>>,
    title: &str,
    folder: &Path,
) -> Vec<PathBuf> {
    let world = &flow.world;
    let column = match quantity {
        "density" => fields::DENSITY.name,
        "acceleration" => fields::ACCELERATION.name,
        "effective pressure" => fields::EFFECTIVE_PRESSURE.name,
        _ => fields::VELOCITY.name,
    };
    let Some((label, mut values)) = column_of(flow, column) else {
        return Vec::new();
    };
    let Ok(position) = world.free.get(fields::POSITION) else {
        return Vec::new();
    };
    let mut points: Vec<[f64; 3]> = position.iter().map(padded).collect();
    let walls = drawn_walls(world);
    let ring = place.as_ref().map(padded);
    // The last point drawn covers its neighbours.
    if let Some(k) = points.iter().position(|x| Some(*x) == ring) {
        let last = points.len() - 1;
        points.swap(k, last);
        values.swap(k, last);
    }
    let whole = Picture {
        title,
        time: Some(world.time),
        label: &label,
        diameter: world.spacing,
        walls: &walls,
        view: if D == 2 { View::Plane } else { View::Front },
        range: range(&values),
        ring,
        ..Picture::new(&points, &values)
    };
    let mut written = Vec::new();
    let mut save = |picture: &Picture<'_>, name: &str| {
        let path = folder.join(name);
        // A failed run is reported without pictures, too.
        if picture.save(&path).is_ok() {
            written.push(path);
        }
    };
    save(&whole, BAD_STATE_PICTURE);
    if let Some(at) = ring {
        let reach = REACH * world.spacing;
        let up = if D == 2 { 1 } else { 2 };
        let (wide, thin) = (1.5 * reach, SLICE * world.spacing);
        let within = |p: &[f64; 3]| {
            let near = |k: usize, r: f64| (p[k] - at[k]).abs() <= r;
            near(0, wide) && near(up, wide) && (D == 2 || near(1, thin))
        };
        let near = points.iter().copied().zip(values.iter().copied());
        let (points, values): (Vec<_>, Vec<_>) = near.filter(|(p, _)| within(p)).unzip();
        let span = |k: usize| [at[k] - reach, at[k] + reach];
        let near = Picture {
            window: Some([span(0), span(up)]),
            range: range(&values),
            points: &points,
            values: &values,
            ..whole.clone()
        };
        save(&near, BAD_STATE_NEAR);
    }
    written
}

/// Between which values nearly all lie; none if they are all alike.
fn range(values: &[f64]) -> Option<[f64; 2]> {
    let mut finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    finite.sort_by(f64::total_cmp);
    let last = finite.len().checked_sub(1)?;
    let cut = (BEYOND * finite.len() as f64).ceil() as usize;
    let cut = cut.min(last / 2);
    let ends = [finite[cut], finite[last - cut]];
    (ends[0] < ends[1] && (ends[1] - ends[0]).is_finite()).then_some(ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_value_beyond_all_others_does_not_stretch_the_colours() {
        let mut values: Vec<f64> = (0..200).map(f64::from).collect();
        values.extend([1e300, f64::NAN, f64::NEG_INFINITY]);
        assert_eq!(range(&values), Some([3.0, 197.0]));
        assert_eq!(range(&[1.0, 1.0]), None);
        assert_eq!(range(&[f64::NAN]), None);
    }
}
