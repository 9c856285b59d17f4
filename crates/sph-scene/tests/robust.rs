//! No text and no override makes the reader panic.

use proptest::prelude::*;
use sph_scene::{Offset, Override, estimate, fill, parse};

const GOOD: [&str; 3] = [
    include_str!("good/dam_break.toml"),
    include_str!("good/poiseuille.toml"),
    include_str!("good/drop.toml"),
];

const PIECES: [&str; 16] = [
    "[",
    "]",
    "{",
    "}",
    "=",
    "\"",
    "nan",
    "-1e308",
    "1e308",
    "[[0,0],[0,0]]",
    ".",
    "\n",
    "é",
    "99999999999999999999",
    "-0.0",
    "[wall.x]\npolyline=[[0,0],[1,1]]\n",
];

fn read(text: &str, overrides: &[Override]) {
    match parse(text, "x.toml", overrides) {
        Err(refused) => {
            assert!(!refused.diagnostics.is_empty());
            for d in &refused.diagnostics {
                let text = refused.source.text_of(d);
                assert!(text.get(d.span.clone()).is_some() && d.line >= 1 && d.column >= 1);
            }
        }
        Ok(loaded) if loaded.scene.dimension == 2 => {
            let spacing = loaded.scene.numerics.spacing;
            let bodies = loaded.scene.regions::<2>();
            if estimate(&bodies, spacing) < 1e4 {
                fill(
                    &bodies,
                    spacing,
                    Offset::None,
                    &loaded.scene.numerics.periodic.bounds(),
                );
            }
        }
        Ok(_) => {}
    }
}

fn boundary(text: &str, at: usize) -> usize {
    (0..=at % (text.len() + 1))
        .rev()
        .find(|k| text.is_char_boundary(*k))
        .unwrap_or(0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        read(&String::from_utf8_lossy(&bytes), &[]);
    }

    #[test]
    fn mutated_scenes(
        which in 0..GOOD.len(),
        edits in proptest::collection::vec((any::<usize>(), 0usize..6, 0..PIECES.len()), 1..4),
    ) {
        let mut text = GOOD[which].to_string();
        for (at, cut, piece) in edits {
            let start = boundary(&text, at);
            let end = boundary(&text, (start + cut).min(text.len())).max(start);
            text.replace_range(start..end, PIECES[piece]);
        }
        read(&text, &[]);
    }

    #[test]
    fn any_override(path in "[a-z\\[\\]0-9.\"]{0,12}", value in "\\PC{0,12}", which in 0..5usize) {
        let head = ["", "numerics.", "wall.tank.polyline", "body.column.", "phase.water."][which];
        if let Ok(set) = Override::parse(&format!("{head}{path}={value}")) {
            read(GOOD[0], &[set]);
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
