//! From names in the scene to built plugins.

use std::sync::Arc;

use sph_boundary::{Mover, MoverEntry, Wall, WallEntry};
use sph_core::SceneProblem;
use sph_implicit::{ImplicitViscosityEntry, LinearSolver, LinearSolverEntry, TimeScheme};
use sph_integrators::{Integrator, IntegratorEntry};
use sph_kernels::Kernel;
use sph_multiphase::{Formulation, FormulationEntry, PressureEntry, PressureScheme};
use sph_neighbours::{KernelEntry, TermEntry, Terms};
use sph_open::{OpenBoundary, OpenBoundaryEntry};
use sph_probes::{Probe, ProbeEntry, Solution, SolutionEntry};
use sph_rheology::RheologyEntry;
use sph_scene::{PluginChoice, Scene};
use sph_state::{EquationOfState, EquationOfStateEntry};
use sph_stress::{
    ElasticForce, ElasticForceEntry, Rheologies, VelocityGradient, VelocityGradientEntry,
};
use sph_viscosity::{ViscousOperator, ViscousOperatorEntry};

use crate::defaults;
use crate::setup::builder::{Builder, Part};
use crate::setup::in_force::PluginInForce;

/// Everything the scene's names stand for.
pub struct Choices<const D: usize> {
    /// The kernel.
    pub kernel: Box<dyn Kernel>,
    /// The time stepping scheme.
    pub integrator: Box<dyn Integrator>,
    /// The treatment of walls; none without walls.
    pub walls: Option<Box<dyn Wall<D>>>,
    /// What moves walls, by the wall's name.
    pub movers: Vec<(String, Box<dyn Mover<D>>)>,
    /// Laws of open faces, by the wall's name.
    pub open: Vec<(String, Box<dyn OpenBoundary<D>>)>,
    /// What acts on the particles.
    pub physics: Physics<D>,
    /// In the order of the phase numbers.
    pub equations_of_state: Vec<Box<dyn EquationOfState>>,
    /// Probes, by name.
    pub probes: Vec<(String, Box<dyn Probe<D>>)>,
    /// Solutions of references, by the reference's name.
    pub solutions: Vec<(String, Box<dyn Solution<D>>)>,
    /// Initial fields, by the body's name.
    pub initial: Vec<(String, Box<dyn Solution<D>>)>,
    /// What is in force, for the summary.
    pub in_force: Vec<PluginInForce>,
}

/// How viscosity is taken over a step, and what solves for it.
pub type ImplicitSolve<const D: usize> = (Box<dyn TimeScheme>, Box<dyn LinearSolver<D>>);

/// What acts on the particles.
pub struct Physics<const D: usize> {
    /// What density is, and how its pressure acts.
    pub formulation: Arc<dyn Formulation<D>>,
    /// Which pressure acts; that of the equations of state if there is none.
    pub pressure: Option<Box<dyn PressureScheme<D>>>,
    /// Friction between particles.
    pub viscous_operator: Box<dyn ViscousOperator<D>>,
    /// Explicitly if there is none.
    pub implicit_viscosity: Option<ImplicitSolve<D>>,
    /// Only where a law asks for a strain rate.
    pub velocity_gradient: Option<Arc<dyn VelocityGradient<D>>>,
    /// Only where a law is elastic.
    pub elastic_force: Option<Box<dyn ElasticForce<D>>>,
    /// Pair terms that the scene names itself.
    pub terms: Terms<D>,
    /// In the order of the phase numbers.
    pub rheologies: Rheologies,
    /// What plugins of kinds offer that the solver does not know, each with its kind.
    pub contributions: Vec<Part<D>>,
}

impl<const D: usize> Choices<D> {
    /// Builds every plugin the scene names or needs.
    ///
    /// # Errors
    /// All unknown names and wrong parameters at once.
    pub fn of(scene: &Scene) -> Result<Self, Vec<SceneProblem>> {
        let mut b = Builder::new(scene);
        let kernel = b.one::<D, KernelEntry>();
        let integrator = b.one::<D, IntegratorEntry>();
        let walls = match scene.wall.is_empty() {
            true => None,
            false => b.one::<D, WallEntry>(),
        };
        let movers = scene.wall.keys().cloned();
        let movers = movers.filter_map(|n| Some((n.clone(), scene.mover(&n)?)));
        let movers = b.named::<D, MoverEntry>(movers);
        let open = scene.wall.keys().cloned();
        let open = open.filter_map(|n| Some((n.clone(), scene.open_boundary(&n)?)));
        let open = b.named::<D, OpenBoundaryEntry>(open);
        let physics = b.physics::<D>();
        let equations_of_state = b.equations_of_state::<D>();
        let probes = b.named::<D, ProbeEntry>(scene.probes());
        let of_references = scene.reference.keys().cloned();
        let solutions = of_references.filter_map(|n| Some((n.clone(), scene.solution(&n)?)));
        let solutions = b.named::<D, SolutionEntry>(solutions);
        let of_bodies = scene.body.keys().cloned();
        let initial = of_bodies.filter_map(|n| Some((n.clone(), scene.initial(&n)?)));
        let initial = b.named::<D, SolutionEntry>(initial);
        match (kernel, integrator, physics) {
            (Some(kernel), Some(integrator), Some(physics)) if b.problems.is_empty() => {
                Ok(Choices {
                    kernel,
                    integrator,
                    walls,
                    movers,
                    open,
                    physics,
                    equations_of_state,
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

impl Builder<'_> {
    fn equations_of_state<const D: usize>(&mut self) -> Vec<Box<dyn EquationOfState>> {
        const KIND: &str = "equation-of-state";
        let default = || defaults::of(KIND).map(|name| PluginChoice::default_of(KIND, name));
        let phases = self.scene.phase.keys();
        let choices = phases.map(|phase| self.scene.equation_of_state(phase).or_else(default));
        let choices: Vec<_> = choices.flatten().collect();
        self.each::<D, EquationOfStateEntry>(choices)
    }

    /// What acts on the particles; none if something is missing.
    fn physics<const D: usize>(&mut self) -> Option<Physics<D>> {
        let scene = self.scene;
        let laws = scene.phase.keys().filter_map(|phase| scene.rheology(phase));
        let rheologies: Rheologies = self.each::<D, RheologyEntry>(laws.collect()).into();
        let formulation = self.one::<D, FormulationEntry>();
        let pressure = self.one::<D, PressureEntry>();
        let viscous_operator = self.one::<D, ViscousOperatorEntry>();
        let implicit_viscosity = self.implicit_viscosity::<D>();
        let eddies = scene.choice("eddy-viscosity").is_some();
        let elastic = rheologies.iter().any(|law| law.elastic().is_some());
        let felt = rheologies.iter().any(|law| law.needs().strain_rate);
        let strained = eddies || felt || elastic || shows_gradients(scene);
        let velocity_gradient = self.where_needed::<D, VelocityGradientEntry>(
            strained,
            "no law of this scene feels a strain rate, and no output shows one: take this table out",
        );
        let elastic_force = self.where_needed::<D, ElasticForceEntry>(
            elastic,
            "no law of this scene is elastic: take this table out",
        );
        let terms = self.each::<D, TermEntry>(scene.terms());
        let contributions = self.contributions::<D>();
        Some(Physics {
            formulation: formulation?.into(),
            pressure,
            viscous_operator: viscous_operator?,
            implicit_viscosity,
            velocity_gradient: velocity_gradient.map(Arc::from),
            elastic_force,
            terms,
            rheologies,
            contributions,
        })
    }

    /// What solves for friction, and how; a solver is of no use without.
    fn implicit_viscosity<const D: usize>(&mut self) -> Option<ImplicitSolve<D>> {
        let scheme = self.one::<D, ImplicitViscosityEntry>();
        if let Some(scheme) = scheme {
            return Some((scheme, self.one::<D, LinearSolverEntry>()?));
        }
        let idle = self.scene.choice("linear-solver");
        if let (None, Some(idle)) = (self.scene.choice("implicit-viscosity"), idle) {
            let add = defaults::suggested("implicit-viscosity");
            let add = add.map_or(String::new(), |table| format!(", or add {table}"));
            let message = format!("nothing in this scene is solved for: take this table out{add}");
            self.problems.push(SceneProblem::new(idle.path, message));
        }
        None
    }
}

/// Whether an output or a probe asks for a field that is made from the velocity gradient.
fn shows_gradients(scene: &Scene) -> bool {
    let shown = scene.output.fields.iter().chain(&scene.output.picture);
    let named = |value: &toml::Value| match value {
        toml::Value::String(name) => sph_probes::needs_gradient(name),
        toml::Value::Array(all) => all
            .iter()
            .filter_map(toml::Value::as_str)
            .any(sph_probes::needs_gradient),
        _ => false,
    };
    let probes = scene.probes();
    let mut values = probes.iter().flat_map(|(_, probe)| probe.table.values());
    shown.clone().any(|name| sph_probes::needs_gradient(name)) || values.any(named)
}
