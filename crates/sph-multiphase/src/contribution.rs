//! The formulation of a scene, and scalars that the motion compresses.

use rayon::prelude::*;
use sph_contribution::{
    Contribution, FromPlugins, Offer, Plugins, Refusal, Setting, StepHook, StepMoment, StepPhase,
    contributes, light_body_limit, sound_limit,
};
use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::{Interaction, interactions};

use crate::{
    Acting, Compressed, Formulation, FormulationEntry, PressureEntry, PressureScheme,
    equations_of_state, interface_limit,
};

/// The formulation that a scene names, with its equations of state.
struct Compressible<const D: usize> {
    formulation: Box<dyn Formulation<D>>,
    /// The pressure scheme; without one the equations of state give the pressure.
    scheme: Option<Box<dyn PressureScheme<D>>>,
    /// True if the scene chooses a finder of free surfaces.
    surfaces: bool,
}

contributes!("formulation", Compressible);

impl<const D: usize> FromPlugins<D> for Compressible<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        let scheme = plugins.one::<D, PressureEntry>();
        Some(Compressible {
            formulation: plugins.one::<D, FormulationEntry>()?,
            scheme,
            surfaces: plugins.names("surface"),
        })
    }
}

impl<const D: usize> Contribution<D> for Compressible<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.stages = self.formulation.stages();
        let state = equations_of_state(setting.laws.clone());
        match &self.scheme {
            None => {
                offer.stage(state);
                offer.limiter(sound_limit(setting.courant, setting.laws.clone()));
                if let Some(limit) = interface_limit(setting.laws) {
                    offer.limiter(limit);
                }
                if !setting.world.walls.bodies.is_empty() {
                    offer.limiter(light_body_limit(setting.laws));
                }
            }
            Some(scheme) => {
                let stage = scheme.stage(Acting {
                    state: Box::new(state),
                    laws: setting.laws.clone(),
                    dilatation: self.formulation.dilatation(),
                    surfaces: self.surfaces,
                });
                offer.solves.push(stage.name());
                offer.stages.push(stage);
                offer.limiters = scheme.limiters(setting);
            }
        }
        offer.terms.push(self.formulation.pressure_term());
        if let Some(compressed) = self.formulation.compressed() {
            offer.advanced.push(compressed.value);
            offer.hook(Dilatation {
                compressed,
                term: [self.formulation.divergence()],
                unused: Vec::new(),
                divergence: Vec::new(),
            });
        }
        Ok(())
    }
}

/// The divergence of a formulation, at work while positions drift.
struct Dilatation<const D: usize> {
    compressed: Compressed,
    term: [Box<dyn Interaction<D>>; 1],
    /// The sweep sums accelerations, too; they are not read.
    unused: Vec<Vect<D>>,
    divergence: Vec<f64>,
}

impl<const D: usize> StepHook<D> for Dilatation<D> {
    fn name(&self) -> String {
        "dilatation".into()
    }
    fn access(&self) -> Access {
        let access = self.term[0].access().both(fields::POSITION);
        access.here(fields::MASS).writes(self.compressed.value)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::MidDrift]
    }
    /// value ← value · exp(exponent · D{u} · dt) at the present positions and velocities, the volume at most 1/w(0).
    ///
    /// That is what a particle alone has where densities are sums, ρ = m w(0). Spray flies apart within the supports of its
    /// particles, and would thin out to 2 % of the fluid; with 50 times their volume such particles throw the fluid about when
    /// they fall back into it.
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let (world, dt) = (&mut *moment.world, moment.dt);
        self.unused.resize(world.free.len(), Vect::zeros());
        self.divergence.resize(world.free.len(), 0.0);
        let (unused, rates) = (&mut self.unused, &mut self.divergence);
        interactions(world, &self.term, unused, Some(rates))?;
        let exponent = self.compressed.exponent;
        let factor = exponent * dt;
        let own_share = world.kernel.value_at_zero();
        let mut value = world.free.take(self.compressed.value)?;
        let mass = world.free.get(fields::MASS)?;
        let changes = self.divergence.par_iter().zip(mass);
        let all = value.par_iter_mut().zip(changes).with_min_len(2048);
        all.for_each(|(v, (divergence, mass))| {
            *v *= (factor * divergence).exp();
            *v = match exponent < 0.0 {
                true => v.max(mass * own_share),
                false => v.min(1.0 / own_share),
            };
        });
        Ok(world.free.put(self.compressed.value, value)?)
    }
}
