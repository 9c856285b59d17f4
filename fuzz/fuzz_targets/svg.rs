//! An SVG drawing, as a whole and as the data of a path.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sph_scene::Line;

fuzz_target!(|text: &str| {
    let path = format!("<svg><path d='{text}'/></svg>");
    for drawing in [text, &path] {
        if let Ok(lines) = Line::from_svg(drawing, "fuzzed.svg", 0.05) {
            let points = || lines.iter().flat_map(|l| &l.points);
            assert!(points().flatten().all(|x| x.is_finite()));
            assert!(points().count() <= 2_000_000);
        }
    }
});
