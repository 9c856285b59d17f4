//! Scenes that cannot have zones, and zones that do not fit their surroundings.

use sph_core::{AnyField, Field, Scalar, Shape as Form, fields};
use sph_scene::{Scene, Shape, Zone};
use sph_solver::{Flow, SolverError};

use super::frame::Frame;
use super::sample::SCALARS;
use crate::setup::Assembled;

/// Columns of state that follow from places, velocities and densities, are led, or begin with those of the parents.
const CARRIED: [&str; 9] = [
    fields::POSITION.name,
    fields::VELOCITY.name,
    fields::MASS.name,
    fields::IDENTITY.name,
    fields::DENSITY_CONSTANT.name,
    fields::SHIFT_VELOCITY.name,
    fields::DISPLACEMENT.name,
    fields::DENSITY.name,
    fields::MEAN_ACCELERATION.name,
];

/// Kinds of plugins that solve for all particles at once.
const SOLVES: [&str; 2] = ["pressure", "implicit-viscosity"];

/// Kinds of plugins that keep a sum over all particles.
const OF_ALL: [&str; 2] = ["flow-control", "suspension"];

/// Scalars of state besides the density, as turbulent energy: a zone has them from the flow around, which has them from
/// the zone. At most [`SCALARS`].
pub(crate) fn scalars<const D: usize>(flow: &Flow<D>) -> Vec<Field<Scalar>> {
    let state = flow.state_columns();
    let own = |field: &AnyField| {
        field.shape == Form::Scalar && state.contains(&field.name) && !CARRIED.contains(&field.name)
    };
    let all = flow.world.free.fields().filter(own);
    all.map(AnyField::scalar).take(SCALARS).collect()
}

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
    let frame = |zone: &Zone| Frame::<D>::new(scene, zone, support * zone.ratio);
    for (name, zone) in &scene.zone {
        let path = format!("zone.{name}");
        let Some(own) = frame(zone) else { continue };
        let [low, high] = own.corners(own.band);
        let crosses = |k: usize| {
            let within = |[lo, hi]: [f64; 2]| lo <= low[k] && high[k] <= hi;
            low[k].is_finite() && periods[k].is_some_and(|period| !within(period))
        };
        if (0..D).any(crosses) {
            let why = format!(
                "the band around it, {:.4} m wide, reaches across a periodic side: move it, or let a box span the \
                 whole period",
                own.band
            );
            return Err(SolverError::at(path, why));
        }
        if let Some(outer) = scene.around_zone(zone) {
            let outer_zone = &scene.zone[outer];
            let spacing = scene.numerics.spacing * outer_zone.ratio;
            let around = frame(outer_zone);
            if around.is_some_and(|around| reaches_out(&own, &around, parts, spacing)) {
                let why = format!(
                    "the band around it, {:.4} m wide, reaches out of the zone `{outer}`: make that zone larger",
                    own.band
                );
                return Err(SolverError::at(path, why));
            }
        }
        for (other, second) in &scene.zone {
            let gap = 2.0 * own.band;
            let meets = frame(second).is_some_and(|second| second.shape.is_near(&own.shape, gap));
            if name < other && second.ratio == zone.ratio && meets {
                let why = format!(
                    "its band meets that of the zone `{name}`: move them {gap:.4} m apart, or make them one"
                );
                return Err(SolverError::at(format!("zone.{other}"), why));
            }
        }
    }
    Ok(())
}

/// True if the band of a zone reaches out of the zone around it, where there may be fluid; `spacing` is that around the outer
/// one, m.
fn reaches_out<const D: usize>(
    zone: &Frame<D>,
    around: &Frame<D>,
    parts: &Assembled<D>,
    spacing: f64,
) -> bool {
    if !matches!(around.shape, Shape::Cuboid { .. }) {
        return !around.shape.encloses(&zone.shape, zone.band);
    }
    let ([low, high], [from, to]) = (zone.corners(zone.band), around.corners(0.0));
    (0..D).any(|axis| {
        let open = |side| around.is_open(parts.flow.walls.as_deref(), spacing, (axis, side));
        (low[axis] < from[axis] && open(0)) || (high[axis] > to[axis] && open(1))
    })
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
    let scalars = scalars(flow);
    let named = |column: &str| scalars.iter().any(|field| field.name == column);
    let carried = |column: &&str| CARRIED.contains(column) || named(column);
    let columns = flow.state_columns();
    if let Some(other) = columns.iter().find(|column| !carried(column)) {
        return refused(format!(
            "zones carry places, velocities, masses, densities and at most {SCALARS} scalars, and this scene has the \
             state `{other}` besides"
        ));
    }
    let names = |kinds: &[&str]| zone.plugins.iter().any(|p| kinds.contains(&&*p.kind));
    let why = if !flow.gates.is_empty() {
        "particles come in or leave by walls of this scene, which zones cannot follow"
    } else if !flow.hooks.kicking.is_empty() || names(&SOLVES) {
        "this scene solves for the end of a step over all particles, which zones cannot share"
    } else if names(&OF_ALL) {
        "this scene keeps a sum over all particles, the rate of a flow or the number of grains, which zones have for \
         themselves only"
    } else if !zone.integrator.kicks_once() {
        "zones want an integrator that evaluates once a step, as `symplectic-euler`"
    } else if !flow.world.walls.beds.is_empty() {
        "grains make a wall of this scene, which zones do not share"
    } else {
        return Ok(());
    };
    refused(why.into())
}
