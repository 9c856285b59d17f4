//! A kind of plugin from outside: heat and salt that diffuse through a fluid, `[tracer.heat-and-salt]`.
//!
//! Everything between the two lines could be a crate of its own; no crate of the workspace knows it.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_contribution::{Contribution, OwnColumn, Setting, contribution_kind};
use sph_core::reexport::inventory;
use sph_core::{Access, Evolved, Field, Scalar, StepError, StepLimit, fields, register};
use sph_multiphase::Limiter;
use sph_neighbours::{
    BoundTerm, FusionEntry, Interaction, Pair, PairTerm, Rates, Term, There, World, fuse_two,
};

// ------------------------------------------------------------------------------------------------

contribution_kind!(
    /// What diffuses through a fluid.
    pub TracerEntry, "tracer", Any, "what diffuses through the fluid", "none if left out"
);

const VALUE: [Field<Scalar>; 2] = [
    Field::new(
        "temperature",
        "K",
        "temperature over that of the surroundings",
    ),
    Field::new("salinity", "g/kg", "salt over mass"),
];
const RATE: [Field<Scalar>; 2] = [
    Field::new("temperature_rate", "K/s", "rate of the temperature"),
    Field::new("salinity_rate", "g/(kg s)", "rate of the salinity"),
];

/// dA/dt = 2κ Σ_b V_b (A_a − A_b) F_ab of the scalar number K (Morris 1997, for a scalar).
struct Diffusion<const K: usize>(f64);

struct BoundDiffusion<'a> {
    value: &'a [f64],
    twice: f64,
    slot: usize,
}

impl<const D: usize, const K: usize> PairTerm<D> for Diffusion<K> {
    type Bound<'a> = BoundDiffusion<'a>;
    fn name(&self) -> String {
        format!("diffusion of {}", VALUE[K].name)
    }
    fn access(&self) -> Access {
        let access = Access::none().both(VALUE[K]).writes(RATE[K]);
        access.neighbours(fields::VOLUME)
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError> {
        Ok(BoundDiffusion {
            value: world.free.get(VALUE[K])?,
            twice: 2.0 * self.0,
            slot: world.slot(RATE[K])?,
        })
    }
}

impl<const D: usize> BoundTerm<D> for BoundDiffusion<'_> {
    type Here = f64;
    type Sum = f64;
    fn here(&self, i: usize) -> f64 {
        self.value[i]
    }
    fn zero(&self) -> f64 {
        0.0
    }
    #[inline(always)]
    fn free(&self, here: &f64, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut f64) {
        *sum += there.volume * (here - self.value[j]) * pair.factor;
    }
    fn finish(&self, _: &f64, sum: &f64, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.more[self.slot] += self.twice * sum * inverse_gamma;
    }
}

inventory::submit! {
    FusionEntry {
        terms: 2,
        fuse_2d: fuse_two::<2, Diffusion<0>, Diffusion<1>>,
        fuse_3d: fuse_two::<3, Diffusion<0>, Diffusion<1>>,
    }
}

/// Heat and salt, waves at the start.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct HeatAndSalt {
    /// Diffusivity of heat.
    #[schemars(range(min = 0.0), extend("unit" = "m²/s"))]
    heat: f64,
    /// Diffusivity of salt.
    #[schemars(range(min = 0.0), extend("unit" = "m²/s"))]
    salt: f64,
    /// Bound on the step: Δt ≤ limit · h²/κ.
    #[serde(default = "quarter")]
    limit: f64,
}

fn quarter() -> f64 {
    0.25
}

impl<const D: usize> Contribution<D> for HeatAndSalt {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let wave = |x: f64| (std::f64::consts::TAU * x).cos();
        vec![
            OwnColumn::scalar(VALUE[0], move |birth| wave(birth.position[0])),
            OwnColumn::scalar(VALUE[1], move |birth| 35.0 * wave(birth.position[1])),
        ]
    }
    fn transported(&self) -> Vec<Evolved> {
        let both = VALUE.into_iter().zip(RATE);
        both.map(|(value, rate)| Evolved { value, rate }).collect()
    }
    fn terms(&self, _: &Setting<'_>) -> Vec<Box<dyn Interaction<D>>> {
        vec![
            Box::new(Term(Diffusion::<0>(self.heat))),
            Box::new(Term(Diffusion::<1>(self.salt))),
        ]
    }
    fn limiters(&self, _: &Setting<'_>) -> Vec<Box<dyn Limiter<D>>> {
        vec![Box::new(*self)]
    }
    fn advice(&self, _: &World<D>) -> Vec<String> {
        vec!["stir it".into()]
    }
}

impl<const D: usize> Limiter<D> for HeatAndSalt {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let h = world.kernel.smoothing_length();
        Ok(StepLimit::new(
            "tracer",
            self.limit * h * h / self.heat.max(self.salt),
        ))
    }
    fn formula(&self) -> String {
        "tracer: limit · h²/κ".into()
    }
}

register!(
    TracerEntry [2, 3],
    HeatAndSalt,
    "heat-and-salt",
    "heat and salt",
    "Fick 1855"
);

// ------------------------------------------------------------------------------------------------

use sph_scene::{Override, parse};
use sph_solver::{Examination, RunOptions, SolverError, Start, Summary, examine, run};
use sph_tests::FinalState;

const SCENE: &str = r#"
title = "Heat and salt in a box at rest"
dimension = 2
[run]
end = 0.5
[numerics]
spacing = 0.0625
smoothing_ratio = 2.0
periodic = { x = [0, 1], y = [0, 1] }
[phase.water]
density = 1000.0
speed_of_sound = 4.0
rheology.newtonian = { viscosity = "1 mPa s" }
[body.water]
phase = "water"
box = [[0, 0], [1, 1]]
[probe.heat]
kind = "range"
field = "temperature"
[probe.salt]
kind = "range"
field = "salinity"
scale = 35.0
[output]
every = 0.25
vtk = false
[tracer.heat-and-salt]
heat = 0.04
salt = 0.02
"#;

fn into(
    folder: &std::path::Path,
    changes: &[&str],
    threads: usize,
    start: Start,
) -> Result<Summary, SolverError> {
    let changes: Vec<_> = changes
        .iter()
        .map(|c| Override::parse(c).unwrap())
        .collect();
    let loaded = parse(SCENE, "scene.toml", &changes).unwrap_or_else(|e| panic!("{e}"));
    let options = RunOptions {
        out: folder.to_path_buf(),
        start,
        threads: Some(threads),
        identity: sph_solver::Identity::of_text(SCENE),
    };
    run(&loaded.scene, &options, &mut ())
}

fn examined(changes: &[&str]) -> Examination {
    let changes: Vec<_> = changes
        .iter()
        .map(|c| Override::parse(c).unwrap())
        .collect();
    let loaded = parse(SCENE, "scene.toml", &changes).unwrap_or_else(|e| panic!("{e}"));
    examine(&loaded.scene, 1).unwrap_or_else(|e| panic!("{e}"))
}

/// Rate at which a wave of length 1 dies on the lattice, over κ: 2 Σ_b V F_ab (1 − cos k x_b), the operator's own.
fn decay_on_the_lattice() -> f64 {
    let loaded = parse(SCENE, "scene.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
    let parts = sph_solver::assemble::<2>(&loaded.scene).unwrap_or_else(|e| panic!("{e}"));
    let (world, d) = (&parts.flow.world, 0.0625);
    let reach = (world.kernel.support_radius() / d).ceil() as i32;
    let mut sum = 0.0;
    for i in -reach..=reach {
        for j in -reach..=reach {
            let (x, y) = (f64::from(i) * d, f64::from(j) * d);
            let factor = world.kernel.at(x.hypot(y)).1;
            if (i, j) != (0, 0) && x.hypot(y) < world.kernel.support_radius() {
                sum -= 2.0 * d * d * factor * (1.0 - (std::f64::consts::TAU * x).cos());
            }
        }
    }
    sum
}

/// What is left of both waves at the end, over what they were.
fn left(folder: &std::path::Path) -> [f64; 2] {
    let series = std::fs::read_to_string(folder.join("series.csv")).expect("a series");
    let series = sph_io::Table::parse(&series, "series.csv").expect("a table");
    ["heat.max", "salt.max"].map(|name| {
        let heights = series.column(name).expect("a column");
        heights.last().expect("a row") / heights[0]
    })
}

/// Relative errors of both waves against exp(−λt), and λΔt of each.
fn errors(changes: &[&str]) -> [(f64, f64); 2] {
    let folder = tempfile::tempdir().expect("a folder");
    let summary = into(folder.path(), changes, 1, Start::Afresh).unwrap_or_else(|e| panic!("{e}"));
    let (t, dt) = (
        summary.simulated_seconds,
        summary.simulated_seconds / summary.steps as f64,
    );
    let per_diffusivity = decay_on_the_lattice();
    let both = left(folder.path()).into_iter().zip([0.04, 0.02]);
    let errors = both.map(|(left, diffusivity)| {
        let rate = diffusivity * per_diffusivity;
        ((left * (rate * t).exp() - 1.0).abs(), rate * dt)
    });
    errors.collect::<Vec<_>>().try_into().expect("two")
}

/// Explicit Euler steps lose λ²Δt t/2 and Heun's steps λ³Δt² t/6; both scalars are summed in one sweep.
#[test]
fn two_scalars_of_a_kind_of_ones_own_decay_as_the_scheme_says() {
    let per_diffusivity = decay_on_the_lattice();
    for (k, (error, step)) in errors(&[]).into_iter().enumerate() {
        let rate = [0.04, 0.02][k] * per_diffusivity;
        let bound = 0.5 * rate * 0.5 * step * (1.0 + step);
        println!("scalar {k}: {error:.2e} of at most {bound:.2e}");
        assert!(error < bound && error > 0.5 * bound, "{error} for {bound}");
    }
    let heun = errors(&["integrator.predictor-corrector={courant=0.4}"]);
    for (k, (error, step)) in heun.into_iter().enumerate() {
        let rate = [0.04, 0.02][k] * per_diffusivity;
        let bound = rate * 0.5 * step * step / 6.0 * (1.0 + step) + 1e-9;
        println!("scalar {k}, Heun: {error:.2e} of at most {bound:.2e}");
        assert!(error < bound, "{error} for {bound}");
    }
}

#[test]
fn one_sweep_sums_both_and_a_scene_without_them_has_nothing_of_them() {
    let with = examined(&[]);
    let sweeps: Vec<_> = with
        .stages
        .iter()
        .filter(|s| {
            s.writes
                .iter()
                .any(|w| w.ends_with("_rate") || w == "acceleration")
        })
        .collect();
    let [sweep] = &sweeps[..] else {
        panic!("one sweep: {sweeps:?}")
    };
    // Fused by the entry above.
    assert!(
        sweep
            .name
            .contains("diffusion of temperature + diffusion of salinity"),
        "{}",
        sweep.name
    );
    assert!(
        with.step_limits.contains_key("tracer"),
        "{:?}",
        with.step_limits
    );
    let state = |name: &str| with.fields.iter().any(|f| f.name == name && f.state);
    assert!(state("temperature") && state("salinity"));
    let without = examined(&[
        "tracer={}",
        "probe.heat.field=pressure",
        "probe.salt.field=pressure",
    ]);
    assert!(
        without
            .fields
            .iter()
            .all(|f| !f.name.starts_with("temperature"))
    );
    assert!(!without.step_limits.contains_key("tracer"));
}

#[test]
fn its_step_limit_binds_and_its_advice_is_given() {
    let folder = tempfile::tempdir().expect("a folder");
    let changes = ["tracer.heat-and-salt.limit=0.01"];
    let summary = into(folder.path(), &changes, 1, Start::Afresh).expect("a run");
    // 0.01 (0.125 m)²/(0.04 m²/s) = 3.9 ms.
    assert_eq!(summary.steps, 128);
    assert!(
        summary.dt_limiters["tracer"] > 0.99,
        "{:?}",
        summary.dt_limiters
    );
    assert!(summary.advice.contains(&"stir it".to_string()));
    let plugin = summary
        .plugins
        .iter()
        .find(|p| p.kind == "tracer")
        .expect("in force");
    assert_eq!(
        (plugin.name.as_str(), plugin.parameters["salt"].as_f64()),
        ("heat-and-salt", Some(0.02))
    );
}

#[test]
fn one_and_two_threads_and_a_resumed_run_have_the_same_bits() {
    let [one, two, resumed] = [(); 3].map(|()| tempfile::tempdir().expect("a folder"));
    into(one.path(), &[], 1, Start::Afresh).expect("a run");
    into(two.path(), &[], 2, Start::Afresh).expect("a run");
    into(resumed.path(), &["run.max_steps=5"], 1, Start::Afresh).expect("a beginning");
    into(resumed.path(), &[], 2, Start::Resumed).expect("the rest");
    let whole = FinalState::of(one.path());
    whole.assert_same(&FinalState::of(two.path()), "one thread and two");
    whole.assert_same(&FinalState::of(resumed.path()), "whole and resumed");
}

#[test]
fn scenes_are_told_what_is_wrong_with_it() {
    let told = |scene: &str| match parse(scene, "scene.toml", &[]) {
        Err(refused) => refused.to_string(),
        Ok(loaded) => examine(&loaded.scene, 1)
            .expect_err("a refusal")
            .to_string(),
    };
    let unknown = told(&SCENE.replace("tracer.heat-and-salt", "tracer.heat-and-sald"));
    assert!(unknown.contains("heat-and-salt"), "{unknown}");
    let kind = told(&SCENE.replace("[tracer.", "[tracers."));
    assert!(kind.contains("tracer"), "{kind}");
    let unit = told(&SCENE.replace("salt = 0.02", "salt = \"2 m\""));
    assert!(
        unit.contains("tracer.heat-and-salt.salt") || unit.contains("m²/s"),
        "{unit}"
    );
    let schema = sph_scene::schema();
    let at = "/properties/tracer/properties/heat-and-salt/properties/heat/unit";
    assert_eq!(schema.pointer(at).and_then(|u| u.as_str()), Some("m²/s"));
}
