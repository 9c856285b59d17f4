//! Which stages run, in which order.

use std::sync::Arc;

use sph_contribution::{
    Gate, Limiter, Offer, OutsideForce, Refusal, Setting, Stages, StoredEnergy,
};
use sph_core::{AnyField, Declares, Evolved, Field, Scalar, fields, plan};
use sph_multiphase::Diffused;
use sph_neighbours::{Interaction, fuse_all};
use sph_scene::Scene;

use crate::failure::error::SolverError;
use crate::setup::builder::Part;
use crate::setup::transported::transported_by;
use crate::step::hooks::{Hooked, Hooks};
use crate::step::stages::{InteractionSweep, SharedWall, WallGeometry, WallState};

/// Pair terms shared by the sweep and whoever measures with them.
pub type SharedTerms<const D: usize> = Arc<[Box<dyn Interaction<D>>]>;

/// What is run, what is not, and with which pair terms.
pub struct Planned<const D: usize> {
    /// Stages in order.
    pub stages: Stages<D>,
    /// Names of the stages nobody needs.
    pub pruned: Vec<String>,
    /// The pair terms of the sweep.
    pub terms: SharedTerms<D>,
    /// What plugin every term comes from, by the term's name.
    pub kinds: Vec<(String, &'static str)>,
    /// Work within a step, in order.
    pub hooks: Hooks<D>,
    /// Forces outside of the sweep.
    pub outside: Vec<OutsideForce<D>>,
    /// Sources and sinks of particles.
    pub gates: Vec<Box<dyn Gate<D>>>,
    /// Energy that particles store.
    pub stored: Vec<Box<dyn StoredEnergy<D>>>,
    /// Scalars with rates, besides the formulation's.
    pub evolved: Vec<Evolved>,
    /// Scalars that hooks advance.
    pub advanced: Vec<Field<Scalar>>,
    /// Bounds on the step.
    pub limiters: Vec<Box<dyn Limiter<D>>>,
    /// Bounds on steps within a step, for listings.
    pub inner_bounds: Vec<String>,
    /// What to change where a term of a kind has thrown a particle about, or where a stage has failed.
    pub remedies: Vec<(&'static str, String)>,
    /// Rates that the sweep sums besides those of the formulation, in the order of their slots.
    pub transported: Vec<AnyField>,
}

/// What a plan is made from.
pub struct Planning<'a, const D: usize> {
    /// The scene.
    pub scene: &'a Scene,
    /// What contributions learn of it.
    pub setting: &'a Setting<'a, D>,
    /// The walls, if there are any.
    pub walls: Option<&'a SharedWall<D>>,
    /// How density diffusion reaches what the formulation integrates.
    pub diffused: Diffused,
    /// Names of columns that outputs show and probes measure.
    pub shown: &'a [String],
}

/// The offers of all parts, each with its kind of plugin.
type Offers<const D: usize> = Vec<(&'static str, Offer<D>)>;

impl<const D: usize> Planning<'_, D> {
    /// Asks all parts for what they offer and keeps, in order, the stages that somebody needs.
    ///
    /// # Errors
    /// The key of the scene for which a part is not known, or a column that nobody writes.
    pub fn plan(&self, parts: &mut [Part<D>]) -> Result<Planned<D>, SolverError> {
        let mut offers = self.offers(parts)?;
        let mut stages: Stages<D> = Vec::new();
        if let Some(walls) = self.walls {
            stages.push(Box::new(WallGeometry(walls.clone())));
            stages.push(Box::new(WallState(walls.clone())));
        }
        stages.extend(offers.iter_mut().flat_map(|(_, o)| o.stages.drain(..)));
        let terms = offers.iter().flat_map(|(_, o)| &o.terms);
        let by_terms: Vec<AnyField> = terms.flat_map(|t| t.access().reads()).collect();
        let read = self.read(&stages, by_terms);
        for ((_, part), (_, offer)) in parts.iter_mut().zip(&mut offers) {
            let offered = part.offer_to_readers(self.setting, &read, offer);
            offered.map_err(|r| self.refused(r))?;
        }
        stages.extend(offers.iter_mut().flat_map(|(_, o)| o.stages.drain(..)));
        let later: Vec<AnyField> = offers.iter().flat_map(read_later).collect();
        let mut kinds = Vec::new();
        let mut terms = Vec::new();
        for (kind, offer) in &mut offers {
            kinds.extend(offer.terms.iter().map(|t| (t.name(), *kind)));
            terms.append(&mut offer.terms);
        }
        for (kind, offer) in &mut offers {
            let riding = offer.riding.drain(..);
            for (_, term) in riding.filter(|(field, _)| later.contains(field)) {
                kinds.push((term.name(), *kind));
                terms.push(term);
            }
        }
        let transported = transported_by(&terms)?;
        let terms: SharedTerms<D> = fuse_all(terms).into();
        let changed = offers.iter().any(|(_, o)| o.changes_density);
        let changed = changed.then_some(self.diffused);
        let sweep = InteractionSweep::new(terms.clone(), changed, self.walls.is_some());
        stages.push(Box::new(sweep));
        let goals = self.goals(&offers, &stages, later);
        let remedies = remedies(&mut offers);
        let hooks = offers.iter_mut();
        let hooks = hooks.flat_map(|(kind, o)| o.hooks.drain(..).map(|h| Hooked::of(kind, h)));
        let mut planned = Planned {
            stages: Vec::new(),
            pruned: Vec::new(),
            terms,
            kinds,
            hooks: Hooks::of(hooks.collect()),
            outside: Vec::new(),
            gates: Vec::new(),
            stored: Vec::new(),
            evolved: Vec::new(),
            advanced: Vec::new(),
            limiters: Vec::new(),
            inner_bounds: Vec::new(),
            remedies,
            transported,
        };
        planned.hooks.fresh_state = offers.iter().any(|(_, o)| o.fresh_state);
        planned.outside.extend(planned.hooks.forces());
        for (_, offer) in offers {
            planned.outside.extend(offer.outside);
            planned.gates.extend(offer.gates);
            planned.stored.extend(offer.stored);
            planned.evolved.extend(offer.transported);
            planned.advanced.extend(offer.advanced);
            planned.limiters.extend(offer.limiters);
            planned.inner_bounds.extend(offer.inner_bounds);
        }
        (planned.stages, planned.pruned) = self.ordered(stages, &goals, &planned.hooks)?;
        Ok(planned)
    }

    /// Asks all parts in turn for what they offer.
    fn offers(&self, parts: &mut [Part<D>]) -> Result<Offers<D>, SolverError> {
        let one = |(kind, part): &mut Part<D>| {
            let chosen = self.scene.choice(kind);
            let path = chosen.map_or(format!("[{kind}]"), |c| format!("`{}`", c.path));
            let mut offer = Offer::of(path);
            let offered = part.offer(self.setting, &mut offer);
            offered.map_err(|r| self.refused(r))?;
            Ok((*kind, offer))
        };
        parts.iter_mut().map(one).collect()
    }

    /// The path of a refused key in the scene.
    fn refused(&self, refusal: Refusal) -> SolverError {
        let chosen = self.scene.choice(refusal.kind);
        let path = chosen.map_or(refusal.kind.to_string(), |choice| choice.path);
        let path = match refusal.key.as_str() {
            "" => path,
            key => format!("{path}.{key}"),
        };
        SolverError::at(path, refusal.why)
    }

    /// What stages and terms read, probes measure and outputs show.
    fn read(&self, stages: &Stages<D>, by_terms: Vec<AnyField>) -> Vec<AnyField> {
        let gradients = [fields::VELOCITY_GRADIENT.any(), fields::STRAIN_RATE.any()];
        let shown = gradients
            .into_iter()
            .filter(|f| self.shown.iter().any(|name| name == f.name));
        let by_stages = stages.iter().flat_map(|s| s.access().reads());
        by_stages.chain(by_terms).chain(shown).collect()
    }

    /// Columns that have to be computed.
    fn goals(&self, offers: &Offers<D>, stages: &Stages<D>, later: Vec<AnyField>) -> Vec<AnyField> {
        let mut goals: Vec<AnyField> = vec![fields::ACCELERATION.any()];
        goals.extend(later);
        for (_, offer) in offers {
            goals.extend(&offer.goals);
            goals.extend(offer.transported.iter().map(|e| e.rate.any()));
        }
        for stage in stages {
            let writes = stage.access().writes;
            let shown = writes.into_iter();
            goals.extend(shown.filter(|f| self.shown.iter().any(|name| name == f.name)));
        }
        goals
    }

    /// The stages that the goals need, in order, and the names of the others.
    fn ordered(
        &self,
        stages: Stages<D>,
        goals: &[AnyField],
        hooks: &Hooks<D>,
    ) -> Result<(Stages<D>, Vec<String>), SolverError> {
        // All that is in the store before the first evaluation is state.
        let state = self.setting.world.free.fields();
        let remembered = hooks.iter().flat_map(|h| h.access.remembers.clone());
        let sources: Vec<AnyField> = state.chain(remembered).collect();
        let declared: Vec<&dyn Declares> =
            stages.iter().map(|s| s.as_ref() as &dyn Declares).collect();
        let mut planned = plan(&declared, goals, &sources)?;
        // Walls without γ still need their geometry checked, although nobody reads a field of it.
        if self.walls.is_some() && !planned.order.contains(&0) {
            planned.order.insert(0, 0);
            planned.pruned.retain(|k| *k != 0);
        }
        let pruned = planned.pruned.iter().map(|&k| stages[k].name()).collect();
        let mut slots: Vec<_> = stages.into_iter().map(Some).collect();
        let order = planned.order.iter();
        Ok((order.filter_map(|&k| slots[k].take()).collect(), pruned))
    }
}

/// Columns that hooks and gates read.
fn read_later<const D: usize>((_, offer): &(&'static str, Offer<D>)) -> Vec<AnyField> {
    let hooks = offer.hooks.iter().map(|h| h.get().access());
    let gates = offer.gates.iter().map(|g| g.access());
    hooks.chain(gates).flat_map(|a| a.reads()).collect()
}

/// Remedies of terms, by their kinds, then those of failures, by the names of what fails.
fn remedies<const D: usize>(offers: &mut Offers<D>) -> Vec<(&'static str, String)> {
    let of_terms =
        |(kind, offer): &mut (&'static str, Offer<D>)| Some((*kind, offer.remedy.take()?));
    let mut all: Vec<_> = offers.iter_mut().filter_map(of_terms).collect();
    for (_, offer) in offers {
        all.append(&mut offer.remedies_of_failures);
    }
    all
}
