//! The elastic force among the terms: which one, and with what it cannot be combined.

use sph_neighbours::{Interaction, World};
use sph_scene::Scene;
use sph_stress::{AdjointDivergence, Blend, Blended, ElasticForce, Felt};

use crate::error::SolverError;

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
    implicit: bool,
    world: &World<D>,
) -> Result<(), SolverError> {
    let chosen = scene.choice("elastic-force");
    let path = chosen.map_or("elastic-force".into(), |choice| choice.path);
    if force.blend() == Blend::Forces {
        let key = format!("{path}.blend");
        let blends = |law: &dyn sph_rheology::Rheology| law.elastic().is_some_and(|e| e.blends());
        if !felt.laws.iter().any(|law| blends(&**law)) {
            let why = "no law of this scene is liquid where it yields: take `blend` out";
            return Err(SolverError::at(key, why));
        }
        if implicit {
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
