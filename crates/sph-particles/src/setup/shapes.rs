//! The scene's walls and bodies as geometry: files read, shapes drawn.

use std::sync::Arc;

use sph_boundary::{
    Bend, BoundaryError, Course, Drawing, Polyline, RigidMotion, Surface, WallSpec, thin_plate,
};
use sph_core::plausible::Quantity;
use sph_core::{Erodible, Vect, suggestion, unit_factor};
use sph_scene::{Facets, Levels, Line, Region, Scene};
use sph_solver::SolverError;

/// Most corners of lines, or facets of surfaces, of all walls.
const PIECES: usize = 10_000_000;
/// Spacings over which walls in a bed stretch, where the scene does not say it.
const STRETCH: f64 = 10.0;

/// Refuses the wall with which there are too many corners or facets.
fn few(pieces: usize, place: &str) -> Result<(), SolverError> {
    let why = format!("with this wall there are {pieces} corners or facets, more than {PIECES}");
    match pieces > PIECES {
        false => Ok(()),
        true => Err(SolverError::at(place, why)),
    }
}

/// Walls and bodies.
#[derive(Default)]
pub struct Drawn<const D: usize> {
    /// The walls; one that is drawn in several pieces is there once per piece.
    pub walls: Vec<WallSpec<D>>,
    /// Box around all walls, m.
    pub bounds: Option<([f64; D], [f64; D])>,
    /// Length or area of all walls, m^(D−1).
    pub measure: f64,
    /// The regions of the bodies, in the order of their names.
    pub regions: Vec<Region<D>>,
}

impl<const D: usize> Drawn<D> {
    /// Reads files and draws shapes.
    pub fn from_scene(scene: &Scene) -> Result<Self, SolverError> {
        let mut drawn = Drawn::default();
        let mut pieces = 0;
        // Those of shapes are known before any is drawn.
        for (name, wall) in &scene.wall {
            pieces += wall.declared(scene.numerics.spacing);
            few(pieces, &format!("wall.{name}"))?;
        }
        for (name, wall) in &scene.wall {
            let place = format!("wall.{name}");
            let mut motion = match &wall.motion {
                None => RigidMotion::default(),
                Some(motion) => match &motion.levels {
                    Some(levels) => levels_of(levels, &format!("{place}.motion.levels"))?,
                    None => rigid_motion(motion, &format!("{place}.motion"), scene.run.end)?,
                },
            };
            let own_bed = wall.erodible.as_ref().map(|_| name.clone());
            motion.bed = wall.stands_in.clone().or(own_bed);
            let spacing = scene.numerics.spacing;
            let erodible = wall.erodible.clone().map(|bed| Erodible {
                cell: bed.cell.or(Some(spacing)),
                stretch: bed.stretch.or(Some(STRETCH * spacing)),
                ..bed
            });
            let surface = wall.velocity.as_deref();
            let surface_velocity = surface.map_or_else(Vect::zeros, Vect::from_column_slice);
            for drawing in drawn.drawings(scene, name, wall, &place)? {
                if wall.path.is_some() {
                    pieces += match &drawing {
                        Drawing::Line(line) => line.points.len(),
                        Drawing::Surface(surface) => surface.triangles.len(),
                    };
                    few(pieces, &place)?;
                }
                drawn.near(scene.numerics.spacing, &place)?;
                drawn.walls.push(WallSpec {
                    drawing,
                    condition: wall.condition,
                    surface_velocity,
                    motion: motion.clone(),
                    erodible: erodible.clone(),
                    mover: None,
                    open: false,
                });
            }
        }
        drawn.regions = scene.regions_within(drawn.bounds)?;
        Ok(drawn)
    }

    fn drawings(
        &mut self,
        scene: &Scene,
        name: &str,
        wall: &sph_scene::Wall,
        place: &str,
    ) -> Result<Vec<Drawing>, SolverError> {
        let spacing = scene.numerics.spacing;
        if D == 3 {
            let Facets { points, triangles } = wall.facets(place, spacing)?;
            points.iter().for_each(|p| self.include(p));
            let area = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|c| Vect::from(points[c as usize]));
                0.5 * (b - a).cross(&(c - a)).norm()
            };
            self.measure += triangles.iter().map(area).sum::<f64>();
            let name = name.to_string();
            return Ok(vec![Drawing::Surface(Surface {
                name,
                points,
                triangles,
            })]);
        }
        let lines = wall.lines(place, spacing)?;
        let line = |Line { points, closed }: Line| -> Result<Drawing, SolverError> {
            points.iter().for_each(|p| self.include(p));
            let line = match wall.thickness {
                Some(thickness) => {
                    let refused = |e: BoundaryError| SolverError::at(place, e.to_string());
                    thin_plate(name, &points, thickness).map_err(refused)?
                }
                None => Polyline {
                    name: name.to_string(),
                    points,
                    closed,
                },
            };
            self.measure += line.lengths().sum::<f64>();
            Ok(Drawing::Line(line))
        };
        lines.into_iter().map(line).collect()
    }

    /// Refuses the wall with which places are so far away that positions there are rounded.
    fn near(&self, spacing: f64, place: &str) -> Result<(), SolverError> {
        let corners = self.bounds.iter().flat_map(|(low, high)| [low, high]);
        let far = (corners.flatten()).fold(0.0, |far: f64, x| far.max(x.abs()));
        match Quantity::refused("distance over the spacing", far / spacing) {
            Some(why) => Err(SolverError::at(place, why)),
            None => Ok(()),
        }
    }

    fn include(&mut self, x: &[f64]) {
        let point: [f64; D] = std::array::from_fn(|k| x[k]);
        let (low, high) = self.bounds.get_or_insert((point, point));
        for k in 0..D {
            low[k] = low[k].min(point[k]);
            high[k] = high[k].max(point[k]);
        }
    }
}

/// A table that a run of `end` seconds does not outlast goes on by two rows, on the parabola of its last three: else
/// it would be brought to rest in its last interval.
fn going_on(mut rows: Vec<[f64; 2]>, end: f64) -> Vec<[f64; 2]> {
    if let [.., a, b, c] = rows[..]
        && end <= c[0]
    {
        let slope = |p: [f64; 2], q: [f64; 2]| (q[1] - p[1]) / (q[0] - p[0]);
        let bend = (slope(b, c) - slope(a, b)) / (c[0] - a[0]);
        let step = c[0] - b[0];
        let rise = slope(b, c) + bend * step;
        for ahead in [step, 2.0 * step] {
            rows.push([c[0] + ahead, c[1] + ahead * (rise + bend * ahead)]);
        }
    }
    rows
}

/// Translations and a rotation of a motion that follows no levels; `place` is its path in the scene, `end` the end of the run,
/// s.
pub fn rigid_motion<const D: usize>(
    motion: &sph_scene::Motion,
    place: &str,
    end: f64,
) -> Result<RigidMotion<D>, SolverError> {
    let (mut translations, mut rotation) = motion.courses(place)?;
    let shifts = translations.iter_mut().map(|t| &mut t.course);
    let turns = rotation.iter_mut().map(|r| &mut r.course);
    for course in shifts.chain(turns) {
        if let Course::Table { rows } = course {
            *rows = going_on(rows.to_vec(), end - motion.start).into();
        }
    }
    Ok(RigidMotion {
        translations,
        rotation,
        start: motion.start,
        stop: motion.stop.unwrap_or(f64::INFINITY),
        ..RigidMotion::default()
    })
}

/// The bend of a wall that follows levels: at each place their rise since the start of the run.
fn levels_of<const D: usize>(levels: &Levels, place: &str) -> Result<RigidMotion<D>, SolverError> {
    let at = |key: &str, why: String| SolverError::at(format!("{place}.{key}"), why);
    let Some(path) = &levels.path else {
        return Err(at("file", "the table is missing".to_string()));
    };
    let table = sph_io::read_table(path).map_err(|e| at("file", e.to_string()))?;
    let column = |key: &str, name: &str| {
        let near = || suggestion(name, table.columns.iter().map(|c| c.name.as_str()));
        let why = || format!("the table has no column `{name}`{}", near());
        table.column(name).ok_or_else(|| at(key, why()))
    };
    let times = column("file", "time")?;
    if times.last().is_none_or(|last| *last <= levels.start) {
        let why = format!("the table has no row after {} s", levels.start);
        return Err(at("start", why));
    }
    let mut lifts = Vec::with_capacity(levels.columns.len());
    for name in &levels.columns {
        let head = table.columns.iter().find(|c| c.name == *name);
        let head = head.map(|c| &*c.unit).filter(|unit| !unit.is_empty());
        let unit = levels.unit.as_deref().or(head);
        let factor = unit.map_or(Ok(1.0), |u| unit_factor(u, "m"));
        let factor = factor.map_err(|why| at("columns", why))?;
        let rows = times.iter().zip(column("columns", name)?);
        let rows: Arc<[[f64; 2]]> = rows.map(|(t, z)| [t - levels.start, factor * *z]).collect();
        let whole = Course::Table { rows: rows.clone() };
        if !whole.is_sound() {
            let why = "it needs two rows at least, times that rise, and finite numbers";
            return Err(at("file", why.to_string()));
        }
        // Where the wall is drawn is where the level is at the start of the run.
        let begin = rows[0][1] + whole.at(0.0).value;
        let later = rows.iter().filter(|row| row[0] > 0.0);
        let rows = std::iter::once([0.0, begin]).chain(later.copied());
        lifts.push(Course::Table {
            rows: rows.collect(),
        });
    }
    let places = levels.places.clone();
    Ok(RigidMotion {
        bend: Some(Arc::new(Bend { places, lifts })),
        ..RigidMotion::default()
    })
}
