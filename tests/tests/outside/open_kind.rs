//! The kind of plugin of `examples/tracer`: heat and salt that diffuse through a fluid, `[tracer.heat-and-salt]`.

use sph_particles::setup::{Examination, examine};
use sph_scene::parse;
use sph_tests::{Ran, Says, assembled, ran, same_bits, scene};
use tracer as _;

const SCENE: &str = include_str!("heat-and-salt.toml");

fn finished(changes: &[&str]) -> Ran {
    ran(&scene(SCENE, changes), 1).unwrap_or_else(|e| panic!("{e}"))
}

fn examined(changes: &[&str]) -> Examination {
    examine(&scene(SCENE, changes)).unwrap_or_else(|e| panic!("{e}"))
}

/// Rate at which a wave of length 1 dies on the lattice, over κ: 2 Σ_b V F_ab (1 − cos k x_b), the operator's own.
fn decay_on_the_lattice() -> f64 {
    let parts = assembled::<2>(&scene(SCENE, &[]));
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

/// Relative errors of both waves against exp(−λt), and λΔt of each.
fn errors(changes: &[&str]) -> [(f64, f64); 2] {
    let run = finished(changes);
    let (t, steps) = (run.summary.simulated_seconds, run.summary.steps as f64);
    let dt = t / steps;
    // What is left of both waves at the end, over what they were.
    let left = ["heat.max", "salt.max"].map(|name| run.last(name) / run.column(name)[0]);
    let per_diffusivity = decay_on_the_lattice();
    let both = left.into_iter().zip([0.04, 0.02]);
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
    let rate = |written: &String| written.ends_with("_rate") || written == "acceleration";
    let sweeps = with.stages.iter().filter(|s| s.writes.iter().any(rate));
    let sweeps: Vec<_> = sweeps.collect();
    let [sweep] = &sweeps[..] else {
        panic!("one sweep: {sweeps:?}")
    };
    sweep
        .name
        .says("diffusion of temperature; diffusion of salinity");
    assert!(with.step_limits.contains_key("tracer"));
    let state = |name: &str| with.fields.iter().any(|f| f.name == name && f.state);
    assert!(state("temperature") && state("salinity"));
    let pressures = ["probe.heat.field=pressure", "probe.salt.field=pressure"];
    let without = examined(&["tracer={}", pressures[0], pressures[1]]);
    let mut fields = without.fields.iter();
    assert!(fields.all(|f| !f.name.starts_with("temperature")));
    assert!(!without.step_limits.contains_key("tracer"));
}

#[test]
fn its_step_limit_binds_and_its_advice_is_given() {
    let summary = finished(&["tracer.heat-and-salt.limit=0.01"]).summary;
    // 0.01 (0.125 m)²/(0.04 m²/s) = 3.9 ms.
    assert_eq!(summary.steps, 128);
    let limiters = summary.dt_limiters;
    assert!(limiters["tracer"] > 0.99, "{limiters:?}");
    assert!(summary.advice.contains(&"stir it".to_string()));
    let plugin = summary.plugins.iter().find(|p| p.kind == "tracer");
    let plugin = plugin.expect("in force");
    assert_eq!(plugin.name, "heat-and-salt");
    assert_eq!(plugin.parameters["salt"].as_f64(), Some(0.02));
}

#[test]
fn one_and_two_threads_and_a_resumed_run_have_the_same_bits() {
    same_bits(SCENE, 5, &[2], |_| ());
}

#[test]
fn scenes_are_told_what_is_wrong_with_it() {
    let told = |scene: &str| match parse(scene, "scene.toml", &[]) {
        Err(refused) => refused.to_string(),
        Ok(loaded) => examine(&loaded.scene).expect_err("a refusal").to_string(),
    };
    let unknown = told(&SCENE.replace("tracer.heat-and-salt", "tracer.heat-and-sald"));
    unknown.says("heat-and-salt");
    let kind = told(&SCENE.replace("[tracer.", "[tracers."));
    kind.says("tracer");
    let unit = told(&SCENE.replace("salt = 0.02", "salt = \"2 m\""));
    assert!(
        unit.contains("tracer.heat-and-salt.salt") || unit.contains("m²/s"),
        "{unit}"
    );
    let schema = sph_scene::schema();
    let at = "/properties/tracer/properties/heat-and-salt/properties/heat/unit";
    assert_eq!(schema.pointer(at).and_then(|u| u.as_str()), Some("m²/s"));
}
