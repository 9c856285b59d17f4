//! Which stages run, in which order.

use std::sync::Arc;

use sph_contribution::{Limiter, Refusal, Setting, Stages, StepWork};
use sph_core::{AnyField, Declares, fields, plan};
use sph_multiphase::Diffused;
use sph_neighbours::{Interaction, Terms};
use sph_scene::Scene;

use crate::failure::error::SolverError;
use crate::setup::builder::Part;
use crate::setup::transported::transported_by;
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
    pub works: Vec<Box<dyn StepWork<D>>>,
    /// The kinds of plugins that it comes from, in the same order.
    pub work_kinds: Vec<&'static str>,
    /// Bounds on the step.
    pub limiters: Vec<Box<dyn Limiter<D>>>,
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

/// Terms with the kinds of plugins that they come from.
#[derive(Default)]
struct Offered<const D: usize> {
    terms: Terms<D>,
    kinds: Vec<(String, &'static str)>,
    change_density: bool,
}

impl<const D: usize> Offered<D> {
    /// Takes terms of a kind of plugin.
    fn take(&mut self, kind: &'static str, terms: Terms<D>) {
        self.kinds.extend(terms.iter().map(|t| (t.name(), kind)));
        self.terms.extend(terms);
    }
}

impl<const D: usize> Planning<'_, D> {
    /// Asks all parts for what they offer and keeps, in order, the stages that somebody needs.
    ///
    /// # Errors
    /// The key of the scene for which a part is not known, or a column that nobody writes.
    pub fn plan(&self, parts: &mut [Part<D>]) -> Result<Planned<D>, SolverError> {
        let setting = self.setting;
        for (_, part) in parts.iter() {
            part.check(setting).map_err(|r| self.refused(r))?;
        }
        let mut offered = Offered::default();
        for (kind, part) in parts.iter() {
            offered.take(kind, part.terms(setting));
            offered.change_density |= part.changes_density(setting);
        }
        let by_terms: Vec<AnyField> = (offered.terms.iter())
            .flat_map(|t| t.access().reads())
            .collect();

        let mut stages: Stages<D> = Vec::new();
        if let Some(walls) = self.walls {
            stages.push(Box::new(WallGeometry(walls.clone())));
            stages.push(Box::new(WallState(walls.clone())));
        }
        stages.extend(parts.iter().flat_map(|(_, part)| part.stages(setting)));
        let read = self.read(&stages, by_terms);
        stages.extend(parts.iter().flat_map(|(_, p)| p.stages_for(setting, &read)));
        let mut works = Vec::new();
        let mut work_kinds = Vec::new();
        for (kind, part) in parts.iter_mut() {
            let done = part.works(setting, &read);
            works.extend(done.map_err(|r| self.refused(r))?);
            work_kinds.resize(works.len(), *kind);
        }
        let later: Vec<AnyField> = works.iter().flat_map(|w| w.access().reads()).collect();
        for (kind, part) in parts.iter() {
            offered.take(kind, part.riding(setting, &read, &later));
        }
        let transported = transported_by(&offered.terms)?;
        let terms: SharedTerms<D> = offered.terms.into();
        let changed = offered.change_density.then_some(self.diffused);
        let sweep = InteractionSweep::new(terms.clone(), changed, self.walls.is_some());
        stages.push(Box::new(sweep));
        let goals = self.goals(parts, &stages, &works);
        let (stages, pruned) = self.ordered(stages, &goals, &works)?;
        Ok(Planned {
            stages,
            pruned,
            terms,
            kinds: offered.kinds,
            works,
            work_kinds,
            limiters: parts
                .iter()
                .flat_map(|(_, p)| p.limiters(setting))
                .collect(),
            transported,
        })
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
    fn goals(
        &self,
        parts: &[Part<D>],
        stages: &Stages<D>,
        works: &[Box<dyn StepWork<D>>],
    ) -> Vec<AnyField> {
        let mut goals: Vec<AnyField> = vec![fields::ACCELERATION.any()];
        goals.extend(works.iter().flat_map(|w| w.access().reads()));
        for (_, part) in parts {
            goals.extend(part.goals());
            goals.extend(part.transported().iter().map(|e| e.rate.any()));
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
        works: &[Box<dyn StepWork<D>>],
    ) -> Result<(Stages<D>, Vec<String>), SolverError> {
        // All that is in the store before the first evaluation is state.
        let state = self.setting.world.free.fields();
        let remembered = works.iter().flat_map(|w| w.remembered());
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
