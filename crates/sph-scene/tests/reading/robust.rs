//! No text and no override makes the reader panic.

use proptest::prelude::*;
use sph_scene::{Offset, Override, estimate, fill, parse};

const GOOD: [&str; 3] = [
    include_str!("../good/dam_break.toml"),
    include_str!("../good/poiseuille.toml"),
    include_str!("../good/drop.toml"),
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

const DRAWN: [&str; 24] = [
    "M", "m", "L", "h", "V", "C", "s", "Q", "t", "A", "a", "Z", " 0", " 1", "-5", " 10", " 1e-200",
    " 3e8", " 1e308", " 1e999", ",", "0.5", " 7", "x",
];

/// What a wall of a file is, of whatever the file holds.
fn wall(name: &str, bytes: &[u8], dimension: usize) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let keys = format!("file = \"{name}\"");
    for keys in [keys.clone(), format!("{keys}\nfluid = \"inside\"")] {
        match dimension {
            2 => drop(super::common::lines(folder.path(), &keys)),
            _ => drop(super::common::facets(folder.path(), &keys)),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_path_of_a_drawing(pieces in proptest::collection::vec(0..DRAWN.len(), 0..40)) {
        let data: String = pieces.iter().map(|k| DRAWN[*k]).collect();
        let svg = format!("<svg><path d='M0 0{data}'/><rect width='9' height='1' rx='{data}'/></svg>");
        wall("x.svg", svg.as_bytes(), 2);
        let svg = format!("<svg viewBox='{data}'><path transform='scale({data})' d='M0 0{data}'/></svg>");
        wall("x.svg", svg.as_bytes(), 2);
    }

    #[test]
    fn any_bytes_of_files(bytes in proptest::collection::vec(any::<u8>(), 0..300), count in 0u8..6) {
        wall("x.svg", &bytes, 2);
        wall("x.csv", &bytes, 2);
        let mut stl = vec![0; 80];
        stl.extend([count, 0, 0, 0]);
        stl.extend(&bytes);
        wall("x.stl", &stl, 3);
        let text = String::from_utf8_lossy(&bytes);
        wall("x.stl", format!("solid x\n{text}\nendsolid").as_bytes(), 3);
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
