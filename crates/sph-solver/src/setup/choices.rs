//! From names in the scene to built plugins.

use sph_boundary::{Mover, MoverEntry, Wall, WallEntry};
use sph_contribution::integrators::{Integrator, IntegratorEntry};
use sph_contribution::{Part, PluginInForce, Plugins};
use sph_core::{Work, fields, kind_of};
use sph_kernels::Kernel;
use sph_multiphase::{Formulation, FormulationEntry};
use sph_neighbours::KernelEntry;
use sph_open::{OpenBoundary, OpenBoundaryEntry};
use sph_probes::{Probe, ProbeEntry, Solution, SolutionEntry, needs_gradient};
use sph_rheology::state::{EquationOfState, EquationOfStateEntry};
use sph_rheology::{Rheology, RheologyEntry};
use sph_scene::Scene;

use crate::error::SolverError;

/// Everything the scene's names stand for.
pub struct Choices<const D: usize> {
    /// The kernel.
    pub kernel: Box<dyn Kernel>,
    /// The time stepping scheme.
    pub integrator: Box<dyn Integrator>,
    /// The treatment of walls; none without walls.
    pub walls: Option<Box<dyn Wall<D>>>,
    /// Movers of walls, by the wall's name.
    pub movers: Vec<(String, Box<dyn Mover<D>>)>,
    /// Laws of open faces, by the wall's name.
    pub open: Vec<(String, Box<dyn OpenBoundary<D>>)>,
    /// The definition of density, and its pressure gradient.
    pub formulation: Box<dyn Formulation<D>>,
    /// In the order of the phase numbers.
    pub rheologies: Vec<Box<dyn Rheology>>,
    /// In the order of the phase numbers.
    pub equations_of_state: Vec<Box<dyn EquationOfState>>,
    /// The contributions of all plugins, in the order of their kinds.
    pub parts: Vec<Part<D>>,
    /// Probes, by name.
    pub probes: Vec<(String, Box<dyn Probe<D>>)>,
    /// Solutions of references, by the reference's name.
    pub solutions: Vec<(String, Box<dyn Solution<D>>)>,
    /// Initial fields, by the body's name.
    pub initial: Vec<(String, Box<dyn Solution<D>>)>,
    /// All plugins that were built, for the summary.
    pub in_force: Vec<PluginInForce>,
}

/// The plugins that a scene names.
pub fn plugins(scene: &Scene) -> Plugins {
    let one = |phase: &String| {
        let kinds = ["rheology", "equation-of-state"].into_iter();
        kinds
            .filter_map(|kind| scene.choice_in(kind, phase))
            .collect()
    };
    let choices = scene.kinds_named().flat_map(|kind| scene.choices(kind));
    Plugins::new(choices.collect(), scene.phase.keys().map(one).collect())
}

/// The kinds of plugins of a scene whose work has an account of its own in the energy budget.
pub fn own_accounts(scene: &Scene) -> Vec<&'static str> {
    let own = |kind: &str| kind_of(kind).is_some_and(|kind| kind.work == Work::Own);
    let kinds = scene.kinds_named();
    kinds
        .filter(|kind| own(kind) && sph_contribution::contributes(kind))
        .collect()
}

/// Choices of a scene for things with names of their own.
fn named<'n, T>(
    names: impl Iterator<Item = &'n String>,
    choice: impl Fn(&str) -> Option<T>,
) -> Vec<(String, T)> {
    let chosen = |name: &String| Some((name.clone(), choice(name)?));
    names.filter_map(chosen).collect()
}

impl<const D: usize> Choices<D> {
    /// Builds every plugin the scene names or needs.
    ///
    /// # Errors
    /// All unknown names and wrong parameters at once.
    pub fn from_scene(scene: &Scene) -> Result<Self, SolverError> {
        let mut plugins = plugins(scene);
        let walls = match scene.wall.is_empty() {
            true => None,
            false => plugins.one::<D, WallEntry>(),
        };
        let movers = named(scene.wall.keys(), |wall| scene.choice_in("mover", wall));
        let open = named(scene.wall.keys(), |wall| {
            scene.choice_in("open-boundary", wall)
        });
        let solutions = named(scene.reference.keys(), |name| scene.solution(name));
        let initial = named(scene.body.keys(), |body| scene.choice_in("initial", body));
        let probes = plugins.named::<D, ProbeEntry>(scene.probes());
        plugins.shown = shown(scene, &probes);
        if plugins.shown.iter().any(|name| needs_gradient(name)) {
            plugins.shown.push(fields::VELOCITY_GRADIENT.name.into());
        }
        let kernel = plugins.one::<D, KernelEntry>();
        let integrator = plugins.one::<D, IntegratorEntry>();
        let formulation = plugins.one::<D, FormulationEntry>();
        let parts = sph_contribution::parts(&plugins);
        let movers = plugins.named::<D, MoverEntry>(movers);
        let open = plugins.named::<D, OpenBoundaryEntry>(open);
        let rheologies = plugins.of_phases::<D, RheologyEntry>();
        let equations_of_state = plugins.of_phases::<D, EquationOfStateEntry>();
        let solutions = plugins.named::<D, SolutionEntry>(solutions);
        let initial = plugins.named::<D, SolutionEntry>(initial);
        let in_force = plugins.in_force().map_err(SolverError::Scene)?;
        let missing = |kind: &str| SolverError::at(kind, "this binary has no plugin of the kind");
        Ok(Choices {
            kernel: kernel.ok_or_else(|| missing("kernel"))?,
            integrator: integrator.ok_or_else(|| missing("integrator"))?,
            walls,
            movers,
            open,
            formulation: formulation.ok_or_else(|| missing("formulation"))?,
            rheologies,
            equations_of_state,
            parts,
            probes,
            solutions,
            initial,
            in_force,
        })
    }
}

/// Names of the columns that outputs show and probes measure.
pub fn shown<const D: usize>(scene: &Scene, probes: &[(String, Box<dyn Probe<D>>)]) -> Vec<String> {
    let shown = scene.output.fields.iter().chain(&scene.output.picture);
    let measured = probes.iter().flat_map(|(_, p)| p.needs().fields);
    shown.cloned().chain(measured).collect()
}
