//! Data that the contributions of a scene's laws share, and gradients of the velocity in a scene.

use std::sync::Arc;

use sph_contribution::{Contribution, FromPlugins, Offer, Plugins, Refusal, Setting, contributes};
use sph_core::{AnyField, Field, Scalar, fields};
use sph_multiphase::linear::ImplicitViscosityEntry;
use sph_multiphase::viscosity::{Viscosity, ViscousOperator, ViscousOperatorEntry};
use sph_rheology::{Rheology, RheologyEntry};

use crate::dilatancy::DilatancyEntry;
use crate::pores::FRICTION_PRESSURE;
use crate::stress::strain_rate::{StrainRateTerm, strain_rates};
use crate::stress::{
    Blend, ElasticForce, ElasticForceEntry, GradientStage, LawInputs, Rheologies, VelocityGradient,
    VelocityGradientEntry,
};

/// The laws of a scene, and the plugins that make forces of them.
pub struct Materials<const D: usize> {
    /// The laws, in the order of the phase numbers.
    pub laws: Rheologies,
    /// The gradient of the velocity, where a stage needs it.
    pub gradient: Option<Arc<dyn VelocityGradient<D>>>,
    /// The viscous operator, for friction.
    pub operator: Box<dyn ViscousOperator<D>>,
    /// Force of elastic stresses, where a law has them.
    pub force: Option<Box<dyn ElasticForce<D>>>,
    /// True if eddies have a viscosity.
    pub eddies: bool,
    /// Share of the friction that is of the end of the step, where it is solved for.
    pub implicit_share: Option<f64>,
    /// True if the pressure between grains is another than that of the equation of state.
    pub effective: bool,
    /// True if dilation adds to the friction of the laws.
    pub dilatant: bool,
}

impl<const D: usize> Materials<D> {
    /// Those of a scene; none if its viscous operator could not be built.
    pub fn from_plugins(plugins: &Plugins) -> Option<Self> {
        let laws: Rheologies = plugins.of_phases::<D, RheologyEntry>().into();
        let eddies = plugins.names("eddy-viscosity");
        let elastic = laws.iter().any(|law| law.elastic().is_some());
        let of_gradients = [fields::VELOCITY_GRADIENT.name, fields::STRAIN_RATE.name];
        let mut shown = plugins.shown.iter();
        let shown = shown.any(|name| of_gradients.contains(&&**name));
        let dilates = plugins.names("dilatancy") && plugins.names("pore-pressure");
        let dilates = dilates.then(|| plugins.one::<D, DilatancyEntry>());
        let strained = eddies
            || plugins.names("dissipation")
            || elastic
            || dilates.is_some()
            || shown
            || laws.iter().any(|law| law.needs().strain_rate);
        let gradient = strained.then(|| plugins.one::<D, VelocityGradientEntry>());
        let force = elastic.then(|| plugins.one::<D, ElasticForceEntry>());
        let scheme = plugins.one::<D, ImplicitViscosityEntry>();
        Some(Materials {
            laws,
            gradient: gradient.flatten().map(Arc::from),
            operator: plugins.one::<D, ViscousOperatorEntry>()?,
            force: force.flatten(),
            eddies,
            implicit_share: scheme.map(|scheme| scheme.implicit_share()),
            effective: plugins.names("effective-pressure"),
            dilatant: dilates.flatten().is_some_and(|law| law.adds_friction()),
        })
    }

    pub(crate) fn grain_pressure(&self) -> Field<Scalar> {
        match self.effective {
            true => fields::EFFECTIVE_PRESSURE,
            false => fields::PRESSURE,
        }
    }

    pub(crate) fn law_inputs(&self) -> LawInputs {
        let blend = self.force.as_ref().map(|force| force.blend());
        LawInputs {
            laws: self.laws.clone(),
            pressure: match self.dilatant {
                true => FRICTION_PRESSURE,
                false => self.grain_pressure(),
            },
            blend: blend.unwrap_or(Blend::Stresses),
        }
    }

    /// True if stresses are those of the end of the step.
    pub(crate) fn ahead(&self) -> bool {
        self.force.as_ref().is_some_and(|force| force.implicit())
    }

    /// The formula whose adjoint is the elastic force, if it is.
    pub(crate) fn adjoint(&self) -> Option<&Arc<dyn VelocityGradient<D>>> {
        let formula = self.gradient.as_ref()?;
        (self.force.is_some() && formula.adjoint()).then_some(formula)
    }

    /// One viscosity for all, or a column, which something besides the laws may need.
    pub(crate) fn viscosity(&self) -> Viscosity {
        let column = self.eddies || self.ahead();
        let laws = &self.laws;
        let uniform: Vec<_> = laws.iter().map(|l| l.uniform_viscosity()).collect();
        match uniform.first() {
            Some(Some(first)) if !column && uniform.iter().all(|v| v == &Some(*first)) => {
                Viscosity::Uniform(*first)
            }
            _ if laws.len() > 1 => Viscosity::PerPhase,
            _ => Viscosity::PerParticle,
        }
    }

    pub(crate) fn inviscid(&self) -> bool {
        self.viscosity() == Viscosity::Uniform(0.0)
    }

    /// The gradient of the phases whose laws read it, or of all if others read it too.
    pub(crate) fn gradient_stage(&self, read: &[AnyField]) -> Option<GradientStage<D>> {
        let formula = self.gradient.clone()?;
        let phases = match self.eddies || includes_gradients(read) {
            true => None,
            false => {
                let phases: Arc<[bool]> = self.laws.iter().map(|l| reads_gradients(&**l)).collect();
                phases.contains(&false).then_some(phases)
            }
        };
        Some(GradientStage { formula, phases })
    }

    /// True if no stage reads strain rates before the interactions, which may then leave them for terms that do it
    /// later.
    pub(crate) fn strain_rides(&self, read: &[AnyField]) -> bool {
        self.eddies
            && !self.laws.iter().any(|law| reads_gradients(&**law))
            && !includes_gradients(read)
    }
}

fn includes_gradients(read: &[AnyField]) -> bool {
    let gradients = [fields::VELOCITY_GRADIENT.any(), fields::STRAIN_RATE.any()];
    read.iter().any(|field| gradients.contains(field))
}

fn reads_gradients(law: &dyn Rheology) -> bool {
    law.needs().strain_rate || law.elastic().is_some()
}

struct Straining<const D: usize>(Materials<D>);

#[cfg(not(test))]
contributes!("velocity-gradient", Straining);

impl<const D: usize> FromPlugins<D> for Straining<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        let materials = Materials::from_plugins(plugins)?;
        materials.gradient.is_some().then_some(Straining(materials))
    }
}

impl<const D: usize> Contribution<D> for Straining<D> {
    fn offer(&mut self, _: &Setting<'_, D>, _: &mut Offer<D>) -> Result<(), Refusal> {
        Ok(())
    }
    fn offer_to_readers(
        &mut self,
        _: &Setting<'_, D>,
        read: &[AnyField],
        offer: &mut Offer<D>,
    ) -> Result<(), Refusal> {
        // An elastic motion leaves the gradients of its drift.
        if let (Some(stage), None) = (self.0.gradient_stage(read), &self.0.force) {
            offer.stage(stage);
        }
        let Some(formula) = self.0.gradient.clone() else {
            return Ok(());
        };
        match self.0.strain_rides(read) {
            false => offer.stage(strain_rates()),
            true => {
                let term = Box::new(StrainRateTerm { formula });
                offer.riding.push((fields::STRAIN_RATE.any(), term));
            }
        }
        Ok(())
    }
}
