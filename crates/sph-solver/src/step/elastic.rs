//! The elastic force among the terms: which one, and with what it cannot be combined.

use sph_implicit::TimeScheme;
use sph_multiphase::ViscousOperator;
use sph_neighbours::{Interaction, World};
use sph_scene::Scene;
use sph_stress::{AdjointDivergence, Blend, Blended, ElasticForce, Felt};

use crate::failure::error::SolverError;

/// The elastic force of a scene as a term.
pub fn term<const D: usize>(
    force: &dyn ElasticForce<D>,
    felt: &Felt,
    adjoint: bool,
) -> Box<dyn Interaction<D>> {
    let term = match adjoint {
        true => Box::new(AdjointDivergence),
        false => force.term(felt),
    };
    match force.blend() {
        Blend::Forces => Box::new(Blended::solid(term)),
        Blend::Stresses => term,
    }
}

/// Refuses an elastic force where it is not known.
///
/// # Errors
/// The key of the scene that asks for it.
pub fn refuse_what_is_not_known<const D: usize>(
    scene: &Scene,
    force: &dyn ElasticForce<D>,
    felt: &Felt,
    adjoint: bool,
    scheme: Option<&dyn TimeScheme>,
    operator: &dyn ViscousOperator<D>,
    world: &World<D>,
) -> Result<(), SolverError> {
    let chosen = scene.choice("elastic-force");
    let path = chosen.map_or("elastic-force".into(), |choice| choice.path);
    if force.implicit() {
        refuse_implicit(&path, scheme, operator.leaves_rotations(), adjoint)?;
    }
    if force.blend() == Blend::Forces {
        let key = format!("{path}.blend");
        let blends = |law: &dyn sph_rheology::Rheology| law.elastic().is_some_and(|e| e.blends());
        if !felt.laws.iter().any(|law| blends(&**law)) {
            let why = "no law of this scene is liquid where it yields: take `blend` out";
            return Err(SolverError::at(key, why));
        }
        if scheme.is_some() {
            let why = "a share of a force is not known as a symmetric system: take \
                       [implicit-viscosity] out, or blend \"stresses\"";
            return Err(SolverError::at(key, why));
        }
        let damps = |law: &dyn sph_rheology::Rheology| law.elastic().is_some_and(|e| e.damps());
        if felt.laws.iter().any(|law| damps(&**law)) {
            let why = "where forces are blended the solid has no viscosity, and the `damping` of the law would do \
                       nothing: let it be 0, or blend \"stresses\"";
            return Err(SolverError::at(key, why));
        }
    }
    if adjoint && force.displaced() {
        return Err(SolverError::at(
            "velocity-gradient.renormalised.adjoint",
            "the force is made of displacements and not of a stress: take `adjoint` out, or take \
             [elastic-force.divergence]",
        ));
    }
    let mut walls = scene.wall.iter();
    let moving = walls.find(|(_, wall)| wall.motion.is_some() || wall.velocity.is_some());
    if let (true, Some((name, _))) = (force.displaced(), moving) {
        let why = format!(
            "the way of a wall is not remembered, and the wall `{name}` moves: take \
             [elastic-force.divergence]"
        );
        return Err(SolverError::at(path, why));
    }
    let grips = &world.walls;
    let mut grips = grips.points.grip.iter().chain(&grips.elements.grip);
    if adjoint && grips.any(|grip| *grip < 1.0) {
        return Err(SolverError::at(
            "velocity-gradient.renormalised.adjoint",
            "the adjoint force is not known at walls that slip: take `adjoint` out, or let all walls be \
             \"no-slip\"",
        ));
    }
    Ok(())
}

/// Refuses sub-steps where they are not known.
///
/// # Errors
/// The key of the scene that asks for them.
pub fn refuse_sub_steps<const D: usize>(
    scene: &Scene,
    force: &dyn ElasticForce<D>,
    adjoint: bool,
    kicks_once: bool,
) -> Result<(), SolverError> {
    let why = if force.implicit() {
        "stresses of the end of the step have no need of sub-steps: take one of `implicit` and `sub_steps` out"
    } else if force.blend() == Blend::Forces {
        "where forces are blended the share of the others is not known within the step: take `sub_steps` out, or \
         blend \"stresses\""
    } else if adjoint {
        "the `adjoint` force was not tried in sub-steps: take one of the two out"
    } else if !kicks_once {
        "sub-steps go between one kick and one drift over all of the step: take [integrator.symplectic-euler], or take \
         `sub_steps` out"
    } else {
        return Ok(());
    };
    let chosen = scene.choice("elastic-force");
    let path = chosen.map_or("elastic-force".into(), |choice| choice.path);
    Err(SolverError::at(format!("{path}.sub_steps"), why))
}

/// Refuses stresses of the end of the step where they are not known.
fn refuse_implicit(
    path: &str,
    scheme: Option<&dyn TimeScheme>,
    leaves_rotations: bool,
    adjoint: bool,
) -> Result<(), SolverError> {
    let why = match scheme {
        None => {
            "what the step adds to the stress is solved for with the viscosity: add \
             [implicit-viscosity.backward-euler], or take `implicit` out"
        }
        Some(scheme) if scheme.implicit_share() < 1.0 => {
            "the stress of the end of the step is all of the force: take \
             [implicit-viscosity.backward-euler], or take `implicit` out"
        }
        Some(_) if !leaves_rotations => {
            "what the step adds to the stress must not brake rotations, as this viscous operator does at free surfaces: take \
             [viscous-operator.monaghan-gingold], or take `implicit` out"
        }
        Some(_) if adjoint => {
            "it was not shown to be stable with the `adjoint` force: take one of the two out"
        }
        Some(_) => return Ok(()),
    };
    Err(SolverError::at(format!("{path}.implicit"), why))
}
