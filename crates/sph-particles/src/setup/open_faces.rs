//! Preparation of open faces with the scene and their walls, and the background pressure of a full box whose faces brake
//! the fluid: without it the fluid would have to carry tension.
//!
//! A face whose velocity into the fluid falls by Δu sends off a wave of −ρcΔu. Particles carry no tension: a full box
//! without background pressure is torn apart, and torn parts move on their own.

use std::sync::Arc;

use sph_boundary::{Wall, WallEntry};
use sph_contribution::Part;
use sph_core::fields::RENORMALISATION;
use sph_core::{Contract, SceneProblem, SlipCondition, Vect, WallCondition};
use sph_neighbours::{CellGrid, World};
use sph_open::{Entering, OpenBoundaries, OpenBoundary, OpenBoundaryEntry, OpenSetting, open};
use sph_rheology::state::{Laws, Lift};
use sph_scene::Scene;
use sph_solver::SolverError;
use sph_solver::setup::Choices;

use crate::setup::box_around;
use crate::setup::initial_world::InitialWorld;
use crate::setup::shapes::Drawn;
use crate::setup::sound::slowest_sound;

/// Distance in front of a port within which the free volume of a particle is measured, over the spacing.
const ROOM: f64 = 0.5;

/// Opens the walls of a scene that have a law for it; takes the laws out of the choices.
pub fn prepare<const D: usize>(
    scene: &Scene,
    drawn: &mut Drawn<D>,
    choices: &mut Choices<D>,
    laws: &Laws,
) -> Result<Option<OpenBoundaries<D>>, SolverError> {
    let given = std::mem::take(&mut choices.open);
    let Some((first, _)) = given.first() else {
        return Ok(None);
    };
    let opens =
        |w: &dyn Wall<D>| w.columns() == [RENORMALISATION.any()] && w.lattice_offset() > 0.0;
    let Some(walls) = choices.walls.take().filter(|w| opens(&**w)) else {
        let walls = WallEntry::KIND.advice();
        let why = format!(
            "open faces need semi-analytical walls without vertices: write {walls} with `vertices = false`"
        );
        return Err(SolverError::at(path(scene, first, ""), why));
    };
    let phases: Vec<String> = scene.phase.keys().cloned().collect();
    let setting = OpenSetting {
        phases: &phases,
        sound_speed: slowest_sound(laws),
        end: scene.run.end,
        gravity: scene.gravity::<D>().norm(),
        dimension: D,
    };
    let refused = given.iter().filter_map(|(wall, law)| {
        let refusal = law.prepare(&setting).err()?;
        let path = path(scene, wall, &refusal.key);
        Some(SceneProblem::new(path, refusal.why))
    });
    SolverError::refuse(refused.collect())?;
    for spec in &mut drawn.walls {
        if given.iter().any(|(name, _)| name == spec.drawing.name()) {
            spec.open = true;
            spec.condition = WallCondition {
                slip: SlipCondition::FreeSlip,
                ..WallCondition::default()
            };
        }
    }
    let shared = |(name, law)| (name, Arc::from(law));
    let given: Vec<(String, Arc<dyn OpenBoundary<D>>)> = given.into_iter().map(shared).collect();
    let spacing = scene.numerics.spacing;
    let summed = choices.formulation.compressed().is_none();
    let (walls, opened) = open(walls, given, (laws, &phases), spacing, summed);
    choices.walls = Some(walls);
    Ok(Some(opened))
}

/// The path of a key of a face's law.
fn path(scene: &Scene, wall: &str, key: &str) -> String {
    let choice = scene.choice_in("open-boundary", wall);
    choice.map_or(format!("wall.{wall}"), |c| c.inside(key))
}

/// Refuses faces that do not fit their law, and those that something blocks; remarks on those by which more comes in
/// than can leave, and on those that brake the fluid, which may lift the laws. Nothing without open faces.
///
/// # Errors
/// The law of a face that it does not fit, or before which there is no room.
pub fn check<const D: usize>(
    scene: &Scene,
    opened: &Option<OpenBoundaries<D>>,
    room: &InitialWorld<D>,
    laws: (&Laws, &Lift),
) -> Result<Vec<String>, SolverError> {
    let Some(opened) = opened else {
        return Ok(Vec::new());
    };
    let misfits = opened
        .misfits()
        .into_iter()
        .map(|(wall, refusal)| SceneProblem::new(path(scene, &wall, &refusal.key), refusal.why));
    SolverError::refuse(misfits.collect())?;
    let mut blocked = Vec::<SceneProblem>::new();
    if let Some(walls) = &room.walls {
        for (name, place) in opened.in_front(ROOM * scene.numerics.spacing) {
            let path = path(scene, &name, "");
            if !walls.contains(&place) && blocked.iter().all(|p| p.path != path) {
                let place = place.as_slice();
                let why = format!(
                    "the open face `{name}` is blocked at the start: {place:?}, half a spacing before it, is behind another \
                     wall"
                );
                blocked.push(SceneProblem::new(path, why));
            }
        }
    }
    SolverError::refuse(blocked)?;
    let outflow = OpenBoundaryEntry::KIND.advice();
    let closed = (!opened.let_out() && scene.outlet.is_empty()).then(|| {
        format!(
            "fluid comes in and none can leave: where there is no room over a free surface the pressure will rise until the run \
             fails; open another wall with {outflow}, `pressure` or `level`, or add an `[outlet.NAME]`"
        )
    });
    let lifted = lift(scene, opened, room, laws);
    Ok(closed.into_iter().chain(lifted).collect())
}

/// Joins open faces to the parts; refuses values of columns that no plugin of the scene brings along, and such as they cannot have.
pub fn join<const D: usize>(
    scene: &Scene,
    opened: Option<OpenBoundaries<D>>,
    parts: &mut Vec<Part<D>>,
) -> Result<(), SolverError> {
    let Some(opened) = opened else {
        return Ok(());
    };
    let entering = opened.entering();
    parts.push(("open-boundary", opened.boxed()));
    let columns = parts.iter().flat_map(|(_, part)| part.columns());
    let known: Vec<_> = columns.map(|c| (c.field, c.within)).collect();
    let mut problems = Vec::new();
    for (wall, Entering { values, .. }) in &entering {
        for (name, value) in values {
            let found = known.iter().find(|(field, _)| field.name == name);
            let why = match found {
                None => {
                    let near = sph_core::suggestion(name, known.iter().map(|(f, _)| f.name));
                    format!("no plugin of this scene has a column `{name}` of its own{near}")
                }
                Some((_, [least, most])) if (*least..=*most).contains(value) => continue,
                Some((field, [least, most])) => {
                    let range = match (*least, *most) {
                        (f64::MIN_POSITIVE, _) => "positive".into(),
                        (f64::NEG_INFINITY, _) => "a number".into(),
                        (least, most) => format!("from {least} to {most}"),
                    };
                    format!(
                        "{} is {range}, and {value}{} comes in here: write such a value, or take it out for that of \
                         the start",
                        field.meaning,
                        sph_core::unit_suffix(field.unit)
                    )
                }
            };
            let path = path(scene, wall, &format!("values.{name}"));
            problems.push(SceneProblem::new(path, why));
        }
    }
    SolverError::refuse(problems)
}

/// Lift over ρcΔu: half as much again for reflections at faces and walls.
const LIFT: f64 = 1.5;
/// The largest lift over ρc²: that of a flow of Mach 0.1 that turns round.
const MOST: f64 = 0.3;
/// Distance over the spacing within which a particle fills a place.
const NEAR: f64 = 0.8;

/// Lifts the law of a full box of one phase if a face brakes its fluid and the law has no background pressure; a
/// remark on it, or on the background pressure that is missing.
fn lift<const D: usize>(
    scene: &Scene,
    opened: &OpenBoundaries<D>,
    room: &InitialWorld<D>,
    (laws, lift): (&Laws, &Lift),
) -> Option<String> {
    let (walls, positions) = (room.walls.as_deref()?, &room.placed.positions);
    let references = || laws.iter().map(|law| law.reference());
    positions.first()?;
    let [low, high] = box_around(positions);
    // Sound goes there and back.
    let time = 2.0 * (high - low).norm() / slowest_sound(laws);
    let (face, fall) = opened.braking(time, scene.run.end)?;
    let background = laws.iter().map(|law| law.background());
    let background = background.fold(0.0, f64::max);
    let tensions = references().map(|r| r.density * r.sound_speed * fall);
    let tension = tensions.fold(0.0, f64::max);
    if background >= tension || !is_full(&room.world, walls, positions) {
        return None;
    }
    let stiffness = references().map(|r| r.density * r.sound_speed.powi(2));
    let stiffness = stiffness.fold(f64::INFINITY, f64::min);
    let pressure = LIFT * tension;
    let why = format!(
        "the open face `{face}` brakes the fluid of a full box by {fall:.3} m/s, which needs a tension of {tension:.3e} Pa; particles carry none"
    );
    // A light phase beside a heavy one would be stirred by a background pressure of the heavy one's size.
    if background > 0.0 || laws.len() > 1 {
        return Some(format!(
            "{why}: let it change more slowly, or give a `background_pressure` of {pressure:.2e} Pa"
        ));
    }
    if pressure > MOST * stiffness {
        return Some(format!(
            "{why}: raise `speed_of_sound` until ρc² is above {:.2e} Pa, or give a `background_pressure`",
            pressure / MOST
        ));
    }
    lift.set(pressure);
    opened.lifted();
    Some(format!(
        "{why}: all pressures are {pressure:.3e} Pa higher; a `background_pressure` of the equation of state takes \
         its place"
    ))
}

/// True if every place a spacing beside a particle has another particle, or is behind a wall.
fn is_full<const D: usize>(world: &World<D>, walls: &dyn Wall<D>, positions: &[Vect<D>]) -> bool {
    let reach = (1.0 + NEAR) * world.spacing;
    let grid = CellGrid::new(positions, reach, &world.domain);
    positions.iter().all(|x| {
        let mut around = Vec::new();
        let way = |j: &u32| world.domain.nearest_image(positions[*j as usize] - x);
        grid.ranges(x, reach, |range| {
            around.extend(grid.order()[range].iter().map(way));
        });
        (0..2 * D).all(|side| {
            let mut way = Vect::<D>::zeros();
            way[side / 2] = [world.spacing, -world.spacing][side % 2];
            let near = |other: &Vect<D>| (other - way).norm() < NEAR * world.spacing;
            around.iter().any(near) || !walls.contains(&(x + way))
        })
    })
}
