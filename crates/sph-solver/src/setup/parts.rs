//! The pieces of physics of a scene, as contributions.

use std::rc::Rc;

use sph_contribution::{Contribution, Offer, Refusal, Setting, open_kinds};
use sph_multiphase::Compressible;
use sph_neighbours::Terms;
use sph_scene::Scene;
use sph_stress::{Elasticity, Friction, Materials, Straining, WallFriction};

use crate::setup::builder::Part;
use crate::setup::choices::Physics;

/// Pair terms that a scene names itself.
struct Given<const D: usize>(Terms<D>);

impl<const D: usize> Contribution<D> for Given<D> {
    fn offer(&mut self, _: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.terms.append(&mut self.0);
        offer.remedy = Some("look at its parameters".into());
        Ok(())
    }
}

/// Fields that outputs and probes ask for by name.
struct Shown(Vec<String>);

impl<const D: usize> Contribution<D> for Shown {
    fn offer(&mut self, _: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.stages = sph_probes::derived_stages(&self.0);
        Ok(())
    }
}

/// Kinds of contributions of this project that are not among [`SUMMED`].
const OTHERS: [&str; 5] = [
    "damping",
    "flow-control",
    "open-boundary",
    "surface",
    "wall-function",
];

/// Kinds of plugins that no crate of this project has plugins of, of which a scene names some.
pub fn strangers(scene: &Scene) -> Vec<&'static str> {
    let kinds = open_kinds().into_iter().map(|k| k.kind);
    let strange = kinds.filter(|k| !SUMMED.contains(k) && !OTHERS.contains(k));
    let strange = strange.chain(["term"]);
    strange
        .filter(|kind| scene.choice(kind).is_some())
        .collect()
}

/// Kinds in the order in which their terms are summed; all others follow.
const SUMMED: [&str; 13] = [
    "formulation",
    "effective-pressure",
    "velocity-gradient",
    "viscous-operator",
    "eddy-viscosity",
    "elastic-force",
    "smoother",
    "interface",
    "shifting",
    "term",
    "walls",
    "seepage",
    "output",
];

/// All of them, in the order in which their terms are summed; `shown` are the names of what is written and measured.
pub fn parts<const D: usize>(scene: &Scene, physics: Physics<D>, shown: &[String]) -> Vec<Part<D>> {
    let share = |(scheme, _): &(Box<dyn sph_implicit::TimeScheme>, _)| scheme.implicit_share();
    let materials = Rc::new(Materials {
        laws: physics.rheologies,
        gradient: physics.velocity_gradient,
        operator: physics.viscous_operator,
        force: physics.elastic_force,
        eddies: scene.choice("eddy-viscosity").is_some(),
        implicit_share: physics.implicit_viscosity.as_ref().map(share),
        grain_pressure: scene.choice("effective-pressure").is_some(),
    });
    let compressible = Compressible {
        formulation: physics.formulation.clone(),
        scheme: physics.pressure,
        surfaces: scene.choice("surface").is_some(),
    };
    let mut all: Vec<Part<D>> = vec![("formulation", Box::new(compressible))];
    let solve = physics.implicit_viscosity;
    let friction = Friction::new(materials.clone(), solve, scene.numerics.delayed_yield);
    all.push(("velocity-gradient", Box::new(Straining(materials.clone()))));
    all.push(("viscous-operator", Box::new(friction)));
    all.push(("elastic-force", Box::new(Elasticity(materials.clone()))));
    all.push(("term", Box::new(Given(physics.terms))));
    all.push(("walls", Box::new(WallFriction(materials))));
    all.push(("output", Box::new(Shown(shown.to_vec()))));
    all.extend(physics.contributions);
    let place = |(kind, _): &Part<D>| SUMMED.iter().position(|k| k == kind);
    all.sort_by_key(|part| place(part).unwrap_or(SUMMED.len()));
    all
}
