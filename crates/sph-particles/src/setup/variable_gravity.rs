//! Changes of gravity: given over time, and by the acceleration of the frame that the scene is drawn in.

use sph_boundary::{Course, RigidMotion};
use sph_core::{Vect, parse_quantity};
use sph_io::{Table, read_columns, read_table};
use sph_scene::{GravityOverTime, Region, Scene};
use sph_solver::SolverError;
use sph_solver::step::{AddedGravity, VariableGravity};

use crate::setup::shapes::rigid_motion;

const PLACE: &str = "numerics.gravity_over_time";
/// Moments of a run at which the largest swing is looked for.
const MOMENTS: u32 = 4096;

/// That of a scene, if it has any.
///
/// # Errors
/// A file that cannot be read; gravity along a periodic direction.
pub fn from_scene<const D: usize>(
    scene: &Scene,
) -> Result<Option<VariableGravity<D>>, SolverError> {
    if !scene.swings() {
        return Ok(None);
    }
    let numerics = &scene.numerics;
    let frame = numerics.frame.as_ref();
    let swing = VariableGravity {
        frame: frame.map_or(Ok(RigidMotion::default()), |m| {
            rigid_motion(m, "numerics.frame", scene.run.end)
        })?,
        given: numerics
            .gravity_over_time
            .as_ref()
            .map_or(Ok(AddedGravity::None), given_of)?,
    };
    let largest = largest_of(&swing, scene.run.end);
    let periodic = numerics.periodic.bounds::<D>();
    if let Some(k) = (0..D).find(|&k| periodic[k].is_some() && largest[k] != 0.0) {
        let axis = ["x", "y", "z"][k];
        let why = format!("gravity along the periodic direction {axis} has no hydrostatic balance");
        let frame = matches!(swing.given, AddedGravity::None);
        return Err(SolverError::at(
            if frame { "numerics.frame" } else { PLACE },
            why,
        ));
    }
    Ok(Some(swing))
}

/// Largest size of every entry until a time (s), m/s².
fn largest_of<const D: usize>(swing: &VariableGravity<D>, end: f64) -> Vect<D> {
    let moments = (0..=MOMENTS).map(|k| end * f64::from(k) / f64::from(MOMENTS));
    let rows: &[_] = match &swing.given {
        AddedGravity::Rows(rows) => rows,
        _ => &[],
    };
    let all = moments.chain(rows.iter().map(|row| row.0));
    all.fold(Vect::zeros(), |most, t| {
        most.zip_map(&swing.at(t), |m, a| f64::max(m, a.abs()))
    })
}

/// Σ a_k L_k with the largest entries and the extent of all bodies, m²/s²: its addend to g H.
pub(crate) fn head<const D: usize>(
    swing: &VariableGravity<D>,
    scene: &Scene,
    regions: &[Region<D>],
) -> f64 {
    let largest = largest_of(swing, scene.run.end);
    let extent = |k: usize| {
        let bounds = regions.iter().map(|region| region.base.bounds());
        let ends = bounds.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (a, b)| {
            [low.min(a[k]), high.max(b[k])]
        });
        (ends[1] - ends[0]).max(0.0)
    };
    (0..D).map(|k| largest[k] * extent(k)).sum()
}

fn given_of<const D: usize>(given: &GravityOverTime) -> Result<AddedGravity<D>, SolverError> {
    if let Some(sine) = &given.sine {
        let course = Course::sine(1.0, sine.period, sine.phase, sine.ramp);
        let first = if sine.ramp > 0.0 {
            0.0
        } else {
            sine.phase.sin()
        };
        return Ok(AddedGravity::Sine(vector(&sine.amplitude), course, first));
    }
    let rows = match &given.table {
        Some(rows) => rows.iter().map(|row| (row[0], vector(&row[1..]))).collect(),
        None => read(given)?,
    };
    Ok(AddedGravity::Rows(rows))
}

fn vector<const D: usize>(entries: &[f64]) -> Vect<D> {
    Vect::from_fn(|k, _| entries.get(k).copied().unwrap_or(0.0))
}

/// The rows of the file.
fn read<const D: usize>(given: &GravityOverTime) -> Result<Vec<(f64, Vect<D>)>, SolverError> {
    let refused = |why: String| SolverError::at(format!("{PLACE}.file"), why);
    let path = given
        .path
        .as_ref()
        .ok_or_else(|| refused("the file is missing".into()))?;
    let table: Result<Table, _> = match &given.columns {
        Some(names) => read_columns(path, &names.iter().map(String::as_str).collect::<Vec<_>>()),
        None => read_table(path),
    };
    let table = table.map_err(|e| refused(e.to_string()))?;
    if table.columns.len() <= D || table.rows() == 0 {
        let columns = table.columns.len();
        return Err(refused(format!(
            "expected rows of a time and {D} entries, found {columns} columns"
        )));
    }
    let mut factors = vec![1.0; D + 1];
    for (k, column) in table.columns[..=D].iter().enumerate() {
        let unit = if k == 0 { "s" } else { "m/s²" };
        if !column.unit.is_empty() {
            let factor = parse_quantity(&format!("1 {}", column.unit), unit);
            factors[k] =
                factor.map_err(|why| refused(format!("column `{}`: {why}", column.name)))?;
        }
        if k > 0 {
            factors[k] *= given.scale;
        }
    }
    let cell = |row: usize, k: usize| factors[k] * table.columns[k].values[row];
    let rows: Vec<_> = (0..table.rows())
        .map(|row| (cell(row, 0), Vect::from_fn(|k, _| cell(row, k + 1))))
        .collect();
    let bad = |(t, a): &(f64, Vect<D>)| !t.is_finite() || a.iter().any(|x| !x.is_finite());
    if let Some(row) = rows.iter().position(bad) {
        return Err(refused(format!(
            "row {} holds a number that is not finite",
            row + 1
        )));
    }
    match rows.windows(2).position(|pair| pair[0].0 >= pair[1].0) {
        Some(row) => {
            let (before, after) = (rows[row].0, rows[row + 1].0);
            Err(refused(format!(
                "times must rise, {after} s follows {before} s"
            )))
        }
        None => Ok(rows),
    }
}
