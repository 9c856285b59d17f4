//! The frames of a run, and one of them with its columns.

use std::path::{Path, PathBuf};

use sph_core::{Corners, bounds};

use crate::curves::{Cloud, DrawError, Result};
use crate::{Cells, FieldData, FieldValues, Location, Picture, Piece, View};

/// One frame: its time and its files.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Simulated time, s.
    pub time: f64,
    /// File of the particles.
    pub particles: PathBuf,
    /// File of the walls, if there are any.
    pub walls: Option<PathBuf>,
}

/// All frames of a run in the order of their times.
#[derive(Clone, Debug)]
pub struct Frames {
    /// The frames, at least one.
    pub entries: Vec<Entry>,
    /// Distance of particles at the start, m: the median distance to the nearest one.
    pub spacing: f64,
}

/// Largest number of frames for a range of colours.
const FRAMES: usize = 20;

/// Particles whose nearest neighbour is looked for.
const SAMPLED: usize = 200;

impl Frames {
    /// Those that `fields.pvd` of a folder lists.
    ///
    /// # Errors
    /// If there are none, or the list or the first frame cannot be read.
    pub fn from_folder(folder: &Path) -> Result<Self> {
        let mut entries: Vec<Entry> = Vec::new();
        for listed in crate::list_pvd(folder.join("fields.pvd"))? {
            let walls = listed.name == "walls";
            match entries.iter_mut().find(|e| e.time == listed.time) {
                Some(entry) if walls => entry.walls = Some(listed.path),
                None if !walls => entries.push(Entry {
                    time: listed.time,
                    particles: listed.path,
                    walls: None,
                }),
                _ => {}
            }
        }
        entries.sort_by(|a, b| a.time.total_cmp(&b.time));
        let none = || format!("{} holds no frames of particles", folder.display());
        let first = (entries.first()).ok_or_else(|| DrawError::Unfit(none()))?;
        let (piece, _) = crate::read_piece(&first.particles)?;
        let spacing = spacing(&piece.points);
        Ok(Frames { entries, spacing })
    }

    /// The frame nearest to a time (s), or the last one.
    pub fn at(&self, time: Option<f64>) -> &Entry {
        let last = &self.entries[self.entries.len() - 1];
        let Some(time) = time else { return last };
        let apart = |e: &Entry| (e.time - time).abs();
        let all = self.entries.iter();
        let nearest = all.min_by(|a, b| apart(a).total_cmp(&apart(b)));
        nearest.unwrap_or(last)
    }

    /// The range of colours of a field that suits all frames, or twenty of them if there are more: round numbers that hold
    /// 98 % of the values.
    ///
    /// # Errors
    /// A field that was not written, a file that cannot be read.
    pub fn range(&self, field: &str) -> Result<Option<[f64; 2]>> {
        let every = self.entries.len().div_ceil(FRAMES).max(1);
        let mut values = Vec::new();
        // From the last one back, which is the most frequent request.
        for entry in self.entries.iter().rev().step_by(every) {
            values.extend(self.read(entry)?.column(field)?.values);
        }
        let range = crate::ColourRanges::default().next(field, &values);
        Ok(range.map(|(range, _)| range))
    }

    /// Reads a frame.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(&self, entry: &Entry) -> Result<Snapshot> {
        let (piece, time) = crate::read_piece(&entry.particles)?;
        let walls = match &entry.walls {
            Some(path) => drawn(&crate::read_piece(path)?.0, self.spacing),
            None => Vec::new(),
        };
        Ok(Snapshot {
            piece,
            time,
            walls,
            spacing: self.spacing,
        })
    }
}

/// The segments of walls in the plane. One whose ends are a period apart is drawn at neither side.
fn drawn(piece: &Piece<'_>, spacing: f64) -> Vec<[[f64; 3]; 2]> {
    let Cells::Segments(ends) = &piece.cells else {
        return Vec::new();
    };
    let all = ends.iter().map(|e| e.map(|k| piece.points[k as usize]));
    all.filter(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1]) < 3.0 * spacing)
        .collect()
}

/// The median of the distances to the nearest point, m.
fn spacing(points: &[[f64; 3]]) -> f64 {
    let step = points.len().div_ceil(SAMPLED).max(1);
    let mut nearest: Vec<f64> = Vec::new();
    for (k, x) in points.iter().enumerate().step_by(step) {
        let others = points.iter().enumerate().filter(|(j, _)| *j != k);
        let apart = |r: &[f64; 3]| (0..3).map(|i| (r[i] - x[i]).powi(2)).sum();
        let all = others.map(|(_, r)| apart(r));
        nearest.push(all.fold(f64::INFINITY, f64::min));
    }
    nearest.sort_by(f64::total_cmp);
    let middle = nearest.get(nearest.len() / 2).copied().unwrap_or(1.0);
    let apart = middle.is_finite() && middle > 0.0;
    if apart { middle.sqrt() } else { 1.0 }
}

/// Particles at one time.
pub struct Snapshot {
    pub(crate) piece: Piece<'static>,
    /// Simulated time, s.
    pub time: f64,
    /// Walls in the plane, by their ends, m.
    pub walls: Vec<[[f64; 3]; 2]>,
    /// Distance of particles at the start, m.
    pub spacing: f64,
}

/// The box around the finite coordinates of points; zero along an axis without a finite coordinate.
pub(crate) fn finite_bounds<'p>(points: impl Iterator<Item = &'p [f64; 3]>) -> Corners<3> {
    let finite = |x: f64| if x.is_finite() { x } else { f64::NAN };
    let ends = bounds(points.map(|point| point.map(finite)));
    ends.map(|corner| corner.map(|x| if x.is_finite() { x } else { 0.0 }))
}

/// One number per particle.
pub struct Column {
    /// The request, with spaces and its unit: `velocity x [m/s]`.
    pub label: String,
    /// Unit.
    pub unit: String,
    /// The numbers.
    pub values: Vec<f64>,
}

impl Snapshot {
    /// Positions of the particles, m.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.piece.points
    }

    pub(crate) fn bounds(&self) -> Corners<3> {
        finite_bounds(self.points().iter())
    }

    /// The particles sorted for values between them.
    pub fn cloud(&self) -> Cloud<'_> {
        Cloud::new(self.points(), self.spacing)
    }

    /// Identities of the particles.
    ///
    /// # Errors
    /// If identities were not written.
    pub fn identities(&self) -> Result<Vec<u32>> {
        match &self.field("identity")?.data {
            FieldValues::U32(v) => Ok(v.to_vec()),
            _ => Err(self.missing("identity")),
        }
    }

    /// The three components of the velocity, m/s, particle after particle.
    ///
    /// # Errors
    /// If the velocity was not written.
    pub fn velocity(&self) -> Result<Vec<f64>> {
        let field = self.field("velocity")?;
        match field.components {
            3 => Ok(field.data.reals()),
            _ => Err(self.missing("velocity")),
        }
    }

    /// A field, of vectors and tensors the length; or a component of it, `velocity.x` or `strain.4`. `speed` is there
    /// wherever the velocity is.
    ///
    /// # Errors
    /// If no such field was written, or it has no such component.
    pub fn column(&self, asked: &str) -> Result<Column> {
        let (name, component) = asked.split_once('.').unzip();
        let name = name.unwrap_or(asked);
        let field = match (name, self.field(name)) {
            ("speed", Err(_)) => self.field("velocity"),
            (_, found) => found,
        }?;
        let all = field.data.reals();
        let per = field.components;
        let one = |component: &str| {
            let axis = ["x", "y", "z"].iter().position(|a| *a == component);
            let place = axis.or_else(|| component.parse().ok());
            let none = || format!("`{name}` has {per} components, and no `{component}`");
            let place = place.filter(|k| *k < per);
            place.ok_or_else(|| DrawError::Unfit(none()))
        };
        let values = match component.map(one).transpose()? {
            Some(k) => all.chunks(per).map(|c| c[k]).collect(),
            None if per == 1 => all,
            None => {
                let size = |c: &[f64]| c.iter().map(|x| x * x).sum::<f64>().sqrt();
                all.chunks(per).map(size).collect()
            }
        };
        let (unit, name) = (field.unit.to_string(), asked.replace(['_', '.'], " "));
        let label = match unit.as_str() {
            "1" | "" => name,
            unit => format!("{name} [{unit}]"),
        };
        Ok(Column {
            label,
            unit,
            values,
        })
    }

    fn field(&self, name: &str) -> Result<&FieldData<'static>> {
        let at_points = |f: &&FieldData| f.name == name && f.location == Location::Point;
        let found = self.piece.fields.iter().find(at_points);
        found.ok_or_else(|| self.missing(name))
    }

    fn missing(&self, name: &str) -> DrawError {
        let known: Vec<&str> = self.piece.fields.iter().map(|f| f.name.as_ref()).collect();
        DrawError::Unfit(format!(
            "no field `{name}` was written (there are: {}); name it in output.fields and run again",
            known.join(", ")
        ))
    }

    /// The picture of points with values between the walls, to be completed.
    pub(crate) fn picture<'a>(&'a self, points: &'a [[f64; 3]], values: &'a [f64]) -> Picture<'a> {
        let planar = self.points().iter().all(|p| p[2] == 0.0);
        Picture {
            time: Some(self.time),
            diameter: self.spacing,
            walls: &self.walls,
            view: if planar { View::Plane } else { View::Front },
            ..Picture::new(points, values)
        }
    }
}
