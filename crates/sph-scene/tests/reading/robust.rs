//! No override and no nesting makes the reader panic. Mutated scenes, drawings, tables and surfaces are read by
//! `tests/tests/refused` of the workspace, any bytes by the targets of `fuzz`.

use proptest::prelude::*;
use sph_scene::{Override, parse};

fn read(text: &str, overrides: &[Override]) {
    if let Err(refused) = parse(text, "x.toml", overrides) {
        assert!(!refused.diagnostics.is_empty());
        for d in &refused.diagnostics {
            let text = refused.source.text_of(d);
            assert!(text.get(d.span.clone()).is_some() && d.line >= 1 && d.column >= 1);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_override(path in "[a-z\\[\\]0-9.\"]{0,12}", value in "\\PC{0,12}", which in 0..5usize) {
        let head = ["", "numerics.", "wall.tank.polyline", "body.column.", "phase.water."][which];
        if let Ok(set) = Override::parse(&format!("{head}{path}={value}")) {
            read(include_str!("../good/dam_break.toml"), &[set]);
        }
    }
}

#[test]
fn deep_nesting_is_refused() {
    read(&format!("a = {}1", "[".repeat(100_000)), &[]);
    read(&format!("{} = 1", vec!["a"; 100_000].join(".")), &[]);
    read(&format!("[{}]", vec!["a"; 100_000].join(".")), &[]);
    read(&format!("a = {}1", "{a=".repeat(100_000)), &[]);
    read("", &[]);
    assert!(Override::parse(&format!("a={}", "[".repeat(100_000))).is_err());
}
