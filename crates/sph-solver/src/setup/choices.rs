//! From names in the scene to built plugins.

use std::sync::Arc;

use serde_json::{Value as Json, json};
use sph_boundary::{Wall, WallEntry};
use sph_contribution::{Contribution, open_kinds};
use sph_core::{Contract, PluginInfo, Registry, RegistryError, SceneProblem};
use sph_implicit::{ImplicitViscosityEntry, LinearSolver, LinearSolverEntry, TimeScheme};
use sph_integrators::{Integrator, IntegratorEntry};
use sph_kernels::Kernel;
use sph_multiphase::{
    EquationOfState, EquationOfStateEntry, Formulation, FormulationEntry, InterfaceEntry,
    InterfaceModel, Shifting, ShiftingEntry, Smoother, SmootherEntry, ViscousOperator,
    ViscousOperatorEntry,
};
use sph_neighbours::{Interaction, KernelEntry, TermEntry};
use sph_probes::{Probe, ProbeEntry, Solution, SolutionEntry};
use sph_rheology::{Rheology, RheologyEntry};
use sph_scene::{PluginChoice, Scene};
use sph_stress::{
    EddyViscosity, EddyViscosityEntry, EffectivePressure, EffectivePressureEntry, ElasticForce,
    ElasticForceEntry, Seepage, SeepageEntry, VelocityGradient, VelocityGradientEntry,
};

use crate::defaults;
use crate::results::summary::PluginInForce;

/// Everything the scene's names stand for.
pub struct Choices<const D: usize> {
    pub kernel: Box<dyn Kernel>,
    pub formulation: Box<dyn Formulation<D>>,
    pub integrator: Box<dyn Integrator>,
    pub walls: Option<Box<dyn Wall<D>>>,
    pub viscous_operator: Box<dyn ViscousOperator<D>>,
    /// How viscosity is taken over a step, and what solves for it; explicitly if there is none.
    pub implicit_viscosity: Option<(Box<dyn TimeScheme>, Box<dyn LinearSolver<D>>)>,
    /// Only where a law asks for a strain rate.
    pub velocity_gradient: Option<Arc<dyn VelocityGradient<D>>>,
    /// Only where a law is elastic.
    pub elastic_force: Option<Box<dyn ElasticForce<D>>>,
    pub effective_pressure: Option<Box<dyn EffectivePressure<D>>>,
    pub seepage: Option<Box<dyn Seepage<D>>>,
    pub eddy_viscosity: Option<Box<dyn EddyViscosity<D>>>,
    pub smoother: Option<Box<dyn Smoother<D>>>,
    pub shifting: Option<Box<dyn Shifting<D>>>,
    pub interfaces: Vec<Box<dyn InterfaceModel<D>>>,
    pub terms: Vec<Box<dyn Interaction<D>>>,
    /// What plugins of kinds offer that the solver does not know, each with its kind.
    pub contributions: Vec<(&'static str, Box<dyn Contribution<D>>)>,
    /// In the order of the phase numbers.
    pub equations_of_state: Vec<Box<dyn EquationOfState>>,
    /// In the order of the phase numbers.
    pub rheologies: Vec<Box<dyn Rheology>>,
    pub probes: Vec<(String, Box<dyn Probe<D>>)>,
    /// Solutions of references, by the reference's name.
    pub solutions: Vec<(String, Box<dyn Solution<D>>)>,
    /// Initial fields, by the body's name.
    pub initial: Vec<(String, Box<dyn Solution<D>>)>,
    /// What is in force, for the summary.
    pub in_force: Vec<PluginInForce>,
}

/// Collects the problems of all plugins before giving up.
struct Builder {
    problems: Vec<SceneProblem>,
    in_force: Vec<PluginInForce>,
}

impl Builder {
    /// All plugins of open kinds.
    fn contributions<const D: usize>(
        &mut self,
        scene: &Scene,
    ) -> Vec<(&'static str, Box<dyn Contribution<D>>)> {
        let mut all = Vec::new();
        for kind in open_kinds() {
            for choice in scene.choices(kind.kind) {
                match kind.build::<D>(&choice.name, &choice.table) {
                    Ok((built, info)) => {
                        self.in_force.push(in_force(&choice, &info));
                        all.push((kind.kind, built));
                    }
                    Err(error) => self.problems.extend(choice.blame(&error)),
                }
            }
        }
        all
    }

    fn build<E: Contract, T>(
        &mut self,
        choice: &PluginChoice,
        make: impl FnOnce(&E) -> Result<T, RegistryError>,
    ) -> Option<T> {
        let built = Registry::<E>::discovered()
            .and_then(|registry| registry.find(&choice.name))
            .and_then(|entry| make(entry).map(|built| (built, *entry.info())));
        match built {
            Ok((built, info)) => {
                self.in_force.push(in_force(choice, &info));
                Some(built)
            }
            Err(error) => {
                self.problems.extend(choice.blame(&error));
                None
            }
        }
    }
}

fn in_force(choice: &PluginChoice, info: &PluginInfo) -> PluginInForce {
    let mut parameters = serde_json::Map::new();
    for (name, value) in sph_core::defaults(&(info.schema)()) {
        parameters.insert(name, value);
    }
    let given = serde_json::to_value(&choice.table).unwrap_or(json!({}));
    if let Json::Object(given) = given {
        parameters.extend(given);
    }
    PluginInForce {
        kind: choice.kind.to_string(),
        name: choice.name.clone(),
        path: choice.path.clone(),
        provider: info.provider.to_string(),
        parameters: Json::Object(parameters),
    }
}

/// The scene's choice of a kind, or the default.
fn choice(scene: &Scene, kind: &'static str) -> Option<PluginChoice> {
    let default = || defaults::of(kind).map(|name| PluginChoice::default_of(kind, name));
    scene.choice(kind).or_else(default)
}

impl<const D: usize> Choices<D> {
    /// Builds every plugin the scene names or needs.
    ///
    /// # Errors
    /// All unknown names and wrong parameters at once.
    pub fn of(scene: &Scene) -> Result<Self, Vec<SceneProblem>> {
        let mut b = Builder {
            problems: Vec::new(),
            in_force: Vec::new(),
        };
        macro_rules! one {
            ($kind:literal, $entry:ty, $make:expr) => {
                choice(scene, $kind).and_then(|c| b.build::<$entry, _>(&c, |e| $make(e, &c.table)))
            };
        }
        let kernel = one!("kernel", KernelEntry, |e: &KernelEntry, t| (e.build)(t));
        let formulation = one!(
            "formulation",
            FormulationEntry,
            |e: &FormulationEntry, t| e.build::<D>(t)
        );
        let integrator = one!("integrator", IntegratorEntry, |e: &IntegratorEntry, t| (e
            .build)(
            t
        ));
        let walls = match scene.wall.is_empty() {
            true => None,
            false => one!("walls", WallEntry, |e: &WallEntry, t| e.build::<D>(t)),
        };
        let viscous_operator = one!(
            "viscous-operator",
            ViscousOperatorEntry,
            |e: &ViscousOperatorEntry, t| e.build::<D>(t)
        );
        let scheme = one!(
            "implicit-viscosity",
            ImplicitViscosityEntry,
            |e: &ImplicitViscosityEntry, t| (e.build)(t)
        );
        let solver = match &scheme {
            // A solver that is named where nothing is solved is said to be of no use elsewhere.
            None => None,
            Some(_) => one!(
                "linear-solver",
                LinearSolverEntry,
                |e: &LinearSolverEntry, t| e.build::<D>(t)
            ),
        };
        if let (None, Some(idle)) = (
            scene.choice("implicit-viscosity"),
            scene.choice("linear-solver"),
        ) {
            let message = "nothing in this scene is solved for: take this table out, or add \
                           [implicit-viscosity.backward-euler]";
            b.problems.push(SceneProblem::new(idle.path, message));
        }
        let implicit_viscosity = scheme.zip(solver);
        let smoother = one!("smoother", SmootherEntry, |e: &SmootherEntry, t| e
            .build::<D>(t));
        let shifting = one!("shifting", ShiftingEntry, |e: &ShiftingEntry, t| e
            .build::<D>(t));
        let interfaces = scene.interfaces();
        let interfaces = interfaces
            .iter()
            .filter_map(|c| b.build::<InterfaceEntry, _>(c, |e| e.build::<D>(&c.table)));
        let interfaces = interfaces.collect();
        let terms = scene.terms();
        let terms = terms
            .iter()
            .filter_map(|c| b.build::<TermEntry, _>(c, |e| e.build::<D>(&c.table)));
        let terms = terms.collect();
        let contributions = b.contributions::<D>(scene);
        let (mut equations_of_state, mut rheologies) = (Vec::new(), Vec::new());
        for phase in scene.phase.keys() {
            let eos = scene.equation_of_state(phase).or_else(|| {
                defaults::of("equation-of-state")
                    .map(|name| PluginChoice::default_of("equation-of-state", name))
            });
            let eos =
                eos.and_then(|c| b.build::<EquationOfStateEntry, _>(&c, |e| (e.build)(&c.table)));
            equations_of_state.extend(eos);
            let law = scene.rheology(phase);
            let law = law.and_then(|c| b.build::<RheologyEntry, _>(&c, |e| (e.build)(&c.table)));
            rheologies.extend(law);
        }
        let eddy_viscosity = one!(
            "eddy-viscosity",
            EddyViscosityEntry,
            |e: &EddyViscosityEntry, t| e.build::<D>(t)
        );
        let mut laws = rheologies.iter();
        let strained = eddy_viscosity.is_some()
            || laws.any(|law| law.needs().strain_rate || law.elastic().is_some());
        let velocity_gradient = match strained {
            true => one!(
                "velocity-gradient",
                VelocityGradientEntry,
                |e: &VelocityGradientEntry, t| e.build::<D>(t)
            ),
            false => None,
        };
        if let (false, Some(idle)) = (
            strained || !b.problems.is_empty(),
            scene.choice("velocity-gradient"),
        ) {
            let message = "no law of this scene feels a strain rate: take this table out";
            b.problems.push(SceneProblem::new(idle.path, message));
        }
        let elastic = rheologies.iter().any(|law| law.elastic().is_some());
        let elastic_force = match elastic {
            true => one!(
                "elastic-force",
                ElasticForceEntry,
                |e: &ElasticForceEntry, t| e.build::<D>(t)
            ),
            false => None,
        };
        if let (false, Some(idle)) = (
            elastic || !b.problems.is_empty(),
            scene.choice("elastic-force"),
        ) {
            let message = "no law of this scene is elastic: take this table out";
            b.problems.push(SceneProblem::new(idle.path, message));
        }
        let effective_pressure = one!(
            "effective-pressure",
            EffectivePressureEntry,
            |e: &EffectivePressureEntry, t| e.build::<D>(t)
        );
        let pressed = rheologies.iter().any(|law| law.needs().pressure);
        if let (false, Some(idle)) = (
            pressed || !b.problems.is_empty(),
            scene.choice("effective-pressure"),
        ) {
            let message = "no law of this scene feels a pressure: take this table out";
            b.problems.push(SceneProblem::new(idle.path, message));
        }
        let seepage = one!("seepage", SeepageEntry, |e: &SeepageEntry, t| e
            .build::<D>(t));
        let mut probes = Vec::new();
        for (name, c) in scene.probes() {
            let probe = b.build::<ProbeEntry, _>(&c, |e| e.build::<D>(&c.table));
            probes.extend(probe.map(|p| (name, p)));
        }
        let mut named = |choice: &dyn Fn(&str) -> Option<PluginChoice>, names: Vec<&String>| {
            let mut found = Vec::new();
            for name in names {
                if let Some(c) = choice(name) {
                    let built = b.build::<SolutionEntry, _>(&c, |e| e.build::<D>(&c.table));
                    found.extend(built.map(|s| (name.clone(), s)));
                }
            }
            found
        };
        let solutions = named(&|n| scene.solution(n), scene.reference.keys().collect());
        let initial = named(&|n| scene.initial(n), scene.body.keys().collect());
        let all = (kernel, formulation, integrator, viscous_operator);
        match all {
            (Some(kernel), Some(formulation), Some(integrator), Some(viscous_operator))
                if b.problems.is_empty() =>
            {
                Ok(Choices {
                    kernel,
                    formulation,
                    integrator,
                    walls,
                    viscous_operator,
                    implicit_viscosity,
                    velocity_gradient: velocity_gradient.map(Arc::from),
                    elastic_force,
                    effective_pressure,
                    seepage,
                    eddy_viscosity,
                    smoother,
                    shifting,
                    interfaces,
                    terms,
                    contributions,
                    equations_of_state,
                    rheologies,
                    probes,
                    solutions,
                    initial,
                    in_force: b.in_force,
                })
            }
            _ => Err(b.problems),
        }
    }
}
