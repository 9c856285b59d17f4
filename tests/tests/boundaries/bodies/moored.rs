//! A body on a chain.

use sph_tests::bench;

use crate::bodies::FLOAT;

/// H = 0.1 N/m, w = 5 N/m and z = 0.2 m: l_s = √(z² + 2 z H/w) = 0.21909 m hang, and the chain is
/// x + l_s − H/w acosh(1 + w z/H) = 0.35730962 m long for x = 0.2 m; T = H + w z (Faltinsen 1990).
#[test]
fn the_probe_tells_the_tension_of_the_closed_form_and_the_chain_holds_the_box() {
    let line = "density = 500.0\n[[wall.float.mover.rigid-body.line]]\nfrom = [0.1, 0.0]\n\
                to = [0.3, 0.2]\nstiffness = 1e8\nweight = 5.0\nlength = 0.35730962";
    let probe = "[probe.bow]\nkind = \"mooring\"\nwall = \"float\"\n[output]";
    let scene = FLOAT.replacen("density = 500.0", line, 1);
    let scene = scene.replacen("[output]", probe, 1);
    let bench = bench!(&scene);
    bench.done("run scene.toml --quiet --out r --threads 1");
    let series = bench.series("r");
    let column = |name: &str| series.column(name);
    let exact = [
        ("bow.x", -0.1),
        ("bow.y", -5.0 * 0.21908902),
        ("bow.tension", 1.1),
        ("bow.anchor", 0.1),
    ];
    for (name, exact) in exact {
        let found = column(name)[0];
        // The length has eight digits; the chain stretches by 1e-8.
        let off = (found / exact - 1.0).abs();
        assert!(off < 1e-6, "{name}: {found}, off by {off:e}");
    }
}

#[test]
fn a_line_that_is_not_there_is_told() {
    let probe = "[probe.bow]\nkind = \"mooring\"\nwall = \"float\"\nline = 2\n[output]";
    let scene = FLOAT.replacen("[output]", probe, 1);
    let bench = bench!(&scene);
    let outcome = bench.call("run scene.toml --quiet --out r");
    assert_ne!(outcome.code, Some(0));
    let told = outcome.err.contains("`float` has 0 lines");
    assert!(told, "{}", outcome.err);
}
