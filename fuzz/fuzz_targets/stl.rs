//! The bytes of an STL file: its triangles, and the solid that they enclose.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sph_scene::Facets;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(facets) = Facets::from_stl(bytes.to_vec(), "fuzzed.stl") {
        let points = facets.points.len() as u32;
        assert!(facets.triangles.iter().flatten().all(|k| *k < points));
        assert!(facets.points.iter().flatten().all(|x| x.is_finite()));
        // A facet takes 50 bytes, or some 20 as text of the shortest form.
        assert!(facets.triangles.len() <= bytes.len() / 20);
        let _ = (facets.area(), facets.volume());
    }
});
