//! Former names of keys and columns.

use sph_scene::{Loaded, Refused, parse};

use super::common::says;

fn read(numerics: &str, output: &str, probe: &str) -> Result<Loaded, Refused> {
    let text = format!(
        "title = \"t\"\ndimension = 2\nrun.end = 1\nnumerics = {{ spacing = 0.1, {numerics} }}\n\
         phase.soil = {{ density = 1, rheology.newtonian = {{}} }}\n\
         body.b = {{ phase = \"soil\", box = [[0, 0], [1, 1]] }}\n{output}\n{probe}\n"
    );
    parse(&text, "scene.toml", &[])
}

#[test]
fn former_names_are_read_with_a_remark_at_their_line() {
    let old = read(
        "disorder = 0.2",
        "output.fields = [\"pressure\", \"emptiness\"]",
        "probe.p = { kind = \"statistic\", field = \"elastic_turn.xx\", above = { held_share = 0.5 } }",
    )
    .unwrap_or_else(|e| panic!("{e}"));
    let new = read(
        "jitter = 0.2",
        "output.fields = [\"pressure\", \"void_fraction\"]",
        "probe.p = { kind = \"statistic\", field = \"stress_rotation.xx\", above = { yield_factor = 0.5 } }",
    )
    .unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(old.resolved(), new.resolved());
    assert_eq!(old.scene.jitter(), 0.2);
    let remarks = |loaded: &Loaded, word: &str| {
        let all = loaded.scene.remarks.iter();
        all.filter(|r| r.contains("is called") && r.contains(word))
            .count()
    };
    for name in [
        "`jitter`",
        "`void_fraction`",
        "`stress_rotation`",
        "`yield_factor`",
    ] {
        assert_eq!([remarks(&old, name), remarks(&new, name)], [1, 0], "{name}");
    }
    let jitter = old.scene.remarks.iter().find(|r| r.contains("`jitter`"));
    let jitter = jitter.expect("a remark");
    assert!(jitter.starts_with("scene.toml:4:"), "{jitter}");
}

#[test]
fn a_key_under_both_names_is_refused() {
    let refused = read("disorder = 0.2, jitter = 0.1", "", "").expect_err("two values");
    let text = refused.to_string();
    says(&text, "numerics.disorder: is the former name of `jitter`");
}
