//! Lines of a bed: free surface, water–sediment interface, failure line and limit of motion, drawn or compared.

use sph_core::{StepError, Vect, bounds, fields, parameters, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, CountedPhase};
use crate::{Curves, Needs, Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Three curves over a movable bed, moving mass of it (kg, per metre of width), and lowest point of the motion (m).
///
/// A grain moves if its speed |u| is above `threshold` = Δx/Δt, one pixel of the experiment's
/// camera in one of its images: 1 mm in 5 ms. Columns are two spacings wide, and in every one
/// * `surface` is half a spacing above the highest particle of all,
/// * `interface` half a spacing above the highest grain,
/// * `limit` half a spacing below the lowest grain that moves; the interface where none does.
///
/// Between the particles of neighbouring columns the curves are straight; they are given at the
/// middles of the columns from the first particle to the last, and NaN where there is none. With every
/// output of fields they go to `curves/NAME_0003.csv`, numbered as the pictures, with the columns x,
/// surface, interface and limit in m. `line` compares any of the three with a drawn one.
///
/// The lowest point is that of the limit where something moves, NaN where nothing does. A single
/// grain that moves deep in the bed draws the limit down to it. Two dimensions only.
///
/// Source: Ghaïtanellis 2017, §5.4.1 and Eq. 5.21.
///
/// ```toml
/// [probe.bed]
/// kind = "bed-lines"
/// phase = "sand"
/// ```
#[plugin(ProbeEntry [2], "bed-lines", "free surface, interface and limit of motion over a movable bed, as curves",
    source: "outermost particles; Ghaïtanellis 2017, Eq. 5.21")]
pub struct BedLines {
    /// Name of the phase that makes the bed.
    pub phase: String,
    /// Speed above which a grain moves.
    #[parameter(default: 0.2, unit: "m/s", above: 0.0, source: "Ghaïtanellis 2017, Eq. 5.21")]
    pub threshold: f64,
    #[serde(skip)]
    number: Option<u32>,
}

impl BedLines {
    /// Surface, interface and lowest moving grains, and the moving mass, kg.
    fn draw(&self, world: &World<2>) -> Result<([Columns; 3], f64), StepError> {
        let bed = CountedPhase::in_phase(world, Some(&self.phase), self.number)?;
        let (positions, velocity) = world.free.all((fields::POSITION, fields::VELOCITY))?;
        let mass = world.free.get(fields::MASS)?;
        let xs = || positions.iter().map(|x: &Vect<2>| x[0]);
        let ends = [HIGHEST, HIGHEST, LOWEST];
        let mut drawn = ends.map(|end| Columns::over(xs(), world.spacing, end));
        let [surface, interface, moving] = &mut drawn;
        let mut moving_mass = 0.0;
        for (k, x) in positions.iter().enumerate() {
            surface.put(x);
            if !bed.has(k) {
                continue;
            }
            interface.put(x);
            if velocity[k].norm() > self.threshold {
                moving.put(x);
                moving_mass += mass[k];
            }
        }
        Ok((drawn, moving_mass))
    }
}

impl Probe<2> for BedLines {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".moving", "kg"), (".lowest", "m")])
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(Some(&self.phase), scene)?;
        Ok(())
    }

    fn measure(&self, world: &World<2>) -> Result<Vec<f64>, StepError> {
        let ([.., moving], mass) = self.draw(world)?;
        let heights = moving.places.iter().flatten().map(|place| place[1]);
        Ok(vec![mass, heights.fold(f64::NAN, f64::min)])
    }

    fn as_curves(&self) -> Option<&dyn Curves<2>> {
        Some(self)
    }
}

impl Curves<2> for BedLines {
    fn curve_columns(&self) -> Vec<ProbeColumn> {
        let names = ["x", "surface", "interface", "limit"];
        names.map(|name| ProbeColumn::named(name, "m")).into()
    }

    fn curves(&self, world: &World<2>) -> Result<Vec<Vec<f64>>, StepError> {
        let ([surface, interface, moving], _) = self.draw(world)?;
        let limit = moving.or(&interface);
        let lines = [&surface, &interface, &limit];
        let row = |x: f64| {
            let heights = lines.map(|line| line.height(x).unwrap_or(f64::NAN));
            [x].into_iter().chain(heights).collect()
        };
        Ok(surface.middles().map(row).collect())
    }
}

/// Line of a body of soil.
#[parameters]
#[serde(rename_all = "lowercase")]
pub enum LineOf {
    /// Over all particles.
    #[default]
    Surface,
    /// Over those that have hardly moved since the start.
    Failure,
    /// Under those that move now.
    Limit,
}

/// Root mean square of the height of a line over a reference's, at the reference's points, the share of these points
/// where there is a line, and the root mean square of their distances from it, in any direction.
///
/// The line goes through the highest particle of every column of two spacings' width, half a spacing above it; with `of
/// = "failure"` through the highest that has moved by less than `moved` since the start, wherever that is: the limit
/// between the soil that failed and that which did not. With `of = "limit"` it goes half a spacing under the lowest
/// particle of a column that is faster than `threshold` now, and along the surface where none is: the limit of a moving
/// bed (`bed-lines`). Between two particles the line is straight, beyond the last ones level; a column without a
/// particle interrupts it. Points of the reference without a line do not count in the first and the last value: read
/// the share, too. Without any they are NaN. A steep line is nearer than it is high.
///
/// Displacements are kept for such probes only.
///
/// Source: ours; the thresholds as in Ghaïtanellis 2017, §5.3.2 and Eq. 5.21.
///
/// ```toml
/// [probe.failure]
/// kind = "line"
/// of = "failure"
/// moved = "1.5 mm"
/// file = "data/bui2008_final_failure.csv"
/// ```
#[plugin(ProbeEntry [2], "line", "free surface, failure line or limit of motion of a phase against a drawn line",
    source: "highest particles; Ghaïtanellis 2017, §5.3.2, Eq. 5.21")]
pub struct Line {
    /// The line: `surface`, `failure` or `limit`.
    #[parameter(default)]
    pub of: LineOf,
    /// CSV file of the reference, relative to the scene's folder: x and y in m.
    pub file: String,
    /// Displacement from which on a particle has failed.
    #[parameter(default: 1.5e-3, unit: "m", above: 0.0, source: "Ghaïtanellis 2017, §5.3.2")]
    pub moved: f64,
    /// Speed above which a particle moves, for `of = "limit"`.
    #[parameter(default: 0.2, unit: "m/s", above: 0.0, source: "Ghaïtanellis 2017, Eq. 5.21")]
    pub threshold: f64,
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    #[serde(skip)]
    number: Option<u32>,
    #[serde(skip)]
    reference: Vec<[f64; 2]>,
}

impl Line {
    fn drawn(&self, world: &World<2>) -> Result<Columns, StepError> {
        let counted = CountedPhase::in_phase(world, self.phase.as_deref(), self.number)?;
        let positions = world.free.get(fields::POSITION)?;
        // Particles far away from the reference make no columns: these must fit into memory.
        let xs = self.reference.iter().map(|[x, _]| *x);
        let through = |end, has: &dyn Fn(usize) -> bool| {
            let mut columns = Columns::over(xs.clone(), world.spacing, end);
            let all = positions.iter().enumerate();
            all.filter(|(k, _)| counted.has(*k) && has(*k))
                .for_each(|(_, x)| columns.put(x));
            columns
        };
        Ok(match self.of {
            LineOf::Surface => through(HIGHEST, &|_| true),
            LineOf::Failure => {
                let moved = world.free.get(fields::DISPLACEMENT)?;
                through(HIGHEST, &|k| moved[k].norm() < self.moved)
            }
            LineOf::Limit => {
                let velocity = world.free.get(fields::VELOCITY)?;
                let moves = |k: usize| velocity[k].norm() > self.threshold;
                through(LOWEST, &moves).or(&through(HIGHEST, &|_| true))
            }
        })
    }
}

impl Probe<2> for Line {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".rms", "m"), (".share", "1"), (".distance", "m")])
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(self.phase.as_deref(), scene)?;
        Ok(())
    }

    fn file(&self) -> Option<&str> {
        Some(&self.file)
    }

    fn load_reference(&mut self, rows: Vec<[f64; 2]>) -> Result<(), String> {
        if rows.is_empty() || rows.iter().flatten().any(|v| !v.is_finite()) {
            return Err("is no line: expected rows of x and y".into());
        }
        self.reference = rows;
        Ok(())
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            displacement: self.of == LineOf::Failure,
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<2>) -> Result<Vec<f64>, StepError> {
        let line = self.drawn(world)?;
        let (mut heights, mut distances, mut count) = (0.0, 0.0, 0_usize);
        for [x, y] in &self.reference {
            if let (Some(height), Some(distance)) = (line.height(*x), line.distance([*x, *y])) {
                heights += (height - y).powi(2);
                distances += distance.powi(2);
                count += 1;
            }
        }
        let rms = |squares: f64| match count {
            0 => f64::NAN,
            count => (squares / count as f64).sqrt(),
        };
        let share = count as f64 / self.reference.len().max(1) as f64;
        Ok(vec![rms(heights), share, rms(distances)])
    }
}

/// Width of a column in spacings: particles that have moved apart by more than one leave narrower
/// columns empty down to the rows below.
const WIDTH: f64 = 2.0;

/// Most columns; a reference may have a wrong unit.
const MOST: f64 = 1e6;

/// Line half a spacing above the highest particle of every column, and half a spacing below the lowest.
const HIGHEST: f64 = 1.0;
const LOWEST: f64 = -1.0;

/// The outermost place of every column of two spacings' width.
struct Columns {
    /// `HIGHEST` or `LOWEST`.
    sign: f64,
    spacing: f64,
    first: f64,
    places: Vec<Option<[f64; 2]>>,
}

impl Columns {
    /// Columns over some places, m, and one more on either side; nothing stands in them yet.
    fn over(xs: impl Iterator<Item = f64>, spacing: f64, sign: f64) -> Self {
        let [[low], [high]] = bounds(xs.map(|x| [x]));
        let width = WIDTH * spacing;
        let first = (low / width).floor() - 1.0;
        let count = (high / width).floor() + 2.0 - first;
        Columns {
            sign,
            spacing,
            first,
            places: vec![None; count.clamp(0.0, MOST) as usize],
        }
    }

    fn column(&self, x: f64) -> f64 {
        (x / (WIDTH * self.spacing)).floor() - self.first
    }

    /// Puts a particle into its column; those beyond the columns are left out.
    fn put(&mut self, x: &Vect<2>) {
        let column = self.column(x[0]);
        if column < 0.0 || column >= self.places.len() as f64 {
            return;
        }
        let sign = self.sign;
        let place = &mut self.places[column as usize];
        let here = [x[0], x[1] + sign * 0.5 * self.spacing];
        // Of equals the first in space, whatever the order of the particles.
        if place.is_none_or(|p| (sign * here[1], -here[0]) > (sign * p[1], -p[0])) {
            *place = Some(here);
        }
    }

    /// These places, and where there is none those of others of the same columns.
    fn or(mut self, others: &Columns) -> Self {
        for (place, other) in self.places.iter_mut().zip(&others.places) {
            *place = place.or(*other);
        }
        self
    }

    /// Height of the line at x, m: straight between two places, level beyond the last ones; none in
    /// a column without a place.
    fn height(&self, x: f64) -> Option<f64> {
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
    fn distance(&self, point: [f64; 2]) -> Option<f64> {
        let pairs = self.places.windows(2).filter_map(|w| Some([w[0]?, w[1]?]));
        let alone = self.places.iter().flatten().map(|place| [*place; 2]);
        let distances = pairs.chain(alone).map(|ends| from_stretch(point, ends));
        distances.reduce(f64::min)
    }

    /// Middles of the columns, m, without the additional ones at the ends.
    fn middles(&self) -> impl Iterator<Item = f64> {
        let inner = 1..self.places.len().saturating_sub(1);
        inner.map(|k| (self.first + k as f64 + 0.5) * WIDTH * self.spacing)
    }
}

/// Distance of a point from the straight line between two places, m.
fn from_stretch(point: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let off = [point[0] - from[0], point[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let part = match square > 0.0 {
        true => ((off[0] * along[0] + off[1] * along[1]) / square).clamp(0.0, 1.0),
        false => 0.0,
    };
    (off[0] - part * along[0]).hypot(off[1] - part * along[1])
}
