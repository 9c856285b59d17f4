//! Scenes that cannot have zones, and zones that do not fit their surroundings.

use sph_core::fields;
use sph_scene::Scene;
use sph_solver::SolverError;

use super::frame::Frame;
use crate::setup::Assembled;

/// Columns of state that follow from places, velocities and densities, or are led.
const CARRIED: [&str; 8] = [
    fields::POSITION.name,
    fields::VELOCITY.name,
    fields::MASS.name,
    fields::IDENTITY.name,
    fields::DENSITY_CONSTANT.name,
    fields::SHIFT_VELOCITY.name,
    fields::DISPLACEMENT.name,
    fields::DENSITY.name,
];

/// Kinds of plugins that solve for all particles at once.
const SOLVES: [&str; 2] = ["pressure", "implicit-viscosity"];

/// Refuses zones whose bands reach across a period, or into each other.
///
/// # Errors
/// The box of the zone.
pub(crate) fn refuse_places<const D: usize>(
    scene: &Scene,
    parts: &Assembled<D>,
) -> Result<(), SolverError> {
    let support = parts.flow.world.kernel.support_radius();
    let periods = scene.numerics.periodic.bounds::<D>();
    let banded = |zone: &sph_scene::Zone| {
        let frame = Frame::<D>::new(scene, zone, support * zone.ratio);
        let corners = frame.corners(frame.band);
        (frame, corners)
    };
    for (name, zone) in &scene.zone {
        let path = format!("zone.{name}.box");
        let (frame, [low, high]) = banded(zone);
        let crosses = |k: usize| {
            let within = |[lo, hi]: [f64; 2]| lo <= low[k] && high[k] <= hi;
            low[k].is_finite() && periods[k].is_some_and(|period| !within(period))
        };
        if (0..D).any(crosses) {
            let why = format!(
                "the band around it, {:.4} m wide, reaches across a periodic side: move the box, or let it span the \
                 whole period",
                frame.band
            );
            return Err(SolverError::at(path, why));
        }
        if let Some(outer) = scene.around_zone(zone) {
            let (around, _) = banded(&scene.zone[outer]);
            let spacing = scene.numerics.spacing * scene.zone[outer].ratio;
            let reaches_out = |(axis, side): (usize, usize)| {
                let beyond = match side {
                    0 => low[axis] < around.corners(0.0)[0][axis],
                    _ => high[axis] > around.corners(0.0)[1][axis],
                };
                beyond && around.is_open(parts.flow.walls.as_deref(), spacing, (axis, side))
            };
            let mut sides = (0..D).flat_map(|axis| [(axis, 0), (axis, 1)]);
            if sides.any(reaches_out) {
                let why = format!(
                    "the band around it, {:.4} m wide, reaches out of the zone `{outer}`: make that zone larger",
                    frame.band
                );
                return Err(SolverError::at(path, why));
            }
        }
        for (other, second) in &scene.zone {
            let [a, b] = banded(second).1;
            let meets = (0..D).all(|k| low[k] < b[k] && a[k] < high[k]);
            if name < other && second.ratio == zone.ratio && meets {
                let why = format!(
                    "its band meets that of the zone `{name}`: move the boxes {:.4} m apart, or make them one",
                    2.0 * frame.band
                );
                return Err(SolverError::at(format!("zone.{other}.box"), why));
            }
        }
    }
    Ok(())
}

/// Refuses a zone whose flow has more than particles of one phase with a density and a velocity.
///
/// # Errors
/// The zone, with the part of the scene that it cannot have.
pub(crate) fn refuse<const D: usize>(name: &str, zone: &Assembled<D>) -> Result<(), SolverError> {
    let refused = |why: String| Err(SolverError::at(format!("zone.{name}"), why));
    let flow = &zone.flow;
    if flow.laws.len() > 1 {
        return refused("zones are for one phase, and this scene has several".into());
    }
    let carried = |column: &&str| CARRIED.contains(column);
    let columns = flow.state_columns();
    if let Some(other) = columns.iter().find(|column| !carried(column)) {
        return refused(format!(
            "zones carry places, velocities, masses and densities, and this scene has the state `{other}` besides"
        ));
    }
    let solves = |kind: &str| SOLVES.contains(&kind);
    let walls = flow.world.walls.names.len();
    let mut own = flow.walls.iter();
    let why = if !flow.gates.is_empty() {
        "particles come in or leave by walls of this scene, which zones cannot follow"
    } else if !flow.hooks.kicking.is_empty() || zone.plugins.iter().any(|p| solves(&p.kind)) {
        "this scene solves for the end of a step over all particles, which zones cannot share"
    } else if !zone.integrator.kicks_once() {
        "zones want an integrator that evaluates once a step, as `symplectic-euler`"
    } else if own.any(|w| (0..walls).any(|k| w.needs_forces(k))) {
        "a wall of this scene moves by the forces on it, which zones do not share yet"
    } else {
        return Ok(());
    };
    refused(why.into())
}
