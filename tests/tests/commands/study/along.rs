//! Axes that are gone along until they break, and the shipped ones that must hold.

use sph_tests::Says;

use crate::study::{bench, files, refuses};

/// Vortices of some ten steps: an axis that breaks at its second value, and one that is yellow at its second, with
/// two combinations of plugins.
const STUDY: &str = include_str!("axes.toml");

#[test]
fn an_axis_ends_where_it_breaks_and_says_when_where_and_why() {
    let bench = bench(STUDY);
    let outcome = bench.done("study s.toml --threads 1");
    outcome.out.says("bounds | loose | NO | nowhere");
    let told = bench.json("results/studies/s/study.json");
    let frontiers = told["frontiers"].as_array().expect("frontiers");
    let of = |k: usize, key: &str| frontiers[k][key].clone();
    assert_eq!(frontiers.len(), 3);
    assert_eq!(of(0, "holds_to"), "loose");
    assert_eq!(of(0, "breaks_at")[0], "tight");
    assert_eq!(of(0, "met"), false);
    assert_eq!([1, 2].map(|k| of(k, "combination")), ["morris", "krimi"]);
    for k in [1, 2] {
        assert_eq!([of(k, "green_to"), of(k, "holds_to")], ["40", "5"]);
        assert_eq!(of(k, "met"), true);
        assert!(of(k, "breaks_at").is_null());
    }

    let variants = told["variants"].as_array().expect("variants");
    let of = |name: &str| {
        let found = variants.iter().find(|v| v["name"] == name);
        found.unwrap_or_else(|| panic!("no {name}"))
    };
    let loose = of("bounds_loose");
    let verdict = &loose["verdict"];
    assert_eq!([&verdict["colour"], &verdict["why"]], ["green", ""]);
    assert!(loose["health"]["density_range"][0].as_f64() < Some(1.0));
    assert!(loose["health"]["mach"].as_f64() > Some(0.05));
    let tight = of("bounds_tight");
    assert_eq!(tight["verdict"]["colour"], "red");
    let trouble = &tight["health"]["first_trouble"];
    assert_eq!(trouble["quantity"], "density", "{tight:#}");
    assert_eq!(trouble["position"].as_array().map(Vec::len), Some(2));
    assert!(trouble["particle"].is_u64() && trouble["time"].is_f64());
    let tighter = of("bounds_tighter");
    assert_eq!(tighter["status"], "skipped");
    tighter["reason"].to_string().says("bounds_tight");
    let yellow = of("sound_krimi_5");
    yellow["verdict"]["why"].to_string().says("\"compression");

    let folder = bench.path("results/studies/s");
    assert_eq!(
        files(&folder).join(" "),
        "axis-bounds.png axis-bounds.svg axis-sound.png axis-sound.svg report.html study.csv study.json variants"
    );
    let page = bench.read("results/studies/s/report.html");
    page.says("class=\"green\" | class=\"red must\" | class=\"none\" | of particle | <svg");
    assert_eq!(bench.read("results/studies/s/study.csv").lines().count(), 8);

    // Nothing is run twice, not even what is skipped, until the axis no longer breaks.
    bench.done("study s.toml").says("7 variants, 0 to run");
    bench.write("s.toml", STUDY.replace("[0.9999, 1.0001]", "[0.4, 2.0]"));
    bench.done("study s.toml").says("7 variants, 2 to run");
}

#[test]
fn mistakes_of_axes_are_shown_where_they_are_made() {
    refuses(STUDY, include_str!("axes.refused"));
}

/// The values that must survive, of axes whose runs take seconds, from the shipped study.
const QUICK: &str = "viscosity-ratio_1e6 density-ratio-dam-break_1000 reynolds-number_1e-6 \
    stress-growth_1e6 friction-angle_plane-strain_55-deg concave-corner_15 convex-corner_15 \
    gate-thickness_1 mach-number_0.3 kernel-narrow_1.2 kernel-wide_3 disorder_0.3 \
    velocity-noise_0.3 gravity_0 gravity_1e3 jet-on-wall_10 falling-block_10";

#[test]
fn required_values_survive() {
    let bench = bench("");
    let only = QUICK.replace(' ', " --only ");
    bench.done(&format!(
        "study scenes/stability.toml --quiet --out s --only {only}"
    ));
    let told = bench.json("s/study.json");
    let variants = told["variants"].as_array().expect("variants");
    for name in QUICK.split(' ') {
        let found = variants.iter().find(|v| v["name"] == name);
        let found = found.unwrap_or_else(|| panic!("the study has no {name}"));
        assert_eq!(found["status"], "done", "{name}: {found:#}");
        let colour = &found["verdict"]["colour"];
        assert!(colour == "green" || colour == "yellow", "{name}: {found:#}");
        assert_eq!(found["health"]["escaped"], 0, "{name}");
    }
    let error = |name: &str| {
        let found = variants.iter().find(|v| v["name"] == name);
        found.and_then(|v| v["errors"]["rest"]["value"].as_f64())
    };
    assert!(error("gravity_0") < Some(1e-12), "it moves");
    // A run beyond Mach 0.1 says so.
    let summary = bench.json("s/variants/mach-number_0.3/summary.json");
    let advice = summary["advice"].to_string();
    advice.says("of the speed of sound");
}
