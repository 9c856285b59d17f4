//! Particles leave by outlets, and nothing of them is lost.

use sph_tests::{DAM_BREAK, bench, line_of};

#[test]
fn outflow_is_counted_and_missing_in_the_flow() {
    let outlet = "[outlet.end]\nbeyond = 0.45\n[probe.lost]\nkind = \"eroded-mass\"\n\
                  phase = \"water\"\nlevel = 10";
    let bench = bench!(&format!("{DAM_BREAK}\n{outlet}\n"));
    bench.done("run scene.toml --quiet --out r");
    let series = bench.series("r");
    let column = |name: &str| series.column(name);
    let mass = column("outlet.end.water");
    let count = column("outlet.end.water.particles");
    assert!(mass.windows(2).all(|m| m[0] <= m[1]), "masses only leave");
    assert_eq!((mass[0], count[0]), (0.0, 0.0));
    let last = (*mass.last().expect("rows"), *count.last().expect("rows"));
    assert_eq!(column("lost.out"), mass, "a probe of what has left");
    let summary: serde_json::Value = bench.summary("r");
    let left = &summary["left"]["outlet.end.water"];
    assert_eq!(left["mass"].as_f64(), Some(last.0));
    assert_eq!(left["particles"].as_f64(), Some(last.1));
    let particles = summary["particles"].as_f64().expect("a number");
    let all = last.1 + particles;
    bench.done("run scene.toml --quiet --out s --set run.end=1e-6");
    let start: serde_json::Value = bench.summary("s");
    let start = start["particles"].as_f64().expect("a number");
    assert!(last.1 > 20.0, "only {} particles left", last.1);
    assert_eq!(all, start, "{} left and {particles} are there", last.1);
    let drift = summary["drift"]["mass"].as_f64().expect("a number");
    assert!(drift.abs() < 1e-14, "mass drift {drift:e} with what left");
}

#[test]
fn an_outlet_where_a_body_starts_is_refused_at_its_line() {
    let scene = format!("{DAM_BREAK}\n[outlet.end]\nbox = [[0.1, 0.1], [0.15, 0.15]]\n");
    let bench = bench!(&scene);
    let outcome = bench.refused("run scene.toml --quiet --out r");
    let said = "the body `column` stands in the outlet at the start, for instance at [";
    outcome.says(said);
    let line = line_of(&scene, "[outlet.end]");
    outcome.says(&format!("scene.toml:{line}:"));
}
