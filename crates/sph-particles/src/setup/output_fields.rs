//! Fields that outputs name.

use sph_core::{SceneProblem, fields};
use sph_scene::Scene;
use sph_solver::step::term_accelerations;
use sph_solver::{Flow, SolverError};

/// Refuses names of fields that no plugin of the scene has.
///
/// # Errors
/// Every unknown name, with the nearest one that is known.
pub(crate) fn check_output_fields<const D: usize>(
    scene: &Scene,
    flow: &Flow<D>,
) -> Result<(), SolverError> {
    let free = &flow.world.free;
    let lists = [
        ("output.fields", &scene.output.fields),
        ("output.picture", &scene.output.picture),
    ];
    // Fields on request are listed with the others.
    let written = sph_probes::SURFACE_DISTANCE.name;
    let more = sph_probes::derived_fields().chain([fields::STRAIN_RATE.name, written]);
    let more = more.chain(term_accelerations::names());
    let more = more.filter(|name| !free.has(name));
    let names: Vec<&str> = free.fields().map(|f| f.name).chain(more).collect();
    let unknown = |path: &str, name: &str| {
        let near = sph_core::suggestion(name, names.iter().copied());
        let known = names.join(", ");
        let message =
            format!("no plugin of this scene has a field `{name}`{near} (there are: {known})");
        SceneProblem::new(path, message)
    };
    let mut problems = Vec::new();
    for (path, wanted) in lists {
        let missing = wanted.iter().filter(|n| *n != written && !free.has(n));
        problems.extend(missing.map(|name| unknown(path, name)));
    }
    if let Some(colours) = &scene.output.picture_range {
        // Colours of a field that is not drawn now do no harm: pictures are changed with `--set`.
        let known = |name: &str| names.contains(&name) || name == fields::DISPLACEMENT.name;
        let missing = colours.fields().filter(|name| !known(name));
        problems.extend(missing.map(|name| unknown(&format!("output.picture_range.{name}"), name)));
    }
    match problems.is_empty() {
        true => Ok(()),
        false => Err(SolverError::Scene(problems)),
    }
}
