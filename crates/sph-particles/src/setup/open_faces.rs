//! Preparation of open faces with the scene and their walls.

use std::sync::Arc;

use sph_boundary::{Wall, WallCondition};
use sph_contribution::Part;
use sph_core::fields::RENORMALISATION;
use sph_core::{SceneProblem, Shape};
use sph_open::{Entering, OpenBoundaries, OpenBoundary, OpenSetting, open};
use sph_rheology::state::Laws;
use sph_scene::Scene;
use sph_solver::setup::Choices;
use sph_solver::{SolverError, defaults};

use crate::setup::shapes::Drawn;
use crate::setup::tension;
use crate::setup::tension::FilledBox;

/// Distance in front of a port within which the free volume of a particle is measured, over the spacing.
const ROOM: f64 = 0.5;

/// Opens the walls of a scene that have a law for it; takes the laws out of the choices.
///
/// # Errors
/// The keys that do not fit.
pub(crate) fn prepare<const D: usize>(
    scene: &Scene,
    drawn: &mut Drawn<D>,
    choices: &mut Choices<D>,
    laws: &Laws,
) -> Result<Option<OpenBoundaries<D>>, SolverError> {
    let given = std::mem::take(&mut choices.open);
    let Some((first, _)) = given.first() else {
        return Ok(None);
    };
    let walls = choices.walls.take();
    let Some(walls) =
        walls.filter(|w| w.columns() == [RENORMALISATION.any()] && w.lattice_offset() > 0.0)
    else {
        let write = defaults::OPEN_WALLS;
        let other =
            format!("open faces need semi-analytical walls without vertices: write {write}");
        return Err(SolverError::at(path(scene, first, ""), other));
    };
    let phases: Vec<String> = scene.phase.keys().cloned().collect();
    let speeds = laws.iter().map(|law| law.reference().sound_speed);
    let setting = OpenSetting {
        phases: &phases,
        sound_speed: speeds.fold(f64::INFINITY, f64::min),
        end: scene.run.end,
        gravity: scene.gravity::<D>().norm(),
        dimension: D,
    };
    let refused = given.iter().filter_map(|(wall, law)| {
        let refusal = law.prepare(&setting).err()?;
        Some(SceneProblem::new(
            path(scene, wall, &refusal.key),
            refusal.why,
        ))
    });
    let problems: Vec<_> = refused.collect();
    if !problems.is_empty() {
        return Err(SolverError::Scene(problems));
    }
    for spec in &mut drawn.walls {
        if given.iter().any(|(name, _)| name == spec.drawing.name()) {
            spec.open = true;
            spec.condition = WallCondition::FreeSlip;
        }
    }
    let given: Vec<(String, Arc<dyn OpenBoundary<D>>)> = given
        .into_iter()
        .map(|(name, law)| (name, Arc::from(law)))
        .collect();
    let summed = choices.formulation.compressed().is_none();
    let (walls, opened) = open(
        walls,
        given,
        (laws, &phases),
        scene.numerics.spacing,
        summed,
    );
    choices.walls = Some(walls);
    Ok(Some(opened))
}

/// The path of a key of a face's law.
fn path(scene: &Scene, wall: &str, key: &str) -> String {
    let choice = scene.open_boundary(wall);
    choice.map_or(format!("wall.{wall}"), |c| c.inside(key))
}

/// Refuses faces that do not fit their law, and those that something blocks; remarks on those by which more comes in
/// than can leave, and on those that brake the fluid, which may lift the laws. Nothing without open faces.
///
/// # Errors
/// The law of a face that it does not fit, or before which there is no room.
pub(crate) fn check<const D: usize>(
    scene: &Scene,
    opened: &Option<OpenBoundaries<D>>,
    walls: Option<&dyn Wall<D>>,
    filled: FilledBox<'_, D>,
) -> Result<Vec<String>, SolverError> {
    let Some(opened) = opened else {
        return Ok(Vec::new());
    };
    let misfits = opened.misfits().into_iter();
    let misfits: Vec<_> = misfits
        .map(|(wall, refusal)| SceneProblem::new(path(scene, &wall, &refusal.key), refusal.why))
        .collect();
    if !misfits.is_empty() {
        return Err(SolverError::Scene(misfits));
    }
    let mut blocked = Vec::<SceneProblem>::new();
    if let Some(walls) = walls {
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
    if !blocked.is_empty() {
        return Err(SolverError::Scene(blocked));
    }
    let mut all = remarks(scene, opened);
    all.extend(tension::lift(scene, opened, walls, filled));
    Ok(all)
}

fn remarks<const D: usize>(scene: &Scene, opened: &OpenBoundaries<D>) -> Vec<String> {
    if opened.let_out() || !scene.outlet.is_empty() {
        return Vec::new();
    }
    let outflow = defaults::OUTFLOW;
    vec![format!(
        "fluid comes in and none can leave: where there is no room over a free surface the pressure will rise until the run \
         fails; open another wall with {outflow}, `pressure` or `level`, or add an `[outlet.NAME]`"
    )]
}

/// Refuses values of columns that no plugin of the scene brings along, and such as they cannot have.
///
/// # Errors
/// The key of the value.
pub(crate) fn check_values<const D: usize>(
    scene: &Scene,
    entering: &[(String, Entering)],
    parts: &[Part<D>],
) -> Result<(), SolverError> {
    let columns = parts.iter().flat_map(|(_, part)| part.columns());
    let known = columns.filter(|c| c.field.shape == Shape::Scalar);
    let known: Vec<_> = known.map(|c| (c.field, c.within)).collect();
    let mut problems = Vec::new();
    for (wall, Entering { values, .. }) in entering {
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
            problems.push(SceneProblem::new(
                path(scene, wall, &format!("values.{name}")),
                why,
            ));
        }
    }
    match problems.is_empty() {
        true => Ok(()),
        false => Err(SolverError::Scene(problems)),
    }
}
