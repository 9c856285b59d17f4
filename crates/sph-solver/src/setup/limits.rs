//! What bounds the time step of a scene.

use std::sync::Arc;

use sph_contribution::Setting;
use sph_multiphase::{BoundState, ForceLimit, InterfaceLimit, Limiter, SoundLimit, ViscousLimit};
use sph_stress::ElasticWaveLimit;

use crate::setup::choices::Choices;

/// The bounds that the chosen plugins ask for: sound and forces always; viscosity and elastic waves where they are explicit, interfaces.
pub(crate) fn limiters_of<const D: usize>(
    choices: &Choices<D>,
    laws: &Arc<[Box<dyn BoundState>]>,
    kinematic_viscosities: &[f64],
    phases: &[String],
) -> Vec<Box<dyn Limiter<D>>> {
    let c = choices.integrator.coefficients();
    let mut limiters: Vec<Box<dyn Limiter<D>>> = vec![
        Box::new(SoundLimit {
            courant: c.courant,
            laws: laws.clone(),
        }),
        Box::new(ForceLimit {
            coefficient: c.force,
        }),
    ];
    let eddies = choices.eddy_viscosity.is_some();
    let kinematic = match eddies {
        true => f64::INFINITY,
        false => kinematic_viscosities.iter().copied().fold(0.0, f64::max),
    };
    if kinematic > 0.0 && choices.implicit_viscosity.is_none() {
        limiters.push(Box::new(ViscousLimit {
            coefficient: c.viscous / choices.viscous_operator.stiffness(),
            largest: kinematic,
            constant: !eddies
                && choices
                    .rheologies
                    .iter()
                    .all(|l| l.uniform_viscosity().is_some()),
        }));
    }
    let force = choices.elastic_force.as_ref();
    let bound = force.is_some_and(|force| !force.implicit() && !force.sub_steps());
    if let (Some(wave), true) = (elastic_wave(choices, laws), bound) {
        limiters.push(Box::new(wave));
    }
    if let Some(limit) = InterfaceLimit::of(laws) {
        limiters.push(Box::new(limit));
    }
    limiters.extend(choices.smoother.iter().filter_map(|s| s.limiter(laws)));
    limiters.extend(choices.interfaces.iter().filter_map(|i| i.limiter(laws)));
    let setting = Setting { laws, phases };
    let contributions = choices.contributions.iter();
    limiters.extend(contributions.flat_map(|(_, c)| c.limiters(&setting)));
    limiters
}

/// The step that elastic waves allow, where a phase is elastic.
pub fn elastic_wave<const D: usize>(
    choices: &Choices<D>,
    laws: &Arc<[Box<dyn BoundState>]>,
) -> Option<ElasticWaveLimit> {
    let stiffness = choices.elastic_force.as_ref()?.stiffness();
    let both = laws.iter().zip(&choices.rheologies);
    let speeds = both.filter_map(|(law, rheology)| {
        let reference = law.reference();
        let shear = rheology.elastic()?.shear_modulus() / reference.density;
        Some((reference.sound_speed.powi(2) + stiffness * shear).sqrt())
    });
    Some(ElasticWaveLimit {
        courant: choices.integrator.coefficients().courant,
        speed: speeds.reduce(f64::max)?,
        stiffness,
    })
}
