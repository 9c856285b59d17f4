//! Plugins from outside: a kernel, a force and eddy viscosities that no crate of the workspace knows, and the
//! laws of `examples/syrup`.
//!
//! Everything between the two lines could be a crate of its own. A binary that mentions it,
//! `use my_plugins as _;`, and calls `sph_cli::main()` has the plugins in all its commands.

use sph_contribution::{Contribution, Offer, Refusal, Setting, contribution_kind};
use sph_core::{Access, Declares, Stage, StepError, fields, plugin};
use sph_kernels::{Kernel, Sampler, ScalarSampler};
use sph_multiphase::viscosity::EddyViscosityEntry;
use sph_neighbours::{
    Interaction, KernelEntry, Neighbourhood, Rates, RowTerm, TermEntry, WithTerm, World,
};

// ------------------------------------------------------------------------------------------------

/// f(q) = exp(−q²), cut at q = 3.
#[plugin(KernelEntry, "gaussian", "a bell cut at 3h", source: "Gingold & Monaghan (1977)")]
struct Gaussian {}

impl Kernel for Gaussian {
    fn name(&self) -> &str {
        "gaussian"
    }
    fn support(&self) -> f64 {
        3.0
    }
    fn value(&self, q: f64) -> f64 {
        if q < 3.0 { (-q * q).exp() } else { 0.0 }
    }
    fn derivative(&self, q: f64) -> f64 {
        -2.0 * q * self.value(q)
    }
    fn sampler(&self, dimension: usize, h: f64) -> Box<dyn Sampler> {
        Box::new(ScalarSampler::new(*self, dimension, h))
    }
}

/// du/dt = −u/τ.
#[plugin(TermEntry [2, 3], "linear-drag", "a force against the velocity", source: "Stokes")]
struct LinearDrag {
    /// Time τ in which the velocity falls to 1/e.
    #[parameter(unit: "s", above: 0.0)]
    time: f64,
}

/// The drag with the column it reads.
struct BoundDrag<'a, const D: usize> {
    velocity: &'a [sph_core::Vect<D>],
    rate: f64,
}

impl<const D: usize> RowTerm<D> for BoundDrag<'_, D> {
    fn row(&self, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.acceleration -= self.velocity[at.particle] * self.rate;
    }
}

impl<const D: usize> Interaction<D> for LinearDrag {
    fn name(&self) -> String {
        "linear drag".into()
    }
    fn access(&self) -> Access {
        Access::none().here(fields::VELOCITY)
    }
    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        with(&BoundDrag {
            velocity: world.free.get(fields::VELOCITY)?,
            rate: 1.0 / self.time,
        })
    }
}

/// The drag of a kind, by its name, with a rate.
struct Brake(&'static str, f64);

impl<const D: usize> Interaction<D> for Brake {
    fn name(&self) -> String {
        self.0.into()
    }
    fn access(&self) -> Access {
        Access::none().here(fields::VELOCITY)
    }
    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        with(&BoundDrag {
            velocity: world.free.get(fields::VELOCITY)?,
            rate: self.1,
        })
    }
}

/// Kinds with one plugin each: a drag.
macro_rules! brakes {
    ($($entry:ident $plugin:ident $kind:literal,)+) => {$(
        contribution_kind!(
            /// A drag.
            $entry, $kind, Any, "a force against the velocity"
        );

        #[plugin($entry [2, 3], "brake", "a force against the velocity", source: "Stokes")]
        struct $plugin {
            /// Share of the velocity that is lost in a second.
            rate: f64,
        }

        impl<const D: usize> Contribution<D> for $plugin {
            fn offer(&mut self, _: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
                offer.term(Brake($kind, self.rate));
                Ok(())
            }
        }
    )+};
}

brakes! {
    BandBrakeEntry BandBrake "band-brake",
    DiscBrakeEntry DiscBrake "disc-brake",
    DrumBrakeEntry DrumBrake "drum-brake",
    RimBrakeEntry RimBrake "rim-brake",
}

/// η_t = η₀ + ρ (C δr)² γ̇: Smagorinsky's, with a constant part.
#[plugin(EddyViscosityEntry [2, 3], "eddies", "a constant and Smagorinsky's", source: "Smagorinsky 1963")]
struct Eddies {
    /// η₀.
    #[parameter(unit: "Pa s")]
    constant: f64,
    /// C.
    coefficient: f64,
}

impl Declares for Eddies {
    fn name(&self) -> String {
        "eddies".into()
    }
    fn access(&self) -> Access {
        let access = Access::none()
            .here(fields::DENSITY)
            .here(fields::STRAIN_RATE);
        access.writes(fields::EDDY_VISCOSITY)
    }
}

impl<const D: usize> Stage<World<D>> for Eddies {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let density = world.free.get(fields::DENSITY)?.iter();
        let rates = density.zip(world.free.get(fields::STRAIN_RATE)?);
        let squared = (self.coefficient * world.spacing).powi(2);
        let eddies = rates
            .map(|(rho, rate)| self.constant + rho * squared * rate)
            .collect();
        Ok(world.free.put(fields::EDDY_VISCOSITY, eddies)?)
    }
}

impl<const D: usize> Contribution<D> for Eddies {
    fn offer(&mut self, _: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.stage(*self);
        Ok(())
    }
}

use sph_core::{Field, Role, Scalar};

/// No eddies, a column of its own that remembers, and a step that fails.
#[plugin(EddyViscosityEntry [2, 3], "remembering", "none, with a memory", source: "nobody")]
struct Remembering {
    /// The first evaluation after this time fails.
    #[parameter(unit: "s")]
    fails_after: f64,
    /// Whether it has.
    #[serde(skip)]
    failed: bool,
}

/// The latest time that a particle has seen.
const LATEST: Field<Scalar> = Field::new("latest", "s", "the latest time that was seen");

impl Declares for Remembering {
    fn name(&self) -> String {
        "remembering".into()
    }
    fn access(&self) -> Access {
        let access = Access::none().writes(fields::EDDY_VISCOSITY);
        access.writes(LATEST)
    }
}

impl<const D: usize> Stage<World<D>> for Remembering {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let refused = |reason: String| StepError::Stage {
            stage: "remembering".into(),
            reason,
        };
        let now = world.time;
        world.free.add(LATEST, Role::State);
        for latest in world.free.get_mut(LATEST)? {
            if *latest > now {
                let why =
                    format!("a particle remembers {latest} s, which is yet to come at {now} s");
                return Err(refused(why));
            }
            *latest = now;
        }
        world.free.get_mut(fields::EDDY_VISCOSITY)?.fill(0.0);
        let fails = !self.failed && now > self.fails_after;
        self.failed |= fails;
        match fails {
            true => Err(refused("it was told to".into())),
            false => Ok(()),
        }
    }
}

impl<const D: usize> Contribution<D> for Remembering {
    fn offer(&mut self, _: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.stage(*self);
        Ok(())
    }
}

// ------------------------------------------------------------------------------------------------

use sph_particles::{RunError, Summary};
use sph_rheology::{Rheology, rheometer};
use sph_solver::SolverError;
use sph_tests::{DAM_BREAK, PERIODIC, Ran, Says, near, ran, scene};
use syrup::PowellEyring;

fn run_text(text: &str) -> Result<Ran, RunError> {
    ran(&scene(text, &[]), 2)
}

fn provider(summary: &Summary, name: &str) -> String {
    let found = summary.plugins.iter().find(|p| p.name == name);
    found.expect("the plugin is in force").provider.clone()
}

#[test]
fn a_drag_of_ones_own_slows_a_uniform_flow_exponentially() {
    let fine = PERIODIC.replace("end = 0.1", "end = 0.1\nsafety = 0.1");
    let scene = format!("{fine}\n[term.linear-drag]\ntime = \"50 ms\"\n");
    let summary = run_text(&scene).unwrap().summary;
    assert!(provider(&summary, "linear-drag").starts_with("sph-tests"));
    // ½ m |u|² exp(−2t/τ) with m = 1000 kg, u² = 1.25 m²/s², t = 0.1 s.
    let exact = 0.5 * 1000.0 * 1.25 * (-4.0f64).exp();
    near(summary.kinetic_energy, exact, 0.02, "J, t Δt/τ² = 0.016");
}

/// All of the energy that goes is the work of the drag, and none of it that of others.
#[test]
fn the_work_of_a_drag_of_ones_own_stands_under_its_kind() {
    let plugins =
        "[term.linear-drag]\ntime = \"50 ms\"\n[probe.budget]\nkind = \"energy-budget\"\n";
    let run = run_text(&format!("{PERIODIC}\n{plugins}")).unwrap();
    let last = |name: &str| run.last(name);
    let lost = run.column("budget.kinetic")[0] - last("budget.kinetic");
    assert!(lost > 100.0, "{lost} J");
    let work = last("budget.term");
    assert!((work / lost + 1.0).abs() < 1e-6, "{work} J of {lost} J");
    assert_eq!(last("budget.others"), 0.0);
}

/// Each has the share of its rate in the energy that goes.
#[test]
fn four_kinds_of_ones_own_have_four_accounts() {
    let kinds = ["band-brake", "disc-brake", "drum-brake", "rim-brake"];
    let rates = [1.0, 2.0, 3.0, 4.0];
    let both = || kinds.into_iter().zip(rates);
    let tables = both().map(|(kind, rate)| format!("[{kind}.brake]\nrate = {rate:?}\n"));
    let tables: String = tables.collect();
    let budget = "[probe.budget]\nkind = \"energy-budget\"\n";
    let run = run_text(&format!("{PERIODIC}\n{tables}{budget}")).unwrap();
    let lost = run.column("budget.kinetic")[0] - run.last("budget.kinetic");
    assert!(lost > 100.0, "{lost} J");
    for (kind, rate) in both() {
        let share = -run.last(&format!("budget.{kind}")) / lost;
        assert!((share / (0.1 * rate) - 1.0).abs() < 1e-6, "{kind}: {share}");
    }
    assert_eq!(run.last("budget.others"), 0.0);
}

#[test]
fn a_kernel_of_ones_own_runs_where_there_are_no_walls() {
    let run = run_text(&format!("{PERIODIC}\n[kernel.gaussian]\n")).unwrap();
    let summary = run.summary;
    assert!(provider(&summary, "gaussian").starts_with("sph-tests"));
    assert!(summary.drift.momentum.abs() < 1e-12, "{:?}", summary.drift);
    // 36π neighbours in a support of 3h = 6δr, the particle itself not counted.
    assert!((summary.neighbours - 36.0 * std::f64::consts::PI).abs() < 4.0);
}

#[test]
fn walls_that_integrate_moments_refuse_it_and_say_why() {
    let refused = run_text(&format!("{DAM_BREAK}\n[kernel.gaussian]\n"))
        .err()
        .expect("refused");
    assert!(matches!(refused, RunError::Solver(SolverError::Scene(_))));
    let told = refused.to_string();
    told.says("`gaussian` gives no radial moments");
}

#[test]
fn a_rheology_of_ones_own_is_as_good_as_a_built_in_one() {
    let syrup = DAM_BREAK
        .replace("rheology.newtonian", "rheology.syrup")
        .replace("viscosity = \"1 mPa s\"", "thickness = \"1 mPa s\"");
    let [ours, theirs] = [&syrup, DAM_BREAK].map(|scene| run_text(scene).unwrap().state());
    ours.assert_same(&theirs, "syrup and a Newtonian fluid");
}

/// arsinh(2)/2 = 0.7218; far up the curve η γ̇ = η₀ ln(2λγ̇)/λ.
#[test]
fn a_law_of_ones_own_that_reads_the_strain_rate_thins_the_flow() {
    let law = PowellEyring {
        rest_viscosity: 10.0,
        infinite_viscosity: 0.0,
        relaxation_time: 2.0,
    };
    assert!(law.needs().strain_rate);
    let found = rheometer::viscosities(&law, 0.0, &[0.0, 1.0, 1e3, 1e6]);
    assert_eq!(found[0], 10.0);
    assert!((found[1] - 7.218_177).abs() < 1e-6, "{found:?}");
    let grown = 1e6 * found[3] - 1e3 * found[2];
    assert!((grown - 5.0 * 1e3f64.ln()).abs() < 1e-5, "{grown}");
    let newtonian = "[phase.water.rheology.newtonian]\nviscosity = \"1 mPa s\"";
    let energy = |keys: &str| {
        let law = format!("[phase.water.rheology.{keys}");
        let scene = DAM_BREAK.replace(newtonian, &law);
        assert_ne!(scene, DAM_BREAK);
        run_text(&scene).unwrap().summary.kinetic_energy
    };
    let thick = energy("newtonian]\nviscosity = 10.0");
    let rest = energy("powell-eyring]\nrest_viscosity = 10.0\nrelaxation_time = 0.0");
    assert!((rest / thick - 1.0).abs() < 1e-9, "{rest} J for {thick} J");
    let thin = energy("powell-eyring]\nrest_viscosity = 10.0\nrelaxation_time = \"10 s\"");
    assert!(thin > 1.2 * thick, "{thin} J for {thick} J");
}

/// 1 mPa s of water and 9 of eddies are 10 mPa s; with Smagorinsky's part the flow loses more.
#[test]
fn an_eddy_viscosity_of_ones_own_adds_to_that_of_the_fluid() {
    let eddies = |c: f64| {
        let table = format!("[eddy-viscosity.eddies]\nconstant = \"9 mPa s\"\ncoefficient = {c}\n");
        let ran = run_text(&format!("{DAM_BREAK}\n{table}")).unwrap();
        ran.summary.kinetic_energy
    };
    let thick = DAM_BREAK.replace("viscosity = \"1 mPa s\"", "viscosity = \"10 mPa s\"");
    assert_ne!(thick, DAM_BREAK);
    let together = run_text(&thick).unwrap().summary.kinetic_energy;
    let found = eddies(0.0);
    near(found, together, 1e-9, "J");
    let more = eddies(0.3);
    assert!(more < found * (1.0 - 1e-6), "{more} J for {found} J");
}

/// The step that fails has written 0.1 s and more into the plugin's column; the shorter one must not find it there.
#[test]
fn a_column_of_ones_own_that_remembers_is_rolled_back_with_the_step() {
    for integrator in ["symplectic-euler", "predictor-corrector"] {
        let plugin = "[eddy-viscosity.remembering]\nfails_after = 0.1\n";
        let scene = format!("{DAM_BREAK}\n[integrator.{integrator}]\n{plugin}");
        let ran = run_text(&scene).unwrap_or_else(|e| panic!("{integrator}: {e}"));
        assert_eq!(ran.summary.steps_rolled_back, 1, "{integrator}");
    }
}

#[test]
fn an_outside_plugin_is_in_the_schema_for_editors() {
    let schema = sph_scene::schema().to_string();
    schema.says("\"gaussian\" | \"linear-drag\" | \"syrup\" | \"eddies\"");
}
