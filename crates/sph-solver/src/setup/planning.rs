//! Which stages run, in which order.

use std::ops::Not;
use std::sync::Arc;

use sph_contribution::Setting;
use sph_core::{Access, AnyField, Declares, Shape, Stage, fields, plan};
use sph_multiphase::{BoundState, Coupling, PressureStage, ShiftedFlow, Viscosity};
use sph_neighbours::{Interaction, TRANSPORTED, World, fuse_all};
use sph_rheology::Rheology;
use sph_scene::Scene;
use sph_stress::{
    Blend, Blended, CarriedAhead, CarriedStress, CoulombFriction, ElasticMotion, Felt,
    GradientStage, PoreFlow, PorePressure, Rheologies, StrainRate, StressCorrection,
    ViscosityStage, Yielded,
};

use crate::failure::error::SolverError;
use crate::setup::choices::Choices;
use crate::step::elastic;
use crate::step::stages::{Also, InteractionSweep, SharedWall, WallGeometry, WallState};

/// Stages of a flow.
pub type Stages<const D: usize> = Vec<Box<dyn Stage<World<D>>>>;

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
    /// Friction that is solved for instead.
    pub friction: Option<Friction<D>>,
    /// What gives the viscosity of the present velocity, where it depends on it.
    pub lagged: Stages<D>,
    /// Whether elastic stresses are those of the end of the step.
    pub ahead: bool,
    /// Remembered stresses that follow the motion.
    pub elastic: Option<ElasticMotion<D>>,
    /// The elastic force, if it has steps of its own, and what its laws feel.
    pub sub_stepped: Option<(Box<dyn Interaction<D>>, Felt)>,
    /// Friction of soils on walls.
    pub coulomb: Option<CoulombFriction<D>>,
    /// Water that moves through pores.
    pub seepage: Option<Box<dyn PoreFlow<D>>>,
    /// Rates that the sweep sums besides those of the formulation, in the order of their slots.
    pub transported: Vec<AnyField>,
}

/// Friction as a matrix, and as a term for those who measure forces.
pub struct Friction<const D: usize> {
    /// The matrix.
    pub coupling: Box<dyn Coupling<D>>,
    /// The term.
    pub term: Box<dyn Interaction<D>>,
}

/// Offers all stages and keeps, in order, those that the goals need.
pub fn plan_stages<const D: usize>(
    scene: &Scene,
    choices: &mut Choices<D>,
    laws: &Arc<[Box<dyn BoundState>]>,
    walls: Option<&SharedWall<D>>,
    world: &World<D>,
) -> Result<Planned<D>, SolverError> {
    let renormalises = walls.is_some_and(|w| crate::step::stages::lock(w).renormalises());
    let gamma = || match renormalises {
        true => Access::none().here(fields::RENORMALISATION),
        false => Access::none(),
    };
    let mut terms = vec![choices.formulation.pressure_term()];
    let mut kinds = vec![(terms[0].name(), "formulation")];
    let rheologies: Rheologies = std::mem::take(&mut choices.rheologies).into();
    let eddies = choices.eddy_viscosity.take();
    let elastic_force = choices.elastic_force.take();
    let elastic = elastic_force.is_some();
    let ahead = elastic_force.as_ref().is_some_and(|f| f.implicit());
    let viscosity = viscosity_of(&rheologies, eddies.is_some() || ahead);
    let felt = Felt {
        laws: rheologies.clone(),
        pressure: match choices.effective_pressure {
            Some(_) => fields::EFFECTIVE_PRESSURE,
            None => fields::PRESSURE,
        },
        blend: elastic_force
            .as_ref()
            .map_or(Blend::Stresses, |f| f.blend()),
    };
    let mut friction = Vec::new();
    let mut solved = None;
    let mut sub_stepped = None;
    if viscosity != Viscosity::Uniform(0.0) {
        let term = choices.viscous_operator.term(viscosity);
        kinds.push((term.name(), "viscous-operator"));
        friction = choices.viscous_operator.stages(viscosity);
        match choices.implicit_viscosity.is_some() {
            false if felt.blend == Blend::Forces => {
                let share = Blended::friction(term, &rheologies);
                kinds.push((share.name(), "viscous-operator"));
                terms.push(Box::new(share));
            }
            false => terms.push(term),
            true => {
                solved = Some(Friction {
                    coupling: choices.viscous_operator.coupling(viscosity),
                    term,
                });
            }
        }
    } else if let Some(idle) = scene.choice("implicit-viscosity") {
        return Err(SolverError::at(
            idle.path,
            "no phase of this scene has a viscosity, so that there is nothing to solve for: take \
             this table out, or give a phase a viscosity",
        ));
    }
    let adjoint = choices.velocity_gradient.clone();
    let adjoint = adjoint.filter(|gradient| elastic && gradient.adjoint());
    if let Some(force) = &elastic_force {
        let adjoint = adjoint.is_some();
        elastic::refuse_what_is_not_known(
            scene,
            &**force,
            &felt,
            adjoint,
            choices.implicit_viscosity.as_ref().map(|(s, _)| &**s),
            &*choices.viscous_operator,
            world,
        )?;
        if force.sub_steps() {
            let once = choices.integrator.kicks_once();
            elastic::refuse_sub_steps(scene, &**force, adjoint, once)?;
        }
        let term = elastic::term(&**force, &felt, adjoint);
        kinds.push((term.name(), "elastic-force"));
        match force.sub_steps() {
            true => sub_stepped = Some((term, felt.clone())),
            false => terms.push(term),
        }
    }
    if let Some(smoother) = &choices.smoother {
        let term = smoother.term(laws);
        kinds.push((term.name(), "smoother"));
        terms.push(term);
    }
    refuse_interfaces_of_one(scene)?;
    for interface in &choices.interfaces {
        let term = interface.term(laws);
        kinds.push((term.name(), "interface"));
        terms.push(term);
    }
    let shifted = ShiftedFlow {
        summed: choices.formulation.compressed().is_none(),
    };
    let transport = choices.shifting.iter().find_map(|s| s.term(shifted));
    let density_changes = choices.smoother.is_some() || transport.is_some();
    kinds.extend(transport.iter().map(|t| (t.name(), "shifting")));
    kinds.extend(choices.terms.iter().map(|t| (t.name(), "term")));
    terms.extend(transport);
    terms.append(&mut choices.terms);
    let phases: Vec<String> = scene.phase.keys().cloned().collect();
    let setting = Setting {
        laws,
        phases: &phases,
    };
    for (kind, contribution) in &choices.contributions {
        let offered = contribution.terms(&setting);
        kinds.extend(offered.iter().map(|t| (t.name(), *kind)));
        terms.extend(offered);
    }
    let transported = transported_by(&terms)?;
    let diffused = choices.formulation.diffused();
    let terms: SharedTerms<D> = fuse_all(terms).into();
    let sweep = InteractionSweep {
        terms: terms.clone(),
        diffused: density_changes.then_some(diffused),
        walls: walls.is_some(),
        states: Vec::new(),
        transported: transported.clone(),
        more: Vec::new(),
    };

    let mut offered: Stages<D> = Vec::new();
    if let Some(walls) = walls {
        offered.push(Box::new(WallGeometry(walls.clone())));
    }
    let with_gamma = |stage| -> Box<dyn Stage<World<D>>> {
        Box::new(Also {
            stage,
            access: gamma(),
        })
    };
    offered.extend(choices.formulation.stages().into_iter().map(with_gamma));
    offered.push(Box::new(PressureStage { laws: laws.clone() }));
    if let Some(walls) = walls {
        offered.push(Box::new(WallState(walls.clone())));
    }
    if let Some(effective) = choices.effective_pressure.take() {
        let both = rheologies.iter().zip(laws.iter());
        let soils = both.map(|(law, state)| {
            let soil = law.needs().pressure;
            soil.then(|| state.reference().density)
        });
        let soils = soils.collect();
        offered.push(with_gamma(effective.stage(soils)));
        offered.push(Box::new(PorePressure));
    }
    let gradient = choices.velocity_gradient.take();
    let smoother = choices.smoother.iter().flat_map(|s| s.stages(laws));
    let interfaces = choices.interfaces.iter().flat_map(|i| i.stages());
    let shifting = choices.shifting.iter().flat_map(|s| s.stages(laws));
    let extra = friction
        .into_iter()
        .chain(smoother)
        .chain(interfaces)
        .chain(shifting);
    let extra: Stages<D> = extra.collect();
    let others = offered.iter().chain(&extra).map(|s| s.access());
    let others = others.chain(terms.iter().map(|t| t.access()));
    let phases = match eddies.is_some() || gradients_are_read(scene, choices, others) {
        true => None,
        false => phases_with_gradients(&rheologies),
    };
    let stage_of_gradient = || {
        let formula = gradient.clone()?;
        let phases = phases.clone();
        Some(GradientStage { formula, phases })
    };
    // An elastic motion leaves the gradients of its drift.
    if let (Some(stage), false) = (stage_of_gradient(), elastic) {
        offered.push(with_gamma(Box::new(stage)));
    }
    let coulomb = world.walls.elements.coulomb.is_empty().not().then(|| {
        let slips = |l: &dyn Rheology| l.elastic().is_none() && l.uniform_viscosity().is_some();
        CoulombFriction {
            rubs: rheologies.iter().map(|l| !slips(&**l)).collect(),
            pressure: felt.pressure,
            forces: Vec::new(),
        }
    });
    if gradient.is_some() {
        offered.push(Box::new(StrainRate));
    }
    let viscosity_stage = || ViscosityStage {
        felt: felt.clone(),
        eddies: eddies.is_some(),
    };
    offered.extend(eddies.iter().map(|e| with_gamma(e.stage())));
    offered.push(Box::new(viscosity_stage()));
    if elastic {
        offered.push(match ahead {
            true => Box::new(CarriedAhead(felt.clone())),
            false => Box::new(CarriedStress(felt.clone())),
        });
        offered.push(Box::new(Yielded(felt.clone())));
        if let Some(gradient) = adjoint {
            offered.push(with_gamma(Box::new(StressCorrection(gradient))));
        }
    }
    let mut lagged: Stages<D> = Vec::new();
    if let (Some(stage), true, Some(_)) = (stage_of_gradient(), felt.strain_rate(), &solved) {
        lagged = vec![
            Box::new(stage),
            Box::new(StrainRate),
            Box::new(viscosity_stage()),
        ];
    }
    let elastic = stage_of_gradient().zip(elastic_force);
    let elastic = elastic.map(|(gradient, force)| ElasticMotion {
        gradient,
        felt,
        displaced: force.displaced(),
    });
    offered.extend(extra.into_iter().map(with_gamma));
    for (_, contribution) in &choices.contributions {
        let stages = contribution.stages(&setting).into_iter();
        offered.extend(stages.map(with_gamma));
    }
    offered.push(with_gamma(Box::new(sweep)));

    let mut goals: Vec<AnyField> = vec![fields::ACCELERATION.any()];
    if let Some(solved) = &solved {
        goals.extend(solved.coupling.access().reads());
    }
    if ahead {
        goals.push(fields::ELASTIC_STIFFNESS.any());
    }
    if let Some((term, _)) = &sub_stepped {
        goals.extend(term.access().reads());
    }
    if let Some(coulomb) = &coulomb {
        goals.extend(coulomb.access().reads());
    }
    let seepage = crate::step::seepage::flow(scene, choices, laws)?;
    if let Some(seepage) = &seepage {
        goals.extend(seepage.access().reads());
    }
    if choices.shifting.is_some() {
        goals.push(fields::SHIFT_VELOCITY.any());
    }
    for (_, contribution) in &choices.contributions {
        goals.extend(contribution.transported().iter().map(|e| e.rate.any()));
        goals.extend(contribution.work().reads());
    }
    for stage in &offered {
        let shown = scene.output.fields.iter().chain(&scene.output.picture);
        let measured = choices.probes.iter().flat_map(|(_, p)| p.fields());
        for name in shown.map(String::as_str).chain(measured) {
            goals.extend(stage.access().writes.iter().filter(|f| f.name == name));
        }
    }
    let sources: Vec<AnyField> = [
        fields::POSITION.any(),
        fields::VELOCITY.any(),
        fields::MASS.any(),
        fields::IDENTITY.any(),
        fields::PHASE.any(),
    ]
    .into_iter()
    .chain([diffused.evolved.value.any()])
    .chain(choices.formulation.compressed().map(|c| c.value.any()))
    // Who tells phases apart does so where there are several.
    .filter(|f| *f == fields::PHASE.any() || world.free.has(f.name))
    .chain(elastic.iter().flat_map(ElasticMotion::remembered))
    .chain(
        seepage
            .iter()
            .flat_map(|_| crate::step::seepage::remembered()),
    )
    .chain(own_columns(choices))
    .collect();
    let declared: Vec<&dyn Declares> = offered
        .iter()
        .map(|s| s.as_ref() as &dyn Declares)
        .collect();
    let mut planned = plan(&declared, &goals, &sources)?;
    // Walls without γ still need their geometry checked, although nobody reads a field of it.
    if walls.is_some() && !planned.order.contains(&0) {
        planned.order.insert(0, 0);
        planned.pruned.retain(|k| *k != 0);
    }
    let pruned = planned.pruned.iter().map(|&k| offered[k].name()).collect();
    let mut slots: Vec<_> = offered.into_iter().map(Some).collect();
    let stages = planned
        .order
        .iter()
        .filter_map(|&k| slots[k].take())
        .collect();
    Ok(Planned {
        stages,
        pruned,
        terms,
        kinds,
        friction: solved,
        lagged,
        ahead,
        elastic,
        sub_stepped,
        coulomb,
        seepage,
        transported,
    })
}

/// State that contributions bring along.
fn own_columns<const D: usize>(choices: &Choices<D>) -> Vec<AnyField> {
    let all = choices.contributions.iter().flat_map(|(_, c)| c.columns());
    all.map(|column| column.field).collect()
}

/// The rates that terms write, each once.
fn transported_by<const D: usize>(
    terms: &[Box<dyn Interaction<D>>],
) -> Result<Vec<AnyField>, SolverError> {
    let mut all: Vec<AnyField> = Vec::new();
    for field in terms.iter().flat_map(|t| t.access().writes) {
        if field.shape != Shape::Scalar {
            let name = field.name;
            let why = format!("a pair term writes `{name}`, which is no scalar");
            return Err(SolverError::at("", why));
        }
        if !all.contains(&field) {
            all.push(field);
        }
    }
    match all.len() > TRANSPORTED {
        false => Ok(all),
        true => Err(SolverError::at(
            "",
            format!(
                "the pair terms of this scene transport {} scalars; a sweep sums {TRANSPORTED} at most",
                all.len()
            ),
        )),
    }
}

/// Whether somebody besides the laws reads velocity gradients or strain rates: stages or terms with the access of `others`, probes, outputs.
fn gradients_are_read<const D: usize>(
    scene: &Scene,
    choices: &Choices<D>,
    mut others: impl Iterator<Item = Access>,
) -> bool {
    let of_gradients = [fields::VELOCITY_GRADIENT.any(), fields::STRAIN_RATE.any()];
    let shown = scene.output.fields.iter().chain(&scene.output.picture);
    let measured = choices.probes.iter().flat_map(|(_, p)| p.fields());
    let mut named = shown.map(String::as_str).chain(measured);
    named.any(|name| of_gradients.iter().any(|f| f.name == name))
        || others.any(|a| a.reads().iter().any(|f| of_gradients.contains(f)))
}

/// By phase number, whether the law reads velocity gradients; `None` if all do.
fn phases_with_gradients(rheologies: &Rheologies) -> Option<Arc<[bool]>> {
    let reads = |law: &dyn Rheology| law.needs().strain_rate || law.elastic().is_some();
    let phases: Arc<[bool]> = rheologies.iter().map(|law| reads(&**law)).collect();
    phases.contains(&false).then_some(phases)
}

/// An interface needs two phases.
fn refuse_interfaces_of_one(scene: &Scene) -> Result<(), SolverError> {
    match scene.interfaces().first() {
        Some(first) if scene.phase.len() < 2 => Err(SolverError::at(
            first.path.clone(),
            "the scene has one phase, and interfaces are between two: take this table out, or add \
             a phase",
        )),
        _ => Ok(()),
    }
}

/// One viscosity for all, or a column, which something besides the laws may need.
fn viscosity_of(laws: &Rheologies, column: bool) -> Viscosity {
    let uniform: Vec<_> = laws.iter().map(|l| l.uniform_viscosity()).collect();
    match uniform.first() {
        Some(Some(first)) if !column && uniform.iter().all(|v| v == &Some(*first)) => {
            Viscosity::Uniform(*first)
        }
        _ if laws.len() > 1 => Viscosity::PerPhase,
        _ => Viscosity::PerParticle,
    }
}
