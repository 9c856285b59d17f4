//! Axes that are gone along until they break, and the shipped ones that must hold.

use crate::study::{bench, files, json, says};

/// Vortices of some ten steps: an axis that breaks at its second value, and one that is yellow at its second, with
/// two combinations of plugins.
const STUDY: &str = r#"title = "Vortices until they break"
scene = "taylor-green-2d"
set.run.end = 0.02
set.run.retries = 1
set.numerics.spacing = 0.0625
judge = { compression = [0.005, 1.0] }

[[axis]]
name = "bounds"
title = "How tight the bounds of the density are"
error = "velocity-l1"
must = "tight"
judge = { velocity-l1 = [0.5, 0.9] }
entries = [
    { name = "loose", set = { numerics.density_bounds = [0.5, 2.0] } },
    { name = "tight", set = { numerics.density_bounds = [0.9999, 1.0001] } },
    { name = "tighter", set = { numerics.density_bounds = [0.99999, 1.00001] } },
]

[[axis]]
name = "sound"
title = "Speed of sound, m/s"
key = "phase.fluid.speed_of_sound"
values = [40.0, 5.0]
must = 40.0

[[combination]]
name = "morris"
axes = ["sound"]
[[combination]]
name = "krimi"
axes = ["sound"]
set.viscous-operator.krimi = {}
"#;

#[test]
fn an_axis_ends_where_it_breaks_and_says_when_where_and_why() {
    let bench = bench(STUDY);
    let outcome = bench.done("study s.toml --threads 1");
    for word in ["bounds", "loose", "NO", "nowhere"] {
        assert!(
            outcome.out.contains(word),
            "no `{word}` in\n{}",
            outcome.out
        );
    }
    let told = json(&bench.read("results/studies/s/study.json"));
    let frontiers = told["frontiers"].as_array().expect("frontiers");
    let of = |k: usize, key: &str| frontiers[k][key].clone();
    assert_eq!(frontiers.len(), 3);
    assert_eq!(of(0, "holds_to"), "loose");
    assert_eq!(of(0, "breaks_at")[0], "tight");
    assert_eq!(of(0, "met"), false);
    assert_eq!(
        (of(1, "combination"), of(2, "combination")),
        ("morris".into(), "krimi".into())
    );
    for k in [1, 2] {
        assert_eq!(
            (of(k, "green_to"), of(k, "holds_to")),
            ("40".into(), "5".into())
        );
        assert_eq!(
            (of(k, "met"), of(k, "breaks_at")),
            (true.into(), serde_json::Value::Null)
        );
    }

    let variants = told["variants"].as_array().expect("variants");
    let of = |name: &str| {
        let found = variants.iter().find(|v| v["name"] == name);
        found.unwrap_or_else(|| panic!("no {name}"))
    };
    let loose = of("bounds_loose");
    assert_eq!(
        (&loose["verdict"]["colour"], &loose["verdict"]["why"]),
        (&"green".into(), &"".into())
    );
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
    assert!(
        tighter["reason"]
            .as_str()
            .is_some_and(|r| r.contains("bounds_tight"))
    );
    let yellow = of("sound_krimi_5");
    assert!(
        yellow["verdict"]["why"]
            .as_str()
            .is_some_and(|w| w.starts_with("compression"))
    );

    let folder = bench.path("results/studies/s");
    assert_eq!(
        files(&folder),
        [
            "axis-bounds.png",
            "axis-bounds.svg",
            "axis-sound.png",
            "axis-sound.svg",
            "report.html",
            "study.csv",
            "study.json",
            "variants"
        ]
    );
    let page = bench.read("results/studies/s/report.html");
    for word in [
        "class=\"green\"",
        "class=\"red must\"",
        "class=\"none\"",
        "of particle",
        "<svg",
    ] {
        assert!(page.contains(word), "no `{word}` on the page");
    }
    assert_eq!(bench.read("results/studies/s/study.csv").lines().count(), 8);

    // Nothing is run twice, not even what is skipped, until the axis no longer breaks.
    says(&bench.done("study s.toml"), &["7 variants, 0 to run"]);
    bench.write("s.toml", &STUDY.replace("[0.9999, 1.0001]", "[0.4, 2.0]"));
    says(&bench.done("study s.toml"), &["7 variants, 2 to run"]);
}

#[test]
fn mistakes_of_axes_are_shown_where_they_are_made() {
    for (from, to, line, words) in [
        ("must = \"tight\"", "must = \"tigth\"", 12, "has no `tigth`"),
        (
            "velocity-l1 = [0.5, 0.9]",
            "velocity = [0.5, 0.9]",
            13,
            "nothing is called `velocity`",
        ),
        ("[0.5, 0.9] }", "[0.9, 0.5] }", 13, "in this order"),
        (
            "axes = [\"sound\"]\n[[",
            "axes = [\"sounds\"]\n[[",
            29,
            "did you mean",
        ),
        ("name = \"sound\"", "name = \"Bounds\"", 21, "another axis"),
        (
            "must = 40.0",
            "must = 40.0\nerror = \"speed\"",
            26,
            "no reference called `speed`",
        ),
        (
            "set.run.retries = 1",
            "vary = []\nset.run.retry = 1",
            5,
            "retry",
        ),
        (
            "scene = \"taylor-green-2d\"\n",
            "",
            7,
            "neither the axis nor the study has a scene",
        ),
    ] {
        assert!(STUDY.contains(from), "the study lost `{from}`");
        let bench = bench(&STUDY.replacen(from, to, 1));
        let outcome = bench.call("study s.toml");
        assert_eq!(outcome.code, Some(2), "{to}: {}", outcome.err);
        says(&outcome, &[words, &format!("s.toml:{line}:")]);
        assert!(!bench.path("results").exists());
    }
}

/// The values that must survive, of axes whose runs take seconds, from the shipped study.
const QUICK: [&str; 17] = [
    "viscosity-ratio_1e6",
    "density-ratio-dam-break_1000",
    "reynolds-number_1e-6",
    "stress-growth_1e6",
    "friction-angle_plane-strain_55-deg",
    "concave-corner_15",
    "convex-corner_15",
    "gate-thickness_1",
    "mach-number_0.3",
    "kernel-narrow_1.2",
    "kernel-wide_3",
    "disorder_0.3",
    "velocity-noise_0.3",
    "gravity_0",
    "gravity_1e3",
    "jet-on-wall_10",
    "falling-block_10",
];

#[test]
fn required_values_survive() {
    let bench = bench("");
    let only: Vec<String> = QUICK.iter().map(|name| format!("--only {name}")).collect();
    bench.done(&format!(
        "study scenes/stability.toml --quiet --out s {}",
        only.join(" ")
    ));
    let told = json(&bench.read("s/study.json"));
    let variants = told["variants"].as_array().expect("variants");
    for name in QUICK {
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
    assert!(
        error("gravity_0") < Some(1e-12),
        "nothing may move without gravity"
    );
    // A run beyond Mach 0.1 says so.
    let summary = json(&bench.read("s/variants/mach-number_0.3/summary.json"));
    let advice = summary["advice"].to_string();
    assert!(advice.contains("of the speed of sound"), "{advice}");
}
