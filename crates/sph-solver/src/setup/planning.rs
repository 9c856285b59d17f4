//! The stages of a run, in order.

use std::sync::Arc;

use sph_boundary::Wall;
use sph_contribution::{Offer, Part, Refusal, Setting};
use sph_core::{AnyField, Declares, Shape, fields, plan};
use sph_multiphase::Diffused;
use sph_neighbours::{Interaction, TRANSPORTED};
use sph_scene::Scene;

use crate::error::SolverError;
use crate::step::hooks::Hooks;
use crate::step::stages::{InteractionSweep, Work};

/// The works that run, those that do not, and the pair terms.
pub struct StagePlan<const D: usize> {
    /// Stages in order.
    pub stages: Vec<Work<D>>,
    /// Names of the stages that are not needed.
    pub pruned: Vec<String>,
    /// The pair terms of the sweep.
    pub terms: Arc<[Box<dyn Interaction<D>>]>,
    /// The plugin of every term, by the term's name.
    pub kinds: Vec<(String, &'static str)>,
    /// Work within a step, in order.
    pub hooks: Hooks<D>,
    /// All other pieces.
    pub offer: Offer<D>,
    /// Remedies where a term of a kind has thrown a particle about, or where a stage has failed.
    pub remedies: Vec<(&'static str, String)>,
    /// Rates that the sweep sums besides those of the formulation, in the order of their slots.
    pub transported: Vec<AnyField>,
}

/// Input of a plan.
pub struct Planning<'a, const D: usize> {
    /// The scene.
    pub scene: &'a Scene,
    /// The part of it that contributions see.
    pub setting: &'a Setting<'a, D>,
    /// The walls, if there are any.
    pub walls: Option<&'a dyn Wall<D>>,
    /// The way from density diffusion to the quantity that the formulation integrates.
    pub diffused: Diffused,
    /// Names of columns that outputs show and probes measure.
    pub shown: &'a [String],
}

type Offers<const D: usize> = Vec<(&'static str, Offer<D>)>;

impl<const D: usize> Planning<'_, D> {
    /// Collects the offers of all parts and keeps, in order, the stages that are needed.
    ///
    /// # Errors
    /// The key of the scene for which a part is not known, or a column that no stage writes.
    pub fn plan(&self, parts: &mut [Part<D>]) -> Result<StagePlan<D>, SolverError> {
        let mut offers = self.offers(parts)?;
        let mut stages: Vec<Work<D>> = Vec::new();
        if let Some(walls) = self.walls {
            let columns = walls.columns();
            stages.extend([Work::WallGeometry { columns }, Work::WallState]);
        }
        stages.extend(offered(&mut offers));
        let derived = sph_probes::derived_stages(self.shown).into_iter();
        stages.extend(derived.map(Work::Stage));
        let terms = offers.iter().flat_map(|(_, o)| &o.terms);
        let by_terms: Vec<AnyField> = terms.flat_map(|t| t.access().reads()).collect();
        let read = self.read(&stages, by_terms);
        for ((_, part), (_, offer)) in parts.iter_mut().zip(&mut offers) {
            let done = part.offer_to_readers(self.setting, &read, offer);
            done.map_err(|r| self.refused(r))?;
        }
        stages.extend(offered(&mut offers));
        let later: Vec<AnyField> = offers.iter().flat_map(read_later).collect();
        let (mut all, mut hooks, mut kinds) = (Offer::default(), Hooks::default(), Vec::new());
        let (mut riding, mut remedies) = (Vec::new(), Vec::new());
        for (kind, mut offer) in offers {
            kinds.extend(offer.terms.iter().map(|t| (t.name(), kind)));
            offer.riding.retain(|(field, _)| later.contains(field));
            riding.extend(offer.riding.iter().map(|(_, t)| (t.name(), kind)));
            remedies.extend(offer.remedy.take().map(|remedy| (kind, remedy)));
            let kicking = hooks.kicking.len();
            offer.hooks.drain(..).for_each(|hook| hooks.add(kind, hook));
            if hooks.kicking.len() > kicking {
                // Forces of kicks act before those that follow.
                std::mem::swap(&mut all.outside, &mut offer.outside);
            }
            all.take(offer);
        }
        remedies.append(&mut all.remedies_of_failures);
        kinds.append(&mut riding);
        all.terms.extend(all.riding.drain(..).map(|(_, term)| term));
        let transported = transported_by(&all.terms)?;
        let terms: Arc<[_]> = std::mem::take(&mut all.terms).into();
        let changed = all.changes_density.then_some(self.diffused);
        let sweep = InteractionSweep::new(terms.clone(), changed, self.walls.is_some());
        stages.push(Work::Stage(Box::new(sweep)));
        let goals = self.goals(&all, &stages, later);
        let (stages, pruned) = self.ordered(stages, &goals, &hooks)?;
        Ok(StagePlan {
            stages,
            pruned,
            terms,
            kinds,
            hooks,
            offer: all,
            remedies,
            transported,
        })
    }

    fn offers(&self, parts: &mut [Part<D>]) -> Result<Offers<D>, SolverError> {
        let one = |(kind, part): &mut Part<D>| {
            let chosen = self.scene.choice(kind);
            let path = chosen.map_or(format!("[{kind}]"), |c| format!("`{}`", c.path));
            let mut offer = Offer::new(path);
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

    /// Columns that stages and terms read, probes measure and outputs show.
    fn read(&self, stages: &[Work<D>], by_terms: Vec<AnyField>) -> Vec<AnyField> {
        let gradients = [fields::VELOCITY_GRADIENT.any(), fields::STRAIN_RATE.any()].into_iter();
        let by_stages = stages.iter().flat_map(|s| s.access().reads());
        let shown = gradients.filter(|f| self.shows(f));
        by_stages.chain(by_terms).chain(shown).collect()
    }

    fn shows(&self, field: &AnyField) -> bool {
        self.shown.iter().any(|name| name == field.name)
    }

    fn goals(&self, offer: &Offer<D>, stages: &[Work<D>], later: Vec<AnyField>) -> Vec<AnyField> {
        let mut goals: Vec<AnyField> = vec![fields::ACCELERATION.any()];
        goals.extend(later);
        goals.extend(&offer.goals);
        goals.extend(offer.transported.iter().map(|e| e.rate.any()));
        let written = stages.iter().flat_map(|stage| stage.access().writes);
        goals.extend(written.filter(|f| self.shows(f)));
        goals
    }

    /// The stages that the goals need, in order, and the names of the others.
    fn ordered(
        &self,
        stages: Vec<Work<D>>,
        goals: &[AnyField],
        hooks: &Hooks<D>,
    ) -> Result<(Vec<Work<D>>, Vec<String>), SolverError> {
        // All that is in the store before the first evaluation is state.
        let state = self.setting.world.free.fields();
        let remembered = hooks.all.iter().flat_map(|h| h.access.remembers.clone());
        let sources: Vec<AnyField> = state.chain(remembered).collect();
        let declared: Vec<&dyn Declares> = stages.iter().map(|s| s as &dyn Declares).collect();
        let mut planned = plan(&declared, goals, &sources)?;
        // Walls without γ still need their geometry checked, although no field of it is read.
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

fn offered<const D: usize>(offers: &mut Offers<D>) -> impl Iterator<Item = Work<D>> {
    let stages = offers
        .iter_mut()
        .flat_map(|(_, offer)| offer.stages.drain(..));
    stages.map(Work::Stage)
}

fn read_later<const D: usize>((_, offer): &(&'static str, Offer<D>)) -> Vec<AnyField> {
    let hooks = offer.hooks.iter().map(|h| h.access());
    let gates = offer.gates.iter().map(|g| g.access());
    hooks.chain(gates).flat_map(|a| a.reads()).collect()
}

/// The rates that terms write, each once.
fn transported_by<const D: usize>(
    terms: &[Box<dyn Interaction<D>>],
) -> Result<Vec<AnyField>, SolverError> {
    let mut all: Vec<AnyField> = Vec::new();
    for field in terms.iter().flat_map(|t| t.access().writes) {
        if field.shape != Shape::Scalar {
            let why = format!("a pair term writes `{}`, which is no scalar", field.name);
            return Err(SolverError::at("", why));
        }
        if !all.contains(&field) {
            all.push(field);
        }
    }
    let count = all.len();
    if count > TRANSPORTED {
        let why = format!(
            "the pair terms of this scene transport {count} scalars; a sweep sums {TRANSPORTED} at most"
        );
        return Err(SolverError::at("", why));
    }
    Ok(all)
}
