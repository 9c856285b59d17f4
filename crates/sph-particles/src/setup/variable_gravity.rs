//! Changes of gravity: given over time, and by the acceleration of the frame that the scene is drawn in.

use sph_boundary::RigidMotion;
use sph_core::{Vect, bounds, parse_quantity};
use sph_scene::{GravityOverTime, Region, Scene};
use sph_solver::SolverError;
use sph_solver::step::{AddedGravity, VariableGravity};

use crate::setup::reference_table::named_or_all;
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
    let swing = VariableGravity {
        frame: match &numerics.frame {
            Some(motion) => rigid_motion(motion, "numerics.frame", scene.run.end)?,
            None => RigidMotion::default(),
        },
        given: match &numerics.gravity_over_time {
            None => AddedGravity::None,
            Some(given) => match (&given.sine, &given.table) {
                (Some(sine), _) => {
                    let swing = &sine.oscillation;
                    let begin = swing.phase.sin();
                    let first = if swing.ramp > 0.0 { 0.0 } else { begin };
                    let course = swing.course(1.0);
                    AddedGravity::Sine(vector(&sine.amplitude), course, first)
                }
                (None, Some(rows)) => {
                    let rows = rows.iter().map(|row| (row[0], vector(&row[1..])));
                    AddedGravity::Rows(rows.collect())
                }
                (None, None) => AddedGravity::Rows(read(given)?),
            },
        },
    };
    let largest = largest_of(&swing, scene.run.end);
    let periodic = numerics.periodic.bounds::<D>();
    if let Some(k) = (0..D).find(|&k| periodic[k].is_some() && largest[k] != 0.0) {
        let axis = ["x", "y", "z"][k];
        let why = format!("gravity along the periodic direction {axis} has no hydrostatic balance");
        let path = match swing.given {
            AddedGravity::None => "numerics.frame",
            _ => PLACE,
        };
        return Err(SolverError::at(path, why));
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

/// Σ a_k L_k with the largest entries until a time (s) and the extent of all bodies, m²/s²: its addend to g H.
pub fn head<const D: usize>(swing: &VariableGravity<D>, end: f64, regions: &[Region<D>]) -> f64 {
    let largest = largest_of(swing, end);
    let corners = regions.iter().map(|region| region.base.bounds());
    let [low, high] = bounds(corners.flat_map(|(low, high)| [low, high]));
    let extent = |k: usize| (high[k] - low[k]).max(0.0);
    (0..D).map(|k| largest[k] * extent(k)).sum()
}

fn vector<const D: usize>(entries: &[f64]) -> Vect<D> {
    Vect::from_fn(|k, _| entries.get(k).copied().unwrap_or(0.0))
}

/// The rows of the file.
fn read<const D: usize>(given: &GravityOverTime) -> Result<Vec<(f64, Vect<D>)>, SolverError> {
    let refused = |why: String| SolverError::at(format!("{PLACE}.file"), why);
    let path = given.path.as_ref();
    let path = path.ok_or_else(|| refused("the file is missing".into()))?;
    let table = named_or_all(path, given.columns.as_deref());
    let table = table.map_err(|e| refused(e.to_string()))?;
    if table.columns.len() <= D || table.rows() == 0 {
        let columns = table.columns.len();
        let why = format!("expected rows of a time and {D} entries, found {columns} columns");
        return Err(refused(why));
    }
    let mut factors = vec![1.0; D + 1];
    for (k, column) in table.columns[..=D].iter().enumerate() {
        let unit = if k == 0 { "s" } else { "m/s²" };
        if !column.unit.is_empty() {
            let factor = parse_quantity(&format!("1 {}", column.unit), unit);
            let told = |why| refused(format!("column `{}`: {why}", column.name));
            factors[k] = factor.map_err(told)?;
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
        let why = format!("row {} holds a number that is not finite", row + 1);
        return Err(refused(why));
    }
    match rows.windows(2).find(|pair| pair[0].0 >= pair[1].0) {
        Some(pair) => {
            let (before, after) = (pair[0].0, pair[1].0);
            let why = format!("times must rise, {after} s follows {before} s");
            Err(refused(why))
        }
        None => Ok(rows),
    }
}
