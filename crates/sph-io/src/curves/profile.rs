//! A field along a straight line.

use std::path::Path;

use crate::curves::{Frames, PLACE, Result, Snapshot, write_beside};
use crate::{Plot, Series};

/// A straight line with points on it.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Start of the line, m.
    pub from: [f64; 3],
    /// End of the line, m.
    pub to: [f64; 3],
    /// Points on it, evenly spread with both ends; at least two.
    pub points: usize,
}

impl Line {
    /// Distance from the start and place of every point, m.
    fn places(&self) -> impl Iterator<Item = (f64, [f64; 3])> {
        let apart = [0, 1, 2].map(|k| self.to[k] - self.from[k]);
        let length = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
        let count = self.points.max(2);
        (0..count).map(move |k| {
            let along = k as f64 / (count - 1) as f64;
            let place = [0, 1, 2].map(|i| self.from[i] + along * apart[i]);
            (along * length, place)
        })
    }
}

impl Snapshot {
    /// Distance from the start (m) and value of a column at the points of a line; NaN outside of the fluid.
    pub fn profile(&self, line: &Line, values: &[f64]) -> Vec<[f64; 2]> {
        let cloud = self.cloud();
        let at = |(distance, place)| {
            let weights = cloud.weights(place);
            let sum = weights.map(|all| all.iter().map(|(j, w)| w * values[*j as usize]).sum());
            [distance, sum.unwrap_or(f64::NAN)]
        };
        line.places().map(at).collect()
    }
}

/// Draws a field along a line at several times (s) into a picture, `.png` or `.svg`, and writes a table beside it. The
/// times are those of the frames nearest to them.
///
/// # Errors
/// A field that was not written, a file that cannot be.
pub fn draw_profile(
    frames: &Frames,
    line: &Line,
    field: &str,
    times: &[Option<f64>],
    path: &Path,
) -> Result<()> {
    let mut plot = Plot {
        x_label: "distance [m]".into(),
        ..Plot::default()
    };
    let mut rows = Vec::new();
    let mut unit = String::new();
    for time in times {
        let snapshot = frames.read(frames.at(*time))?;
        let column = snapshot.column(field)?;
        let points = snapshot.profile(line, &column.values);
        for ([distance, value], (_, [x, y, z])) in points.iter().zip(line.places()) {
            rows.push(vec![snapshot.time, *distance, x, y, z, *value]);
        }
        plot.y_label = column.label;
        unit = column.unit;
        let time = format!("{:.6}", snapshot.time);
        let time = time.trim_end_matches('0').trim_end_matches('.');
        let name = format!("t = {time} s");
        plot.series.push(Series::line(name, points));
    }
    plot.save(path)?;
    let columns = [("time", "s"), ("distance", "m")].into_iter().chain(PLACE);
    write_beside(path, columns.chain([(field, &*unit)]), rows.into_iter())
}
