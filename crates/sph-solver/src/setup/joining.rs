//! A flow of what was planned.

use sph_contribution::StepWork;
use sph_core::{AnyField, Evolved, Role, fields};
use sph_multiphase::Formulation;
use sph_neighbours::World;
use sph_scene::Scene;
use sph_state::Laws;

use crate::setup::builder::Part;
use crate::setup::planning::Planned;
use crate::step::declared::Columns;
use crate::step::flow::Flow;
use crate::step::outlets::Outlets;
use crate::step::snapshot::Snapshot;
use crate::step::stages::{SharedWall, WALL_STATE};
use crate::step::swing::Swing;

/// What a flow is made of besides its plan.
pub(crate) struct Given<const D: usize> {
    pub walls: Option<SharedWall<D>>,
    pub laws: Laws,
    /// η/ρ₀ of every phase, m²/s.
    pub kinematic_viscosities: Vec<f64>,
    pub swing: Option<Swing<D>>,
    pub outlets: Outlets,
    pub remedies: Vec<(&'static str, String)>,
    pub evolved: Vec<Evolved>,
}

/// Scalars with rates: the formulation's, then those of contributions.
pub(crate) fn evolved<const D: usize>(
    formulation: &dyn Formulation<D>,
    parts: &[Part<D>],
) -> Vec<Evolved> {
    let transported = parts.iter().flat_map(|(_, p)| p.transported());
    std::iter::once(formulation.diffused().evolved)
        .chain(transported)
        .collect()
}

/// What to change where a term of a kind has thrown a particle about, or where a stage has failed.
pub(crate) fn remedies<const D: usize>(
    scene: &Scene,
    parts: &[Part<D>],
) -> Vec<(&'static str, String)> {
    let of_terms = parts.iter().filter_map(|(kind, part)| {
        let chosen = scene.choice(kind);
        let path = chosen.map_or(format!("[{kind}]"), |c| format!("`{}`", c.path));
        Some((*kind, part.remedy(&path)?))
    });
    let of_failures = parts.iter().flat_map(|(_, p)| p.remedies_of_failures());
    of_terms.chain(of_failures).collect()
}

/// A flow of what was planned, with all columns that it touches.
pub(crate) fn joined<const D: usize>(
    world: World<D>,
    planned: Planned<D>,
    given: Given<D>,
) -> Flow<D> {
    let works = planned.works;
    let mut integrated: Vec<_> = given.evolved.iter().map(|e| e.value).collect();
    for scalar in works.iter().flat_map(|w| w.advanced()) {
        if !integrated.contains(&scalar) {
            integrated.push(scalar);
        }
    }
    // Those that kick come before those that follow.
    let mut forceful: Vec<&Box<dyn StepWork<D>>> = works.iter().collect();
    forceful.sort_by_key(|w| !w.kicks());
    let outside = forceful.iter().filter_map(|w| w.force()).collect();
    let mut flow = Flow {
        world,
        stages: planned.stages,
        pruned: planned.pruned,
        terms: planned.terms,
        kinds: planned.kinds,
        remedies: given.remedies,
        limiters: planned.limiters,
        walls: given.walls,
        loads: Vec::new(),
        evolved: given.evolved,
        integrated,
        outside,
        columns: Columns::default(),
        works,
        moved: true,
        restored: false,
        kept: Snapshot::default(),
        kept_rates: Default::default(),
        kept_image: Default::default(),
        laws: given.laws,
        kinematic_viscosities: given.kinematic_viscosities,
        timings: Vec::new(),
        swing: given.swing,
        outlets: given.outlets,
        nursery: None,
        books: None,
        parts: None,
        work_kinds: planned.work_kinds,
    };
    flow.ask_all();
    flow.reset_timings();
    allocate(&mut flow);
    flow
}

/// Allocates every column that a planned stage touches.
fn allocate<const D: usize>(flow: &mut Flow<D>) {
    let touched: Vec<AnyField> = flow
        .columns
        .stages
        .iter()
        .flat_map(|access| access.writes.iter().copied().chain(access.reads()))
        .filter(|f| f.name != WALL_STATE.name && f.name != fields::PHASE.name)
        .collect();
    let remembering = flow.stages.iter().zip(&flow.columns.stages);
    let remembering = remembering.filter(|(stage, _)| stage.remembers());
    let remembered: Vec<AnyField> = remembering.flat_map(|(_, a)| a.writes.clone()).collect();
    for field in touched {
        // Drifts may sort particles between their halves: the shift must be sorted, too.
        // Solves for the effective pressure start from the last one.
        let kept = [fields::SHIFT_VELOCITY.name, fields::EFFECTIVE_PRESSURE.name];
        let role = match kept.contains(&field.name) || remembered.contains(&field) {
            true => Role::State,
            false => Role::Derived,
        };
        flow.world.free.add_any(field, role);
    }
    for field in flow.works.iter().flat_map(|w| w.remembered()) {
        flow.world.free.add_any(field, Role::State);
    }
    flow.world.free.add(fields::ACCELERATION, Role::Derived);
    // An evolved scalar that nothing changes is a constant: it needs no rate and no kick.
    let free = &flow.world.free;
    flow.evolved.retain(|e| free.has(e.rate.name));
}
