//! A flow from a plan.

use sph_core::{AnyField, Evolved, Role, fields};
use sph_neighbours::World;
use sph_rheology::state::Laws;

use crate::setup::planning::StagePlan;
use crate::step::flow::Flow;
use crate::step::hooks::Columns;
use crate::step::outlets::Outlets;
use crate::step::stages::WALL_STATE;

impl<const D: usize> Flow<D> {
    /// A flow from a plan, with all columns that it touches, and without walls; `density` is the scalar with its rate that
    /// the formulation integrates.
    pub fn new(
        mut world: World<D>,
        planned: StagePlan<D>,
        density: Evolved,
        laws: Laws,
        outlets: Outlets,
    ) -> Self {
        world.transported = planned.transported;
        let mut evolved = vec![density];
        let offer = planned.offer;
        evolved.extend(offer.transported);
        let mut integrated: Vec<_> = evolved.iter().map(|e| e.value).collect();
        for scalar in offer.advanced {
            if !integrated.contains(&scalar) {
                integrated.push(scalar);
            }
        }
        let mut flow = Flow {
            world,
            stages: planned.stages,
            pruned: planned.pruned,
            terms: planned.terms,
            kinds: planned.kinds,
            remedies: planned.remedies,
            solves: offer.solves,
            limiters: offer.limiters,
            inner_bounds: offer.inner_bounds,
            walls: None,
            loads: Vec::new(),
            finer_loads: Vec::new(),
            evolved,
            integrated,
            outside: offer.outside,
            columns: Columns::default(),
            hooks: planned.hooks,
            fresh_state: offer.fresh_state,
            gates: offer.gates,
            stored: offer.stored,
            on_walls: Vec::new(),
            moved: true,
            restored: false,
            kept: Default::default(),
            laws,
            kinematic_viscosities: Vec::new(),
            timings: Vec::new(),
            swing: None,
            outlets,
            nursery: None,
            observers: Vec::new(),
            parts: None,
        };
        flow.ask_all();
        flow.reset_timings();
        allocate(&mut flow);
        flow
    }
}

fn allocate<const D: usize>(flow: &mut Flow<D>) {
    let stages = &flow.columns.stages;
    let touched = stages
        .iter()
        .flat_map(|a| a.writes.iter().copied().chain(a.reads()));
    let apart = [WALL_STATE.name, fields::PHASE.name];
    let remembered: Vec<AnyField> = stages.iter().flat_map(|a| a.remembers.clone()).collect();
    for field in touched.filter(|f| !apart.contains(&f.name)) {
        let role = match remembered.contains(&field) {
            true => Role::State,
            false => Role::Derived,
        };
        flow.world.free.add_any(field, role);
    }
    let hooks = flow.hooks.all.iter();
    let by_hooks = hooks.map(|hook| hook.access.remembers.clone());
    let by_gates = flow.gates.iter().map(|gate| gate.access().remembers);
    for field in by_hooks.chain(by_gates).flatten() {
        flow.world.free.add_any(field, Role::State);
    }
    flow.world.free.add(fields::ACCELERATION, Role::Derived);
    // An evolved scalar that nothing changes is a constant: it needs no rate and no kick.
    let free = &flow.world.free;
    flow.evolved.retain(|e| free.has(e.rate.name));
}
