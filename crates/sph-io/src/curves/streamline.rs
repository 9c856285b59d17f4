//! Lines along the velocity of one moment.

use std::path::Path;

use sph_core::place_cells::PlaceCells;

use crate::curves::cloud::square;
use crate::curves::{Cloud, DrawError, Frames, PLACE, Result, write_beside};

/// Length of a step along a line, in spacings.
const STEP: f64 = 0.25;
/// A line ends where another is nearer than that share of the distance between lines.
const CROWDED: f64 = 0.5;
/// A velocity below that share of the largest one has no direction.
const STILL: f64 = 1e-6;
const LONGEST: usize = 20_000;

/// Streamlines of a velocity with three components per particle, some `apart` (m) from each other.
///
/// Lines begin at particles, the fastest ones first, where no other line is within `apart`, and are followed both ways
/// by steps of a quarter of a spacing along u/|u| (Runge–Kutta, fourth order) until they leave the fluid, close, or
/// come nearer than half of `apart` to another. All are in the plane of `flat`, the index of the axis that is left out.
///
/// Source: the rule of distances is that of Jobard & Lefer 1997.
pub fn streamlines(
    cloud: &Cloud<'_>,
    velocity: &[f64],
    flat: usize,
    apart: f64,
) -> Vec<Vec<[f64; 3]>> {
    let (velocities, _) = velocity.as_chunks();
    let fastest = velocities.iter().map(square).fold(0.0, f64::max).sqrt();
    let flow = Flow {
        cloud,
        velocity,
        flat,
        still: STILL * fastest,
    };
    let speed = |k: u32| square(&flow.own(k));
    let mut seeds: Vec<u32> = (0..cloud.points.len() as u32).collect();
    // The same on every machine: particles of one speed keep their order.
    seeds.sort_by(|a, b| speed(*b).total_cmp(&speed(*a)).then(a.cmp(b)));
    let mut drawn = PointCells::new(apart, []);
    let mut lines = Vec::new();
    for seed in seeds {
        let start = cloud.points[seed as usize];
        if near(&drawn, start, apart) {
            continue;
        }
        let line = flow.through(start, &drawn, apart);
        // Shorter ones are blots.
        if line.len() as f64 * STEP * cloud.spacing > apart {
            line.iter().for_each(|x| drawn.add(*x, *x));
            lines.push(line);
        }
    }
    lines
}

struct Flow<'a> {
    cloud: &'a Cloud<'a>,
    velocity: &'a [f64],
    flat: usize,
    still: f64,
}

impl Flow<'_> {
    /// The velocity of a particle in the plane.
    fn own(&self, k: u32) -> [f64; 3] {
        let mut u = [0, 1, 2].map(|i| self.velocity[3 * k as usize + i]);
        u[self.flat] = 0.0;
        u
    }

    /// u/|u|; nothing outside of the fluid and where it stands.
    fn direction(&self, x: [f64; 3]) -> Option<[f64; 3]> {
        let weights = self.cloud.weights(x)?;
        let mut sum = [0.0; 3];
        for (j, w) in weights {
            let u = self.own(j);
            (0..3).for_each(|k| sum[k] += w * u[k]);
        }
        let speed = square(&sum).sqrt();
        (speed > self.still).then(|| sum.map(|u| u / speed))
    }

    /// One step of fourth order.
    fn step(&self, x: [f64; 3], length: f64) -> Option<[f64; 3]> {
        let to = |d: [f64; 3], share: f64| [0, 1, 2].map(|k| x[k] + share * length * d[k]);
        let a = self.direction(x)?;
        let b = self.direction(to(a, 0.5))?;
        let c = self.direction(to(b, 0.5))?;
        let d = self.direction(to(c, 1.0))?;
        Some([0, 1, 2].map(|k| x[k] + length / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k])))
    }

    /// The line through a place, against the flow and along it.
    fn through(&self, start: [f64; 3], drawn: &PointCells, apart: f64) -> Vec<[f64; 3]> {
        let step = STEP * self.cloud.spacing;
        let (mut line, closed) = self.followed(start, step, drawn, apart);
        if closed {
            return line;
        }
        let (mut whole, _) = self.followed(start, -step, drawn, apart);
        whole.reverse();
        whole.pop();
        whole.append(&mut line);
        whole
    }

    /// The points from a place on, and whether they come back to it.
    fn followed(
        &self,
        start: [f64; 3],
        step: f64,
        drawn: &PointCells,
        apart: f64,
    ) -> (Vec<[f64; 3]>, bool) {
        let mut line = vec![start];
        // Its own earlier points, of which the last ones are always near.
        let mut own = PointCells::new(apart, []);
        let lag = (2.0 * apart / step.abs()).ceil() as usize;
        let home = |x: &[f64; 3]| square(&[0, 1, 2].map(|k| x[k] - start[k])).sqrt();
        let crowded = CROWDED * apart;
        while let Some(next) = self.step(line[line.len() - 1], step) {
            if line.len() > 8 && home(&next) < 0.75 * step.abs() {
                line.push(start);
                return (line, true);
            }
            let taken = near(drawn, next, crowded) || near(&own, next, 0.5 * crowded);
            if taken || line.len() == LONGEST {
                break;
            }
            line.push(next);
            // Those around the start are left out, so that a line can close.
            if let Some(past) = line.len().checked_sub(lag + 1).map(|k| line[k])
                && home(&past) > crowded
            {
                own.add(past, past);
            }
        }
        (line, false)
    }
}

type PointCells = PlaceCells<3, [f64; 3]>;

/// True if a point is nearer than `reach`, which is at most a side of a cell.
fn near(points: &PointCells, x: [f64; 3], reach: f64) -> bool {
    let apart = |p: &[f64; 3]| square(&[0, 1, 2].map(|k| p[k] - x[k]));
    points.around(x).any(|p| apart(p) < reach * reach)
}

/// Draws streamlines over a field of the frame nearest to a time (s; the last one if there is none) into a picture,
/// `.png`, and writes their points into a table beside it; the number of lines. `apart` is the distance between lines
/// in m, a 40th of the longer side if there is none. Of a flow in space the slice y = `plane` is shown (m; the middle
/// if there is none).
///
/// # Errors
/// A field that was not written, a file that cannot be.
pub fn draw_streamlines(
    frames: &Frames,
    time: Option<f64>,
    field: &str,
    (apart, plane): (Option<f64>, Option<f64>),
    path: &Path,
) -> Result<usize> {
    let snapshot = frames.read(frames.at(time))?;
    let (velocity, column) = (snapshot.velocity()?, snapshot.column(field)?);
    let cloud = snapshot.cloud();
    let [low, high] = snapshot.bounds();
    let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let apart = apart.unwrap_or(longest / 40.0).max(snapshot.spacing);
    let flat = if cloud.planar { 2 } else { 1 };
    let level = plane.unwrap_or(0.5 * (low[flat] + high[flat]));
    // Lines of a slice begin at its own particles, moved into it.
    let (mut points, mut values, mut moving) = (Vec::new(), Vec::new(), Vec::new());
    for (k, point) in snapshot.points().iter().enumerate() {
        if cloud.planar || (point[flat] - level).abs() <= 0.5 * snapshot.spacing {
            let mut point = *point;
            if !cloud.planar {
                point[flat] = level;
            }
            points.push(point);
            values.push(column.values[k]);
            moving.extend_from_slice(&velocity[3 * k..3 * k + 3]);
        }
    }
    if points.is_empty() {
        return Err(DrawError::Unfit(format!(
            "there are no particles at y = {level} m"
        )));
    }
    let slice = Cloud::new(&points, snapshot.spacing);
    let lines = streamlines(&slice, &moving, flat, apart);
    let mut drawn = lines.clone();
    drawn.extend(lines.iter().filter_map(|l| arrow(l, flat, 0.3 * apart)));
    let picture = crate::Picture {
        label: &column.label,
        lines: &drawn,
        range: frames.range(field)?,
        ..snapshot.picture(&points, &values)
    };
    picture.save(path)?;
    let rows = lines.iter().enumerate().flat_map(|(number, line)| {
        let row = move |[x, y, z]: &[f64; 3]| vec![number as f64, *x, *y, *z];
        line.iter().map(row)
    });
    write_beside(path, [("line", "1")].into_iter().chain(PLACE), rows)?;
    Ok(lines.len())
}

/// The head of an arrow in the middle of a line.
fn arrow(line: &[[f64; 3]], flat: usize, size: f64) -> Option<Vec<[f64; 3]>> {
    let middle = line.len() / 2;
    let (tip, before) = (line.get(middle)?, line.get(middle.checked_sub(2)?)?);
    let up = if flat == 2 { 1 } else { 2 };
    let (dx, dy) = (tip[0] - before[0], tip[up] - before[up]);
    let length = dx.hypot(dy);
    let (dx, dy) = (size * dx / length, size * dy / length);
    let barb = |side: f64| {
        let mut end = *tip;
        end[0] -= dx - 0.5 * side * dy;
        end[up] -= dy + 0.5 * side * dx;
        end
    };
    (length != 0.0).then(|| vec![barb(1.0), *tip, barb(-1.0)])
}
