//! Viscosities, stresses and yielding by the laws of a scene, as columns.

use std::ops::Range;

use sph_core::{Access, Stage, Symmetric, fields, stage};
use sph_neighbours::{World, column_stage};
use sph_rheology::{Elastic, Inputs, Yielding};

use crate::stress::strain_rate::in_space;
use crate::stress::{Blend, LawInputs};

/// η of every particle by the law of its phase; where phases differ or a law depends on the flow. Where forces are
/// blended it is that of the liquid alone. With `eddies` there is an eddy viscosity to add.
pub(crate) fn viscosities<const D: usize>(laws: LawInputs, eddies: bool) -> impl Stage<World<D>> {
    let eddies = eddies.then_some(fields::EDDY_VISCOSITY);
    let (access, field) = (laws.access().here(eddies), fields::VISCOSITY);
    column_stage::<D, _>("rheology", access, field, move |world, viscosity| {
        laws.each(world, viscosity, |law, inputs, _, out| {
            match law.elastic().filter(|elastic| elastic.blends()) {
                Some(elastic) if laws.blend == Blend::Forces => {
                    elastic.liquid_viscosity(inputs, out)
                }
                _ => law.viscosity(inputs, out),
            }
        })?;
        if let Some(eddies) = world.free.all(eddies)? {
            viscosity.iter_mut().zip(eddies).for_each(|(v, e)| *v += e);
        }
        Ok(())
    })
}

/// [`CARRIED_STRESS`](fields::CARRIED_STRESS) from the remembered one; zero in phases without
/// an elastic part. Where forces are blended it is the whole stress of the solid, cut to the yield stress.
pub(crate) fn carried_stress<const D: usize>(laws: LawInputs) -> impl Stage<World<D>> {
    let (access, field) = (elastic_access(&laws), fields::CARRIED_STRESS);
    column_stage::<D, _>("carried stress", access, field, move |world, carried| {
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        laws.each(world, carried, |law, inputs, run, out| {
            match law.elastic() {
                Some(elastic) if laws.blend == Blend::Forces => {
                    let stress = &stress[run];
                    let yielding = yielding(elastic, inputs, stress);
                    let all = out.iter_mut().zip(stress).zip(&yielding);
                    all.for_each(|((out, stress), yielding)| *out = *stress * yielding.held);
                }
                Some(elastic) => elastic.carried(inputs, &stress[run], out),
                None => out.fill(Symmetric::ZERO),
            }
        })
    })
}

fn elastic_access(laws: &LawInputs) -> Access {
    laws.access().here(fields::ELASTIC_STRESS)
}

pub(crate) fn yielding(
    elastic: &dyn Elastic,
    inputs: &Inputs<'_>,
    stress: &[Symmetric],
) -> Vec<Yielding> {
    let mut yielding = vec![Yielding::NONE; stress.len()];
    elastic.yielding(inputs, stress, &mut yielding);
    yielding
}

/// The stress at the end of the step in two parts: sτⁿ in [`CARRIED_STRESS`](fields::CARRIED_STRESS), and s𝒢 in
/// [`ELASTIC_STIFFNESS`](fields::ELASTIC_STIFFNESS) for what the step adds, s 2𝒢Δt D(uⁿ⁺¹), which is solved for with the viscosity.
///
/// s = (1 − ζ) min(1, τ_y/|τⁿ + 2𝒢Δt D|) is what yielding leaves, with strain rate and step of the step before, also where the
/// viscosity follows the velocity within the step. With a = 𝒢Δt²k²/ρ of the direct second differences and b of the nested first ones that
/// remember, a shear wave of wave number k is stable if b < 2a + 4: always, as nested differences are the softer ones; it loses the
/// share 1 − 1/√(1 + a) of its amplitude in a step. To compression the viscous operator gives 3𝒢 where 4/3 𝒢 are remembered: the
/// rest is a viscosity of the volume, 5/3 s𝒢Δt. Ours.
pub(crate) fn implicit_elastic_stress<const D: usize>(laws: LawInputs) -> impl Stage<World<D>> {
    let access = elastic_access(&laws)
        .here(fields::VELOCITY_GRADIENT)
        .writes((fields::CARRIED_STRESS, fields::ELASTIC_STIFFNESS));
    let name = "carried stress, ahead";
    stage(name, access, move |world: &mut World<D>| {
        let dt = world.dt;
        let mut carried = world.free.take(fields::CARRIED_STRESS)?;
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        let gradient = world.free.get(fields::VELOCITY_GRADIENT)?;
        let mut stiffness = vec![0.0; stress.len()];
        let shares = |elastic: &dyn Elastic, inputs: &Inputs<'_>, run: Range<usize>| {
            let twice = 2.0 * elastic.shear_modulus() * dt;
            let both = stress[run.clone()].iter().zip(&gradient[run]);
            let trial = both.map(|(stress, gradient)| {
                *stress + Symmetric::part_of(in_space(gradient)).deviator() * twice
            });
            yielding(elastic, inputs, &trial.collect::<Vec<_>>())
        };
        laws.each(world, &mut stiffness, |law, inputs, run, out| {
            if let Some(elastic) = law.elastic() {
                let modulus = elastic.shear_modulus();
                let all = out.iter_mut().zip(shares(elastic, inputs, run));
                all.for_each(|(out, y)| *out = modulus * (y.solid * y.held));
            }
        })?;
        laws.each(world, &mut carried, |law, _, run, out| {
            let Some(elastic) = law.elastic() else {
                return out.fill(Symmetric::ZERO);
            };
            let modulus = elastic.shear_modulus();
            let all = stress[run.clone()].iter().zip(&stiffness[run]);
            let all = out.iter_mut().zip(all);
            all.for_each(|(out, (stress, stiff))| *out = *stress * (stiff / modulus));
        })?;
        world.free.put(fields::CARRIED_STRESS, carried)?;
        Ok(world.free.put(fields::ELASTIC_STIFFNESS, stiffness)?)
    })
}

/// [`FRICTION_SHARE`](fields::FRICTION_SHARE), [`SOLID_FRACTION`](fields::SOLID_FRACTION) and
/// [`YIELD_FACTOR`](fields::YIELD_FACTOR) from the remembered stress; 1 in phases without an elastic part.
pub(crate) fn yield_shares<const D: usize>(laws: LawInputs) -> impl Stage<World<D>> {
    let access = elastic_access(&laws)
        .writes((fields::FRICTION_SHARE, fields::SOLID_FRACTION))
        .writes(fields::YIELD_FACTOR);
    // Kept for its memory.
    let mut yielding = Vec::new();
    stage("yielding", access, move |world: &mut World<D>| {
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        laws.yielding(world, stress, &mut yielding)?;
        type Share = fn(&Yielding) -> f64;
        let columns: [(_, Share); 3] = [
            (fields::FRICTION_SHARE, |y| y.friction),
            (fields::SOLID_FRACTION, |y| y.solid),
            (fields::YIELD_FACTOR, |y| y.held),
        ];
        for (field, share) in columns {
            let all = world.free.get_mut(field)?.iter_mut().zip(&yielding);
            all.for_each(|(value, yielding)| *value = share(yielding));
        }
        Ok(())
    })
}
