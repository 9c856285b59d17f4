//! Velocities that are damped: everywhere, in a sponge, for a while.

use sph_tests::{CHECK_AND_RUN, PERIODIC, bench, close, within};

/// Rows of momentum along x and time, one for every step.
fn momenta(damping: &str, overrides: &str) -> Vec<[f64; 2]> {
    let every = "series_every = 1e-9\nevery = 0.1";
    let scene = PERIODIC.replace("every = 0.1", every) + "\n[damping.rayleigh]\n" + damping;
    let bench = bench!(&scene);
    bench.done(&format!("run scene.toml --quiet --out r {overrides}"));
    let series = bench.series("r");
    let column = |name: &str| series.column(name);
    let both = column("time").iter().zip(column("momentum.x"));
    both.map(|(t, p)| [*t, *p]).collect()
}

/// A uniform flow keeps 1/(1 + ΓΔt) of its momentum in every step, to rounding.
#[test]
fn a_uniform_flow_dies_away_by_the_rate_of_every_step() {
    let rows = momenta("rate = 30.0\n", "");
    assert!(rows.len() > 10, "{} rows", rows.len());
    for pair in rows.windows(2) {
        let [[from, before], [to, after]] = [pair[0], pair[1]];
        let left = 1.0 / (1.0 + 30.0 * (to - from));
        let error = (after / before / left - 1.0).abs();
        assert!(error < 1e-12, "{error:e} of the momentum at {to} s");
    }
    // What is left after 0.1 s of Γ = 30 1/s is e⁻³ of it, and more by half of Γ²Δt t, which backward Euler is late.
    let ratio = rows[rows.len() - 1][1] / rows[0][1];
    let kept = (-3.0f64).exp();
    within(ratio, kept..1.25 * kept, "share of the momentum");
}

#[test]
fn it_ends_when_it_is_told_and_leaves_the_velocity_that_it_is_told() {
    let rows = momenta("rate = 1e6\nuntil = 0.05\nvelocity = [0.25, 0.0]\n", "");
    let start = rows[0][1];
    let [_, end] = rows[rows.len() - 1];
    // ΓΔt is some thousand: one step leaves a thousandth of the difference, two a millionth.
    close(
        end / start,
        0.25,
        1e-6,
        "share of the momentum that is left",
    );
    let late = rows.iter().filter(|row| row[0] > 0.06).map(|row| row[1]);
    let drift = late.map(|p| (p / end - 1.0).abs()).fold(0.0, f64::max);
    assert!(drift < 1e-12, "{drift:e} after its end");
}

#[test]
fn only_the_zone_is_damped() {
    let zone = "rate = 1e13\nzones = [{ axis = \"y\", from = 0.499, to = 0.501 }]\n";
    let rows = momenta(zone, "--set run.end=1e-5");
    let ratio = rows[rows.len() - 1][1] / rows[0][1];
    close(ratio, 0.5, 1e-6, "share with the upper half held");
}

#[test]
fn invalid_damping_is_refused() {
    let changes = include_str!("damping.refused");
    bench!().refuses("scene.toml", &CHECK_AND_RUN, PERIODIC, changes);
}
