//! Seepage in a scene: what it is, what it remembers, and where it is not known.

use sph_core::{AnyField, fields};
use sph_multiphase::Laws;
use sph_scene::Scene;
use sph_stress::{PoreFlow, SEEPAGE_PRESSURE, SEEPAGE_VELOCITY, SeepagePhases};

use crate::failure::error::SolverError;
use crate::setup::choices::Choices;

/// The flow through pores, if the scene has one.
///
/// # Errors
/// The key of the scene that does not fit.
pub fn flow<const D: usize>(
    scene: &Scene,
    choices: &mut Choices<D>,
    laws: &Laws,
) -> Result<Option<Box<dyn PoreFlow<D>>>, SolverError> {
    let Some(seepage) = choices.seepage.take() else {
        return Ok(None);
    };
    let path = scene
        .choice("seepage")
        .map_or("seepage".into(), |choice| choice.path);
    if choices.formulation.diffused().evolved.value != fields::DENSITY_CONSTANT {
        let why = "particles give and take mass, which is known with densities that are sums \
                   over positions: take [formulation.hu-adams]";
        return Err(SolverError::at(path, why));
    }
    let names: Vec<String> = scene.phase.keys().cloned().collect();
    let phases = SeepagePhases {
        names: &names,
        laws,
    };
    let found = seepage.flow(&phases).map_err(|(key, why)| match key {
        "" => SolverError::at(path, why),
        key => SolverError::at(format!("{path}.{key}"), why),
    });
    found.map(Some)
}

/// The columns that the flow through pores carries from step to step.
pub fn remembered() -> [AnyField; 2] {
    [SEEPAGE_VELOCITY.any(), SEEPAGE_PRESSURE.any()]
}
