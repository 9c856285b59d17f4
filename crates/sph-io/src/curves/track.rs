//! Tracks of single particles, and a field along a straight line.

use std::path::Path;

use crate::curves::frames::finite_bounds;
use crate::curves::{DrawError, Frames, PLACE, Result, Snapshot, write_beside};
use crate::{Plot, Series};

/// The places of a particle, frame by frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Identity of the particle.
    pub identity: u32,
    /// Time (s) and place (m) in every frame that has it.
    pub places: Vec<(f64, [f64; 3])>,
}

/// The tracks of particles through all frames, in the order in which they are named.
///
/// # Errors
/// A frame that cannot be read, an identity that no frame has.
pub fn tracks(frames: &Frames, identities: &[u32]) -> Result<Vec<Track>> {
    let start = |&identity: &u32| Track {
        identity,
        places: Vec::new(),
    };
    let mut all: Vec<Track> = identities.iter().map(start).collect();
    for entry in &frames.entries {
        let snapshot = frames.read(entry)?;
        for (identity, place) in snapshot.identities()?.iter().zip(snapshot.points()) {
            // Few are followed: a list is as good as a map.
            for track in all.iter_mut().filter(|t| t.identity == *identity) {
                track.places.push((snapshot.time, *place));
            }
        }
    }
    if let Some(Track { identity, .. }) = all.iter().find(|t| t.places.is_empty()) {
        let said = format!("no frame has a particle of identity {identity}");
        return Err(DrawError::Unfit(said));
    }
    Ok(all)
}

/// The identity of the particle that is nearest to a place (m).
///
/// # Errors
/// If identities were not written, or there is no particle.
pub fn nearest(snapshot: &Snapshot, place: [f64; 3]) -> Result<u32> {
    let identities = snapshot.identities()?;
    let apart = |r: &[f64; 3]| (0..3).map(|k| (r[k] - place[k]).powi(2)).sum::<f64>();
    let all = snapshot.points().iter().map(apart).zip(identities);
    let found = all.min_by(|a, b| a.0.total_cmp(&b.0));
    let none = || DrawError::Unfit("there is no particle".into());
    found.map(|(_, identity)| identity).ok_or_else(none)
}

/// `count` identities, evenly spread over those of a frame.
///
/// # Errors
/// If identities were not written.
pub fn evenly(snapshot: &Snapshot, count: usize) -> Result<Vec<u32>> {
    let mut all = snapshot.identities()?;
    all.sort_unstable();
    let count = count.min(all.len());
    let at = |k: usize| all[(2 * k + 1) * all.len() / (2 * count)];
    Ok((0..count).map(at).collect())
}

/// Draws tracks over a field of the last frame into a picture, `.png`, and writes a table beside it.
///
/// # Errors
/// A field that was not written, a file that cannot be.
pub fn draw_tracks(frames: &Frames, tracks: &[Track], field: &str, path: &Path) -> Result<()> {
    let snapshot = frames.read(frames.at(None))?;
    let column = snapshot.column(field)?;
    let along = tracks.iter().flat_map(|t| t.places.iter().map(|(_, x)| x));
    let [low, high] = finite_bounds(along.chain(snapshot.points()));
    let half = [0, 1, 2].map(|k| 0.5 * (high[k] - low[k]));
    let lines: Vec<Vec<[f64; 3]>> = tracks.iter().flat_map(|t| unbroken(t, half)).collect();
    let picture = crate::Picture {
        label: &column.label,
        lines: &lines,
        range: frames.range(field)?,
        ..snapshot.picture(snapshot.points(), &column.values)
    };
    picture.save(path)?;
    let rows = tracks.iter().flat_map(|t| {
        let identity = f64::from(t.identity);
        let places = t.places.iter();
        places.map(move |(time, [x, y, z])| vec![identity, *time, *x, *y, *z])
    });
    let columns = [("identity", "1"), ("time", "s")].into_iter().chain(PLACE);
    write_beside(path, columns, rows)
}

/// The pieces of a track between jumps across a periodic border: steps longer than half of everything along an axis.
fn unbroken(track: &Track, longest: [f64; 3]) -> Vec<Vec<[f64; 3]>> {
    let mut pieces: Vec<Vec<[f64; 3]>> = Vec::new();
    for (_, place) in &track.places {
        let near = |before: &[f64; 3]| (0..3).all(|k| (before[k] - place[k]).abs() <= longest[k]);
        match pieces.last_mut() {
            Some(piece) if piece.last().is_some_and(near) => piece.push(*place),
            _ => pieces.push(vec![*place]),
        }
    }
    pieces
}

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
